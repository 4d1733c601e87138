"""The interpolant of the integrator."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.errors import ModelError

#: Number of work integrals that the integrator computes with the motion.
WORKS = 3


@dataclass(frozen=True)
class DenseOutput:
    """y(t_old + θ h) = y_old + h Σ_k c_k θ^(k+1) in every step, with y = [q, v, z, works].

    Attributes:
        t: boundaries of the k steps, (k + 1,), s; descending if the motion is computed over a
            decreasing quantity.
        y: y at the start of each step, (k, n_y).
        c: coefficients, (k, n_y, degree); the degree is 4, or 9 with DOP853.
    """

    t: Floats
    y: Floats
    c: Floats

    @property
    def degree(self) -> int:
        """The degree of the polynomials."""
        return int(self.c.shape[2])

    @classmethod
    def of_an_instant(cls, t: float, y: Floats) -> DenseOutput:
        """The interpolant of a simulation that makes no steps."""
        return cls(np.array([t, t]), y[None], np.zeros((1, len(y), 1)))

    def __repr__(self) -> str:
        return f"<DenseOutput: {len(self.y)} steps, degree {self.degree}>"

    def __call__(self, t: Floats) -> Floats:
        """State y at times of any shape, (…, n_y).

        Raises:
            ModelError: a time is outside the simulated interval, or is NaN.
        """
        self._refuse_outside(t)
        times = np.ascontiguousarray(np.ravel(t), dtype=np.float64)
        rows = _core.interpolate(self.t, self.y, self.c, times)
        return rows.reshape((*np.shape(t), self.y.shape[1]))

    def parts(self, t: Floats, n_q: int, n_z: int) -> tuple[Floats, Floats, Floats]:
        """q, v and z at times of any shape, (…, n_q), (…, n_q) and (…, n_z)."""
        y = self(t)
        return y[..., :n_q], y[..., n_q : 2 * n_q], y[..., 2 * n_q : 2 * n_q + n_z]

    def _refuse_outside(self, t: Floats) -> None:
        slack = 1e-12 * max(abs(self.t[0]), abs(self.t[-1]))
        low, high = sorted((self.t[0], self.t[-1]))
        inside = (t >= low - slack) & (t <= high + slack)
        if not np.all(inside):
            wrong = float(np.extract(~inside, t)[0])
            raise ModelError(
                f"t = {wrong:g} s is outside the solution, {self.t[0]:g} to {self.t[-1]:g} s",
                t=wrong,
                hint="choose a time within it, or compute a longer motion",
            )
