"""The mechanics of the reference integration, against closed forms and conservation laws."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import pytest

from oracle import simulate
from oracle_cases import IDEAL, OFF, PID, G, central_angular_momentum, energy, vehicle, wild_steps
from oracle_data import BalanceElement, Counterweight, Payload, StepInputs, StepOutput, Support


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
