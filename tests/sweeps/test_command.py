"""``kempe sweep``: table, figures, progress, interruption and resumption."""

import csv
import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli.app import run
from sweeps.test_file import written


def rows() -> list[dict[str, str]]:
    with Path("out/case/sweep/sweep.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_sweep_of_a_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["sweep", "case.toml"]) == 0
    told = capsys.readouterr().out
    assert "4 variants over L2, k" in told and "pin.max" in told
    table = rows()
    assert list(table[0]) == ["L2", "k", "pin.max", "rocker.angle.final", "reason"]
    result = kp.sweep(kp.load("case.toml"))
    np.testing.assert_array_equal([float(row["pin.max"]) for row in table], result["pin.max"])
    figures = sorted(path.name for path in Path("out/case/sweep/figures").iterdir())
    assert "00_map_pin_max.png" in figures


def test_variables_of_the_command_line(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    words = ["--over", "k=1e5:1e7:3:log", "--over", "L2=26:47:2", "--measure", "C.force.max"]
    assert run(["sweep", "case.toml", *words, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["variants"], found["failed"]) == (6, 3)
    assert [float(row["k"]) for row in rows()][::2] == pytest.approx([1e5, 1e6, 1e7])
    assert "too long" in rows()[1]["reason"]


def test_it_resumes_and_begins_anew(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(folder)
    assert run(["sweep", "case.toml", "--over", "k=1e6:2e6:2", "--measure", "pin.max"]) == 0
    first = rows()
    assert run(["sweep", "case.toml", "--over", "k=1e6:2e6:2", "--measure", "pin.max"]) == 0
    assert rows() == first
    assert run(["sweep", "case.toml", "--over", "k=1e6:3e6:2", "--measure", "pin.max"]) == 4
    told = capsys.readouterr().err
    assert "another sweep" in told and "--anew discards its results" in told
    words = ["--over", "k=1e6:3e6:2", "--measure", "pin.max", "--anew"]
    assert run(["sweep", "case.toml", *words]) == 0
    assert float(rows()[1]["k"]) == 3e6


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--over", "k=1"], "NAME=FROM:TO:N"),
        (["--over", "k=1:2:3:lg"], "neither 'linear' nor 'log'"),
        (["--over", "kk=1:2:3"], "unknown variable 'kk'"),
        (["--measure", "pin"], "write pin.max"),
        (["--scheduler", "tcp://127.0.0.1:1"], "no Dask scheduler|needs Dask"),
    ],
)
def test_faulty_words_are_refused(
    words: list[str],
    message: str,
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import re

    from kempe.sweeps import cluster

    monkeypatch.setattr(cluster, "_LONGEST_WAIT", 1)
    written(folder)
    assert run(["sweep", "case.toml", *words]) == 2
    assert re.search(message, capsys.readouterr().err)


def test_an_interruption_writes_what_is_finished(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from kempe.sweeps import local
    from kempe.sweeps.table import Table

    original = Table.add

    def add(self: Table, *given: object) -> None:
        original(self, *given)  # type: ignore[arg-type]
        raise KeyboardInterrupt

    written(folder)
    monkeypatch.setattr(Table, "add", add)
    monkeypatch.setattr(local, "_MOST", 1)
    with pytest.raises((KeyboardInterrupt, SystemExit)):
        run(["sweep", "case.toml", "--workers", "1"])
        raise SystemExit  # the command line may turn it into an exit code
    told = " ".join(capsys.readouterr().err.split())
    assert "interrupted: 1 of 4 variants" in told and "the same command continues" in told
    assert [bool(row["pin.max"]) for row in rows()] == [True, False, False, False]
    monkeypatch.setattr(Table, "add", original)
    assert run(["sweep", "case.toml"]) == 0
    assert all(row["pin.max"] for row in rows())
