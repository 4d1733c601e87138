"""Six-bars that synthesis found."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.model.model import Model
from kempe.synthesis.candidate import OUTPUTS, Candidate, pair
from kempe.synthesis.six_bar.topology import Topology, topology

if TYPE_CHECKING:
    from kempe.case import Case


@dataclass(frozen=True, eq=False, repr=False)
class SixBar(Candidate):
    """A six-bar, at the first point or pair of its task.

    It has the attributes of a ``Candidate``. ``family.bodies`` contains the points of each body.
    ``grashof`` means that the crank turns fully. The transmission angle is the least one between
    two links that meet in a dyad; for "stephenson_2" it is that between link or strut and the
    line from its pin on the arm to the pole about which coupler and arm turn without it.
    """

    family: Topology = topology("watt_1")  # noqa: RUF009 - immutable

    @property
    def outline(self) -> Mapping[str, str]:
        """The names of the points of each body."""
        return MappingProxyType(self.family.bodies)

    @property
    def points(self) -> Mapping[str, tuple[float, float]]:
        """All points: O, D and G are ground pivots, P is the coupler point."""
        names = zip(self.family.names, self.pins, strict=True)
        return MappingProxyType({name: pair(at) for name, at in names})

    @property
    def lengths(self) -> Mapping[str, float]:
        """The distance of the first two points of each body, and ``ground``, that of O and D, m."""
        at = dict(zip(self.family.names, self.pins, strict=True))
        sides = {body: of[:2] for body, of in self.family.bodies.items()} | {"ground": "OD"}
        return MappingProxyType({name: abs(at[of[0]] - at[of[1]]) for name, of in sides.items()})

    @property
    def type(self) -> str:
        """Such as "Watt I"."""
        name, number = self.family.name.split("_")
        return f"{name.capitalize()} {'I' * int(number)}"

    def _case(self) -> Case:
        from kempe.case import Case

        at = dict(zip(self.family.names, self.pins, strict=True))
        m = Model(self.type, gravity=(0.0, -9.81))
        m.ground.points(**{name: pair(at[name]) for name in self.family.ground})
        guess = {}
        owners = {name: ["ground"] for name in self.family.ground}
        for body, names in self.family.bodies.items():
            corners = [at[name] for name in names]
            sides = self._sides(corners)
            mass = self._mass(body, sum(abs(y - x) for x, y in sides))
            angle = float(np.angle(corners[1] - corners[0]))
            guess[f"{body}.angle"] = angle
            if len(names) == 2:
                m.bar(body, mass=mass, through={name: pair(at[name]) for name in names})
            else:
                own = [(z - corners[0]) * np.exp(-1j * angle) for z in corners]
                placed = {name: pair(z) for name, z in zip(names, own, strict=True)}
                m.body(body, points=placed, shapes=self._rods(body, own))
                guess |= {f"{body}.x": corners[0].real, f"{body}.y": corners[0].imag}
            for name in names.replace("P", ""):
                owners.setdefault(name, []).append(body)
        for name, (i, j) in owners.items():
            m.revolute(name, f"{i}.{name}", f"{j}.{name}")
        start, rate, t_end = self.drive
        m.coordinate_driver("drive", "crank.angle", value=f"{start!r} + {rate!r}*t")
        guess["crank.angle"] = start
        motion = {"type": "inverse_dynamics", "t_end": t_end, "output_step": t_end / OUTPUTS}
        return Case(m, {"guess": guess}, analyses={"motion": motion})

    def positions(self, n: int) -> Floats:
        """All points in the order of ``points`` as the crank turns, (n_points, n, 2), m.

        A crank that turns fully makes one turn from the first position on, any other one moves
        through the positions of the task.

        Raises:
            KempeError: the crank cannot move through the positions.
        """
        from kempe.analyses.kinematics import kinematics

        first, rate, t_end = self.drive
        case, ends = self.case, (first, first + rate * t_end)
        sol = kinematics(case.model, case.start(), over="crank.angle", range=ends, n=n)
        placed = []
        for name in self.family.names:
            for body, names in self.family.bodies.items():
                if name in names:
                    at = [sol[f"{body}.{name}.{axis}"] for axis in "xy"]
            placed.append(np.stack(at, axis=1))
        return fixed(np.stack(placed))
