"""FMUs for the tests: built by the project's own program, once per structure and session."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
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
    command = [os.environ.get("CARGO", "cargo"), "run", "--release", "--quiet", "--locked", "--"]
    run = subprocess.run([*command, *arguments], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


@cache
def build(structure: Structure) -> Pair:
    """The FMUs of a structure."""
    folder = TARGET / "fmus" / str(structure)
    name = structure.balance.replace("_", "-")
    balance = [] if name == "none" else [f"--{name}"]
    program("build", "--links", str(structure.links), *balance, "--out", str(folder))
    return Pair(folder / "uam_controller.fmu", folder / "uam_plant.fmu")


@pytest.fixture(scope="session")
def fmus() -> Callable[[Structure], Pair]:
    """The FMUs of any structure."""
    return build


@pytest.fixture(scope="session")
def pair() -> Pair:
    """The FMUs of the default structure."""
    return build(DEFAULT)
