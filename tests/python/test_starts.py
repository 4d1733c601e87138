"""A run starts where its caller says, or not at all."""

import json
import warnings
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli.app import run as cli

SLIDER_CRANK = Path("examples/slider_crank.toml")
STABILIZATIONS = [
    None,
    kp.Baumgarte(alpha=10, beta=200),
    kp.Baumgarte(gains="step"),
    kp.Projection(),
]
ROOT = Path(__file__).parents[2]


@pytest.fixture
def case(four_bar_file: Path) -> kp.Case:
    return kp.load(four_bar_file)


@pytest.mark.parametrize("stabilization", STABILIZATIONS, ids=str)
def test_a_start_of_other_lengths_is_refused_with_gap_joint_and_remedy(
    model: kp.Model, start: kp.State, stabilization: kp.analyses.option.Option | None
) -> None:
    # the coupler grows by 1 m about its centre, so that it leaves B and C by 0.5 m
    longer = model.with_parameters({"L2": 27})
    options = {"method": kp.RK45(), "stabilization": stabilization, "t_end": 0.1}
    with pytest.raises(kp.AssemblyError) as caught:
        kp.dynamics(longer, start, **options)
    error = caught.value
    assert error.name in {"B", "C"}
    assert f"joint {error.name} is open by 5.000e-1 m" in str(error)
    assert error.t == 0.0
    # the remedy of the hint
    assert error.hint is not None
    assert "kp.assemble(model, from_state=state)" in error.hint
    closed = kp.assemble(longer, from_state=start)
    solution = kp.dynamics(longer, closed, **options)
    assert np.array_equal(solution.q[0], closed.q)


def test_a_case_with_other_parameters_starts_where_the_file_says(case: kp.Case) -> None:
    for length in (25, 26, 27):
        varied = case.with_parameters({"L2": length})
        begin = varied.start()
        assert begin["crank"].angle == pytest.approx(np.deg2rad(70), abs=1e-12)
        assert np.abs(begin.residuals[0]).max() < 1e-10
        run = varied.run()["release"]
        assert run["crank"].angle[0] == pytest.approx(np.deg2rad(70), abs=1e-12)
        # C is where two circles meet: about B with the coupler, about D with the rocker
        bx, by = 10 * np.cos(np.deg2rad(70)), 10 * np.sin(np.deg2rad(70))
        cx, cy = begin["rocker"].point("C").position
        assert np.hypot(cx - bx, cy - by) == pytest.approx(length, rel=1e-12)
        assert np.hypot(cx - 20, cy) == pytest.approx(18, rel=1e-12)
    assert case.start().model.parameters["L2"] == 26, "the case itself is not changed"


def test_the_command_line_starts_where_the_file_says(
    four_bar_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [
        "run",
        str(four_bar_file),
        "--set",
        "L2=27",
        "--no-figures",
        "-o",
        str(tmp_path / "out"),
    ]
    assert cli(words) == 0
    assert "70" in capsys.readouterr().out
    solution = kp.load_solution(tmp_path / "out" / "solution.npz")
    assert solution["crank"].angle[0] == pytest.approx(np.deg2rad(70), abs=1e-12)


def test_assembly_from_a_state_moves_as_little_as_it_can(model: kp.Model, start: kp.State) -> None:
    longer = model.with_parameters({"L2": 26.01})
    near = kp.assemble(longer, from_state=start)
    scale = np.array([20.0, 20.0, 1.0] * 3)
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    angles = np.linspace(1.21, 1.23, 401)
    family = [kp.assemble(longer, {"crank.angle": float(angle)}, guess).q for angle in angles]
    nearest = min(float(np.linalg.norm((q - start.q) / scale)) for q in family)
    assert np.linalg.norm((near.q - start.q) / scale) == pytest.approx(nearest, rel=1e-3)
    assert near["crank"].angle != pytest.approx(float(start["crank"].angle), abs=1e-5)
    held = kp.assemble(longer, {"crank.angle": "70*deg"}, from_state=start)
    assert held["crank"].angle == pytest.approx(np.deg2rad(70), abs=1e-12)


def test_assembly_from_a_state_keeps_its_time_and_a_consistent_state(
    model: kp.Model, solution: kp.Solution
) -> None:
    again = kp.assemble(model, from_state=solution.final)
    assert again.t == solution.final.t
    assert np.array_equal(again.q, solution.final.q)
    assert np.array_equal(again.v, solution.final.v)
    with pytest.raises(kp.ModelError, match="pass it as from_state="):
        kp.assemble(model, guess=solution.final)  # type: ignore[arg-type]


def test_every_state_of_a_projected_run_is_a_start(model: kp.Model, solution: kp.Solution) -> None:
    for k in range(0, len(solution.t), 10):
        state = kp.State(solution.model, solution.t[k], solution.q[k], solution.v[k])
        again = kp.dynamics(model, state, t_end=solution.t[k] + 1e-3)
        assert np.array_equal(again.q[0], state.q)


def test_a_slider_crank_off_its_slide_is_refused() -> None:
    case = kp.load(ROOT / "examples" / "slider_crank.toml")
    begin = case.start()
    q = begin.q.copy()
    slide = begin.model.bodies["piston" if "piston" in begin.model.bodies else "slider"]
    q[slide.columns][1] += 0.0
    moved = q.copy()
    moved[slide.columns.start + 1] += 0.003
    off = kp.State(begin.model, 0.0, moved, begin.v)
    with pytest.raises(kp.AssemblyError, match=r"is open by 3\.000e-3 m"):
        kp.dynamics(case.model, off, t_end=0.1)
    kp.dynamics(case.model, kp.assemble(case.model, from_state=off), t_end=0.1)


def drifting(four_bar_file: Path) -> kp.Case:
    """A loose run with Baumgarte's stabilization, and one with projection after it."""
    loose = {
        "type": "dynamics",
        "t_end": 0.25,
        "method": {"type": "rk45", "rtol": 1e-3, "atol": 1e-6},
        "stabilization": {"type": "baumgarte", "alpha": 10, "beta": 200},
    }
    case = kp.load(four_bar_file)
    after = {"type": "dynamics", "t_end": 0.5}
    return kp.Case(case.model, case._start, {"loose": loose, "after": after})


def test_an_analysis_after_drift_says_that_it_starts_beside_it(four_bar_file: Path) -> None:
    case = drifting(four_bar_file)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        results = case.run()
    drifted, after = results["loose"].final, results["after"].initial
    gap = np.hypot(*np.abs(drifted.residuals[0]).reshape(-1, 2).T).max()
    assert gap > 1e-6
    (warning,) = [str(w.message) for w in caught if issubclass(w.category, kp.AssemblyWarning)]
    assert warning.startswith("after: the state does not meet the constraints at t = 0.25")
    assert f"{gap:.3e}".replace("e-0", "e-") in warning
    assert np.abs(after.residuals[0]).max() < 1e-10
    assert np.abs(after.q - drifted.q).max() < 10 * gap
    assert after.t == drifted.t


@pytest.mark.filterwarnings("default")
def test_the_command_line_prints_that_warning_in_one_line(
    four_bar_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "drifting.json"
    path.write_text(json.dumps(drifting(four_bar_file).tree()), encoding="utf-8")
    assert cli(["run", str(path), "-q", "--no-figures", "-o", str(tmp_path / "out")]) == 0
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert line.startswith("warning: after: the state does not meet the constraints")
