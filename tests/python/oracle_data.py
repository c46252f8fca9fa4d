"""Plain data of the planar aerial manipulator: vehicle, autopilot, inputs, outputs (SI units)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Link:
    """Arm link; `com` is the distance of its centre of mass from its joint."""

    mass: float
    length: float
    com: float
    inertia: float


@dataclass(frozen=True)
class Counterweight:
    """Body sliding along the UAV's x axis at the given height; it does not turn on the UAV."""

    mass: float
    inertia: float
    height: float
    start: float = 0.0


@dataclass(frozen=True)
class BalanceElement:
    """Body turning about the UAV's centre of mass, at angle 0 hanging below it in the UAV frame."""

    mass: float
    inertia: float  # about its own centre of mass
    com: float
    start: float = 0.0


@dataclass(frozen=True)
class Vehicle:
    """UAV (frame origin at its centre of mass), first joint's place, arm, what balances it."""

    uav_mass: float
    uav_inertia: float
    mount_x: float
    mount_y: float
    links: tuple[Link, ...]
    balance: Counterweight | BalanceElement | None = None

    @property
    def mass(self) -> float:
        """Total mass without payload."""
        balance = self.balance.mass if self.balance else 0.0
        return self.uav_mass + sum(link.mass for link in self.links) + balance


@dataclass(frozen=True)
class Gains:
    kp: float = 0.0
    ki: float = 0.0
    kd: float = 0.0


@dataclass(frozen=True)
class Autopilot:
    """`mode` is one of "pid", "sampled", "external", "ideal"; `sample_time` serves "sampled"."""

    mode: str
    altitude: Gains = Gains()
    roll: Gains = Gains()
    sample_time: float = 0.0


@dataclass(frozen=True)
class Payload:
    """Point mass, held at distance `com` from the last joint along the last link."""

    mass: float
    com: float


@dataclass(frozen=True)
class Support:
    """One-sided vertical spring pushing the held payload up while it is below `height`."""

    stiffness: float
    height: float


@dataclass(frozen=True)
class StepInputs:
    """Inputs held during one communication step; rates are `rate + acceleration * (t - t_k)`.

    Joints with a torque have that torque instead of a rate; torques change by their slopes.
    """

    joint_rates: tuple[float, ...]
    joint_accelerations: tuple[float, ...] = ()
    balance_rate: float = 0.0
    balance_acceleration: float = 0.0
    grasp: bool = False
    altitude_reference: float = 0.0
    roll_reference: float = 0.0
    thrust_feedforward: float = 0.0
    thrust_command: float = 0.0
    torque_command: float = 0.0
    base_force: tuple[float, float] = (0.0, 0.0)
    base_torque: float = 0.0
    end_effector_force: tuple[float, float] = (0.0, 0.0)
    end_effector_torque: float = 0.0
    joint_torques: tuple[float | None, ...] = ()
    joint_torque_slopes: tuple[float, ...] = ()


@dataclass(frozen=True)
class StepOutput:
    """Left limits at the end of a step, triples being (x, y, roll).

    Coordinates are the joints, then what balances the arm.  `transmitted` (force and moment about
    the UAV's centre of mass which everything carried exerts on the UAV), `motors` and, in ideal
    mode, thrust and torque are means over the step, with the impulses at its start.
    """

    time: float
    pose: Array
    velocity: Array
    acceleration: Array
    coordinates: Array
    rates: Array
    end_effector: Array
    end_effector_velocity: Array
    thrust: float
    torque: float
    momentum: Array
    angular_momentum: float  # about the UAV's centre of mass, with absolute velocities
    center_of_mass: Array
    support_force: float
    payload_attached: bool
    transmitted: Array
    motors: Array
    kinetic_energy: float
    potential_energy: float
