"""Settling is reported unless drivers determine the motion; places of forces and instants."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe import design
from kempe.design.locate import instants, integral, zeros
from kempe.design.wrenches import loads
from kempe.report import summary


def arm(*, driven: bool, redundancy: str = "refuse", twice: bool = False) -> kp.Model:
    m = kp.Model("arm", gravity=(0, -9.81), redundancy=redundancy)
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1, length=1, ends=("A", "B"))
    m.revolute("O", "ground.O", "arm.A")
    if twice:
        m.revolute("O2", "ground.O", "arm.A")
    if driven:
        m.coordinate_driver("motor", "arm.angle", value="0.5*t")
    return m


@pytest.mark.parametrize(
    ("build", "more", "settles"),
    [
        ({"driven": False}, {}, True),
        ({"driven": True}, {}, False),
        ({"driven": True}, {"release": ["motor"]}, True),
        ({"driven": False, "redundancy": "allow", "twice": True}, {}, True),
        # as many equations as coordinates, of which one adds nothing: the arm is free
        ({"driven": False, "redundancy": "allow"}, {}, True),
    ],
)
def test_settling_is_left_out_where_drivers_determine_the_motion(
    build: dict[str, Any], more: dict[str, Any], settles: bool
) -> None:
    m = arm(**build)
    start = kp.assemble(m, {} if build["driven"] else {"arm.angle": 0.1})
    sol = kp.dynamics(m, start, t_end=0.2, output_step=0.05, **more)
    assert bool(summary(sol)["settling"]) == settles


def test_one_equation_too_many_does_not_drive_a_mechanism() -> None:
    """A slide held twice along the same line: three equations for three coordinates."""
    m = kp.Model("slide", redundancy="allow")
    m.ground.points(O=(0, 0))
    m.body("cart", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "cart.P")
    m.coordinate_driver("level", "cart.y", value=0)
    sol = kp.dynamics(m, kp.assemble(m, {"cart.vx": 1}), t_end=0.1, output_step=0.05)
    assert sol.model.n_rows == sol.model.n_q
    assert [one["body"] for one in summary(sol)["settling"]] == ["cart"]


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("redundancy", ["refuse", "allow"])
def test_only_bodies_that_drivers_leave_free_may_settle(size: float, redundancy: str) -> None:
    """A driven crank moves a cart by a rod; a pendulum hangs on the cart, another one on ground."""
    m = kp.Model("carriage", gravity=(0, -9.81 * size), redundancy=redundancy)
    m.ground.points(O=(0, 0), H=(0, 3 * size))
    inertia = size**2
    for name, length in (("crank", 1), ("rod", 3), ("hung", 1), ("apart", 1)):
        m.bar(name, mass=1, length=length * size, ends=("P", "Q"))
    m.body("cart", mass=1, inertia=inertia, points={"C": (0, 0)})
    m.revolute("O", "ground.O", "crank.P")
    m.revolute("A", "crank.Q", "rod.P")
    m.revolute("B", "rod.Q", "cart.C")
    m.translational("guide", "ground.O", "cart.C")
    if redundancy == "allow":
        m.translational("again", "ground.O", "cart.C")
    m.revolute("C", "cart.C", "hung.P")
    m.revolute("H", "ground.H", "apart.P")
    m.coordinate_driver("motor", "crank.angle", value="1 + t")
    sol = kp.dynamics(m, kp.assemble(m, {"hung.angle": 0, "apart.angle": 0}), t_end=0.1)
    assert [one["body"] for one in summary(sol)["settling"]] == ["hung", "apart"]


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_rod_pulls_at_its_own_point_of_each_body(size: float) -> None:
    m = kp.Model("swing", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("seat", mass=1, inertia=size**2, points={"P": (0.2 * size, 0.1 * size)})
    m.distance("rope", "ground.O", "seat.P", length=size)
    state = kp.assemble(m, {"seat.x": 0.1 * size, "seat.angle": 0.2})
    (of_rope,) = (one for one in loads(state, "seat") if one.name == "rope")
    wanted = state["seat"].point("P").position
    np.testing.assert_allclose(of_rope.place, wanted, atol=1e-12 * size)
    assert np.hypot(*wanted) == pytest.approx(size)
    (at_ground,) = loads(state, "ground")
    np.testing.assert_allclose(at_ground.place, [0, 0], atol=1e-12 * size)


@pytest.mark.parametrize("ends", [(0.1, 0.9), (0.9, 0.1)])
@pytest.mark.parametrize("n", [2, 3, 20])
def test_instants_follow_the_order_of_the_motion(ends: tuple[float, float], n: int) -> None:
    m = arm(driven=True)
    sol = kp.kinematics(m, kp.assemble(m), over="arm.angle", range=ends, n=n)
    t = instants(sol)
    assert (t[0], t[-1]) == pytest.approx(ends)
    assert np.all(np.diff(t) * (ends[1] - ends[0]) > 0.0)
    # the integral of the angle over itself, with an empty part
    found = integral(sol, lambda at: at["arm.angle"], [ends[0], ends[0], ends[1]])
    assert found == pytest.approx([0.0, (ends[1] ** 2 - ends[0] ** 2) / 2.0], abs=1e-12)


def test_polygons_have_the_same_images_at_every_size() -> None:
    """Points at the origin of a frame, and points far from it, occur once for each body."""
    wanted = None
    for size in (1e-3, 1.0, 1e3):
        m = kp.Model("crank-rocker")
        m.ground.points(O=(0, 0), D=(0.4 * size, 0))
        m.body("crank", mass=1, inertia=1, points={"O": (0, 0), "A": (0.12 * size, 0)})
        m.body("coupler", mass=1, inertia=1, points={"A": (0, 0), "B": (0.4 * size, 0)})
        m.body("rocker", mass=1, inertia=1, points={"B": (0, 0), "D": (0.3 * size, 0)})
        m.revolute("O", "ground.O", "crank.O")
        m.revolute("A", "crank.A", "coupler.A")
        m.revolute("B", "coupler.B", "rocker.B")
        m.revolute("D", "rocker.D", "ground.D")
        m.coordinate_driver("motor", "crank.angle", value="5*t")
        guess = {"coupler.angle": "50 deg", "rocker.angle": "-90 deg"}
        state = kp.assemble(m, guess=guess)
        found = design.velocity_polygon(state)
        told = {
            name: tuple(np.round(np.asarray(image) / size, 9))
            for name, image in found.images.items()
        }
        sides = [(side.name, side.part, side.body) for side in found.sides]
        assert len(sides) == len(set(sides))
        wanted = wanted or (told, sides)
        assert sides == wanted[1]
        assert told.keys() == wanted[0].keys() == {"o", "A", "B"}
        for name, image in told.items():
            assert image == pytest.approx(wanted[0][name], abs=1e-8)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_zeros_are_found_wherever_they_lie_between_the_instants(scale: float) -> None:
    m = arm(driven=True)
    sol = kp.kinematics(m, kp.assemble(m), over="arm.angle", range=(0.1, 0.9), n=3)
    for at in np.random.default_rng(38).uniform(0.1, 0.9, 40):

        def read(motion: Any, at: float = at) -> Any:
            return scale * np.sin(np.asarray(motion["arm.angle"]) - at)

        assert zeros(sol, read) == pytest.approx([at], abs=1e-13)


def test_a_cusp_at_the_end_of_a_path_is_no_part_of_its_own() -> None:
    """A wheel of radius r rolls from cusp to cusp: one arch of the cycloid, 8 r."""
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=0.01, points={"C": (0, 0), "P": (0.25, 0)})
    m.rolling("roll", "ground.O", "wheel.C", radius=0.25)
    m.coordinate_driver("d", "wheel.angle", value="-t")
    start = kp.assemble(m, guess={"wheel.y": 0.25})
    ends = (-0.5 * np.pi, -2.5 * np.pi)
    sol = kp.kinematics(m, start, over="wheel.angle", range=ends)
    assert design.coupler_curve(sol, "wheel.P").length == pytest.approx(2.0, rel=1e-12)
