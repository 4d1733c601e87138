"""The cost of rigid contacts in a heap: discs of different sizes fall into a bin.

Run ``.venv/bin/python benchmarks/heaps.py [--discs 5 10] [--t-end 1]``. For each number of discs
and restitution it prints the contacts that are watched, the events, the time for each of them, the
largest penetration, which follows from the positions alone, and the largest energy error.
"""

from __future__ import annotations

import argparse
import time

import kempe as kp
import numpy as np

RESTITUTIONS = (0.0, 0.3, 0.6, 0.9)


def heap(radii: np.ndarray, restitution: float) -> tuple[kp.State, float]:
    """Discs above the floor of a bin, each in contact with walls and all others; its half width."""
    half = 0.125 * np.sqrt(len(radii)) + 0.05
    columns = int(2 * half / 0.25)
    m = kp.Model("heap", gravity=(0, -9.81))
    walls = {
        "left": {"line": ((-half, 0), (-half, 50))},
        "right": {"line": ((half, 50), (half, 0))},
        "floor": {"line": ((half, 0), (-half, 0))},
    }
    m.ground.curves(**walls)
    place: dict[str, float] = {}
    for k, r in enumerate(radii):
        mass = 30 * np.pi * r**2
        rim = {"rim": {"circle": (0, 0, r)}}
        m.body(f"b{k}", mass=mass, inertia=mass * r**2 / 2, points={"C": (0, 0)}, curves=rim)
        row, column = divmod(k, max(columns, 1))
        x = -half + (column + 0.5) * 2 * half / max(columns, 1)
        place |= {f"b{k}.x": x + 0.01 * np.sin(7.0 * k), f"b{k}.y": 0.15 + 0.26 * row}
        place |= {f"b{k}.angle": 0.0}
        others = [*(f"ground.{name}" for name in walls), *(f"b{j}.rim" for j in range(k))]
        for other in others:
            name = f"c{k}_{other.partition('.')[0 if other[0] == 'b' else 2]}"
            m.contact(name, f"b{k}.C", other, radius=r, restitution=restitution)
    return kp.assemble(m, set=place), half


def penetration(sol: kp.Solution, radii: np.ndarray, half: float) -> float:
    """The largest depth in m at the reported times, from the positions of the discs."""
    x, y = sol.q[:, 0::3], sol.q[:, 1::3]
    depth = max(float((radii - y).max()), float((np.abs(x) + radii - half).max()))
    for k in range(1, len(radii)):
        apart = np.hypot(x[:, :k] - x[:, k : k + 1], y[:, :k] - y[:, k : k + 1])
        depth = max(depth, float((radii[:k] + radii[k] - apart).max()))
    return depth


def main() -> None:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--discs", type=int, nargs="+", default=[2, 5, 10])
    parser.add_argument("--t-end", type=float, default=0.5)
    asked = parser.parse_args()
    print("discs contacts    e  events      cpu  per event  penetration  energy error")
    for count in asked.discs:
        radii = np.random.default_rng(1).uniform(0.06, 0.12, count)
        for restitution in RESTITUTIONS:
            start, half = heap(radii, restitution)
            begin = time.process_time()
            sol = kp.dynamics(start.model, start, t_end=asked.t_end)
            cpu = time.process_time() - begin
            events = sum(len(event.t) for event in sol.events.values())
            contacts = count * 3 + count * (count - 1) // 2
            error = float(np.abs(sol.energy.balance).max())
            print(
                f"{count:5d} {contacts:8d} {restitution:4.1f} {events:7d} {cpu:6.2f} s "
                f"{1e3 * cpu / max(events, 1):7.2f} ms {penetration(sol, radii, half):10.1e} m "
                f"{error:13.1e}",
                flush=True,
            )


if __name__ == "__main__":
    main()
