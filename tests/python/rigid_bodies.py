"""The vehicle in other people's rigid-body programs: MuJoCo, Pinocchio and, where installed, Drake.

Each gets nothing but the list of bodies and joints.  Their worlds are three-dimensional: x to the
right, z up, and turning counter-clockwise in that plane is turning about -y.
Coordinates are (x, y, roll, joints, what balances the arm) as everywhere; all in SI units.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from oracle_data import Array, BalanceElement, Counterweight, Payload, Vehicle

UP = (0.0, 0.0, 1.0)
RIGHT = (1.0, 0.0, 0.0)
TURN = (0.0, -1.0, 0.0)
# MuJoCo insists on some inertia and mass, also of a point mass and of a disc without mass.
LITTLE = 1e-14


@dataclass(frozen=True)
class Body:
    """A body, moved against its parent by a joint at `place` in the parent's frame.

    The body's frame has its origin at the joint and is parallel to the parent's at position 0.
    """

    name: str
    parent: str | None
    place: tuple[float, float]
    slides: tuple[float, float, float] | None
    mass: float
    com: tuple[float, float]
    inertia: float


def bodies(vehicle: Vehicle) -> Iterator[Body]:
    """All bodies with a joint, parents first; a held payload is part of the last link."""
    yield Body("uav", None, (0.0, 0.0), None, vehicle.uav_mass, (0.0, 0.0), vehicle.uav_inertia)
    parent, place = "uav", (vehicle.mount_x, vehicle.mount_y)
    for i, link in enumerate(vehicle.links, start=1):
        yield Body(f"link{i}", parent, place, None, link.mass, (0.0, -link.com), link.inertia)
        parent, place = f"link{i}", (0.0, -link.length)
    balance, middle = vehicle.balance, (0.0, 0.0)
    if isinstance(balance, Counterweight):
        at = (0.0, balance.height)
        yield Body("balance", "uav", at, RIGHT, balance.mass, middle, balance.inertia)
    elif isinstance(balance, BalanceElement):
        com = (0.0, -balance.com)
        yield Body("balance", "uav", middle, None, balance.mass, com, balance.inertia)


class Dynamics(Protocol):
    """Inverse dynamics by somebody else."""

    def forces(self, q: Array, v: Array, a: Array) -> Array:
        """Generalized forces that, beside gravity, let the system accelerate by `a`."""

    def mass_matrix(self, q: Array) -> Array:
        """Generalized inertia."""

    def pushed(self, q: Array, distance: float, force: Array, torque: float) -> Array:
        """Generalized forces of a load on the last link, `distance` from its joint."""


class MuJoCo:
    def __init__(self, vehicle: Vehicle, payload: Payload | None, gravity: float) -> None:
        import mujoco

        self._mujoco = mujoco
        spec = mujoco.MjSpec()
        spec.option.gravity = [0.0, 0.0, -gravity]
        spec.option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONTACT
        made = {None: spec.worldbody}
        for body in bodies(vehicle):
            x, y = body.place
            new = made[body.parent].add_body(name=body.name, pos=[x, 0.0, y])
            new.explicitinertial = True
            new.mass, new.ipos = max(body.mass, LITTLE), [body.com[0], 0.0, body.com[1]]
            new.inertia = [body.inertia] * 3
            made[body.name] = new
            slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
            if body.parent is None:
                new.add_joint(type=slide, axis=RIGHT)
                new.add_joint(type=slide, axis=UP)
            if body.slides:
                new.add_joint(type=slide, axis=body.slides)
            else:
                new.add_joint(type=hinge, axis=TURN)
        self._tip = f"link{len(vehicle.links)}"
        if payload:
            point = made[self._tip].add_body(name="payload", pos=[0.0, 0.0, -payload.com])
            point.explicitinertial = True
            point.ipos = [0.0] * 3
            point.mass, point.inertia = payload.mass, [LITTLE] * 3
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._link = self._model.body(self._tip).id

    def forces(self, q: Array, v: Array, a: Array) -> Array:
        self._data.qpos, self._data.qvel, self._data.qacc = q, v, a
        self._mujoco.mj_inverse(self._model, self._data)
        return self._data.qfrc_inverse.copy()

    def mass_matrix(self, q: Array) -> Array:
        self._at(q)
        size = self._model.nv
        columns = np.zeros((size, size))
        for column, unit in zip(columns, np.eye(size)):
            self._mujoco.mj_mulM(self._model, self._data, column, unit)
        return columns

    def pushed(self, q: Array, distance: float, force: Array, torque: float) -> Array:
        self._at(q)
        place = self._data.body(self._link).xpos + self._data.body(self._link).xmat.reshape(
            3, 3
        ) @ [0.0, 0.0, -distance]
        result = np.zeros(self._model.nv)
        self._mujoco.mj_applyFT(
            self._model,
            self._data,
            np.array([force[0], 0.0, force[1]]),
            np.multiply(torque, TURN),
            place,
            self._link,
            result,
        )
        return result

    def _at(self, q: Array) -> None:
        self._data.qpos, self._data.qvel = q, 0.0
        self._mujoco.mj_fwdPosition(self._model, self._data)


class Pinocchio:
    def __init__(self, vehicle: Vehicle, payload: Payload | None, gravity: float) -> None:
        import pinocchio

        self._pin = pin = pinocchio
        self._model = model = pin.Model()
        model.gravity.linear = np.array([0.0, 0.0, -gravity])
        made: dict[str | None, int] = {}

        def joint(parent: int, kind: object, place: tuple[float, float], name: str) -> int:
            at = pin.SE3(np.eye(3), np.array([place[0], 0.0, place[1]]))
            return model.addJoint(parent, kind, at, name)

        def inertia(mass: float, com: tuple[float, float], about: float) -> object:
            return pin.Inertia(mass, np.array([com[0], 0.0, com[1]]), about * np.eye(3))

        hinge = pin.JointModelRevoluteUnaligned(np.array(TURN))
        for body in bodies(vehicle):
            if body.parent is None:
                right = joint(0, pin.JointModelPX(), (0.0, 0.0), "x")
                parent = joint(right, pin.JointModelPZ(), (0.0, 0.0), "y")
            else:
                parent = made[body.parent]
            kind = pin.JointModelPX() if body.slides else hinge
            made[body.name] = joint(parent, kind, body.place, body.name)
            model.appendBodyToJoint(
                made[body.name], inertia(body.mass, body.com, body.inertia), pin.SE3.Identity()
            )
        self._link = made[f"link{len(vehicle.links)}"]
        if payload:
            point = inertia(payload.mass, (0.0, -payload.com), 0.0)
            model.appendBodyToJoint(self._link, point, pin.SE3.Identity())
        self._data = model.createData()

    def forces(self, q: Array, v: Array, a: Array) -> Array:
        return np.array(self._pin.rnea(self._model, self._data, q, v, a))

    def mass_matrix(self, q: Array) -> Array:
        upper = np.triu(self._pin.crba(self._model, self._data, q))
        return upper + np.triu(upper, 1).T

    def pushed(self, q: Array, distance: float, force: Array, torque: float) -> Array:
        pin = self._pin
        pin.computeJointJacobians(self._model, self._data, q)
        turn = self._data.oMi[self._link].rotation
        lever = turn @ np.array([0.0, 0.0, -distance])
        jacobian = pin.getJointJacobian(
            self._model, self._data, self._link, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        )
        push = np.array([force[0], 0.0, force[1]])
        moment = np.cross(lever, push) + np.multiply(torque, TURN)
        return jacobian.T @ np.concatenate([push, moment])


class Drake:
    def __init__(self, vehicle: Vehicle, payload: Payload | None, gravity: float) -> None:
        from pydrake.math import RigidTransform
        from pydrake.multibody import plant, tree

        self._tree = tree
        self._plant = system = plant.MultibodyPlant(time_step=0.0)
        system.mutable_gravity_field().set_gravity_vector([0.0, 0.0, -gravity])

        def inertia(mass: float, com: tuple[float, float], about: float) -> object:
            at = np.array([com[0], 0.0, com[1]])
            return tree.SpatialInertia.MakeFromCentralInertia(
                mass, at, tree.RotationalInertia(about, about, about)
            )

        def place(at: tuple[float, float]) -> RigidTransform:
            return RigidTransform([at[0], 0.0, at[1]])

        here = RigidTransform()
        made = {None: system.world_body()}
        nothing = tree.SpatialInertia.Zero()
        joints = []
        for body in bodies(vehicle):
            parent, at = made[body.parent], place(body.place)
            if body.parent is None:
                for name, axis in (("x", RIGHT), ("y", UP)):
                    child = system.AddRigidBody(name, nothing)
                    joint = tree.PrismaticJoint(
                        name, _frame(system, parent, at), child.body_frame(), axis
                    )
                    joints.append(system.AddJoint(joint))
                    parent, at = child, here
            child = system.AddRigidBody(body.name, inertia(body.mass, body.com, body.inertia))
            frame = _frame(system, parent, at)
            if body.slides:
                joint = tree.PrismaticJoint(body.name, frame, child.body_frame(), body.slides)
            else:
                joint = tree.RevoluteJoint(body.name, frame, child.body_frame(), TURN)
            joints.append(system.AddJoint(joint))
            made[body.name] = child
        self._link = made[f"link{len(vehicle.links)}"]
        if payload:
            point = inertia(payload.mass, (0.0, -payload.com), 0.0)
            load = system.AddRigidBody("payload", point)
            system.WeldFrames(self._link.body_frame(), load.body_frame())
        system.Finalize()
        self._context = system.CreateDefaultContext()
        # Drake may order coordinates its own way.
        self._order = [joint.velocity_start() for joint in joints]

    def _put(self, values: Array) -> Array:
        result = np.zeros(len(self._order))
        result[self._order] = values
        return result

    def forces(self, q: Array, v: Array, a: Array) -> Array:
        system, context = self._plant, self._context
        system.SetPositions(context, self._put(q))
        system.SetVelocities(context, self._put(v))
        loads = self._tree.MultibodyForces(system)
        system.CalcForceElementsContribution(context, loads)
        return system.CalcInverseDynamics(context, self._put(a), loads)[self._order]

    def mass_matrix(self, q: Array) -> Array:
        self._plant.SetPositions(self._context, self._put(q))
        return self._plant.CalcMassMatrix(self._context)[np.ix_(self._order, self._order)]

    def pushed(self, q: Array, distance: float, force: Array, torque: float) -> Array:
        system, context, world = self._plant, self._context, self._plant.world_frame()
        system.SetPositions(context, self._put(q))
        jacobian = system.CalcJacobianSpatialVelocity(
            context,
            self._tree.JacobianWrtVariable.kV,
            self._link.body_frame(),
            np.array([0.0, 0.0, -distance]),
            world,
            world,
        )
        push = np.concatenate([np.multiply(torque, TURN), [force[0], 0.0, force[1]]])
        return (jacobian.T @ push)[self._order]


def _frame(system: object, body: object, at: object) -> object:
    """A frame fixed to a body."""
    from pydrake.multibody.tree import FixedOffsetFrame

    count = system.num_frames()
    return system.AddFrame(FixedOffsetFrame(f"at{count}", body.body_frame(), at))
