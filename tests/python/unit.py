"""A unit in a host that speaks of variables by name: FMPy's binding of the C functions."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable, Mapping, Sequence
from ctypes import c_void_p
from pathlib import Path

import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

# An alternative of an enumeration by its name or number.
Values = Mapping[str, float | str]


class Unit:
    """An unpacked FMU; instances live as long as it does."""

    def __init__(self, fmu: Path) -> None:
        self.description = read_model_description(str(fmu))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.folder = extract(str(fmu))
        # FMPy unloads the library with the first instance that goes: they go together.
        self.instances: list[Instance] = []

    def __enter__(self) -> Unit:
        return self

    def __exit__(self, *_: object) -> None:
        for instance in self.instances:
            instance.slave.fmi2FreeInstance(instance.slave.component)
        if self.instances:
            self.instances[0].slave.freeLibrary()
        shutil.rmtree(self.folder, ignore_errors=True)

    def names(self, causality: str) -> list[str]:
        return [name for name, v in self.variables.items() if v.causality == causality]

    def instantiate(self, name: str = "unit", logging: bool = False) -> Instance:
        self.instances.append(Instance(self, name, logging))
        return self.instances[-1]


class Instance:
    """An instance, with all that it has said: category, status and text."""

    def __init__(self, unit: Unit, name: str, logging: bool) -> None:
        self.unit = unit
        self.said: list[tuple[str, int, str]] = []
        self.allocations = 0

        def log(_: c_void_p, __: bytes, status: int, category: bytes, text: bytes) -> None:
            self.said.append((category.decode(), status, text.decode()))

        def allocate(*_: object) -> None:
            self.allocations += 1

        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(log)
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(allocate)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(allocate)
        self.slave = FMU2Slave(
            guid=unit.description.guid,
            unzipDirectory=unit.folder,
            modelIdentifier=unit.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.slave.instantiate(callbacks=self.callbacks, loggingOn=logging)

    def initialize(
        self,
        start: float = 0.0,
        parameters: Values | None = None,
        inputs: Values | None = None,
    ) -> None:
        """Through initialization; inputs are set in it, parameters before."""
        self.set(parameters or {})
        self.slave.setupExperiment(startTime=start)
        self.slave.enterInitializationMode()
        self.set(inputs or {})
        self.slave.exitInitializationMode()

    def set(self, values: Values) -> None:
        """Set variables by their own types."""
        for name, value in values.items():
            variable = self.unit.variables[name]
            if isinstance(value, str):
                value = {item.name: item.value for item in variable.declaredType.items}[value]
            kind = {"Real": float, "Boolean": bool}.get(variable.type, int)
            setter = {"Real": self.slave.setReal, "Boolean": self.slave.setBoolean}
            setter.get(variable.type, self.slave.setInteger)(
                [variable.valueReference], [kind(value)]
            )

    def get(self, name: str) -> float:
        """A variable as a number, whatever its type."""
        return self.slave.getReal([self.unit.variables[name].valueReference])[0]

    def all(self, names: Iterable[str]) -> list[float]:
        return self.slave.getReal([self.unit.variables[name].valueReference for name in names])

    def set_slopes(self, slopes: Mapping[str, float]) -> None:
        """First derivatives of inputs, for the coming step."""
        references = [self.unit.variables[name].valueReference for name in slopes]
        self.slave.setRealInputDerivatives(references, [1] * len(slopes), list(slopes.values()))

    def slopes(self, names: Sequence[str], order: int = 1) -> list[float]:
        """Derivatives of outputs."""
        references = [self.unit.variables[name].valueReference for name in names]
        return self.slave.getRealOutputDerivatives(references, [order] * len(names))

    def refuses(self, call: Callable[[], object]) -> str:
        """The message with which this instance refuses a call."""
        with pytest.raises(Exception, match="failed with status 3"):
            call()
        return self.said[-1][2]

    def step(self, start: float, size: float) -> None:
        self.slave.doStep(currentCommunicationPoint=start, communicationStepSize=size)
