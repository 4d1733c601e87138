"""A study: variants are compared with the most accurate run, and what it says is in its data."""

import csv
import json
import re
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.cli import main
from kempe.draw.painter import Painting
from kempe.draw.placing import place
from kempe.plot import study_figures
from kempe.plot.study_gaps import joint_gaps, magnification
from kempe.sweeps.studies import Outcome, Variant
from kempe.sweeps.studies.findings import growth
from kempe.sweeps.studies.run import _diverged
from matplotlib.axes import Axes

ROOT = Path(__file__).parents[2]
FLAGSHIP = ROOT / "examples" / "four_bar.toml"
REFERENCE = json.loads((ROOT / "tests/reference/four_bar.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def found() -> kp.Study:
    begin = time.perf_counter()
    made = kp.study(kp.load(FLAGSHIP))
    assert time.perf_counter() - begin < 30.0
    return made


def one(found: kp.Study, group: str, alpha: float, beta: float, number: float) -> Outcome:
    wanted = (alpha, beta, number, False)
    return next(
        o
        for o in found.group(group)
        if (o.variant.alpha, o.variant.beta, o.variant.number, o.variant.projected) == wanted
    )


def test_the_most_accurate_run_is_the_independent_solution(found: kp.Study) -> None:
    best = found.reference.solution
    assert best is not None
    for state in REFERENCE["states"]:
        k = int(np.abs(best.t - state["t"]).argmin())
        if abs(best.t[k] - state["t"]) < 1e-12:
            np.testing.assert_allclose(best.q[k], state["q"], atol=1e-8)


def test_the_classical_residuals_are_those_that_were_published(found: kp.Study) -> None:
    """Residual peaks and steps at rtol 1e-3, atol 1e-6: 1.5 mm, 8 mm, and a drift of metres."""
    strong = one(found, "stabilization", 10, 200, 1e-3)
    assert strong.residual == pytest.approx(1.5e-3, rel=0.15)
    assert strong.residual_at == pytest.approx(0.22, abs=0.05)
    assert strong.steps == pytest.approx(1333, rel=0.02)
    weak = one(found, "stabilization", 1, 20, 1e-3)
    assert weak.residual == pytest.approx(8e-3, rel=0.15)
    assert weak.steps == pytest.approx(234, rel=0.02)
    assert one(found, "stabilization", 0, 0, 1e-3).residual > 1.0


def test_projection_closes_the_joints_in_fewer_steps_and_evaluations(found: kp.Study) -> None:
    for tolerance in (1e-3, 1e-6):
        projected = next(
            o
            for o in found.group("stabilization")
            if o.variant.projected and o.variant.number == tolerance
        )
        strong = one(found, "stabilization", 10, 200, tolerance)
        assert projected.residual < 1e-10
        assert projected.evaluations < 0.5 * strong.evaluations
    schemes = {o.variant.scheme for o in found.group("tolerance") if o.variant.projected}
    assert schemes == {"RK45", "DOP853"}


def test_weak_gains_beat_strong_ones_with_constant_steps(found: kp.Study) -> None:
    for h in (1e-3, 2e-3, 5e-3, 1e-2):
        weak, strong = one(found, "step", 1, 20, h), one(found, "step", 10, 200, h)
        assert weak.position_error < strong.position_error
    told = [f for f in found.findings() if "beats" in f]
    assert len(told) == 4


def test_divergence_is_a_row_and_not_a_crash(found: kp.Study) -> None:
    lost = one(found, "step", 10, 200, 2e-2)
    assert lost.diverged
    assert lost.diverged_at is not None
    assert 0.0 < lost.diverged_at < 1.0
    assert np.isnan(lost.position_error)
    assert "diverged at t = 0.06 s: the joints come apart" in found.table()
    assert any("h = 0.02 s with α = 10, β = 200 diverges" in f for f in found.findings())
    assert not one(found, "step", 1, 20, 2e-2).diverged


def test_the_growth_of_a_step_decides_on_divergence(found: kp.Study) -> None:
    assert growth(0.0, 1.0, 2.0 * np.sqrt(2.0)) == pytest.approx(1.0)  # the imaginary axis
    assert growth(1.0, 1.0, 2.785293563) == pytest.approx(1.0)  # the real axis
    for o in found.group("step"):
        if o.variant.beta > 0.0:
            unstable = growth(o.variant.alpha, o.variant.beta, o.variant.number) > 1.0
            assert unstable == o.diverged, o.variant.name


def test_errors_are_the_largest_differences_on_the_output_times(found: kp.Study) -> None:
    best, some = found.reference, one(found, "step", 1, 20, 1e-2)
    assert best.solution is not None
    assert some.solution is not None
    np.testing.assert_array_equal(best.solution.t, some.solution.t)
    angle = max(
        np.abs(some.solution[b].angle - best.solution[b].angle).max()
        for b in some.solution.model.bodies
    )
    position = max(
        np.linalg.norm(some.solution[b].r - best.solution[b].r, axis=1).max()
        for b in some.solution.model.bodies
    )
    assert (some.angle_error, some.position_error) == pytest.approx((angle, position))
    assert found.reference.position_error == 0.0


def test_the_order_that_is_told_is_four(found: kp.Study) -> None:
    orders = [re.search(r"converges with order ([\d.]+)", told) for told in found.findings()]
    values = [float(match[1]) for match in orders if match]
    assert values == pytest.approx([4.0, 4.0], abs=0.2)


def test_tables_and_figures_are_written(found: kp.Study, tmp_path: Path) -> None:
    written = [*found.save(tmp_path), *study_figures.write(found, tmp_path / "figures")]
    assert [path.name for path in written] == [
        "study.md",
        "study.csv",
        "study.json",
        *(f"{name}.png" for name in ("residual", "error", "steps", "work_precision", "gaps")),
    ]
    assert all(path.stat().st_size > 0 for path in written)
    rows = list(csv.DictReader(written[1].read_text(encoding="utf-8").splitlines()))
    told = json.loads(written[2].read_text(encoding="utf-8"))
    assert len(rows) == len(told["variants"]) == len(found.outcomes)
    assert told["findings"] == found.findings()
    for row, outcome in zip(rows, found.outcomes, strict=True):
        assert (row["position_error"] == "") == outcome.diverged
        assert int(row["steps"]) == outcome.steps
    text = written[0].read_text(encoding="utf-8")
    tables = [line for line in text.splitlines() if line.startswith("|")]
    assert {line.count("|") for line in tables} == {9}


def test_gaps_are_those_of_the_residual_and_magnified_by_a_round_factor(found: kp.Study) -> None:
    weak = one(found, "stabilization", 1, 20, 1e-3).solution
    assert weak is not None
    k = int(weak.drift.position.argmax())
    state = kp.State(weak.model, float(weak.t[k]), weak.q[k], weak.v[k])
    begin, along = joint_gaps(state)
    np.testing.assert_allclose(along.ravel(), state.residuals[0], atol=1e-12)
    assert begin.shape == (4, 2)
    assert magnification(0.0085, 25.0) == 500.0
    assert magnification(0.0, 25.0) == 1.0


def drawn(found: kp.Study, name: str) -> Axes:
    from kempe.plot import style

    with style.applied():
        height = study_figures.HEIGHTS.get(name, style.HEIGHT)
        axes = style.figure(height).add_subplot()
        study_figures.FIGURES[name](found, axes)
    return axes


@pytest.mark.parametrize("name", ["residual", "error", "work_precision"])
def test_curves_differ_in_colour_dashes_and_marker(found: kp.Study, name: str) -> None:
    axes = drawn(found, name)
    assert len(axes.lines) >= 8
    for get in ("get_color", "get_marker", "_unscaled_dash_pattern"):
        looks = [getattr(line, get) for line in axes.lines]
        values = [str(look() if callable(look) else look) for look in looks]
        assert len(set(values)) == len(values), get
    texts = [text.get_text() for text in axes.get_legend().get_texts()]
    assert len(set(texts)) == len(texts) == len(axes.lines)
    assert axes.get_title("left")


def test_work_is_counted_in_evaluations(found: kp.Study) -> None:
    axes = drawn(found, "work_precision")
    assert axes.get_xlabel() == "largest position error / m"
    assert axes.get_ylabel() == "evaluations of the accelerations / 1"
    line = next(line for line in axes.lines if line.get_label() == "RK4, α = 1, β = 20")
    group = [one(found, "step", 1, 20, h) for h in (1e-3, 2e-3, 5e-3, 1e-2, 2e-2)]
    expected = sorted((o.position_error, o.evaluations) for o in group)
    assert [tuple(point) for point in line.get_xydata()] == expected
    assert expected[0][1] == pytest.approx(4 * 15.0 / 1e-3, rel=0.01)  # four for each step


def test_residuals_are_drawn_as_the_largest_of_each_span(found: kp.Study) -> None:
    axes = drawn(found, "residual")
    line = next(line for line in axes.lines if line.get_label() == "α = 1, β = 20")
    solution = one(found, "stabilization", 1, 20, 1e-6).solution
    assert solution is not None
    assert line.get_ydata().max() == solution.drift.position.max()
    assert axes.get_xlim() == (0.0, 15.0)
    assert axes.get_xlabel() == "time t / s"
    assert axes.get_ylabel() == "max |Φ| / (m, rad)"


def test_arrows_of_gaps_can_be_seen(found: kp.Study) -> None:
    axes = drawn(found, "gaps")
    painting = next(a for a in axes.get_children() if isinstance(a, Painting))
    factor = float(axes.get_title("left").split("magnified ")[1].split()[0])
    weak = one(found, "stabilization", 1, 20, 1e-3).solution
    assert weak is not None
    k = int(weak.drift.position.argmax())
    worst = kp.State(weak.model, float(weak.t[k]), weak.q[k], weak.v[k])
    _, along = joint_gaps(worst)
    shafts = [i for i in painting.items if (i["kind"], i["colour"]) == ("line", "reaction")]
    assert [item["of"] for item in shafts] == ["A", "B", "C", "D"]
    for item, gap in zip(shafts, along, strict=True):
        assert item["points"][1][0] == pytest.approx(factor * float(np.hypot(*gap)))
        assert item["width"] >= 2.0
        ends = place(item, painting.poses, painting.view())
        assert np.hypot(*(ends[1] - ends[0])) > 10.0  # points of print
    fills = [i for i in painting.items if i["kind"] == "fill" and i["of"] in "ABCD"]
    for name, begin, gap in zip("ABCD", *joint_gaps(worst), strict=True):
        tip = painting.view().points(begin + factor * gap)
        along = gap / np.hypot(*gap)
        shaft = next(item for item in shafts if item["of"] == name)
        ends = place(shaft, painting.poses, painting.view())
        np.testing.assert_allclose(ends[0], painting.view().points(begin), atol=1e-6)
        np.testing.assert_allclose(ends[1], tip - 6.0 * along, atol=1e-6)
        for colour, ahead, size in (("reaction", 0.0, 10.0), ("paper", 1.5, 14.0)):
            (head,) = (
                i
                for i in fills
                if (i["of"], i["colour"]) == (name, colour) and i["points"][0][0] > 0.0
            )
            corners = place(head, painting.poses, painting.view())
            np.testing.assert_allclose(corners[0], tip + ahead * along, atol=1e-6)
            back = corners[1:].mean(axis=0)
            np.testing.assert_allclose(back, tip + (ahead - size) * along, atol=1e-6)


def test_closed_joints_have_no_arrow() -> None:
    """The guide of a slider-crank stays closed to rounding; A and B open."""
    case = kp.load(ROOT / "examples" / "slider_crank.toml").with_analysis("coasting", t_end=0.3)
    ways = [
        Variant("reference", 0, 0, "DOP853", 1e-11, projected=True),
        Variant("stabilization", 1, 20, "RK45", 1e-3),
    ]
    painting = next(
        a
        for a in drawn(kp.study(case, ways=ways), "gaps").get_children()
        if isinstance(a, Painting)
    )
    names = {item["text"].partition(":")[0] for item, _ in painting.texts}
    assert names == {"A", "B"}


def test_curves_of_a_study_are_its_numbers(found: kp.Study) -> None:
    steps = drawn(found, "steps").lines[0]
    sweep = [o for o in found.group("beta") if not o.diverged]
    points = [(o.variant.beta, o.steps) for o in sweep]
    assert [tuple(point) for point in steps.get_xydata()] == points
    axes = drawn(found, "error")
    line = next(one for one in axes.lines if one.get_label() == "α = 1, β = 20")
    solution = one(found, "stabilization", 1, 20, 1e-6).solution
    best = found.reference.solution
    assert solution is not None
    assert best is not None
    apart = np.max(
        [np.hypot(*(solution[b].r - best[b].r).T) for b in solution.model.bodies], axis=0
    )
    assert line.get_ydata().max() == pytest.approx(apart.max(), rel=1e-12)
    gaps = drawn(found, "gaps")
    painting = next(a for a in gaps.get_children() if isinstance(a, Painting))
    weak = one(found, "stabilization", 1, 20, 1e-3).solution
    assert weak is not None
    k = int(weak.drift.position.argmax())
    _, along = joint_gaps(kp.State(weak.model, float(weak.t[k]), weak.q[k], weak.v[k]))
    texts = {item["text"] for item, _ in painting.texts}
    for name, gap in zip("ABCD", along, strict=True):
        assert f"{name}: {1e3 * float(np.hypot(*gap)):.3g} mm" in texts


def test_figures_have_the_display_units(found: kp.Study) -> None:
    with kp.units("mm", "ms"):
        work, error, gaps = (drawn(found, name) for name in ("work_precision", "error", "gaps"))
    usual = [drawn(found, name) for name in ("work_precision", "error")]
    assert work.get_xlabel() == "largest position error / mm"
    assert error.get_ylabel() == "position error / mm"
    assert error.get_xlabel() == "time t / ms"
    for one, k in ((work, 0), (error, 1)):
        for line, si in zip(one.lines, usual[k].lines, strict=True):
            clear = si.get_xydata()[:, k] > 1e-12  # the error is cut off below
            shown, expected = line.get_xydata()[clear], si.get_xydata()[clear] * 1.0
            expected[:, k] *= 1e3
            expected[:, 0] *= 1e3 if k else 1.0
            # An instant between two spans may fall into the other one.
            assert np.isclose(shown, expected, rtol=1e-12).mean() > 0.98
    assert re.search(r"t = [\d.e+]+ ms, gaps", gaps.get_title("left"))


def test_other_variants_and_a_case_without_output_step(four_bar_file: Path) -> None:
    text = four_bar_file.read_text(encoding="utf-8").replace("output_step = 0.01\n", "")
    four_bar_file.write_text(text, encoding="utf-8")
    ways = [
        Variant("reference", 10, 200, "RK45", 1e-9),
        Variant("step", 10, 200, "RK4", 1e-3),
        Variant("step", 10, 200, "RK4", 0.02),
    ]
    seen: list[str] = []
    small = kp.study(kp.load(four_bar_file), "release", ways=ways, progress=seen.append)
    assert seen == [way.name for way in ways]
    assert [o.diverged for o in small.outcomes] == [False, False, True]
    assert small.outcomes[1].position_error < 1e-5
    assert "## Constant steps" in str(small)
    assert drawn(small, "gaps").get_title() == "no variant to draw"
    reached = small.outcomes[2]
    assert reached.solution is not None
    cost = reached.solution.statistics
    assert reached.diverged_at == pytest.approx(reached.solution.t[-1], abs=0.02)
    assert (reached.steps, reached.evaluations) == (cost["steps"], cost["evaluations"])
    assert reached.seconds == cost["seconds"] > 0.0
    assert reached.steps == round(reached.solution.t[-1] / 0.02) > 0


def test_the_steps_of_an_analysis_are_no_outputs_of_a_study(four_bar_file: Path) -> None:
    """With output = "steps" the variants have 1500 common times, as without an output_step."""
    text = four_bar_file.read_text(encoding="utf-8")
    four_bar_file.write_text(text.replace("output_step = 0.01", 'output = "steps"'), "utf-8")
    case = kp.load(four_bar_file)
    ways = [Variant("reference", 10, 200, "RK45", tol) for tol in (1e-9, 1e-4)]
    for one in kp.study(case, "release", ways=ways).outcomes:
        assert one.solution is not None
        t = one.solution.t
        assert np.diff(t) == pytest.approx((t[-1] - t[0]) / 1500)


def test_an_error_without_a_time_has_that_of_its_last_state() -> None:
    way = Variant("step", 10, 200, "RK4", 1e-3)
    reached: Any = SimpleNamespace(
        t=np.array([0.0, 0.25]), statistics={"steps": 250, "evaluations": 1000, "seconds": 0.5}
    )
    for t, partial, expected in ((None, reached, 0.25), (0.3, reached, 0.3), (None, None, None)):
        found = _diverged(way, partial, t, "it broke")
        cost = (250, 1000, 0.5) if partial else (0, 0, 0.0)
        assert (found.steps, found.evaluations, found.seconds) == cost
        assert found.diverged_at == expected and found.reason == "it broke"


def test_what_cannot_be_studied_is_refused(four_bar_file: Path) -> None:
    case = kp.load(four_bar_file)
    with pytest.raises(kp.ModelError, match="did you mean 'release'"):
        kp.study(case, "relase")
    with pytest.raises(kp.ModelError, match="no analysis") as caught:
        kp.study(kp.Case(case.model))
    assert caught.value.hint == "add one, as [analyses.release]"
    with pytest.raises(kp.IntegrationError):
        kp.study(case, ways=[Variant("reference", 10, 200, "RK4", 0.02)])


def test_the_command_tells_and_writes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = kp.load(FLAGSHIP).with_analysis("release", t_end=0.5)
    case.save(tmp_path / "short.toml")
    assert main(["study", str(tmp_path / "short.toml"), "-o", str(tmp_path / "s")]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    for words in ("Sweep of β", "Findings", "diverged at t", "study.json"):
        assert words in out
    assert (tmp_path / "s" / "figures" / "gaps.png").exists()
    assert main(["study", str(tmp_path / "short.toml"), "--analysis", "x"]) == 2
    assert "Traceback" not in capsys.readouterr().err
