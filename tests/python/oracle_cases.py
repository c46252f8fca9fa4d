"""What the checks of the reference integration have in common."""

from __future__ import annotations

from typing import Any

import numpy as np

from oracle_data import (
    Autopilot,
    Counterweight,
    Gains,
    Link,
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
