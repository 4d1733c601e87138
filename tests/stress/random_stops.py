"""Oscillators between random stops: no stop is missed at any time.

    PYTHONPATH=tests python -m stress.random_stops 10000

tries 10 000 limits and prints the deepest place beyond one, with the number of impacts. The exit
code is 1 if a place is deeper than 1e-6 m.
"""

from __future__ import annotations

import argparse
import sys

import kempe as kp
import numpy as np

#: Oscillators of a model, each with two limits.
TOGETHER = 5
#: Deepest place beyond a limit, m.
BEYOND = 1e-6
T_END = 0.5
#: States of a run that are looked at, between its outputs.
LOOKED_AT = 4001


def oscillators(seed: int) -> tuple[kp.Model, dict[str, float]]:
    """Masses on springs with excitation between stops, and their start."""
    rng = np.random.default_rng([10_000, seed])
    m = kp.Model("oscillators")
    m.ground.points(O=(0, 0))
    start: dict[str, float] = {}
    for k in range(TOGETHER):
        m.point_mass(f"p{k}", mass=10 ** rng.uniform(-2, 2))
        stiffness, pulse = 10 ** rng.uniform(0, 4), rng.uniform(1, 60)
        law = f"-{stiffness}*p{k}.x + {rng.uniform(0, 5)}*sin({pulse}*t)"
        m.generalized_force(f"f{k}", f"p{k}.x", value=law)
        limits = {"lower": -(10 ** rng.uniform(-4, 0)), "upper": 10 ** rng.uniform(-4, 0)}
        m.stop(f"s{k}", f"p{k}.x", restitution=rng.choice([0, rng.uniform(0, 1), 1]), **limits)
        start |= {f"p{k}.x": 0, f"p{k}.y": 0, f"p{k}.vx": rng.uniform(-2, 2)}
    return m, start


def deepest(seed: int) -> tuple[float, int]:
    """The deepest place beyond a limit, m, and the number of impacts."""
    m, start = oscillators(seed)
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=T_END)
    fine = sol(np.linspace(0, T_END, LOOKED_AT))
    gaps = [min(fine[f"s{k}.gap"].min(), sol[f"s{k}.gap"].min()) for k in range(TOGETHER)]
    return -min(gaps), sum(len(sol.events[f"s{k}.hit"].t) for k in range(TOGETHER))


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("limits", type=int)
    asked = parser.parse_args()
    models = -(-asked.limits // (2 * TOGETHER))
    found, errors = [], 0
    for seed in range(models):
        try:
            found.append(deepest(seed))
        except kp.KempeError as error:
            errors += 1
            print(f"{seed}: {error}", flush=True)
            continue
        if found[-1][0] > BEYOND:
            print(f"{seed}: {found[-1][0]:.2g} m beyond a limit", flush=True)
    worst = max(depth for depth, _ in found)
    impacts = sum(count for _, count in found)
    limits = 2 * TOGETHER * len(found)
    print(f"{limits} limits, {impacts} impacts, deepest {worst:.2g} m, {errors} errors")
    return int(worst > BEYOND)


if __name__ == "__main__":
    sys.exit(main())
