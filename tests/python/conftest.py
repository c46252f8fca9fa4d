"""FMUs for the tests: built by the project's own program, once per structure and session."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
CARGO = os.environ.get("CARGO", "cargo")
TARGET = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
sys.path.insert(0, str(ROOT / "examples"))


@dataclass(frozen=True)
class Structure:
    """What is chosen when FMUs are built."""

    links: int
    balance: str = "none"  # or "counterweight", "balance_element"

    def __str__(self) -> str:
        return f"{self.links}{'' if self.balance == 'none' else '-' + self.balance}"


DEFAULT = Structure(3)
BALANCES = ("none", "counterweight", "balance_element")
ALL = [Structure(links, balance) for links in range(1, 7) for balance in BALANCES]
SOME = [DEFAULT, Structure(2, "counterweight"), Structure(1, "balance_element"), Structure(6)]
# Every number of links, and everything that may balance them.
EVERY_LENGTH = [*SOME, Structure(4, "counterweight"), Structure(5, "balance_element")]
FULL = bool(os.environ.get("UAM_FULL"))


@dataclass(frozen=True)
class Pair:
    """The two FMUs of a structure."""

    controller: Path
    plant: Path


def program(*arguments: str) -> str:
    """Run the project's program and return what it prints."""
    command = [CARGO, "run", "--release", "--quiet", "--locked", "--"]
    run = subprocess.run([*command, *arguments], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def read_table(path: Path) -> dict[str, np.ndarray]:
    """The columns of a csv by their headings; true and false are 1 and 0."""
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    numbers = {"true": "1", "false": "0"}
    columns = zip(*([numbers.get(value.lower(), value) for value in row] for row in rows))
    return {name: np.array(column, dtype=float) for name, column in zip(header, columns)}


def simulate(scenario: str, folder: Path, **options: float) -> dict[str, np.ndarray]:
    """What the project's own master records: columns by the names of the variables."""
    given = [text for name, value in options.items() for text in (f"--{name}", str(value))]
    program("simulate", scenario, *given, "--out", str(folder))
    return read_table(folder / f"{scenario}.csv")


@cache
def build(structure: Structure, *options: str) -> Pair:
    """The FMUs of a structure."""
    folder = TARGET / "fmus" / "".join([str(structure), *options])
    name = structure.balance.replace("_", "-")
    balance = [] if name == "none" else [f"--{name}"]
    links = str(structure.links)
    program("build", "--links", links, *balance, *options, "--out", str(folder))
    return Pair(folder / "uam_controller.fmu", folder / "uam_plant.fmu")


@pytest.fixture(scope="session")
def fmus() -> Callable[[Structure], Pair]:
    """The FMUs of any structure."""
    return build


@pytest.fixture(scope="session")
def pair() -> Pair:
    """The FMUs of the default structure."""
    return build(DEFAULT)
