"""The SSP of every structure and of scenarios: valid, and runnable where the start values say."""

from __future__ import annotations

import io
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import get_connections, read_ssd, read_ssv

from conftest import ALL, Pair, Structure, build, program, simulate

# Scenarios of all kinds of structures, and how long they are watched [s].
SCENARIOS = {"2.5a": 2.0, "4.4b": 2.0, "4.3a": 2.0}
STEP = 1e-3


@pytest.mark.parametrize("structure", ALL, ids=str)
def test_system_and_parameters_follow_the_schemas_of_the_standard(structure: Structure) -> None:
    """FMPy checks both against the schemas, and gives every connection its connectors."""
    ssp = build(structure).plant.with_name("uam.ssp")
    system = read_ssd(str(ssp)).system
    coordinates = structure.links + (structure.balance != "none")
    assert len(get_connections(system)) == 2 * coordinates + 1
    parameters = {p.name for p in read_ssv(str(ssp), "resources/uam.ssv").parameters}
    assert {"uav.mass", f"link[{structure.links}].length", "autopilot.roll.kd"} <= parameters
    with zipfile.ZipFile(ssp) as archive:
        for unit in ("uam_controller", "uam_plant"):
            with zipfile.ZipFile(io.BytesIO(archive.read(f"resources/{unit}.fmu"))) as fmu:
                assert fmu.testzip() is None


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_the_system_of_a_scenario_runs_it_without_being_told_anything(
    tmp_path: Path, scenario: str
) -> None:
    """FMPy's master drives the first step with zeros: the numbers agree but for that step."""
    program("build", "--scenario", scenario, "--out", str(tmp_path))
    stop = SCENARIOS[scenario]
    there = simulate_ssp(str(tmp_path / "uam.ssp"), stop_time=stop - STEP / 2, step_size=STEP)
    here = simulate(scenario, tmp_path / "native", stop=stop)
    assert max(abs(here[name][-1]) for name in ("base.x", "base.y")) > 1e-3, "it moves"
    for name in ("base.x", "base.y", "base.roll", "end_effector.x", "end_effector.y"):
        assert there[f"plant.{name}"][-1] == pytest.approx(here[name][-1], abs=2e-6), name


def test_omsimulator_runs_the_system(pair: Pair, tmp_path: Path) -> None:
    """Only where the program is on the path: its package fetches it from elsewhere."""
    oms = shutil.which("OMSimulator")
    if oms is None:
        print("skipped: OMSimulator")
        pytest.skip("OMSimulator")
    result = tmp_path / "result.csv"
    command = [oms, "--stopTime=1", f"--resultFile={result}", pair.plant.with_name("uam.ssp")]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    said = run.stdout + run.stderr
    assert run.returncode == 0 and "error:" not in said.lower(), said
    assert len(result.read_text().splitlines()) > 100
