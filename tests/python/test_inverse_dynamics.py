"""What the plant FMU reports, put into the inverse dynamics of MuJoCo, Pinocchio and Drake.

The FMU says where everything is, how fast it moves and accelerates.  From that, these programs say
which forces that takes: on the base the thrust, the torque and what else pushes from outside, and
at the joints the torques of the motors.  Joints that are driven by a torque must be found to need
just that.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from conftest import ALL, EVERY_LENGTH, FULL, Structure, build
from fmu_run import fmu_table
from oracle_data import Array, Payload, StepInputs, Vehicle
from random_cases import MODES, PAYLOADS, Case, random_case
from rigid_bodies import Drake, Dynamics, MuJoCo, Pinocchio

STRUCTURES = ALL if FULL else EVERY_LENGTH
COMBINATIONS = len(MODES) * len(PAYLOADS)
SEEDS = range(COMBINATIONS * (2 if FULL else 1))
PROGRAMS = [
    pytest.param(MuJoCo, id="mujoco"),
    pytest.param(Pinocchio, id="pinocchio"),
    pytest.param(Drake, id="drake"),
]
Program = Callable[[Vehicle, Payload | None, float], Dynamics]

# Of the weight of the vehicle in N, and of 1 N m.
WRENCH = 1e-10
# Means over a step are differences of momenta divided by its length.
MEAN = 1e-9

# Nodes of quadratures over a step: exact for polynomials of degree 11.  Free joints whip about.
NODES, NODES_DRIVEN = 6, 14


class Observed:
    """What the FMU reports of a case at the end of each step."""

    def __init__(self, structure: Structure, case: Case) -> None:
        joints = range(1, structure.links + 1)
        position = [f"joint[{i}].position" for i in joints]
        rate = [f"joint[{i}].rate" for i in joints]
        torque = [f"joint[{i}].torque" for i in joints]
        if structure.balance != "none":
            position.append(f"{structure.balance}.position")
            rate.append(f"{structure.balance}.rate")
        position = ["base.x", "base.y", "base.roll", *position]
        rate = ["base.vx", "base.vy", "base.roll_rate", *rate]
        acceleration = ["base.ax", "base.ay", "base.roll_acceleration"]
        turning = [f"der({name})" for name in rate[3:]]
        control = ["autopilot.thrust", "autopilot.torque", "support.force"]
        groups = [position, rate, acceleration, turning, control, torque]
        table = fmu_table(
            build(structure).plant, case, [name for group in groups for name in group]
        )
        self.q, self.v, base, relative, self.control, self.torque = (
            np.array([table[name] for name in group]).T for group in groups
        )
        self.a = np.hstack([base, relative])
        own = [3 + joint for joint in _driven(case)]
        imposed = np.array([[0.0] * 3 + _accelerations(case, inputs) for _, inputs in case.steps])
        told = [i for i in range(3, self.a.shape[1]) if i not in own]
        np.testing.assert_allclose(self.a[:, told], imposed[:, told], rtol=0.0, atol=1e-12)


@cache
def observed(structure: Structure, case: Case) -> Observed:
    """Each case is run once, however many programs look at it."""
    return Observed(structure, case)


def _accelerations(case: Case, inputs: StepInputs) -> list[float]:
    joints = inputs.joint_accelerations or (0.0,) * len(case.vehicle.links)
    return [*joints, *([inputs.balance_acceleration] if case.vehicle.balance else [])]


def _rates(case: Case, inputs: StepInputs) -> list[float]:
    return [*inputs.joint_rates, *([inputs.balance_rate] if case.vehicle.balance else [])]


def _driven(case: Case) -> list[int]:
    """Joints that are driven by a torque."""
    torques = case.steps[0][1].joint_torques
    return [joint for joint, torque in enumerate(torques) if torque is not None]


def _torques(case: Case, inputs: StepInputs, passed: float) -> Array:
    """Of the motors that give a torque, so long after the beginning of a step."""
    joints = _driven(case)
    slopes = inputs.joint_torque_slopes
    return np.array([(inputs.joint_torques[j] or 0.0) + slopes[j] * passed for j in joints])


class Programs:
    """One program, with and without the payload."""

    def __init__(self, program: Program, case: Case) -> None:
        self._with = {
            held: program(case.vehicle, case.payload if held else None, case.gravity)
            for held in {inputs.grasp for _, inputs in case.steps} | {False}
        }

    def __getitem__(self, held: bool) -> Dynamics:
        return self._with[held]

    def motors(
        self, case: Case, inputs: StepInputs, q: Array, v: Array, a: Array, support: float
    ) -> Array:
        """Generalized forces less the loads from outside: rotors, then motors."""
        program, link = self[inputs.grasp], case.vehicle.links[-1]
        forces = program.forces(q, v, a)
        forces[:3] -= [*inputs.base_force, inputs.base_torque]
        tip = np.array(inputs.end_effector_force)
        forces -= program.pushed(q, link.length, tip, inputs.end_effector_torque)
        if case.payload and support:
            forces -= program.pushed(q, case.payload.com, np.array([0.0, support]), 0.0)
        return forces


def _case(structure: Structure, seed: int, duration: float = 1.0, **given: Any) -> Case:
    seed += 7000 + COMBINATIONS * 1000 * ALL.index(structure)
    return random_case(
        seed, links=structure.links, balance=structure.balance, duration=duration, **given
    )


def _skip_unless_installed(program: type) -> None:
    module = {MuJoCo: "mujoco", Pinocchio: "pinocchio", Drake: "pydrake"}[program]
    pytest.importorskip(module, reason=f"{module} is not installed")


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("driven", [False, True], ids=["imposed", "driven"])
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_rotors_motors_and_loads_are_what_the_motion_takes(
    structure: Structure, seed: int, driven: bool, program: type
) -> None:
    _skip_unless_installed(program)
    case = _case(structure, seed, duration=0.5 if driven else 1.0, driven=driven)
    own = [3 + joint for joint in _driven(case)]
    assert bool(own) == driven
    seen, programs = observed(structure, case), Programs(program, case)
    scale = np.array([case.vehicle.mass * 9.81] * 2 + [1.0])
    for k, (size, inputs) in enumerate(case.steps):
        thrust, torque, support = seen.control[k]
        needed = programs.motors(case, inputs, seen.q[k], seen.v[k], seen.a[k], support)
        roll = seen.q[k][2]
        given = np.array([-np.sin(roll) * thrust, np.cos(roll) * thrust, torque])
        residual = np.abs(needed[:3] - given) / np.maximum(scale, np.max(np.abs(needed)))
        # On an ideal carriage, thrust and torque are means over the step: it gives what is needed.
        residual = residual[: 1 if case.autopilot.mode == "ideal" else 3]
        assert np.all(residual <= WRENCH), f"{case.name}: step {k}: {residual}"
        missing = np.abs(needed[own] - _torques(case, inputs, size))
        missing /= max(1.0, float(np.max(np.abs(needed))))
        assert np.all(missing <= WRENCH), f"{case.name}: step {k}: {missing}"


def _quadrature(count: int) -> tuple[Array, Array]:
    """Nodes from 0 to 1 and weights (Gauss-Legendre)."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return (nodes + 1) / 2, weights / 2


def _refined(case: Case, nodes: Array) -> Case:
    """The same motion, with communication points at the nodes of the quadrature in each step."""
    own = _driven(case)
    instants = [0.0, *nodes, 1.0]
    steps = []
    for size, inputs in case.steps:
        accelerations = inputs.joint_accelerations or (0.0,) * len(inputs.joint_rates)
        for begin, end in pairwise(instants):
            passed = begin * size
            rates = tuple(r + a * passed for r, a in zip(inputs.joint_rates, accelerations))
            balance = inputs.balance_rate + inputs.balance_acceleration * passed
            moved = replace(inputs, joint_rates=rates, balance_rate=balance)
            if own:
                torques: list[float | None] = list(inputs.joint_torques)
                for joint, torque in zip(own, _torques(case, inputs, passed)):
                    torques[joint] = float(torque)
                moved = replace(moved, joint_torques=tuple(torques))
            steps.append(((end - begin) * size, moved))
    return replace(case, steps=tuple(steps))


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("driven", [False, True], ids=["imposed", "driven"])
@pytest.mark.parametrize("payload", ["none", "free"])
@pytest.mark.parametrize("mode", ["pid", "external"])
@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_mean_joint_torques_are_impulses_over_the_step(
    structure: Structure, mode: str, payload: str, driven: bool, program: type
) -> None:
    """Jumps of the rates at the beginning of a step are shocks, and belong to it.

    Joints that are driven by a torque give way to them.  Long arms on free joints are chaotic: the
    two runs that are compared part after some tenths of a second.
    """
    _skip_unless_installed(program)
    links = structure.links
    duration = 0.2 if driven else 1.0
    case = _case(structure, 3, mode=mode, payload=payload, duration=duration, driven=driven)
    own = [3 + joint for joint in _driven(case)]
    free = [0, 1, 2, *own]
    nodes, weights = _quadrature(NODES_DRIVEN if driven else NODES)
    coarse, fine = observed(structure, case), observed(structure, _refined(case, nodes))
    programs = Programs(program, case)
    largest = max(1.0, float(np.max(np.abs(coarse.torque))))
    before, held = np.zeros(coarse.v.shape[1]), False
    start = np.concatenate([np.zeros(3), case.joint_start])
    if balance := case.vehicle.balance:
        start = np.append(start, balance.start)
    shocks = 0
    for k, (size, inputs) in enumerate(case.steps):
        q = coarse.q[k - 1] if k else start
        # A payload that is taken over is at rest, one that is let go keeps its momentum.
        momentum = programs[held and inputs.grasp].mass_matrix(q) @ before
        inertia = programs[inputs.grasp].mass_matrix(q)
        after = np.array([0.0] * 3 + _rates(case, inputs))
        after[free] = 0.0
        left = (momentum - inertia @ after)[free]
        after[free] = np.linalg.solve(inertia[np.ix_(free, free)], left)
        shock = (inertia @ after - momentum)[3 : 3 + links]
        shocks += bool(np.max(np.abs(shock)) > 1e-6)
        mean = shock / size
        for i, weight in enumerate(weights):
            row = k * (len(nodes) + 1) + i
            motors = programs.motors(case, inputs, fine.q[row], fine.v[row], fine.a[row], 0.0)
            mean += weight * motors[3 : 3 + links]
        error = np.max(np.abs(mean - coarse.torque[k]))
        assert error <= MEAN * largest, f"{case.name}: step {k}: {error} of {largest}"
        before, held = coarse.v[k], inputs.grasp
    if links == len(own):
        assert shocks == 0, "joints that are all driven give way"
    else:
        assert shocks > (0 if driven else 5)
