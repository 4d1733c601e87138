"""Energies of a simulation and the energy balance."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed

#: Part of the potential energy below which its changes are rounding errors and those of closed
#: joints: a mechanism that moves less is at rest.
RESOLVED = 1e-6


@explain_methods
class Energy:
    """Energies over time, (n_t,), J, read-only."""

    def __init__(self, columns: Floats) -> None:
        self._columns = fixed(columns)

    def at(self, rows: NDArray[np.intp]) -> Energy:
        """The energies at some of the times."""
        return Energy(self._columns[rows])

    @property
    def columns(self) -> Floats:
        """Kinetic, potential, dissipated, work of drivers, work of applied forces, (n_t, 5)."""
        return self._columns

    def __repr__(self) -> str:
        largest = float(self.kinetic.max(initial=0.0))
        return f"<Energy at {len(self._columns)} times: kinetic up to {largest:.6g} J>"

    @cached_property
    def kinetic(self) -> Floats:
        """Kinetic energy T."""
        return fixed(self._columns[:, 0])

    @cached_property
    def potential(self) -> Floats:
        """Potential energy V of gravity and of conservative forces."""
        return fixed(self._columns[:, 1])

    @cached_property
    def dissipated(self) -> Floats:
        """Energy dissipated since the start."""
        return fixed(self._columns[:, 2])

    @cached_property
    def work_of_drivers(self) -> Floats:
        """Work of the drivers since the start."""
        return fixed(self._columns[:, 3])

    @cached_property
    def work_of_forces(self) -> Floats:
        """Work of the applied forces since the start."""
        return fixed(self._columns[:, 4])

    @property
    def work(self) -> Floats:
        """Work of drivers and applied forces since the start."""
        return fixed(self.work_of_drivers + self.work_of_forces)

    @property
    def total(self) -> Floats:
        """T + V + dissipated - work: constant in an exact solution."""
        return fixed(self.kinetic + self.potential + self.dissipated - self.work)

    @cached_property
    def scale(self) -> float:
        """The energy to which the balance is relative, J.

        It is the largest of the kinetic energy and of the ranges of the potential energy, the
        dissipated energy and the work. It is at least a millionth of the largest potential energy,
        because of rounding errors, and 1 J if all energies are zero.
        """
        if not len(self.kinetic):
            return 1.0
        exchanged = [
            self.potential,
            self.dissipated,
            self.work_of_drivers,
            self.work_of_forces,
        ]
        largest = max(float(self.kinetic.max()), *(float(np.ptp(part)) for part in exchanged))
        return max(largest, RESOLVED * float(np.abs(self.potential).max())) or 1.0

    @property
    def balance(self) -> Floats:
        """Change of the total relative to ``scale``."""
        return fixed((self.total - self.total[0]) / self.scale)
