"""FMI 2.0, 2.1.8: a saved state goes on bit by bit, in any instance and in any process."""

from __future__ import annotations

import math
import pickle
import resource
import subprocess
import sys
from collections.abc import Callable
from ctypes import byref
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import pytest
from fmpy import read_model_description

from conftest import DEFAULT, Structure, build
from continuation import Call, Record, go_on
from unit import Instance, Unit, Values

STEP = 1e-3
# Steps before the state is saved, and after.
BEFORE, AFTER = 60, 60


@dataclass(frozen=True)
class Case:
    """A coupled run: parameters by names and items, and what holds when the state is saved."""

    name: str
    parameters: dict[str, float | str] = field(default_factory=dict)
    structure: Structure = DEFAULT
    holds: Callable[[Instance, Instance], bool] = lambda controller, plant: True
    # Torques of joints that follow one [N m].
    torques: tuple[str, ...] = ()

    def __str__(self) -> str:
        return self.name


# At the start, the end effector pushes the payload 5 mm into its support.
GRASPED = {"payload.grasp_time": 0.02, "support.height": -0.220}
# Moves fast at once.
HURRY = {
    "reference.leg[1].start": 0.0,
    "reference.leg[1].duration": 0.2,
    "reference.leg[1].ramp": 0.05,
}
LIMITS = {
    "joint[1].rate_limit": 0.3,
    "joint[2].rate_limit": 0.3,
    "joint[1].acceleration_limit": 8.0,
}


# What initialization refuses.
CONTRADICTIONS = [("least_squares", "first_order"), ("acceleration_level", "zero_order")]


def in_contact(_: Instance, plant: Instance) -> bool:
    return plant.get("payload.attached") == 1.0 and plant.get("support.force") > 0.0


def limited(controller: Instance, _: Instance) -> bool:
    items = controller.unit.variables["ik.status"].declaredType.items
    status = next(item.name for item in items if int(item.value) == controller.get("ik.status"))
    return status in ("task_limited", "path_limited")


def methods() -> list[Case]:
    """Every resolution with every discretization and hold that it goes with."""
    model = read_model_description(str(build(DEFAULT).controller))
    items = {
        v.name: [item.name for item in v.declaredType.items]
        for v in model.modelVariables
        if v.name in ("ik.resolution", "ik.discretization", "ik.hold")
    }
    return [
        Case(
            f"{resolution}, {discretization}, {hold}",
            HURRY
            | GRASPED
            | {
                "ik.resolution": resolution,
                "ik.discretization": discretization,
                "ik.hold": hold,
            },
        )
        for resolution in items["ik.resolution"]
        for discretization in items["ik.discretization"]
        for hold in items["ik.hold"]
        if (resolution, hold) not in CONTRADICTIONS
    ]


CASES = [
    Case("payload in contact", HURRY | GRASPED, holds=in_contact),
    Case(
        "limits",
        HURRY | LIMITS | {"ik.resolution": "least_squares"},
        holds=limited,
    ),
    Case(
        "counterweight",
        HURRY | GRASPED | {"ik.resolution": "least_squares"},
        Structure(2, "counterweight"),
        lambda controller, _: controller.get("counterweight.rate_command") != 0.0,
    ),
    Case("balance element at rest", HURRY | GRASPED, Structure(3, "balance_element")),
    Case(
        "balance element",
        HURRY | GRASPED | {"ik.resolution": "acceleration_level", "ik.hold": "first_order"},
        Structure(3, "balance_element"),
        lambda controller, _: controller.get("balance_element.rate_command") != 0.0,
    ),
    Case(
        "a joint driven by a torque",
        HURRY | GRASPED | {"joint[3].actuation": "torque"},
        torques=("joint[3].torque_command",),
    ),
    Case(
        "all joints driven by torques",
        GRASPED | {f"joint[{n}].actuation": "torque" for n in (1, 2, 3)},
        torques=tuple(f"joint[{n}].torque_command" for n in (1, 2, 3)),
    ),
    Case("between samples of the autopilot", HURRY | GRASPED | {"autopilot.sample_time": 7e-3}),
    Case("between two plans", HURRY | GRASPED | {"sample_time": 7e-3, "ik.hold": "first_order"}),
    Case("ideal base", HURRY | GRASPED | {"autopilot.mode": "ideal"}),
    Case("autopilot outside", HURRY | {"autopilot.mode": "external"}),
    *methods(),
]


def known(unit: Unit, parameters: Values) -> Values:
    """Those that the unit has."""
    return {name: value for name, value in parameters.items() if name in unit.variables}


@dataclass(frozen=True)
class Run:
    """What a unit was told from the state on, what it answered, and the instance, gone on."""

    record: Record
    answers: list[list[str]]
    instance: Instance


def couple(case: Case, units: dict[str, Unit]) -> list[Run]:
    """Run both in parallel; save both states when everything for the next step is set."""
    controller, plant = instances = [unit.instantiate() for unit in units.values()]
    for instance in instances:
        instance.initialize(parameters=known(instance.unit, case.parameters))
    wires = sorted(set(units["controller"].names("output")) & set(units["plant"].names("input")))
    calls: list[list[Call]] = [[], []]
    answers: list[list[list[str]]] = [[], []]
    states = []
    for n in range(BEFORE + AFTER):
        values = {name: controller.get(name) for name in wires}
        values |= {name: 0.3 * math.sin(0.1 * n) for name in case.torques}
        values["base.external_force_x"] = 0.1 * math.sin(0.02 * n)
        slopes = {"base.external_force_x": 2.0}
        both = Call(n * STEP, STEP, {}, {}), Call(n * STEP, STEP, values, slopes)
        for call, instance in zip(both, instances):
            call.prepare(instance)
            if n == BEFORE:
                state = instance.slave.getFMUstate()
                states.append(instance.slave.serializeFMUstate(state))
                instance.slave.freeFMUstate(state)
        if n == BEFORE:
            assert case.holds(controller, plant), "the state is not what the case is about"
        for i, (call, instance) in enumerate(zip(both, instances)):
            answer = call.step(instance)
            if n >= BEFORE:
                calls[i].append(call)
                answers[i].append(answer)

    pair = build(case.structure)
    return [
        Run(Record(getattr(pair, name), state, calls), answers, instance)
        for name, state, calls, answers, instance in zip(units, states, calls, answers, instances)
    ]


@pytest.mark.parametrize("case", CASES, ids=str)
def test_a_state_goes_on_bit_by_bit(case: Case, tmp_path: Path) -> None:
    pair = build(case.structure)
    with Unit(pair.controller) as controller, Unit(pair.plant) as plant:
        for run in couple(case, {"controller": controller, "plant": plant}):
            record, expected = run.record, run.answers
            assert any(row != expected[0] for row in expected), "something happens"
            instances = {"back": run.instance, "in another": run.instance.unit.instantiate()}
            for where, instance in instances.items():
                state = instance.slave.deSerializeFMUstate(record.state)
                for _ in range(2):
                    instance.slave.setFMUstate(state)
                    assert go_on(instance, record.calls) == expected, where

            file = tmp_path / record.fmu.stem
            file.write_bytes(pickle.dumps(record))
            command = [sys.executable, Path(__file__).with_name("continuation.py"), file]
            printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
            assert [line.split() for line in printed.splitlines()] == expected, "elsewhere"
            assert not run.instance.said, run.instance.said


@pytest.mark.parametrize("name", ["controller", "plant"])
def test_gains_that_are_to_change_are_part_of_a_state(name: str) -> None:
    """Tunable gains act from the next step on: the outputs of the finished step, and how they
    change, are by the old ones."""
    gains = {"autopilot.altitude.kp": 3.0, "autopilot.altitude.kd": 40.0, "autopilot.roll.kd": 1.0}
    with Unit(getattr(build(DEFAULT), name)) as unit:
        instance, other, untouched = (unit.instantiate() for _ in range(3))
        outputs = unit.names("output")
        rates = {f"joint[{n}].rate_command": 0.3 * n for n in (1, 2, 3)} if name == "plant" else {}
        for each in (instance, untouched):
            each.initialize(parameters=known(unit, HURRY))
            each.set(rates)
            for n in range(BEFORE):
                each.step(n * STEP, STEP)
        instance.set(gains)
        slave = instance.slave
        other.slave.setFMUstate(
            other.slave.deSerializeFMUstate(slave.serializeFMUstate(slave.getFMUstate()))
        )
        assert other.all(outputs) == instance.all(outputs) == untouched.all(outputs)
        reals = [v for v in outputs if unit.variables[v].type == "Real"]
        slopes = [each.slopes(reals) for each in (instance, other, untouched)]
        assert slopes[0] == slopes[1] == slopes[2]
        for n in range(BEFORE, BEFORE + AFTER):
            for each in (instance, other, untouched):
                each.step(n * STEP, STEP)
            assert other.all(outputs) == instance.all(outputs)
        assert untouched.all(outputs) != instance.all(outputs), "gains act"


@pytest.mark.parametrize("name", ["controller", "plant"])
def test_what_is_no_state_of_the_unit_is_refused(name: str) -> None:
    """Truncated, damaged or foreign bytes; the instance goes on as if nothing had been asked."""
    fmus = {unit: getattr(build(DEFAULT), unit) for unit in ("controller", "plant")}
    others = [build(Structure(2)), build(Structure(3, "counterweight"))]
    foreign = [fmus.pop("plant" if name == "controller" else "controller")]
    foreign += [getattr(other, name) for other in others]
    with Unit(fmus[name]) as unit:
        instance, twin = unit.instantiate(), unit.instantiate()
        for each in (instance, twin):
            each.initialize()
            each.step(0.0, STEP)
        state = instance.slave.getFMUstate()
        whole = instance.slave.serializeFMUstate(state)
        title = whole.index(b"\n") + 1
        wrong = [whole[:length] for length in (0, 1, title, title + 8, len(whole) - 1)]
        for place in (0, title, title + 9, len(whole) // 2, len(whole) - 1):
            wrong.append(bytes([*whole[:place], whole[place] ^ 1, *whole[place + 1 :]]))
        for fmu in foreign:
            with Unit(fmu) as stranger:
                theirs = stranger.instantiate()
                theirs.initialize()
                wrong.append(theirs.slave.serializeFMUstate(theirs.slave.getFMUstate()))
        for content in wrong:
            message = instance.refuses(partial(instance.slave.deSerializeFMUstate, content))
            assert message.startswith("fmi2DeSerializeFMUstate: "), message
        instance.slave.freeFMUstate(state)
        assert state.value is None
        instance.refuses(partial(instance.slave.setFMUstate, state))
        for each in (instance, twin):
            each.step(STEP, STEP)
        outputs = unit.names("output")
        assert instance.all(outputs) == twin.all(outputs)


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc")
@pytest.mark.parametrize("name", ["controller", "plant"])
def test_states_are_reused_and_given_back(name: str) -> None:
    """Ten thousand states, each some kilobytes, leave nothing behind."""

    def resident() -> int:
        return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()

    with Unit(getattr(build(DEFAULT), name)) as unit:
        instance = unit.instantiate()
        instance.initialize()
        slave = instance.slave

        def many(count: int) -> None:
            for _ in range(count):
                state = slave.getFMUstate()
                address = state.value
                slave.fmi2GetFMUstate(slave.component, byref(state))
                assert state.value == address, "the state that is there is overwritten"
                content = slave.serializeFMUstate(state)
                slave.deSerializeFMUstate(content, state)
                assert state.value == address
                slave.freeFMUstate(state)

        many(500)
        before = resident()
        many(10_000)
        assert len(slave.serializeFMUstate(slave.getFMUstate())) > 1000
        assert resident() - before < 2_000_000
