"""Times masters in FMPy that couple both FMUs: joint rates and grasp only, nothing recorded.

python masters.py CONTROLLER.fmu PLANT.fmu RUNS

prints for each discretization and each master, in turns, how many times faster than real time
it was, and both names. All masters must come to the same end, bit by bit.
"""

import sys
import time
from collections.abc import Callable
from ctypes import byref, c_double, c_int, c_size_t, c_void_p
from functools import partial
from pathlib import Path
from shutil import rmtree

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2OK, fmi2True, fmi2ValueReference
from fmpy.simulation import instantiate_fmu

sys.path.append(str(Path(__file__).parents[3] / "examples"))
from couple import Values  # noqa: E402

STEP, STEPS = 1e-3, 30_000

# Each makes from the controller, the plant, and the value references of rates and grasp in both,
# a function that runs all steps.
Master = Callable[[FMU2Slave, FMU2Slave, list[int], list[int]], Callable[[], None]]


def lists(controller: FMU2Slave, plant: FMU2Slave, source: list[int], target: list[int]):
    """Numbers as Python's lists, the Boolean by functions of its own."""
    *rates, grasp = source
    *commands, taken = target

    def run() -> None:
        for n in range(STEPS):
            plant.setReal(commands, controller.getReal(rates))
            plant.setBoolean([taken], controller.getBoolean([grasp]))
            plant.doStep(currentCommunicationPoint=n * STEP, communicationStepSize=STEP)
            controller.doStep(currentCommunicationPoint=n * STEP, communicationStepSize=STEP)

    return run


def kept_arrays(controller: FMU2Slave, plant: FMU2Slave, source: list[int], target: list[int]):
    """As in examples/couple.py: all values as numbers, in one array that is made once."""
    outputs = Values(controller, source)
    inputs = Values(plant, target, outputs.array)

    def run() -> None:
        for n in range(STEPS):
            outputs.get()
            inputs.set()
            plant.doStep(n * STEP, STEP)
            controller.doStep(n * STEP, STEP)

    return run


def bound_functions(controller: FMU2Slave, plant: FMU2Slave, source: list[int], target: list[int]):
    """The C functions of the libraries that FMPy has loaded, every argument made once."""
    values = (c_double * len(source))()
    now, step = c_double(), c_double(STEP)

    def bound(unit: FMU2Slave, name: str, *arguments):
        return partial(unit.dll[name], c_void_p(unit.component), *arguments)

    def exchange(unit: FMU2Slave, name: str, references: list[int]):
        count = len(references)
        return bound(
            unit, name, (fmi2ValueReference * count)(*references), c_size_t(count), byref(values)
        )

    get = exchange(controller, "fmi2GetReal", source)
    put = exchange(plant, "fmi2SetReal", target)
    plan, move = (
        bound(unit, "fmi2DoStep", now, step, c_int(fmi2True)) for unit in (controller, plant)
    )

    def run() -> None:
        for n in range(STEPS):
            now.value = n * STEP
            if get() or put() or move() or plan():
                raise RuntimeError(f"a call at {now.value} s did not return {fmi2OK}")

    return run


MASTERS: dict[str, Master] = {
    "getReal and setReal": lists,
    "arrays made once": kept_arrays,
    "C functions bound once": bound_functions,
}


def main(files: list[str], runs: int) -> None:
    folders = [extract(file) for file in files]
    models = [read_model_description(folder) for folder in folders]
    controller, plant = units = [instantiate_fmu(f, m) for f, m in zip(folders, models)]
    tables = ours, theirs = [{v.name: v for v in model.modelVariables} for model in models]
    shared = [name for name in theirs if name in ours and ours[name].causality == "output"]
    names = [name for name in shared if name.endswith(".rate_command")] + ["grasp"]
    source, target = [[table[name].valueReference for name in names] for table in tables]
    outputs = [
        [v.valueReference for v in model.modelVariables if v.causality == "output"]
        for model in models
    ]
    masters = {name: make(controller, plant, source, target) for name, make in MASTERS.items()}
    choice = ours["ik.discretization"]
    ends = {}
    for _ in range(runs):
        for item in choice.declaredType.items:
            for name, run in masters.items():
                controller.setInteger([choice.valueReference], [int(item.value)])
                for unit in units:
                    unit.setupExperiment(startTime=0.0)
                    unit.enterInitializationMode()
                    unit.exitInitializationMode()
                begin = time.perf_counter()
                run()
                elapsed = time.perf_counter() - begin
                print(STEPS * STEP / elapsed, f"{name}, {item.name}", flush=True)
                end = [unit.getReal(seen) for unit, seen in zip(units, outputs)]
                assert ends.setdefault(item.name, end) == end, f"{name} ends elsewhere"
                for unit in units:
                    unit.terminate()
                    unit.reset()
    for unit, folder in zip(units, folders):
        unit.freeInstance()
        rmtree(folder)


if __name__ == "__main__":
    main(sys.argv[1:3], int(sys.argv[3]))
