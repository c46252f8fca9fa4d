"""Every flag of the model description's element CoSimulation, proven by what the unit does."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Iterator
from ctypes import byref, c_double, c_int
from xml.etree import ElementTree

import numpy as np
import pytest
from fmpy.fmi2 import fmi2DoStepStatus, fmi2LastSuccessfulTime, fmi2OK

from conftest import DEFAULT, build
from unit import Instance, Unit

UNITS = ("controller", "plant")
STEP = 1e-3

# Outputs by what a master may expect of them.
END_EFFECTOR = re.compile(r"(predicted\.)?end_effector\.[xy]")
CONTINUOUS = re.compile(
    r"(predicted\.)?(base|end_effector|joint\[\d\])\.(x|y|roll|position)|reference\.(x|y|vx|vy)"
    r"|(base|end_effector)\.(vx|vy|roll_rate)|joint\[\d\]\.rate|(momentum|center_of_mass)\.\w+"
    r"|autopilot\.(thrust|torque)|support\.force|timestamp"
)
# Velocities that jump where a plan ends.
JUMPING = re.compile(r"predicted\.base\.(vx|vy|roll_rate)")


def flags(name: str) -> dict[str, str]:
    """The flags of a unit as they are written."""
    with zipfile.ZipFile(getattr(build(DEFAULT), name)) as fmu:
        root = ElementTree.fromstring(fmu.read("modelDescription.xml"))
    element = root.find("CoSimulation")
    assert element is not None
    return {key: value for key, value in element.items() if key != "modelIdentifier"}


@pytest.fixture(params=UNITS)
def unit(request: pytest.FixtureRequest) -> Iterator[Unit]:
    with Unit(getattr(build(DEFAULT), request.param)) as unit:
        yield unit


def started(unit: Unit) -> Instance:
    """At its first communication point: the path begins at once, the plant has rates."""
    instance = unit.instantiate()
    begin = {"reference.leg[1].start": 0.0, "reference.leg[1].ramp": 0.1, "ik.resolution": 1}
    instance.initialize(parameters=begin if "reference.x" in unit.variables else {})
    if "joint[1].rate_command" in unit.names("input"):
        instance.set({"joint[1].rate_command": 0.5, "joint[2].rate_command": -0.3})
    return instance


def outputs(instance: Instance) -> list[float]:
    return instance.all(instance.unit.names("output"))


def variable_steps(unit: Unit) -> bool:
    """Steps of any length, in any order, lead to the same place."""
    odd = [0.0099999999999984546, 1e-13, 0.0100000000000014454]
    sizes = [1e-3] * 60, [0.02] * 3, odd * 3
    instances = [started(unit) for _ in sizes]
    for instance, steps in zip(instances, sizes):
        time = 0.0
        for size in steps:
            instance.step(time, size)
            time += size
            assert instance.get("time") == time
    ends = [
        [instance.get(name) for name in unit.names("output") if END_EFFECTOR.fullmatch(name)]
        for instance in instances
    ]
    return bool(ends[0]) and np.allclose(ends, ends[0], rtol=0, atol=1e-6)


def interpolation(unit: Unit) -> bool:
    """A derivative of an input is a ramp within the step, and holds for that step only."""
    instance = started(unit)
    if "joint[1].rate_command" not in unit.names("input"):
        for name in unit.names("input"):
            instance.refuses(lambda name=name: instance.set_slopes({name: 1.0}))
        return False
    before = instance.get("joint[1].position")
    instance.set_slopes({"joint[1].rate_command": 4.0})
    instance.step(0.0, 0.1)
    assert instance.get("joint[1].position") - before == pytest.approx(0.07, abs=1e-14)
    instance.step(0.1, 0.1)
    assert instance.get("joint[1].position") - before == pytest.approx(0.12, abs=1e-14)
    return True


def output_derivatives(unit: Unit) -> int:
    """Left derivatives: what a backward difference of second order gives. Means over the step,
    accelerations and commands are extrapolated as if they were held: 0."""
    instance = started(unit)
    names = [name for name in unit.names("output") if unit.variables[name].type == "Real"]
    rows, size = [], 1e-3
    for n in range(40):
        instance.step(n * size, size)
        rows.append(instance.all(names))
    last = np.array(rows[-3:])
    difference = (3 * last[2] - 4 * last[1] + last[0]) / (2 * size)
    moving = 0
    for name, expected, slope in zip(names, difference, instance.slopes(names)):
        if CONTINUOUS.fullmatch(name):
            # After 40 accelerated steps, the controller's rates jump by a fortieth at each of them.
            assert slope == pytest.approx(expected, rel=0.05, abs=1e-4), name
            moving += abs(expected) > 1e-3
        elif not JUMPING.fullmatch(name):
            assert slope == 0.0, name
    instance.refuses(lambda: instance.slopes(names[:1], 2))
    return 1 if moving > 3 else 0


def asynchronous(unit: Unit) -> bool:
    """A step is done when the call comes back; there is nothing to cancel."""
    instance = started(unit)
    instance.step(0.0, STEP)
    slave, status, time = instance.slave, c_int(-1), c_double()
    slave.fmi2GetStatus(slave.component, fmi2DoStepStatus, byref(status))
    slave.fmi2GetRealStatus(slave.component, fmi2LastSuccessfulTime, byref(time))
    assert (status.value, time.value) == (fmi2OK, STEP)
    assert "fmi2CancelStep" in instance.refuses(lambda: slave.fmi2CancelStep(slave.component))
    return False


def only_once(unit: Unit) -> bool:
    """Two instances, step by step, and one alone give the same."""
    alone, *pair = started(unit), started(unit), started(unit)
    for n in range(10):
        for instance in pair:
            instance.step(n * STEP, STEP)
    for n in range(10):
        alone.step(n * STEP, STEP)
    return not all(outputs(instance) == outputs(alone) for instance in pair)


def own_memory(unit: Unit) -> bool:
    """The host's functions for memory are never called."""
    instance = started(unit)
    instance.step(0.0, STEP)
    instance.slave.getFMUstate()
    instance.slave.terminate()
    instance.slave.reset()
    return instance.allocations == 0


def states(unit: Unit) -> bool:
    """Back, and the same way again."""
    instance = started(unit)
    state = instance.slave.getFMUstate()
    instance.step(0.0, STEP)
    first = outputs(instance)
    instance.slave.setFMUstate(state)
    instance.step(0.0, STEP)
    return outputs(instance) == first


def serialization(unit: Unit) -> bool:
    """The same through bytes, in an instance that has seen nothing."""
    instance, other = started(unit), unit.instantiate()
    content = instance.slave.serializeFMUstate(instance.slave.getFMUstate())
    other.slave.setFMUstate(other.slave.deSerializeFMUstate(content))
    for each in (instance, other):
        each.step(0.0, STEP)
    return outputs(instance) == outputs(other)


def directional_derivatives(unit: Unit) -> bool:
    """Not there, and the message names the flag."""
    instance = started(unit)
    slave = instance.slave
    names = unit.names("output")[0], unit.names("input")[0]
    known, unknown = ([unit.variables[name].valueReference] for name in names)
    said = instance.refuses(lambda: slave.getDirectionalDerivative(unknown, known, [1.0]))
    assert "providesDirectionalDerivative" in said
    return False


# What each flag promises.
PROOFS: dict[str, Callable[[Unit], bool | int]] = {
    # It runs in every test here, where no tool is.
    "needsExecutionTool": lambda unit: not outputs(started(unit)),
    "canHandleVariableCommunicationStepSize": variable_steps,
    "canInterpolateInputs": interpolation,
    "maxOutputDerivativeOrder": output_derivatives,
    "canRunAsynchronuously": asynchronous,
    "canBeInstantiatedOnlyOncePerProcess": only_once,
    "canNotUseMemoryManagementFunctions": own_memory,
    "canGetAndSetFMUstate": states,
    "canSerializeFMUstate": serialization,
    "providesDirectionalDerivative": directional_derivatives,
}


@pytest.mark.parametrize("name", UNITS)
def test_every_flag_is_there_and_has_a_proof(name: str) -> None:
    assert set(flags(name)) == set(PROOFS)


@pytest.mark.parametrize("flag", PROOFS)
def test_a_flag_says_what_the_unit_does(unit: Unit, flag: str) -> None:
    found = PROOFS[flag](unit)
    written = flags(unit.description.modelName.removeprefix("uam_"))[flag]
    assert written == (str(found).lower() if isinstance(found, bool) else str(found))


def test_every_log_category_is_used_and_no_other(unit: Unit) -> None:
    """Declared are those of the messages, and one that stands for all."""
    nameless = unit.instantiate("", logging=True)
    nameless.initialize()
    nameless.refuses(lambda: nameless.step(5.0, STEP))
    nameless.slave.terminate()
    nameless.slave.reset()
    used = {category for category, _, _ in nameless.said}
    assert used | {"logAll"} == {category.name for category in unit.description.logCategories or []}
    status = {"logEvents": 0, "logStatusWarning": 1, "logStatusError": 3}
    assert all(status[category] == found for category, found, _ in nameless.said)

    quiet = unit.instantiate("quiet", logging=True)
    quiet.slave.setDebugLogging(False, ["logEvents"])
    quiet.initialize()
    assert quiet.said == []
    quiet.slave.setDebugLogging(True, ["logAll"])
    quiet.slave.terminate()
    assert [category for category, _, _ in quiet.said] == ["logEvents"]


def test_reset_equals_new(unit: Unit) -> None:
    """Whatever was set and done before, bit by bit, all variables."""
    used, new = unit.instantiate(), unit.instantiate()
    changed = {
        v.name: float(v.start) * 1.01
        for v in unit.description.modelVariables
        if v.type == "Real" and v.causality == "parameter" and v.name.startswith(("uav", "link"))
    }
    used.initialize(3.0, changed)
    for n in range(5):
        used.step(3.0 + n * STEP, STEP)
    used.slave.reset()
    names = [v.name for v in unit.description.modelVariables]
    assert used.all(names) == new.all(names)
    for instance in (used, new):
        instance.initialize()
        for n in range(5):
            instance.step(n * STEP, STEP)
    assert used.all(names) == new.all(names)
