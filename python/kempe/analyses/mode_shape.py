"""A mode as a motion: states along one period of its oscillation."""

from __future__ import annotations

import numpy as np

from kempe import _core
from kempe.analyses.eigenmodes import Complexes
from kempe.base.arrays import Floats
from kempe.results.state import State

#: Largest change of an angle, rad, or of a position, as a fraction of the size of the mechanism.
AMPLITUDE = 0.15
#: Remaining residual of the constraints, relative to the size of the mechanism.
_CLOSED = 1e-9


class ModeShape:
    """A mode about a state, with a visible amplitude.

    Attributes:
        state: the state.
        shape: (n_q,), the change of all coordinates, complex.
        eigenvalue: s, 1/s.
        number: number of the mode, from 0.
        amplitude: largest change of an angle, rad, or of a position, as a fraction of the size of
            the mechanism.
    """

    def __init__(
        self,
        state: State,
        shape: Complexes,
        eigenvalue: complex,
        number: int,
        amplitude: float | None = None,
    ) -> None:
        self.state, self.shape, self.eigenvalue, self.number = state, shape, eigenvalue, number
        self.amplitude = AMPLITUDE if amplitude is None else float(amplitude)

    def at(self, phase: float) -> State:
        """The mechanism at a phase of the mode, rad: 0 and π are the largest changes.

        The joints are closed: the linear motion is projected onto the constraints.
        """
        changed = self.state.q + (self._factor * self.shape * np.exp(1j * phase)).real
        model, none = self.state.compiled, np.zeros((1, self.state.compiled.n_q))
        rows = np.array([self.state.t]), changed[None], none, self.state.z[None]
        closed, _ = _core.States(model.core, *rows).project(_CLOSED)
        return State(model, self.state.t, closed[0], none[0], z=self.state.z)

    def states(self, count: int) -> list[State]:
        """States evenly spaced over one period, the first at the largest change."""
        return [self.at(float(phase)) for phase in np.arange(count) * 2.0 * np.pi / count]

    @property
    def _factor(self) -> float:
        """The factor of the shape."""
        size = np.abs(self.shape) / self._scales
        largest = float(size.max(initial=0.0))
        return self.amplitude / largest if largest > 0.0 else 0.0

    @property
    def _scales(self) -> Floats:
        """The size of the mechanism for lengths, 1 for angles."""
        model = self.state.compiled
        bodies = model.bodies.values()
        points = [abs(complex(*s)) for body in bodies for s in body.points.values()]
        lengths = np.array([not name.endswith(".angle") for name in model.column_names()])
        return np.where(lengths, 2.0 * max(points, default=0.5) or 1.0, 1.0)
