"""Piles of discs with friction rest where a linear program finds forces within the limits."""

import kempe as kp
import numpy as np
import pytest
from scipy.optimize import linprog
from sizes import FULL

G = 9.81
SCALES = [(1.0, 1.0), (1e3, 1e-3), (1e-3, 1e3)]
Contact = tuple[str, str, str | None, np.ndarray]


class Pile:
    """Rows of discs on a floor that is tilted, beside each other at a distance of `apart` radii."""

    def __init__(self, rows: int, apart: float, tilt: float, seed: int, scale: tuple[float, float]):
        (mass, self.size), rng = scale, np.random.default_rng(seed)
        self.gravity = G * np.array([np.sin(tilt), -np.cos(tilt)])
        wide = (2 + apart) * self.size
        high = np.sqrt(4 * self.size**2 - wide**2 / 4)
        self.mass: dict[str, float] = {}
        self.at: dict[str, np.ndarray] = {}
        for k in range(rows):
            for i in range(rows - k):
                self.mass[f"d{k}{i}"] = mass * 10 ** rng.uniform(-0.5, 0.5)
                self.at[f"d{k}{i}"] = np.array([(i + k / 2) * wide, self.size + k * high])
        self.contacts = [self.contact(*pair) for pair in self.pairs(rows, apart)]

    def pairs(self, rows: int, apart: float) -> list[tuple[str, str | None]]:
        found: list[tuple[str, str | None]] = [(f"d0{i}", None) for i in range(rows)]
        for k in range(1, rows):
            found += [(f"d{k}{i}", f"d{k - 1}{j}") for i in range(rows - k) for j in (i, i + 1)]
        if apart == 0:
            found += [(f"d{k}{i}", f"d{k}{i - 1}") for k in range(rows) for i in range(1, rows - k)]
        return found

    def contact(self, one: str, other: str | None) -> Contact:
        away = np.array([0.0, 1.0]) if other is None else self.at[one] - self.at[other]
        return f"{one}_{other or 'floor'}", one, other, away / np.linalg.norm(away)

    def model(
        self, static: float, kinetic: float, tilts: float = 0
    ) -> tuple[kp.Model, dict[str, float]]:
        m = kp.Model("pile", gravity=tuple(self.gravity))
        floor = {"floor": {"line": [(20 * self.size, 0), (-20 * self.size, 0)]}}
        if tilts:
            m.ground.points(O=(0, 0))
            m.body("table", mass=1, inertia=1, points={"O": (0, 0)}, curves=floor)
            m.revolute("pivot", "ground.O", "table.O")
            m.coordinate_driver("tilt", "table.angle", value=f"-{tilts}*t^2")
        else:
            m.ground.curves(**floor)
        rim = {"rim": {"circle": (0, 0, self.size)}}
        for name, mass in self.mass.items():
            inertia = 0.5 * mass * self.size**2
            m.body(name, mass=mass, inertia=inertia, points={"C": (0, 0)}, curves=rim)
        laws = {"friction": kinetic, "static": static, "restitution": 0}
        for name, one, other, _ in self.contacts:
            curve = f"{other}.rim" if other else "table.floor" if tilts else "ground.floor"
            m.contact(name, f"{one}.C", curve, radius=self.size, **laws)
        start = {
            f"{name}.{x}": float(at["xy".index(x)]) for name, at in self.at.items() for x in "xy"
        }
        return m, start

    def directions(self) -> np.ndarray:
        """Forces and moments, in radii, of a unit normal force and friction of each contact."""
        n, names = len(self.contacts), list(self.at)
        columns = np.zeros((3 * len(names), 2 * n))
        for k, (_, one, other, away) in enumerate(self.contacts):
            along = np.array([-away[1], away[0]])
            for column, force in ((2 * k, away), (2 * k + 1, along)):
                for name, sign in ((one, 1), (other, -1)):
                    if name is None:
                        continue
                    row = 3 * names.index(name)
                    columns[row : row + 2, column] = sign * force
                    # both arms point to the contact: -away of the one, +away of the other
                    columns[row + 2, column] = -float(away[0] * force[1] - away[1] * force[0])
        return columns

    def several(self) -> set[str]:
        """The contacts whose forces the equations of rest do not determine."""
        columns = self.directions()
        _, sizes, rows = np.linalg.svd(columns)
        left = rows[int((sizes > 1e-9 * sizes[0]).sum()) :]
        takes_part = np.abs(left).max(axis=0, initial=0).reshape(-1, 2).max(axis=1) > 1e-9
        return {name for (name, *_), part in zip(self.contacts, takes_part, strict=True) if part}

    def balances(self, mu: float) -> bool:
        """Whether forces within the limits of friction keep all discs at rest."""
        n, names, columns = len(self.contacts), list(self.at), self.directions()
        load = np.zeros(3 * len(names))
        for k, mass in enumerate(self.mass.values()):
            load[3 * k : 3 * k + 2] = -mass * self.gravity
        load /= np.abs(load).max()
        limits = np.zeros((2 * n, 2 * n))
        for k in range(n):
            limits[2 * k : 2 * k + 2, 2 * k] = -mu
            limits[2 * k : 2 * k + 2, 2 * k + 1] = 1, -1
        found = linprog(
            np.zeros(2 * n),
            A_ub=limits,
            b_ub=np.zeros(2 * n),
            A_eq=columns,
            b_eq=load,
            bounds=[(0, None), (None, None)] * n,
        )
        return found.status == 0

    def least(self) -> float:
        """The least coefficient of friction with which the pile can rest."""
        low, high = 0.0, 8.0
        assert self.balances(high)
        while high - low > 1e-7:
            middle = (low + high) / 2
            low, high = (low, middle) if self.balances(middle) else (middle, high)
        return high


ALL = [
    (rows, apart, tilt, SCALES[(rows + k) % 3])
    for rows in (2, 3, 4, 5)
    for k, (apart, tilt) in enumerate([(0, 0), (1e-3, 0), (0.1, 0), (0, 0.02), (0.02, 0)])
]
SOME = [ALL[k] for k in (2, 5, 8, 10, 11)]


@pytest.mark.parametrize(("rows", "apart", "tilt", "scale"), ALL if FULL else SOME)
def test_a_pile_rests_where_its_forces_balance(
    rows: int, apart: float, tilt: float, scale: tuple[float, float]
) -> None:
    pile = Pile(rows, apart, tilt, rows, scale)
    least, time = pile.least(), 0.1 * np.sqrt(pile.size)
    several = pile.several()
    for static, kinetic in [(0.97, 0.97), (1.03, 1.03), (1.5, 1.5), (3, 1.1), (20, 20)]:
        m, at = pile.model(static * least, kinetic * least)
        sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=time, output_step=time)
        moved = max(float(np.ptp(sol[f"{name}.{x}"])) for name in pile.at for x in "xy")
        assert (moved < 1e-9 * pile.size) == (static > 1), (static, moved / pile.size)
        notes = str(sol.statistics.get("notes", ""))
        told = "contacts and friction at rest share the load" in notes
        assert told == bool(sol.choices)
        # a part of a pile that moves may rest
        assert set(sol.choices) == several if static > 1 else set(sol.choices) <= several
        assert {name for name in m.forces if not sol.force(name).unique} == set(sol.choices)
        weight = G * sum(pile.mass.values())
        for name in m.forces if static > 1 else ():
            normal, along = sol[f"{name}.force"], sol[f"{name}.tangential"]
            assert np.all(np.abs(along) <= static * least * normal + 1e-9 * weight), name
            assert np.min(normal) > -1e-9 * weight, name


@pytest.mark.parametrize(("rows", "factor"), [(2, 2.0), (3, 1.3)] if FULL else [(2, 2.0)])
def test_a_pile_on_a_table_that_tilts_moves_at_the_angle_of_its_limit(
    rows: int, factor: float
) -> None:
    """The tilt grows so slowly that inertia does not matter, and the shares are found anew."""
    seed, tilts = rows, 5e-4
    mu = factor * Pile(rows, 0, 0, seed, SCALES[0]).least()
    low, high = 0.0, 1.0
    while high - low > 1e-6:
        middle = (low + high) / 2
        holds = Pile(rows, 0, middle, seed, SCALES[0]).balances(mu)
        low, high = (middle, high) if holds else (low, middle)
    pile = Pile(rows, 0, 0, seed, SCALES[0])
    m, at = pile.model(mu, mu, tilts)
    t_end = float(np.sqrt(1.2 * low / tilts))
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=t_end, output_step=t_end / 200)
    away = [np.hypot(sol[f"{name}.x"], sol[f"{name}.y"]) for name in pile.at]
    moved = np.max([np.abs(own - own[0]) for own in away], axis=0) > 1e-6
    assert tilts * sol.t[np.argmax(moved)] ** 2 == pytest.approx(low, rel=0.03)
