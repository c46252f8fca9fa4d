"""fmuloader, a plain binding of the C functions: a parallel master in a few lines."""

import xml.etree.ElementTree as ElementTree
from zipfile import ZipFile

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

from coupling import GRASP, RATES, RECORDED, Coupling, Rows, serve


def couple(coupling: Coupling) -> Rows:
    units, references = [], []
    for path in (coupling.controller, coupling.plant):
        description = ElementTree.fromstring(ZipFile(path).read("modelDescription.xml"))
        variables = description.iter("ScalarVariable")
        references.append({v.get("name"): int(v.get("valueReference")) for v in variables})
        unit = Fmi2Slave(path, model_identifier=path.stem)
        unit.instantiate(path.stem, Fmi2Type.CO_SIMULATION, guid=description.get("guid"))
        unit.setup_experiment(0.0)
        unit.enter_initialization_mode()
        unit.exit_initialization_mode()
        units.append(unit)

    (controller, plant), (ours, theirs) = units, references
    source, target = ([names[name] for name in RATES] for names in (ours, theirs))
    recorded = [theirs[name] for name in RECORDED]
    yield 0.0, *plant.get_real(recorded)
    for n in range(coupling.steps):
        plant.set_real(target, controller.get_real(source))
        plant.set_boolean([theirs[GRASP]], controller.get_boolean([ours[GRASP]]))
        for unit in units:
            unit.do_step(n * coupling.step, coupling.step)
        yield (n + 1) * coupling.step, *plant.get_real(recorded)
    for unit in units:
        unit.terminate()
        unit.free_instance()


if __name__ == "__main__":
    serve(couple)
