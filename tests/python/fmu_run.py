"""Drives a co-simulation FMU of the planar aerial manipulator through a case."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from oracle_data import Array
from random_cases import Case, Value, fmi_inputs, fmi_parameters, fmi_slopes


class _Names:
    """Sets and gets variables of an FMU by name, whatever their type."""

    def __init__(self, slave: FMU2Slave, variables: Iterable[Any]) -> None:
        self._slave = slave
        self._variables = {variable.name: variable for variable in variables}
        self._set = {
            "Real": (slave.setReal, float),
            "Integer": (slave.setInteger, int),
            "Enumeration": (slave.setInteger, int),
            "Boolean": (slave.setBoolean, bool),
        }
        self._get = {
            "Real": slave.getReal,
            "Integer": slave.getInteger,
            "Enumeration": slave.getInteger,
            "Boolean": slave.getBoolean,
        }

    def set(self, values: Mapping[str, Value]) -> None:
        for name, value in values.items():
            variable = self._variables[name]
            setter, kind = self._set[variable.type]
            setter([variable.valueReference], [kind(value)])

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """Set first derivatives of inputs for the coming step."""
        for name, slope in slopes.items():
            reference = self._variables[name].valueReference
            self._slave.setRealInputDerivatives([reference], [1], [slope])

    def get(self, name: str) -> float:
        """The value of a variable or, as "der(name)", its first derivative."""
        if name.startswith("der("):
            reference = self._variables[name[4:-1]].valueReference
            return float(self._slave.getRealOutputDerivatives([reference], [1])[0])
        variable = self._variables[name]
        return float(self._get[variable.type]([variable.valueReference])[0])

    def outputs(self) -> list[str]:
        return [
            name for name, variable in self._variables.items() if variable.causality == "output"
        ]


def fmu_table(fmu: str | Path, case: Case, names: Iterable[str] | None = None) -> dict[str, Array]:
    """Run the case in the FMU: one array over the steps per name (default: all its outputs)."""
    description = read_model_description(str(fmu))
    if description.coSimulation is None:
        raise ValueError("not a co-simulation FMU")
    directory = extract(str(fmu))
    try:
        slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=directory,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="plant",
        )
        slave.instantiate()
        try:
            variables = _Names(slave, description.modelVariables)
            names = list(variables.outputs() if names is None else names)
            table: dict[str, list[float]] = {name: [] for name in names}
            variables.set(fmi_parameters(case))
            slave.setupExperiment(startTime=0.0)
            slave.enterInitializationMode()
            variables.set(fmi_inputs(case, case.steps[0][1]))
            slave.exitInitializationMode()
            time = 0.0
            for step, inputs in case.steps:
                variables.set(fmi_inputs(case, inputs))
                variables.set_slopes(fmi_slopes(inputs))
                slave.doStep(currentCommunicationPoint=time, communicationStepSize=step)
                time += step
                for name in names:
                    table[name].append(variables.get(name))
            slave.terminate()
        finally:
            slave.freeInstance()
    finally:
        shutil.rmtree(directory, ignore_errors=True)
    return {name: np.array(column) for name, column in table.items()}
