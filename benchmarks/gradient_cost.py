"""Cost of a gradient of a final value, in runs of the same case: CPU time, medians of several."""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import kempe as kp

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "examples"))
import n_four_bar  # noqa: E402

REPEATS = 7
COUNTS = (1, 2, 4, 8, 16)


def seconds(work: Callable[[], object]) -> float:
    """The median CPU time of a call, s."""
    found = []
    for _ in range(REPEATS):
        begin = time.process_time()
        work()
        found.append(time.process_time() - begin)
    return statistics.median(found)


def with_variables(case: kp.Case) -> tuple[kp.Case, list[str]]:
    """The case with masses and inertias as parameters, and their names."""
    tree: dict[str, Any] = json.loads(json.dumps(case.tree()))
    parameters = tree.setdefault("parameters", {})
    names = []
    for body, entry in tree["bodies"].items():
        for key in ("mass", "inertia"):
            if isinstance(entry, Mapping) and isinstance(entry.get(key), float | int):
                names.append(f"{key}_{body}")
                parameters[names[-1]], entry[key] = entry[key], names[-1]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.json"
        path.write_text(json.dumps(tree), encoding="utf-8")
        return kp.load(path), names


def row_of_windows(count: int) -> kp.Case:
    """The N-four-bar mechanism for one second, before its first singular position."""
    guess = {f"coupler{k}.angle": 0 for k in range(count)}
    start = {"set": {"crank0.angle": "90*deg", "crank0.omega": -1}, "guess": guess}
    run = kp.Dynamics(t_end=0.3, output_step=0.01)
    return kp.Case(n_four_bar.windows(count), start, [run])


def cantilever() -> kp.Case:
    """A beam of two elements vibrates under its weight; its fastest rate is 2e9 1/s."""
    values = {"E": "70e9 Pa", "L": "0.4 m", "h": "2 mm", "rho": 2700}
    m = kp.Model("cantilever", gravity=(0, -9.81), parameters=values)
    m.ground.points(O=(0, 0))
    section = {"rectangle": ["h", "20 mm"]}
    m.beam("beam", length="L", section=section, young="E", density="rho", damping=1e-4, elements=2)
    m.weld("clamp", "ground.O", "beam.A")
    return kp.Case(m, {}, [kp.Dynamics(t_end=0.006, output_step=0.002)])


def damped_floor() -> kp.Case:
    """A mass that falls on a stiff floor, and rests on it."""
    values = {"k": 1e6, "c": 1e3, "height": 0.12, "mass": 1}
    m = kp.Model("floor", gravity=(0, -9.81), parameters=values)
    m.ground.points(O=(0, 0))
    m.body("body", mass="mass", inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "body.P", axes=("pi/2", "pi/2"))
    law: dict[str, Any] = {"stiffness": "k", "damping": "c", "free_length": 0.1}
    m.spring_damper("floor", "ground.O", "body.P", only="compression", **law)
    start: dict[str, Any] = {"set": {"body.y": "height", "body.vy": 0}}
    return kp.Case(m, start, [kp.Dynamics(t_end=0.5, output_step=0.05)])


def main() -> None:
    """Print the ratios by number of variables."""
    four_bar = kp.load(ROOT / "examples" / "four_bar.toml")
    first = ["k", "c", "L2", "G", "L1", "L3", "crank.angle"]
    flagship, masses = with_variables(four_bar)
    cases = {
        "four-bar linkage": (flagship, first + masses, "rocker.angle.final"),
        "squeezer": (
            *with_variables(kp.load(ROOT / "examples" / "squeezer.toml")),
            "K1.angle.final",
        ),
        "100 windows": (*with_variables(row_of_windows(100)), "crank0.angle.final"),
        "bistable_switch, snap (stiff)": (
            kp.load(ROOT / "examples" / "bistable_switch.toml").with_analysis("snap"),
            ["E", "rise", "thickness", "width"],
            "push.effort.final",
        ),
        "cantilever (stiff)": (cantilever(), ["E", "L", "h", "rho"], "beam.B.y.final"),
        "damped floor (stiff)": (damped_floor(), ["k", "c", "height", "mass"], "body.y.final"),
    }
    for title, (case, names, measure) in cases.items():
        level = {names[0]: [kp.gradient(case, [measure], names[:1]).variables[names[0]]]}
        run = seconds(lambda: kp.sweep(case, level, [measure], workers=1))  # noqa: B023
        print(f"{title}: run {1e3 * run:.2f} ms")
        for count in [count for count in COUNTS if count <= len(names)]:
            taken = seconds(lambda: kp.gradient(case, [measure], names[:count]))  # noqa: B023
            print(f"  {count:2} variables: {taken / run:5.1f} runs")


if __name__ == "__main__":
    main()
