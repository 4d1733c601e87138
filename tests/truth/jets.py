"""Numbers with two derivatives along a direction, by the rules of calculus."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Jet:
    """A value with its first and second derivative by one variable."""

    value: float
    first: float = 0.0
    second: float = 0.0

    def __add__(self, other: Jet | float) -> Jet:
        o = jet(other)
        return Jet(self.value + o.value, self.first + o.first, self.second + o.second)

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.first, -self.second)

    def __sub__(self, other: Jet | float) -> Jet:
        return self + (-jet(other))

    def __mul__(self, other: Jet | float) -> Jet:
        o = jet(other)
        second = self.second * o.value + 2 * self.first * o.first + self.value * o.second
        return Jet(self.value * o.value, self.first * o.value + self.value * o.first, second)

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
