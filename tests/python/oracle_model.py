"""Equations of motion of a planar aerial manipulator from its Lagrangian (test oracle).

Only the Lagrangian is written down by hand.  Momenta, inertia matrix and generalised forces come
from automatic differentiation (CasADi).  All quantities are in SI units.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import casadi as ca
import numpy as np

from oracle_data import Array, Counterweight


def layout(n: int, m: int) -> dict[str, int]:
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


class Fast:
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
class Model:
    """Compiled functions of one structure."""

    derivative: Fast  # (z, tau, p) -> dz
    report: Fast  # (z, tau, p) -> the quantities listed at its creation
    gap: Fast  # (z, tau, p) -> support height minus payload height, two derivatives
    momenta: Fast  # (Q, Qd, p) -> dL/dQd


@cache
def equations(
    n: int, balance: type | None, driven: tuple[int, ...], held: bool, ideal: bool
) -> Model:
    """Derive and compile the equations of one structure from its Lagrangian.

    State z: base (x, y, roll), conjugate base momenta, integrals of the two control errors,
    impulse of thrust (x, y, moment), integrals of dL/dq + Q for each coordinate, positions of the
    driven joints, their conjugate momenta.
    In ideal mode the y and roll momenta in z leave out the reactions (thrust, torque).
    """
    m = n + (balance is not None)
    sizes = layout(n, m)
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

    def compiled(name: str, arguments: list[ca.SX], results: Any) -> Fast:
        dense = [ca.densify(result) for result in results]
        return Fast(ca.Function(name, arguments, dense, {"cse": True}))

    return Model(
        derivative=compiled("derivative", [z, tau, p], [derivative]),
        report=compiled("report", [z, tau, p], report),
        gap=compiled("gap", [z, tau, p], gaps(position, velocity, acceleration, p)),
        momenta=compiled("momenta", [q, qd, p], [momenta]),
    )
