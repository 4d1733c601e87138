"""JSON that kempe writes is JSON: numbers that are not finite are null, in every writer."""

import json
import re
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.base import files
from kempe.cli import results
from kempe.cli.failure import print_json
from kempe.cli.figures import Drawing, Which

VALUES = {"a": float("inf"), "b": [1.0, float("-inf"), {"c": float("nan")}], "d": (2, "x", None)}
PLAIN = {"a": None, "b": [1.0, None, {"c": None}], "d": [2, "x", None]}


def strict(text: str) -> Any:
    """The content; the words that only Python reads are refused, as by the standard."""

    def refuse(word: str) -> None:
        raise ValueError(word)

    return json.loads(text, parse_constant=refuse)


def test_numbers_that_are_not_finite_are_null(capsys: pytest.CaptureFixture[str]) -> None:
    assert strict(files.json_text(VALUES)) == PLAIN
    assert strict(files.json_text({"x": np.float64("inf")})) == {"x": None}
    print_json(VALUES)
    assert strict(capsys.readouterr().out) == PLAIN


def test_summaries_of_runs_are_json(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = kp.load(ROOT / "examples" / "pendulum.toml")
    solution = case.run()[0]
    assert isinstance(solution, kp.Solution)
    summary = {**solution.summary, "measures": [{"max": float("inf"), "rms": float("nan")}]}
    results.write_results(solution, summary, tmp_path, Drawing(Which.none))
    found = strict((tmp_path / "summary.json").read_text("utf-8"))
    assert found["measures"] == [{"max": None, "rms": None}]
    state = kp.equilibrium(case.model, case.start())
    monkeypatch.setattr(type(state), "summary", lambda _: {"stiffness": float("inf")})
    results.write_result(state, tmp_path / "rest", Drawing(Which.none))
    assert strict((tmp_path / "rest" / "summary.json").read_text("utf-8"))["stiffness"] is None


def test_there_is_one_writer_of_json_files() -> None:
    """``json.dumps`` writes ``Infinity`` without ``allow_nan=False``."""
    calls = [
        (path.name, call)
        for path in (ROOT / "python" / "kempe").rglob("*.py")
        for call in re.findall(r"json\.dumps?\([^\n]*", path.read_text("utf-8"))
        if "indent" in call or "dump(" in call
    ]
    assert [name for name, _ in calls] == ["files.py"]
