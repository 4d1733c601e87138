"""The independent variable of a motion: the time, or the value of a driven quantity."""

from __future__ import annotations

from dataclasses import dataclass

from kempe import _core

#: The units of forces and torques.
_FORCES = ("N", "N*m", "N·m")


@dataclass(frozen=True)
class Variable:
    """The quantity in the array ``t`` of a motion.

    Attributes:
        name: "t", or a position quantity such as "crank.angle".
        unit: its SI unit: "s", "m" or "rad".
        static: whether the mechanism is at rest at each value; otherwise the value grows at unit
            rate.
    """

    name: str = "t"
    unit: str = "s"
    static: bool = False

    @property
    def is_time(self) -> bool:
        """Whether it is the time."""
        return self.name == TIME.name

    @property
    def words(self) -> str:
        """Its name in a sentence or on an axis: "time t", or the name of the quantity."""
        return f"time {self.name}" if self.is_time else self.name

    def rate(self, unit: str) -> str:
        """The SI unit of a rate: m/s over time, m/rad over an angle, and so on; W becomes J/rad."""
        return unit if self.is_time else _core.rate_unit(unit, self.unit)

    def integral(self, unit: str) -> str:
        """The SI unit of an integral: N*s over time, N*m*rad over an angle, and so on.

        A rate becomes the quantity itself, W becomes J, and an unknown unit remains unknown.
        """
        if unit in ("", "SI"):
            return unit
        if " or " in unit:
            return " or ".join(map(self.integral, unit.split(" or ")))
        if unit in ("1", "W", self.unit):
            return {"1": self.unit, "W": "J"}.get(unit, f"{unit}^2")
        whole, rate, order = unit.rpartition(f"/{self.unit}")
        if rate and order in ("", "^2"):
            return whole + (rate if order else "")
        return f"{unit}*{self.unit}"

    @property
    def condition(self) -> str:
        """What forces over a driven quantity contain, in words; empty over time."""
        if self.static:
            return "at rest, without inertia and damping"
        return "" if self.is_time else f"with inertia and damping at 1 {self.unit}/s"

    def condition_of(self, unit: str) -> str:
        """``condition`` for values of an SI unit of forces, torques or powers; otherwise empty."""
        return self.condition if unit in (*_FORCES, self.rate("W")) else ""


#: The variable of all motions that are not over a driven quantity.
TIME = Variable()
