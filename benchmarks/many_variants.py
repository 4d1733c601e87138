"""Sweeps: runs per second beside the floor program, and memory over many small variants.

    .venv/bin/python benchmarks/many_variants.py           # 2000 flagships, 100 000 small variants
    .venv/bin/python benchmarks/many_variants.py --small 1000000
    .venv/bin/python benchmarks/many_variants.py --runs 100000 --only "default, final"
    .venv/bin/python benchmarks/many_variants.py --dask       # what a block on a cluster costs
    .venv/bin/python benchmarks/many_variants.py --mujoco     # beside RK4 of MuJoCo at 1 ms

The floor (``benchmarks/floor``) simulates the flagship by hand, with RK45 and Baumgarte's
stabilization. It runs on all processors at once, as the sweep does, because others may load the
processors of one machine differently. Times are CPU times, so that other work on the machine counts
little. The wall time is printed too.
"""

from __future__ import annotations

import argparse
import os
import resource
import statistics
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
from floor_program import build, told
from peers import mujoco_tree
from peers.setting import Setting
from problems import problem

ROOT = Path(__file__).parents[1]
METHODS: dict[str, dict[str, Any]] = {
    "rk45 1e-6, baumgarte": {},
    "default": {"method": kp.Auto(), "stabilization": kp.Projection()},
}
_TURNS = 4
#: The integrator and solver of MuJoCo.
MUJOCO = {"integrator": "RK4", "solver": "Newton"}
MEASURES = {"final": ["rocker.angle.final"], "peak": ["C.force.max"]}
#: Both, as in "default, peak".
KINDS = [f"{method}, {name}" for method in METHODS for name in MEASURES]


def flagship(changes: dict[str, Any]) -> kp.Case:
    """The flagship, 15 s, with the damping of the floor."""
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    return case.with_analysis("release", **changes)


def rod() -> kp.Case:
    """A rod that swings for ten milliseconds."""
    m = kp.Model("rod", gravity=(0, -9.81), parameters={"mass": 2.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="mass", length=1, ends=("O", "E"))
    m.revolute("O", "ground.O", "rod.O")
    run = kp.Dynamics(t_end=0.01, output_step=0.01, dense_output=False)
    return kp.Case(m, {"set": {"rod.angle": 0.0}}, [run])


def spent(case: kp.Case, n: int, measures: list[str], **options: Any) -> tuple[float, float]:
    """CPU and wall time of a variant of the flagship, s."""
    given = {"k": {"uniform": [5e5, 2e6]}}
    cpu, wall = time.process_time(), time.perf_counter()
    found = kp.sweep(case, given, measures, design="random", n=n, **options)
    assert found.succeeded.all()
    return (time.process_time() - cpu) / n, (time.perf_counter() - wall) / n


def by_hand(program: Path) -> float:
    """CPU time of a run of the floor, s: the mean of programs on all processors at once."""
    count = len(os.sched_getaffinity(0))
    with ThreadPoolExecutor(count) as pool:
        found = list(pool.map(lambda _: told(program, 5, "runs")["runs"], range(count)))
    return statistics.mean(one[1]["chain"]["seconds"] for one in found)


def runs(n: int, floor: Path | None, only: str | None) -> None:
    """Times of a run by kempe's sweep and by the floor, in alternation."""
    program = floor or build()
    for method, changes in METHODS.items():
        for name, measures in MEASURES.items():
            if only not in (None, f"{method}, {name}"):
                continue
            case = flagship(changes)
            turns = [(by_hand(program), spent(case, n // _TURNS, measures)) for _ in range(_TURNS)]
            least = statistics.median(at for at, _ in turns)
            cpu = statistics.median(times[0] for _, times in turns)
            wall = statistics.median(times[1] for _, times in turns)
            print(
                f"{method:22} {name:8} {1e3 * cpu:7.3f} ms CPU  {1e3 * wall:7.3f} ms wall  "
                f"floor {1e3 * least:6.3f} ms CPU  runs per second: {least / cpu:5.2f} × floor",
                flush=True,
            )


def memory(n: int) -> None:
    """The largest memory over many small variants, above that of the table."""
    kp.sweep(rod(), {"mass": {"uniform": [1, 3]}}, ["rod.angle.final"], design="random", n=100)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    began = time.perf_counter()
    found = kp.sweep(
        rod(), {"mass": {"uniform": [1, 3]}}, ["rod.angle.final"], design="random", n=n
    )
    wall = time.perf_counter() - began
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    table = sum(found[name].nbytes for name in found.columns) / 1e6
    print(
        f"{n} small variants: {1e6 * wall / n:.0f} µs each, "
        f"{(after - before) / 1e3 - table:.0f} MB above the table of {table:.0f} MB"
    )


def cluster(n: int) -> None:
    """Times of a sweep on threads and on processes of a cluster on this machine."""
    workers = len(os.sched_getaffinity(0))
    case = flagship({**METHODS["default"], "t_end": 2.0})
    given = {"k": np.linspace(5e5, 2e6, n)}
    for name, options in {"threads": {}, "Dask, processes": {"scheduler": "dask"}}.items():
        began = time.perf_counter()
        kp.sweep(case, given, ["C.force.max"], workers=workers, **options)
        print(f"{n} variants on {workers} {name}: {time.perf_counter() - began:.1f} s wall")


def mujoco(n: int) -> None:
    """CPU time of a run by MuJoCo beside that of a variant, in alternation."""
    run = mujoco_tree.prepare(problem("flagship"), Setting(mujoco_tree.CURVE, 1e-3, MUJOCO))
    for method, changes in METHODS.items():
        turns = []
        for _ in range(_TURNS):
            began = time.process_time()
            run()
            told = time.process_time() - began
            turns.append((told, spent(flagship(changes), n // _TURNS, MEASURES["final"])[0]))
        theirs, ours = (statistics.median(times) for times in zip(*turns, strict=True))
        print(
            f"{method:22} {1e3 * ours:7.3f} ms CPU  MuJoCo {1e3 * theirs:7.1f} ms CPU: "
            f"{theirs / ours:.0f} × as long",
            flush=True,
        )


def main() -> None:
    """Measure what the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=2000, help="flagships")
    parser.add_argument("--small", type=int, default=100_000, help="small variants")
    parser.add_argument("--floor", type=Path, help="the floor program, if it is built")
    parser.add_argument("--dask", action="store_true", help="compare threads and a cluster")
    parser.add_argument("--mujoco", action="store_true", help="compare with MuJoCo")
    parser.add_argument("--only", choices=KINDS, help="one method and statistic")
    words = parser.parse_args()
    if words.dask:
        cluster(words.runs)
        return
    if words.mujoco:
        mujoco(words.runs)
        return
    memory(words.small)
    runs(words.runs, words.floor, words.only)


if __name__ == "__main__":
    main()
