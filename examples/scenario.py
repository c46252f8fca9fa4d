"""Runs a scenario file on both FMUs with FMPy.

cargo run --release -- export 4.3c-minimum-norm     writes out/4.3c-minimum-norm.toml
python examples/scenario.py out/4.3c-minimum-norm.toml [FOLDER]

The folder holds the FMUs of the scenario's structure; default: out.
"""

import sys
import tomllib
from pathlib import Path

import numpy as np

from couple import couple


def names(table: dict, before: str = "") -> dict[str, float | str]:
    """The values of nested tables under their whole names: autopilot.roll.kd."""
    flat = {}
    for key, value in table.items():
        flat |= (
            names(value, f"{before}{key}.") if isinstance(value, dict) else {before + key: value}
        )
    return flat


def run(path: Path, folder: Path, **settings: float) -> dict:
    """Couple the FMUs in the folder on the scenario; settings may be another step or stop."""
    scenario = tomllib.loads(path.read_text())
    schedule = {"step": scenario["step"], "stop": scenario["duration"]} | settings
    return couple(folder, **schedule, **names(scenario["parameters"]))


if __name__ == "__main__":
    scenario, folder = Path(sys.argv[1]), Path(sys.argv[2] if len(sys.argv) > 2 else "out")
    seen = run(scenario, folder)
    off = np.hypot(*(seen[f"end_effector.{axis}"] - seen[f"reference.{axis}"] for axis in "xy"))
    lost = seen["time"][off > 0.01]
    right, down = 1e3 * max(seen["base.x"]), -1e3 * min(seen["base.y"])
    print(f"UAV up to {right:.1f} mm to the right, {down:.1f} mm down;")
    print(f"1 cm off at {lost[0]:.1f} s" if len(lost) else f"arm {max(off):.0e} m off")
