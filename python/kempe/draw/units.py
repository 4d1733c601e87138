"""Units in which the numbers of an axis are short."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from kempe.base.display_units import chosen_for

#: SI prefixes by the power of ten.
_PREFIXES = {9: "G", 6: "M", 3: "k", 0: "", -3: "m", -6: "µ", -9: "n"}
#: The usual powers of ten for each unit; other powers are written as a factor such as 10³.
_CUSTOM = {
    "s": (0, -3, -6, -9),
    "m": (0, -3, -6, -9),
    "m/s": (0, -3, -6),
    "m/s²": (0, -3, -6),
    "N": (9, 6, 3, 0, -3, -6),
    "N·m": (9, 6, 3, 0, -3, -6),
    "J": (9, 6, 3, 0, -3, -6),
    "W": (9, 6, 3, 0, -3, -6),
    "Pa": (9, 6, 3, 0),
}
#: Angles are in degrees, as in tables, with a power of ten only outside of this range.
_DEGREE, _WRITTEN = math.pi / 180.0, (0.2, 1e6)
#: Numbers without unit have a power of ten only outside of this range.
_PLAIN = (1e-3, 1e4)
#: Numbers with more digits before the point have a power of ten.
_LONGEST = 7
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

#: Below this value, in SI units, a quantity is a rounding error and is shown as zero.
NOISE = 1e-9


@dataclass(frozen=True)
class Scale:
    """The scale of an axis.

    Attributes:
        divisor: divisor of values in SI units.
        unit: unit on the axis, such as "kN".
    """

    divisor: float
    unit: str

    def written(self, value: float) -> str:
        """A value in SI units as text, such as ``-12.3 kN`` or ``30°``, with a true minus sign."""
        shown = number(value / self.divisor)
        if self.unit == "1":
            return shown
        gap = "" if self.unit == "°" else "·" if self.unit.startswith("10") else " "
        return f"{shown}{gap}{self.unit}"

    def axis(self, symbol: str) -> str:
        """The label of an axis, such as ``F / kN``."""
        return axis_label(symbol, [self.unit])


def number(value: float, digits: int = 4) -> str:
    """A number for a figure, such as ``−12.3``, ``10000`` or ``1.2·10⁻⁵``, to some digits."""
    mantissa, _, power = f"{value:.{digits}g}".partition("e")
    if power and 0 < int(power) < _LONGEST:
        mantissa, power = f"{float(f'{mantissa}e{power}'):.0f}", ""
    shown = mantissa.replace("-", "\N{MINUS SIGN}")
    return f"{shown}·{power_of_ten(int(power))}" if power else shown


def axis_label(symbol: str, units: Sequence[str]) -> str:
    """The label of an axis: quantity / unit, such as ``v / (m/s)`` or ``x, φ / (m, rad)``."""
    text = ", ".join(units)
    return f"{symbol} / ({text})" if set(text) & set("/ ,") else f"{symbol} / {text}"


def scale(unit: str, peak: float) -> Scale:
    """The chosen display unit, or the scale with one to four digits before the point.

    Angles are in degrees, unless their unit was chosen.

    Args:
        unit: SI unit of the values.
        peak: largest magnitude in SI units.
    """
    chosen = chosen_for(unit)
    if chosen is not None:
        return Scale(chosen.divisor, chosen.symbol)
    if unit == "rad":
        power = _power(peak / _DEGREE) if not _WRITTEN[0] <= peak / _DEGREE < _WRITTEN[1] else 0
        return Scale(_DEGREE * 10.0**power, f"{power_of_ten(power)} °" if power else "°")
    power = _power(peak)
    if not power or (unit == "1" and _PLAIN[0] <= peak < _PLAIN[1]):
        return Scale(1.0, unit)
    if unit == "1":
        return Scale(10.0**power, power_of_ten(power))
    if power in _CUSTOM.get(unit, ()):
        return Scale(10.0**power, _PREFIXES[power] + unit)
    return Scale(10.0**power, f"{power_of_ten(power)} {unit}")


def power_of_ten(power: int) -> str:
    """Such as 10⁻³, in plain letters."""
    return f"10{str(power).translate(_RAISED)}"


def _power(peak: float) -> int:
    if peak < NOISE or 0.2 <= peak < 2.0:
        return 0
    return 3 * math.floor(math.log10(peak / 2.0 if peak >= 2.0 else peak) / 3.0)
