"""By default a run draws few figures: its time is that of a command, not of a report."""

import resource
import subprocess
import sys
from pathlib import Path

import kempe as kp
import pytest

from examples.n_four_bar import windows

pytestmark = pytest.mark.alone

FOUR_BAR = Path(__file__).parents[2] / "examples" / "four_bar.toml"
TRIES = 3


def seconds(case: Path, folder: Path) -> float:
    """Processor time of a run, s: other work of the machine hardly changes it."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "kempe", "run", str(case), "-q"]
    subprocess.run(command, cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def least(case: Path, folder: Path, limit: float) -> float:
    found = float("inf")
    for _ in range(TRIES):
        found = min(found, seconds(case, folder))
        if found < limit:
            break
    return found


@pytest.mark.skipif(sys.platform == "win32", reason="times of processes as POSIX has them")
def test_the_flagship_takes_less_than_3_s(tmp_path: Path) -> None:
    assert least(FOUR_BAR, tmp_path, 3.0) < 3.0


@pytest.mark.skipif(sys.platform == "win32", reason="times of processes as POSIX has them")
def test_21_bodies_take_less_than_6_s(tmp_path: Path) -> None:
    model = windows(10)
    guess = {f"coupler{k}.angle": 0 for k in range(10)}
    start = {"set": {"crank0.angle": "90*deg", "crank0.omega": -1}, "guess": guess}
    path = tmp_path / "windows.toml"
    kp.Case(model, start, [kp.Dynamics(10, 0.01, name="turn")]).save(path)
    assert len(kp.load(path).start().coordinates()) > 3 * 21
    assert least(path, tmp_path, 6.0) < 6.0
