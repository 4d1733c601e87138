"""Numbers as they are printed in a report."""

from __future__ import annotations

from kempe.base.display_units import display
from kempe.lab_report.blocks import Number

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
#: Digits of a number, and of the size of an error.
DIGITS, FEW = 6, 3


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


def quantity(value: float, unit: str, usual: str | None = None, digits: int = DIGITS) -> str:
    """A number with its display unit, for a sentence."""
    symbol = display(unit, usual).symbol
    gap = "" if symbol == "°" else " "
    return f"{number(value, unit, usual, digits).text}{gap}{symbol}"
