"""What every master of this folder is asked for, and how it answers.

Each script here couples the two FMUs in one foreign program with that program's own master:

    python with_NAME.py FOLDER STEP STOP TABLE

reads the FMUs and the SSP in FOLDER, steps by STEP up to STOP [s], and writes TABLE (csv): a row
for every communication point that the program lets its user see. It needs that program only, so
that each may live in an environment of its own.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

# What is compared: outputs of the plant, which stand at the end of every chain of computations.
RECORDED = [
    "base.x",
    "base.y",
    "base.roll",
    "end_effector.x",
    "end_effector.y",
    *(f"joint[{n}].position" for n in (1, 2, 3)),
    "autopilot.thrust",
    "support.force",
]

# The outputs of the controller that the plant has as inputs.
RATES = [f"joint[{n}].rate_command" for n in (1, 2, 3)]
GRASP = "grasp"

Rows = Iterable[tuple[float, ...]]


@dataclass(frozen=True)
class Coupling:
    """A run of controller and plant with the start values that are in the FMUs."""

    folder: Path
    step: float
    stop: float

    @property
    def controller(self) -> Path:
        return self.folder / "uam_controller.fmu"

    @property
    def plant(self) -> Path:
        return self.folder / "uam_plant.fmu"

    @property
    def ssp(self) -> Path:
        return self.folder / "uam.ssp"

    @property
    def steps(self) -> int:
        return round(self.stop / self.step)


def serve(master: Callable[[Coupling], Rows]) -> None:
    """Answer the command line with what the master gives: rows of time and the recorded outputs."""
    folder, step, stop, table = sys.argv[1:]
    rows = master(Coupling(Path(folder).absolute(), float(step), float(stop)))
    with Path(table).open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *RECORDED])
        writer.writerows(rows)
