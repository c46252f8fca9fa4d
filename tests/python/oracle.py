"""Reference integration of a planar aerial manipulator (test oracle).

A UAV moves in a vertical plane (x right, y up, angles counter-clockwise) and carries an arm of
revolute links, optionally a sliding counterweight or a turning balance element, and a grasped
point mass.  Rates are imposed, except on joints that are driven by a torque; the base (x, y, roll)
moves freely under thrust and torque.

Base and driven joints are integrated in their conjugate momenta, which stay continuous when imposed
rates jump; the equations are those of `oracle_model`.  All quantities are in SI units.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from oracle_data import (
    Array,
    Autopilot,
    Counterweight,
    Payload,
    StepInputs,
    StepOutput,
    Support,
    Vehicle,
)
from oracle_model import Model, equations, layout

# No longer steps where contact may switch within one [s].
CONTACT_STEP = 2.5e-3


@dataclass
class _Integrator:
    """DOP853 over one smooth piece after another; switches of the support are events."""

    model: Model
    p: Array
    contact_index: int
    supported: bool
    rtol: float
    atol: float
    max_step: float

    def _solve(self, z: Array, a: float, b: float, *crossings: tuple[int, float]) -> Any:
        """Integrate from a to b, or to the first crossing: (index into `gap`, its direction)."""

        def event(index: int, direction: float) -> Any:
            value: Any = lambda tau, state: self._gap(state, tau)[index]  # noqa: E731
            value.terminal, value.direction = True, direction
            return value

        solution = solve_ivp(
            lambda tau, state: self.model.derivative(state, tau, self.p)[0],
            (a, b),
            z,
            method="DOP853",
            rtol=self.rtol,
            atol=self.atol,
            events=[event(*crossing) for crossing in crossings] or None,
            max_step=self.max_step if crossings or self.max_step < CONTACT_STEP else np.inf,
        )
        if solution.status < 0:
            raise RuntimeError(solution.message)
        return solution

    def _state(self, z: Array, a: float, b: float) -> Array:
        return self._solve(z, a, b).y[:, -1] if b > a else z

    def _gap(self, z: Array, tau: float) -> list[float]:
        return [float(value[0]) for value in self.model.gap(z, tau, self.p)]

    def advance(self, z: Array, a: float, b: float) -> Array:
        """Integrate from a to b (times since the start of the communication step)."""
        self.p[self.contact_index] = 0.0
        if not self.supported:
            return self._state(z, a, b)
        # Touching, or turning: the sign of the first derivative that is not zero decides.
        gaps = self._gap(z, a)
        contact = next((g > 0 for g in gaps if abs(g) > 1e-12), False)
        sinking = next((g > 0 for g in gaps[1:] if abs(g) > 1e-12), False)
        for _ in range(1000):
            self.p[self.contact_index] = float(contact)
            switch, turn = (0, -1.0 if contact else 1.0), (1, -1.0 if sinking else 1.0)
            solution = self._solve(z, a, b, switch, turn)
            turned = solution.status == 1 and solution.t_events[1].size > 0
            if turned:  # A short touch before the turn may hide inside one step: look again.
                turn_time = float(solution.t_events[1][0])
                turned = turn_time > a + 1e-12  # otherwise the payload stands still
                solution = self._solve(z, a, turn_time if turned else b, switch)
            if solution.status == 1:
                # Not the interpolated state: integrate up to the switch and correct its time.
                time = float(solution.t[-1])
                for _ in range(2):
                    gap, gap_rate, _ = self._gap(self._state(z, a, time), time)
                    if abs(gap) < 1e-15 or abs(gap_rate) < 1e-6:
                        break
                    time = min(max(time - gap / gap_rate, a), b)
                z, a, contact = self._state(z, a, time), time, not contact
            elif turned:
                z, a, sinking = self._state(z, a, turn_time), turn_time, not sinking
            else:
                z, gap = solution.y[:, -1], self._gap(solution.y[:, -1], b)[0]
                if (gap > 0) != contact and abs(gap) > 1e-11:
                    raise RuntimeError("a switch of the support was missed")
                return z
        raise RuntimeError("too many switches of the support")


def simulate(
    vehicle: Vehicle,
    autopilot: Autopilot,
    payload: Payload | None,
    support: Support | None,
    gravity: float,
    q0: Sequence[float],
    steps: Sequence[tuple[float, StepInputs | Mapping[str, Any]]],
    *,
    rtol: float = 1e-13,
    atol: float = 1e-14,
) -> list[StepOutput]:
    """Simulate from rest at x = y = roll = 0 and return the outputs of every step.

    `q0` are the joint angles at the start, `steps` pairs of duration and inputs.  A sample of the
    "sampled" autopilot that falls on a step boundary uses the references of the step it opens.
    """
    if autopilot.mode not in ("pid", "sampled", "external", "ideal"):
        raise ValueError(f"unknown autopilot mode {autopilot.mode!r}")
    n, balance = len(vehicle.links), vehicle.balance
    ideal, sampled = autopilot.mode == "ideal", autopilot.mode == "sampled"
    m = n + (balance is not None)
    sizes = layout(n, m)
    offsets = dict(zip(sizes, np.cumsum([0, *sizes.values()])))
    control_at = slice(offsets["constant_control"], offsets["constant_control"] + 2)
    gains = np.array([[g.kp, g.ki, g.kd] for g in (autopilot.altitude, autopilot.roll)])
    kp, ki, kd = gains.T
    inertia = np.array([vehicle.uav_mass, vehicle.uav_mass, vehicle.uav_inertia])
    weight = np.array([0.0, -vehicle.uav_mass * gravity, 0.0])

    body: tuple[float, float, float] = (0.0, 0.0, 0.0)
    if balance:
        distance = balance.height if isinstance(balance, Counterweight) else balance.com
        body = balance.mass, balance.inertia, distance

    def with_balance(joints: Sequence[float], own: float) -> Array:
        return np.array([*(joints or [0.0] * n), *([own] if balance else [])], dtype=float)

    pose, velocity, integrals = np.zeros(3), np.zeros(3 + m), np.zeros(2)
    coordinates = with_balance(q0, balance.start if balance else 0.0)
    held, time, samples, sums, control = False, 0.0, 0, np.zeros(2), np.zeros(2)
    outputs: list[StepOutput] = []

    for duration, given in steps:
        u = given if isinstance(given, StepInputs) else StepInputs(**given)
        driven = tuple(j for j, torque in enumerate(u.joint_torques) if torque is not None)
        references = np.array([u.altitude_reference, u.roll_reference])
        feedforward = np.array([vehicle.mass * gravity + u.thrust_feedforward, 0.0])
        constant = {"pid": feedforward, "external": (u.thrust_command, u.torque_command)}
        base_wrench = np.array([*u.base_force, u.base_torque])
        values = {
            "uav": (vehicle.uav_mass, vehicle.uav_inertia),
            "mount": (vehicle.mount_x, vehicle.mount_y),
            "links": [x for k in vehicle.links for x in (k.mass, k.length, k.com, k.inertia)],
            "balance": body,
            "payload": (payload.mass, payload.com) if payload else (0, 0),
            "gravity": [gravity],
            "support": (support.stiffness, support.height) if support else (0, 0),
            "contact": [0.0],
            "gains": gains.ravel() if autopilot.mode == "pid" else np.zeros(6),
            "references": references,
            "constant_control": constant.get(autopilot.mode, np.zeros(2)),
            "base_wrench": base_wrench,
            "end_wrench": (*u.end_effector_force, u.end_effector_torque),
            "position": coordinates,
            "rate": with_balance(u.joint_rates, u.balance_rate),
            "acceleration": with_balance(u.joint_accelerations, u.balance_acceleration),
            "torque": with_balance([torque or 0.0 for torque in u.joint_torques], 0.0),
            "torque_slope": with_balance(u.joint_torque_slopes, 0.0),
        }
        p = np.concatenate([np.asarray(values[name], dtype=float) for name in sizes])
        structure = n, type(balance) if balance else None, driven
        model = equations(*structure, u.grasp, ideal)
        supported = u.grasp and support is not None and support.stiffness > 0
        # The inertia of a light link on a free joint makes small errors of momenta large ones of
        # rates: tolerances alone do not see to that.
        max_step = 2.5e-4 if driven else CONTACT_STEP
        integrator = _Integrator(model, p, offsets["contact"], supported, rtol, atol, max_step)

        # Before the jump.  A payload being taken over is at rest, one being let go keeps its own
        # momentum: in both cases only a payload held before and after adds to the momenta.
        through = equations(*structure, held and u.grasp, ideal)
        before = through.momenta(np.concatenate([pose, coordinates]), velocity, p)[0]
        own = list(driven)
        z = np.concatenate(
            [pose, before[:3], integrals, np.zeros(3 + m), coordinates[own], before[3:][own]]
        )

        tau, measured_rates = 0.0, velocity[1:3]
        while tau < duration:
            end = duration
            if sampled:
                if samples * autopilot.sample_time - (time + tau) < 1e-9:
                    errors = z[1:3] - references
                    control = feedforward - kp * errors - kd * measured_rates - ki * sums
                    sums = sums + errors * autopilot.sample_time
                    samples += 1
                p[control_at] = control
                following = samples * autopilot.sample_time - time
                end = following if following < duration - 1e-9 else duration
            z, tau = integrator.advance(z, tau, end), end
            measured_rates = model.report(z, tau, p)[0][1:3]

        if supported:
            p[offsets["contact"]] = float(model.gap(z, duration, p)[0][0] > 0)
        (
            now,
            acceleration,
            momenta,
            applied,
            tip,
            tip_velocity,
            linear,
            angular,
            center,
            support_force,
            kinetic,
            potential,
            place,
        ) = model.report(z, duration, p)
        thrust_impulse = z[8:11]
        if ideal:
            thrust_impulse = np.array([0.0, *(momenta[1:3] - z[4:6])])
            applied = thrust_impulse[1:] / duration
        transmitted = (
            (inertia * (now[:3] - velocity[:3]) - thrust_impulse) / duration - weight - base_wrench
        )
        time += duration
        pose, velocity, integrals, held = z[:3], now, z[6:8], u.grasp
        coordinates = place[3:]
        outputs.append(
            StepOutput(
                time,
                pose,
                now[:3],
                acceleration[:3],
                coordinates,
                now[3:],
                tip,
                tip_velocity,
                applied[0],
                applied[1],
                linear,
                angular[0],
                center,
                support_force[0] + 0.0,
                held,
                transmitted,
                (momenta[3:] - before[3:] - z[11 : 11 + m]) / duration,
                kinetic[0],
                potential[0],
            )
        )
    return outputs
