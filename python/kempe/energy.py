"""Where the energy of a simulation went, and how well it is kept."""

from __future__ import annotations

from kempe.arrays import Floats, fixed


class Energy:
    """Energies over time, (n_t,), J, read-only.

    Attributes:
        kinetic: T.
        potential: V of gravity and of conservative forces.
        dissipated: lost in dampers, from the start.
        work_of_drivers: done by drivers, from the start.
        work_of_forces: done by applied forces, from the start.
    """

    def __init__(self, columns: Floats) -> None:
        self.kinetic = fixed(columns[:, 0])
        self.potential = fixed(columns[:, 1])
        self.dissipated = fixed(columns[:, 2])
        self.work_of_drivers = fixed(columns[:, 3])
        self.work_of_forces = fixed(columns[:, 4])

    @property
    def work(self) -> Floats:
        """Done from outside, by drivers and applied forces."""
        return fixed(self.work_of_drivers + self.work_of_forces)

    @property
    def total(self) -> Floats:
        """T + V + dissipated - work: constant in an exact solution."""
        return fixed(self.kinetic + self.potential + self.dissipated - self.work)

    @property
    def balance(self) -> Floats:
        """Change of the total, relative to the largest kinetic energy (to 1 J at rest)."""
        largest = float(self.kinetic.max(initial=0.0)) or 1.0
        return fixed((self.total - self.total[0]) / largest)
