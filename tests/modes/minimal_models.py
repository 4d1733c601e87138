"""Models in minimal coordinates, written by hand, for complex steps.

Each gives accelerations and outputs as analytic functions of real or complex numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

G = 9.81
STEP = 1e-30


def slopes(f: Callable[[np.ndarray], Sequence[complex]], x: Sequence[float]) -> np.ndarray:
    """The derivatives of ``f`` at ``x``, (n_out, n_in), by complex steps."""
    columns = []
    for k in range(len(x)):
        at = np.array(x, dtype=complex)
        at[k] += 1j * STEP
        columns.append(np.imag(np.array(f(at))) / STEP)
    return np.array(columns).T


@dataclass(frozen=True)
class CartPole:
    """A cart of mass ``M`` on a level rail and a uniform pole that turns about its pin.

    The force ``F`` and the damping ``b`` act on the cart, the spring ``k`` on the pole from the
    horizontal.
    """

    M: float = 2.0
    m: float = 0.8
    L: float = 1.2
    k: float = 1.5

    def accelerations(self, x: np.ndarray) -> tuple[complex, complex]:
        """Of cart and pole; x = (position, angle, rates, force F, damping b)."""
        _, angle, speed, rate, force, b = x
        h, inertia = self.L / 2.0, self.m * self.L**2 / 3.0
        s, c = np.sin(angle), np.cos(angle)
        # [M + m, -m h s; -m h s, J] a = right
        right = (
            force - b * speed + self.m * h * c * rate**2,
            -self.m * G * h * c - self.k * angle,
        )
        a11, a12 = self.M + self.m, -self.m * h * s
        det = a11 * inertia - a12**2
        return (
            (inertia * right[0] - a12 * right[1]) / det,
            (a11 * right[1] - a12 * right[0]) / det,
        )

    def outputs(self, x: np.ndarray) -> tuple[complex, ...]:
        """Place of the tip, rate of its height, acceleration of the pole, pin force on the pole."""
        place, angle, speed, rate, _, _ = x
        a, alpha = self.accelerations(x)
        h, s, c = self.L / 2.0, np.sin(angle), np.cos(angle)
        ax = a - h * (s * alpha + c * rate**2)
        ay = h * (c * alpha - s * rate**2)
        return (
            place + self.L * c,
            self.L * c * rate,
            alpha,
            self.m * ax,
            self.m * (ay + G),
            0.5 * self.M * speed**2 + self._energy_of_pole(x),
        )

    def _energy_of_pole(self, x: np.ndarray) -> complex:
        _, angle, speed, rate, _, _ = x
        h, s, c = self.L / 2.0, np.sin(angle), np.cos(angle)
        vx, vy = speed - h * s * rate, h * c * rate
        return 0.5 * self.m * (vx**2 + vy**2) + self.m * self.L**2 / 24.0 * rate**2


@dataclass(frozen=True)
class FourBar:
    """Uniform bars: crank a, coupler b, rocker c with ground pins at (0, 0) and (d, 0).

    A torsion spring acts on the rocker from ground. The angles are those of A-B, B-C and C-D.
    """

    a: float = 10.0
    b: float = 26.0
    c: float = 18.0
    d: float = 20.0
    masses: tuple[float, float, float] = (3.0, 5.0, 4.0)
    k: float = 1e6
    damping: float = 1e4
    free: float = 1.5 * np.pi

    def angles(self, crank: complex) -> tuple[complex, complex]:
        """Coupler and rocker, open, C above."""
        x, y = self.d - self.a * np.cos(crank), -self.a * np.sin(crank)
        far2 = x * x + y * y  # from B to D
        far = np.sqrt(far2)
        inner = np.arccos((self.b**2 + far2 - self.c**2) / (2.0 * self.b * far))
        direction = np.arctan(y / x) if np.real(x) > 0 else np.arctan(y / x) + np.pi
        coupler = direction + inner
        cx = self.a * np.cos(crank) + self.b * np.cos(coupler) - self.d
        cy = self.a * np.sin(crank) + self.b * np.sin(coupler)
        # the rocker points from C to D, downwards
        rocker = np.pi + (np.arctan(cy / cx) if np.real(cx) > 0 else np.arctan(cy / cx) + np.pi)
        return coupler, rocker

    def coefficients(self, crank: complex) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """All angles, their first and second derivatives by the crank's angle."""
        angle = np.array([crank, *self.angles(crank)])
        lengths = np.array([self.a, self.b, self.c])
        s, c = lengths * np.sin(angle), lengths * np.cos(angle)
        # Σ l cos = d, Σ l sin = 0: the loop A-B-C-D
        matrix = np.array([[-s[1], -s[2]], [c[1], c[2]]])
        first = np.array([1.0, *np.linalg.solve(matrix, [s[0], -c[0]])])
        right = [np.sum(c * first**2), np.sum(s * first**2)]
        second = np.array([0.0, *np.linalg.solve(matrix, right)])
        return angle, first, second

    def centres(self, crank: complex) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Places of the mass centres, (3, 2), with both derivatives."""
        angle, first, second = self.coefficients(crank)
        lengths = np.array([self.a, self.b, self.c])
        along = np.array([np.cos(angle), np.sin(angle)]).T * lengths[:, None]
        across = np.array([-np.sin(angle), np.cos(angle)]).T * lengths[:, None]
        rate = across * first[:, None]
        bend = across * second[:, None] - along * (first**2)[:, None]
        found = []
        for part in (along, rate, bend):
            ends = np.cumsum(part, axis=0)
            found.append(
                np.array([part[0] / 2.0, ends[0] + part[1] / 2.0, ends[1] + part[2] / 2.0])
            )
        return found[0], found[1], found[2]

    def acceleration(self, x: np.ndarray) -> complex:
        """Of the crank; x = (angle, rate, torque on the crank, stiffness)."""
        crank, rate, torque, k = x
        angle, first, second = self.coefficients(crank)
        _, velocity, bend = self.centres(crank)
        m = np.array(self.masses)
        j = m * np.array([self.a, self.b, self.c]) ** 2 / 12.0
        inertia = np.sum(m[:, None] * velocity**2) + np.sum(j * first**2)
        change = np.sum(m[:, None] * velocity * bend) + np.sum(j * first * second)
        spring = -k * (angle[2] - self.free) - self.damping * first[2] * rate
        force = torque + spring * first[2] - G * np.sum(m * velocity[:, 1])
        return (force - change * rate**2) / inertia

    def outputs(self, x: np.ndarray) -> tuple[complex, ...]:
        """Angle of the rocker, height and velocity of the coupler's centre, alpha of the rocker."""
        crank, rate, _, _ = x
        angle, first, second = self.coefficients(crank)
        place, velocity, _ = self.centres(crank)
        alpha = self.acceleration(x)
        return (
            angle[2],
            place[1, 1],
            velocity[1, 0] * rate,
            first[2] * alpha + second[2] * rate**2,
        )

    def rest(self, guess: float) -> float:
        """The angle of the crank at an equilibrium, by Newton's method."""
        for _ in range(60):
            at = [guess, 0.0, 0.0, self.k]
            slope = slopes(lambda x: [self.acceleration(x)], at)[0, 0]
            guess -= float(np.real(self.acceleration(np.array(at, dtype=complex)))) / slope
        return guess
