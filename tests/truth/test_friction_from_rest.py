"""Four-bar linkages at rest with friction in several pins: which way they begin to move, if at all.

With one freedom there are two ways to slide. For each, the signs of the friction are known, and the
loads follow from Newton–Euler equations with loads N = |λ(N)|. A way is that of the motion if the
mechanism accelerates along it. The directions of friction in pins belong together: with others the
equations may have no solution, which is not a paradox of the mechanism.
"""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from kempe.base.arrays import Floats
from scipy.optimize import fsolve

PINS = {
    "A": ("ground.O", "crank.A"),
    "B": ("crank.B", "coupler.A"),
    "C": ("coupler.B", "rocker.B"),
    "D": ("ground.D", "rocker.A"),
}
#: Column of the angle of each body.
ANGLES = {"crank": 2, "coupler": 5, "rocker": 8}


def linkage(random: np.random.Generator, rubbing: dict[str, float]) -> kp.State:
    """A four-bar at rest with friction radii μ r in some pins."""
    m = kp.Model("linkage", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), D=(random.uniform(0.6, 0.9), random.uniform(-0.1, 0.1)))
    for name, low, high in (("crank", 0.15, 0.3), ("coupler", 0.6, 0.9), ("rocker", 0.5, 0.7)):
        length = random.uniform(low, high)
        m.bar(name, mass=random.uniform(0.5, 3), length=length, ends=("A", "B"))
    for name, (i, j) in PINS.items():
        m.revolute(name, i, j)
    for name, radius in rubbing.items():
        m.friction(f"rub_{name}", name, kinetic=1.0, radius=radius)
    at = {"crank.angle": random.uniform(-3, 3), "crank.omega": 0}
    return kp.assemble(m, set=at, guess={"rocker.angle": 2.0, "coupler.angle": 0.5})


def ways(start: kp.State, rubbing: dict[str, float]) -> list[Floats]:
    """The accelerations of all ways to slide from rest that agree with themselves."""
    tree = dict(start.model.tree())
    del tree["forces"]
    smooth = kp.State(kp.Model.from_tree(tree), t=0.0, q=start.q, v=start.v).matrices()
    n_rows = len(smooth.Phi_q)
    matrix = np.block([[smooth.M, smooth.Phi_q.T], [smooth.Phi_q, np.zeros((n_rows, n_rows))]])
    inverse = np.linalg.inv(matrix)
    freedom = np.linalg.svd(smooth.Phi_q)[2][-1]
    found = []
    for way in (freedom, -freedom):
        columns = []
        for pin, radius in rubbing.items():
            column = np.zeros(9 + n_rows)
            i, j = (end.split(".")[0] for end in PINS[pin])
            column[ANGLES[j]] = 1.0
            if i in ANGLES:
                column[ANGLES[i]] = -1.0
            column *= -radius * np.sign(column[:9] @ way)
            columns.append(inverse @ column)
        free = inverse @ np.append(smooth.Q, smooth.gamma)
        rows = [9 + 2 * list(PINS).index(pin) for pin in rubbing]

        def solution(loads: Floats, free: Floats = free, columns: list[Floats] = columns) -> Floats:
            return free + np.transpose(columns) @ loads

        def excess(loads: Floats, rows: list[int] = rows) -> Floats:
            x = solution(loads)
            return np.array([np.hypot(x[row], x[row + 1]) for row in rows]) - loads

        loads, _, reached, _ = fsolve(excess, np.zeros(len(rows)), full_output=True, xtol=1e-13)
        if reached == 1 and loads.min() >= 0 and (acceleration := solution(loads)[:9]) @ way > 0:
            found.append(acceleration)
    return found


@pytest.mark.parametrize("seed", range(40))
def test_the_motion_from_rest(seed: int) -> None:
    random = np.random.default_rng([7, seed])
    pins = random.choice(list(PINS), random.integers(2, 5), replace=False)
    rubbing = {str(pin): float(random.uniform(0.005, 0.04)) for pin in pins}
    start = linkage(random, rubbing)
    expected = ways(start, rubbing)
    assert len(expected) < 2, "draw another linkage"
    begun = kp.dynamics(start.model, start, t_end=1e-4)
    a = begun(0.0).a
    if expected:
        assert np.allclose(a, expected[0], rtol=1e-8, atol=1e-8 * np.abs(a).max())
    else:
        assert np.abs(begun.v).max() < 1e-12
