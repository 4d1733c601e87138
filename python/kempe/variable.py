"""The independent variable of a motion: the time, or the value of a driven quantity."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Variable:
    """The quantity in the array ``t`` of a motion.

    Attributes:
        name: "t", or a position quantity such as "crank.angle".
        unit: its SI unit: "s", "m" or "rad".
    """

    name: str = "t"
    unit: str = "s"

    @property
    def is_time(self) -> bool:
        """Whether it is the time."""
        return self.name == TIME.name

    @property
    def words(self) -> str:
        """Its name in a sentence or on an axis: "time t", or the name of the quantity."""
        return f"time {self.name}" if self.is_time else self.name


#: The variable of all motions that are not over a driven quantity.
TIME = Variable()
