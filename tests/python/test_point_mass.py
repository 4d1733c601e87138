"""A point mass has two coordinates: columns, names, views, tables, closed forms of its motion."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.results.table import columns
from matplotlib.figure import Figure


@pytest.fixture
def pendulum() -> kp.Solution:
    """A point mass on a string beside a bar on a pin."""
    model = kp.Model("pendulums", gravity=(0.0, -9.81))
    model.ground.points(O=(0.0, 0.0))
    model.point_mass("bob", mass=2.0, at=(0.6, -0.8))
    model.bar("rod", mass=1.0, length=1.0, ends=("A", "B"))
    model.distance("string", "ground.O", "bob.P", length=1.0)
    model.revolute("pin", "ground.O", "rod.A")
    start = kp.assemble(model, {"bob.x": 0.6, "rod.angle": 0.0})
    return kp.dynamics(model, start, t_end=1.0, output_step=0.1, method=kp.DOP853(rtol=1e-11))


def falling() -> kp.Model:
    model = kp.Model("fall", gravity=(0.0, -10.0))
    model.ground.points(O=(0.0, 0.0))
    model.point_mass("stone", mass=3.0, at=(1.0, 2.0))
    return model


def test_the_columns_of_a_point_mass_are_x_and_y(pendulum: kp.Solution) -> None:
    model = pendulum.model
    assert (model.n_q, model.n_z, model.n_rows) == (5, 0, 3)
    assert model.column_names() == ["bob.x", "bob.y", "rod.x", "rod.y", "rod.angle"]
    assert model.rate_names() == ["bob.vx", "bob.vy", "rod.vx", "rod.vy", "rod.omega"]
    assert model.bodies["bob"].columns == slice(0, 2)
    assert model.bodies["rod"].columns == slice(2, 5)
    assert not model.bodies["bob"].turns
    assert pendulum.final.matrices().M.shape == (5, 5)
    assert pendulum.final.matrices().degrees_of_freedom == 2


def test_a_point_mass_does_not_turn(pendulum: kp.Solution) -> None:
    bob = pendulum.body("bob")
    for still in (bob.angle, bob.omega, bob.alpha):
        assert np.array_equal(still, np.zeros(len(pendulum.t)))
    assert np.array_equal(bob.point("P").position, bob.r)
    assert np.array_equal(pendulum.body("rod").angle, pendulum.q[:, 4])


def test_free_fall_is_a_parabola() -> None:
    model = falling()
    start = kp.assemble(model, {"stone.vx": 2.0})
    assert start.coordinates() == {"stone.x": 1.0, "stone.y": 2.0, "stone.vx": 2.0, "stone.vy": 0.0}
    stone = kp.dynamics(model, start, t_end=1.5, output_step=0.25)
    t = stone.t
    assert stone["stone"].x == pytest.approx(1.0 + 2.0 * t, abs=1e-9)
    assert stone["stone"].y == pytest.approx(2.0 - 5.0 * t**2, abs=1e-9)
    assert stone["stone"].ay == pytest.approx(-10.0)
    assert stone.energy.kinetic == pytest.approx(1.5 * (4.0 + (10.0 * t) ** 2), abs=1e-7)


def test_the_string_carries_weight_and_centrifugal_force(pendulum: kp.Solution) -> None:
    bob = pendulum.body("bob")
    along = np.sum(bob.r * pendulum.constraint("string").force(on="bob"), axis=1)
    speed = bob.vx**2 + bob.vy**2
    assert along == pytest.approx(-2.0 * (speed - 9.81 * bob.y), rel=1e-9)
    assert np.abs(pendulum.energy.balance).max() < 1e-9


def test_tables_and_texts_leave_the_angle_out(pendulum: kp.Solution, tmp_path: Path) -> None:
    names = [column.name for column in columns(pendulum)]
    assert names[1:7] == ["bob.x", "bob.y", "bob.vx", "bob.vy", "bob.ax", "bob.ay"]
    assert "rod.angle" in names
    assert "bob.angle" not in names
    pendulum.to_csv(tmp_path / "all.csv")
    header = (tmp_path / "all.csv").read_text("utf-8").partition("\n")[0].split(",")
    assert header[1:4] == ["bob.x [m]", "bob.y [m]", "bob.vx [m/s]"]
    bob = next(line for line in str(pendulum.final).splitlines() if line.startswith("bob"))
    assert len(bob.split()) == 5


def test_a_saved_solution_is_the_same(pendulum: kp.Solution, tmp_path: Path) -> None:
    pendulum.save(tmp_path / "pendulum.npz")
    again = kp.load_solution(tmp_path / "pendulum.npz")
    assert np.array_equal(again.q, pendulum.q)
    assert np.array_equal(again(0.33).q, pendulum(0.33).q)
    assert again.z.shape == (len(again.t), 0)


def test_a_point_mass_is_drawn(pendulum: kp.Solution) -> None:
    scene = kp.scene(pendulum, frames=5)
    assert np.array(scene["frames"]["poses"]).shape == (5, 2, 3)
    # The page offers the angles of all bodies that are not point masses.
    assert [body["kind"] for body in scene["bodies"]] == ["ground", "point_mass", "bar"]
    assert not [one["name"] for one in scene["channels"] if one["name"].startswith("bob.")]
    assert json.dumps(scene)


def test_pages_of_angles_leave_a_point_mass_out(pendulum: kp.Solution) -> None:
    from kempe.plot.pages import pages

    assert "angle" in {page.name for page in pages(pendulum)}
    start = kp.assemble(falling())
    stone = kp.dynamics(falling(), start, t_end=0.5, output_step=0.1)
    found = {page.name: page for page in pages(stone)}
    assert "angle" not in found
    assert {"x", "y", "stone"} <= set(found)
    figure = found["stone"].draw()
    assert [axes.get_ylabel() for axes in figure.axes] == ["$v_y$ / (m/s)"]
    (left_out,) = (text.get_text() for text in figure.texts)
    assert left_out == "Not drawn: $v_x$, $a_x$ (zero); $a_y$ = −10 m/s² (constant)."


def test_a_figure_of_a_point_mass_has_no_axis_of_the_angle(pendulum: kp.Solution) -> None:
    from kempe.plot import positions

    counts = {}
    for body in ("bob", "rod"):
        axes = Figure().add_subplot()
        positions(pendulum, body, ax=axes)
        counts[body] = len(axes.figure.axes)
    assert counts == {"bob": 1, "rod": 2}
