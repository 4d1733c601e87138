"""A linkage that synthesis found, as a case with masses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.model.given import value
from kempe.model.model import Model
from kempe.model.values import refuse
from kempe.synthesis.tasks import Complexes

if TYPE_CHECKING:
    from kempe.case import Case

#: Speed of the crank, rad/s, and outputs of a motion.
SPEED, OUTPUTS = 2.0 * np.pi, 180
#: Types of Grashof's linkages, by the shortest of ``_LINKS``.
TYPES = ("crank-rocker", "double-rocker", "rocker-crank", "double-crank")
_LINKS = ("crank", "coupler", "rocker", "ground")


@dataclass(frozen=True, eq=False)
class Candidate:
    """A four-bar, at the first pose or point of its task.

    Attributes:
        error: the largest distance from the task, in m and rad as given.
        transmission_angle: the least over the full turn of the crank, rad; 0 if it passes a dead
            point.
        grashof: whether Grashof's condition s + l ≤ p + q holds.
        turns: whether the crank makes full turns.
        defects: what is wrong, each with its place: "branch: at pose 3"; empty if nothing is.
        crank_angles: of the crank at the positions of the task, rad, (n,).
    """

    pins: tuple[complex, ...]
    frame: float
    error: float
    transmission_angle: float
    grashof: bool
    turns: bool
    defects: tuple[str, ...]
    crank_angles: Floats
    masses: Mapping[str, float] = field(repr=False, default_factory=dict)

    @property
    def outline(self) -> Mapping[str, str]:
        """The names of the points of each body."""
        return MappingProxyType({"crank": "OA", "coupler": "ABP", "rocker": "DB"})

    @property
    def points(self) -> Mapping[str, tuple[float, float]]:
        """O, A, B, D and P: pivot and pin of the crank, pin and pivot of the rocker, the point."""
        names = zip("OABDP", self.pins, strict=True)
        return MappingProxyType({name: (at.real, at.imag) for name, at in names})

    @property
    def lengths(self) -> Mapping[str, float]:
        """The lengths of ``crank``, ``coupler``, ``rocker`` and ``ground``, m."""
        o, a, b, d, _ = self.pins
        found = (abs(a - o), abs(b - a), abs(d - b), abs(o - d))
        return MappingProxyType(dict(zip(_LINKS, found, strict=True)))

    @property
    def size(self) -> float:
        """The largest distance of two of its points, m."""
        return max(abs(x - y) for x in self.pins for y in self.pins)

    @property
    def type(self) -> str:
        """Such as ``"crank-rocker"``, by Grashof's condition; "triple-rocker" without it."""
        if not self.grashof:
            return "triple-rocker"
        shortest = min(self.lengths, key=lambda name: self.lengths[name])
        return TYPES[_LINKS.index(shortest)]

    @cached_property
    def case(self) -> Case:
        """The linkage with masses, and a motion by ``inverse_dynamics``.

        The bodies are ``crank``, ``coupler`` with the point ``P``, and ``rocker``; the driver is
        ``drive``. The frame of the coupler is the moving frame of the poses. A crank that turns
        fully makes one turn in 1 s, any other one moves through the positions of the task.
        """
        return self._case()

    def _case(self) -> Case:
        from kempe.case import Case

        o, a, b, _, p = self.pins
        m = Model(self.type, gravity=(0.0, -9.81))
        m.ground.points(O=pair(o), D=pair(self.pins[3]))
        m.bar("crank", mass=self._mass("crank", abs(a - o)), through={"O": pair(o), "A": pair(a)})
        turn = np.exp(-1j * self.frame)
        corners = {"A": (a - p) * turn, "B": (b - p) * turn, "P": 0j}
        m.body(
            "coupler",
            points={name: pair(at) for name, at in corners.items()},
            shapes=self._rods("coupler", list(corners.values())),
        )
        m.revolute("O", "ground.O", "crank.O")
        m.revolute("A", "crank.A", "coupler.A")
        output = self._output(m)
        start, rate, t_end = self.drive
        m.coordinate_driver("drive", "crank.angle", value=f"{start!r} + {rate!r}*t")
        guess = {
            "crank.angle": start,
            "coupler.x": p.real,
            "coupler.y": p.imag,
            "coupler.angle": self.frame,
            **output,
        }
        motion = {"type": "inverse_dynamics", "t_end": t_end, "output_step": t_end / OUTPUTS}
        return Case(m, {"guess": guess}, analyses={"motion": motion})

    def _output(self, m: Model) -> dict[str, float]:
        """Add the output link to a model; its coordinates at the start."""
        _, _, b, d, _ = self.pins
        ends = {"D": pair(d), "B": pair(b)}
        m.bar("rocker", mass=self._mass("rocker", abs(b - d)), through=ends)
        m.revolute("B", "coupler.B", "rocker.B")
        m.revolute("D", "ground.D", "rocker.D")
        return {"rocker.angle": float(np.angle(b - d))}

    @property
    def drive(self) -> tuple[float, float, float]:
        """The angle of the crank at the start, its speed, and the end of the motion, s."""
        first, last = float(self.crank_angles[0]), float(self.crank_angles[-1])
        rate = SPEED if last >= first else -SPEED
        return first, rate, 1.0 if self.turns else max(abs(last - first) / SPEED, 1e-3)

    def _mass(self, body: str, length: float) -> float:
        return self.masses.get(body, length)

    def _sides(self, corners: list[complex]) -> list[tuple[complex, complex]]:
        """The sides between the corners of a body, each once."""
        ends = corners[1:] + corners[:1] * (len(corners) > 2)
        return [
            (x, y) for x, y in zip(corners, ends, strict=False) if abs(y - x) > 1e-9 * self.size
        ]

    def _rods(self, body: str, corners: list[complex]) -> list[dict[str, Any]]:
        """Rods between the corners, together the mass of a body."""
        sides = self._sides(corners)
        total = sum(abs(y - x) for x, y in sides)
        share = self._mass(body, total) / total
        return [
            {
                "type": "rod",
                "length": abs(y - x),
                "at": pair((x + y) / 2.0),
                "angle": float(np.angle(y - x)),
                "mass": share * abs(y - x),
            }
            for x, y in sides
        ]

    def positions(self, n: int) -> Floats:
        """Pins A, B and the point P as the crank turns, (3, n, 2), m.

        A crank that turns fully makes one turn from the first position on, any other one moves
        through the positions of the task.
        """
        o, a, b, _, p = self.pins
        first, rate, t_end = self.drive
        pin = o + abs(a - o) * np.exp(1j * np.linspace(first, first + rate * t_end, n))
        coupler = self._couplers(pin)
        places = np.stack([pin, pin + coupler, pin + (p - a) / (b - a) * coupler])
        return fixed(np.stack([places.real, places.imag], axis=2))

    def _couplers(self, pin: Complexes) -> Complexes:
        """The vectors from A to B for places of A."""
        _, a, b, d, _ = self.pins
        coupler, rocker, far = abs(b - a), abs(b - d), d - pin
        cosine = (coupler**2 + abs(far) ** 2 - rocker**2) / (2.0 * coupler * abs(far))
        side = np.sign((np.conj(d - a) * (b - a)).imag) or 1.0
        turn = np.exp(1j * side * np.arccos(np.clip(cosine, -1.0, 1.0)))
        return np.asarray(coupler * far / abs(far) * turn)

    def __repr__(self) -> str:
        lengths = ", ".join(f"{name} {x:.4g}" for name, x in self.lengths.items())
        wrong = "; ".join(self.defects) or "no defects"
        return f"<Candidate {self.type}: {lengths} m; error {self.error:.2g}; {wrong}>"


def pair(at: complex) -> tuple[float, float]:
    """Coordinates of a point."""
    return float(at.real), float(at.imag)


def masses_of(given: Mapping[str, Any] | None) -> dict[str, float]:
    """Masses by body, kg; the others have 1 kg per metre of their sides.

    Raises:
        ModelError: a mass is not positive.
    """
    found = {}
    for name, mass in (given or {}).items():
        found[name] = value(mass, f"masses.{name}", "kg")
        if not found[name] > 0.0:
            refuse(f"masses.{name}", f"{mass!r}; must be > 0")
    return found
