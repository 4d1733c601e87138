"""The torques of force elements are about the points at which their forces act."""

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose

#: Sizes in m, and masses in kg.
SIZES = [(1e-3, 1e3), (1.0, 1.0), (1e3, 1e-3)]


def bushing(size: float, mass: float) -> kp.State:
    """A bushing between two free bodies, at points away from their origins."""
    m = kp.Model("mount")
    for name, point in (("base", (0.3 * size, -0.2 * size)), ("engine", (-0.5 * size, 0.4 * size))):
        m.body(name, mass=mass, inertia=0.2 * mass * size**2, points={"P": point})
    stiffness = (8 * mass, 18 * mass, 5 * mass * size**2)
    damping = (3 * mass, 2 * mass, mass * size**2)
    m.bushing("mount", "base.P", "engine.P", stiffness=stiffness, damping=damping)
    at = {"base.angle": 0.7, "engine.angle": -0.4, "base.omega": 2.0, "engine.omega": -1.0}
    lengths = {"engine.x": 1.1, "engine.y": 0.6, "base.vx": 0.3, "engine.vy": -0.8}
    return kp.assemble(m, set=at | {name: part * size for name, part in lengths.items()})


@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_a_bushing_has_the_torque_of_its_law_about_its_point(size: float, mass: float) -> None:
    state = bushing(size, mass)
    view, unit = state.force("mount"), mass * size**2
    turned, rate = -0.4 - 0.7, -1.0 - 2.0
    torque = -(5 * turned + 1 * rate) * unit
    assert view.torque(on="engine") == pytest.approx(torque, rel=1e-12)
    assert view.torque(on="base") == pytest.approx(-torque, rel=1e-12)
    assert state["mount.torque"] == pytest.approx(torque, rel=1e-12)
    assert view.stiffness_torque(on="engine") == pytest.approx(-5 * turned * unit, rel=1e-12)
    place = state.body("engine").point("P").position
    for on in ("base", "engine"):
        assert_allclose(view.place(on=on), place, rtol=1e-12, atol=1e-12 * size)


@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_moments_about_the_mass_centres_follow(size: float, mass: float) -> None:
    """J α = T + (P - r) × F, and the power is that on both bodies at the point."""
    state = bushing(size, mass)
    view, power = state.force("mount"), 0.0
    for on in ("base", "engine"):
        body, force = state.body(on), np.asarray(view.force(on=on))
        arm = view.place(on=on) - body.r
        moment = view.torque(on=on) + arm[0] * force[1] - arm[1] * force[0]
        assert moment == pytest.approx(0.2 * mass * size**2 * body.alpha, rel=1e-10)
        velocity = body.velocity + body.omega * np.array([-arm[1], arm[0]])
        power += force @ velocity + view.torque(on=on) * body.omega
    assert view.power == pytest.approx(power, rel=1e-12)
    assert state["mount.power"] == pytest.approx(power, rel=1e-12)


@pytest.mark.parametrize(("size", "mass"), SIZES)
def test_forces_at_points_have_no_torque_about_them(size: float, mass: float) -> None:
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), A=(-1.2 * size, 0.3 * size))
    m.ground.curves(floor={"line": [[-5 * size, -0.29 * size], [5 * size, -0.29 * size]]})
    m.bar("rod", mass=mass, length=size, ends=("O", "P"))
    m.body("block", mass=mass, inertia=mass * size**2, points={"S": (0.1 * size, 0.2 * size)})
    m.revolute("O", "ground.O", "rod.O")
    m.translational("slide", "rod.O", "block.S")
    m.spring_damper("spring", "ground.A", "rod.P", stiffness=100 * mass, damping=2 * mass)
    m.actuator("ram", "ground.A", "rod.P", force=7 * mass)
    m.force("load", "rod.P", force=(3 * mass, 4 * mass))
    m.friction("rub", "slide", kinetic=0.3, velocity=0.1 * size)
    contact = {"stiffness": 1e4 * mass, "friction": 0.2, "velocity": 0.1 * size}
    m.contact("touch", "rod.P", "ground.floor", radius=0.3 * size, **contact)
    start = {"rod.angle": "-10*deg", "rod.omega": 2.0, "slide.displacement": 0.6 * size}
    state = kp.assemble(m, set=start | {"slide.rate": -0.4 * size})
    for name in ("spring", "ram", "load", "rub", "touch"):
        view = state.force(name)
        for on in (view.info.i, view.info.j):
            force = np.hypot(*view.force(on=on))
            assert force > 0.01 * mass, name
            assert abs(view.torque(on=on)) <= 1e-14 * force * size, (name, on)
        assert abs(state[f"{name}.torque"]) <= 1e-14 * force * size
    low = state.body("rod").point("P").position - [0, 0.3 * size]
    assert_allclose(state.force("touch").place(on="rod"), [low[0], -0.29 * size], rtol=1e-9)
    assert_allclose(
        state.force("rub").place(on="rod"), state.body("block").point("S").position, rtol=1e-12
    )


def test_an_element_without_points_acts_at_the_origin() -> None:
    m = kp.Model()
    m.body("wheel", mass=1, inertia=2, points={"P": (1, 0)})
    m.torque("drive", "wheel", torque=3)
    state = kp.assemble(m, set={"wheel.x": 4.0, "wheel.angle": 1.0})
    assert_allclose(state.force("drive").place(on="wheel"), [4, 0])
    assert state.force("drive").torque(on="wheel") == 3
    with pytest.raises(kp.ModelError, match="wheel"):
        state.force("drive").place(on="hub")
