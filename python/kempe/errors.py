"""The closed set of exceptions that kempe raises.

Every error names the joint or body, the time and the remedy::

    try:
        sol = kp.dynamics(m, start, t_end=15)
    except kp.IntegrationError as error:
        print(error.name, error.t, error.hint)
        sol = error.solution  # the results until then

The compiled core raises these same classes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Problem:
    """A fault of a model or a file.

    Attributes:
        message: the fault and its remedy.
        path: the place in the model, such as ``joints.C.i``; may be empty.
        line: line in the file, from 1; None for a model built in Python.
        column: column in the file, from 1; None for a model built in Python.
    """

    message: str
    path: str = ""
    line: int | None = None
    column: int | None = None

    def __str__(self) -> str:
        where = f"{self.path}: " if self.path else ""
        if self.line is None:
            return f"{where}{self.message}"
        column = "" if self.column is None else f", column {self.column}"
        return f"{where}{self.message} (line {self.line}{column})"


class KempeError(Exception):
    """Base of all errors of kempe.

    Attributes:
        name: the joint or body at fault, or None.
        t: the time of the failure in s, or None.
        hint: the remedy, or None.
        problems: all faults, in the order of the file; may be empty.
    """

    def __init__(
        self,
        message: str,
        *,
        name: str | None = None,
        t: float | None = None,
        hint: str | None = None,
        problems: tuple[Problem, ...] = (),
    ) -> None:
        super().__init__(message)
        self.name = name
        self.t = t
        self.hint = hint
        self.problems = problems

    def __str__(self) -> str:
        message = str(self.args[0])  # a KeyError, which some are too, would put it in quotes
        text = f"{message}; {self.hint}" if self.hint else message
        return text.encode("utf-8", "backslashreplace").decode()  # half a character, in a name


class ModelError(KempeError):
    """The model, or the file from which it was read, is invalid."""


class AssemblyError(KempeError):
    """The mechanism cannot be assembled."""


class RedundancyError(KempeError):
    """Some constraints are redundant: other constraints imply them in every position."""


class SingularityError(KempeError):
    """The solution is not unique in this position, for example at a dead point.

    Attributes:
        solution: the results before the position, or None.
        value: the time or driven value at which ``kinematics`` ends, or None.
    """

    solution: Any = None
    value: float | None = None


class IntegrationError(KempeError):
    """The integrator failed.

    Attributes:
        solution: the results before the failure, or None.
    """

    def __init__(
        self,
        message: str,
        *,
        name: str | None = None,
        t: float | None = None,
        hint: str | None = None,
        problems: tuple[Problem, ...] = (),
        solution: Any = None,
    ) -> None:
        super().__init__(message, name=name, t=t, hint=hint, problems=problems)
        self.solution = solution


class FileError(KempeError):
    """A file cannot be read or written."""


class InternalError(KempeError):
    """A fault in kempe itself; please report it."""
