"""Settling times."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from kempe.arrays import Floats

#: Half width of the settling band, relative to the largest deviation from the final value.
BAND = 0.005
#: A motion has settled only if it stays in the band for this share of the time, at the end.
QUIET_SHARE = 0.1
#: Smaller deviations are rounding errors, rad or m.
NOISE = 1e-12
#: Refinement of the time: points in an interval, and how often it shrinks to one of its parts.
_POINTS, _ROUNDS = 9, 12


@dataclass(frozen=True)
class Settling:
    """Settling of a quantity.

    Attributes:
        moves: whether the quantity changes.
        time: time after which it stays in the band, s; None if it does not settle.
    """

    moves: bool
    time: float | None


def settling(
    t: Floats,
    values: Floats,
    *,
    between: Callable[[Floats], Floats] | None = None,
    noise: float | None = None,
) -> Settling:
    """Settling time, with a band of 0.5 % of the largest deviation from the final value.

    Args:
        t: (n_t,), s.
        values: (n_t,).
        between: the quantity at any times; with it the time is that at which the quantity enters
            the band, otherwise the first of ``t`` in the band.
        noise: the largest deviation of a quantity that does not change; 1e-12 of the largest value
            by default, at least 1e-12.
    """
    deviation = np.abs(values - values[-1])
    peak = float(deviation.max())
    if noise is None:
        noise = NOISE * max(1.0, float(np.abs(values).max()))
    if peak <= noise:
        return Settling(moves=False, time=None)
    last = int(np.flatnonzero(deviation > BAND * peak)[-1])  # the last value is in the band
    entered = float(t[last + 1])
    if between is not None:
        entered = _entry(between, float(t[last]), entered, float(values[-1]), BAND * peak)
    is_quiet = abs(float(t[-1]) - entered) >= QUIET_SHARE * abs(float(t[-1] - t[0]))
    return Settling(moves=True, time=entered if is_quiet else None)


def _entry(
    between: Callable[[Floats], Floats], outside: float, inside: float, final: float, band: float
) -> float:
    """Time of the last entry into the band, between a time outside and a time in it."""
    for _ in range(_ROUNDS):
        times = np.linspace(outside, inside, _POINTS)
        beyond = np.abs(between(times) - final) > band
        beyond[0], beyond[-1] = True, False
        k = int(np.flatnonzero(beyond)[-1])
        outside, inside = float(times[k]), float(times[k + 1])
    return inside
