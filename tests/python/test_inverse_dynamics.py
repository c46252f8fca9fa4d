"""What the plant FMU reports, put into the inverse dynamics of MuJoCo, Pinocchio and Drake.

The FMU says where everything is, how fast it moves and accelerates.  From that, these programs say
which forces that takes: on the base the thrust, the torque and what else pushes from outside, and
at the joints the torques of the motors.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from conftest import ALL, FULL, SOME, Structure, build
from fmu_run import fmu_table
from oracle_data import Array, Payload, StepInputs, Vehicle
from random_cases import MODES, PAYLOADS, Case, random_case
from rigid_bodies import Drake, Dynamics, MuJoCo, Pinocchio

STRUCTURES = ALL if FULL else SOME
SEEDS = range(len(MODES) * len(PAYLOADS))
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

# Gauss-Legendre quadrature: exact for polynomials of degree 11.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)
NODES, WEIGHTS = (NODES + 1) / 2, WEIGHTS / 2


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
        control = ["autopilot.thrust", "autopilot.torque", "support.force"]
        groups = [position, rate, acceleration, control, torque]
        table = fmu_table(
            build(structure).plant, case, [name for group in groups for name in group]
        )
        self.q, self.v, base, self.control, self.torque = (
            np.array([table[name] for name in group]).T for group in groups
        )
        imposed = np.array([_accelerations(case, inputs) for _, inputs in case.steps])
        self.a = np.hstack([base, imposed])


@cache
def observed(structure: Structure, case: Case) -> Observed:
    """Each case is run once, however many programs look at it."""
    return Observed(structure, case)


def _accelerations(case: Case, inputs: StepInputs) -> list[float]:
    joints = inputs.joint_accelerations or (0.0,) * len(case.vehicle.links)
    return [*joints, *([inputs.balance_acceleration] if case.vehicle.balance else [])]


def _rates(case: Case, inputs: StepInputs) -> list[float]:
    return [*inputs.joint_rates, *([inputs.balance_rate] if case.vehicle.balance else [])]


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


def _case(structure: Structure, seed: int, **given: str) -> Case:
    seed += 7000 + len(SEEDS) * 1000 * ALL.index(structure)
    return random_case(
        seed, links=structure.links, balance=structure.balance, duration=1.0, **given
    )


def _skip_unless_installed(program: type) -> None:
    module = {MuJoCo: "mujoco", Pinocchio: "pinocchio", Drake: "pydrake"}[program]
    pytest.importorskip(module, reason=f"{module} is not installed")


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_rotors_and_loads_are_what_the_motion_takes(
    structure: Structure, seed: int, program: type
) -> None:
    _skip_unless_installed(program)
    case = _case(structure, seed)
    seen, programs = observed(structure, case), Programs(program, case)
    scale = np.array([case.vehicle.mass * 9.81] * 2 + [1.0])
    for k, (_, inputs) in enumerate(case.steps):
        thrust, torque, support = seen.control[k]
        needed = programs.motors(case, inputs, seen.q[k], seen.v[k], seen.a[k], support)
        roll = seen.q[k][2]
        given = np.array([-np.sin(roll) * thrust, np.cos(roll) * thrust, torque])
        residual = np.abs(needed[:3] - given) / np.maximum(scale, np.max(np.abs(needed)))
        # On an ideal carriage, thrust and torque are means over the step: it gives what is needed.
        residual = residual[: 1 if case.autopilot.mode == "ideal" else 3]
        assert np.all(residual <= WRENCH), f"{case.name}: step {k}: {residual}"


def _refined(case: Case) -> Case:
    """The same motion, with communication points at the nodes of the quadrature in each step."""
    instants = [0.0, *NODES, 1.0]
    steps = []
    for size, inputs in case.steps:
        accelerations = inputs.joint_accelerations or (0.0,) * len(inputs.joint_rates)
        for begin, end in pairwise(instants):
            passed = begin * size
            rates = tuple(r + a * passed for r, a in zip(inputs.joint_rates, accelerations))
            balance = inputs.balance_rate + inputs.balance_acceleration * passed
            moved = replace(inputs, joint_rates=rates, balance_rate=balance)
            steps.append(((end - begin) * size, moved))
    return replace(case, steps=tuple(steps))


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("payload", ["none", "free"])
@pytest.mark.parametrize("mode", ["pid", "external"])
@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_mean_joint_torques_are_impulses_over_the_step(
    structure: Structure, mode: str, payload: str, program: type
) -> None:
    """Jumps of the rates at the beginning of a step are shocks, and belong to it."""
    _skip_unless_installed(program)
    links = structure.links
    case = _case(structure, 3, mode=mode, payload=payload)
    coarse, fine = observed(structure, case), observed(structure, _refined(case))
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
        rates = np.array(_rates(case, inputs))
        base = np.linalg.solve(inertia[:3, :3], momentum[:3] - inertia[:3, 3:] @ rates)
        shock = (inertia @ np.concatenate([base, rates]) - momentum)[3 : 3 + links]
        shocks += bool(np.max(np.abs(shock)) > 1e-6)
        mean = shock / size
        for i, weight in enumerate(WEIGHTS):
            row = k * (len(NODES) + 1) + i
            motors = programs.motors(case, inputs, fine.q[row], fine.v[row], fine.a[row], 0.0)
            mean += weight * motors[3 : 3 + links]
        error = np.max(np.abs(mean - coarse.torque[k]))
        assert error <= MEAN * largest, f"{case.name}: step {k}: {error} of {largest}"
        before, held = coarse.v[k], inputs.grasp
    assert shocks > 5
