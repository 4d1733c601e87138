"""Mobility: freedoms, redundancies, singular positions, bodies and loops."""

import json
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.cli import app


def parallelogram(cranks: int = 2) -> kp.Model:
    """Equal cranks on a rod of 1 m for each crank after the first."""
    m = kp.Model("parallelogram", redundancy="allow")
    m.ground.points(**{f"G{k}": (k, 0) for k in range(cranks)})
    m.body("rod", mass=1, inertia=1, points={f"P{k}": (k, 0) for k in range(cranks)})
    for k in range(cranks):
        m.bar(f"crank{k}", mass=1, length=0.6, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.G{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.P{k}")
    return m


def upright(m: kp.Model, angle: float = 1.2) -> kp.State:
    cranks = {name: angle for name in m.compile().column_names() if name.startswith("crank")}
    guess = {name: value for name, value in cranks.items() if name.endswith(".angle")}
    return kp.assemble(m, set={"crank0.angle": angle}, guess=guess | {"rod.angle": 0})


@pytest.mark.parametrize("cranks", [3, 4, 5])
def test_each_crank_too_many_is_a_redundancy(cranks: int) -> None:
    m = parallelogram(cranks)
    found = kp.mobility(m, upright(m))
    assert found.gruebler == 3 - cranks
    assert found.degrees_of_freedom == 1
    assert len(found.redundant) == cranks - 2
    assert not found.singular
    named = {joint for one in found.redundant for joint in one.joints}
    assert named == set(m.compile().joints)
    assert all(one.consistent and one.remove in one.equations for one in found.redundant)
    told = str(found)
    assert "one equation too many among" in told
    assert f"rank {3 * (cranks + 1) - 1}" in told


def test_each_equation_of_a_redundancy_may_be_removed_alone() -> None:
    m = parallelogram(3)
    start = upright(m)
    (one,) = kp.mobility(m, start).redundant
    matrix = start.matrices().Phi_q
    names = list(m.compile().row_names())
    whole = np.linalg.matrix_rank(matrix)
    assert set(one.equations) <= set(names)
    for name in names:
        rank = np.linalg.matrix_rank(np.delete(matrix, names.index(name), axis=0))
        assert rank == whole - (name not in one.equations), name


def test_all_that_are_proposed_may_be_removed_together() -> None:
    m = parallelogram(5)
    start = upright(m)
    found = kp.mobility(m, start)
    names = list(m.compile().row_names())
    rows = [names.index(one.remove) for one in found.redundant]
    assert len(set(rows)) == 3
    left = np.delete(start.matrices().Phi_q, rows, axis=0)
    assert np.linalg.matrix_rank(left) == len(left) == found.rank


@pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
def test_a_change_point_and_its_redundancy() -> None:
    m = parallelogram(3)
    flat = {f"crank{k}.angle": 0.0 for k in range(3)}
    start = kp.assemble(m, set={"crank0.angle": 0}, guess=flat | {"rod.angle": 0})
    found = kp.mobility(m, start)
    assert found.singular[0].kind == "change point"
    assert "change point: motions cross here" in str(found)
    assert all(loop.kind == "change point" and loop.turning is None for loop in found.four_bars)


def test_a_dead_point_at_a_limit() -> None:
    m = kp.load(ROOT / "examples/four_bar.toml").model
    start = kp.assemble(m, set={"crank.angle": 1}, guess={"coupler.angle": 0.3, "rocker.angle": 4})
    limit = kp.limits(m, start, over="rocker.angle").at_upper()
    assert limit is not None
    found = kp.mobility(limit.compiled, limit)
    assert [one.kind for one in found.singular] == ["dead point"]
    assert "over" in found.singular[0].joints
    (loop,) = found.four_bars
    assert loop.kind == "crank-rocker"
    assert loop.turning == ("crank",)
    assert loop.lengths == pytest.approx((20, 10, 26, 18))


def test_bodies_that_are_locked_or_loose() -> None:
    m = kp.Model("truss")
    m.ground.points(A=(0, 0), B=(2, 0))
    m.bar("left", mass=1, length=1.5, ends=("A", "C"))
    m.bar("right", mass=1, length=1.5, ends=("B", "C"))
    m.revolute("A", "ground.A", "left.A")
    m.revolute("B", "ground.B", "right.B")
    m.revolute("C", "left.C", "right.C")
    m.body("bird", mass=1, inertia=1, points={"P": (0, 0)})
    found = kp.mobility(m, kp.assemble(m))
    assert found.locked == ("left", "right")
    assert found.loose == ("bird",)
    assert found.degrees_of_freedom == 3
    assert "cannot move: left, right" in str(found)
    assert "not connected with ground: bird" in str(found)


def test_a_beam_is_one_body_where_bodies_are_locked_or_loose() -> None:
    m = kp.Model("beams")
    m.ground.points(O=(0, 0))
    blade: dict[str, Any] = {"length": 1, "EA": 1e3, "EI": 1, "GA": 1e3, "mass_per_length": 0.2}
    m.beam("held", ends=("A", "B"), **blade)
    m.beam("free", ends=("A", "B"), **blade)
    m.weld("clamp", "ground.O", "held.A")
    m.body("tip", mass=1, inertia=1, points={"B": (0, 0)})
    m.weld("end", "held.B", "tip.B")
    found = kp.mobility(m, kp.assemble(m))
    assert found.locked == ()
    assert found.loose == ("free",)
    shown = m.compile().shown_bodies
    assert [info.mass for info in shown.values()] == pytest.approx([0.2, 0.2, 1])
    assert [info.has_inertia for info in shown.values()] == [False, False, True]


def test_on_the_command_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    file = str(ROOT / "examples/six_bar.toml")
    assert app.run(["check", file]) == 0
    told = capsys.readouterr().out
    assert "0 degrees of freedom, 1 without its driver" in told
    assert "four-bar A-B-C-D: crank-rocker, crank turns fully" in told
    assert app.run(["check", file, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["mobility"]["rank"] == 15
    assert app.run(["mobility", file]) == 0
    assert "four-bar A-B-C-D: crank-rocker" in capsys.readouterr().out
    summary = json.loads((tmp_path / "out/six_bar/summary.json").read_text("utf-8"))
    assert summary["gruebler"] == 0
    case = kp.Case(parallelogram(3), {"set": {"crank0.angle": 1}}, [kp.Mobility()])
    assert case.run()["mobility"].rank == 11
    with pytest.raises(kp.ModelError, match="not a State"):
        kp.mobility(case.model, 1)  # type: ignore[arg-type]
