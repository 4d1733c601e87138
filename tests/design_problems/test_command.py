"""``kempe optimize``: the table, the files, the figure, and a search that is stopped."""

import csv
import json
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
from design_problems.conftest import SECTION, TEXT, written
from kempe.cli.app import run

HERE = Path("out/lamp/optimize")


def test_the_best_values_of_a_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    best = kp.optimize(kp.load(written(folder)))
    assert run(["optimize", "lamp.toml"]) == 0
    told = capsys.readouterr().out
    assert f"over.effort.rms = {best.objective:.6g} N·m" in told
    assert f"{best.values['k']:.6g}" in told and "h <= 0.25" in told
    with (HERE / "history.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == best.runs
    held = [float(row["objective"]) for row in rows if row["violation"] == "0"]
    assert min(held) == pytest.approx(best.objective, rel=1e-9)
    figures = sorted(path.name for path in (HERE / "figures").iterdir())
    assert figures == ["00_optimization.png", "00_optimization.svg"]


def test_the_new_file_keeps_comments_units_and_formulas(folder: Path) -> None:
    written(folder)
    assert run(["optimize", "lamp.toml", "--set", "mass=1.5"]) == 0
    old, new = (TEXT + SECTION).splitlines(), (HERE / "optimized.toml").read_text("utf-8")
    changed = [(a, b) for a, b in zip(old, new.splitlines(), strict=True) if a != b]
    assert [a.split()[0] for a, _ in changed] == ["k", "h", "mass"]
    assert changed[0][1].endswith(' kN/m"                                  # to be chosen')
    assert changed[1][1].endswith(' mm"                                    # of its anchor')
    case = kp.load(HERE / "optimized.toml")
    assert case.model.parameters["weight"] == pytest.approx(9.81 * 1.5)
    best = kp.optimize(kp.load("lamp.toml", parameters={"mass": 1.5}))
    assert case.model.parameters["k"] == pytest.approx(best.values["k"], rel=1e-12)
    again = kp.sweep(case, {"g": [9.81]}, ["over.effort.rms"])
    assert again["over.effort.rms"][0] == pytest.approx(best.objective, rel=1e-9)


def test_a_value_at_the_start_is_written_too(folder: Path) -> None:
    section = SECTION.replace("h = [0.05, 0.3]", '"arm.angle" = [-1.2, -0.9]')
    path = written(folder, section)
    path.write_text(path.read_text("utf-8").replace('range = ["-60*deg",', 'range = ["arm.angle",')
                    .replace('over = "arm.angle"\n', "").replace("static = true\n", "")
                    .replace("inverse_dynamics", "equilibrium").replace("n = 41\n", "")
                    .replace('range = ["arm.angle", "60*deg"]\n', 'hold = ["arm.angle"]\n')
                    .replace("over.effort.rms", "effort.arm.angle")
                    .replace("spring.force.peak", "spring.force"),
                    "utf-8")  # fmt: skip
    assert run(["optimize", "lamp.toml"]) == 0
    text = (HERE / "optimized.toml").read_text("utf-8")
    assert '*deg" }               # low' in text and "-60*deg" not in text
    assert kp.load(HERE / "optimized.toml").start()["arm.angle"] == pytest.approx(
        kp.optimize(kp.load("lamp.toml")).values["arm.angle"]
    )


def test_bounds_in_the_figure_have_all_their_digits(folder: Path) -> None:
    """Stiffnesses from 10000 to 200000 N/m, a wide range of masses, and a place below."""
    names = {"k": (1e4, 2e5), "mass": (-5e-6, 1.5), "h": (-0.3, 0.25)}
    case = kp.load(written(folder, ""))
    best = kp.optimize(case, names, minimize="k", starts=1)
    panels = [axes for axes in kp.plot.optimization(best).axes if axes.get_xlim() == (-0.04, 1.04)]
    texts = [label.get_text() for label in panels[0].get_yticklabels()]
    assert texts == ["k\n10000 … 200000 N/m", "mass\n−5·10⁻⁶ … 1.5 kg", "h\n−0.3 … 0.25 m"]


def test_json(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    best = kp.optimize(kp.load(written(folder)), starts=1)
    assert run(["optimize", "lamp.toml", "--starts", "1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["values"] == dict(best.values) and found["active"] == dict(best.active)
    assert found["runs"] == best.runs and found["success"]


def counted(path: Path) -> int:
    if not path.exists():
        return 0
    with closing(sqlite3.connect(path)) as data:
        try:
            return int(data.execute("SELECT count(*) FROM row").fetchone()[0])
        except sqlite3.OperationalError:  # not yet made
            return 0


#: A search that takes seconds.
WIDE = SECTION.replace("starts = 2", "starts = 8")


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> kp.Optimum:
    """The same search without an interruption."""
    return kp.optimize(kp.load(written(tmp_path_factory.mktemp("whole"), WIDE)))


@pytest.mark.alone
@pytest.mark.parametrize("sign", [signal.SIGINT, signal.SIGKILL])
def test_a_stopped_search_continues(sign: int, folder: Path, undisturbed: kp.Optimum) -> None:
    written(folder, WIDE)
    words = [sys.executable, "-m", "kempe", "optimize", "lamp.toml"]
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True) as child:
        while child.poll() is None and counted(HERE / "optimize.db") < 15:
            time.sleep(0.01)
        child.send_signal(sign)
        _, told = child.communicate()
    kept = counted(HERE / "optimize.db")
    assert kept >= 15 and child.returncode != 0
    if sign == signal.SIGINT:
        assert "the same command continues" in told
        assert kp.load(HERE / "optimized.toml").model.parameters["k"] != 300
    whole = undisturbed
    assert kept < whole.runs, "the search was not stopped halfway"
    seen: list[int] = []
    found = kp.optimize(
        kp.load("lamp.toml"), out=HERE / "optimize.db", progress=lambda *told: seen.append(told[0])
    )
    assert found.values == whole.values
    np.testing.assert_array_equal(found._table, whole._table)


def test_runs_are_not_repeated(case: kp.Case, folder: Path) -> None:
    """Damage a stored run: the search reads it, and does not compute it again."""
    ask = {"minimize": "over.effort.rms", "out": folder / "a.db"}
    first = kp.optimize(case, {"k": (50, 2000)}, **ask)
    before = (folder / "a.db").stat().st_mtime_ns
    again = kp.optimize(case, {"k": (50, 2000)}, **ask)
    assert again.values == first.values and counted(folder / "a.db") <= first.runs
    assert (folder / "a.db").stat().st_mtime_ns == before
    with pytest.raises(kp.FileError, match="another"):
        kp.optimize(case, {"k": (60, 2000)}, **ask)


def test_another_problem_names_anew(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["optimize", "lamp.toml"]) == 0
    written(folder, SECTION.replace("2000", "1900"))
    assert run(["optimize", "lamp.toml"]) != 0
    assert "--anew" in capsys.readouterr().err
    assert run(["optimize", "lamp.toml", "--anew"]) == 0
