"""Six-bars by complex numbers and Newton's method, without kempe's code of synthesis."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
#: Links of each family by their points; those that are no first point elsewhere are on ground.
LINKS = {
    "watt_1": ("OA", "ABC", "DBE", "CFP", "EF"),
    "watt_2": ("OA", "AB", "DBC", "CFP", "GF"),
    "stephenson_1": ("OAC", "AB", "DBE", "CFP", "EF"),
    "stephenson_2": ("OA", "ABCP", "BE", "CF", "DEF"),
    "stephenson_3": ("OA", "ABC", "DB", "CFP", "GF"),
}
GROUND = "ODG"
#: The link of the output.
ARM = 4


@dataclass(frozen=True)
class SixBar:
    """Points at the first position."""

    family: str
    at: dict[str, complex]

    def positions(self, cranks: Floats) -> dict[str, Complexes] | None:
        """Points as the crank turns by angles from the first position; None if it cannot.

        The unknowns are the points that move, the equations the lengths between points of a link.
        """
        free = [name for name in self.at if name not in "ODG"]
        free = [name for name in free if name not in LINKS[self.family][0]]
        sides = [
            (x, y, abs(self.at[x] - self.at[y]))
            for points in LINKS[self.family][1:]
            for k, x in enumerate(points)
            for y in points[k + 1 :]
        ]
        now, found = dict(self.at), {name: [] for name in self.at}
        lever = {name: self.at[name] - self.at["O"] for name in LINKS[self.family][0][1:]}
        for turn in cranks:
            before = dict(now)
            for name, arm in lever.items():
                now[name] = self.at["O"] + arm * np.exp(1j * turn)
            for _ in range(30):
                gaps, rows = [], np.zeros((len(sides), 2 * len(free)))
                for k, (x, y, length) in enumerate(sides):
                    apart = now[x] - now[y]
                    gaps.append(abs(apart) ** 2 - length**2)
                    for name, sign in ((x, 2.0), (y, -2.0)):
                        if name in free:
                            j = 2 * free.index(name)
                            rows[k, j : j + 2] = sign * apart.real, sign * apart.imag
                step = np.linalg.lstsq(rows, np.array(gaps), rcond=None)[0]
                for j, name in enumerate(free):
                    now[name] -= complex(step[2 * j], step[2 * j + 1])
                if abs(step).max() < 1e-13:
                    break
            moved = max(abs(now[name] - before[name]) for name in free)
            if not moved < 0.6 or max(map(abs, gaps)) > 1e-11 or not self.keeps(now):
                return None
            for name, at in now.items():
                found[name].append(at)
        return {name: np.array(at) for name, at in found.items()}

    def keeps(self, now: dict[str, complex]) -> bool:
        """Whether triangles keep their sense."""
        triples = [points[:3] for points in LINKS[self.family] if len(points) > 2]
        triples += [points[:2] + "P" for points in LINKS[self.family] if len(points) > 3]

        def area(of: dict[str, complex], x: str, y: str, z: str) -> float:
            return float(((of[y] - of[x]).conjugate() * (of[z] - of[x])).imag)

        return all(area(self.at, *t) * area(now, *t) > 0.0 for t in triples)

    def arm(self, at: dict[str, Complexes]) -> Floats:
        """The angle of the output."""
        first, last = LINKS[self.family][ARM][:2]
        return np.asarray(np.unwrap(np.angle(at[last] - at[first])))


def drawn(
    family: str, seed: int, n: int, span: float
) -> tuple[SixBar, Floats, dict[str, Complexes]]:
    """A six-bar whose crank moves through an angle, and its positions."""
    random = np.random.default_rng(seed)
    names = sorted({point for points in LINKS[family] for point in points})
    while True:
        at = {name: complex(*random.normal(size=2)) for name in names}
        at["A"] = at["O"] + 0.4 * (at["A"] - at["O"])
        shift, unit = at["O"], at["D"] - at["O"]
        at = {name: (z - shift) / unit for name, z in at.items()}
        fine = np.linspace(0.0, span, 8 * (n - 1) + 1)
        one = SixBar(family, at)
        moved = one.positions(fine)
        if moved is not None and max(abs(z) for z in at.values()) < 4.0:
            return one, fine[::8], {name: z[::8] for name, z in moved.items()}
