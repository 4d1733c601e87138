"""Compare the results of two builds of kempe.

    python benchmarks/compare_builds.py OTHER [THIS]

OTHER and THIS are folders that contain the package `kempe` with its extension, such as `python/` of
another checkout, or files that an earlier comparison has stored: `--store FILE.npz` stores THIS.
By default THIS is the package that is imported here.

Every method is written out with its first step, so no default can differ. The program prints the
largest differences of q and v between the builds, relative to the largest component of q or v,
and the numbers of steps.
"""

from __future__ import annotations

import argparse
import os
import runpy
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

EXAMPLES = Path(__file__).parent.with_name("examples")
#: Examples, with the time simulated and the constant step, s.
CASES = {
    "four_bar": (5.0, 1e-3),
    "squeezer": (0.03, 1e-5),
    "slider_crank": (2.0, 1e-3),
    "six_bar": (2.0, 1e-3),
}
#: Windows of the N-four-bar, part of the time to its first singular position, constant step.
WINDOWS, PART, STEP = 10, 0.95, 1e-3
#: Reported states of a run.
OUTPUTS = 200


def record(file: Path) -> None:
    """Run everything with the imported build and store q, v and the steps."""
    import kempe as kp

    n_four_bar = runpy.run_path(str(EXAMPLES / "n_four_bar.py"))
    starts = {name: kp.load(EXAMPLES / f"{name}.toml").start() for name in CASES}
    starts["n_four_bar"] = n_four_bar["upright"](n_four_bar["windows"](WINDOWS), WINDOWS)
    angles = np.linspace(0.0, np.pi / 2, 10_001)
    paces = 1 / n_four_bar["rate"](angles, WINDOWS)
    to_singular = float(((paces[1:] + paces[:-1]) / 2 * np.diff(angles)).sum())
    tables: dict[str, np.ndarray] = {}
    for name, start in starts.items():
        t_end, step = CASES.get(name, (PART * to_singular, STEP))
        gains, projection = kp.Baumgarte(alpha=10, beta=200), kp.Projection(tolerance=1e-12)
        # after a much shorter first step, the error estimate and so the next step are rounding
        rk45 = kp.RK45(rtol=1e-8, atol=1e-11, first_step=20 * step)
        dop853 = kp.DOP853(rtol=1e-9, atol=1e-12, first_step=20 * step)
        runs = {
            "RK45, Baumgarte": (rk45, gains),
            "DOP853, projection": (dop853, projection),
            "RK4, constant step": (kp.RK4(step=step), gains),
            "Radau, constant step": (kp.Radau(rtol=1e-10, atol=1e-12, step=step), projection),
        }
        for label, (method, stabilization) in runs.items():
            sol = kp.dynamics(
                start.model,
                start,
                t_end=t_end,
                method=method,
                stabilization=stabilization,
                output_step=t_end / OUTPUTS,
            )
            key = f"{name}: {label}"
            tables |= {f"{key}: q": sol.q, f"{key}: v": sol.v}
            tables[f"{key}: steps"] = np.array(sol.statistics["steps"])
    np.savez(file, **tables)  # type: ignore[arg-type]


def results(build: Path, folder: str) -> dict[str, np.ndarray]:
    """The tables of a build, in a process of its own, or those of a file."""
    if build.is_dir():
        file = Path(folder) / "record.npz"
        command = [sys.executable, __file__, "--record", str(file)]
        subprocess.run(command, check=True, env=os.environ | {"PYTHONPATH": str(build)})
        build = file
    with np.load(build) as stored:
        return dict(stored)


def largest(a: np.ndarray, b: np.ndarray) -> float:
    """Largest difference, relative to the largest component; infinite for other shapes."""
    if a.shape != b.shape:
        return float("inf")
    return float(np.abs(a - b).max() / np.abs(a).max())


def main() -> None:
    """Compare and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("other", type=Path, nargs="?")
    parser.add_argument("this", type=Path, nargs="?")
    parser.add_argument("--store", type=Path, help="store the results of THIS in this file")
    parser.add_argument("--record", type=Path, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.record is not None:
        record(given.record)
        return
    if given.this is None:
        import kempe

        given.this = Path(kempe.__file__).parent.parent
    with tempfile.TemporaryDirectory() as folder:
        this = results(given.this, folder)
        if given.store is not None:
            np.savez(given.store, **this)  # type: ignore[arg-type]
        if given.other is None:
            return
        other = results(given.other, folder)
    print(f"{'run':<36}{'difference of q':>18}{'difference of v':>18}{'steps':>16}")
    for run in [key.removesuffix(": q") for key in this if key.endswith(": q")]:
        q, v = (largest(other[f"{run}: {x}"], this[f"{run}: {x}"]) for x in "qv")
        before, after = (int(tables[f"{run}: steps"]) for tables in (other, this))
        steps = str(after) if before == after else f"{before} → {after}"
        print(f"{run:<36}{q:>18.1e}{v:>18.1e}{steps:>16}")


if __name__ == "__main__":
    main()
