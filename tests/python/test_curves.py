"""Curves of bodies from Python: faults, copies, files, normal forces and ``lift_off``."""

from __future__ import annotations

import math
import pickle
import warnings
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT

R, E, MASS, G = 0.05, 0.02, 0.8, 9.81
CIRCLE = {"circle": (E, 0, R)}
CLOCKWISE = {"x": "0.02 + R*cos(u)", "y": "-R*sin(u)", "range": (0, "2*pi"), "periodic": True}
THROUGH_POINTS = {"points": np.array([[6, 0], [0, 5], [-6, 0], [0, -5]]) / 100, "periodic": True}


def cam(curve: dict[str, Any], joint: str = "flat", speed: float = 10.0, **fields: Any) -> kp.Model:
    """A cam that turns about the origin, and a follower on the y axis."""
    m = kp.Model("cam", gravity=(0, -G), parameters={"R": R})
    m.ground.points(O=(0, 0))
    m.body("cam", mass=2, inertia=0.01, points={"O": (0, 0)}, curves={"rim": curve})
    m.body("follower", mass=MASS, inertia=0.001, points={"P": (0, 0)})
    m.revolute("shaft", "ground.O", "cam.O")
    m.translational("guide", "ground.O", "follower.P", axes=("90*deg", "90*deg"))
    getattr(m, f"{joint}_on_curve")("contact", "follower.P", "cam.rim", **fields)
    m.coordinate_driver("motor", "cam.angle", value=f"{speed}*t")
    return m


def started(m: kp.Model) -> kp.State:
    return kp.assemble(m, guess={"follower.y": 0.1})


def test_the_normal_force_of_a_flat_follower() -> None:
    sol = kp.dynamics(cam(CIRCLE), started(cam(CIRCLE)), t_end=0.5, output_step=0.01)
    phi = 10 * sol.t
    np.testing.assert_allclose(sol["follower.y"], R + E * np.sin(phi), rtol=1e-10)
    expected = MASS * (G - E * 100 * np.sin(phi))
    np.testing.assert_allclose(sol["contact.normal"], expected, rtol=1e-10)
    np.testing.assert_allclose(sol["contact"].normal, expected, rtol=1e-10)
    np.testing.assert_allclose(sol["contact"].force(on="follower")[:, 1], expected, rtol=1e-10)
    np.testing.assert_allclose(sol["contact"].torque(on="follower"), 0, atol=1e-11)
    assert not len(sol.events["contact.lift_off"].t)
    assert repr(sol.events["contact.lift_off"]) == "<Event 'contact.lift_off': never>"
    assert sol.final["contact"].normal == sol["contact.normal"][-1]
    with pytest.raises(AttributeError, match="tangential"):
        _ = sol["contact"].tangential


@pytest.mark.parametrize("dense", [True, False])
def test_a_follower_lifts_off_where_its_normal_force_becomes_negative(dense: bool) -> None:
    """N = m (g - e ω² sin φ) falls through zero at sin φ = g/(e ω²), in each turn once."""
    m = cam(CIRCLE, speed=30)
    with pytest.warns(kp.EventWarning, match=r"contact.lift_off: 2 times, first at t = 0\.019"):
        sol = kp.dynamics(m, started(m), t_end=0.4, output_step=1e-4, dense_output=dense)
    event = sol.events["contact.lift_off"]
    angle = np.arcsin(G / (E * 900))
    expected = np.array([angle, angle + 2 * np.pi]) / 30
    np.testing.assert_allclose(event.t, expected, atol=1e-12 if dense else 1.01e-4)
    for t, state in zip(event.t, event.states, strict=True):
        assert state.t == t
        assert abs(state["contact"].normal) < (1e-8 if dense else 0.05)
    found = kp.report.summary(sol)["events"]
    assert found == {"contact.lift_off": event.t.tolist()}
    copy = pickle.loads(pickle.dumps(sol))
    np.testing.assert_array_equal(copy.events["contact.lift_off"].t, event.t)


def test_a_cam_that_starts_lifted_has_an_event_at_its_start() -> None:
    m = cam(CIRCLE, speed=30)
    start = kp.assemble(m, guess={"follower.y": 0.1}, t=np.pi / 60)  # at the top
    with pytest.warns(kp.EventWarning, match="once"):
        sol = kp.dynamics(m, start, t_end=0.06)
    np.testing.assert_array_equal(sol.events["contact.lift_off"].t, [start.t])


@pytest.mark.parametrize(
    ("curve", "joint", "fields"),
    [
        (CIRCLE, "roller", {"radius": 0.01}),
        (CLOCKWISE, "flat", {}),
        ({"polar": "0.06 + 0.005*cos(2*u)"}, "roller", {"radius": 0.02, "side": "right"}),
        (THROUGH_POINTS, "point", {}),
    ],
)
def test_file_and_model_are_the_same(
    tmp_path: Path, curve: dict[str, Any], joint: str, fields: dict[str, Any]
) -> None:
    m = cam(curve, joint, **fields)
    start = started(m)
    case = kp.Case(m, start=kp.Start(guess={"follower.y": 0.1}), analyses=[kp.Dynamics(t_end=0.1)])
    for name in ("cam.toml", "cam.json"):
        case.save(tmp_path / name)
        back = kp.load(tmp_path / name)
        assert back.model.tree() == m.tree()
        np.testing.assert_array_equal(back.start().q, start.q)
    for other in (pickle.loads(pickle.dumps(m)), pickle.loads(pickle.dumps(m.compile()))):
        np.testing.assert_array_equal(kp.assemble(other, guess={"follower.y": 0.1}).q, start.q)
    sol = kp.dynamics(m, start, t_end=0.1)
    assert sol.drift.position.max() < 1e-9
    assert np.abs(sol.energy.balance).max() < 1e-6


def test_a_bar_and_ground_have_curves() -> None:
    m = kp.Model("slot", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.ground.curves(ring={"circle": (0, 0, 2)})
    m.ground.curves(floor={"line": [(-3, -3), (3, -3)]})
    slot = {"slot": {"line": [(-0.5, 0), (0.5, 0)]}}
    m.bar("arm", mass=1, length=1, ends=("O", "A"), curves=slot)
    m.revolute("O", "ground.O", "arm.O")
    m.point_mass("bead", mass=1)
    m.point_on_curve("slide", "bead.P", "arm.slot")
    start = kp.assemble(m, set={"arm.angle": "30*deg"}, guess={"slide.u": 0.25})
    along = start["bead.x"] * np.cos(np.pi / 6) + start["bead.y"] * np.sin(np.pi / 6)
    assert start["slide.u"] == pytest.approx(along, abs=1e-12)
    assert 0 <= start["slide.u"] <= 1
    infos = m.compile().all_bodies
    assert list(infos["ground"].curves) == ["ring", "floor"]
    assert infos["ground"].curves["floor"] == (((-3.0, -3.0), (3.0, -3.0)), False)
    assert infos["ground"].curves["ring"][1]
    with pytest.raises(kp.ModelError, match="taken by another curve"):
        m.ground.curves(ring={"circle": (0, 0, 1)})


@pytest.mark.parametrize(
    ("curve", "words"),
    [
        ({"circle": (0, 0, "x")}, "unknown name 'x'"),
        ({"circel": (0, 0, 1)}, "did you mean 'circle'"),
        ({"circle": (0, 0, 1), "polar": "1"}, "both polar and circle"),
        ({"points": [(0, 0), (1, 0)]}, "at least 3"),
        ({"polar": "0.1 + 0.2*v"}, "v"),
        ({"points": [(0, 0), (1, 0), (2, 1)], "interpolation": "cubick"}, "cubic"),
    ],
)
def test_faults_of_curves_have_their_place(curve: dict[str, Any], words: str) -> None:
    with pytest.raises(kp.ModelError, match=words) as caught:
        cam(curve).compile()
    assert "bodies.cam.curves.rim" in str(caught.value)


def test_a_value_of_the_wrong_kind_is_refused_at_once() -> None:
    with pytest.raises(kp.ModelError, match=r"bodies.cam.curves.rim.circle\[0\]: nan"):
        cam({"circle": (float("nan"), 0, 1)})
    with pytest.raises(kp.ModelError, match="must be a mapping"):
        cam([1, 2])  # type: ignore[arg-type]


def test_the_contact_cannot_be_set() -> None:
    m = cam(CIRCLE)
    with pytest.raises(kp.ModelError, match=r"contact.u follows the bodies.*guess"):
        kp.assemble(m, set={"contact.u": 1})


def test_the_example_of_a_cam_with_dwell() -> None:
    """Dwells are exact, the normal force is Newton's, and a faster cam lifts the follower off."""
    case = kp.load(ROOT / "examples/cam_roller.toml")
    with warnings.catch_warnings():
        warnings.simplefilter("error", kp.EventWarning)
        sol = case.run()["turn"]
    angle = np.mod(np.pi / 2 + 60 * sol.t, 2 * np.pi)  # of the cam below the roller
    y, inside = sol["follower.y"], 0.25  # the roller touches the rim this near to its direction
    top = (angle > np.radians(100) + inside) & (angle < np.radians(140) - inside)
    base = angle > np.radians(240) + inside
    assert top.sum() > 3 and base.sum() > 30
    np.testing.assert_allclose(y[top], 0.048, rtol=1e-12)
    np.testing.assert_allclose(y[base], 0.038, rtol=1e-11)
    spring = 1500 * (0.06 - (0.12 - y - 0.05))
    vertical = 0.25 * (sol["follower.ay"] + 9.81) + spring
    np.testing.assert_allclose(sol["contact"].force(on="follower")[:, 1], vertical, rtol=1e-9)
    assert sol["contact.normal"].min() > 10
    model = case.model.with_parameters({"speed": 120})
    start = kp.assemble(model, guess={"follower.y": 0.05})
    with pytest.warns(kp.EventWarning, match=r"contact.lift_off"):
        kp.dynamics(model, start, t_end=2 * np.pi / 120)


@pytest.mark.parametrize(
    ("curve", "unit"),
    [
        ({"circle": [0, 0, 0.05]}, "rad"),
        ({"polar": "0.05 + 0.01*cos(u)"}, "rad"),
        ({"line": [[-0.1, 0.05], [0.1, 0.05]]}, "m"),
        ({"points": [[-0.1, 0.05], [-0.03, 0.05], [0.03, 0.05], [0.1, 0.06]]}, "m"),
        ({"x": "0.1*u", "y": "0.05", "range": [-1, 1]}, "1"),
    ],
)
def test_u_has_the_unit_of_its_curve(curve: dict[str, object], unit: str) -> None:
    m = kp.Model("follower")
    m.ground.points(S=(0, 0.2))
    m.ground.curves(rim=curve)
    m.body("follower", mass=1, inertia=1e-3, points={"P": (0, 0)})
    m.translational("guide", "ground.S", "follower.P", axes=["90*deg", "90*deg"])
    m.point_on_curve("contact", "follower.P", "ground.rim")
    start = kp.assemble(m)
    assert start["follower.y"] > 0.04
    assert m.compile().column_units()[-1] == unit
    assert f"contact.u = {start['contact.u']:.6g} {unit}" in " ".join(str(start).split())


def bead_on_a_ring() -> kp.Model:
    """A bead of 0.5 kg on a ring of 0.8 m, with a force along the ring that its parameter gives."""
    m = kp.Model("ring", gravity=(0, 0), parameters={"k": 3.0, "c": 0.4})
    m.ground.curves(ring={"circle": [0.2, -0.1, 0.8]})
    m.point_mass("bead", mass=0.5)
    m.point_on_curve("wire", "bead.P", "ground.ring")
    along = "(-k*wire.u - c*wire.u_rate)"
    m.force("push", "bead.P", force=[f"-{along}*sin(wire.u)", f"{along}*cos(wire.u)"])
    return m


RING_RATE = 0.4 / (2 * 0.5)
#: m R u'' + c u' + k u = 0, where u is an angle and the force is along the ring
RING_OMEGA = math.sqrt(3.0 / (0.5 * 0.8) - (RING_RATE / 0.8) ** 2)


@pytest.mark.parametrize(
    "method",
    [kp.DOP853(rtol=1e-12, atol=1e-14), kp.Radau(rtol=1e-11, atol=1e-13)],
    ids=["dop", "radau"],
)
def test_a_force_may_depend_on_the_parameter_of_a_curve(method: kp.DOP853 | kp.Radau) -> None:
    m = bead_on_a_ring()
    angle = 0.9
    at = {"bead.x": 0.2 + 0.8 * math.cos(angle), "bead.y": -0.1 + 0.8 * math.sin(angle)}
    sol = kp.dynamics(
        m, kp.assemble(m, guess=at, set={"bead.x": at["bead.x"]}), t_end=6, method=method
    )
    decay = RING_RATE / 0.8
    wave = np.cos(RING_OMEGA * sol.t) + decay / RING_OMEGA * np.sin(RING_OMEGA * sol.t)
    exact = angle * np.exp(-decay * sol.t) * wave
    np.testing.assert_allclose(sol["wire.u"], exact, atol=1e-9)


def test_modes_see_the_parameter_of_a_curve_in_laws() -> None:
    m = bead_on_a_ring()
    rest = kp.assemble(m, guess={"bead.x": 1.0, "bead.y": -0.1}, set={"bead.y": -0.1})
    eigenvalue = kp.modes(m, rest).eigenvalues[0]
    assert eigenvalue.real == pytest.approx(-RING_RATE / 0.8, rel=1e-10)
    assert abs(eigenvalue.imag) == pytest.approx(RING_OMEGA, rel=1e-10)


def test_the_law_of_a_driver_may_not_depend_on_the_parameter_of_a_curve() -> None:
    m = bead_on_a_ring()
    m.body("wheel", mass=1, inertia=1)
    m.coordinate_driver("drive", "wheel.angle", value="wire.u")
    with pytest.raises(kp.ModelError, match="laws of forces, conditions and measures may use u"):
        kp.assemble(m)


def pressed(load: str, angle: str = "0") -> tuple[kp.Model, kp.State]:
    """A roller on an eccentric disc; at rest the load on its rod alone makes the normal force."""
    m = kp.Model("pressed")
    m.ground.points(O=(0, 0), S=(0, 0))
    rim = {"rim": {"circle": [0.01, 0, 0.05]}}
    m.body("cam", mass=1, inertia=1, points={"C": (0, 0)}, curves=rim)
    m.body("rod", mass=1, inertia=1, points={"T": (0, 0)})
    m.revolute("O", "ground.O", "cam.C")
    m.translational("guide", "ground.S", "rod.T", axes=("90*deg", "90*deg"))
    m.roller_on_curve("contact", "rod.T", "cam.rim", radius=0.01)
    m.coordinate_driver("motor", "cam.angle", value=angle)
    m.force("push", "rod.T", force=["0", load])
    return m, kp.assemble(m, guess={"rod.y": 0.06})


METHODS = [kp.Auto(), kp.Radau(), kp.RK4(step=0.01), kp.GeneralizedAlpha()]


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
@pytest.mark.parametrize(
    ("load", "times"),
    [("-1", []), ("-t", []), ("-t^2", []), ("1", [0]), ("1 - 4*t", [0]), ("t", [0]), ("t^2", [0])],
)
@pytest.mark.filterwarnings("ignore::kempe.EventWarning")
def test_lift_off_at_the_start(load: str, times: list[float], method: Any) -> None:
    """A force that is negative or becomes so at once is one event at t = 0; zero alone is none."""
    m, start = pressed(load)
    sol = kp.dynamics(m, start, t_end=1, output_step=0.1, method=method)
    found = sol.events["contact.lift_off"].t
    np.testing.assert_array_equal(found, times)
    assert not np.signbit(found).any()  # "t = 0 s", not "t = -0 s"


@pytest.mark.parametrize("angle", ["0", "0.3", "0.001*t"])
def test_generalized_alpha_holds_a_driven_mechanism_on_its_branch(angle: str) -> None:
    """Nothing but the constraints decides the motion, and the steps become long."""
    m, start = pressed("-1", angle)
    grid = {"t_end": 100, "output_step": 1}
    sol = kp.dynamics(m, start, **grid, method=kp.GeneralizedAlpha())
    exact = kp.kinematics(m, start, **grid)
    np.testing.assert_allclose(sol["rod.y"], exact["rod.y"], atol=1e-9)
