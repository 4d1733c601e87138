"""Random mechanisms with up to three joints on curves, against equations that share no formula.

Sizes and masses lie between 1e-3 and 1e3 (m, kg), and each body has its own mass.
"""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from sizes import FULL, count
from truth.drawn_mechanisms import Drawing, Drawn, Vector, scales

#: Largest difference of accelerations, and of coordinates after a run.
EXACT = 1e-7
#: A mechanism whose equations are nearer to a singular position is not compared.
REGULAR = 3e-3
#: Mechanisms of one test.
MANY = 25
#: A stiff motion, of which the other integration takes ten thousand steps, is followed for a while.
BRIEF = {} if FULL else {1015: 0.1}
#: A motion like that of 1015, of which the other integration takes ten thousand steps.
LONG = frozenset() if FULL else frozenset({1017})


def regular(made: Drawn, q: Vector) -> bool:
    jacobian = made.jacobian(q) * scales(made)
    rows = jacobian / np.linalg.norm(jacobian, axis=1)[:, None]
    return bool(np.linalg.svd(rows, compute_uv=False)[-1] > REGULAR)


def drawn(seed: int, rubs: bool = False) -> tuple[Drawn, Vector] | None:
    """A mechanism with its rates; None near a singular position."""
    drawing = Drawing(seed)
    made = drawing.mechanism(on_curves=seed % 4, rubs=rubs)
    return (made, drawing.rates()) if regular(made, np.array(made.q)) else None


def apart(made: Drawn, a: Vector, b: Vector) -> float:
    """The largest difference of two vectors of coordinates, relative to the largest coordinate."""
    scale = scales(made)
    return float((abs(a - b) / scale).max() / (abs(b) / scale).max())


@pytest.mark.parametrize("rubs", [False, True], ids=["free", "friction"])
@pytest.mark.parametrize("part", range(count(12, 120)))
def test_accelerations(part: int, rubs: bool) -> None:
    compared = 0
    for seed in range(MANY * part, MANY * (part + 1)):
        if (found := drawn(seed, rubs)) is not None:
            made, v = found
            state = kp.State(made.model, 0.0, made.q, v)
            a, _ = made.accelerations(np.array(made.q), v)
            assert apart(made, state.a, a) < EXACT, seed
            compared += 1
    assert compared > MANY / 2


@pytest.mark.parametrize("part", range(count(6, 60)))
def test_starts(part: int) -> None:
    """Assembly keeps rates that satisfy the joints, and coordinates."""
    for seed in range(MANY * part, MANY * (part + 1)):
        if (found := drawn(seed)) is not None:
            made, v = found
            state = kp.State(made.model, 0.0, made.q, v)
            again = kp.assemble(made.model, from_state=state)
            assert apart(made, again.q, state.q) < EXACT, seed
            assert apart(made, again.v, state.v) < EXACT, seed


@pytest.mark.filterwarnings("ignore::kempe.EventWarning")  # flats that lift off
@pytest.mark.parametrize("part", range(count(4, 40)))
def test_motions(part: int) -> None:
    """A short motion by two methods, against an integration of the other equations."""
    compared = 0
    for seed in range(1000 + 6 * part, 1000 + 6 * (part + 1)):
        if seed in LONG or (found := drawn(seed)) is None:
            continue
        made, v = found
        n, q = len(v), np.array(made.q)
        t_end = 0.1 * (made.size / 9.81) ** 0.5 * BRIEF.get(seed, 1.0)

        def rates(_: float, y: Vector, made: Drawn = made, n: int = n) -> Vector:
            return np.concatenate([y[n:], made.accelerations(y[:n], y[n:])[0]])

        # some springs are stiff
        exact = {"method": "LSODA", "rtol": 1e-11, "atol": 1e-14}
        other = solve_ivp(rates, (0.0, t_end), [*q, *v], **exact)
        end = other.y[:n, -1]
        if not regular(made, end):
            continue
        tight = {"rtol": 1e-9, "atol": 1e-12}
        for method in (kp.DOP853(**tight), kp.Radau(**tight)):
            begin = kp.State(made.model, 0.0, q, v)
            run = kp.dynamics(made.model, begin, t_end=t_end, method=method)
            assert apart(made, run.q[-1], end) < EXACT, (seed, method)
            balance = abs(run.energy.balance).max() / max(run.energy.kinetic.max(), 1e-300)
            assert balance < 1e-6, (seed, method)
        compared += 1
    assert compared > 1
