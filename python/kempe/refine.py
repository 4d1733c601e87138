"""Local maxima on the interpolant, and the singular positions beside which values mean nothing.

A run passes positions in which constraints lose their rank. Beside such a position a multiplier is
the quotient of two small numbers: it may have a pole there, and the errors of the state, divided by
little, exceed it. A maximum that a search finds there depends on how close to it the search comes.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kempe.arrays import Floats
from kempe.errors import KempeError

#: Local maxima above this share of the largest one are refined together, so many at most.
_SHARE, _TOGETHER = 0.9, 8
#: A bracket is divided so often into so many intervals; each time it shrinks by half as much.
_ROUNDS, _INTERVALS = 4, 16
#: So many groups of maxima are examined at most.
_GROUPS = 64
#: A maximum between instants exceeds that at an instant by at most this multiple of the change from
#: there to the instants beside it, as each step of the integrator has several instants: by an
#: eighth at a smooth maximum, by the whole at a kink. A share of the value is the error of states.
_STEEP, _ERROR = 2.0, 1e-3
#: Instants on either side of a singular position at which errors of states may hide the value, and
#: instants up to which its neighbourhood is examined.
_NEAR, _FAR = 8, 40
#: Degree of polynomials for the smooth part of a quantity beside a singular position.
_DEGREE = 6
#: A pole is worth this share of the values around it, ``_NEAR`` instants beside it.
_POLE = 0.02

#: A quantity at some times, with the sign that makes the wanted extreme value a maximum.
Read = Callable[[Floats], Floats]
Indices = NDArray[np.intp]


class Maxima:
    """The largest local maxima of a quantity, without those beside singular positions.

    Attributes:
        values: the largest maxima that were found, (n,); none if all are beside such positions.
        t: their times, s.
        near: the indices of singular positions, those met on the way too.
        near_t: closer times of these positions, s.
    """

    def __init__(
        self,
        read: Read,
        t: Floats,
        values: Floats,
        known: Maxima | None = None,
        *,
        resolved: bool = True,
    ) -> None:
        self._t, self._sampled, self._resolved = t, values, resolved
        self.values, self.t = np.empty(0), np.empty(0)
        self.near: Indices = np.empty(0, dtype=np.intp) if known is None else known.near
        self.near_t: Floats = np.empty(0) if known is None else known.near_t
        left = _local_maxima(values)
        for _ in range(_GROUPS):
            left = left[self._is_clear(left)]
            if not len(left) or len(self.values):
                break
            group = left[values[left] >= self._least_worth(left[0])][:_TOGETHER]
            self._examine(group, read)
            left = np.setdiff1d(left, group, assume_unique=True)
            left = left[np.argsort(-values[left], kind="stable")]
        self._add_across()

    def _least_worth(self, best: int) -> float:
        return float(self._sampled[best]) - (1.0 - _SHARE) * abs(float(self._sampled[best]))

    def _is_clear(self, k: Indices) -> NDArray[np.bool_]:
        clear: NDArray[np.bool_] = (np.abs(k[:, None] - self.near) > _NEAR).all(axis=1)
        return clear

    def _examine(self, group: Indices, read: Read) -> None:
        """Refine some maxima, and keep those that are none of a singular position."""
        beside = np.clip(group[:, None] + [-1, 1], 0, len(self._t) - 1)
        highest, at = _refined(self._t[beside], read)
        here = self._sampled[group]
        change = np.abs(self._sampled[beside] - here[:, None]).max(axis=1)
        steep = highest - here > _STEEP * change + _ERROR * np.abs(here)
        steep &= self._resolved
        self.near = np.append(self.near, group[steep])
        self.near_t = np.append(self.near_t, at[steep])
        kept = ~steep & self._is_clear(group)
        self.values, self.t = highest[kept], at[kept]

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


def _local_maxima(values: Floats) -> Indices:
    """Indices of the local maxima, the largest first."""
    padded = np.concatenate([[-np.inf], values, [-np.inf]])
    found = np.flatnonzero((values >= padded[:-2]) & (values >= padded[2:]))
    return found[np.argsort(-values[found], kind="stable")]


def _refined(brackets: Floats, read: Read) -> tuple[Floats, Floats]:
    """The largest value in each bracket and its time; ∞ where the quantity is not unique.

    Each bracket shrinks to the parts beside its largest value.
    """
    share = np.linspace(0.0, 1.0, _INTERVALS + 1)
    rows = np.arange(len(brackets))
    highest, at = np.full(len(brackets), -np.inf), brackets[:, 0]
    for _ in range(_ROUNDS):
        times = brackets[:, :1] + share * np.diff(brackets)
        try:
            values = read(times.ravel()).reshape(times.shape)
        except KempeError:
            if len(brackets) == 1:
                return np.array([np.inf]), at
            each = [_refined(one[None], read) for one in brackets]
            return np.concatenate([v for v, _ in each]), np.concatenate([t for _, t in each])
        k = values.argmax(axis=1)
        highest, at = values[rows, k], times[rows, k]
        ends = np.clip(k[:, None] + [-1, 1], 0, _INTERVALS)
        brackets = np.take_along_axis(times, ends, axis=1)
    return highest, at
