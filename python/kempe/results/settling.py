"""Settling times."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from kempe import _core
from kempe.base.arrays import Floats


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
        between: function that returns the quantity at any times. With it, the settling time is the
            time at which the quantity enters the band; otherwise it is the first of ``t`` in the
            band.
        noise: the largest deviation of a quantity that does not change; 1e-12 of the largest value
            by default, at least 1e-12.
    """
    moves, time = _core.settling(t, values, noise, between)
    return Settling(moves, time)
