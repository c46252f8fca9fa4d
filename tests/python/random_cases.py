"""Seeded random cases for the planar aerial manipulator, and their names in an FMU."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import numpy as np

from oracle import simulate
from oracle_data import (
    Array,
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

TYPICAL_LINK = Link(mass=1.0, length=0.13, com=0.065, inertia=6e-4)
ALTITUDE_GAINS = (Gains(37.0, 8.0, 18.0), Gains(1000.0, 500.0, 500.0))
STIFF_ROLL_GAINS = Gains(600.0, 500.0, 30.0)
MODES = ("pid", "sampled", "external", "ideal")
FMI_MODES = {"pid": 1, "sampled": 1, "ideal": 2, "external": 3}
PAYLOADS = ("none", "free", "support")
BALANCES = ("none", "counterweight", "balance_element")

Value = float | int | bool


@dataclass(frozen=True)
class Case:
    """One simulation from rest: everything `simulate` and an FMU need."""

    name: str
    vehicle: Vehicle
    autopilot: Autopilot
    payload: Payload | None
    support: Support | None
    gravity: float
    joint_start: tuple[float, ...]
    steps: tuple[tuple[float, StepInputs], ...]

    @property
    def has_contact(self) -> bool:
        return self.support is not None


def random_vehicle(random: np.random.Generator, n: int, kind: str) -> Vehicle:
    """Typical values in one case of three, else values spread around them."""
    u = random.uniform
    mount = u(-0.08, 0.08), u(-0.1, 0.05)
    balance: Counterweight | BalanceElement | None = None
    if kind == "counterweight":
        balance = Counterweight(u(0.3, 1.5), u(1e-3, 5e-3), u(-0.1, 0.1), u(-0.05, 0.05))
    elif kind == "balance_element":
        disc = random.random() < 1 / 3
        balance = BalanceElement(
            0.0 if disc else u(0.3, 1.5), u(1e-3, 1e-2), u(-0.1, 0.2), u(-3, 3)
        )
    if random.random() < 1 / 3:
        return Vehicle(4.2, 0.4097, *mount, (TYPICAL_LINK,) * n, balance)
    links = []
    for _ in range(n):
        mass, length = u(0.2, 1.2), u(0.08, 0.25)
        links.append(Link(mass, length, length * u(0.2, 0.8), mass * length**2 / 12 * u(0.5, 1.5)))
    return Vehicle(u(2.5, 6.0), u(0.2, 0.6), *mount, tuple(links), balance)


def random_motion(
    random: np.random.Generator,
    count: int,
    step: float,
    start: float,
    top_rate: float,
    limit: float,
    accelerated: bool,
) -> tuple[Array, Array, Array]:
    """Rate and acceleration commands, and positions at the start of each step, of a coordinate.

    Rates hold for 10 to 100 ms and jump then; acceleration commands either continue from one
    step to the next or start over at the same rate in each step.
    """
    rates, accelerations, positions = np.zeros(count), np.zeros(count), np.zeros(count)
    position, k = start, 0
    while k < count:
        hold = max(1, round(random.uniform(0.01, 0.1) / step))
        rate = random.uniform(-top_rate, top_rate)
        if abs(position) > limit:
            rate = -math.copysign(rate, position)
        acceleration = random.uniform(-5.0, 5.0) * top_rate if accelerated else 0.0
        continued = random.random() < 0.5
        for _ in range(min(hold, count - k)):
            positions[k], rates[k], accelerations[k] = position, rate, acceleration
            position += rate * step + acceleration * step**2 / 2
            rate += acceleration * step if continued else 0.0
            k += 1
    return rates, accelerations, positions


def random_levels(random: np.random.Generator, count: int, top: float) -> Array:
    """Piecewise constant values of up to `top`."""
    levels = np.zeros(count)
    k = 0
    while k < count:
        hold = int(random.integers(3, 25))
        levels[k : k + hold] = random.uniform(-top, top)
        k += hold
    return levels


def random_torques(
    random: np.random.Generator, count: int, n: int
) -> tuple[list[Array | None], list[Array | None]]:
    """Torques, and their slopes, of one joint at least; some turn freely.

    Motors are as strong as the part of the arm is long that they move.
    """
    torques: list[Array | None] = []
    slopes: list[Array | None] = []
    always = int(random.integers(n))
    for i in range(n):
        driven = i == always or random.random() < 0.4
        strength = 0.0 if random.random() < 0.3 else 0.3 * (n - i) / n
        torques.append(random_levels(random, count, strength) if driven else None)
        slopes.append(random_levels(random, count, 15.0 * strength) if driven else None)
    return torques, slopes


def random_grasp(random: np.random.Generator, count: int) -> list[bool]:
    """Held from the start or taken over later; mostly let go again, sometimes twice."""
    changes = sorted(random.choice(np.arange(1, count), size=4, replace=False))
    changes = changes[: int(random.integers(0, 5))]
    first = bool(random.random() < 0.5) or not changes
    return [
        bool(first ^ (np.searchsorted(changes, k, side="right") % 2 == 1)) for k in range(count)
    ]


def _payload_height(vehicle: Vehicle, payload: Payload, angles: Array) -> float:
    absolute = np.cumsum(angles)
    lengths = [link.length for link in vehicle.links[:-1]] + [payload.com]
    return vehicle.mount_y - float(np.dot(lengths, np.cos(absolute)))


def random_case(
    seed: int,
    *,
    links: int | None = None,
    balance: str | None = None,
    mode: str | None = None,
    payload: str | None = None,
    duration: float = 2.0,
    driven: bool = False,
) -> Case:
    """Random case; what is given is kept, the rest follows from the seed.

    `balance` is one of BALANCES, `mode` one of MODES, `payload` one of PAYLOADS; `driven`: some
    joints are driven by torques.
    """
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 7))
    n = n if links is None else links
    balance = balance or BALANCES[int(random.integers(3))]
    mode = mode or MODES[seed % len(MODES)]
    payload = payload or PAYLOADS[seed // len(MODES) % len(PAYLOADS)]
    vehicle = random_vehicle(random, n, balance)
    step = float(random.choice([0.01, 0.01, 0.01, 0.005, 0.02]))
    count = round(duration / step)

    soft_roll = Gains(40.0, 35.0, random.uniform(3.0, 9.0))
    sample_time = float(random.choice([0.005, 0.01, 0.02, 0.007])) if mode == "sampled" else 0.0
    pilot = Autopilot(
        mode,
        ALTITUDE_GAINS[random.integers(2)],
        STIFF_ROLL_GAINS if random.random() < 0.5 else soft_roll,
        sample_time,
    )
    if pilot.sample_time > 0.01:  # the stiff gains are unstable when held that long
        pilot = Autopilot(mode, ALTITUDE_GAINS[0], soft_roll, pilot.sample_time)

    start = random.uniform(-0.8, 0.8, n)
    accelerated = bool(random.random() < 0.5)
    top_rate = random.uniform(0.5, 2.0)
    joints = [random_motion(random, count, step, q, top_rate, 1.2, accelerated) for q in start]
    balance_start = vehicle.balance.start if vehicle.balance else 0.0
    reach = (0.3, 0.1) if balance == "counterweight" else (2.0, 4.0)
    moved = random_motion(random, count, step, balance_start, *reach, accelerated)
    grasp = random_grasp(random, count) if payload != "none" else [False] * count
    load = None
    support = None
    if payload != "none":
        mass, share = random.uniform(0.1, 0.8), random.uniform(0.5, 1.2)
        load = Payload(mass, vehicle.links[-1].length * share)
    if load and payload == "support":
        taken = grasp.index(True)
        height = _payload_height(vehicle, load, np.array([joint[2][taken] for joint in joints]))
        support = Support(
            float(random.choice([1000.0, random.uniform(300.0, 2000.0)])),
            height + random.uniform(-0.015, 0.01),
        )

    def levels(top: float) -> Array:
        return random_levels(random, count, top)

    gravity = 9.81 if random.random() < 0.8 else float(random.uniform(0.0, 9.81))
    open_loop = mode == "external"
    disturbed = 1.0 if random.random() < 0.6 else 0.0
    thrust = vehicle.mass * gravity * (1 + levels(0.2)) if open_loop else np.zeros(count)
    torque = levels(0.3) if open_loop else np.zeros(count)
    altitude, roll, feedforward = levels(0.1), levels(0.1), levels(2.0)
    forces = [disturbed * levels(top) for top in (2.0, 2.0, 0.2, 1.5, 1.5, 0.1)]
    torques, torque_slopes = random_torques(random, count, n) if driven else ([], [])
    steps = []
    for k in range(count):
        fx, fy, torque_on_base, tip_x, tip_y, tip_torque = (float(f[k]) for f in forces)
        steps.append(
            (
                step,
                StepInputs(
                    joint_rates=tuple(float(joint[0][k]) for joint in joints),
                    joint_accelerations=tuple(float(joint[1][k]) for joint in joints),
                    joint_torques=tuple(
                        None if torque is None else float(torque[k]) for torque in torques
                    ),
                    joint_torque_slopes=tuple(
                        0.0 if slope is None else float(slope[k]) for slope in torque_slopes
                    ),
                    balance_rate=float(moved[0][k]) if vehicle.balance else 0.0,
                    balance_acceleration=float(moved[1][k]) if vehicle.balance else 0.0,
                    grasp=grasp[k],
                    altitude_reference=float(altitude[k]),
                    roll_reference=float(roll[k]),
                    thrust_feedforward=float(feedforward[k]),
                    thrust_command=float(thrust[k]),
                    torque_command=float(torque[k]),
                    base_force=(fx, fy),
                    base_torque=torque_on_base,
                    end_effector_force=(tip_x, tip_y),
                    end_effector_torque=tip_torque,
                ),
            )
        )
    name = f"{seed}-{mode}-{n}-{balance}-{payload}{'-driven' if driven else ''}"
    return Case(
        name, vehicle, pilot, load, support, gravity, tuple(map(float, start)), tuple(steps)
    )


def fmi_parameters(case: Case) -> dict[str, Value]:
    """Parameters by FMI variable name."""
    v, pilot = case.vehicle, case.autopilot
    values: dict[str, Value] = {
        "gravity": case.gravity,
        "uav.mass": v.uav_mass,
        "uav.inertia": v.uav_inertia,
        "mount.x": v.mount_x,
        "mount.y": v.mount_y,
        "autopilot.mode": FMI_MODES[pilot.mode],
        "autopilot.sample_time": pilot.sample_time,
        "support.stiffness": case.support.stiffness if case.support else 0.0,
        "support.height": case.support.height if case.support else 0.0,
    }
    for axis, gains in (("altitude", pilot.altitude), ("roll", pilot.roll)):
        for gain in ("kp", "ki", "kd"):
            values[f"autopilot.{axis}.{gain}"] = getattr(gains, gain)
    for i, (link, start) in enumerate(zip(v.links, case.joint_start), start=1):
        for quantity in ("mass", "length", "com", "inertia"):
            values[f"link[{i}].{quantity}"] = getattr(link, quantity)
        values[f"joint[{i}].start"] = start
    for i, torque in enumerate(case.steps[0][1].joint_torques, start=1):
        values[f"joint[{i}].actuation"] = 1 if torque is None else 2
    if v.balance:
        values |= {f"{balance_name(v)}.{name}": value for name, value in asdict(v.balance).items()}
    if case.payload:
        values |= {"payload.mass": case.payload.mass, "payload.com": case.payload.com}
    return values


def balance_name(vehicle: Vehicle) -> str:
    """First part of the names of the variables of what balances the arm."""
    return "counterweight" if isinstance(vehicle.balance, Counterweight) else "balance_element"


def fmi_inputs(case: Case, inputs: StepInputs) -> dict[str, Value]:
    """Inputs of one step by FMI variable name."""
    u = inputs
    values: dict[str, Value] = {
        "grasp": u.grasp,
        "autopilot.altitude_reference": u.altitude_reference,
        "autopilot.roll_reference": u.roll_reference,
        "autopilot.thrust_feedforward": u.thrust_feedforward,
        "autopilot.thrust_command": u.thrust_command,
        "autopilot.torque_command": u.torque_command,
        "base.external_force_x": u.base_force[0],
        "base.external_force_y": u.base_force[1],
        "base.external_torque": u.base_torque,
        "end_effector.external_force_x": u.end_effector_force[0],
        "end_effector.external_force_y": u.end_effector_force[1],
        "end_effector.external_torque": u.end_effector_torque,
    }
    accelerations = u.joint_accelerations or (0.0,) * len(u.joint_rates)
    for i, (rate, acceleration) in enumerate(zip(u.joint_rates, accelerations), start=1):
        values[f"joint[{i}].rate_command"] = rate
        values[f"joint[{i}].acceleration_command"] = acceleration
    for i, torque in enumerate(u.joint_torques, start=1):
        values[f"joint[{i}].torque_command"] = torque or 0.0
    if case.vehicle.balance:
        name = balance_name(case.vehicle)
        values[f"{name}.rate_command"] = u.balance_rate
        values[f"{name}.acceleration_command"] = u.balance_acceleration
    return values


def fmi_slopes(inputs: StepInputs) -> dict[str, float]:
    """First derivatives of inputs in one step, where they are not zero, by FMI variable name."""
    slopes = enumerate(inputs.joint_torque_slopes, start=1)
    return {f"joint[{i}].torque_command": slope for i, slope in slopes if slope}


def fmi_outputs(vehicle: Vehicle, out: StepOutput) -> dict[str, Value]:
    """Outputs of one step by FMI variable name."""
    n = len(vehicle.links)
    values: dict[str, Value] = dict(
        zip(
            (
                "base.x",
                "base.y",
                "base.roll",
                "base.vx",
                "base.vy",
                "base.roll_rate",
                "base.ax",
                "base.ay",
                "base.roll_acceleration",
            ),
            np.concatenate([out.pose, out.velocity, out.acceleration]),
        )
    )
    for i in range(n):
        values[f"joint[{i + 1}].position"] = out.coordinates[i]
        values[f"joint[{i + 1}].rate"] = out.rates[i]
        values[f"joint[{i + 1}].torque"] = out.motors[i]
    if vehicle.balance:
        name = balance_name(vehicle)
        values[f"{name}.position"] = out.coordinates[n]
        values[f"{name}.rate"] = out.rates[n]
        values[f"{name}.{'force' if name == 'counterweight' else 'torque'}"] = out.motors[n]
    for prefix, names, entries in (
        ("end_effector", ("x", "y"), out.end_effector),
        ("end_effector", ("vx", "vy"), out.end_effector_velocity),
        ("transmitted", ("force_x", "force_y", "moment"), out.transmitted),
        ("momentum", ("x", "y"), out.momentum),
        ("center_of_mass", ("x", "y"), out.center_of_mass),
    ):
        values |= {f"{prefix}.{name}": entry for name, entry in zip(names, entries)}
    return values | {
        "momentum.angular": out.angular_momentum,
        "autopilot.thrust": out.thrust,
        "autopilot.torque": out.torque,
        "payload.attached": out.payload_attached,
        "support.force": out.support_force,
    }


def oracle_table(case: Case) -> dict[str, Array]:
    """Outputs of the reference integration: one array over the steps per FMI variable name."""
    outputs = simulate(
        case.vehicle,
        case.autopilot,
        case.payload,
        case.support,
        case.gravity,
        case.joint_start,
        case.steps,
    )
    rows = [fmi_outputs(case.vehicle, out) for out in outputs]
    return {name: np.array([row[name] for row in rows], dtype=float) for name in rows[0]}
