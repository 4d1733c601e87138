"""The cost of contacts: balls that bounce on a floor, for each form of curve.

Run ``.venv/bin/python benchmarks/contacts.py``. It prints the wall time of a run with 100, 300 and
1000 contacts, and the time for each contact and evaluation.
"""

from __future__ import annotations

import time
from typing import Any

import kempe as kp
import numpy as np

COUNTS = (100, 300, 1000)
FLOORS: dict[str, dict[str, Any]] = {
    "line": {"line": ((9, 0), (-1, 0))},
    "circle": {"circle": (4, -50, 50)},
    "spline": {"points": [(x, 0.05 * np.sin(x)) for x in np.linspace(9, -1, 60)]},
    "formula": {"x": "-u", "y": "0.05*sin(u)", "range": (-9, 1)},
}


def bouncing(floor: dict[str, Any], count: int) -> kp.State:
    """Balls beside each other above a floor."""
    m = kp.Model("balls", gravity=(0, -9.81))
    m.ground.curves(floor=floor)
    place: dict[str, float] = {}
    for k in range(count):
        m.point_mass(f"b{k}", mass=1)
        m.contact(f"c{k}", f"b{k}.P", "ground.floor", radius=0.01, stiffness=1e6, damping=0.1)
        place |= {f"b{k}.x": 8 * k / count, f"b{k}.y": 0.2}
    return kp.assemble(m, set=place)


def main() -> None:
    """Print a table."""
    print(f"{'curve':8} {'contacts':>8} {'wall':>9} {'evaluations':>12} {'each':>9}")
    for name, floor in FLOORS.items():
        for count in COUNTS:
            start = bouncing(floor, count)
            begin = time.perf_counter()
            sol = kp.dynamics(start.model, start, t_end=0.1, method=kp.RK4(step=1e-4))
            wall = time.perf_counter() - begin
            each = 1e9 * wall / (sol.nfev * count)
            print(f"{name:8} {count:8d} {wall:7.2f} s {sol.nfev:12d} {each:6.0f} ns")


if __name__ == "__main__":
    main()
