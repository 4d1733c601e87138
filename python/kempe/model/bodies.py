"""Entries for bodies: the slender bar, the general body and the point mass."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from kempe.model.element import Element
from kempe.model.values import Curves, Number, Outline, Pair, Points, Shapes


@dataclass(frozen=True)
class Bar(Element):
    """Uniform slender bar: frame at its centre, x along it, inertia mass·length²/12.

    Attributes:
        mass: kg.
        length: m; optional if ``through`` gives both ends.
        ends: names of the points at (-length/2, 0) and (length/2, 0).
        through: global coordinates of two named points, m; initial placement of the bar.
        points: further named points in the frame of the bar, m.
        curves: named curves in the frame of the bar.
        outline: its shape in drawings.
    """

    mass: Number
    length: Number | None = None
    ends: Sequence[str] | None = None
    through: Points | None = None
    points: Points | None = None
    curves: Curves | None = None
    outline: Outline | None = None
    section: ClassVar[str] = "bodies"
    kind: ClassVar[str] = "bar"
    value_kinds: ClassVar[Mapping[str, str]] = {
        "mass": "number",
        "length": "number",
        "ends": "names",
        "through": "points",
        "points": "points",
        "curves": "curves",
        "outline": "outline",
    }


@dataclass(frozen=True)
class Body(Element):
    """General rigid body.

    Attributes:
        mass: kg.
        inertia: about the mass centre, kg·m².
        center: mass centre in the body's frame, m.
        points: named points in the body's frame, m.
        through: global coordinates of two named points, m; initial placement of the body.
        curves: named curves in the body's frame.
        shapes: homogeneous pieces, instead of mass, inertia and center.
        outline: its shape in drawings.
    """

    mass: Number | None = None
    inertia: Number | None = None
    center: Pair = (0.0, 0.0)
    points: Points | None = None
    through: Points | None = None
    curves: Curves | None = None
    shapes: Shapes | None = None
    outline: Outline | None = None
    section: ClassVar[str] = "bodies"
    kind: ClassVar[str] = "body"
    value_kinds: ClassVar[Mapping[str, str]] = {
        "mass": "number",
        "inertia": "number",
        "center": "pair",
        "points": "points",
        "through": "points",
        "curves": "curves",
        "shapes": "shapes",
        "outline": "outline",
    }


@dataclass(frozen=True)
class PointMass(Element):
    """A point with mass and one named point, P. It has no angle.

    Attributes:
        mass: kg.
        at: position in the global frame when assembly starts, m.
        outline: its shape in drawings.
    """

    mass: Number
    at: Pair | None = None
    outline: Outline | None = None
    section: ClassVar[str] = "bodies"
    kind: ClassVar[str] = "point_mass"
    value_kinds: ClassVar[Mapping[str, str]] = {
        "mass": "number",
        "at": "pair",
        "outline": "outline",
    }
