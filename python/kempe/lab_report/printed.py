"""Numbers as they are printed in a report."""

from __future__ import annotations

import numpy as np

from kempe.base.arrays import Floats
from kempe.base.display_units import display
from kempe.lab_report.blocks import Number

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
#: Digits of a number, and of the size of an error.
DIGITS, FEW = 6, 3
#: Numbers below this part of the largest of their kind are rounding errors.
ROUNDING = 1e-12


def text(value: float, digits: int = DIGITS) -> str:
    """``-1.5e-7`` → ``−1.5·10⁻⁷``."""
    mantissa, _, exponent = f"{value + 0.0:.{digits}g}".partition("e")
    power = f"·10{str(int(exponent)).translate(_RAISED)}" if exponent else ""
    return mantissa.replace("-", "−") + power


def number(value: float, unit: str = "", usual: str | None = None, digits: int = DIGITS) -> Number:
    """A number in SI units, printed in its display unit.

    Args:
        value: the number.
        unit: its SI unit; empty for a number without a unit.
        usual: the unit where none was chosen.
        digits: significant digits in print.
    """
    divisor = display(unit, usual).divisor if unit else 1.0
    return Number(float(value), text(float(value) / divisor, digits))


def tidy(values: Floats, scale: float = 0.0) -> list[float]:
    """Numbers of one kind, with rounding errors replaced by zeros.

    Args:
        values: the numbers.
        scale: a natural magnitude of the numbers; the largest number is used if it is larger.
    """
    least = ROUNDING * float(np.abs(values).max(initial=scale))
    tidied: list[float] = np.where(np.abs(values) <= least, 0.0, values).tolist()
    return tidied


def quantity(value: float, unit: str, usual: str | None = None, digits: int = DIGITS) -> str:
    """A number with its display unit, for a sentence."""
    symbol = display(unit, usual).symbol
    gap = "" if symbol == "°" else " "
    return f"{number(value, unit, usual, digits).text}{gap}{symbol}"
