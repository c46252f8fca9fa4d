"""Times the coupling of both FMUs in FMPy: joint rates and grasp only, nothing recorded.

python couple.py CONTROLLER.fmu PLANT.fmu RUNS

prints for each discretization in turns its name and how many times faster than real time it was.
"""

import sys
import time
from shutil import rmtree

from fmpy import extract, read_model_description
from fmpy.simulation import instantiate_fmu

STEP, STEPS = 1e-3, 30_000


def main(files: list[str], runs: int) -> None:
    folders = [extract(file) for file in files]
    models = [read_model_description(folder) for folder in folders]
    controller, plant = units = [instantiate_fmu(f, m) for f, m in zip(folders, models)]
    ours, theirs = ({v.name: v for v in model.modelVariables} for model in models)
    shared = [name for name in theirs if name in ours and ours[name].causality == "output"]
    rates = [name for name in shared if name.endswith(".rate_command")]
    source, target = [[table[name].valueReference for name in rates] for table in (ours, theirs)]
    grasp, taken = [[table["grasp"].valueReference] for table in (ours, theirs)]
    choice = ours["ik.discretization"]
    for _ in range(runs):
        for number, item in enumerate(choice.declaredType.items, start=1):
            controller.setInteger([choice.valueReference], [number])
            for unit in units:
                unit.setupExperiment(startTime=0.0)
                unit.enterInitializationMode()
                unit.exitInitializationMode()
            begin = time.perf_counter()
            for n in range(STEPS):
                plant.setReal(target, controller.getReal(source))
                plant.setBoolean(taken, controller.getBoolean(grasp))
                plant.doStep(currentCommunicationPoint=n * STEP, communicationStepSize=STEP)
                controller.doStep(currentCommunicationPoint=n * STEP, communicationStepSize=STEP)
            print(item.name, STEPS * STEP / (time.perf_counter() - begin), flush=True)
            for unit in units:
                unit.terminate()
                unit.reset()
    for unit, folder in zip(units, folders):
        unit.freeInstance()
        rmtree(folder)


if __name__ == "__main__":
    main(sys.argv[1:3], int(sys.argv[3]))
