"""The units in which tables, figures and CSV files show their numbers.

Arrays, saved solutions and the JSON summary are always in SI units and rad; only displayed numbers
are converted. A chosen unit of length or angle also determines the units of velocity and
acceleration: "mm" implies mm/s and mm/s^2.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import cache
from itertools import product
from types import TracebackType
from typing import NoReturn

from kempe import _core
from kempe.base.arguments import explained
from kempe.base.names import UnknownNameError, unknown
from kempe.errors import ModelError

#: The SI unit of each combination of base units. A torque has the unit N*m, an energy the unit J.
_QUANTITIES: Mapping[str, str] = {
    "m": "m",
    "rad": "rad",
    "s": "s",
    "kg": "kg",
    "A": "A",
    "V": "V",
    "m s^-1": "m/s",
    "rad s^-1": "rad/s",
    "m s^-2": "m/s^2",
    "rad s^-2": "rad/s^2",
    "N": "N",
    "J": "J",
    "W": "W",
    "N m": "N*m",
    "kg m^2": "kg*m^2",
}
#: Units of velocity and acceleration that follow from those of length and angle.
_FOLLOWING = {"m": ("m/s", "m/s^2"), "rad": ("rad/s", "rad/s^2")}
_FACTOR = re.compile(r"([*/]?)\s*([A-Za-zµ°]+)(?:\^(-?\d))?\s*")
#: Full names of units, in the singular.
_FULL = {
    **{"metre": "m", "millimetre": "mm", "centimetre": "cm", "kilometre": "km", "inch": "in"},
    **{"degree": "deg", "radian": "rad", "second": "s", "minute": "min", "hour": "h"},
    **{"kilogram": "kg", "newton": "N", "joule": "J", "watt": "W", "ampere": "A", "volt": "V"},
}
_SPELLINGS = {"°": "deg", "µ": "u", "·": "*", "²": "^2", "Ω": "Ohm"}
_SYMBOLS = {"deg": "°", "um": "µm", "us": "µs", "*": "·", "^2": "²", "Ohm": "Ω"}


@dataclass(frozen=True)
class Shown:
    """The unit in which a quantity is shown.

    Attributes:
        unit: the unit in plain letters, such as "mm/s^2" or "deg".
        divisor: divisor of values in SI units.
    """

    unit: str
    divisor: float = 1.0

    @property
    def symbol(self) -> str:
        """The unit as in print, such as "mm/s²" or "°"."""
        text = self.unit
        for plain, printed in _SYMBOLS.items():
            text = re.sub(rf"\b{plain}\b" if plain.isalpha() else re.escape(plain), printed, text)
        return text


@dataclass(frozen=True)
class Units:
    """The current display units; a ``with`` statement restores the earlier units at its end.

    Attributes:
        chosen: the units that were chosen, in the order of the choice; empty for SI units.
    """

    chosen: tuple[str, ...] = ()
    _shown: Mapping[str, Shown] = field(default_factory=dict, repr=False)
    _before: Units | None = field(default=None, repr=False, compare=False)

    def __enter__(self) -> Units:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        _set(self._before or SI)

    def __repr__(self) -> str:
        return f"<Units {', '.join(self.chosen) or 'SI'}>"


SI = Units()
_current = SI


@explained
def units(*names: str) -> Units:
    """Choose the units of tables, figures and CSV files.

    For example, ``kp.units("mm", "deg", "rpm")``, or ``kp.units("mm,deg,rpm")``.
    Quantities without a chosen unit are shown in SI units. Arrays are always in SI units.

    Args:
        names: one unit for each quantity to be shown in another unit: of length, angle, time,
            velocity, angular velocity, acceleration, force (``"kN"``), torque (``"N*mm"``), energy,
            power, mass or current. ``"SI"`` returns to SI units; no name changes nothing.

    Returns:
        The current units. ``with kp.units("mm"): …`` limits them to a block.

    Raises:
        ModelError: a unit is unknown, measures no shown quantity, or repeats a quantity.
    """
    if not names:
        return _current
    if any(not isinstance(name, str) for name in names):
        raise ModelError(f"units: {names!r} are not texts", hint='write kp.units("mm", "deg")')
    chosen = tuple(word.strip() for name in names for word in name.split(",") if word.strip())
    if not chosen:
        raise ModelError("units: the text names no unit", hint='write kp.units("mm", "deg")')
    if chosen in (("SI",), ("si",)):
        return _set(Units((), {}, _current))
    return _set(Units(chosen, _table(chosen), _current))


def chosen_for(unit: str) -> Shown | None:
    """The chosen unit of a quantity; None where no unit was chosen.

    Args:
        unit: its SI unit, such as "m/s^2" or "m/s²".
    """
    return _current._shown.get(_plain(unit))


def display(unit: str, otherwise: str | None = None) -> Shown:
    """The display unit of a quantity.

    Args:
        unit: its SI unit, such as "m/s^2" or "m/s²".
        otherwise: the unit where none was chosen, such as "deg" for angles; the SI unit by default.
    """
    found = chosen_for(unit)
    if found is not None:
        return found
    return Shown(unit) if otherwise is None else Shown(otherwise, _parsed(otherwise)[1])


def heading(symbol: str, unit: str, otherwise: str | None = None) -> str:
    """Header of a column, such as ``x / mm``; see ``display``."""
    return f"{symbol} / {display(unit, otherwise).symbol}"


def _set(chosen: Units) -> Units:
    global _current  # noqa: PLW0603 - one choice for all tables and figures
    _current = chosen
    return chosen


def _table(chosen: tuple[str, ...]) -> dict[str, Shown]:
    """The display unit by SI unit, with the units that follow."""
    found: dict[str, Shown] = {}
    for name in chosen:
        quantity, divisor = _parsed(name)
        if quantity in found:
            raise ModelError(
                f"units: {found[quantity].unit!r} and {name!r} measure the same quantity",
                hint="choose one of them",
            )
        found[quantity] = Shown(_plain(name), divisor)
    for quantity, rates in _FOLLOWING.items():
        if quantity in found:
            base = found[quantity]
            for rate, over in zip(rates, ("/s", "/s^2"), strict=True):
                found.setdefault(rate, Shown(base.unit + over, base.divisor))
    return found | _derivatives(found)


def _derivatives(found: Mapping[str, Shown]) -> dict[str, Shown]:
    """The units of derivatives by a length or an angle, such as mm/° for m/rad."""
    derived = {}
    for of, by in product(("m", "rad", "J"), ("m", "rad")):
        if of in found or by in found:
            top, bottom = found.get(of, Shown(of)), found.get(by, Shown(by))
            for order in ("", "^2"):
                divisor = top.divisor / bottom.divisor ** (2 if order else 1)
                derived[f"{of}/{by}{order}"] = Shown(f"{top.unit}/{bottom.unit}{order}", divisor)
    return derived


def _parsed(text: str) -> tuple[str, float]:
    """SI unit of the quantity that a unit measures, and the factor to that unit."""
    divisor, powers, at = 1.0, Counter[str](), 0
    plain = _plain(text)
    while at < len(plain):
        match = _FACTOR.match(plain, at)
        if match is None or bool(match[1]) != bool(at):
            raise ModelError(
                f"units: {text!r} is not a unit", hint='write such as "mm", "deg/s" or "N*mm"'
            )
        power = int(match[3] or 1) * (-1 if match[1] == "/" else 1)
        factor, bases = _known(match[2])
        divisor *= factor**power
        for base, exponent in bases.items():
            powers[base] += exponent * power
        at = match.end()
    written = " ".join(
        base if power == 1 else f"{base}^{power}" for base, power in sorted(powers.items()) if power
    )
    if written not in _QUANTITIES:
        _refuse(text)
    return _QUANTITIES[written], divisor


def _refuse(text: str) -> NoReturn:
    raise ModelError(
        f"units: {text!r} measures no shown quantity",
        hint="there are units of " + ", ".join(_QUANTITIES.values()),
    )


def _known(name: str) -> tuple[float, Mapping[str, int]]:
    """Factor to SI and powers of the units that quantities are written with."""
    table = _units()
    if name not in table:
        spelt = get_close_matches(name.lower().rstrip("s"), _FULL, n=1, cutoff=0.8)
        if spelt:
            hint = f"write {_FULL[spelt[0]]!r}"
            raise UnknownNameError(f"unknown unit {name!r}", name=name, hint=hint)
        raise unknown("unit", name, table)
    return table[name]


@cache
def _units() -> dict[str, tuple[float, Mapping[str, int]]]:
    """The units of formulas. A unit such as kN has the base N."""
    told = json.loads(_core.catalogue())["units"]
    alike = {entry["dimension"]: entry["name"] for entry in told if entry["si"] == 1.0}
    bases: dict[str, Mapping[str, int]] = {name: {"rad": 1, "s": -1} for name in ("rpm", "rps")}
    found = {}
    for entry in told:
        base = bases.get(entry["name"], {alike.get(entry["dimension"], entry["name"]): 1})
        found[entry["name"]] = (float(entry["si"]), base)
    return found


def _plain(text: str) -> str:
    """A unit in plain letters; blanks between names mean a product."""
    for printed, plain in _SPELLINGS.items():
        text = text.replace(printed, plain)
    return "*".join(re.sub(r"\s*([*/])\s*", r"\1", text).split())
