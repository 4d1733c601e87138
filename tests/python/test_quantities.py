"""Quantities by name agree with hand-derived values and with differences of the interpolant."""

import math
from itertools import pairwise

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

EXAMPLES = ["four_bar", "six_bar", "slider_crank", "pendulum", "squeezer"]


@pytest.fixture(scope="module")
def rig() -> kp.Solution:
    """A block on a slide of a turning arm, a rod, a spring to it, and a driven wheel."""
    m = kp.Model("rig", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), P=(3, 0), Q=(0, 4), W=(5, 0))
    m.body("arm", mass=2, inertia=0.5, points={"O": (0, 0), "S": (0.2, 0.1)})
    m.body("block", mass=1, inertia=0.2, points={"C": (0, 0), "D": (0.3, 0)})
    m.revolute("pivot", "ground.O", "arm.O")
    m.translational("slide", "arm.S", "block.C", axes=(0.3, 0))
    m.spring_damper("spring", "ground.P", "block.D", stiffness=40, damping=2, free_length=2)
    m.body("bob", mass=1.5, inertia=0.1, points={"B": (0.1, 0.2)})
    m.distance("rod", "ground.Q", "bob.B", length=2)
    m.body("wheel", mass=1, inertia=0.4, points={"W": (0, 0)})
    m.revolute("axle", "ground.W", "wheel.W")
    m.coordinate_driver("drive", "wheel.angle", value="2*t + 1.5*t^2")
    m.torsion_spring("coil", "arm", "wheel", stiffness=3, damping=0.5, free_angle=0)
    start = kp.assemble(
        m,
        set={"arm.angle": 0.4, "block.x": 1.2, "arm.omega": 1.0, "block.vx": 0.7},
        guess={"bob.x": 1, "bob.y": 3, "bob.vx": 1.0},
    )
    return kp.dynamics(
        m, start, t_end=1, output_step=0.05, method=kp.DOP853(rtol=1e-11, atol=1e-12)
    )


TRIPLES = [
    ("arm", "angle", "omega", "alpha"),
    ("block", "y", "vy", "ay"),
    ("block.D", "x", "vx", "ax"),
    ("bob.B", "y", "vy", "ay"),
    ("pivot", "angle", "omega", "alpha"),
    ("coil", "angle", "omega", "alpha"),
    ("slide", "displacement", "rate", "acceleration"),
    ("spring", "length", "rate", "acceleration"),
    ("rod", "length", "rate", "acceleration"),
]


@pytest.mark.parametrize("names", TRIPLES, ids=lambda names: names[0])
def test_rates_and_accelerations_are_derivatives(rig: kp.Solution, names: tuple[str, ...]) -> None:
    owner, *family = names
    t, h = np.linspace(0.1, 0.9, 17), 1e-4
    for value, rate in pairwise(family):
        after, before = rig(t + h)[f"{owner}.{value}"], rig(t - h)[f"{owner}.{value}"]
        found = rig(t)[f"{owner}.{rate}"]
        np.testing.assert_allclose(found, (after - before) / (2 * h), atol=1e-5, rtol=1e-6)


def test_positions_are_those_of_the_points(rig: kp.Solution) -> None:
    arm, block = rig.body("arm"), rig.body("block")
    apart = block.point("C").position - arm.point("S").position
    u = np.stack([np.cos(arm.angle + 0.3), np.sin(arm.angle + 0.3)], axis=1)
    assert rig["slide.displacement"] == pytest.approx((apart * u).sum(axis=1))
    assert np.ptp(rig["slide.displacement"]) > 0.1
    to_spring = block.point("D").position - [3, 0]
    assert rig["spring.length"] == pytest.approx(np.hypot(*to_spring.T))
    assert rig["coil.angle"] == pytest.approx(rig["wheel"].angle - arm.angle)
    assert rig["rod.length"] == pytest.approx(np.full(21, 2.0))


def test_forces_have_their_signs(rig: kp.Solution) -> None:
    stretch, rate = rig["spring.length"] - 2, rig["spring.rate"]
    push = -(40 * stretch + 2 * rate)
    assert rig["spring.force"] == pytest.approx(push)  # > 0 pushes apart
    assert rig["spring.power"] == pytest.approx(push * rate)
    away = rig.body("block").point("D").position - [3, 0]
    assert rig["spring.fx"] == pytest.approx(push * away[:, 0] / rig["spring.length"])
    assert rig["coil.torque"] == pytest.approx(-3 * rig["coil.angle"] - 0.5 * rig["coil.omega"])
    assert rig["coil.torque_on_arm"] == pytest.approx(-rig["coil.torque"])
    assert rig["coil.power"] == pytest.approx(rig["coil.torque"] * rig["coil.omega"])


def test_tension_carries_the_bob(rig: kp.Solution) -> None:
    bob = rig.body("bob")
    pull = 1.5 * (bob.acceleration - [0, -9.81])  # the rod is the only other force
    to_ground = np.array([0.0, 4.0]) - bob.point("B").position
    along = to_ground / np.linalg.norm(to_ground, axis=1)[:, None]
    assert rig["rod.tension"] == pytest.approx((pull * along).sum(axis=1), rel=1e-6)
    assert (rig["rod.tension"] > 0).any()


def test_effort_of_a_driver_is_newtons_law(rig: kp.Solution) -> None:
    effort = 0.4 * 3.0 - rig["coil.torque"]  # J alpha with alpha = 3
    assert rig["drive.effort"] == pytest.approx(effort, rel=1e-7)
    assert rig["drive.power"] == pytest.approx(effort * (2 + 3 * rig.t), rel=1e-7)


def test_reactions_are_those_on_body_j(rig: kp.Solution) -> None:
    on_arm = rig.joint("pivot").force(on="arm")
    assert rig["pivot.fx"] == pytest.approx(on_arm[:, 0])
    assert rig["pivot.fy"] == pytest.approx(on_arm[:, 1])
    assert rig["pivot.force"] == pytest.approx(np.hypot(*on_arm.T))
    assert rig["slide.torque"] == pytest.approx(rig["slide"].torque(on="block"))


def test_a_state_gives_floats(rig: kp.Solution) -> None:
    state = rig(0.3)
    for name in state._ipython_key_completions_():
        if "." in name:
            assert type(state[name]) is float, name
    for name in ("x", "angle", "vx", "omega", "ax", "alpha"):
        assert type(getattr(state.body("arm"), name)) is float
    assert type(state.t) is float
    assert type(state.joint("slide").torque(on="arm")) is float
    assert type(state.force("coil").damping_torque(on="arm")) is float
    assert state["arm"].r.shape == (2,)


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_column_of_the_table_is_a_quantity(name: str) -> None:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    sol = case.with_analysis(next(iter(case.analyses)), t_end=0.01).run()[0]
    frame = sol.to_dataframe()
    for column in frame.columns[1:]:
        assert np.array_equal(sol[column], frame[column]), column
        assert column in sol


def test_completion_lists_names_that_exist(rig: kp.Solution) -> None:
    names = rig._ipython_key_completions_()
    assert {"arm", "arm.angle", "block.D.vx", "slide.rate", "energy.total", "drift.position"} <= {
        *names
    }
    for name in names:
        _ = rig[name]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("arm.angel", "unknown quantity of arm 'angel'; did you mean 'angle'?"),
        ("arn.angle", "unknown quantity 'arn.angle'; did you mean 'arm.angle'?"),
        ("slide.angle", "unknown quantity of slide 'angle'; there is displacement, rate"),
        ("energy.kinetik", "did you mean 'kinetic'?"),
        ("block.E.x", "did you mean 'block."),
    ],
)
def test_an_unknown_quantity_has_a_suggestion(rig: kp.Solution, name: str, message: str) -> None:
    with pytest.raises(kp.ModelError) as caught:
        rig[name]
    assert message in str(caught.value)
    assert isinstance(caught.value, KeyError)
    remedy = str(caught.value).partition("did you mean '")[2].partition("'")[0]
    if remedy:
        _ = rig[remedy if "." in remedy else f"{name.rpartition('.')[0]}.{remedy}"]


def test_views_have_their_kind(rig: kp.Solution) -> None:
    assert rig.joint("slide").info.group == "joints"
    assert rig.driver("drive").info.group == "drivers"
    with pytest.raises(kp.ModelError, match="unknown joint 'drive'"):
        rig.joint("drive")
    with pytest.raises(kp.ModelError, match="unknown driver 'slide'"):
        rig.driver("slide")
    assert math.isclose(rig.final.body("wheel").angle, 3.5, rel_tol=1e-9)
