"""kempe compared with a plain NumPy/SciPy program of the same equations, on the flagship.

    python benchmarks/four_bar.py [--repeat 5] [--rtol 1e-6]

Both programs integrate the 18 first-order equations of the Cartesian formulation with
Baumgarte(10, 200) and Dormand-Prince 5(4) over 15 s, atol = rtol / 1000. They compute 1501 outputs
with accelerations and multipliers. Times are medians of CPU times of alternating runs in one
process. Compare the ratio. `run.py` compares all tools at all settings.
"""

from __future__ import annotations

import argparse
import statistics

from peers import kempe_itself, numpy_scipy
from problems import problem
from turns import first, timed

#: Runs of kempe per turn, because a single run of a few milliseconds is not representative.
RUNS = 20
PROGRAMS = ((numpy_scipy, "scipy RK45, Baumgarte", 1), (kempe_itself, kempe_itself.BAUMGARTE, RUNS))


def main() -> None:
    """Print the comparison."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--rtol", type=float, default=1e-6)
    asked = parser.parse_args()
    flagship = problem("flagship")
    programs = []
    for tool, curve, runs in PROGRAMS:
        of_curve = [s for s in tool.settings(flagship) if s.curve == curve]
        setting = next((s for s in of_curve if s.tolerance == asked.rtol), None)
        if setting is None:
            parser.error(f"--rtol: one of {', '.join(f'{s.tolerance:g}' for s in of_curve)}")
        record, run = first(tool, flagship, setting)
        if record.failure is not None:
            raise SystemExit(f"{tool.NAME}: {record.failure}")
        programs.append((record, run, runs))
    times: dict[str, list[float]] = {record.tool: [] for record, _, _ in programs}
    for _ in range(asked.repeat):
        for record, run, runs in programs:
            times[record.tool] += [timed(run)[0] for _ in range(runs)]
    medians = {tool: statistics.median(values) for tool, values in times.items()}
    print(f"flagship, 15 s, rtol {asked.rtol:g}, {asked.repeat} turns")
    for record, _, _ in programs:
        print(
            f"  {record.tool:<6} {1e3 * medians[record.tool]:10.2f} ms   error {record.error:.1e}"
        )
    print(f"  ratio of medians {medians['scipy'] / medians['kempe']:.0f}")


if __name__ == "__main__":
    main()
