"""Runs a scenario file on both FMUs with FMPy.

uam export 4.3c-minimum-norm                         writes out/4.3c-minimum-norm.toml
python examples/scenario.py out/4.3c-minimum-norm.toml [FOLDER]

The folder holds the FMUs of the scenario's structure; default: out.
"""

import struct
import sys
import tomllib
import zipfile
from pathlib import Path

import numpy as np
from fmpy import read_model_description

from couple import couple


def names(table: dict, before: str = "") -> dict[str, float | str]:
    """The values of nested tables under their whole names: autopilot.roll.kd."""
    flat = {}
    for key, value in table.items():
        flat |= (
            names(value, f"{before}{key}.") if isinstance(value, dict) else {before + key: value}
        )
    return flat


class UnsuitableError(Exception):
    """The FMUs would run something else than the scenario."""


def rows(scenario: dict) -> list[list[int]]:
    """The path of a scenario, each row the bits of its numbers as whole numbers."""
    try:
        return [
            [int.from_bytes(struct.pack(">d", number)) for number in row]
            for row in scenario.get("path", [])
        ]
    except struct.error:
        raise UnsuitableError("the path must be rows of numbers, as `show` writes them") from None


def check(scenario: dict, folder: Path) -> None:
    """Whether the FMUs in the folder are those of the scenario's structure, and all else is set."""
    structure, parameters = scenario["structure"], names(scenario.get("parameters", {}))
    wanted = {f"link[{n}].mass" for n in range(1, structure["links"] + 1)}
    if structure["balance"] != "none":
        wanted.add(f"{structure['balance']}.mass")
    for fmu in (folder / "uam_controller.fmu", folder / "uam_plant.fmu"):
        found = {variable.name for variable in read_model_description(fmu).modelVariables}
        bodies = ("link[", "counterweight.", "balance_element.")
        masses = {name for name in found if name.startswith(bodies) and name.endswith(".mass")}
        if masses != wanted:
            raise UnsuitableError(
                f"{fmu} is of another structure: the scenario has {', '.join(sorted(wanted))},"
                f" the FMU has {', '.join(sorted(masses)) or 'none of them'}"
            )
        # A scenario holds what differs from the start values of the library; FMUs may have others.
        with zipfile.ZipFile(fmu) as archive:
            own = "resources/start.toml"
            starts = tomllib.loads(archive.read(own).decode()) if own in archive.namelist() else {}
        # A path is a table inside the controller, each row the bits of its numbers.
        path = [row for name, row in starts.items() if name.startswith("path[")]
        if "uam_controller" in fmu.name and path != rows(scenario):
            raise UnsuitableError(
                f"{fmu} has not the path of the scenario: `build --scenario` packs it into FMUs"
            )
        left = {name for name in starts if not name.startswith("path[")}
        left -= {"structure", "naming", *parameters}
        if left:
            raise UnsuitableError(
                f"{fmu} has start values of its own that the scenario does not set:"
                f" {', '.join(sorted(left))}; build FMUs without --scenario"
            )


def run(path: Path, folder: Path, **settings: float) -> dict:
    """Couple the FMUs in the folder on the scenario; settings may be another step or stop."""
    scenario = tomllib.loads(path.read_text(encoding="utf-8"))
    missing = {"step", "duration", "structure"} - scenario.keys()
    if missing:
        raise UnsuitableError(
            f"{path} lacks {', '.join(sorted(missing))}: `export` writes whole files"
        )
    check(scenario, folder)
    schedule = {"step": scenario["step"], "stop": scenario["duration"]} | settings
    return couple(folder, **schedule, **names(scenario.get("parameters", {})))


if __name__ == "__main__":
    scenario, folder = Path(sys.argv[1]), Path(sys.argv[2] if len(sys.argv) > 2 else "out")
    try:
        seen = run(scenario, folder)
    except (UnsuitableError, OSError) as refusal:
        sys.exit(f"error: {refusal}")
    off = np.hypot(*(seen[f"end_effector.{axis}"] - seen[f"reference.{axis}"] for axis in "xy"))
    lost = seen["time"][off > 0.01]
    right, down = 1e3 * max(seen["base.x"]), -1e3 * min(seen["base.y"])
    print(f"UAV up to {right:.1f} mm to the right, {down:.1f} mm down;")
    print(f"1 cm off at {lost[0]:.1f} s" if len(lost) else f"arm {max(off):.0e} m off")
