"""A driven motion has figures of design on the command line."""

from pathlib import Path

import kempe as kp
import pytest
from kempe.cli.app import app
from python.test_design_kinematics import four_bar
from python.test_kinematics import slider_crank
from typer.testing import CliRunner


@pytest.fixture
def case(tmp_path: Path) -> Path:
    guess = {"coupler.angle": "50 deg", "rocker.angle": "-90 deg"}
    analysis = kp.InverseDynamics(over="crank.angle", range=(0, "2*pi"), n=25, name="turn")
    kp.Case(four_bar(), {"guess": guess}, [analysis]).save(tmp_path / "case.toml")
    return tmp_path / "case.toml"


def test_a_driven_motion_writes_its_figures_by_default(case: Path, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    done = CliRunner().invoke(app, ["inverse_dynamics", str(case), "-o", str(folder)])
    assert done.exit_code == 0, done.output
    names = {path.stem.partition("_")[2] for path in (folder / "figures").glob("*.png")}
    assert {"path_coupler_P", "transmission_B", "effort_motor"} <= names
    assert not {name for name in names if name.startswith("pin_load")}


def test_figures_of_design_can_be_chosen(case: Path, tmp_path: Path) -> None:
    folder = tmp_path / "figures"
    names = ["pin_load_B_on_coupler", "path_coupler.P", "velocity_polygon", "shaking_force"]
    chosen = [word for name in names for word in ("--figure", name)]
    words = ["plot", str(case), *chosen, "--format", "svg", "-o", str(folder)]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    assert len(list(folder.glob("*.svg"))) == 4


def test_a_motion_of_dynamics_has_efforts_and_paths_but_no_design_figures() -> None:
    m = slider_crank()
    start = kp.assemble(m, guess={"piston.x": 0.4})
    names = [page.name for page in kp.plot.pages(kp.dynamics(m, start, t_end=0.1))]
    design = ("path", "transmission", "effort", "duty", "velocity_polygon", "pin_load", "shaking")
    assert [name for name in names if name.startswith(design)] == ["effort_motor"]


def test_polygons_and_centres_are_drawn_at_two_fifths_of_the_motion() -> None:
    m = four_bar()
    start = kp.assemble(m, guess={"coupler.angle": "50 deg", "rocker.angle": "-90 deg"})
    sol = kp.inverse_dynamics(m, start, over="crank.angle", range=(0.5, 2.5), n=5)
    pages = {page.name: page for page in kp.plot.pages(sol)}
    for name in ("velocity_polygon", "acceleration_polygon", "instant_centres"):
        title = pages[name].draw().axes[0].get_title(loc="left")
        at = {t: getattr(kp.plot, name)(sol, t).get_title(loc="left") for t in (1.2, 1.3, 1.4)}
        assert title == at[1.3]
        assert len(set(at.values())) == 3
