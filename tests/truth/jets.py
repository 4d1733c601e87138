"""Numbers with two derivatives along a direction, by the rules of calculus."""

from __future__ import annotations

import math
from dataclasses import dataclass


# not frozen: a frozen object takes three times as long to make, and tests make millions
@dataclass(slots=True, eq=False)
class Jet:
    """A value with its first and second derivative by one variable."""

    value: float
    first: float = 0.0
    second: float = 0.0

    def __add__(self, other: Jet | float) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value + other, self.first, self.second)
        return Jet(self.value + other.value, self.first + other.first, self.second + other.second)

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.first, -self.second)

    def __sub__(self, other: Jet | float) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value - other, self.first, self.second)
        return Jet(self.value - other.value, self.first - other.first, self.second - other.second)

    def __mul__(self, other: Jet | float) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value * other, self.first * other, self.second * other)
        x, y = self.value, other.value
        second = self.second * y + 2 * self.first * other.first + x * other.second
        return Jet(x * y, self.first * y + x * other.first, second)

    __radd__, __rmul__ = __add__, __mul__

    def of(self, value: float, slope: float, curvature: float) -> Jet:
        """A function with this value and these derivatives, by the chain rule."""
        return Jet(value, slope * self.first, curvature * self.first**2 + slope * self.second)


def jet(x: Jet | float) -> Jet:
    return x if isinstance(x, Jet) else Jet(float(x))


def sin(x: Jet) -> Jet:
    s, c = math.sin(x.value), math.cos(x.value)
    return x.of(s, c, -s)


def cos(x: Jet) -> Jet:
    s, c = math.sin(x.value), math.cos(x.value)
    return x.of(c, -s, -c)


def root(x: Jet) -> Jet:
    r = math.sqrt(x.value)
    return x.of(r, 0.5 / r, -0.25 / r**3)


def inverse(x: Jet) -> Jet:
    y = 1.0 / x.value
    return x.of(y, -y * y, 2 * y**3)
