"""How a state was made, so that its derivatives can be computed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np

from kempe.base.arrays import Floats
from kempe.errors import ModelError


@dataclass(frozen=True)
class Origin:
    """The recipe of a state: an assembly, and the analyses that lead from it to the state.

    Attributes:
        set: coordinates and rates that the assembly holds.
        guess: its guesses.
        analyses: the analyses in order, by names, as entries of a case.
    """

    set: Mapping[str, Any]
    guess: Mapping[str, Any]
    analyses: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def then(self, entry: Mapping[str, Any]) -> Origin:
        """The recipe of the state at the end of one more analysis."""
        following = {f"run{len(self.analyses) + 1}": dict(entry)}
        return Origin(self.set, self.guess, {**self.analyses, **following})


class KeptSlopes(Protocol):
    """The slopes that a run keeps."""

    @property
    def origin(self) -> Origin:
        """The recipe of the end of the run."""

    @property
    def variables(self) -> Mapping[str, float]:
        """The variables and their values."""

    def read(self, quantity: str, variable: str, t: Floats) -> Floats:
        """The derivative of a quantity by a variable at the times of the run, (n_t,)."""


class WithSlopes:
    """A solution that may have kept slopes."""

    t: Any
    _slopes: KeptSlopes | None = None

    @property
    def variables_of_slopes(self) -> Mapping[str, float]:
        """The variables of ``slopes=`` and their values; empty for a run without slopes."""
        return MappingProxyType(self._slopes.variables if self._slopes else {})

    def slope(self, quantity: str, variable: str) -> Floats:
        """The derivative of a quantity with respect to a variable over time; it is exact.

        The run keeps it if its call names the variable: ``kp.dynamics(…, slopes=["L2"])``. It is
        the derivative at a fixed time. It jumps where the motion changes, such as at a hit.

        Args:
            quantity: ``"rocker.angle"``, ``"C.force"``, ``"motor.effort"``; a measure too.
            variable: a parameter, or a coordinate or rate that is set at the start.

        Returns:
            (n_t,), the SI unit of the quantity per SI unit of the variable.

        Raises:
            ModelError: the run has no slopes, or not these; there is no such quantity.
            NoSlopesError: a derivative does not exist; the message has the reason.
        """
        if self._slopes is None:
            raise ModelError(
                "the run has no slopes",
                hint=f'pass slopes=["{variable}"] to kp.dynamics, kp.kinematics or '
                "kp.inverse_dynamics",
            )
        return self._slopes.read(quantity, variable, np.asarray(self.t))
