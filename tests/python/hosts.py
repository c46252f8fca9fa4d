"""The pick-up of thesis 4.3, coupled by every master that can be had, beside the project's own.

    source tests/environment.sh && "$python" tests/python/hosts.py

prints the table of docs/compatibility.md: to how many digits do the numbers agree? What is not
there is named as skipped.
"""

from __future__ import annotations

import os
import subprocess
import sys
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import distributions
from pathlib import Path

import numpy as np

from conftest import CARGO, FULL, ROOT, TARGET, program, read_table, simulate

MASTERS = Path(__file__).parent / "masters"
ENVIRONMENTS = TARGET / "hosts"
SCENARIO, STEP, STOP = "pick-up", 1e-3, 30.0

HEAD = "| master | version | agrees |\n|---|---|---|"

# What is compared, by unit, as far as a host has it: the plant's outputs, or else the controller's.
# Digits are counted from the largest value of the kind.
PLANT = {
    "m": ["base.x", "base.y", "end_effector.x", "end_effector.y"],
    "rad": ["base.roll", *(f"joint[{n}].position" for n in (1, 2, 3))],
    "N": ["autopilot.thrust", "support.force"],
}
CONTROLLER = {
    "m": ["predicted.base.x", "predicted.base.y", "reference.x", "reference.y"],
    "rad": ["predicted.base.roll"],
    "rad/s": [f"joint[{n}].rate_command" for n in (1, 2, 3)],
}

Table = dict[str, np.ndarray]


class MissingError(Exception):
    """A host that this machine cannot have, and why."""


class Host(ABC):
    """A program with a master of its own, and how it deals with the first step."""

    name: str
    package: str
    # Whether the plant's first step is driven by the controller's initial outputs, or by zeros.
    hands_over: bool = True
    # Seconds of the pick-up; less where a host is slow.
    stop: float = STOP

    @abstractmethod
    def version(self) -> str:
        """Of the package."""

    @abstractmethod
    def run(self, folder: Path) -> Table:
        """The recorded outputs over the communication points.

        Raises MissingError where this machine has no such host.
        """


@dataclass(frozen=True)
class Script(Host):
    """A package for Python, and the script in the folder `masters` that uses it."""

    name: str
    script: str
    package: str
    options: tuple[str, ...] = ()
    environment: str = "requirements"
    hands_over: bool = True
    stop: float = STOP

    def version(self) -> str:
        return installed(python_of(self.environment))[self.package]

    def run(self, folder: Path) -> Table:
        python = python_of(self.environment)
        if self.package not in installed(python):
            raise MissingError(f"{self.package} cannot be installed")
        table = folder / f"{self.script}{''.join(self.options)}.csv"
        command = [python, MASTERS / f"{self.script}.py", folder, str(STEP), str(self.stop), table]
        execute([*command, *self.options])
        return read_table(table)


class Crate(Host):
    """A foreign crate, used by an example of the tests' own crate."""

    name = "`fmi` crate, parallel"
    package = "fmi"

    def version(self) -> str:
        lines = (ROOT / "Cargo.lock").read_text().splitlines()
        return lines[lines.index(f'name = "{self.package}"') + 1].split('"')[1]

    def run(self, folder: Path) -> Table:
        if "LIBCLANG_PATH" not in os.environ:
            raise MissingError("LIBCLANG_PATH is not set; source tests/environment.sh")
        table = folder / "fmi-crate.csv"
        cargo = [CARGO, "run", "--quiet", "--locked", "--package", "fmi-host"]
        execute([*cargo, "--example", "couple", "--", folder, str(STEP), str(self.stop), table])
        return read_table(table)


class FmiSim(Host):
    """fmi-sim runs one unit: the controller, which predicts the whole pick-up on its own."""

    name = "fmi-sim, the controller alone"
    package = "fmi-sim"

    def version(self) -> str:
        return "0.7.0"

    def program(self) -> Path:
        """From cargo; only the full set of tests takes the minutes that it needs to be built."""
        root = ENVIRONMENTS / self.package
        program = root / "bin" / "fmi-sim"
        if not program.exists():
            if not FULL:
                raise MissingError("it takes minutes to build: UAM_FULL=1 does it")
            cargo = [CARGO, "install", self.package, "--locked", "--debug"]
            execute([*cargo, "--version", self.version(), "--root", root])
        return program

    def run(self, folder: Path) -> Table:
        table = folder / "fmi-sim.csv"
        command = [self.program(), "--model", folder / "uam_controller.fmu", "-o", table]
        # -n 0: a row for every step.
        execute([*command, "co-simulation", "--step", str(STEP), "-f", str(self.stop), "-n", "0"])
        return read_table(table)


HOSTS: list[Host] = [
    Script("FMPy, a parallel loop", "with_fmpy", "fmpy"),
    Script("libcosim, with the two FMUs", "with_libcosim", "libcosimpy"),
    Script("libcosim, from the SSP", "with_libcosim_ssp", "libcosimpy"),
    Script("Ecos, from the SSP", "with_ecos", "ecospy"),
    Script("container of both, parallel", "with_container", "fmu-manipulation-toolbox"),
    Script(
        "container of both, plant first",
        "with_container",
        "fmu-manipulation-toolbox",
        ("--sequential",),
    ),
    Script("fmuloader, a parallel loop", "with_fmuloader", "fmuloader"),
    Crate(),
    FmiSim(),
    Script("FMPy, from the SSP", "with_fmpy_ssp", "fmpy", hands_over=False),
    Script("CoFMUpy", "with_cofmupy", "cofmupy", (), "requirements-cofmupy", False, 6.0),
]


@dataclass(frozen=True)
class Agreement:
    """How far a host is from the native master."""

    rows: int
    # By unit: largest difference, and digits that agree.
    difference: dict[str, float] = field(default_factory=dict)
    digits: dict[str, float] = field(default_factory=dict)

    def __str__(self) -> str:
        if not any(self.difference.values()):
            return "bit by bit"
        apart = ", ".join(f"{value:.1e} {unit}" for unit, value in self.difference.items())
        apart = apart.replace("e-0", "e-")
        return f"{int(min(self.digits.values()))} digits ({apart})"


def agreement(native: Table, host: Table) -> Agreement:
    """Compare at the communication points that both have."""
    row_of = {round(time / STEP): row for row, time in enumerate(native["time"])}
    rows = [row_of[round(time / STEP)] for time in host["time"]]
    difference, digits = {}, {}
    for unit, names in (PLANT if "base.x" in host else CONTROLLER).items():
        apart = max(np.max(np.abs(host[name] - native[name][rows])) for name in names)
        scale = max(np.max(np.abs(native[name])) for name in names)
        difference[unit], digits[unit] = apart, np.inf if apart == 0 else -np.log10(apart / scale)
    return Agreement(len(rows), difference, digits)


@cache
def native() -> tuple[Path, Table]:
    """The native master's numbers, and the folder with the files that it used."""
    folder = ENVIRONMENTS / "files"
    program("build", "--out", str(folder))
    return folder, simulate(SCENARIO, folder, step=STEP, stop=STOP)


def execute(command: list[str | Path]) -> str:
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 0, f"{command}\n{run.stdout[-3000:]}\n{run.stderr[-3000:]}"
    return run.stdout


@cache
def python_of(environment: str) -> Path:
    """The interpreter of a local environment, which is made if it is missing or out of date."""
    requirements = MASTERS / f"{environment}.txt"
    folder = ENVIRONMENTS / environment
    python, made_for = folder / "bin" / "python", folder / "made-for"
    wanted = f"{sys.version}\n{requirements.read_text()}"
    if made_for.exists() and made_for.read_text() == wanted:
        return python
    execute([sys.executable, "-m", "venv", "--clear", folder])
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]
    lines = [line for line in requirements.read_text().splitlines() if line[:1] not in ("", "#")]
    if subprocess.run([*pip, *lines], capture_output=True).returncode != 0:
        # One of them is not to be had for this machine: the others may be.
        for line in lines:
            subprocess.run([*pip, line], capture_output=True)
    made_for.write_text(wanted)
    return python


@cache
def installed(python: Path) -> dict[str, str]:
    """Packages of an environment, with their versions."""
    folders = [str(path) for path in python.parents[1].glob("lib/python*/site-packages")]
    names = {
        d.metadata["Name"].lower().replace("_", "-"): d.version for d in distributions(path=folders)
    }
    return names


@cache
def found(host: Host) -> Agreement:
    """What comes out with a host. Raises MissingError where this machine has no such host."""
    folder, ours = native()
    return agreement(ours, host.run(folder))


def title(host: Host) -> str:
    """Its name, and what is special about its run."""
    remarks = [] if host.hands_over else ["zeros in the first step"]
    remarks += [] if host.stop == STOP else [f"the first {host.stop:.0f} s"]
    return f"{host.name} ({'; '.join(remarks)})" if remarks else host.name


def row(host: Host) -> str:
    """A host's line of the table. Raises MissingError where this machine has no such host."""
    return f"| {title(host)} | {host.package} {host.version()} | {found(host)} |"


def main() -> None:
    print(HEAD)
    for host in HOSTS:
        try:
            print(row(host))
        except MissingError as reason:
            print(f"skipped: {host.name} ({reason})", file=sys.stderr)


if __name__ == "__main__":
    main()
