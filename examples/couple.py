"""Couples both FMUs with FMPy: the payload pick-up of thesis 4.3, with two ways to move the arm.

python examples/couple.py [FOLDER]    the folder holds the FMUs; default: out
"""

import sys
from ctypes import Array
from functools import partial
from pathlib import Path
from shutil import rmtree

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2Real, fmi2ValueReference
from fmpy.simulation import instantiate_fmu

try:
    from matplotlib import pyplot
except ImportError:  # without it there are numbers, but no picture
    pyplot = None

RECORDED = ["base.x", "base.y", "base.roll", "end_effector.x", "end_effector.y"]


class Values:
    """Some variables of a unit, with an array for their values that is made once.

    FMPy's getReal and setReal take and give lists, for which they make two arrays in every call:
    that takes longer than a step of a unit. Outputs of one unit and inputs of another may share
    an array; then nothing is copied.
    """

    def __init__(self, unit: FMU2Slave, references: list[int], array: Array | None = None) -> None:
        count = len(references)
        self.array = (fmi2Real * count)() if array is None else array
        arguments = unit.component, (fmi2ValueReference * count)(*references), count, self.array
        self._get = partial(unit.fmi2GetReal, *arguments)
        self.set = partial(unit.fmi2SetReal, *arguments)

    def get(self) -> Array:
        self._get()
        return self.array


def couple(folder: Path, step: float = 1e-3, stop: float = 30.0, **parameters: float | str) -> dict:
    """Every communication point; each parameter is set in the units that have it."""
    folders = [extract(folder / f"{name}.fmu") for name in ("uam_controller", "uam_plant")]
    models = [read_model_description(folder) for folder in folders]
    controller, plant = units = [instantiate_fmu(f, m) for f, m in zip(folders, models)]
    ours, theirs = ({v.name: v for v in model.modelVariables} for model in models)

    # Every type of variable may be set and got as a number, so setReal and getReal do for all.
    for name, value in parameters.items():
        having = [(unit, v[name]) for unit, v in zip(units, (ours, theirs)) if name in v]
        if not having:
            raise KeyError(f"neither unit has a parameter {name}")
        for unit, variable in having:
            if isinstance(
                value, str
            ):  # the name of an item of an enumeration stands for its number
                value = {item.name: int(item.value) for item in variable.declaredType.items}[value]
            unit.setReal([variable.valueReference], [float(value)])
    for unit in units:
        unit.setupExperiment(startTime=0.0)
        unit.enterInitializationMode()
        unit.exitInitializationMode()

    # Outputs of the controller that the plant has, too, are its inputs: the rates and `grasp`.
    shared = [name for name in ours if name in theirs and ours[name].causality == "output"]
    source, target = ([names[name].valueReference for name in shared] for names in (ours, theirs))
    outputs = Values(controller, source)
    inputs = Values(plant, target, outputs.array)
    seen = Values(plant, [theirs[name].valueReference for name in RECORDED])
    wanted = Values(controller, [ours[f"reference.{axis}"].valueReference for axis in "xy"])
    rows = [[0.0, *seen.get(), *wanted.get()]]
    for n in range(round(stop / step)):
        outputs.get()
        inputs.set()
        for unit in units:
            unit.doStep(currentCommunicationPoint=n * step, communicationStepSize=step)
        rows.append([(n + 1) * step, *seen.get(), *wanted.get()])
    for unit, unpacked in zip(units, folders):
        unit.terminate()
        unit.freeInstance()
        rmtree(unpacked)
    return dict(zip(["time", *RECORDED, "reference.x", "reference.y"], np.array(rows).T))


if __name__ == "__main__":
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "out")
    for resolution, name in {1: "minimum norm", 3: "extended Jacobian"}.items():
        run = couple(folder, **{"ik.resolution": resolution})
        x, y, roll = 1e3 * run["base.x"], 1e3 * run["base.y"], np.degrees(run["base.roll"])
        off = np.hypot(*(run[f"end_effector.{axis}"] - run[f"reference.{axis}"] for axis in "xy"))
        print(f"{name}: UAV up to {max(x):.1f} mm to the right, at the end {x[-1]:.1f} mm,")
        print(f"    {-min(y):.1f} mm down, roll {max(abs(roll)):.3f} deg; arm {max(off):.0e} m off")
        if pyplot:
            pyplot.plot(run["time"], x, label=f"{name}: x [mm]")
            pyplot.plot(run["time"], y, label=f"{name}: y [mm]")
            pyplot.legend()
            pyplot.savefig(folder / "couple.png")
