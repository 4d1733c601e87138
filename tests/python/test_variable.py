"""A motion over a driven quantity names this quantity and its unit wherever the time would be."""

import copy
import csv
import json
import pickle
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe import design
from kempe.report import summary
from kempe.results.variable import TIME, Variable
from python.test_kinematics import slider_crank, started
from typer.testing import CliRunner

OVER = Variable("crank.angle", "rad")


@pytest.fixture(scope="module")
def sweep() -> kp.Solution:
    m = slider_crank()
    return kp.inverse_dynamics(m, started(m), over="motor", range=(0.5, 5.5), n=31)


def test_a_motion_over_time_is_over_the_time() -> None:
    m = slider_crank()
    sol = kp.kinematics(m, started(m), t_end=0.1)
    assert sol.variable == TIME
    assert sol.variable.is_time
    assert summary(sol)["variable"] == {"name": "t", "unit": "s"}


def test_copies_parts_and_files_keep_the_variable(sweep: kp.Solution, tmp_path: Path) -> None:
    assert sweep.variable == OVER
    assert sweep.final.variable == OVER
    assert sweep(1.0).variable == OVER
    assert sweep(np.array([1.0, 2.0])).variable == OVER
    for one in (sweep, sweep.final, sweep(np.array([1.0, 2.0]))):
        assert pickle.loads(pickle.dumps(one)).variable == OVER
        assert copy.copy(one).variable == OVER
    sweep.save(tmp_path / "sweep.npz")
    assert kp.load_solution(tmp_path / "sweep.npz").variable == OVER
    assert "crank.angle = 0.5 … 5.5 rad" in repr(sweep)
    assert "at crank.angle = 5.5 rad" in repr(sweep.final)
    assert str(sweep.final).startswith("crank.angle = 5.5 rad\n")


def test_a_part_before_a_limit_keeps_the_variable() -> None:
    m = slider_crank()
    with pytest.raises(kp.SingularityError) as caught:
        kp.kinematics(m, started(m), over="S.displacement", range=(0.38, 0.5), n=13)
    assert caught.value.solution.variable == Variable("S.displacement", "m")


def test_the_first_column_of_a_table_is_the_driven_quantity(
    sweep: kp.Solution, tmp_path: Path
) -> None:
    sweep.to_csv(tmp_path / "sweep.csv")
    with (tmp_path / "sweep.csv").open(encoding="utf-8") as file:
        header = next(csv.reader(file))
    assert header[0] == "crank.angle [rad]"
    assert len(set(header)) == len(header)
    assert not any(name.startswith("t [") for name in header)
    read = np.loadtxt(tmp_path / "sweep.csv", delimiter=",", skiprows=1)
    assert read[:, 0] == pytest.approx(sweep.t, abs=1e-15)
    with kp.units("deg"):
        sweep.to_csv(tmp_path / "sweep.csv")
    assert (tmp_path / "sweep.csv").read_text("utf-8").startswith("crank.angle [deg],")


@pytest.mark.parametrize("static", [False, True])
def test_tables_and_figures_say_what_forces_over_the_quantity_contain(
    tmp_path: Path, static: bool
) -> None:
    m = slider_crank()
    m.measures(push="sqrt(A.force)")
    sol = kp.inverse_dynamics(m, started(m), over="motor", range=(0.5, 1.5), n=5, static=static)
    words = "at rest, without" if static else "with inertia and damping at 1 rad/s"
    told = sol.variable.condition
    assert told.startswith(words)
    sol.to_csv(tmp_path / "turn.csv")
    with (tmp_path / "turn.csv").open(encoding="utf-8") as file:
        header = next(csv.reader(file))
    for marked in ("A.fx_on_rod [N", "motor.lambda_angle [N*m", "push [SI"):
        assert f"{marked}, {told}]" in header
    for plain in ("crank.angle [rad]", "rod.omega [rad/rad]", "piston.ax [m/rad^2]"):
        assert plain in header
    title = kp.plot.pin_load(sol, "A")
    assert told in [text.get_text() for text in title.texts]
    design.write_pin_loads(sol, tmp_path / "pins.csv")
    with (tmp_path / "pins.csv").open(encoding="utf-8") as file:
        assert f"A.body_fx_on_rod [N, {told}]" in next(csv.reader(file))
    case = design.load_cases(sol, "rod", "A")[0]
    case.to_csv(tmp_path / "case.csv")
    assert f"# loads {told}\n" in (tmp_path / "case.csv").read_text("utf-8")
    below = [text.get_text() for text in kp.plot.free_body(sol, "rod", 1.0).texts]
    assert any(told in text for text in below)
    frame = sol.to_dataframe()
    assert frame.attrs["conditions"]["A.fx_on_rod"] == told
    over_time = kp.inverse_dynamics(m, started(m), t_end=0.1)
    over_time.to_csv(tmp_path / "time.csv")
    assert "inertia" not in (tmp_path / "time.csv").read_text("utf-8")


def test_all_figures_over_the_quantity_have_its_name_and_unit(sweep: kp.Solution) -> None:
    for page in kp.plot.pages(sweep):
        labels = {axes.get_xlabel() for axes in page.figure().axes} - {""}
        assert not {label for label in labels if "time" in label or "/ s" in label}, page
    axes = kp.plot.reactions(sweep, "A")
    assert axes.get_xlabel() == "crank.angle / °"
    assert axes.get_xlim() == pytest.approx(np.degrees([0.5, 5.5]))
    assert [text for text in axes.texts if "°" in text.get_text()]
    assert kp.plot.configuration(sweep.final).get_title("left") == "crank.angle = 315.127°"
    m = slider_crank()
    stroke = kp.kinematics(m, started(m), over="S.displacement", range=(0.38, 0.3), n=13)
    assert kp.plot.positions(stroke, "rod").get_xlabel() == "S.displacement / m"


def test_a_motion_over_a_falling_quantity_has_values_between_and_is_saved(tmp_path: Path) -> None:
    m = slider_crank()
    down = kp.kinematics(m, started(m), over="S.displacement", range=(0.38, 0.3), n=5)
    up = kp.kinematics(m, down.final, over="S.displacement", range=(0.3, 0.38), n=5)
    at = np.linspace(0.3, 0.38, 17)
    for name in ("crank.angle", "crank.omega", "rod.angle"):
        assert down(at)[name] == pytest.approx(up(at)[name], rel=1e-9, abs=1e-11)
    down.save(tmp_path / "down.npz")
    assert kp.load_solution(tmp_path / "down.npz")(at)["rod.x"] == pytest.approx(up(at)["rod.x"])
    with pytest.raises(kp.ModelError, match="outside the solution"):
        down(0.381)


def test_the_printed_summary_names_the_quantity(tmp_path: Path) -> None:
    from kempe.cli.app import app

    m = slider_crank()
    analysis = kp.InverseDynamics(over="motor", range=(0, "2*pi"), n=25, name="turn")
    kp.Case(m, {"guess": {"piston.x": 0.4}}, [analysis]).save(tmp_path / "case.toml")
    folder = tmp_path / "out"
    done = CliRunner().invoke(
        app, ["run", str(tmp_path / "case.toml"), "-o", str(folder), "--no-figures"]
    )
    assert "turn: over crank.angle, 0 to 360°, 25 outputs" in done.output
    assert "at / °" in done.output
    assert " s," not in done.output.split("Accuracy")[0].split("turn:")[1]
    told = json.loads((folder / "summary.json").read_text("utf-8"))
    assert told["variable"] == {"name": "crank.angle", "unit": "rad"}
