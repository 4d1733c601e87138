"""A sweep that was killed or interrupted continues, and its table is the same to the last bit."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.sweeps import storage
from sweeps.conftest import FLAGSHIP, flagship

GIVEN = {"L2": {"from": 25.0, "to": 46.0, "n": 12}, "k": [5e5, 1e6, 2e6]}
SCRIPT = f"""
import sys
sys.path.insert(0, {str(FLAGSHIP.parents[1] / "tests")!r})
import kempe as kp
from sweeps.conftest import flagship
kp.sweep(flagship(8.0), {GIVEN!r}, ["pin.max", "lean.final"], workers=1, out=sys.argv[1])
"""


def finished(path: Path) -> int:
    if not path.exists():
        return 0
    data = sqlite3.connect(path)
    try:
        return int(data.execute("SELECT count(*) FROM row").fetchone()[0])
    except sqlite3.OperationalError:  # not yet made
        return 0
    finally:
        data.close()


def same(one: kp.SweepResult, two: kp.SweepResult) -> None:
    for name in one.columns:
        np.testing.assert_array_equal(one[name], two[name])
    assert one.reasons == two.reasons


def test_a_killed_sweep_resumes(folder: Path) -> None:
    path = folder / "sweep.db"
    with subprocess.Popen([sys.executable, "-c", SCRIPT, str(path)]) as child:
        while child.poll() is None and finished(path) < 2:
            time.sleep(0.01)
        child.send_signal(signal.SIGKILL)
    kept = finished(path)
    assert 2 <= kept < 36, "the child was not killed halfway"
    case, seen = flagship(8.0), []
    resumed = kp.sweep(
        case,
        GIVEN,
        ["pin.max", "lean.final"],
        out=path,
        progress=lambda *told: seen.append(told),
    )
    assert seen[0][:3] == (kept, seen[0][1], 36)
    assert seen[-1][0] == 36
    same(resumed, kp.sweep(case, GIVEN, ["pin.max", "lean.final"]))
    assert resumed.reasons


def test_a_finished_sweep_is_only_read(case: kp.Case, folder: Path) -> None:
    first = kp.sweep(case, {"k": [1e6, 2e6]}, ["pin.max"], out=folder / "a" / "s.db")
    with closing(sqlite3.connect(folder / "a" / "s.db")) as data, data:
        row = data.execute("SELECT k, numbers, marks FROM row WHERE k = 1").fetchone()
        data.execute("DELETE FROM row WHERE k = 1")
        told = storage._entry(row[0], row[1], "kept", row[2])
        data.execute("INSERT INTO row VALUES (?, ?, ?, ?, ?)", told)
    again = kp.sweep(case, {"k": [1e6, 2e6]}, ["pin.max"], out=folder / "a" / "s.db")
    assert again.reasons == {1: "kept"}
    assert again["pin.max"][0] == first["pin.max"][0]


@pytest.mark.parametrize(
    ("given", "texts"), [({"k": [1e6, 3e6]}, ["pin.max"]), ({"k": [1e6, 2e6]}, ["pin.min"])]
)
def test_the_file_of_another_sweep_is_refused(
    given: dict, texts: list[str], case: kp.Case, folder: Path
) -> None:
    kp.sweep(case, {"k": [1e6, 2e6]}, ["pin.max"], out=folder / "s.db")
    with pytest.raises(kp.FileError, match=r"another sweep.*name another file"):
        kp.sweep(case, given, texts, out=folder / "s.db")
    with pytest.raises(kp.FileError, match="another sweep"):
        kp.sweep(
            case.with_parameters({"c": 2e4}), {"k": [1e6, 2e6]}, ["pin.max"], out=folder / "s.db"
        )


def test_a_file_that_is_no_sweep_is_refused(case: kp.Case, folder: Path) -> None:
    (folder / "s.db").write_text("not a database, but long enough to be one " * 10)
    with pytest.raises(kp.FileError, match=r"cannot use .*s.db.*delete this file"):
        kp.sweep(case, {"k": [1e6]}, ["pin.max"], out=folder / "s.db")


def test_an_interruption_keeps_what_is_finished(case: kp.Case, folder: Path) -> None:
    def interrupt(done: int, *_: object) -> None:
        if done >= 3:
            os.kill(os.getpid(), signal.SIGINT)

    given = {"k": np.linspace(5e5, 2e6, 9)}
    with pytest.raises(KeyboardInterrupt) as caught:
        kp.sweep(case, given, ["pin.max"], workers=1, out=folder / "s.db", progress=interrupt)
    partial = caught.value.result  # type: ignore[attr-defined]
    assert 0 < len(partial.reasons) < 9
    assert set(partial.reasons.values()) == {"not computed: the sweep was interrupted"}
    whole = kp.sweep(case, given, ["pin.max"], out=folder / "s.db")
    good = partial.succeeded
    np.testing.assert_array_equal(whole["pin.max"][good], partial["pin.max"][good])
    same(whole, kp.sweep(case, given, ["pin.max"]))


def test_an_interruption_within_a_block_arrives_at_once(folder: Path) -> None:
    script = SCRIPT.replace("flagship(8.0)", "flagship(9000.0)").replace("'n': 12", "'n': 120")
    with subprocess.Popen(
        [sys.executable, "-c", script, "s.db"], cwd=folder, stderr=subprocess.PIPE, text=True
    ) as child:
        time.sleep(4.0)
        child.send_signal(signal.SIGINT)
        began = time.monotonic()
        _, told = child.communicate(timeout=30)
    assert "KeyboardInterrupt" in told
    assert time.monotonic() - began < 5.0
