"""Constraint violation of a solution, and the balance of its reactions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats

if TYPE_CHECKING:
    from kempe.results.solution import Solution


@explain_methods
@dataclass(frozen=True)
class Drift:
    """Constraint violation over time, and the balance of the reactions.

    Attributes:
        position: largest |Φ| at each time, (n_t,), m or rad.
        velocity: largest |Φ_q q̇ + Φ_t| at each time, (n_t,), per s.
    """

    position: Floats
    velocity: Floats
    _solution: Solution

    @property
    def balance(self) -> Floats:
        """Largest Newton–Euler residual of all bodies at each time, (n_t,).

        It is relative to the largest single force (moment) on the body in the run; see
        ``Motion.newton_euler``.

        Raises:
            SingularityError: the reactions are not unique at one of the times.
        """
        return self._solution.newton_euler.balance

    def __repr__(self) -> str:
        largest = float(self.position.max(initial=0.0)), float(self.velocity.max(initial=0.0))
        return f"<Drift: position up to {largest[0]:.3g}, velocity up to {largest[1]:.3g}>"
