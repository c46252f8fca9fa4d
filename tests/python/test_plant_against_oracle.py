"""The plant FMU against the reference integration, over random cases of 5 s and 2 s."""

from __future__ import annotations

import numpy as np
import pytest

from conftest import ALL, EVERY_LENGTH, FULL, Structure, build
from fmu_run import fmu_table
from oracle_data import Array
from random_cases import MODES, PAYLOADS, Case, oracle_table, random_case

STRUCTURES = ALL if FULL else EVERY_LENGTH
COMBINATIONS = len(MODES) * len(PAYLOADS)
SEEDS = range(COMBINATIONS * (20 if FULL else 2))
# Durations [s]; the first cases of each combination are long.
LONG, SHORT = 5.0, 2.0
LONG_SEEDS = COMBINATIONS * (4 if FULL else 1)

# Bounds: (smooth, with contact), for series up to 1 in SI units; they grow with the largest value,
# for some vehicles without control fall and tumble.  The plant's error shows amplified by gains and
# stiffness in accelerations and controls, and divided by the step in the means, which are
# differences of momenta.
BOUNDS = {
    "position": (1e-10, 1e-9),
    "velocity": (1e-9, 1e-8),
    "momentum": (1e-9, 1e-8),
    "acceleration": (1e-7, 1e-6),
    "force": (1e-7, 1e-6),
    "exact": (0.0, 0.0),
}
KINDS = {
    "position": {
        *("base.x", "base.y", "base.roll", "position", "end_effector.x", "end_effector.y"),
        *("center_of_mass.x", "center_of_mass.y"),
    },
    "velocity": {
        *("base.vx", "base.vy", "base.roll_rate", "rate", "end_effector.vx", "end_effector.vy")
    },
    "acceleration": {"base.ax", "base.ay", "base.roll_acceleration"},
    "momentum": {"momentum.x", "momentum.y", "momentum.angular"},
    "force": {
        *("autopilot.thrust", "autopilot.torque", "torque", "force", "support.force"),
        *("transmitted.force_x", "transmitted.force_y", "transmitted.moment"),
    },
    "exact": {"payload.attached"},
}


def kind_of(name: str) -> str:
    """Kind of an output; those of coordinates go by their last part."""
    coordinates = ("joint[", "counterweight.", "balance_element.")
    key = name.rsplit(".", 1)[1] if name.startswith(coordinates) else name
    return next(kind for kind, names in KINDS.items() if key in names)


def compare(case: Case, plant: dict[str, Array], oracle: dict[str, Array]) -> list[str]:
    """One line for each output that misses its bound."""
    misses = []
    for name, expected in oracle.items():
        bound = BOUNDS[kind_of(name)][case.has_contact] * max(1.0, float(np.max(np.abs(expected))))
        error = np.abs(plant[name] - expected)
        if not np.all(error <= bound):  # also where an error is not a number
            first = int(np.argmax(~(error <= bound)))
            misses.append(
                f"{name}: error {np.max(error):.3g} above {bound:.3g}, first in step "
                f"{first}: {plant[name][first]!r} instead of {expected[first]!r}"
            )
    return misses


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_plant(structure: Structure, seed: int) -> None:
    duration = LONG if seed < LONG_SEEDS else SHORT
    # Seeds differ from one structure to the next, so that all together see more vehicles.
    seed += COMBINATIONS * 1000 * STRUCTURES.index(structure)
    case = random_case(seed, links=structure.links, balance=structure.balance, duration=duration)
    oracle = oracle_table(case)
    misses = compare(case, fmu_table(build(structure).plant, case, list(oracle)), oracle)
    assert not misses, "\n".join([case.name, *misses])


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("structure", STRUCTURES, ids=str)
def test_plant_with_joints_driven_by_torques(structure: Structure, seed: int) -> None:
    """Some joints have torques that change within the steps, some turn freely.

    Long arms that whip about on free joints are chaotic: rounding grows tenfold in 0.1 s, and
    after 0.6 s the reference differs by 1e-9 rad from itself at another tolerance.
    """
    seed += COMBINATIONS * (1000 * STRUCTURES.index(structure) + 500)
    case = random_case(
        seed,
        links=structure.links,
        balance=structure.balance,
        duration=0.6 if structure.links < 5 else 0.2,
        driven=True,
    )
    oracle = oracle_table(case)
    misses = compare(case, fmu_table(build(structure).plant, case, list(oracle)), oracle)
    assert not misses, "\n".join([case.name, *misses])


@pytest.mark.parametrize("payload", PAYLOADS)
@pytest.mark.parametrize("mode", MODES)
def test_random_cases_are_worth_running(mode: str, payload: str) -> None:
    """The cases move, switch and stay within sane bounds."""
    switches = 0
    for seed in range(3):
        table = oracle_table(random_case(seed, mode=mode, payload=payload))
        assert all(np.all(np.isfinite(column)) for column in table.values())
        # Without control, the thrust beside the system's centre of mass lets the vehicle tumble.
        assert np.max(np.abs(table["base.roll"])) < (40.0 if mode == "external" else 20.0)
        assert np.max(np.abs(table["base.x"])) > 1e-4
        touching = table["support.force"] > 0
        switches += int(np.sum(touching[1:] != touching[:-1]))
        assert np.any(table["payload.attached"]) == (payload != "none")
    assert (switches > 3) == (payload == "support")
