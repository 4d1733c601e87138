"""Slider-cranks that synthesis found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from kempe.model.model import Model
from kempe.synthesis.candidate import Candidate
from kempe.synthesis.tasks import Complexes

#: Mass of a slider, kg.
_SLIDER = 1.0


@dataclass(frozen=True, eq=False, repr=False)
class SliderCrank(Candidate):
    """A slider-crank: the pin B of the coupler moves along a straight line.

    It has the attributes of a ``Candidate``, with ``slide`` in place of D. ``grashof`` means that
    the crank turns fully. The body ``slider`` replaces ``rocker``.
    """

    along: complex = 1.0

    @property
    def slide(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """A point of the line, B at the first position, and its direction."""
        b, way = self.pins[2], self.along
        return (b.real, b.imag), (way.real, way.imag)

    @property
    def points(self) -> Mapping[str, tuple[float, float]]:
        """O, A, B and P: pivot and pin of the crank, pin of the slider, the point."""
        return MappingProxyType({name: at for name, at in super().points.items() if name != "D"})

    @property
    def lengths(self) -> Mapping[str, float]:
        """``crank``, ``coupler``, and ``offset``, the distance of O from the line, m."""
        o, a, b, _, _ = self.pins
        offset = abs((np.conj(self.along) * (o - b)).imag)
        return MappingProxyType(
            {
                "crank": abs(a - o),
                "coupler": abs(b - a),
                "offset": float(offset),
            }
        )

    @property
    def type(self) -> str:
        """Either "slider-crank", or "slider-rocker" if the crank does not turn fully."""
        return "slider-crank" if self.turns else "slider-rocker"

    def _output(self, m: Model) -> dict[str, float]:
        b, angle = self.pins[2], float(np.angle(self.along))
        m.body("slider", mass=self._mass("slider", _SLIDER), inertia=0.0, points={"B": (0, 0)})
        m.revolute("B", "coupler.B", "slider.B")
        m.translational("slide", "ground.D", "slider.B", axes=(angle, 0.0))
        return {"slider.x": b.real, "slider.y": b.imag, "slider.angle": angle}

    def _couplers(self, pin: Complexes) -> Complexes:
        _, a, b, _, _ = self.pins
        coupler, across = abs(b - a), (np.conj(self.along) * (b - pin)).imag
        side = np.sign((np.conj(self.along) * (b - a)).real) or 1.0
        far = np.sqrt(np.maximum(coupler**2 - across**2, 0.0))
        return np.asarray(self.along * (side * far + 1j * across))
