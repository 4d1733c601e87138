"""Frames, points and uniqueness of reactions."""

import json
import re
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.cli import app
from kempe.draw.player import page
from kempe.plot.pages import pages
from motions import results

EXAMPLES = sorted((ROOT / "examples").glob("*.toml"))


def crank() -> kp.Solution:
    """A uniform bar of 2 kg and 0.5 m that turns about A with 8 rad/s."""
    m = kp.Model("crank", gravity=(0, -9.81))
    m.ground.points(A=(0.3, 0.1))
    m.bar("bar", mass=2, length=0.5, ends=("A", "B"))
    m.revolute("A", "ground.A", "bar.A", axes=(0.2, 0.7))
    m.coordinate_driver("motor", "bar.angle", value="8*t")
    return kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.05)


def test_the_radial_force_on_a_crank_is_the_centripetal_one() -> None:
    sol = crank()
    angle = sol["bar.angle"]
    found = sol["A"].force(on="bar", frame="radial")  # from the mass centre to A: against x of bar
    # along x of the bar: F_x - m g sin(angle) = -m ω² L/2; to its left: F_y - m g cos(angle) = 0
    radial = 2 * 8**2 * 0.25 - 2 * 9.81 * np.sin(angle)
    tangential = -2 * 9.81 * np.cos(angle)
    np.testing.assert_allclose(found[:, 0], radial, atol=1e-9)
    np.testing.assert_allclose(found[:, 1], tangential, atol=1e-9)
    outwards = sol["A"].force(on="bar", frame="radial", about="B")
    np.testing.assert_allclose(outwards, found, atol=1e-9)


def test_frames_turn_the_global_components() -> None:
    case = kp.load(ROOT / "examples/four_bar.toml")
    sol = kp.dynamics(case.model, case.start(), t_end=0.5, output_step=0.01)
    c = sol["C"]
    fx, fy = c.force(on="rocker").T
    for frame, angle in {"i": "coupler", "j": "rocker", "body": "rocker"}.items():
        turn = sol[f"{angle}.angle"]
        expected = [fx * np.cos(turn) + fy * np.sin(turn), fy * np.cos(turn) - fx * np.sin(turn)]
        np.testing.assert_allclose(c.force(on="rocker", frame=frame).T, expected, atol=1e-8)
    # radial: from the other pin of the rocker, D, to C
    d = sol["rocker"].point("D").position - sol["rocker"].point("C").position
    u = -d / np.hypot(*d.T)[:, None]
    radial = c.force(on="rocker", frame="radial")
    np.testing.assert_allclose(radial[:, 0], (np.column_stack([fx, fy]) * u).sum(axis=1), atol=1e-8)
    np.testing.assert_allclose(np.hypot(*radial.T), np.hypot(fx, fy), rtol=1e-12)
    opposite = c.force(on="coupler", frame="i")
    np.testing.assert_allclose(c.force(on="rocker", frame="i"), -opposite, atol=1e-8)


def test_the_radial_line_joins_two_pins_or_begins_at_the_mass_centre() -> None:
    m = kp.Model("plates", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    plates = {"A": (0, 0), "B": (1, 0), "C": (1, 1)}
    m.body("one", mass=1, inertia=1, center=(0.3, 0.8), points=plates)
    m.body("two", mass=1, inertia=1, center=(0.3, 0.8), points={"B": (0, 0)})
    m.revolute("A", "ground.A", "one.A")
    m.revolute("B", "one.B", "two.B")
    state = kp.assemble(m, set={"one.angle": 0.3, "two.angle": 0.1})
    assert state["B"].reaction(on="one", frame="radial").axis == pytest.approx(0.3)
    assert state["A"].reaction(on="one", frame="radial").axis == pytest.approx(0.3 - np.pi)
    at_c = state["B"].reaction(on="one", frame="radial", about="C")
    assert at_c.axis == pytest.approx(0.3 - np.pi / 2)
    alone = state["B"].reaction(on="two", frame="radial")  # from the mass centre of two to B
    assert alone.axis == pytest.approx(0.1 + np.arctan2(-0.8, -0.3))


@pytest.mark.parametrize("frame", ["global", "body", "joint"])
def test_a_reaction_agrees_with_force_and_torque(frame: str) -> None:
    sol = crank()
    for on in ("bar", "ground"):
        for name in ("A", "motor"):
            found = sol[name].reaction(on=on, frame=frame)
            force = sol[name].force(on=on, frame=frame)
            np.testing.assert_allclose(found.force, force, atol=1e-10)
            np.testing.assert_array_equal(found.torque, sol[name].torque(on=on))
            assert (found.joint, found.body, found.frame, found.unique) == (name, on, frame, True)


def test_a_reaction_acts_at_its_point() -> None:
    sol = crank()
    np.testing.assert_allclose(sol["A"].reaction(on="bar").point, np.tile([0.3, 0.1], (21, 1)))
    state = sol.final["A"].reaction(on="bar", frame="body")
    assert state.axis == sol.final["bar.angle"]
    assert state.force.shape == (2,)
    assert isinstance(state.torque, float)


def test_a_roller_pushes_at_the_point_of_contact() -> None:
    sol = results("cam_roller")[0]
    (name,) = (n for n, info in sol.compiled.joints.items() if info.results)
    i, j = (sol[name].reaction(on=on) for on in (sol[name].info.i, sol[name].info.j))
    np.testing.assert_allclose(i.point, j.point, atol=1e-9)
    np.testing.assert_allclose(i.force, -j.force, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(np.hypot(*i.force.T), np.abs(sol[f"{name}.normal"]), rtol=1e-9)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_action_is_reaction_on_every_body_that_a_joint_touches(path: Path) -> None:
    sol = next(one for one in results(path.stem).values() if isinstance(one, kp.Solution))
    for name, info in sol.compiled.constraints.items():
        force, moment, size = np.zeros((len(sol.t), 2)), np.zeros(len(sol.t)), 1e-9
        for body in info.bodies:
            on = sol[name].reaction(on=body)
            force = force + on.force
            arm = on.point[:, 0] * on.force[:, 1] - on.point[:, 1] * on.force[:, 0]
            moment = moment + on.torque + arm
            size = max(size, np.abs(on.force).max(), np.abs(on.torque).max(), np.abs(arm).max())
        assert np.abs(force).max() < 1e-9 * size, name
        # an open joint turns by its gap times the force
        assert np.abs(moment).max() < 2e-5 * size, name


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"frame": "local"}, "write 'body'"),
        ({"frame": "radial", "about": "X"}, "unknown point of bar 'X'"),
        ({"frame": "radial", "about": "A"}, "name another point of the body"),
        ({"frame": "body", "about": "B"}, 'only the frame "radial" needs it'),
    ],
)
def test_a_wrong_frame_is_an_error(arguments: dict[str, str], message: str) -> None:
    with pytest.raises(kp.ModelError, match=message):
        crank()["A"].reaction(on="bar", **arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("place", [(0.0, 0.0), (1e9, 0.0), (0.0, -1e9)])
def test_a_direction_within_rounding_errors_of_places_is_refused(
    place: tuple[float, float],
) -> None:
    """1 µm is a direction near the origin; at 1e9 m, places have errors of 0.1 µm."""
    m = kp.Model("far")
    m.ground.points(A=place)
    m.body("bar", mass=1, inertia=1, points={"A": (0, 0), "near": (-1e-6, 1e-6), "B": (-3e3, 0)})
    m.revolute("A", "ground.A", "bar.A")
    view = kp.assemble(m, set={"bar.angle": 0})["A"]
    assert view.reaction(on="bar", frame="radial", about="B").axis == pytest.approx(0.0)
    if place == (0.0, 0.0):
        found = view.reaction(on="bar", frame="radial", about="near")
        assert found.axis == pytest.approx(-np.pi / 4)
    else:
        with pytest.raises(kp.ModelError, match="A lies at the origin of the radial direction"):
            view.reaction(on="bar", frame="radial", about="near")


def door() -> kp.Solution:
    """A door on two slides, one too many, that a driver moves; a lamp hangs on it."""
    m = kp.Model("door", gravity=(0, -9.81), redundancy="allow")
    m.ground.points(A=(0, 0), B=(0, 1))
    points = {"A": (0, 0), "B": (0, 1)}
    m.body("door", mass=10, inertia=1, center=(0.5, 0.5), points=points)
    m.bar("lamp", mass=1, length=0.3, ends=("P", "Q"))
    m.translational("low", "ground.A", "door.A")
    m.translational("high", "ground.B", "door.B")
    m.revolute("hook", "door.B", "lamp.P")
    m.coordinate_driver("motor", "door.x", value="0.3*sin(5*t)")
    start = kp.assemble(m, set={"lamp.angle": "-90*deg"})
    return kp.dynamics(m, start, t_end=1, output_step=0.1)


def test_redundant_joints_have_no_unique_reaction() -> None:
    sol = door()
    unique = {name: sol[name].unique for name in sol.compiled.constraints}
    assert unique == {"low": False, "high": False, "hook": True, "motor": True}
    assert not sol["low"].reaction(on="door").unique
    assert "minimum norm" in repr(sol["low"].reaction(on="door"))
    assert not sol.final["low"].unique
    assert sol.newton_euler.largest < 1e-9  # the values carry the loads


def test_the_page_remarks_values_that_are_not_unique() -> None:
    shown = kp.scene(door())
    assert shown["choices"] == dict.fromkeys(["low", "high"], "minimum norm")
    found = re.search(r'<script type="application/json"[^>]*>(.*?)</script>', page(shown), re.S)
    assert found
    written = json.loads(found[1])
    remarked = ["low (minimum norm)", "high (minimum norm)", "hook"]
    assert [joint["name"] for joint in written["joints"]] == remarked
    torques = {one["of"] for one in written["channels"] if one["quantity"] == "torque"}
    assert "low (minimum norm)" in torques
    assert [joint["name"] for joint in shown["joints"]] == ["low", "high", "hook"]


def test_values_that_are_not_unique_are_labelled(tmp_path: Path) -> None:
    sol = door()
    sol.to_csv(tmp_path / "door.csv")
    header = (tmp_path / "door.csv").read_text().split("\n")[0]
    assert '"low.fy_on_door [N, minimum norm]"' in header
    assert ",hook.fy_on_lamp [N]," in header
    by_name = {found["joint"]: found["unique"] for found in sol.summary["peaks"]["reactions"]}
    assert by_name == {"low": False, "high": False, "hook": True, "motor": True}
    assert "minimum norm" in kp.plot.reactions(sol, "low").get_title(loc="left")
    assert "minimum norm" not in kp.plot.reactions(sol, "hook").get_title(loc="left")
    labels = [line.get_label() for line in kp.plot.all_reactions(sol).get_lines()]
    assert [", minimum norm" in str(label) for label in labels] == [True, True, False, False]
    for one in pages(sol):
        if one.name in ("reactions_low", "reactions_hook"):
            told = " ".join(text.get_text() for text in one.draw().texts)
            assert ("not unique: minimum norm" in told) == (one.name == "reactions_low")


def test_the_printed_table_marks_values_that_are_not_unique(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "door.json"
    model = door().model
    kp.Case(model, {"set": {"lamp.angle": "-90*deg"}}, [kp.Dynamics(t_end=0.1)]).save(file)
    assert app.run(["run", str(file), "-o", str(tmp_path / "out"), "--no-figures"]) == 0
    told = capsys.readouterr().out
    starts = [
        line.split()[:2] for line in told.splitlines() if " door " in line or " lamp " in line
    ]
    assert ["*", "low"] in starts
    assert ["*", "high"] in starts
    assert ["hook", "lamp"] in starts
    assert "* not unique, of the smallest multipliers (minimum norm): low, high" in told
    summary = json.loads((tmp_path / "out/summary.json").read_text("utf-8"))
    unique = {found["joint"]: found["unique"] for found in summary["peaks"]["reactions"]}
    assert unique == {"low": False, "high": False, "hook": True, "motor": True}
    header = (tmp_path / "out/solution.csv").read_text().split("\n")[0]
    assert '"low.fy_on_door [N, minimum norm]"' in header


def test_reactions_of_a_regular_mechanism_are_unique() -> None:
    sol = crank()
    assert sol["A"].unique
    assert sol.final["motor"].unique
