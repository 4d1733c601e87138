"""When a motion comes to rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kempe.arrays import Floats

#: Settled: within this share of the largest deviation from the final value.
BAND = 0.005
#: The last sample is always within its own band; to count, a motion must stay there for the last
#: tenth of the time.
QUIET_SHARE = 0.1


@dataclass(frozen=True)
class Settling:
    """How a quantity settles.

    Attributes:
        moves: whether it changes at all.
        time: when it enters the band for good, s; None if it does not settle.
    """

    moves: bool
    time: float | None


def settling(t: Floats, values: Floats) -> Settling:
    """When a quantity stays within 0.5 % of its largest deviation from the final value.

    Args:
        t: (n_t,), s.
        values: (n_t,).
    """
    deviation = np.abs(values - values[-1])
    peak = float(deviation.max())
    if peak <= 1e-12 * max(1.0, float(np.abs(values).max())):
        return Settling(moves=False, time=None)
    outside = np.flatnonzero(deviation > BAND * peak)
    entered = float(t[outside[-1] + 1])  # the last value is never outside
    is_quiet = float(t[-1]) - entered >= QUIET_SHARE * float(t[-1] - t[0])
    return Settling(moves=True, time=entered if is_quiet else None)
