"""Entries for beams, and their cross sections."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from kempe.model.element import Element
from kempe.model.values import Number, Pair


class Section(dict[str, Any]):
    """A cross section of a beam. The height lies in the plane of the mechanism.

    The shear stiffness of a beam is the shear modulus times the area times a factor: 5/6 for a
    rectangle, 0.9 for a circle, 0.5 for a thin tube.
    """

    @classmethod
    def rectangle(cls, height: Number, width: Number) -> Section:
        """A rectangle; height and width in m, or formulas such as "2 mm"."""
        return cls(rectangle=[height, width])

    @classmethod
    def circle(cls, diameter: Number) -> Section:
        """A full circle; diameter in m."""
        return cls(circle=diameter)

    @classmethod
    def tube(cls, outer: Number, inner: Number) -> Section:
        """A tube; outer and inner diameter in m."""
        return cls(tube=[outer, inner])


@dataclass(frozen=True)
class Beam(Element):
    """Geometrically exact beam: a link that bends.

    Attributes:
        ends: names of the first and the last end.
        length: of a straight beam, m.
        through: global positions of points of the centre line, m; initial placement of the beam.
        arc: centre x and y, radius, first and last angle of a circular centre line, m and rad.
        cross_section: the ``section`` of the file.
        young: Young's modulus, Pa.
        poisson: Poisson's ratio; 0.3 if absent.
        density: kg/m³.
        EA: axial stiffness, N, in place of section and young.
        EI: bending stiffness, N·m².
        GA: effective shear stiffness, N.
        mass_per_length: kg/m, in place of density.
        inertia_per_length: of the sections, kg·m.
        damping: damping in proportion to stiffness, s.
        elements: number of elements.
        points: arc lengths of named points, m, or "50 %".
        shear: whether sections may shear.
        inextensible: whether the centre line keeps its length.
    """

    ends: Sequence[str] | None = None
    length: Number | None = None
    through: Sequence[Pair] | None = None
    arc: Sequence[Number] | None = None
    cross_section: Mapping[str, Any] | None = None
    young: Number | None = None
    poisson: Number | None = None
    density: Number | None = None
    EA: Number | None = None
    EI: Number | None = None
    GA: Number | None = None
    mass_per_length: Number | None = None
    inertia_per_length: Number | None = None
    damping: Number | None = None
    elements: int | None = None
    points: Mapping[str, Number] | None = None
    shear: bool = True
    inextensible: bool = False
    section: ClassVar[str] = "bodies"
    kind: ClassVar[str] = "beam"
    keys: ClassVar[Mapping[str, str]] = {"cross_section": "section"}
    value_kinds: ClassVar[Mapping[str, str]] = {
        "ends": "names",
        "length": "number",
        "through": "ranges",
        "arc": "laws",
        "cross_section": "section",
        "young": "number",
        "poisson": "number",
        "density": "number",
        "EA": "number",
        "EI": "number",
        "GA": "number",
        "mass_per_length": "number",
        "inertia_per_length": "number",
        "damping": "number",
        "elements": "number",
        "points": "terms",
        "shear": "flag",
        "inextensible": "flag",
    }
