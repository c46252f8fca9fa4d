"""Payload and support in the reference integration, against closed forms and conservation laws."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from oracle import simulate
from oracle_cases import IDEAL, OFF, G, vehicle
from oracle_data import Payload, StepInputs, StepOutput, Support


def test_capture_and_release_in_free_fall() -> None:
    """Hanging straight: a common velocity after capture, nothing jumps at release."""
    v, load = vehicle(2, mount=(0.0, -0.05)), Payload(0.5, 0.1)
    still = StepInputs((0.0, 0.0))
    a, b, c = simulate(
        v,
        OFF,
        load,
        None,
        G,
        [0.0, 0.0],
        [(0.1, still), (0.1, replace(still, grasp=True)), (0.1, still)],
    )
    caught = -v.mass * G * 0.1 / (v.mass + 0.5)
    assert a.velocity[1] == pytest.approx(-G * 0.1, abs=1e-13)
    assert b.velocity[1] == pytest.approx(caught - G * 0.1, abs=1e-13)
    assert c.velocity[1] == pytest.approx(caught - G * 0.2, abs=1e-13)
    assert b.momentum[1] == pytest.approx((v.mass + 0.5) * b.velocity[1], abs=1e-12)
    assert c.momentum[1] == pytest.approx(v.mass * c.velocity[1], abs=1e-12)
    assert (a.payload_attached, b.payload_attached, c.payload_attached) == (False, True, False)
    # Mean force of the carried on the UAV: the impulse at capture only.
    assert b.transmitted[1] == pytest.approx(v.uav_mass * (caught + G * 0.1) / 0.1, abs=1e-10)
    np.testing.assert_allclose(c.transmitted, 0.0, atol=1e-10)


def test_capture_off_axis_keeps_both_momenta() -> None:
    """No gravity: what the payload gains, the vehicle loses, also in angular momentum."""
    v, load = vehicle(2, sliding=True), Payload(0.7, 0.1)
    moving = StepInputs((1.0, -2.0), balance_rate=0.3, base_force=(1.0, 2.0), base_torque=0.4)
    jumped = StepInputs((-1.0, 0.5), balance_rate=-0.1, grasp=True)
    outputs = simulate(
        v,
        OFF,
        load,
        None,
        0.0,
        [0.3, 0.8],
        [(0.2, moving), (0.1, jumped), (0.1, jumped), (0.1, replace(jumped, grasp=False))],
    )

    def about_origin(out: StepOutput) -> float:
        return out.angular_momentum + (
            out.pose[0] * out.momentum[1] - out.pose[1] * out.momentum[0]
        )

    for out in outputs[1:3]:
        np.testing.assert_allclose(out.momentum, outputs[0].momentum, atol=1e-13)
        assert about_origin(out) == pytest.approx(about_origin(outputs[0]), abs=1e-13)
    # After release the vehicle keeps its own share: rates do not jump, so velocities do not.
    held, free = outputs[2:]
    short = simulate(
        v,
        OFF,
        load,
        None,
        0.0,
        [0.3, 0.8],
        [(0.2, moving), (0.1, jumped), (0.1, jumped), (1e-9, replace(jumped, grasp=False))],
    )[-1]
    np.testing.assert_allclose(short.velocity, held.velocity, atol=1e-8)
    np.testing.assert_allclose(free.momentum, short.momentum, atol=1e-8)


def test_support_bounce() -> None:
    """Falling straight onto the support: parabola, half an oscillation, parabola."""
    v, load = vehicle(2, mount=(0.0, -0.05)), Payload(0.5, 0.1)
    mass, k, drop = v.mass + 0.5, 2000.0, 0.07
    bottom = v.mount_y - v.links[0].length - load.com
    still = StepInputs((0.0, 0.0), grasp=True)
    outputs = simulate(v, OFF, load, Support(k, bottom - drop), G, [0.0, 0.0], [(0.01, still)] * 58)
    touch, speed, omega = math.sqrt(2 * drop / G), math.sqrt(2 * G * drop), math.sqrt(k / mass)
    sag = mass * G / k
    amplitude, phase = math.hypot(sag, speed / omega), math.atan2(sag, speed / omega)
    leave = touch + (math.pi + 2 * phase) / omega
    assert touch < 0.15 < 0.3 < leave < 0.4
    for out in outputs:
        t = out.time
        if t < touch:
            y, force = -G * t**2 / 2, 0.0
        elif t < leave:
            depth = sag + amplitude * math.sin(omega * (t - touch) - phase)
            y, force = -drop - depth, k * depth
        else:
            y, force = -drop + speed * (t - leave) - G * (t - leave) ** 2 / 2, 0.0
        assert out.pose[1] == pytest.approx(y, abs=1e-12)
        assert out.support_force == pytest.approx(force, abs=1e-9)


def test_support_touched_at_rest() -> None:
    """Exactly touching at the start: sinks by (1 - cos) where the thrust carries no payload."""
    v, load = vehicle(1, mount=(0.0, -0.05)), Payload(0.5, 0.1)
    u = StepInputs((0.0,), grasp=True, thrust_command=v.mass * G)
    support = Support(1000.0, v.mount_y - load.com)
    mass, sag = v.mass + 0.5, 0.5 * G / 1000.0
    for out in simulate(v, OFF, load, support, G, [0.0], [(0.01, u)] * 30):
        expected = -sag * (1 - math.cos(math.sqrt(1000.0 / mass) * out.time))
        assert out.pose[1] == pytest.approx(expected, abs=1e-13)


def test_static_hover_on_support() -> None:
    """Held still by the ideal base, the motor of a level link carries weight less support."""
    v, load = vehicle(1), Payload(0.5, 0.1)
    support = Support(1000.0, v.mount_y + 0.003)
    u = StepInputs((0.0,), grasp=True)
    out = simulate(v, IDEAL, load, support, G, [math.pi / 2], [(0.01, u)] * 3)[-1]
    assert out.support_force == pytest.approx(3.0, abs=1e-11)
    lever = v.links[0].mass * G * v.links[0].com + (0.5 * G - 3.0) * load.com
    assert out.motors[0] == pytest.approx(lever, abs=1e-10)
    assert out.thrust == pytest.approx((v.mass + 0.5) * G - 3.0, abs=1e-10)


def test_touch_shorter_than_an_integration_step() -> None:
    """A level base swings the payload through its lowest point, 1 micrometre into the support."""
    v, load, rate, depth = vehicle(1), Payload(0.5, 0.1), 1.0, 1e-6
    start, duration = -0.0153, 0.04
    u = StepInputs((rate,), grasp=True)
    support = Support(1000.0, v.mount_y - load.com + depth)
    touched, free = (
        simulate(v, IDEAL, load, s, G, [start], [(duration, u)])[-1] for s in (support, None)
    )
    half = math.acos(1 - depth / load.com)  # angle from entering to the lowest point
    impulse = 2 * 1000.0 * load.com * (math.sin(half) - half * math.cos(half)) / rate
    assert impulse / duration > 1e-4
    assert free.thrust - touched.thrust == pytest.approx(impulse / duration, abs=1e-10)
    # Symmetric about the lowest point: no moment about the joint.
    assert touched.motors[0] == pytest.approx(free.motors[0], abs=1e-10)
