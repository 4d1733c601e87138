"""Settling times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.arrays import Floats

#: Half width of the settling band, relative to the largest deviation from the final value.
BAND = 0.005
#: An angle that changes by less, in rad or relative to it, does not turn: this is the size of
#: errors of integration.
STILL = 1e-8
#: A motion has settled only if it stays in the band for this share of the time, at the end.
QUIET_SHARE = 0.1


@dataclass(frozen=True)
class Settling:
    """Settling of a quantity.

    Attributes:
        moves: whether the quantity changes.
        time: time after which it stays in the band, s; None if it does not settle.
    """

    moves: bool
    time: float | None


def settling(t: Floats, values: Floats) -> Settling:
    """Settling time, with a band of 0.5 % of the largest deviation from the final value.

    Args:
        t: (n_t,), s.
        values: (n_t,).
    """
    deviation = np.abs(values - values[-1])
    peak = float(deviation.max())
    if peak <= STILL * max(1.0, float(np.abs(values).max())):
        return Settling(moves=False, time=None)
    outside = np.flatnonzero(deviation > BAND * peak)
    entered = float(t[outside[-1] + 1])  # the last value is inside the band
    is_quiet = float(t[-1]) - entered >= QUIET_SHARE * float(t[-1] - t[0])
    return Settling(moves=True, time=entered if is_quiet else None)
