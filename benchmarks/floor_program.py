"""Builds and runs the floor program: the flagship by hand, compared with kempe's evaluation."""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
from pathlib import Path
from typing import Any

from peers import kempe_itself
from peers.setting import Setting
from problems import problem
from turns import timed

FLOOR = Path(__file__).parent / "floor"
#: Runs of the floor and of kempe in each turn.
RUNS = 5


def build(native: bool = False) -> Path:
    """The program, built with kempe's compiler flags or for the present processor."""
    if shutil.which("cargo") is None:
        raise RuntimeError(
            "cargo was not found: the floor is a Rust program; see https://rustup.rs"
        )
    target = FLOOR / "target" / ("native" if native else "")
    flags = {"RUSTFLAGS": "-C target-cpu=native"} if native else {}
    command = ["cargo", "build", "--release", "--locked", "--quiet", "--target-dir", str(target)]
    subprocess.run(command, cwd=FLOOR, check=True, env={**os.environ, **flags})
    return target / "release" / "kempe-floor"


def told(program: Path, *words: object) -> Any:
    """The output of the program."""
    command = [str(program), *map(str, words)]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)


def measure(repeat: int) -> dict[str, Any]:
    """Evaluations, windows and runs of the floor, in alternation with kempe's run from Python."""
    program = build()
    flagship = problem("flagship")
    alpha, beta = flagship.gains
    options = kempe_itself.settings(flagship)
    same = next(s for s in options if s.curve == kempe_itself.BAUMGARTE and s.tolerance == 1e-6)
    run = kempe_itself.prepare(flagship, Setting("floor", 1e-6, same.options))
    by_hand: dict[str, list[float]] = {"chain": [], "straight": []}
    from_python = []
    for _ in range(repeat):
        at = told(program, RUNS, "runs")["runs"][1]
        for name, times in by_hand.items():
            times.append(at[name]["seconds"])
        from_python += [timed(run)[0] for _ in range(RUNS)]
    found = told(program, 5 * repeat)
    found["native"] = {
        part: told(build(native=True), 5 * repeat, part)[part] for part in ("evaluation", "runs")
    }
    found["python"] = {
        "kempe_seconds": statistics.median(from_python),
        **{f"{name}_seconds": statistics.median(times) for name, times in by_hand.items()},
        "gains": [alpha, beta],
    }
    return dict(found)
