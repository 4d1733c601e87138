"""Random mechanisms with up to three joints on curves, against equations that share no formula."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from sizes import count
from truth.drawn_mechanisms import Drawing, Drawn, Vector

#: Distance of accelerations, relative to the largest of their kind.
EXACT = 1e-8
#: A mechanism whose equations are nearer to a singular position is not compared.
REGULAR = 1e-3


def scales(made: Drawn) -> Vector:
    """The sizes of the coordinates: lengths for x and y, 1 for angles and parameters."""
    scale = np.ones(len(made.q))
    for body in range(made.bodies):
        scale[3 * body : 3 * body + 2] = made.size
    return scale


def regular(made: Drawn) -> bool:
    jacobian = made.jacobian(np.array(made.q)) * scales(made)
    rows = jacobian / np.linalg.norm(jacobian, axis=1)[:, None]
    return bool(np.linalg.svd(rows, compute_uv=False)[-1] > REGULAR)


def drawn(seed: int) -> tuple[Drawn, Vector, kp.State] | None:
    """A mechanism with its rates and its state in kempe; None near a singular position."""
    drawing = Drawing(seed)
    made = drawing.mechanism(on_curves=seed % 4)
    if not regular(made):
        return None
    rates = drawing.rates()
    return made, rates, kp.State(made.model, 0.0, made.q, rates)


if __name__ == "__main__":
    import sys, collections
    bad = collections.Counter()
    for seed in range(int(sys.argv[1]), int(sys.argv[2])):
        try:
            found = drawn(seed)
            if found is None:
                bad["near"] += 1
                continue
            made, v, state = found
            a, lam = made.accelerations(np.array(made.q), v)
            e = abs(state.a - a) / scales(made)
            e = e.max() / (abs(a) / scales(made)).max()
            bad["ok" if e < EXACT else "WRONG"] += 1
            if e > EXACT:
                print(seed, "wrong", e, made.size, made.masses[::3], [len(r([kp_ for kp_ in []])) if False else 0 for r in []])
        except kp.KempeError as error:
            bad["error"] += 1
            print(seed, type(error).__name__, str(error)[:200])
    print(bad)
