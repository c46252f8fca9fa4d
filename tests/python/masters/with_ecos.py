"""Ecos, through its Python package: units and connections are taken from the SSP."""

import ctypes
import sys
from pathlib import Path

# Its library needs TBB, which the package of that name puts where no loader looks.
ctypes.CDLL(str(Path(sys.prefix, "lib", "libtbb.so.12")), mode=ctypes.RTLD_GLOBAL)

from ecospy import EcosSimulation  # noqa: E402, needs TBB

from coupling import RECORDED, Coupling, Rows, serve  # noqa: E402


def couple(coupling: Coupling) -> Rows:
    with EcosSimulation(ssp_path=str(coupling.ssp), step_size=coupling.step) as simulation:
        simulation.init()
        yield 0.0, *(simulation.get_real(f"plant::{name}") for name in RECORDED)
        for n in range(1, coupling.steps + 1):
            simulation.step()
            row = (simulation.get_real(f"plant::{name}") for name in RECORDED)
            yield n * coupling.step, *row
        simulation.terminate()


if __name__ == "__main__":
    serve(couple)
