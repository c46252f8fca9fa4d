"""The reference integration under its autopilots, against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from oracle import simulate
from oracle_cases import IDEAL, LINK, PID, G, vehicle, wild_steps
from oracle_data import Autopilot, Gains, StepInputs, Vehicle


def test_ideal_reactions() -> None:
    """Level base: thrust by total vertical momentum, moment by the first joint's reaction."""
    v = vehicle(2)
    outputs = simulate(
        v,
        IDEAL,
        None,
        None,
        G,
        [0.3, -0.2],
        wild_steps(2, 40, base_torque=0.3, end_effector_force=(1.0, 0.4)),
    )
    momentum = 0.0
    for out in outputs:
        assert out.momentum[0] == pytest.approx(1.0 * out.time, abs=1e-12)
        thrust = v.mass * G - 0.4 + (out.momentum[1] - momentum) / 0.01
        assert out.thrust == pytest.approx(thrust, abs=1e-9)
        fx, fy, moment = out.transmitted
        assert out.torque == pytest.approx(-moment - 0.3, abs=1e-9)
        assert fy == pytest.approx(v.uav_mass * G - out.thrust, abs=1e-9)
        assert moment == pytest.approx(-out.motors[0] + v.mount_x * fy - v.mount_y * fx, abs=1e-9)
        momentum = out.momentum[1]


def test_pid_altitude() -> None:
    """Arm hanging straight below: third-order linear response of the altitude."""
    v = vehicle(2, mount=(0.0, -0.05))
    kp, ki, kd = 37.0, 8.0, 18.0
    a = np.array(
        [
            [0, 1, 0, 0],
            [-kp / v.mass, -kd / v.mass, -ki / v.mass, kp / v.mass],
            [1, 0, 0, -1],
            [0, 0, 0, 0],
        ]
    )
    steps = [(0.05, StepInputs((0.0, 0.0), altitude_reference=0.3))] * 40
    for out in simulate(v, PID, None, None, G, [0.0, 0.0], steps):
        state = expm(a * out.time) @ [0, 0, 0, 0.3]
        assert out.pose[1] == pytest.approx(state[0], abs=1e-12)
        assert out.velocity[1] == pytest.approx(state[1], abs=1e-12)
        assert out.thrust - v.mass * G == pytest.approx(v.mass * (a @ state)[1], abs=1e-10)


@pytest.mark.parametrize("gains", [(40.0, 35.0, 3.0), (600.0, 500.0, 30.0)])
def test_pid_roll(gains: tuple[float, float, float]) -> None:
    """Links balanced about a joint at the UAV's centre of mass: linear response of the roll."""
    v = Vehicle(4.2, 0.4097, 0.0, 0.0, (replace(LINK, com=0.0),))
    inertia = v.uav_inertia + LINK.inertia
    kp, ki, kd = gains
    a = np.array(
        [
            [0, 1, 0, 0],
            [-kp / inertia, -kd / inertia, -ki / inertia, kp / inertia],
            [1, 0, 0, -1],
            [0, 0, 0, 0],
        ]
    )
    steps = [(0.02, StepInputs((0.0,), roll_reference=0.3))] * 50
    for out in simulate(v, Autopilot("pid", Gains(), Gains(*gains)), None, None, 0.0, [0.7], steps):
        state = expm(a * out.time) @ [0, 0, 0, 0.3]
        assert out.pose[2] == pytest.approx(state[0], abs=1e-12)
        assert out.torque == pytest.approx(inertia * (a @ state)[1], abs=1e-9)


@pytest.mark.parametrize("sample_time", [0.01, 0.004, 0.007, 0.03])
def test_sampled_altitude(sample_time: float) -> None:
    """Exact recursion of a held thrust, with samples on and between step boundaries."""
    v, steps = vehicle(1, mount=(0.0, -0.05)), []
    for _ in range(100):
        steps.append((0.01, StepInputs((0.0,), altitude_reference=0.2, thrust_feedforward=0.5)))
    pilot = replace(PID, mode="sampled", sample_time=sample_time)
    outputs = simulate(v, pilot, None, None, G, [0.0], steps)
    y, vy, total, t, history = 0.0, 0.0, 0.0, 0.0, []
    for _ in range(round(1.0 / sample_time) + 2):
        excess = 0.5 - 37.0 * (y - 0.2) - 18.0 * vy - 8.0 * total
        history.append((t, y, vy, excess))
        total += (y - 0.2) * sample_time
        y += vy * sample_time + excess / v.mass * sample_time**2 / 2
        vy += excess / v.mass * sample_time
        t += sample_time
    for out in outputs:
        t, y, vy, excess = [entry for entry in history if entry[0] < out.time - 1e-9][-1]
        late = out.time - t
        assert out.thrust == pytest.approx(v.mass * G + excess, abs=1e-11)
        assert out.pose[1] == pytest.approx(
            y + vy * late + excess / v.mass * late**2 / 2, abs=1e-12
        )


def test_sampled_uses_the_velocity_before_the_jump() -> None:
    v = vehicle(2)
    pilot = replace(PID, mode="sampled", sample_time=0.01)
    steps = wild_steps(2, 10, every=1)
    outputs = simulate(v, pilot, None, None, G, [0.3, 0.2], steps)
    assert outputs[0].thrust == pytest.approx(v.mass * G, abs=1e-12)
    total = 0.0
    for old, new in zip(outputs, outputs[1:]):
        torque = -40.0 * old.pose[2] - 9.0 * old.velocity[2] - 35.0 * total
        assert new.torque == pytest.approx(torque, abs=1e-12)
        total += old.pose[2] * 0.01
