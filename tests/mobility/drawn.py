"""Mechanisms from a drawing: points with coordinates, and bodies as the letters of their points."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from math import cos, radians, sin

import kempe as kp
import numpy as np

Point = tuple[float, float]


@dataclass(frozen=True)
class Drawn:
    """A mechanism in the position in which it is drawn; all frames coincide with that of ground.

    Attributes:
        points: the points.
        bodies: the points of each body; "ground" first. A pin joins the bodies that share a capital
            letter, the first one with each of the others.
        slides: body i, body j, a point of both, and the direction of the slide, degrees.
        slots: the same of a pin of body j in a slot of body i.
        gears: body i, body j, and their centres.
        freedom: degrees of freedom, as known.
    """

    points: dict[str, Point]
    bodies: dict[str, str]
    freedom: int
    slides: tuple[tuple[str, str, str, float], ...] = ()
    slots: tuple[tuple[str, str, str, float], ...] = ()
    gears: tuple[tuple[str, str, str, str], ...] = ()

    def pins(self) -> list[tuple[str, str, str]]:
        """Point, body i, body j of each pin."""
        found = []
        for point in filter(str.isupper, self.points):
            sharing = [name for name, letters in self.bodies.items() if point in letters]
            found += [(point, sharing[0], other) for other in sharing[1:]]
        return found

    def model(self, title: str) -> kp.Model:
        """The mechanism as a model that accepts redundancy."""
        m = kp.Model(title, redundancy="allow")
        for name, letters in self.bodies.items():
            points = {letter: self.points[letter] for letter in letters}
            if name == "ground":
                m.ground.points(**points)
            else:
                m.body(name, mass=1, inertia=1, points=points)
        for k, (point, i, j) in enumerate(self.pins()):
            m.revolute(f"{point}{k}", f"{i}.{point}", f"{j}.{point}")
        for k, (i, j, point, axis) in enumerate(self.slides):
            axes = (radians(axis), radians(axis))
            m.translational(f"slide{k}", f"{i}.{point}", f"{j}.{point}", axes=axes)
        for k, (i, j, point, axis) in enumerate(self.slots):
            m.pin_in_slot(f"slot{k}", f"{i}.{point}", f"{j}.{point}", axis=radians(axis))
        for k, (i, j, a, b) in enumerate(self.gears):
            half = 0.5 * self._apart(a, b)
            m.gear(f"gear{k}", f"{i}.{a}", f"{j}.{b}", radii=(half, half), offset=self._phase(a, b))
        return m

    def state(self, model: kp.Model) -> kp.State:
        """The position of the drawing."""
        zeros = np.zeros(3 * (len(self.bodies) - 1))
        return kp.State(model, 0, zeros, zeros)

    def jacobian(self) -> np.ndarray:
        """Velocities across the constraints for those of the bodies at the origin."""
        rows = []
        for point, i, j in self.pins():
            rows += [self._row(i, j, point, way) for way in (0.0, 90.0)]
        for i, j, point, axis in self.slides:
            rows += [self._row(i, j, point, axis + 90), self._turn(i, j)]
        rows += [self._row(i, j, point, axis + 90) for i, j, point, axis in self.slots]
        for i, j, a, b in self.gears:
            # the teeth in touch have the same velocity across the line of the centres
            (ax, ay), (bx, by) = self.points[a], self.points[b]
            way = np.degrees(np.arctan2(by - ay, bx - ax)) + 90
            rows.append(self._row(i, j, (0.5 * (ax + bx), 0.5 * (ay + by)), way))
        return np.array(rows)

    def _row(self, i: str, j: str, at: str | Point, way: float) -> np.ndarray:
        x, y = self.points[at] if isinstance(at, str) else at
        u, v = cos(radians(way)), sin(radians(way))
        return self._of(i, j, np.array([u, v, x * v - y * u]))

    def _turn(self, i: str, j: str) -> np.ndarray:
        return self._of(i, j, np.array([0.0, 0.0, 1.0]))

    def _of(self, i: str, j: str, part: np.ndarray) -> np.ndarray:
        row = np.zeros((len(self.bodies), 3))
        names = list(self.bodies)
        row[names.index(i)] -= part
        row[names.index(j)] += part
        return row[1:].ravel()

    def _apart(self, a: str, b: str) -> float:
        (ax, ay), (bx, by) = self.points[a], self.points[b]
        return float(np.hypot(bx - ax, by - ay))

    def _phase(self, a: str, b: str) -> float:
        """The offset of a gear of equal wheels whose teeth mesh in the drawing."""
        (ax, ay), (bx, by) = self.points[a], self.points[b]
        return -self._apart(a, b) * float(np.arctan2(by - ay, bx - ax))

    def loops(self) -> set[str]:
        """The kinds of all four-bar loops by Grashof's rule."""
        hinges = [
            (point, i, j)
            for point in filter(str.isupper, self.points)
            for i, j in combinations([b for b, own in self.bodies.items() if point in own], 2)
        ]
        found = set()
        for four in combinations(hinges, 4):
            bodies = [body for _, i, j in four for body in (i, j)]
            names = set(bodies)
            if len(names) != 4 or any(bodies.count(name) != 2 for name in names):
                continue
            lengths = {}
            for name in names:
                a, b = (point for point, i, j in four if name in (i, j))
                lengths[name] = self._apart(a, b)
            if min(lengths.values()) > 0 and _connected(four, names):
                found.add(_kind(four, lengths))
        return found


def _connected(four: tuple[tuple[str, str, str], ...], names: set[str]) -> bool:
    reached = {next(iter(names))}
    for _ in names:
        reached |= {b for _, i, j in four for b in (i, j) if reached & {i, j}}
    return reached == names


def _kind(four: tuple[tuple[str, str, str], ...], lengths: dict[str, float]) -> str:
    """Grashof's rule by the place of the shortest link."""
    s, p, q, longest = sorted(lengths.values())
    if abs(s + longest - p - q) < 1e-9:
        return "change point"
    if s + longest > p + q:
        return "triple rocker"
    shortest = min(lengths, key=lambda name: lengths[name])
    if "ground" not in lengths:
        return "Grashof"
    if shortest == "ground":
        return "double crank"
    beside = any({"ground", shortest} == {i, j} for _, i, j in four)
    return "crank-rocker" if beside else "double rocker"
