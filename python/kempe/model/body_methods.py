"""The methods of ``Model`` that add bodies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from kempe.model.beams import Beam
from kempe.model.bodies import Bar, Body, PointMass
from kempe.model.elements import E
from kempe.model.values import Curves, Number, Outline, Pair, Points, Shapes


class BodyMethods:
    """The methods of ``Model`` that add a body.

    The ``outline`` of a body is its shape in drawings, instead of a link around its points. It
    changes no number and is one of: points ``[(x, y), …]``; ``{"circle": (x, y, r)}``;
    ``{"path": "M 0 0 L …"}`` with the path data of SVG in m, y upwards.
    """

    def _add(self, element: E) -> E:
        raise NotImplementedError

    def bar(
        self,
        name: str,
        *,
        mass: Number,
        length: Number | None = None,
        ends: tuple[str, str] | None = None,
        through: Points | None = None,
        points: Points | None = None,
        curves: Curves | None = None,
        outline: Outline | None = None,
    ) -> Bar:
        """Add a uniform slender bar: frame at its centre, x along it, inertia mass·length²/12.

        Args:
            name: name of the bar.
            mass: kg.
            length: m; optional if ``through`` gives both ends.
            ends: names of the points at (-length/2, 0) and (length/2, 0).
            through: global coordinates of two named points, m: ``{"B": (3.4, 9.4), …}``.
            points: further named points in the frame of the bar, m.
            curves: named curves in the frame of the bar, for joints on curves; see ``body``.
            outline: its shape in drawings: points, circle or path, m.
        """
        return self._add(Bar(name, mass, length, ends, through, points, curves, outline))

    def body(
        self,
        name: str,
        *,
        mass: Number | None = None,
        inertia: Number | None = None,
        center: Pair = (0.0, 0.0),
        points: Points | None = None,
        through: Points | None = None,
        curves: Curves | None = None,
        shapes: Shapes | None = None,
        outline: Outline | None = None,
    ) -> Body:
        """Add a general rigid body, by mass, inertia and center or by shapes.

        Args:
            name: name of the body.
            mass: kg.
            inertia: about the mass centre, kg·m².
            center: mass centre in the body's frame, m.
            points: named points in the body's frame, m.
            through: global coordinates of two named points, m.
            curves: named curves in the body's frame, for joints on curves, each in one of the forms
                ``{"x": "…u…", "y": "…u…", "range": (a, b), "periodic": False}``,
                ``{"polar": "r(u)"}``, ``{"points": [(x, y), …], "periodic": False,
                "interpolation": "quintic"}``, ``{"circle": (x, y, r)}``,
                ``{"line": [(x, y), (x, y)]}`` and, for contacts, ``{"polygon": [(x, y), …]}``.
            shapes: homogeneous pieces that give mass, inertia and mass centre: ``{"type": "rod",
                "length": L}``, ``{"type": "plate", "width": w, "height": h}``, ``{"type": "disc",
                "radius": r}``, ``{"type": "ring", "inner": a, "outer": b}`` or ``{"type":
                "polygon", "points": [(x, y), …]}``, each with ``at`` and ``angle`` of its frame in
                that of the body, and ``mass``, or ``density`` and ``thickness`` (of a rod:
                ``area``). A hole has a negative mass or density.
            outline: its shape in drawings: points, circle or path, m; by default the shapes, or
                a link around its points.
        """
        given = (mass, inertia, center, points, through, curves, shapes, outline)
        return self._add(Body(name, *given))

    def beam(
        self,
        name: str,
        *,
        ends: tuple[str, str] | None = None,
        length: Number | None = None,
        through: Sequence[Pair] | None = None,
        arc: Sequence[Number] | None = None,
        section: Mapping[str, Any] | None = None,
        young: Number | None = None,
        poisson: Number | None = None,
        density: Number | None = None,
        EA: Number | None = None,
        EI: Number | None = None,
        GA: Number | None = None,
        mass_per_length: Number | None = None,
        inertia_per_length: Number | None = None,
        damping: Number | None = None,
        elements: int | None = None,
        points: Mapping[str, Number] | None = None,
        shear: bool = True,
        inextensible: bool = False,
    ) -> Beam:
        """Add a beam: a link that bends, stretches and shears, at large rotations.

        Its ends and named points are points for joints, forces and measures, and have an angle,
        such as ``rod.B.angle``. Its frame is that of its first end, with x along the tangent.

        Args:
            name: name of the beam.
            ends: names of the first and the last end; A and B by default.
            length: of a straight beam, m.
            through: global positions of points of the centre line when assembly starts, m.
            arc: centre x and y, radius, first and last angle of a circular centre line, m and rad.
            section: such as ``kp.Section.rectangle(height=0.01, width=0.02)``.
            young: Young's modulus of the section, Pa.
            poisson: Poisson's ratio of the section; 0.3 by default.
            density: of the section, kg/m³.
            EA: axial stiffness, N; EA, EI and GA take the place of section and young.
            EI: bending stiffness, N·m².
            GA: effective shear stiffness, N.
            mass_per_length: kg/m, in place of density.
            inertia_per_length: of the sections, kg·m; by default mass_per_length·EI/EA.
            damping: efforts per rate of strain, relative to the stiffness, s; 0 by default.
            elements: number of elements of the third degree, each with three nodes of its own.
            points: further named points by their arc lengths, m, or shares such as ``"50 %"``.
            shear: whether the sections may shear.
            inextensible: whether the centre line keeps its length.
        """
        line = (ends, length, through, arc, section, young, poisson, density, EA, EI, GA)
        masses = (mass_per_length, inertia_per_length, damping)
        given = (*line, *masses, elements, points, shear, inextensible)
        return self._add(Beam(name, *given))

    def point_mass(
        self, name: str, *, mass: Number, at: Pair | None = None, outline: Outline | None = None
    ) -> PointMass:
        """Add a point with mass. It has no angle and one named point, P.

        Args:
            name: name of the point mass.
            mass: kg.
            at: position in the global frame when assembly starts, m.
            outline: its shape in drawings: points, circle or path, m.
        """
        return self._add(PointMass(name, mass, at, outline))
