"""libcosim (Open Simulation Platform), through its Python package: its fixed-step algorithm."""

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from coupling import GRASP, RATES, RECORDED, Coupling, Rows, serve


def couple(coupling: Coupling) -> Rows:
    execution = CosimExecution.from_step_size(step_size=nanoseconds(coupling))
    controller, plant = (
        execution.add_local_slave(CosimLocalSlave(fmu_path=str(path), instance_name=path.stem))
        for path in (coupling.controller, coupling.plant)
    )
    ours, theirs = references(execution, controller), references(execution, plant)
    for name in RATES:
        execution.connect_real_variables(controller, ours[name], plant, theirs[name])
    execution.connect_boolean_variables(controller, ours[GRASP], plant, theirs[GRASP])
    yield from run(coupling, execution, plant)


def run(coupling: Coupling, execution: CosimExecution, plant: int) -> Rows:
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    theirs = references(execution, plant)
    recorded = [theirs[name] for name in RECORDED]
    for n in range(1, coupling.steps + 1):
        assert execution.step()
        yield n * coupling.step, *observer.last_real_values(plant, recorded)


def nanoseconds(coupling: Coupling) -> int:
    return round(coupling.step * 1e9)


def references(execution: CosimExecution, unit: int) -> dict[str, int]:
    return {str(v.name, "utf-8"): v.reference for v in execution.slave_variables(unit)}


if __name__ == "__main__":
    serve(couple)
