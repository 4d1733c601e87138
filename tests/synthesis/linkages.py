"""Four-bars by their closed form, and their circuits by continuation, without kempe."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
#: Step along a circuit, rad.
STEP = 0.03


@dataclass(frozen=True)
class FourBar:
    """OABD with a point in the frame of the coupler, which has its origin at A and x towards B."""

    a: float
    b: float
    c: float
    d: float
    point: complex

    def poses(self, crank: Floats, side: float = 1.0) -> tuple[Complexes, Floats]:
        """Place of the point and angle of the coupler; NaN where the linkage does not close."""
        pin = self.a * np.exp(1j * crank)
        far = abs(self.d - pin)
        with np.errstate(all="ignore"):
            between = np.arccos((self.b**2 + far**2 - self.c**2) / (2.0 * self.b * far))
        angle = np.angle(self.d - pin) + side * between
        return pin + self.point * np.exp(1j * angle), angle

    def rocker(self, crank: Floats, side: float = 1.0) -> Floats:
        """The angle of the rocker."""
        pin = self.a * np.exp(1j * crank)
        _, angle = self.poses(crank, side)
        return np.asarray(np.angle(pin + self.b * np.exp(1j * angle) - self.d))

    def circuit(self, at: Floats) -> Floats:
        """The circuit through the angles of crank, coupler and rocker, (n, 3); it is closed."""
        lengths = np.array([self.a, self.b, -self.c])

        def slopes(x: Floats) -> tuple[Floats, Floats]:
            arms = lengths * np.exp(1j * x)
            left = arms.sum() - self.d
            turned = 1j * arms
            return np.array([left.real, left.imag]), np.array([turned.real, turned.imag])

        def tangent(matrix: Floats) -> Floats:
            way = np.cross(matrix[0], matrix[1])
            return np.asarray(way / np.linalg.norm(way))

        path, x = [at], at
        while len(path) < 4000:
            guess = x + STEP * tangent(slopes(x)[1])
            for _ in range(3):
                left, matrix = slopes(guess)
                guess = guess - matrix.T @ np.linalg.solve(matrix @ matrix.T, left)
            path.append(x := guess)
            apart = np.exp(1j * x) - np.exp(1j * at)
            if len(path) > 4 and np.linalg.norm(apart) < 0.7 * STEP:
                return np.array(path)
        raise AssertionError("the circuit does not close")


def drawn(random: np.random.Generator, n: int) -> tuple[FourBar, Floats]:
    """A four-bar and crank angles at which it closes, in order over less than a turn."""
    while True:
        a, b, c, d = random.uniform(0.3, 3.0, 4)
        bar = FourBar(a, b, c, d, complex(*random.normal(size=2) * 1.5))
        start, span = random.uniform(0.0, 2.0 * np.pi, 2)
        crank = start + np.sort(random.uniform(0.0, span, n))
        steps = np.linspace(crank[0], crank[-1], 200)
        if np.diff(crank).min() > 0.1 and np.isfinite(bar.poses(steps)[1]).all():
            return bar, crank


def rows(places: Complexes, angles: Floats) -> list[tuple[float, float, float]]:
    """Poses as ``kp.synthesis.motion`` takes them."""
    return list(zip(places.real.tolist(), places.imag.tolist(), angles.tolist(), strict=True))


def found_in(bar: FourBar, pins: dict[str, complex]) -> float:
    """The largest distance of the ground pivots and lengths of a candidate from a four-bar."""
    pivots = sorted([pins["O"], pins["D"]], key=abs)
    lengths = sorted([abs(pins["A"] - pins["O"]), abs(pins["B"] - pins["D"])])
    wanted = sorted([bar.a, bar.c])
    apart = [abs(pivots[0]), abs(pivots[1] - bar.d), abs(abs(pins["A"] - pins["B"]) - bar.b)]
    return max(*apart, *(abs(x - y) for x, y in zip(lengths, wanted, strict=True)))
