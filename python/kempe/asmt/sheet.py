"""The lines of an assembly file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

#: Rows of a rotation matrix; its columns are the axes of the turned frame.
Rotation = tuple[tuple[float, float, float], ...]


def about_z(angle: float) -> Rotation:
    """The frame that is turned about z; its z axis is normal to the plane."""
    c, s = math.cos(angle), math.sin(angle)
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)


def along(angle: float) -> Rotation:
    """A frame whose z axis lies in the plane, at this angle from x; its y axis is the normal."""
    c, s = math.cos(angle), math.sin(angle)
    return (-s, 0.0, c), (c, 0.0, s), (0.0, 1.0, 0.0)


@dataclass
class Solid:
    """A part, or the assembly itself, with its markers.

    Attributes:
        name: its name.
        place, angle: its frame at the start, m and rad.
        velocity, omega: of its origin, m/s; rad/s.
        mass, inertia, center: kg; kg·m² about the centre; m in its frame. None for the assembly.
        markers: place in the part, m, and frame of each marker.
        points: names of the markers of the points of its body.
    """

    name: str
    place: tuple[float, float] = (0.0, 0.0)
    angle: float = 0.0
    velocity: tuple[float, float] = (0.0, 0.0)
    omega: float = 0.0
    mass: float | None = None
    inertia: float = 0.0
    center: tuple[float, float] = (0.0, 0.0)
    markers: dict[str, tuple[tuple[float, float], Rotation]] = field(default_factory=dict)
    points: dict[str, str] = field(default_factory=dict)

    def marker(self, wanted: str, at: tuple[float, float], turn: Rotation) -> str:
        """The name of a marker with this place and frame; a new one is named as wanted."""
        for name, known in self.markers.items():
            if known == (at, turn):
                return name
        name, k = wanted, 2
        while name in self.markers or name == "MassMarker":
            name, k = f"{wanted}_{k}", k + 1
        self.markers[name] = (at, turn)
        return name


#: Class, name and fields of a joint, a motion, a limit or a force.
Entry = tuple[str, str, Mapping[str, str]]


@dataclass
class Sheet:
    """All parts of an assembly, and its text."""

    assembly: Solid
    parts: list[Solid] = field(default_factory=list)
    sections: dict[str, list[Entry]] = field(
        default_factory=lambda: {"Joints": [], "Motions": [], "Limits": [], "ForceTorques": []}
    )
    gravity: tuple[float, float] = (0.0, 0.0)
    t_end: float = 1.0
    step: float = 0.01
    lines: list[str] = field(default_factory=list)

    def text(self) -> str:
        """The file."""
        self.lines = ["OndselSolver", "Assembly"]
        self._pair(1, "Notes", "(Text string: '' runs: (Core.RunArray runs: #() values: #()))")
        self._solid(1, self.assembly)
        self._put(1, "Parts")
        for part in self.parts:
            self._put(2, "Part")
            self._solid(3, part)
        self._put(1, "KinematicIJs")
        self._put(1, "ConstraintSets")
        for section in ("Joints", "Motions", "Limits"):
            self._put(2, section)
            self._entries(3, section)
        self._put(2, "GeneralConstraintSets")
        self._put(1, "ForceTorques")
        self._entries(2, "ForceTorques")
        self._put(1, "ConstantGravity")
        self._numbers(2, (*self.gravity, 0.0))
        self._settings()
        return "\n".join(self.lines) + "\n"

    def _settings(self) -> None:
        self._put(1, "SimulationParameters")
        settings = {"tstart": 0.0, "tend": self.t_end, "hmin": self.step * 1e-6}
        settings |= {"hmax": self.step, "hout": self.step, "errorTol": 1e-9}
        for key, value in settings.items():
            self._pair(2, key, repr(value))
        self._put(1, "AnimationParameters")
        frames = str(math.floor(self.t_end / self.step + 1e-9) + 1)
        shown = {"nframe": frames, "icurrent": "1", "istart": "1", "iend": frames}
        shown |= {"isForward": "true", "framesPerSecond": "30"}
        for key, word in shown.items():
            self._pair(2, key, word)

    def _put(self, level: int, text: str) -> None:
        self.lines.append("\t" * level + text)

    def _pair(self, level: int, key: str, value: str) -> None:
        self._put(level, key)
        self._put(level + 1, value)

    def _numbers(self, level: int, numbers: Sequence[float]) -> None:
        self._put(level, "\t".join(repr(float(x) + 0.0) for x in numbers))

    def _frame(self, level: int, at: tuple[float, float], turn: Rotation) -> None:
        self._put(level, "Position3D")
        self._numbers(level + 1, (*at, 0.0))
        self._put(level, "RotationMatrix")
        for row in turn:
            self._numbers(level + 1, row)

    def _solid(self, level: int, solid: Solid) -> None:
        self._pair(level, "Name", solid.name)
        self._frame(level, solid.place, about_z(solid.angle))
        self._put(level, "Velocity3D")
        self._numbers(level + 1, (*solid.velocity, 0.0))
        self._put(level, "Omega3D")
        self._numbers(level + 1, (0.0, 0.0, solid.omega))
        if solid.mass is not None:
            self._put(level, "FeatureOrder")
            self._put(level, "PrincipalMassMarker")
            self._pair(level + 1, "Name", "MassMarker")
            self._frame(level + 1, solid.center, about_z(0.0))
            self._pair(level + 1, "Mass", repr(solid.mass))
            self._put(level + 1, "MomentOfInertias")
            self._numbers(level + 2, (solid.inertia,) * 3)
            self._pair(level + 1, "Density", "1.0")
        self._put(level, "RefPoints")
        for name, (at, turn) in solid.markers.items():
            self._put(level + 1, "RefPoint")
            self._frame(level + 2, at, about_z(0.0))
            self._put(level + 2, "Markers")
            self._put(level + 3, "Marker")
            self._pair(level + 4, "Name", name)
            self._frame(level + 4, (0.0, 0.0), turn)
        self._put(level, "RefCurves")
        self._put(level, "RefSurfaces")

    def _entries(self, level: int, section: str) -> None:
        for kind, name, fields in self.sections[section]:
            self._put(level, kind)
            self._pair(level + 1, "Name", name)
            for key, value in fields.items():
                self._pair(level + 1, key, value)
