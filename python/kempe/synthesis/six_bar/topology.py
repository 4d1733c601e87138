"""Six-bars as data, and their closures with exact slopes.

A family is one line of ``FAMILIES``: its bodies with their points. The first body with a point that
is not on ground places it, a later one closes a loop there. The drive turns the body ``crank``
about O, ``P`` is a point of the coupler, and ``arm`` is the output of functions.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from kempe.base.arrays import Floats
from kempe.synthesis.tasks import Complexes

FAMILIES = {
    "watt_1": "crank OA, link ABC, rocker DBE, coupler CFP, arm EF",
    "watt_2": "crank OA, link AB, rocker DBC, coupler CFP, arm GF",
    "stephenson_1": "crank OAC, link AB, rocker DBE, coupler CFP, arm EF",
    "stephenson_2": "crank OA, coupler ABCP, link BE, strut CF, arm DEF",
    "stephenson_3": "crank OA, link ABC, rocker DB, coupler CFP, arm GF",
}
#: A closed position: the largest gap of a loop, relative to the unit of the linkage.
CLOSED = 1e-9

#: A part of a sum: its sign, its body (-1 for ground), and the number of its point there.
Term = tuple[int, int, int]


@dataclass(frozen=True)
class Topology:
    """The bodies of a family.

    Unknowns of a linkage, in this order: x and y of each ground pivot; for each body the distance
    of its second point from the first one, then x and y of its other points, in the frame at the
    first point with x towards the second one; offsets and scales of the angles of crank and arm.
    Unknowns of a position: the angle of each body, rad.

    Attributes:
        name: such as "watt_1".
        bodies: names of the points of each body.
    """

    name: str
    bodies: dict[str, str]

    @cached_property
    def ground(self) -> str:
        """The names of the ground pivots."""
        placed = {point for points in self.bodies.values() for point in points[1:]}
        return "".join(
            sorted({points[0] for points in self.bodies.values()} - placed, key="ODG".index)
        )

    @cached_property
    def names(self) -> str:
        """The names of all points, ground pivots first, P last."""
        found = self.ground
        for points in self.bodies.values():
            found += "".join(point for point in points if point not in found)
        return found.replace("P", "") + "P"

    @cached_property
    def columns(self) -> dict[tuple[int, int], int]:
        """The first unknown of each point by its body (-1 for ground) and its number there."""
        found, count = {(-1, k): 2 * k for k in range(len(self.ground))}, 2 * len(self.ground)
        for body, points in enumerate(self.bodies.values()):
            for k in range(1, len(points)):
                found[body, k] = count
                count += 1 if k == 1 else 2
        return found

    @cached_property
    def lengths(self) -> frozenset[int]:
        """The unknowns that are distances of second points."""
        found = {column for (body, k), column in self.columns.items() if body >= 0 and k == 1}
        return frozenset(found)

    @cached_property
    def angles(self) -> int:
        """The first of the offsets of crank and arm and of their scales."""
        last = max(self.columns.values())
        return last + (1 if last in self.lengths else 2)

    @cached_property
    def size(self) -> int:
        """Number of unknowns of a linkage."""
        return self.angles + 4

    @cached_property
    def places(self) -> dict[str, tuple[Term, ...]]:
        """Each point as a sum."""
        return self._sums[0]

    @cached_property
    def closures(self) -> tuple[tuple[Term, ...], ...]:
        """The sums that are zero in a closed position, one for each loop."""
        return self._sums[1]

    @cached_property
    def _sums(self) -> tuple[dict[str, tuple[Term, ...]], tuple[tuple[Term, ...], ...]]:
        found: dict[str, tuple[Term, ...]] = {
            name: ((1, -1, k),) for k, name in enumerate(self.ground)
        }
        loops = []
        for body, points in enumerate(self.bodies.values()):
            for k, name in enumerate(points[1:], 1):
                here = (*found[points[0]], (1, body, k))
                if name in found:
                    loops.append(here + tuple((-sign, of, j) for sign, of, j in found[name]))
                else:
                    found[name] = here
        return found, tuple(loops)

    @cached_property
    def crank(self) -> int:
        """The number of the crank among the bodies."""
        return list(self.bodies).index("crank")

    @cached_property
    def arm(self) -> int:
        """The number of the arm among the bodies."""
        return list(self.bodies).index("arm")

    def value(self, linkage: Floats, column: int) -> Complexes:
        """The point that begins at an unknown, as a complex number, (...)."""
        if column in self.lengths:
            return linkage[..., column].astype(complex)
        return np.asarray(linkage[..., column] + 1j * linkage[..., column + 1])

    def sum(self, terms: tuple[Term, ...], linkage: Floats, turned: Complexes) -> Complexes:
        """A sum at positions, (n_linkages, n).

        Args:
            terms: of the sum.
            linkage: unknowns of linkages, (n_linkages, size).
            turned: exp(i angle) of each body, (n_linkages, n, n_bodies).
        """
        total = np.zeros(turned.shape[:2], dtype=complex)
        for sign, body, k in terms:
            at = self.value(linkage, self.columns[body, k])[:, None]
            total += sign * at if body < 0 else sign * at * turned[:, :, body]
        return total

    def slopes(
        self, terms: tuple[Term, ...], linkage: Floats, turned: Complexes
    ) -> tuple[Complexes, Complexes]:
        """Slopes of a sum: (n_linkages, n, n_bodies) and (n_linkages, n, size)."""
        own = np.zeros(turned.shape, dtype=complex)
        more = np.zeros((*turned.shape[:2], self.size), dtype=complex)
        for sign, body, k in terms:
            column = self.columns[body, k]
            way = np.full(1, sign, dtype=complex) if body < 0 else sign * turned[:, :, body]
            more[:, :, column] += way
            if column not in self.lengths:
                more[:, :, column + 1] += 1j * way
            if body >= 0:
                own[:, :, body] += 1j * way * self.value(linkage, column)[:, None]
        return own, more

    def points(self, linkage: Floats, angles: Floats) -> dict[str, Complexes]:
        """All points at positions, each (n_linkages, n)."""
        turned = np.exp(1j * angles)
        return {name: self.sum(of, linkage, turned) for name, of in self.places.items()}

    def from_points(self, at: dict[str, Complexes]) -> tuple[Floats, Floats]:
        """Linkages with these points, each (n,): their unknowns and the angles of the bodies."""
        count = len(at["O"])
        linkage, angles = np.zeros((count, self.size)), np.zeros((count, len(self.bodies)))
        linkage[:, -2:] = 1.0
        for k, name in enumerate(self.ground):
            linkage[:, 2 * k], linkage[:, 2 * k + 1] = at[name].real, at[name].imag
        for body, points in enumerate(self.bodies.values()):
            angles[:, body] = np.angle(at[points[1]] - at[points[0]])
            for k, name in enumerate(points[1:], 1):
                own = (at[name] - at[points[0]]) * np.exp(-1j * angles[:, body])
                column = self.columns[body, k]
                linkage[:, column] = own.real
                if k > 1:
                    linkage[:, column + 1] = own.imag
        return linkage, angles

    def closed(self, linkage: Floats, angles: Floats, steps: int = 8) -> Floats:
        """The closed positions near others for the same angles of the crank; NaN if there are none.

        Newton's method, for positions (n_linkages, n, n_bodies).
        """
        free = np.arange(len(self.bodies)) != self.crank
        unit = abs(linkage[:, : self.angles]).max(axis=1)
        found = angles.copy()
        with np.errstate(all="ignore"):
            for _ in range(steps):
                gaps, slopes = self.gaps(linkage, found)
                gaps, slopes = gaps / unit[:, None, None], slopes / unit[:, None, None, None]
                far = abs(gaps).max(axis=2, initial=0.0)
                if not (far > 1e-14).any():
                    break
                found[:, :, free] -= solved(slopes[..., free], gaps[..., None])[..., 0]
            gaps, _ = self.gaps(linkage, found)
            bad = ~(abs(gaps).max(axis=2) <= CLOSED * unit[:, None])
        found[bad] = np.nan
        return np.asarray(found)

    def gaps(self, linkage: Floats, angles: Floats) -> tuple[Floats, Floats]:
        """Gaps of the loops, (n_linkages, n, 4), with slopes by the angles, (..., n_bodies)."""
        turned = np.exp(1j * angles)
        sums = [self.sum(of, linkage, turned) for of in self.closures]
        slopes = [self.slopes(of, linkage, turned)[0] for of in self.closures]
        return (
            np.stack([part for z in sums for part in (z.real, z.imag)], axis=-1),
            np.stack([part for z in slopes for part in (z.real, z.imag)], axis=-2),
        )

    def room(self, linkage: Floats, angles: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """The determinant of the slopes of the gaps, which is zero at dead points.

        It is that of a linkage whose unknowns have the root of their sum of squares 1.

        Returns:
            Its sign and the logarithm of its size, (n_linkages, n), and the slopes of the logarithm
            by the angles, (..., n_bodies), and by the unknowns of the linkage, (..., size).
        """
        turned, free = np.exp(1j * angles), np.arange(len(self.bodies)) != self.crank
        both = [self.slopes(of, linkage, turned) for of in self.closures]
        matrix = np.stack([part for z, _ in both for part in (z.real, z.imag)], axis=-2)
        matrix = matrix[..., free]
        with np.errstate(all="ignore"):
            sign, log = np.linalg.slogdet(matrix)
        inverse = solved(matrix, np.broadcast_to(np.eye(matrix.shape[-1]), matrix.shape))
        by_angles, by_linkage = np.zeros(angles.shape), np.zeros((*angles.shape[:2], self.size))
        for k, (own, more) in enumerate(both):
            factor = np.zeros(angles.shape, dtype=complex)
            factor[:, :, free] = inverse[..., 2 * k] - 1j * inverse[..., 2 * k + 1]
            by_angles += (factor * 1j * own).real
            for (body, j), column in self.columns.items():
                for part in range(column, column + (1 if j == 1 else 2) * (body >= 0)):
                    by_linkage[:, :, part] += (factor[:, :, body] * 1j * more[:, :, part]).real
        own = np.where(np.arange(self.size) < self.angles, linkage, 0.0)
        square = (own**2).sum(axis=1)[:, None]
        order = 0.5 * matrix.shape[-1]
        by_linkage -= 2.0 * order * (own / square)[:, None]
        return sign, log - order * np.log(square), by_angles, by_linkage

    def followed(self, linkage: Floats, start: Floats, turns: Floats) -> Floats:
        """Positions as the crank turns by given angles from a closed start.

        The positions are (n_linkages, n, n_bodies). NaN from the first one on that does not close,
        or that is far from the one before.
        """
        found, now, before = list[Floats](), start[:, None, :], 0.0
        ahead = np.zeros_like(now)
        for turn in turns:
            guess = now + ahead
            guess[:, :, self.crank] = start[:, None, self.crank] + turn
            new = self.closed(linkage, guess, 4)
            with np.errstate(invalid="ignore"):
                jumped = abs(new - now).max(axis=2) > 4.0 * abs(turn - before) + 0.5
            new[jumped] = np.nan
            ahead, now, before = (new - now if found else ahead), new, turn
            found.append(new[:, 0])
        return np.stack(found, axis=1)


def solved(matrix: Floats, right: Floats) -> Floats:
    """Solutions of many linear systems; NaN for singular ones."""
    try:
        return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    except np.linalg.LinAlgError:
        flat = matrix.reshape(-1, *matrix.shape[-2:])
        good = np.linalg.matrix_rank(np.nan_to_num(flat)) == flat.shape[-1]
        found = np.full((len(flat), *right.shape[-2:]), np.nan)
        sides = np.broadcast_to(right, (*matrix.shape[:-2], *right.shape[-2:]))
        found[good] = np.linalg.solve(flat[good], sides.reshape(-1, *right.shape[-2:])[good])
        return found.reshape(*matrix.shape[:-2], *right.shape[-2:])


@cache
def topology(family: str) -> Topology:
    """The bodies of a family."""
    bodies = dict(part.split() for part in FAMILIES[family].split(", "))
    return Topology(family, bodies)
