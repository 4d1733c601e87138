"""Many contacts: the time of a run is linear in their number, and each hit is found.

Contacts that hit at different instants end as many steps, each with the cost of all contacts.
"""

import time

import kempe as kp
import numpy as np
import pytest
from sizes import count


def points(n: int, high: float, spread: float, **law: float) -> tuple[kp.Model, kp.State]:
    """A model of n points above a line, or in it, each higher than the one before by the spread."""
    m = kp.Model("many", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.ground.curves(floor={"line": [[3, 0], [-3, 0]]})
    start: dict[str, float | str] = {}
    for k in range(n):
        m.body(f"b{k}", mass=1, inertia=0.01, points={"P": (0, 0)})
        m.contact(f"c{k}", f"b{k}.P", "ground.floor", **law)
        at = {"x": -2 + 4 * k / n, "y": high + k * spread, "angle": 0, "vx": 0, "vy": 0, "omega": 0}
        start |= {f"b{k}.{name}": value for name, value in at.items()}
    return m, kp.assemble(m, set=start)


def seconds(n: int, high: float, spread: float = 0.0, enough: float = 0.0, **law: float) -> float:
    """The least CPU time of three runs with n points near a line, or a time below `enough`."""
    m, state = points(n, high, spread, **law)
    least = float("inf")
    for _ in range(3):
        if least < enough:
            break
        begin = time.process_time()
        sol = kp.dynamics(m, state, t_end=0.15)
        least = min(least, time.process_time() - begin)
    assert sol[f"c{n - 1}.gap"][-1] <= high + n * spread
    return least


@pytest.mark.parametrize(
    ("high", "law"),
    [
        (1.0, {"restitution": 0.5}),
        (0.0, {"restitution": 0.5}),
        (1.0, {"stiffness": 1e5}),
        (-0.001, {"stiffness": 1e5, "damping": 0.1}),
    ],
)
def test_a_thousand_contacts_cost_linear_time(high: float, law: dict[str, float]) -> None:
    # 16 times as many: linear 16, quadratic 256. 250 contacts fit into a cache near the core, 4000
    # do not: measured 23 to 52 on one machine; another took 38 times as long for 8 times as many
    few = count(100, 250)
    limit = 128 * seconds(few, high, **law)
    assert seconds(16 * few, high, enough=limit, **law) < limit


def test_hits_at_different_instants_cost_quadratic_time() -> None:
    # 4 times as many steps, each 4 times as long: quadratic 16, cubic 64
    few = count(40, 60)
    limit = 40 * seconds(few, 0.1, 1e-6, restitution=0.5)
    assert seconds(4 * few, 0.1, 1e-6, enough=limit, restitution=0.5) < limit


@pytest.mark.parametrize("n", [1, 2, 3, 5, 10, 17, 50])
@pytest.mark.parametrize("spread", [0.0, 1e-9, 1e-6, 1e-4])
def test_each_of_many_hits_is_found(n: int, spread: float) -> None:
    m, state = points(n, 0.1, spread, restitution=0.5)
    sol = kp.dynamics(m, state, t_end=0.16)
    for k in range(n):
        fall = np.sqrt(2 * (0.1 + k * spread) / 9.81)
        after = 0.16 - fall
        assert sol.events[f"c{k}.hit"].t == pytest.approx([fall], abs=1e-12)
        expected = 0.5 * 9.81 * fall * after - 0.5 * 9.81 * after**2
        assert sol[f"b{k}.y"][-1] == pytest.approx(expected, abs=1e-12)
