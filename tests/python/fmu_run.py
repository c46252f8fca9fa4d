"""Drives a co-simulation FMU of the planar aerial manipulator through a case."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from oracle_data import Array
from random_cases import Case, fmi_inputs, fmi_parameters, fmi_slopes
from unit import Unit


def fmu_table(fmu: Path, case: Case, names: Iterable[str]) -> dict[str, Array]:
    """Run the case in the FMU: one array over the steps per output or, as "der(name)", per first
    derivative of an output."""
    slopes = [name for name in names if name.startswith("der(")]
    outputs = [name for name in names if name not in slopes]
    rows = []
    with Unit(fmu) as unit:
        instance = unit.instantiate("plant")
        instance.initialize(
            parameters=fmi_parameters(case), inputs=fmi_inputs(case, case.steps[0][1])
        )
        time = 0.0
        for size, inputs in case.steps:
            instance.set(fmi_inputs(case, inputs))
            instance.set_slopes(fmi_slopes(inputs))
            instance.step(time, size)
            time += size
            derivatives = instance.slopes([name[4:-1] for name in slopes])
            rows.append([*instance.all(outputs), *derivatives])
        instance.slave.terminate()
        assert not instance.said, instance.said
    return dict(zip([*outputs, *slopes], np.array(rows).T))
