"""FMPy, unit by unit: the parallel master that is the project's example."""

import sys
from pathlib import Path

from coupling import RECORDED, Coupling, Rows, serve

sys.path.insert(0, str(Path(__file__).parents[3] / "examples"))

import couple as example  # noqa: E402, found in the folder of the examples


def couple(coupling: Coupling) -> Rows:
    example.RECORDED = RECORDED
    run = example.couple(coupling.folder, coupling.step, coupling.stop)
    return zip(*(run[name] for name in ["time", *RECORDED]))


if __name__ == "__main__":
    serve(couple)
