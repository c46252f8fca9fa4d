"""Goes on from a saved state, in this process or another, with recorded calls.

    python continuation.py RECORD

RECORD is a file with a pickled `Record`; all outputs after every step are printed, bit by bit.
"""

from __future__ import annotations

import pickle
import sys
from dataclasses import dataclass
from pathlib import Path

from unit import Instance, Unit, Values


@dataclass(frozen=True)
class Call:
    """What is set before a step, and the step. Of the first step, all that is part of the state."""

    start: float
    size: float
    values: Values
    slopes: Values

    def prepare(self, instance: Instance) -> None:
        instance.set(self.values)
        if self.slopes:
            instance.set_slopes(self.slopes)

    def step(self, instance: Instance) -> list[str]:
        instance.step(self.start, self.size)
        outputs = instance.all(instance.unit.names("output"))
        return [value.hex() for value in outputs]


@dataclass(frozen=True)
class Record:
    """A state, saved just before the first of these calls' steps."""

    fmu: Path
    state: bytes
    calls: list[Call]


def go_on(instance: Instance, calls: list[Call]) -> list[list[str]]:
    """All outputs after every step."""
    rows = []
    for number, call in enumerate(calls):
        if number > 0:
            call.prepare(instance)
        rows.append(call.step(instance))
    return rows


def main() -> None:
    record: Record = pickle.loads(Path(sys.argv[1]).read_bytes())
    with Unit(record.fmu) as unit:
        instance = unit.instantiate("elsewhere")
        instance.slave.setFMUstate(instance.slave.deSerializeFMUstate(record.state))
        for row in go_on(instance, record.calls):
            print(*row)


if __name__ == "__main__":
    # What is in the file was made by a module of this name.
    from continuation import main as run

    run()
