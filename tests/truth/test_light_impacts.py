"""Impacts of bodies in a row, of very different masses, that touch each other and walls."""

from __future__ import annotations

from dataclasses import dataclass

import kempe as kp
import numpy as np
import pytest
from sizes import count

#: Rounds of impacts after which a sequence does not end: with e = 1 and a ratio of masses of 1e6
#: there are about π/2 · 1e3 of them.
ROUNDS = 4000


@dataclass
class Row:
    """Bodies on a line, each in touch with the next. `walls` are those below and above."""

    masses: list[float]
    rates: list[float]
    walls: tuple[bool, bool]
    restitution: float
    size: float

    def rates_after(self) -> tuple[dict[str, int], list[float], list[float]]:
        """The events of the impacts, the rates after them, and the energies before and after."""
        m = kp.Model("row")
        m.ground.points(O=(0, 0))
        for k, mass in enumerate(self.masses):
            face = {"line": ((self.size, -self.size), (self.size, self.size))}
            points = {"C": (0, 0), "L": (-self.size, 0)}
            m.body(f"b{k}", mass=mass, inertia=mass, points=points, curves={"face": face})
            m.translational(f"g{k}", "ground.O", f"b{k}.C")
        law = {"restitution": self.restitution, "rest_speed": 1e-12 * max(map(abs, self.rates))}
        last = len(self.masses) - 1
        for k in range(last):
            m.contact(f"c{k}", f"b{k + 1}.L", f"b{k}.face", side="right", **law)
        if self.walls[0]:
            m.stop("below", "b0.x", lower=0, **law)
        if self.walls[1]:
            m.stop("above", f"b{last}.x", upper=2 * self.size * last, **law)
        place = {f"b{k}.x": 2 * self.size * k for k in range(last + 1)}
        place |= {f"b{k}.vx": rate for k, rate in enumerate(self.rates)}
        sol = kp.dynamics(m, kp.assemble(m, set=place), t_end=1e-3 * self.size)
        events = {name: len(event.t) for name, event in sol.events.items()}
        found = [sol[f"b{k}.vx"][-1] for k in range(last + 1)]
        kinetic = sol.energy.kinetic
        return events, found, [kinetic[0], kinetic[-1]]

    def nearest(self) -> list[float]:
        """The rates nearest to the present ones, in the norm of the masses, that do not approach.

        Neighbours that approach each other are pooled (isotonic regression); the walls only
        limit the pools (van Eeden).
        """
        pools: list[tuple[float, float, int]] = []
        for mass, rate in zip(self.masses, self.rates, strict=True):
            pools.append((mass, rate, 1))
            while len(pools) > 1 and pools[-2][1] > pools[-1][1]:
                (a, u, m), (b, v, n) = pools[-2:]
                pools[-2:] = [(a + b, (a * u + b * v) / (a + b), m + n)]
        low, high = 0.0 if self.walls[0] else -np.inf, 0.0 if self.walls[1] else np.inf
        return [min(max(rate, low), high) for _, rate, n in pools for _ in range(n)]

    def by_rounds(self) -> tuple[bool, list[float]]:
        """Whether the impacts of two bodies above a wall end, and the rates then."""
        (m, n), (u, v), e = self.masses, self.rates, self.restitution
        least = 1e-12 * max(abs(u), abs(v))
        for _ in range(ROUNDS):
            wall, hit = u < -least, v - u < -least
            if not wall and not hit:
                return True, [u, v]
            if wall and hit:
                u, v = -e * u, -e * v
            elif wall:
                u = -e * u
            else:
                push = -(1 + e) * (v - u) / (1 / m + 1 / n)
                u, v = u - push / m, v + push / n
        return False, self.nearest()


def random_row(random: np.random.Generator, restitution: float) -> Row:
    masses = 10 ** random.uniform(-3, 3, random.integers(2, 6))
    rates = 10 ** random.uniform(-3, 3) * random.normal(size=len(masses))
    walls = (bool(random.integers(2)), bool(random.integers(2)))
    return Row(list(masses), list(rates), walls, restitution, 10 ** random.uniform(-3, 3))


@pytest.mark.parametrize("seed", range(count(40, 2000)))
def test_rows_without_restitution(seed: int) -> None:
    """e = 0: the rates are the nearest ones at which no bodies approach."""
    row = random_row(np.random.default_rng([41, seed]), 0.0)
    events, found, (before, after) = row.rates_after()
    np.testing.assert_allclose(found, row.nearest(), rtol=0, atol=1e-9 * np.abs(row.rates).max())
    assert after <= before * (1 + 1e-12)
    assert not any(number for name, number in events.items() if name.endswith("collapse"))


@pytest.mark.parametrize("seed", range(count(40, 2000)))
def test_a_light_body_before_a_wall(seed: int) -> None:
    """Hits on a light body, one by one; a sequence without end has its limit."""
    random = np.random.default_rng([42, seed])
    light, scale, rate, size = 10 ** random.uniform([-3, -3, -3, -3], [0, 0, 3, 3])
    heavy = light * 10 ** random.uniform(0, 6)
    e = float(random.choice([0.1, 0.5, 0.9, 1.0, random.uniform()]))
    row = Row([light, heavy], [rate * scale * random.normal(), -rate], (True, False), e, size)
    events, found, (before, after) = row.rates_after()
    ends, right = row.by_rounds()
    np.testing.assert_allclose(found, right, rtol=0, atol=1e-7 * rate * np.sqrt(heavy / light))
    assert after <= before * (1 + 1e-12)
    if not ends:
        assert events["c0.collapse"] == events["below.collapse"] == 1
    if e == 1:
        assert after == pytest.approx(before, rel=1e-9)
        assert ends and events["c0.collapse"] == 0


@pytest.mark.parametrize("seed", range(count(30, 1000)))
def test_rows_with_restitution_never_gain_energy(seed: int) -> None:
    """Any e: the impacts end, and no bodies approach after them."""
    random = np.random.default_rng([43, seed])
    row = random_row(random, float(random.choice([0.2, 0.8, 1.0, random.uniform()])))
    _, found, (before, after) = row.rates_after()
    assert after <= before * (1 + 1e-12)
    rates = [0.0] * row.walls[0] + found + [0.0] * row.walls[1]
    assert np.diff(rates).min() >= -1e-9 * np.abs(row.rates).max()
