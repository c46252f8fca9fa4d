"""Checks of the reference integration against closed forms and conservation laws."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from oracle import simulate
from oracle_data import (
    Autopilot,
    BalanceElement,
    Counterweight,
    Gains,
    Link,
    Payload,
    StepInputs,
    StepOutput,
    Support,
    Vehicle,
)

G = 9.81
LINK = Link(mass=1.0, length=0.13, com=0.065, inertia=6e-4)
OFF = Autopilot("external")
IDEAL = Autopilot("ideal")
PID = Autopilot("pid", Gains(37.0, 8.0, 18.0), Gains(40.0, 35.0, 9.0))


def vehicle(
    n: int, *, sliding: bool = False, mount: tuple[float, float] = (0.03, -0.05)
) -> Vehicle:
    """Vehicle with links that differ, so that a mixed-up index shows."""
    links = tuple(
        Link(1.0 - 0.1 * i, 0.13 + 0.02 * i, 0.065 - 0.004 * i, 6e-4 * (1 + 0.3 * i))
        for i in range(n)
    )
    slider = Counterweight(0.8, 2e-3, 0.07, -0.02) if sliding else None
    return Vehicle(4.2, 0.4097, *mount, links, slider)


def wild_steps(
    n: int, count: int, *, duration: float = 0.01, seed: int = 0, every: int = 5, **inputs: Any
) -> list[tuple[float, StepInputs]]:
    """Piecewise constant random rates, jumping every few steps."""
    random = np.random.default_rng(seed)
    steps: list[tuple[float, StepInputs]] = []
    for k in range(count):
        if k % every == 0:
            rates = tuple(random.uniform(-2.0, 2.0, n))
            slide = random.uniform(-0.3, 0.3)
        steps.append((duration, StepInputs(rates, balance_rate=slide, **inputs)))
    return steps


def energy(output: StepOutput, support: Support | None = None) -> float:
    spring = 0.5 * output.support_force**2 / support.stiffness if support else 0.0
    return output.kinetic_energy + output.potential_energy + spring


def central_angular_momentum(output: StepOutput) -> float:
    """Angular momentum about the centre of mass of the whole system."""
    arm = output.center_of_mass - output.pose[:2]
    return output.angular_momentum - (arm[0] * output.momentum[1] - arm[1] * output.momentum[0])


def test_kinematics() -> None:
    v = vehicle(3, sliding=True)
    out = simulate(v, PID, None, None, G, [0.1, 0.2, -0.4], wild_steps(3, 20))[-1]
    x, y, phi = out.pose
    point = np.array(
        [
            x + v.mount_x * math.cos(phi) - v.mount_y * math.sin(phi),
            y + v.mount_x * math.sin(phi) + v.mount_y * math.cos(phi),
        ]
    )
    moment = v.uav_mass * out.pose[:2]
    for link, angle in zip(v.links, phi + np.cumsum(out.coordinates[:3])):
        along = np.array([math.sin(angle), -math.cos(angle)])
        moment = moment + link.mass * (point + link.com * along)
        point = point + link.length * along
    assert v.balance is not None
    s, h = out.coordinates[3], v.balance.height
    moment = moment + v.balance.mass * (
        out.pose[:2]
        + [s * math.cos(phi) - h * math.sin(phi), s * math.sin(phi) + h * math.cos(phi)]
    )
    np.testing.assert_allclose(out.end_effector, point, atol=1e-15)
    np.testing.assert_allclose(out.center_of_mass, moment / v.mass, atol=1e-15)


def test_sliding_base_with_one_link() -> None:
    """No horizontal force: x = -m c (sin q - sin q0) / M."""
    v, q0 = vehicle(1), 0.3
    steps = [(0.1, StepInputs((1.5,), (0.7,))), (0.1, StepInputs((-2.0,)))]
    for out in simulate(v, IDEAL, None, None, G, [q0], steps):
        link = v.links[0]
        expected = -link.mass * link.com * (math.sin(out.coordinates[0]) - math.sin(q0)) / v.mass
        np.testing.assert_allclose(out.pose, [expected, 0.0, 0.0], atol=1e-14)
        assert out.velocity[1] == out.velocity[2] == 0.0
    # Positions of the joint itself.
    assert out.coordinates[0] == pytest.approx(q0 + 0.15 + 0.0035 - 0.2, abs=1e-15)


def test_pendulum_torque_on_a_nearly_fixed_base() -> None:
    """Mean of (I + m c^2) qdd + m g c sin q, plus the impulse of the jump from rest."""
    v = replace(vehicle(1), uav_mass=1e12, uav_inertia=1e12)
    link, q0, rate, duration = v.links[0], 0.4, 1.3, 0.05
    inertia = link.inertia + link.mass * link.com**2
    first, second = simulate(
        v,
        IDEAL,
        None,
        None,
        G,
        [q0],
        [(duration, StepInputs((rate,))), (duration, StepInputs((rate,), (0.9,)))],
    )
    q1 = q0 + rate * duration
    weight = link.mass * G * link.com * (math.cos(q0) - math.cos(q1)) / (rate * duration)
    assert first.motors[0] == pytest.approx(weight + inertia * rate / duration, abs=1e-11)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    t = (nodes + 1) * duration / 2
    mean = weights @ np.sin(q1 + rate * t + 0.45 * t**2) / 2
    assert second.motors[0] == pytest.approx(
        link.mass * G * link.com * mean + inertia * 0.9, abs=1e-11
    )


def test_floating_reorientation() -> None:
    """Joint at the UAV's centre of mass, no gravity: roll rate is a fixed share of the rate."""
    v = vehicle(1, mount=(0.0, 0.0))
    link = v.links[0]
    reduced = v.uav_mass * link.mass / v.mass
    inertia = link.inertia + reduced * link.com**2
    share = -inertia / (v.uav_inertia + inertia)
    for out in simulate(v, OFF, None, None, 0.0, [0.2], wild_steps(1, 30)):
        assert out.velocity[2] == pytest.approx(share * out.rates[0], abs=1e-13)
        assert out.pose[2] == pytest.approx(share * (out.coordinates[0] - 0.2), abs=1e-13)
        angle = out.pose[2] + out.coordinates[0]
        offset = link.com * np.array([math.sin(angle), -math.cos(angle)])
        start = link.com * np.array([math.sin(0.2), -math.cos(0.2)])
        np.testing.assert_allclose(out.pose[:2], -(offset - start) * link.mass / v.mass, atol=1e-13)


@pytest.mark.parametrize("n", [1, 2, 4, 6])
@pytest.mark.parametrize("sliding", [False, True])
def test_free_fall(n: int, sliding: bool) -> None:
    v = vehicle(n, sliding=sliding)
    outputs = simulate(v, OFF, None, None, G, [0.2] * n, wild_steps(n, 60))
    start = outputs[0].center_of_mass[0]
    drop = outputs[0].center_of_mass[1] + G * outputs[0].time ** 2 / 2
    for out in outputs:
        np.testing.assert_allclose(out.momentum, [0.0, -v.mass * G * out.time], atol=1e-11)
        np.testing.assert_allclose(
            out.center_of_mass, [start, drop - G * out.time**2 / 2], atol=1e-12
        )
        assert central_angular_momentum(out) == pytest.approx(0.0, abs=1e-11)


@pytest.mark.parametrize("n", [1, 3, 6])
@pytest.mark.parametrize("case", ["free", "wrenches", "payload", "support"])
def test_energy_balance(n: int, case: str) -> None:
    """Without a jump, work of motors and external loads equals the change of energy."""
    v = vehicle(n, sliding=True)
    loads: dict[str, Any] = {}
    support = None
    if case == "wrenches":
        loads = dict(
            base_force=(1.0, 60.0),
            base_torque=0.3,
            end_effector_force=(-1.5, 0.8),
            end_effector_torque=0.2,
            torque_command=-0.4,
        )
    if case in ("payload", "support"):
        loads = dict(grasp=True, base_force=(0.0, 60.0))
    if case == "support":
        support = Support(1000.0, -0.05 - sum(link.length for link in v.links) + 0.02)
    outputs = simulate(
        v,
        OFF,
        Payload(0.5, 0.1),
        support,
        G,
        [0.1] * n,
        wild_steps(n, 50, every=10, seed=n, **loads),
    )
    if case == "support":
        touching = [out.support_force > 0 for out in outputs]
        assert any(touching) and not all(touching)
    fx, fy = loads.get("base_force", (0.0, 0.0))
    base = np.array([fx, fy, loads.get("base_torque", 0.0) + loads.get("torque_command", 0.0)])
    tip = np.array(loads.get("end_effector_force", (0.0, 0.0)))
    checked = 0
    for k, (old, new) in enumerate(zip(outputs, outputs[1:]), start=1):
        if k % 10 == 0:
            continue
        turned = new.pose[2] - old.pose[2] + np.sum((new.coordinates - old.coordinates)[:n])
        work = (
            new.motors @ (new.coordinates - old.coordinates)
            + base @ (new.pose - old.pose)
            + tip @ (new.end_effector - old.end_effector)
            + loads.get("end_effector_torque", 0.0) * turned
        )
        assert energy(new, support) - energy(old, support) == pytest.approx(work, abs=2e-11)
        checked += 1
    assert checked == 45


@pytest.mark.parametrize("ideal", [False, True])
def test_jump(ideal: bool) -> None:
    """At a jump base momenta stay; energy changes by impulses times mean rates."""
    v, short = vehicle(3, sliding=True), 1e-10
    before = StepInputs((1.0, -0.5, 0.7), balance_rate=0.2)
    after = StepInputs((-1.0, 1.5, 0.2), balance_rate=-0.1)
    old, new = simulate(
        v,
        IDEAL if ideal else OFF,
        None,
        None,
        0.0,
        [0.3, 0.4, 0.5],
        [(0.2, before), (short, after)],
    )[-2:]
    np.testing.assert_allclose(new.pose, old.pose, atol=1e-9)
    kept = 1 if ideal else 2
    np.testing.assert_allclose(new.momentum[:kept], old.momentum[:kept], atol=2e-8)
    if not ideal:
        assert new.angular_momentum == pytest.approx(old.angular_momentum, abs=1e-8)
        assert np.max(np.abs(new.velocity - old.velocity)) > 0.01
    work = short * new.motors @ (new.rates + old.rates) / 2
    assert new.kinetic_energy - old.kinetic_energy == pytest.approx(work, abs=1e-8)


def test_transmitted_wrench_against_momentum_of_the_carried() -> None:
    """Force by momentum of the rest of the system; moment by the first joint's reaction."""
    v = vehicle(3, mount=(0.0, 0.0))
    loads: dict[str, Any] = dict(
        end_effector_force=(2.0, -1.0), base_force=(0.5, 0.2), base_torque=0.3
    )
    outputs = simulate(v, PID, None, None, G, [0.3, -0.2, 0.4], wild_steps(3, 40, **loads))
    carried = np.zeros(2)
    for out in outputs:
        now = out.momentum - v.uav_mass * out.velocity[:2]
        weight = np.array([0.0, -(v.mass - v.uav_mass) * G])
        np.testing.assert_allclose(
            out.transmitted[:2], weight + [2.0, -1.0] - (now - carried) / 0.01, atol=1e-9
        )
        assert out.transmitted[2] == pytest.approx(-out.motors[0], abs=1e-9)
        carried = now


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


@pytest.mark.parametrize("ideal", [False, True])
def test_accelerations_are_derivatives_of_velocities(ideal: bool) -> None:
    v, h = vehicle(3, sliding=True), 1e-4
    u = StepInputs((1.0, -0.5, 0.7), (3.0, -2.0, 1.0), 0.2, 0.5, True, 0.1, 0.05, 2.0)
    coarse = simulate(
        v,
        IDEAL if ideal else PID,
        Payload(0.5, 0.1),
        None,
        G,
        [0.1] * 3,
        [
            (0.3, u),
            (h, replace(u, joint_rates=(1.9, -1.1, 1.0), balance_rate=0.35)),
            (h, replace(u, joint_rates=(1.9003, -1.1002, 1.0001), balance_rate=0.35005)),
        ],
    )
    slope = (coarse[2].velocity - coarse[0].velocity) / (2 * h)
    np.testing.assert_allclose(coarse[1].acceleration, slope, atol=2e-5)


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


@pytest.mark.parametrize("n", [1, 3])
@pytest.mark.parametrize("element", [None, BalanceElement(0.8, 3e-3, 0.12, 0.7)])
def test_free_joints_conserve_energy_and_momentum(n: int, element: BalanceElement | None) -> None:
    """Nothing drives the joints and nothing controls the UAV."""
    v = replace(vehicle(n), balance=element)
    still = StepInputs((0.0,) * n, base_torque=0.2, joint_torques=(0.0,) * n)
    steps = [(0.01, still)] * 5 + [(0.01, replace(still, base_torque=0.0))] * 60
    outputs = simulate(v, OFF, None, None, G, [0.8] * n, steps)
    start = outputs[5]
    turned = np.abs(outputs[-1].coordinates - start.coordinates)
    assert np.max(turned[:n]) > 1e-2
    for out in outputs[5:]:
        np.testing.assert_allclose(energy(out), energy(start), atol=1e-10)
        np.testing.assert_allclose(out.momentum[0], start.momentum[0], atol=1e-11)
        np.testing.assert_allclose(
            central_angular_momentum(out), central_angular_momentum(start), atol=1e-10
        )
        np.testing.assert_allclose(out.motors[:n], 0.0, atol=1e-9)


def test_a_free_pendulum_under_a_heavy_uav() -> None:
    """Small swings on a base that hardly moves: the frequency is sqrt(m g a / (I + m a^2))."""
    v = replace(vehicle(1), uav_mass=1e12, uav_inertia=1e12)
    link = v.links[0]
    inertia = link.inertia + link.mass * link.com**2
    frequency = math.sqrt(link.mass * G * link.com / inertia)
    steps = [(0.01, StepInputs((0.0,), joint_torques=(0.0,)))] * 50
    for out in simulate(v, IDEAL, None, None, G, [1e-4], steps):
        assert out.coordinates[0] == pytest.approx(1e-4 * math.cos(frequency * out.time), abs=1e-11)


def test_massless_counterweight_changes_nothing() -> None:
    steps = wild_steps(2, 30)
    with_slider = replace(vehicle(2), balance=Counterweight(0.0, 0.0, 0.1, 0.05))
    a = simulate(vehicle(2), PID, None, None, G, [0.3, 0.2], steps)[-1]
    b = simulate(with_slider, PID, None, None, G, [0.3, 0.2], steps)[-1]
    np.testing.assert_allclose(a.pose, b.pose, atol=1e-13)
    np.testing.assert_allclose(a.transmitted, b.transmitted, atol=1e-10)


def test_splitting_steps_changes_nothing() -> None:
    """Step means of halves average to the mean of the whole."""
    v, u = vehicle(2, sliding=True), StepInputs((1.0, -1.5), (0.5, 2.0), 0.2, 0.3)
    late = replace(
        u, joint_rates=(1.0 + 0.5 * 0.01, -1.5 + 2.0 * 0.01), balance_rate=0.2 + 0.3 * 0.01
    )
    whole = simulate(v, PID, None, None, G, [0.3, 0.2], [(0.02, u)])[-1]
    one, two = simulate(v, PID, None, None, G, [0.3, 0.2], [(0.01, u), (0.01, late)])
    np.testing.assert_allclose(two.pose, whole.pose, atol=1e-13)
    np.testing.assert_allclose(
        (one.transmitted + two.transmitted) / 2, whole.transmitted, atol=1e-9
    )
    np.testing.assert_allclose((one.motors + two.motors) / 2, whole.motors, atol=1e-9)


@pytest.mark.parametrize("contact", [False, True])
def test_convergence(contact: bool) -> None:
    """Tighter tolerances approach the default solution, and it has settled."""
    v, load = vehicle(3, sliding=True), Payload(0.5, 0.1)
    support = Support(1000.0, -0.40) if contact else None
    steps = wild_steps(3, 6, duration=0.4, grasp=True, every=1, seed=1)

    def run(rtol: float, atol: float) -> list[StepOutput]:
        return simulate(v, PID, load, support, G, [0.3, -0.2, 0.4], steps, rtol=rtol, atol=atol)

    def values(output: StepOutput) -> np.ndarray:
        return np.hstack([np.ravel(value) for value in asdict(output).values()])

    reference = values(run(1e-13, 1e-14)[-1])
    errors = [np.max(np.abs(values(run(r, r)[-1]) - reference)) for r in (1e-3, 1e-6, 1e-9)]
    assert errors[0] > 10 * errors[1] > 100 * errors[2]
    assert errors[2] < 1e-7
    settled = values(run(3e-14, 1e-15)[-1])
    np.testing.assert_allclose(settled, reference, rtol=1e-11, atol=1e-11)
