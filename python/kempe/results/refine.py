"""Local maxima on the interpolant, and singular positions beside which values are meaningless.

A run can pass positions in which the constraint Jacobian loses rank. Beside such a position a
multiplier is the quotient of two small numbers. It may have a pole there, and it is dominated by
the errors of the state divided by a small number. A maximum that is found there depends on the
distance of the samples from the position. The core searches for maxima; this module continues
quantities without a pole across singular positions.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kempe import _core
from kempe.base.arrays import Floats

#: Instants on either side of a singular position at which errors of states may hide the value, as
#: in the search of the core, and instants up to which its neighbourhood is examined.
_NEAR, _FAR = 8, 40
#: Degree of polynomials for the smooth part of a quantity beside a singular position.
_DEGREE = 6
#: Least part of a pole in the values ``_NEAR`` instants beside it, as a fraction of these values.
_POLE = 0.02

#: A quantity at some times, with the sign that makes the wanted extreme value a maximum.
Read = Callable[[Floats], Floats]
Indices = NDArray[np.intp]


class Maxima:
    """The largest local maxima of a quantity, excluding maxima beside singular positions.

    Attributes:
        values: the largest maxima that were found, (n,); empty if all are beside such positions.
        t: their times, s.
        near: the indices of singular positions, including those found during the search.
        near_t: closer times of these positions, s.
        samples: the instants and the values there.
    """

    def __init__(
        self,
        read: Read,
        t: Floats,
        values: Floats,
        known: Maxima | tuple[list[int], list[float]] | None = None,
        *,
        resolved: bool = True,
    ) -> None:
        self._t, self._sampled = t, values
        self.samples = t, values
        if isinstance(known, Maxima):
            known = known.near.tolist(), known.near_t.tolist()
        near, times = known or ([], [])
        near_t: Floats = np.array(times, dtype=float)
        self.values: Floats
        self.t: Floats
        self.near_t: Floats
        self.values, self.t, found, self.near_t = _core.maxima(
            t, values, near, near_t, resolved, read
        )
        self.near: Indices = np.array(found, dtype=np.intp)
        self._add_across()

    def _add_across(self) -> None:
        """Continue a quantity without a pole across singular positions, from both sides."""
        away = np.arange(-_FAR, _FAR + 1)
        for k in self.near:
            window = k + away
            if window[0] < 0 or window[-1] >= len(self._t) or self._has_pole(k):
                continue
            x = (self._t[window] - self._t[k]) / (self._t[window[-1]] - self._t[window[0]])
            outside = (np.abs(window[:, None] - self.near) > _NEAR).all(axis=1)
            if not (outside[:_FAR].any() and outside[_FAR:].any()):
                continue
            terms = np.polynomial.Polynomial.fit(
                x[outside], self._sampled[window[outside]], _DEGREE
            )
            inside = terms(x[~outside])
            best = int(inside.argmax())
            self.values = np.append(self.values, inside[best])
            self.t = np.append(self.t, self._t[window[~outside][best]])

    @property
    def poles(self) -> Floats:
        """Times of the singular positions beside which the quantity has no bound, s."""
        has = [self._has_pole(k) for k in self.near]
        return np.sort(self.near_t[np.array(has, dtype=bool)])

    def _has_pole(self, k: int) -> bool:
        """Whether the quantity grows like 1/x towards a singular position from either side."""
        return any(self._grows(k + side * np.arange(_NEAR, _FAR + 1), k) for side in (-1, 1))

    def _grows(self, window: Indices, k: int) -> bool:
        window = window[(window >= 0) & (window < len(self._t))]
        if len(window) < _FAR - _NEAR:
            return False
        x = (self._t[window] - self._t[k]) / (self._t[window[0]] - self._t[k])
        terms = np.stack([1.0 / x, *(x**power for power in range(_DEGREE))], axis=1)
        values = self._sampled[window]
        pole = np.linalg.lstsq(terms, values, rcond=None)[0][0]
        return bool(abs(pole) > _POLE * np.abs(values).max())
