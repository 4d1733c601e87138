"""Drivers of the place u of a joint on its curve, against closed forms."""

import math

import kempe as kp
import numpy as np
import pytest

G = 9.81


def bead(size, mass, drive=None):
    """A body on an ellipse, which turns with its place if it is not driven."""
    m = kp.Model("bead", gravity=(0, -G))
    x, y = f"{2 * size}*cos(u)", f"{size}*sin(u)"
    m.ground.curves(wire={"x": x, "y": y, "range": [0, 2 * math.pi], "periodic": True})
    m.body("bead", mass=mass, inertia=0.3 * mass * size**2, points={"P": (0, 0)})
    m.point_on_curve("on", "bead.P", "ground.wire")
    if drive is not None:
        m.coordinate_driver("drive", "on.u", value=drive)
        m.coordinate_driver("upright", "bead.angle", value=0)
    return m


def on_ellipse(size, u):
    """C, C′ and C″ of the ellipse, (2, n) each."""
    c, s = np.cos(u), np.sin(u)
    return size * np.array([[2 * c, s], [-2 * s, c], [-2 * c, -s]])


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("mass", [1e-3, 2.0, 1e3])
def test_a_driven_bead_has_the_forces_of_its_path(size, mass):
    rate = math.sqrt(G / size)
    m = bead(size, mass, f"0.3 + {2 * rate}*t + {rate**2}*t^2")
    start = kp.assemble(m)
    assert kp.mobility(m, start).degrees_of_freedom == 0
    for sol in (
        kp.dynamics(m, start, t_end=4 / rate),
        kp.kinematics(m, start, t_end=4 / rate),
        kp.inverse_dynamics(m, start, t_end=4 / rate),
    ):
        t = rate * sol.t
        u, du, ddu = 0.3 + 2 * t + t**2, rate * (2 + 2 * t), 2 * rate**2
        place, slope, second = on_ellipse(size, u)
        force = mass * (slope * ddu + second * du**2 + np.array([[0.0], [G]]))
        effort = (force * slope).sum(axis=0)
        assert np.abs(sol["on.u"] - u).max() <= 1e-12 * u.max()  # several turns
        assert np.abs(np.array([sol["bead.x"], sol["bead.y"]]) - place).max() <= 1e-9 * size
        assert np.abs(sol["on"].force(on="bead").T - force).max() <= 1e-8 * np.abs(force).max()
        assert np.abs(sol["drive.effort"] - effort).max() <= 1e-8 * np.abs(effort).max()
        power = effort * du
        assert np.abs(sol["drive.power"] - power).max() <= 1e-8 * np.abs(power).max()
        assert sol.newton_euler.largest <= 1e-9
    found = kp.design.duty(kp.inverse_dynamics(m, start, t_end=1 / rate), "drive")
    assert found.effort[0] == pytest.approx(sol["drive.effort"][0], rel=1e-9)


def test_a_place_is_a_driven_quantity_of_other_analyses():
    m = bead(1.0, 2.0)
    m.coordinate_driver("upright", "bead.angle", value=0)
    start = kp.assemble(m, set={"bead.x": 2 * math.cos(0.3)}, guess={"on.u": 0.3})
    over = kp.kinematics(m, start, over="on.u", range=[0.3, 2.0], n=9)
    assert np.abs(over["bead.y"] - np.sin(over.t)).max() < 1e-10
    rest = kp.equilibrium(m, start, hold=["on.u"])
    assert rest.state["on.u"] == pytest.approx(start["on.u"], abs=1e-12)


@pytest.mark.parametrize("size", [1e-2, 1.0, 1e2])
@pytest.mark.parametrize("u", [0.5, 1.3, 2.4])
def test_a_driven_roller_turns_its_cam(size, u):
    """A roller of a vertical follower on an eccentric disc: with ρ the distance of the centres,
    tan φ = (e + ρ cos u) / (ρ sin u), and the effort at rest is m g dh/du."""
    e, radius, roller, mass = 0.4 * size, 1.0 * size, 0.3 * size, 3.0
    m = kp.Model("cam", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body(
        "cam",
        mass=5,
        inertia=size**2,
        points={"O": (0, 0)},
        curves={"rim": {"circle": (e, 0, radius)}},
    )
    m.body("follower", mass=mass, inertia=size**2, points={"R": (0, 0)})
    m.revolute("pin", "ground.O", "cam.O")
    m.translational("guide", "ground.O", "follower.R", axes=("90 deg", "90 deg"))
    m.roller_on_curve("on", "follower.R", "cam.rim", radius=roller)
    m.coordinate_driver("drive", "on.u", value=f"{u} + 0.4*t")
    rho = radius + roller

    def angle(u):
        return np.arctan2(e + rho * np.cos(u), rho * np.sin(u))

    def height(u):
        return e * np.sin(angle(u)) + rho * np.sin(angle(u) + u)

    guess = {"cam.angle": float(angle(u)), "follower.y": float(height(u)), "on.u": u}
    start = kp.assemble(m, guess=guess)
    sol = kp.kinematics(m, start, t_end=1)
    assert np.abs(sol["follower.y"] - height(u + 0.4 * sol.t)).max() <= 1e-10 * size
    turned = sol["cam.angle"] - angle(u + 0.4 * sol.t)
    assert np.abs(turned - turned[0]).max() <= 1e-10
    static = kp.inverse_dynamics(m, start, over="drive", range=[u, u + 0.1], n=2, static=True)
    step = 1e-5
    slope = (
        8 * (height(u + step) - height(u - step)) - height(u + 2 * step) + height(u - 2 * step)
    ) / (12 * step)
    assert static["drive.effort"][0] == pytest.approx(mass * G * slope, rel=1e-7)


@pytest.mark.parametrize("size", [1e-2, 1.0, 1e2])
def test_a_coupling_may_use_a_place(size):
    """A bead that turns by half of the angle u on its ellipse: u̇ = 0 at the start."""
    mass = 2.0
    m = bead(size, mass)
    m.coupling("gearing", terms={"on.u": 1, "bead.angle": -2}, value=0)
    start = kp.assemble(m, set={"bead.angle": 0.2}, guess={"on.u": 0.4})
    _, slope, _ = on_ellipse(size, np.array([start["on.u"]]))
    inertia = mass * (slope**2).sum() + 0.3 * mass * size**2 / 4
    assert start["on.u"] == pytest.approx(0.4, abs=1e-12)
    assert start.a[-1] == pytest.approx(-mass * G * slope[1, 0] / inertia, rel=1e-9)
    sol = kp.dynamics(m, start, t_end=5 * math.sqrt(size / G))
    assert np.abs(sol["on.u"] - 2 * sol["bead.angle"]).max() < 1e-9


@pytest.mark.parametrize("element", ["stop", "generalized_force"])
def test_no_force_acts_along_a_place(element):
    m = bead(1.0, 1.0)
    add = {
        "stop": lambda: m.stop("s", "on.u", lower=0, restitution=0),
        "generalized_force": lambda: m.generalized_force("s", "on.u", value=1),
    }
    add[element]()
    with pytest.raises(kp.ModelError, match=r"no force acts along 'on\.u'"):
        m.compile()
