"""Cases in other units of length and mass: every field is multiplied by the scale of its unit.

Formulas stay as they are. A formula f becomes K*(f), where K is the scale of the unit of the field,
and each length in it, such as `crank.x`, is divided by the scale of lengths. Parameters and tables
therefore keep their values.
"""

import json
import re
from copy import deepcopy
from fractions import Fraction

from kempe import _core

#: Exponents of length and mass in the units of fields. Time, angles and currents are not scaled.
_BASE = {"m": (1, 0), "kg": (0, 1), "N": (1, 1), "V": (2, 1), "Ohm": (2, 1), "H": (2, 1)}
_LENGTHS = ["x", "y", "vx", "vy", "ax", "ay", "displacement", "length", "gap", "gap_rate"]
_CATALOGUE = json.loads(_core.catalogue())
_FIELDS = {
    (section, one["name"]): {field["name"]: field for field in one["fields"]}
    for section in ("bodies", "shapes", "joints", "drivers", "forces")
    for one in _CATALOGUE[section]
}
_QUANTITY = re.compile(r"\b([A-Za-z_]\w*(?:\.\w+)+)")
#: A number with a unit: the whole text of a field.
_WITH_UNIT = re.compile(r"\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s+([A-Za-z].*)")


def dimension(unit):
    """Exponents of length and mass of a unit."""
    total = [Fraction(0), Fraction(0)]
    for sign, name, power in re.findall(r"([*/]?)([A-Za-z]+)(?:\^(\d+))?", unit):
        length, mass = _BASE.get(name, (0, 0))
        exponent = int(power or 1) * (-1 if sign == "/" else 1)
        total[0] += length * exponent
        total[1] += mass * exponent
    return tuple(total)


class Scaled:
    """A case with lengths and masses in other units.

    Args:
        tree: the case.
        length: factor of all lengths.
        mass: factor of all masses.
    """

    def __init__(self, tree, length, mass):
        self.length, self.mass = length, mass
        self.tree = deepcopy(tree)
        if "gravity" in self.tree:
            self.tree["gravity"] = self._each(self.tree["gravity"], "m")
        for name, body in self.tree["bodies"].items():
            kind = "ground" if name == "ground" else body.get("type", "body")
            body.pop("outline", None)
            self._fields("bodies", kind, body)
        for section in ("joints", "drivers", "forces"):
            for one in self.tree.get(section, {}).values():
                self._fields(section, one["type"], one)
        for values in self.tree.get("start", {}).values():
            for name in values:
                values[name] = self._value(values[name], self._of(name))
        for analysis in self.tree.get("analyses", {}).values():
            if "stop" in analysis:
                analysis["stop"] = self._formula(analysis["stop"])
        self.tree.pop("measures", None)

    def factor(self, unit):
        """The scale of a unit."""
        length, mass = dimension(unit)
        return float(self.length) ** float(length) * float(self.mass) ** float(mass)

    def _of(self, quantity):
        return "m" if quantity.rpartition(".")[2] in _LENGTHS else "rad"

    def _formula(self, text):
        if not isinstance(text, str):
            return text

        def quantity(found):
            name = found[1]
            return f"({name}/{self.length!r})" if self._of(name) == "m" else name

        return _QUANTITY.sub(quantity, text)

    def _value(self, value, unit):
        factor = self.factor(unit)
        if isinstance(value, str):
            if found := _WITH_UNIT.fullmatch(value):
                return f"{float(found[1]) * factor!r} {found[2]}"
            return f"{factor!r}*({self._formula(value)})"
        return value * factor

    def _each(self, values, unit):
        if isinstance(values, dict):
            return {name: self._each(value, unit) for name, value in values.items()}
        if isinstance(values, list):
            return [self._each(value, unit) for value in values]
        return self._value(values, unit)

    def _fields(self, section, kind, one):
        known = _FIELDS[section, kind]
        powers = {
            name: self._unit(kind, one, field["unit"])
            for name, field in known.items()
            if name in one and field["unit"]
        }
        for name, unit in powers.items():
            if "," in unit:
                one[name] = [
                    self._each(x, u) for x, u in zip(one[name], unit.split(","), strict=True)
                ]
            else:
                one[name] = self._each(one[name], unit)
        for shape in one.get("shapes", []):
            self._fields("shapes", shape["type"], shape)
        for curve in one.get("curves", {}).values():
            for name in ("x", "y", "polar", "points", "circle", "line"):
                if name in curve:
                    curve[name] = self._each(curve[name], "m")

    def _unit(self, kind, one, unit):
        """The unit of a field, where it depends on other fields."""
        length = self._of(one.get("coordinate", "x")) == "m"
        if unit == "any" and kind in ("stop", "contact"):
            power = one.get("exponent", 1 if kind == "stop" else 1.5)
            if not length:
                return "N*m"
            return "N" + "/m" * int(power) if power == int(power) else "N/m"
        if kind == "coupling":
            return one.get("unit", "m")
        first, _, second = unit.partition("|")
        return first if length or not second else second
