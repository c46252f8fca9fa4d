"""Reference integration of a planar aerial manipulator (test oracle).

A UAV moves in a vertical plane (x right, y up, angles counter-clockwise) and carries an arm of
revolute links, optionally a sliding counterweight or a turning balance element, and a grasped
point mass.  Rates are imposed, except on joints that are driven by a torque; the base (x, y, roll)
moves freely under thrust and torque.

Only the Lagrangian is written down by hand.  Momenta, inertia matrix and generalised forces come
from automatic differentiation (CasADi).  Base and driven joints are integrated in their conjugate
momenta, which stay continuous when imposed rates jump.  All quantities are in SI units.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca
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

# No longer steps where contact may switch within one [s].
CONTACT_STEP = 2.5e-3


def _layout(n: int, m: int) -> dict[str, int]:
    """Names and sizes in the flat parameter vector of the compiled functions.

    There are n joints and m coordinates.
    """
    return {
        "uav": 2,
        "mount": 2,
        "links": 4 * n,
        "balance": 3,
        "payload": 2,
        "gravity": 1,
        "support": 2,
        "contact": 1,
        "gains": 6,
        "references": 2,
        "constant_control": 2,
        "base_wrench": 3,
        "end_wrench": 3,
        "position": m,
        "rate": m,
        "acceleration": m,
        "torque": m,
        "torque_slope": m,
    }


class _Fast:
    """Calls a CasADi function through preallocated buffers; every output comes back flat."""

    def __init__(self, function: ca.Function) -> None:
        self._inputs = [np.zeros(function.numel_in(i)) for i in range(function.n_in())]
        self._outputs = [np.zeros(function.numel_out(i)) for i in range(function.n_out())]
        buffer: Any
        buffer, self._evaluate = function.buffer()
        self._keep = function, buffer  # the buffer only borrows both
        for i, array in enumerate(self._inputs):
            buffer.set_arg(i, memoryview(array.data))
        for i, array in enumerate(self._outputs):
            buffer.set_res(i, memoryview(array.data))

    def __call__(self, *arguments: Any) -> list[Array]:
        for array, argument in zip(self._inputs, arguments, strict=True):
            array[:] = argument
        self._evaluate()
        return [array.copy() for array in self._outputs]


@dataclass(frozen=True)
class _Model:
    """Compiled functions of one structure."""

    derivative: _Fast  # (z, tau, p) -> dz
    report: _Fast  # (z, tau, p) -> the quantities listed at its creation
    gap: _Fast  # (z, tau, p) -> support height minus payload height, two derivatives
    momenta: _Fast  # (Q, Qd, p) -> dL/dQd


@cache
def _model(
    n: int, balance: type | None, driven: tuple[int, ...], held: bool, ideal: bool
) -> _Model:
    """Derive and compile the equations of one structure from its Lagrangian.

    State z: base (x, y, roll), conjugate base momenta, integrals of the two control errors,
    impulse of thrust (x, y, moment), integrals of dL/dq + Q for each coordinate, positions of the
    driven joints, their conjugate momenta.
    In ideal mode the y and roll momenta in z leave out the reactions (thrust, torque).
    """
    m = n + (balance is not None)
    sizes = _layout(n, m)
    p = ca.SX.sym("p", sum(sizes.values()))
    offsets = np.cumsum([0, *sizes.values()])
    par = {name: p[int(a) : int(b)] for name, a, b in zip(sizes, offsets, offsets[1:])}

    q, qd, qdd = (ca.SX.sym(name, 3 + m) for name in ("q", "qd", "qdd"))

    def rate(expression: ca.SX) -> ca.SX:
        return ca.jtimes(expression, q, qd)

    base, phi = q[:2], q[2]
    turn = ca.vertcat(ca.horzcat(ca.cos(phi), -ca.sin(phi)), ca.horzcat(ca.sin(phi), ca.cos(phi)))
    bodies = [(par["uav"][0], par["uav"][1], base, phi)]
    joint, angle, load = base + turn @ par["mount"], phi, base
    for i in range(n):
        mass, length, com, inertia = ca.vertsplit(par["links"][4 * i : 4 * i + 4])
        angle = angle + q[3 + i]
        along = ca.vertcat(ca.sin(angle), -ca.cos(angle))
        bodies.append((mass, inertia, joint + com * along, angle))
        load = joint + par["payload"][1] * along
        joint = joint + length * along
    tip = joint
    if balance is not None:
        mass, inertia, distance = ca.vertsplit(par["balance"])
        own = q[3 + n]
        if balance is Counterweight:
            bodies.append((mass, inertia, base + turn @ ca.vertcat(own, distance), phi))
        else:
            down = ca.vertcat(ca.sin(phi + own), -ca.cos(phi + own))
            bodies.append((mass, inertia, base + distance * down, phi + own))
    if held:
        bodies.append((par["payload"][0], ca.SX(0), load, angle))

    kinetic = sum(
        0.5 * mass * ca.sumsqr(rate(r)) + 0.5 * j * rate(a) ** 2 for mass, j, r, a in bodies
    )
    potential = sum(mass * par["gravity"] * r[1] for mass, _, r, _ in bodies)
    momenta = ca.gradient(kinetic, qd)
    inertia_matrix = ca.jacobian(momenta, qd)
    gap = par["support"][1] - load[1]
    support_force = par["contact"] * par["support"][0] * gap if held else ca.SX(0)
    forces = (
        ca.gradient(kinetic - potential, q)
        + ca.vertcat(par["base_wrench"], ca.SX.zeros(m))
        + ca.jacobian(tip, q).T @ par["end_wrench"][:2]
        + ca.jacobian(angle, q).T * par["end_wrench"][2]
        + ca.jacobian(load[1], q).T * support_force
    )
    total = sum(mass for mass, *_ in bodies)
    center = sum(mass * r for mass, _, r, _ in bodies) / total
    linear = sum(mass * rate(r) for mass, _, r, _ in bodies)
    angular = sum(
        mass * ((r - base)[0] * rate(r)[1] - (r - base)[1] * rate(r)[0]) + j * rate(a)
        for mass, j, r, a in bodies
    )
    gap_rate = rate(gap)
    gap_acceleration = rate(gap_rate) + ca.jtimes(gap_rate, qd, qdd)
    mechanics = ca.Function(
        "mechanics", [q, qd, p], [momenta, inertia_matrix, forces, rate(momenta)]
    )
    observed = ca.Function(
        "observed",
        [q, qd, p],
        [tip, rate(tip), linear, angular, center, support_force, kinetic, potential],
    )
    gaps = ca.Function("gaps", [q, qd, qdd, p], [gap, gap_rate, gap_acceleration])

    k, tau = len(driven), ca.SX.sym("tau")
    z = ca.SX.sym("z", 11 + m + 2 * k)
    base_free = [0] if ideal else [0, 1, 2]
    joints = [3 + j for j in driven]
    free = base_free + joints
    fixed = [i for i in range(3, 3 + m) if i not in joints]
    torque = (par["torque"] + par["torque_slope"] * tau)[list(driven)]

    position = ca.SX(ca.vertcat(z[:3], par["position"]))
    position[3:] += par["rate"] * tau + par["acceleration"] * tau**2 / 2
    if driven:
        position[joints] = z[11 + m : 11 + m + k]
    matrix = mechanics(position, ca.SX.zeros(3 + m), p)[1]
    z_momenta = ca.vertcat(z[3 : 3 + len(base_free)], z[11 + m + k :])

    def completed(imposed: ca.SX, right_hand_side: ca.SX) -> ca.SX:
        """The imposed entries, and the free ones that follow from their momenta or forces."""
        whole = ca.SX.zeros(3 + m)
        if fixed:
            whole[fixed] = imposed[[i - 3 for i in fixed]]
        whole[free] = ca.solve(matrix[free, free], right_hand_side - (matrix @ whole)[free])
        return whole

    velocity = completed(par["rate"] + par["acceleration"] * tau, z_momenta)
    p_now, _, f_now, drift = mechanics(position, velocity, p)
    errors = z[[1, 2]] - par["references"]
    kp, ki, kd = (par["gains"][[i, i + 3]] for i in range(3))
    control = par["constant_control"] - kp * errors - ki * z[6:8] - kd * velocity[[1, 2]]
    if ideal:
        control = ca.SX.zeros(2)
    thrust = ca.vertcat(-ca.sin(z[2]) * control[0], ca.cos(z[2]) * control[0], control[1])
    push = ca.vertcat(f_now[:3] + thrust, f_now[3:])
    if driven:
        push[joints] += torque
    acceleration = completed(par["acceleration"], (push - drift)[free])
    derivative = ca.vertcat(
        *(velocity[:3], push[:3], errors, thrust, f_now[3:]), *(velocity[joints], push[joints])
    )
    report = [velocity, acceleration, p_now, control, *observed(position, velocity, p), position]

    def compiled(name: str, arguments: list[ca.SX], results: Any) -> _Fast:
        dense = [ca.densify(result) for result in results]
        return _Fast(ca.Function(name, arguments, dense, {"cse": True}))

    return _Model(
        derivative=compiled("derivative", [z, tau, p], [derivative]),
        report=compiled("report", [z, tau, p], report),
        gap=compiled("gap", [z, tau, p], gaps(position, velocity, acceleration, p)),
        momenta=compiled("momenta", [q, qd, p], [momenta]),
    )


@dataclass
class _Integrator:
    """DOP853 over one smooth piece after another; switches of the support are events."""

    model: _Model
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
    sizes = _layout(n, m)
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
        model = _model(*structure, u.grasp, ideal)
        supported = u.grasp and support is not None and support.stiffness > 0
        # The inertia of a light link on a free joint makes small errors of momenta large ones of
        # rates: tolerances alone do not see to that.
        max_step = 2.5e-4 if driven else CONTACT_STEP
        integrator = _Integrator(model, p, offsets["contact"], supported, rtol, atol, max_step)

        # Before the jump.  A payload being taken over is at rest, one being let go keeps its own
        # momentum: in both cases only a payload held before and after adds to the momenta.
        through = _model(*structure, held and u.grasp, ideal)
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
