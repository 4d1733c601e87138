"""Each number in a report is that of the solution; sections appear where they have content."""

import math
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from lab_report.conftest import Reported
from lab_report.pages import Page

EXAMPLES = ("slider_crank", "cam_roller", "boom", "barrier")


@pytest.fixture(params=EXAMPLES)
def one(request: pytest.FixtureRequest, reported: Callable[[str], Reported]) -> Reported:
    return reported(request.param)


def solution(of: Reported) -> kp.Solution:
    found = of.results[0]
    assert isinstance(found, kp.Solution)
    return found


def test_every_number_is_printed_as_it_is(one: Reported) -> None:
    for table in one.page.tables:
        heads = [cell.text for cell in table.head[-1]]
        for row in table.rows:
            for head, cell in zip(heads, row, strict=True):
                if cell.value is None or cell.text == "·":
                    continue
                value = math.degrees(cell.value) if head.endswith("°") else cell.value
                assert cell.printed == pytest.approx(value, rel=6e-3, abs=1e-300), table.caption


def test_the_initial_configuration_is_that_of_the_case(one: Reported) -> None:
    start = one.case.start()
    model = start.compiled
    for name, info in model.bodies.items():
        values = one.page.table("Coordinates q").values(name)
        expected = [*start.q[info.columns]]
        assert values[: info.count] == pytest.approx(expected, abs=1e-11)
    if model.n_q > sum(info.count for info in model.bodies.values()):
        (value,) = one.page.table("Further").values("contact.u")
        assert value == start["contact.u"]


def test_jacobian_and_multipliers_are_those_at_the_start(one: Reported) -> None:
    start = one.case.start()
    names = start.compiled.column_names()
    held = {name: value for name, value in one.case.held.items() if name in names}
    parts = [table for table in one.page.tables if table.caption.startswith("Jacobian")]
    found = np.hstack([[[cell.value for cell in row[1:]] for row in of.rows] for of in parts])
    assert np.allclose(found, start.matrices(held).Phi_q, rtol=0.0, atol=1e-14)
    assert [cell.name for of in parts for cell in of.head[1][1:]] == names
    multipliers = [row[1].value for row in one.page.table("Multipliers").rows]
    rows = start.lam[: len(multipliers)]  # a brake that sticks has one more
    assert multipliers == pytest.approx(rows, abs=1e-9 * np.abs(rows).max())


def test_the_peaks_are_those_of_the_motion(one: Reported) -> None:
    found = solution(one)
    table = one.page.table("Largest reactions")
    heads = [cell.text for cell in table.head[0]]
    k = heads.index("force / N")
    for row in table.rows:
        joint, on = row[0].text, row[1].text
        value, at = row[k].value, row[k + 1].value
        forces = np.hypot(*found[joint].force(on=on).T)
        assert value >= forces.max() * (1.0 - 1e-9)
        reached = np.hypot(*found(at)[joint].force(on=on))
        assert value == pytest.approx(reached, rel=1e-3, abs=1e-9)


def test_accuracy_and_energy_are_those_of_the_motion(one: Reported) -> None:
    found = solution(one)
    residual = one.page.table("Accuracy").rows[0][1].value
    assert residual >= found.drift.position.max()
    energy = one.page.table("Energy")
    assert energy.values("dissipated until the end") == [found.energy.dissipated[-1]]
    assert energy.rows[0][1].value >= found.energy.kinetic.max() * (1.0 - 1e-12)
    (balance,) = energy.values("largest error of the balance, relative to the scale")
    assert balance == np.abs(found.energy.balance).max()


def test_identifiers_are_unique_and_nothing_is_loaded(one: Reported) -> None:
    found = one.page.identifiers
    assert len(found) == len(set(found)) > 100
    for loading in ('src="', "<script", "@import", "<link", 'href="http'):
        assert loading not in one.text


@pytest.mark.parametrize(
    ("name", "there", "absent"),
    [
        ("slider_crank", {"Reactions"}, {"Events", "Measures", "Settling", "Forces"}),
        ("cam_roller", {"Forces"}, {"Events", "Measures", "Settling"}),
        ("boom", {"Reactions"}, {"Events", "Forces"}),
        ("barrier", {"Events", "Forces"}, {"Measures", "Settling"}),
    ],
)
def test_sections_without_content_are_left_out(
    name: str, there: set[str], absent: set[str], reported: Callable[[str], Reported]
) -> None:
    headings = set(reported(name).page.headings)
    assert there <= headings
    assert not absent & headings
    assert not headings & {"Study of stabilization, method and tolerance"}


def test_the_events_of_the_barrier_are_listed(reported: Callable[[str], Reported]) -> None:
    barrier = reported("barrier")
    rows = barrier.page.table("Events").rows
    events = solution(barrier).events
    expected = [(name, t) for name, event in events.items() for t in event.t]
    assert [(row[0].text, row[2].value) for row in rows] == expected
    assert {"brake.slip", "brake.stick", "buffer.hit", "buffer.release"} <= {
        name for name, _ in expected
    }


def test_formulas_with_branches_are_replaced_by_a_note(
    reported: Callable[[str], Reported],
) -> None:
    boom = reported("boom")
    assert any("cylinder" in told and "omitted" in told for told in boom.page.paragraphs)
    law = boom.page.table("Fields of joints").row("cylinder")
    assert law[3].text == "step5(t, 0, 2.76, 12, 3.86)"


def crank_rocker() -> kp.Case:
    """A driven four-bar linkage with a measure and an analysis of most types."""
    m = kp.Model("crank <rocker> & more", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(4, 0))
    m.bar("crank", mass=1, length=1, ends=("A", "B"))
    m.bar("coupler", mass=2, length=4, ends=("B", "C"))
    m.bar("rocker", mass=2, length=3, ends=("C", "D"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.coordinate_driver("motor", "crank.angle", value="0.5 + 2*t")
    m.measures(pin="C.force")
    analyses = {
        "turn": {"type": "kinematics", "t_end": 3, "output_step": 0.05},
        "efforts": {"type": "inverse_dynamics", "t_end": 3, "output_step": 0.05, "from": "start"},
        "freedom": {"type": "mobility", "from": "start"},
        "reach": {"type": "limits", "over": "crank.angle", "from": "start"},
        "ways": {"type": "configurations", "from": "start"},
        "rest": {"type": "equilibrium", "from": "start"},
    }
    return kp.Case(m, None, analyses)


@pytest.fixture(scope="module")
def driven(tmp_path_factory: pytest.TempPathFactory) -> tuple[kp.Case, str]:
    path = tmp_path_factory.mktemp("driven") / "report.html"
    case = crank_rocker()
    assert kp.write_report(case, path) == path
    return case, path.read_text("utf-8")


def test_every_type_of_analysis_has_a_section(driven: tuple[kp.Case, str]) -> None:
    case, text = driven
    page = Page(text)
    for name in case.analyses:
        assert {f"Analysis {name}", f"Results of {name}"} <= set(page.headings), name
    for number in ("3.6.10", "6.6.8", "6.3.18 at rest"):
        assert f"({number})" in text
    assert "7.3.8" not in text
    assert "crank &lt;rocker&gt; &amp; more" in text
    assert "<rocker>" not in text


def test_a_measure_has_its_statistics(driven: tuple[kp.Case, str]) -> None:
    case, text = driven
    measures = [table for table in Page(text).tables if table.caption == "Measures"]
    found = case.run()["efforts"].measure("pin")
    expected = [found.max, found.min, found.mean, found.rms, found.final]
    values = measures[-1].values("pin", "C.force", "N")
    assert values[:5] == pytest.approx(expected, rel=1e-9)


def test_a_solution_has_the_report_of_its_case(
    reported: Callable[[str], Reported], tmp_path: Path
) -> None:
    barrier = reported("barrier")
    stored = tmp_path / "solution.npz"
    solution(barrier).save(stored)
    text = kp.write_report(kp.load_solution(stored), tmp_path / "report.html").read_text("utf-8")
    page = Page(text)
    assert page.headings == barrier.page.headings
    for one, other in zip(page.tables, barrier.page.tables, strict=True):
        assert one.caption == other.caption
        for cell, same in zip(one.numbers(), other.numbers(), strict=True):
            assert cell.value == pytest.approx(same.value, rel=1e-9, abs=1e-12)


def test_a_motion_without_a_case_has_a_report(tmp_path: Path) -> None:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    m.torque("brake", "rod", torque=lambda _, state: -0.1 * state["rod.omega"])
    start = kp.assemble(m, set={"rod.angle": "-30 deg"})
    found = kp.dynamics(m, start, t_end=1, output_step=0.02)
    page = Page(kp.write_report(found, tmp_path / "report.html").read_text("utf-8"))
    assert page.table("Coordinates q").values("rod")[2] == pytest.approx(math.radians(-30))
    assert "Python" in page.listing


def test_display_units_are_used(tmp_path: Path, reported: Callable[[str], Reported]) -> None:
    case = reported("slider_crank").case
    with kp.units("mm,deg,kN"):
        text = kp.write_report(case, tmp_path / "report.html").read_text("utf-8")
    table = Page(text).table("Coordinates q")
    assert [cell.text for cell in table.head[0][1:4]] == ["x / mm", "y / mm", "φ / °"]
    x = table.row("slider")[1]
    assert x.printed == pytest.approx(1e3 * x.value, rel=1e-5)
    assert x.value == pytest.approx(case.start()["slider.x"])
    force = Page(text).table("Largest reactions").row("O", "crank")[2]
    assert force.printed == pytest.approx(1e-3 * force.value, rel=1e-5)
