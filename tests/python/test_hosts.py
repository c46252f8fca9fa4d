"""Every foreign master gives the numbers of the project's own; see hosts.py."""

from __future__ import annotations

import subprocess

import pytest

from conftest import Pair
from hosts import HOSTS, Host, MissingError, found, installed, python_of

# Differences of rounding: foreign masters add up time, ours multiplies.
ROUNDING = 9.5
# Masters that drive the first step with zeros miss the motion of one millisecond, in which the arm
# is about to start.
FIRST_STEP = 9.0


@pytest.mark.parametrize("host", HOSTS, ids=lambda host: host.name)
def test_the_pick_up_has_the_same_numbers(host: Host) -> None:
    try:
        agrees = found(host)
    except MissingError as reason:
        print(f"skipped: {host.name} ({reason})")
        pytest.skip(str(reason))
    assert agrees.rows >= round(host.stop / 1e-3) - 1
    bar = ROUNDING if host.hands_over else FIRST_STEP
    assert min(agrees.digits.values()) >= bar, str(agrees)


def test_the_toolbox_finds_nothing_wrong(pair: Pair) -> None:
    """The FMU Manipulation Toolbox: conformity, and semantics that the schema does not cover."""
    python = python_of("requirements")
    if "fmu-manipulation-toolbox" not in installed(python):
        pytest.skip("fmu-manipulation-toolbox")
    for fmu in (pair.controller, pair.plant):
        command = [python.with_name("fmutool"), "-input", fmu, "-check"]
        run = subprocess.run(command, capture_output=True, text=True)
        said = run.stdout + run.stderr
        assert run.returncode == 0, said
        assert "No semantic error" in said and "ERROR" not in said and "WARNING" not in said, said
