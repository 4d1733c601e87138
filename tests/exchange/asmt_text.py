"""Writes assemblies in the format of OndselSolver, for tests."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

Vector = Sequence[float]
#: Rotations that turn the z axis: into itself, along x, along y.
Z, X, Y = (
    np.eye(3),
    np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]]),
    np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]]),
)


def turn(angle: float) -> np.ndarray:
    """The rotation about z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


@dataclass
class Part:
    """A part: its place and rates at the start, its mass, and its markers."""

    name: str
    place: Vector = (0, 0, 0)
    rotation: np.ndarray = field(default_factory=lambda: Z)
    velocity: Vector = (0, 0, 0)
    omega: Vector = (0, 0, 0)
    mass: float = 1.0
    center: Vector = (0, 0, 0)
    inertias: Vector = (1, 1, 1)
    markers: dict[str, tuple[Vector, np.ndarray]] = field(default_factory=dict)


@dataclass
class Assembly:
    """An assembly: the markers of ground, the parts, and the lines of joints and so on."""

    ground: dict[str, tuple[Vector, np.ndarray]]
    parts: list[Part]
    joints: list[tuple]
    motions: list[tuple] = field(default_factory=list)
    limits: list[tuple] = field(default_factory=list)
    forces: list[tuple] = field(default_factory=list)
    gravity: Vector = (0, 0, 0)
    t_end: float = 1.0
    step: float = 0.1
    name: str = "Machine"

    def turned(self, by: np.ndarray) -> Assembly:
        """The same assembly, turned in space as a whole."""
        turned = lambda v: tuple(by @ np.asarray(v, float))  # noqa: E731
        parts = [
            Part(
                p.name,
                turned(p.place),
                by @ p.rotation,
                turned(p.velocity),
                turned(p.omega),
                p.mass,
                p.center,
                p.inertias,
                p.markers,
            )
            for p in self.parts
        ]
        ground = {name: (turned(at), by @ r) for name, (at, r) in self.ground.items()}
        return Assembly(
            ground,
            parts,
            self.joints,
            self.motions,
            self.limits,
            self.forces,
            turned(self.gravity),
            self.t_end,
            self.step,
            self.name,
        )

    def text(self) -> str:
        """The file."""
        out: list[str] = ["freeCAD: written by a test", "Assembly"]
        put = lambda level, *words: out.append("\t" * level + "\t".join(map(str, words)))  # noqa: E731
        pair = lambda level, key, value: (put(level, key), put(level + 1, value))  # noqa: E731
        pair(1, "Notes", "(Text string: '')")
        self._solid(put, 1, Part(self.name, markers=self.ground), mass=False)
        put(1, "Parts")
        for part in self.parts:
            put(2, "Part")
            self._solid(put, 3, part)
        put(1, "KinematicIJs")
        put(1, "ConstraintSets")
        for section, entries in (
            ("Joints", self.joints),
            ("Motions", self.motions),
            ("Limits", self.limits),
        ):
            put(2, section)
            for entry in entries:
                _entry(put, 3, entry, self.name)
        put(2, "GeneralConstraintSets")
        put(1, "ForceTorques")
        for entry in self.forces:
            _entry(put, 2, entry, self.name)
        put(1, "ConstantGravity")
        put(2, *self.gravity)
        put(1, "SimulationParameters")
        for key, value in {
            "tstart": 0.0,
            "tend": self.t_end,
            "hmin": 1e-9,
            "hmax": 1,
            "hout": self.step,
            "errorTol": 1e-6,
        }.items():
            pair(2, key, value)
        put(1, "AnimationParameters")
        pair(2, "nframe", 11)
        return "\n".join(out) + "\n"

    @staticmethod
    def _solid(put, level: int, part: Part, mass: bool = True) -> None:
        put(level, "Name")
        put(level + 1, part.name)
        _frame(put, level, part.place, part.rotation)
        for key, value in (("Velocity3D", part.velocity), ("Omega3D", part.omega)):
            put(level, key)
            put(level + 1, *value)
        if mass:
            put(level, "FeatureOrder")
            put(level, "PrincipalMassMarker")
            put(level + 1, "Name")
            put(level + 2, "MassMarker")
            _frame(put, level + 1, part.center, Z)
            for key, value in (
                ("Mass", [part.mass]),
                ("MomentOfInertias", part.inertias),
                ("Density", [1]),
            ):
                put(level + 1, key)
                put(level + 2, *value)
        put(level, "RefPoints")
        for name, (at, rotation) in part.markers.items():
            put(level + 1, "RefPoint")
            _frame(put, level + 2, at, Z)
            put(level + 2, "Markers")
            put(level + 3, "Marker")
            put(level + 4, "Name")
            put(level + 5, name)
            _frame(put, level + 4, (0, 0, 0), rotation)
        put(level, "RefCurves")
        put(level, "RefSurfaces")


def _frame(put, level: int, at: Vector, rotation: np.ndarray) -> None:
    put(level, "Position3D")
    put(level + 1, *(repr(float(x)) for x in at))
    put(level, "RotationMatrix")
    for row in np.asarray(rotation, float):
        put(level + 1, *(repr(float(x)) for x in row))


def _entry(put, level: int, entry: tuple, assembly: str) -> None:
    """An entry: its class, its name, and its fields, whose values may begin with a slash."""
    kind, name, fields = entry
    put(level, kind)
    put(level + 1, "Name")
    put(level + 2, name)
    for key, value in fields.items():
        put(level + 1, key)
        text = f"/{assembly}{value}" if isinstance(value, str) and value.startswith("/") else value
        put(level + 2, text)
