"""FMPy as a host: validation, each unit alone, both coupled, and FMPy's own command line."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

import couple
import scenario as scenario_file
from conftest import ALL, ROOT, Pair, Structure, build, program, read_table, simulate

SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"
# The thesis' joint angles at the start of the pick-up [rad].
START = -np.pi / 6, 2 * np.pi / 3, -2 * np.pi / 3


@pytest.mark.parametrize("structure", ALL, ids=str)
def test_validation_finds_no_problem(structure: Structure) -> None:
    for fmu in (build(structure).controller, build(structure).plant):
        assert validate_fmu(str(fmu)) == []


def test_controller_alone(pair: Pair) -> None:
    """30 s at 1 ms: what it predicts follows the reference."""
    result = simulate_fmu(str(pair.controller), output_interval=1e-3)
    assert len(result) == 30001
    assert result["time"][-1] == pytest.approx(30.0, abs=1e-9)
    for axis in "xy":
        off = result[f"predicted.end_effector.{axis}"] - result[f"reference.{axis}"]
        assert np.max(np.abs(off)) < 1e-9
    # There and back: 8 cm to the right and 12 cm down between 1.5 s and 2 s.
    way = [result[f"reference.{axis}"] - result[f"reference.{axis}"][0] for axis in "xy"]
    assert [float(w[1750]) for w in way] == pytest.approx([0.08, -0.12], abs=1e-12)
    assert [float(w[-1]) for w in way] == pytest.approx([0.0, 0.0], abs=1e-12)
    assert not result["grasp"][1500] and result["grasp"][1700]


def test_controller_alone_by_default(pair: Pair) -> None:
    """FMPy takes the stop time of the default experiment, and steps of 32 ms."""
    result = simulate_fmu(str(pair.controller))
    assert result["time"][-1] == pytest.approx(30.0, abs=1e-9)
    off = [result[f"predicted.end_effector.{a}"] - result[f"reference.{a}"] for a in "xy"]
    assert np.max(np.abs(off)) < 1e-5


def test_plant_alone_without_inputs(pair: Pair) -> None:
    """The arm's centre of mass is below the UAV's, thrust carries all weight: nothing moves."""
    result = simulate_fmu(str(pair.plant), stop_time=5.0, output_interval=0.01)
    for name in ("base.x", "base.y", "base.roll", "end_effector.vx", "end_effector.vy"):
        assert np.max(np.abs(result[name])) < 1e-9, name
    assert result["autopilot.thrust"][-1] == pytest.approx((4.2 + 3.0) * 9.81, abs=1e-9)
    assert result["timestamp"] == pytest.approx(result["time"], abs=1e-12)


def test_plant_alone_with_inputs(pair: Pair) -> None:
    """Imposed rates: q = q0 + integral of the rate. Two rates jump, another is held throughout."""
    rates = [(0.4, -0.3, 0.1), (-0.2, 0.5, 0.1)]
    names = [f"joint[{n}].rate_command" for n in (1, 2, 3)]
    kind = [("time", float), *((name, float) for name in names)]
    times = [0.0, 1.0, 1.0, 2.0]
    rows = [(time, *rates[k // 2]) for k, time in enumerate(times)]
    signals = np.array(rows, dtype=kind)
    result = simulate_fmu(str(pair.plant), stop_time=2.0, output_interval=0.01, input=signals)
    for n, (start, first, second) in enumerate(zip(START, *rates), start=1):
        assert result[f"joint[{n}].position"][-1] == pytest.approx(start + first + second, abs=1e-9)
        assert result[f"joint[{n}].rate"][-1] == pytest.approx(second, abs=1e-15)
    assert np.max(np.abs(result["base.roll"])) > 1e-3


@pytest.mark.parametrize("step", [1e-3, 1e-2])
@pytest.mark.parametrize(("scenario", "resolution"), [("4.3a", 1), ("pick-up", 3)])
def test_coupled_as_in_the_native_program(
    pair: Pair, tmp_path: Path, scenario: str, resolution: int, step: float
) -> None:
    """The example gives the numbers of the project's own master, to rounding, over 30 s."""
    ours = couple.couple(pair.plant.parent, step, **{"ik.resolution": resolution})
    native = simulate(scenario, tmp_path, step=step)
    assert set(ours) <= set(native)
    for name, values in ours.items():
        np.testing.assert_allclose(values, native[name], rtol=0, atol=1e-12, err_msg=name)
    assert np.max(np.abs(native["base.y"])) > 0.09


@pytest.mark.parametrize(
    ("name", "structure"), [("4.3c-minimum-norm", Structure(3)), ("2.2b", Structure(2))], ids=str
)
def test_exported_scenarios_as_in_the_native_program(
    tmp_path: Path, name: str, structure: Structure
) -> None:
    """What `export` writes is what `simulate` runs, also without the program's own reader."""
    step, stop = 0.01, 6.0
    program("export", name, "--out", str(tmp_path))
    ours = scenario_file.run(
        tmp_path / f"{name}.toml", build(structure).plant.parent, step=step, stop=stop
    )
    native = simulate(name, tmp_path, step=step, stop=stop)
    for quantity, values in ours.items():
        np.testing.assert_allclose(values, native[quantity], rtol=0, atol=1e-12, err_msg=quantity)
    # The other way of writing the same: a parameter set by the SSP standard.
    numbers = scenario_file.names(
        tomllib.loads((tmp_path / f"{name}.toml").read_text())["parameters"]
    )
    for unit in ("controller", "plant"):
        variables = {
            v.name: v
            for v in read_model_description(getattr(build(structure), unit)).modelVariables
        }
        root = ElementTree.parse(tmp_path / f"{name}.{unit}.ssv").getroot()
        values = {p.get("name"): p[0].get("value") for p in root.iter(f"{SSV}Parameter")}
        assert values.keys() == numbers.keys() & variables.keys()
        for parameter, value in values.items():
            expected = numbers[parameter]
            if isinstance(expected, str):
                items = variables[parameter].declaredType.items
                expected = {item.name: int(item.value) for item in items}[expected]
            assert float(value) == expected, parameter


def test_example_as_printed_in_the_readme(pair: Pair) -> None:
    picture = pair.plant.parent / "couple.png"
    picture.unlink(missing_ok=True)
    run = subprocess.run(
        [sys.executable, ROOT / "examples" / "couple.py", pair.plant.parent],
        capture_output=True,
        text=True,
        check=True,
    )
    assert "minimum norm: UAV up to 109.8 mm to the right" in run.stdout, run.stdout
    assert "extended Jacobian: UAV up to 5.5 mm to the right" in run.stdout, run.stdout
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_start_values_by_number_as_printed_in_the_readme(pair: Pair, tmp_path: Path) -> None:
    """Minimum norm by Euler's step: the line of the README gives what the names give."""
    readme = (ROOT / "README.md").read_text()
    (line,) = (
        line for line in readme.splitlines() if "fmpy simulate" in line and "start-v" in line
    )
    place = {"out/uam_controller.fmu": pair.controller, "out/euler.csv": tmp_path / "euler.csv"}
    words = [str(place.get(word, word)) for word in line.split()]
    subprocess.run([sys.executable, "-m", *words], check=True, capture_output=True)
    by_number = read_table(tmp_path / "euler.csv")
    start = {"ik.resolution": "minimum_norm", "ik.discretization": "euler"}
    types = {v.name: v.declaredType for v in read_model_description(pair.controller).modelVariables}
    numbers = {
        name: [i.name for i in types[name].items].index(item) + 1 for name, item in start.items()
    }
    by_name = simulate_fmu(str(pair.controller), start_values=numbers)
    other = simulate_fmu(str(pair.controller))
    for joint in (1, 2, 3):
        name = f"joint[{joint}].rate_command"
        np.testing.assert_allclose(by_number[name], by_name[name], rtol=0, atol=1e-12)
        assert np.max(np.abs(by_number[name] - other[name])) > 1e-2


@pytest.mark.parametrize("unit", ["controller", "plant"])
def test_command_line_of_fmpy(pair: Pair, tmp_path: Path, unit: str) -> None:
    fmpy = [sys.executable, "-m", "fmpy"]
    fmu = shutil.copy(getattr(pair, unit), tmp_path)
    validated = subprocess.run([*fmpy, "validate", fmu], capture_output=True, text=True)
    assert validated.returncode == 0, validated.stdout + validated.stderr
    result = tmp_path / "result.csv"
    options = ["--stop-time", "1", "--output-interval", "0.01", "--output-file", result]
    simulated = subprocess.run([*fmpy, "simulate", fmu, *options], capture_output=True, text=True)
    assert simulated.returncode == 0, simulated.stdout + simulated.stderr
    table = read_table(result)
    assert len(table["time"]) == 101
    outputs = {
        v.name for v in read_model_description(fmu).modelVariables if v.causality == "output"
    }
    assert set(table) == {"time", *outputs}
