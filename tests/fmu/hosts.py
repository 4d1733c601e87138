"""Hosts: programs that load an FMU, here with FMPy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

OK, WARNING, DISCARD, ERROR = 0, 1, 2, 3


class Host:
    """An instance of an FMU, with the same methods for both versions."""

    def __init__(self, folder: Path, begin: bool = True) -> None:
        self.description = read_model_description(str(folder))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.messages: list[str] = []
        self.is_2 = self.description.fmiVersion == "2.0"
        kind = FMU2Slave if self.is_2 else FMU3Slave
        self.fmu: Any = kind(
            guid=self.description.guid,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            unzipDirectory=str(folder),
            instanceName="one",
        )
        self._instantiate()
        self.t = 0.0
        if begin:
            self.begin()

    def _instantiate(self) -> None:
        if self.is_2:
            from fmpy.fmi2 import defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE

            def log(_1: Any, _2: Any, _status: int, _category: bytes, text: bytes) -> None:
                self.messages.append(text.decode())

            own = fmi2CallbackFunctions()
            own.logger = fmi2CallbackLoggerTYPE(log)
            own.allocateMemory = defaultCallbacks.allocateMemory
            own.freeMemory = defaultCallbacks.freeMemory
            self.fmu.instantiate(callbacks=own)
        else:

            def note(_1: Any, _status: int, _category: bytes, text: bytes) -> None:
                self.messages.append(text.decode())

            self.fmu.instantiate(logMessage=note)

    def begin(self, values: dict[str, float] | None = None, tolerance: float | None = None) -> None:
        for name, value in (values or {}).items():
            self.set(name, value)
        if self.is_2:
            self.fmu.setupExperiment(startTime=0.0, tolerance=tolerance)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=0.0, tolerance=tolerance)
        self.fmu.exitInitializationMode()
        self.t = 0.0

    def set(self, name: str, value: float) -> None:
        setter = self.fmu.setReal if self.is_2 else self.fmu.setFloat64
        setter([self.references[name]], [value])

    def get(self, *names: str) -> list[float]:
        getter = self.fmu.getReal if self.is_2 else self.fmu.getFloat64
        return list(getter([self.references[name] for name in names]))

    def step(self, dt: float) -> None:
        self.fmu.doStep(currentCommunicationPoint=self.t, communicationStepSize=dt)
        self.t += dt

    def state(self) -> Any:
        return self.fmu.getFMUState()

    def restore(self, state: Any) -> None:
        self.fmu.setFMUState(state)

    def free(self, state: Any) -> None:
        self.fmu.freeFMUState(state)

    def bytes(self, state: Any) -> bytes:
        return bytes(self.fmu.serializeFMUState(state))

    def read(self, data: bytes) -> Any:
        return self.fmu.deserializeFMUState(data)

    def reset(self) -> None:
        self.fmu.reset()

    def close(self) -> None:
        self.fmu.freeInstance()


@contextmanager
def hosts(
    path: Path, folder: Path, count: int = 1, begin: bool = True
) -> Iterator[tuple[Host, ...]]:
    extract(str(path), str(folder))
    made = tuple(Host(folder, begin) for _ in range(count))
    try:
        yield made
    finally:
        for host in made:
            host.close()
