"""By default a run draws few figures: its time is that of a command, not of a report."""

import resource
import subprocess
import sys
from pathlib import Path

import kempe as kp
import pytest
from sizes import only_full

from examples.n_four_bar import windows

FOUR_BAR = Path(__file__).parents[2] / "examples" / "four_bar.toml"
TRIES = 3

#: A program that draws one figure, and its processor time on the machine of the limits, s.
ONE_FIGURE = """
import matplotlib
matplotlib.use("agg")
from matplotlib import pyplot
figure, axes = pyplot.subplots()
axes.plot([1, 2])
figure.savefig("figure.png")
figure.savefig("figure.svg")
"""
SECONDS_OF_ONE_FIGURE = 0.7


def seconds(arguments: list[str], folder: Path) -> float:
    """Processor time of a Python process, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def takes_less_than(limit: float, case: Path, folder: Path) -> bool:
    """Whether a run takes less than the limit; a slower machine gets more time."""
    run, figure = [], []
    for _ in range(TRIES):
        run.append(seconds(["-m", "kempe", "run", str(case), "-q"], folder))
        figure.append(seconds(["-c", ONE_FIGURE], folder))
        slowness = max(1.0, min(figure) / SECONDS_OF_ONE_FIGURE)
        if min(run) < limit * slowness:
            return True
    print(f"a run takes {run} s, one figure {figure} s")
    return False


@pytest.mark.skipif(sys.platform == "win32", reason="times of processes as POSIX has them")
def test_the_flagship_takes_less_than_3_s(tmp_path: Path) -> None:
    assert takes_less_than(3.0, FOUR_BAR, tmp_path)


@only_full
@pytest.mark.skipif(sys.platform == "win32", reason="times of processes as POSIX has them")
def test_21_bodies_take_less_than_6_s(tmp_path: Path) -> None:
    model = windows(10)
    guess = {f"coupler{k}.angle": 0 for k in range(10)}
    start = {"set": {"crank0.angle": "90*deg", "crank0.omega": -1}, "guess": guess}
    path = tmp_path / "windows.toml"
    kp.Case(model, start, [kp.Dynamics(10, 0.01, name="turn")]).save(path)
    assert len(kp.load(path).start().coordinates()) > 3 * 21
    assert takes_less_than(6.0, path, tmp_path)
