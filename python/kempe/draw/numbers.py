"""Numbers of a drawing: nine significant digits, ready for JSON."""

from __future__ import annotations

import math
from typing import Any

from kempe.base.arrays import Floats


def plain(values: Floats, digits: int = 9) -> Any:
    """Nested lists of the values to nine significant digits; None for non-finite values."""
    return rounded_all(values.tolist(), digits)


def rounded_all(data: Any, digits: int = 9) -> Any:
    """The data with every fractional number rounded to nine significant digits."""
    if isinstance(data, dict):
        return {key: rounded_all(value, digits) for key, value in data.items()}
    if isinstance(data, list):
        return [rounded_all(value, digits) for value in data]
    return rounded(data, digits) if isinstance(data, float) else data


def rounded(value: float, digits: int = 9) -> float | None:
    """Nine significant digits, no negative zero; None for values that are not finite."""
    return float(f"{value:.{digits}g}") + 0.0 if math.isfinite(value) else None


def round_below(value: float) -> float:
    """The largest of 1, 2, 5, 10, 20, 50 … that is not above a positive value."""
    power = float(f"1e{math.floor(math.log10(value))}")
    return next((step * power for step in (5.0, 2.0) if step * power <= value), power)
