"""The examples on FMUs of the right and of other vehicles."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from conftest import DEFAULT, ROOT, Structure, build, program, simulate


def example(*arguments: str | Path) -> subprocess.CompletedProcess:
    command = [sys.executable, ROOT / "examples" / "scenario.py", *arguments]
    return subprocess.run(command, capture_output=True, text=True)


def exported(scenario: str, folder: Path) -> Path:
    """A scenario as a file, cut to its first seconds."""
    program("export", scenario, "--out", str(folder))
    return folder / f"{scenario}.toml"


def shortened(path: Path) -> Path:
    lines = path.read_text().splitlines()
    lines = ["duration = 2.0" if line.startswith("duration = ") else line for line in lines]
    path.write_text("\n".join(lines))
    return path


STRUCTURES = {"4.3a": DEFAULT, "2.5a": Structure(2), "4.4b": Structure(3, "counterweight")}


@pytest.mark.parametrize("scenario", STRUCTURES)
def test_a_scenario_runs_on_its_own_structure_only(tmp_path: Path, scenario: str) -> None:
    file = shortened(exported(scenario, tmp_path))
    seen = simulate(scenario, tmp_path / "here", stop=2.0)
    expected = f"UAV up to {1e3 * max(seen['base.x']):.1f} mm to the right"
    for structure in [*STRUCTURES.values(), Structure(1, "balance_element")]:
        run = example(file, build(structure).plant.parent)
        if structure == STRUCTURES[scenario]:
            assert run.returncode == 0 and expected in run.stdout, run.stdout + run.stderr
        else:
            assert run.returncode != 0 and run.stdout == "", f"{structure}: {run.stdout}"
            assert "error: " in run.stderr and "is of another structure" in run.stderr, run.stderr


def test_fmus_with_other_start_values_are_refused(tmp_path: Path) -> None:
    """What a file does not set is as in the library; an own vehicle starts with something else."""
    program("build", "--scenario", "4.3a", "--out", str(tmp_path / "own"))
    for scenario, fits in {"4.3a": True, "4.3b": False}.items():
        run = example(shortened(exported(scenario, tmp_path)), tmp_path / "own")
        assert (run.returncode == 0) == fits, run.stderr
        assert fits or "start values of its own that the scenario does not set" in run.stderr


def test_flat_names_are_refused(tmp_path: Path) -> None:
    program("build", "--flat", "--out", str(tmp_path))
    run = example(exported("4.3a", tmp_path), tmp_path)
    assert run.returncode != 0 and "the FMU has none of them" in run.stderr, run.stderr


def test_what_is_missing_is_named(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('id = "mine"\nbased_on = "4.3b"\n')
    run = example(file, tmp_path)
    assert run.returncode != 0 and "lacks duration, step, structure" in run.stderr, run.stderr
    run = example(exported("4.3a", tmp_path), tmp_path / "nowhere")
    assert run.returncode != 0 and "uam_controller.fmu" in run.stderr, run.stderr
    assert "Traceback" not in run.stderr
