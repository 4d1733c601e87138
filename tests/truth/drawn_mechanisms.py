"""Random mechanisms with joints on curves, and their equations of motion without kempe.

The poses are drawn first, and then points, axes and curves with which the joints are closed. The
constraints are written in the plane of complex numbers and differentiated with :mod:`jets`, so that
the accelerations share no formula with those of kempe.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import kempe as kp
import numpy as np
from numpy.typing import NDArray
from truth.jets import Jet, cos, inverse, jet, root, sin

Vector = NDArray[np.float64]
Random = np.random.Generator
#: The coordinates as jets: x, y and angle of each body, then the parameters of curves.
Place = list[Jet]
Point = tuple[Jet, Jet]
#: A curve: its point, and its tangent.
Curve = Callable[[Jet], tuple[Point, Point]]

G = 9.81


def turned(x: Jet | float, y: Jet | float, angle: Jet) -> Point:
    c, s = cos(angle), sin(angle)
    return c * x - s * y, s * x + c * y


@dataclass
class Drawn:
    """A mechanism with its own equations.

    Attributes:
        model: the mechanism.
        q: closed coordinates, shape (n_q).
        masses: masses of all coordinates, shape (n_q); zero for parameters of curves.
        rows: the equations of all constraints.
        springs: pairs of points with the stiffness and the free length of a spring.
    """

    model: kp.Model
    size: float
    q: list[float] = field(default_factory=list)
    parameters: list[float] = field(default_factory=list)
    masses: list[float] = field(default_factory=list)
    rows: list[Callable[[Place], list[Jet]]] = field(default_factory=list)
    springs: list[tuple[Any, Any, float, float]] = field(default_factory=list)

    @property
    def bodies(self) -> int:
        return len(self.masses) // 3

    def pose(self, place: Place, body: int) -> tuple[Jet, Jet, Jet]:
        """The pose of a body; -1 is ground."""
        if body < 0:
            return jet(0), jet(0), jet(0)
        return place[3 * body], place[3 * body + 1], place[3 * body + 2]

    def point(self, place: Place, at: tuple[int, float, float]) -> Point:
        body, px, py = at
        x, y, angle = self.pose(place, body)
        dx, dy = turned(px, py, angle)
        return x + dx, y + dy

    def local(self, body: int, x: float, y: float) -> tuple[int, float, float]:
        """The point of a body that is now at (x, y)."""
        bx, by, angle = (0.0, 0.0, 0.0) if body < 0 else self.q[3 * body : 3 * body + 3]
        c, s = math.cos(angle), math.sin(angle)
        dx, dy = x - bx, y - by
        return body, c * dx + s * dy, c * dy - s * dx

    def angle(self, body: int) -> float:
        return 0.0 if body < 0 else self.q[3 * body + 2]

    def residual(self, place: Place) -> list[Jet]:
        return [row for rows in self.rows for row in rows(place)]

    def jacobian(self, q: Vector) -> NDArray[np.float64]:
        columns = []
        for k in range(len(q)):
            place = [Jet(x, float(i == k)) for i, x in enumerate(q)]
            columns.append([row.first for row in self.residual(place)])
        return np.array(columns).T.reshape(-1, len(q))

    def forces(self, q: Vector) -> Vector:
        f = np.zeros(len(q))
        for body in range(self.bodies):
            f[3 * body + 1] -= self.masses[3 * body] * G
        for i, j, stiffness, free in self.springs:
            for k in range(len(q)):  # the slope of the potential energy
                place = [Jet(x, float(n == k)) for n, x in enumerate(q)]
                (xi, yi), (xj, yj) = self.point(place, i), self.point(place, j)
                dx, dy = xj - xi, yj - yi
                f[k] -= (
                    (root(dx * dx + dy * dy) - free).first
                    * stiffness
                    * (root(dx * dx + dy * dy).value - free)
                )
        return f

    def accelerations(self, q: Vector, v: Vector) -> tuple[Vector, Vector]:
        """q̈ and the multipliers, by scaled dense elimination."""
        jacobian = self.jacobian(q)
        place = [Jet(x, rate) for x, rate in zip(q, v, strict=True)]
        gamma = -np.array([row.second for row in self.residual(place)])
        masses = np.zeros(len(q))
        masses[: len(self.masses)] = self.masses
        n, m = len(q), len(gamma)
        full = np.zeros((n + m, n + m))
        full[:n, :n], full[:n, n:], full[n:, :n] = np.diag(masses), jacobian.T, jacobian
        right = np.concatenate([self.forces(q), gamma])
        x = solved(full, right)
        return x[:n], x[n:]


def solved(a: NDArray[np.float64], b: Vector) -> Vector:
    """Gaussian elimination of an equilibrated symmetric matrix, with refinement."""
    scale = np.ones(len(b))
    for _ in range(20):
        scale /= np.sqrt(np.abs(a * scale[:, None] * scale).max(axis=1))
    scaled = a * scale[:, None] * scale
    x = np.zeros(len(b))
    for _ in range(4):
        x += scale * np.linalg.solve(scaled, scale * (b - a @ x))
    return x


def names(body: int) -> str:
    return "ground" if body < 0 else f"b{body}"


class Drawing:
    """Draws one mechanism."""

    def __init__(self, seed: int, ranges: float = 3.0) -> None:
        self.random = np.random.default_rng(seed)
        self.size = self.power(ranges)
        self.made = Drawn(kp.Model("drawn", gravity=(0.0, -G)), self.size)
        self.mass_range = ranges
        self.points: dict[int, dict[str, tuple[float, float]]] = {-1: {}}
        self.curves: dict[int, dict[str, dict[str, Any]]] = {-1: {}}
        self.joints: list[Callable[[kp.Model], Any]] = []
        self.freedoms = 0
        self.pins: list[str] = []

    def power(self, exponent: float) -> float:
        return float(10 ** self.random.uniform(-exponent, exponent))

    def length(self) -> float:
        return self.size * float(self.random.uniform(0.3, 1.5))

    def name(self, at: tuple[int, float, float]) -> str:
        own = self.points[at[0]]
        own[f"P{len(own)}"] = at[1:]
        return f"{names(at[0])}.P{len(own) - 1}"

    def place(self) -> tuple[float, float]:
        x, y = self.size * self.random.uniform(-2, 2, 2)
        return float(x), float(y)

    def body(self) -> int:
        k = self.made.bodies
        self.made.q += [*self.place(), float(self.random.uniform(-3, 3))]
        mass = self.power(self.mass_range)
        inertia = mass * self.size**2 * float(10 ** self.random.uniform(-1.5, 0))
        self.made.masses += [mass, mass, inertia]
        self.points[k], self.curves[k] = {}, {}
        self.freedoms += 3
        return k

    def pin(self, i: int, j: int) -> None:
        x, y = self.place()
        ends = [self.made.local(body, x, y) for body in (i, j)]
        a, b = (self.name(at) for at in ends)
        name = f"j{len(self.joints)}"
        self.pins.append(name)
        self.joints.append(lambda m: m.revolute(name, a, b))

        def rows(place: Place) -> list[Jet]:
            (xi, yi), (xj, yj) = (self.made.point(place, at) for at in ends)
            return [xj - xi, yj - yi]

        self.add(rows, 2)

    def add(self, rows: Callable[[Place], list[Jet]], count: int) -> None:
        self.made.rows.append(rows)
        self.freedoms -= count

    def slot(self, i: int, j: int, guided: bool) -> None:
        """A pin in a slot of body i, or a guide that also holds the angle."""
        x, y = self.place()
        along, axis = self.length(), float(self.random.uniform(-3, 3))
        heading = self.made.angle(i) + axis
        start = self.made.local(i, x, y)
        end = self.made.local(j, x + along * math.cos(heading), y + along * math.sin(heading))
        a, b = self.name(start), self.name(end)
        other = heading - self.made.angle(j)
        angle = self.made.angle(j) - self.made.angle(i)

        name = f"j{len(self.joints)}"

        def joint(m: kp.Model) -> None:
            if guided:
                m.translational(name, a, b, axes=(axis, other))
            else:
                m.pin_in_slot(name, a, b, axis=axis)

        self.joints.append(joint)

        def rows(place: Place) -> list[Jet]:
            (xi, yi), (xj, yj) = self.made.point(place, start), self.made.point(place, end)
            own = self.made.pose(place, i)[2]
            nx, ny = turned(0.0, 1.0, own + axis)
            across = nx * (xj - xi) + ny * (yj - yi)
            return [across, self.made.pose(place, j)[2] - own - angle][: 1 + guided]

        self.add(rows, 1 + guided)

    def rod(self, i: int, j: int) -> None:
        ends = [self.made.local(body, *self.place()) for body in (i, j)]
        a, b = (self.name(at) for at in ends)
        still = [Jet(x) for x in self.made.q]
        (xi, yi), (xj, yj) = (self.made.point(still, at) for at in ends)
        length = math.hypot(xj.value - xi.value, yj.value - yi.value)
        name = f"j{len(self.joints)}"
        self.joints.append(lambda m: m.distance(name, a, b, length=length))

        def rows(place: Place) -> list[Jet]:
            (xi, yi), (xj, yj) = (self.made.point(place, at) for at in ends)
            dx, dy = xj - xi, yj - yi
            return [dx * dx + dy * dy - length**2]

        self.add(rows, 1)

    def curve(self, body: int, convex: bool) -> tuple[str, Curve, float]:
        """A circle, an ellipse or a line of a body, and a parameter."""
        own = self.curves[body]
        name = f"c{len(own)}"
        x, y = self.place()
        r, u = self.length(), float(self.random.uniform(0.3, 5.9))
        kind = self.random.integers(2 if convex else 3)
        if kind == 0:
            own[name] = {"circle": (x, y, r)}
            radii = (r, r)
        elif kind == 1:
            radii = (r, r * float(self.random.uniform(0.6, 1.6)))
            own[name] = {
                "x": f"{x!r} + {radii[0]!r}*cos(u)",
                "y": f"{y!r} + {radii[1]!r}*sin(u)",
                "range": ["0", "2*pi"],
                "periodic": True,
            }
        else:
            a = float(self.random.uniform(-3, 3))
            c, s, u = math.cos(a), math.sin(a), float(self.random.uniform(4, 6)) * r
            own[name] = {"line": [(x, y), (x + 10 * r * c, y + 10 * r * s)]}
            return f"{names(body)}.{name}", lambda t: ((t * c + x, t * s + y), (jet(c), jet(s))), u

        def at(t: Jet) -> tuple[Point, Point]:
            c, s = cos(t), sin(t)
            return (c * radii[0] + x, s * radii[1] + y), (s * (-radii[0]), c * radii[1])

        return f"{names(body)}.{name}", at, u

    def on_curve(self, i: int, j: int) -> None:
        """A point, a roller or a flat of body i on a curve of body j."""
        kind = self.random.integers(3)
        rim, at, u = self.curve(j, convex=kind == 2)
        k = len(self.made.parameters)
        self.made.parameters.append(u)
        radius = 0.2 * self.size if kind == 1 else 0.0

        def contact(place: Place, t: Jet) -> tuple[Point, Point]:
            """Global point and unit tangent."""
            bx, by, angle = self.made.pose(place, j)
            (x, y), (dx, dy) = at(t)
            per = inverse(root(dx * dx + dy * dy))
            tx, ty = turned(dx * per, dy * per, angle)
            px, py = turned(x, y, angle)
            return (bx + px, by + py), (tx, ty)

        still = [Jet(x) for x in self.made.q]
        (cx, cy), (tx, ty) = contact(still, Jet(u))
        shift = self.length() * 0.3 if kind == 2 else 0.0
        x = cx.value + radius * ty.value + shift * tx.value
        y = cy.value - radius * tx.value + shift * ty.value
        end = self.made.local(i, x, y)
        axis = math.atan2(ty.value, tx.value) - self.made.angle(i)
        a = self.name(end)

        name = f"j{len(self.joints)}"

        def joint(m: kp.Model) -> None:
            if kind == 0:
                m.point_on_curve(name, a, rim)
            elif kind == 1:
                m.roller_on_curve(name, a, rim, radius=radius, side="right")
            else:
                m.flat_on_curve(name, a, rim, axis=axis)

        self.joints.append(joint)

        def rows(place: Place) -> list[Jet]:
            px, py = self.made.point(place, end)
            (cx, cy), (tx, ty) = contact(place, place[3 * self.made.bodies + k])
            if kind == 2:
                nx, ny = turned(0.0, 1.0, self.made.pose(place, i)[2] + axis)
                return [nx * (cx - px) + ny * (cy - py), nx * tx + ny * ty]
            return [px - cx - ty * radius, py - cy + tx * radius]

        self.add(rows, 1)

    def spring(self, i: int, j: int) -> None:
        ends = [self.made.local(body, *self.place()) for body in (i, j)]
        a, b = (self.name(at) for at in ends)
        stiffness = max(self.made.masses) * G / self.size * float(self.random.uniform(0, 3))
        free = self.length()
        name = f"j{len(self.joints)}"
        self.joints.append(
            lambda m: m.spring_damper(name, a, b, stiffness=stiffness, free_length=free)
        )
        self.made.springs.append((*ends, stiffness, free))

    def mechanism(self, on_curves: int, rubs: bool = False) -> Drawn:
        """A mechanism with this number of joints on curves and at least one freedom.

        If it ``rubs``, its pins have a friction too small to matter.
        """
        for _ in range(int(self.random.integers(2, 5))):
            k = self.body()
            other = int(self.random.integers(-1, k)) if k else -1
            kind = self.random.integers(5)
            if kind < 2:
                self.pin(other, k)
            elif kind < 4:
                self.slot(other, k, guided=kind == 2)
            else:
                self.rod(other, k)
        for _ in range(on_curves):
            if self.freedoms < 2:
                self.body()
            i = int(self.random.integers(0, self.made.bodies))
            j = int(self.random.choice([b for b in range(-1, self.made.bodies) if b != i]))
            self.on_curve(i, j)
        self.spring(-1, int(self.random.integers(0, self.made.bodies)))
        m = self.made.model
        for body, points in self.points.items():
            if body < 0:
                m.ground.points(**points)
                m.ground.curves(**self.curves[body])
                continue
            mass, _, inertia = self.made.masses[3 * body : 3 * body + 3]
            m.body(names(body), mass=mass, inertia=inertia, points=points, curves=self.curves[body])
        for joint in self.joints:
            joint(m)
        for pin in self.pins if rubs else []:
            m.friction(f"{pin}_rubs", pin, kinetic=1e-12, radius=0.01 * self.size)
        self.made.q += self.made.parameters
        return self.made

    def rates(self) -> Vector:
        """Rates that keep all joints closed."""
        q = np.array(self.made.q)
        scale = np.ones(len(q))
        for body in range(self.made.bodies):
            scale[3 * body : 3 * body + 2] = self.size
        jacobian = self.made.jacobian(q) * scale
        drawn = self.random.normal(size=len(q)) * math.sqrt(G / self.size)
        found = drawn - np.linalg.pinv(jacobian) @ (jacobian @ drawn)
        return scale * found


def scales(made: Drawn) -> Vector:
    """The sizes of the coordinates: lengths for x and y, 1 for angles and parameters."""
    scale = np.ones(len(made.q))
    for body in range(made.bodies):
        scale[3 * body : 3 * body + 2] = made.size
    return scale
