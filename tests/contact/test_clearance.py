"""Pins in bushes against closed forms and motions of the tests' own."""

from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.special import ellipk

EXACT = kp.DOP853(rtol=1e-12, atol=1e-15)
#: Masses in kg, radii of bushes in m, and accelerations of free fall in m/s².
SCALES = [(2.0, 0.02, 9.81), (1e-3, 1e-3, 9.81), (1e3, 1e3, 1e-2)]
#: Clearance over the radius of the bush.
PART = 0.05


def hanging(
    scale: tuple[float, float, float], turned: bool = False, arm: float = 0.0, **fields: Any
) -> kp.Model:
    """A body whose pin is in a bush of ground, or whose bush is around a pin of ground."""
    mass, radius, g = scale
    m = kp.Model("pin in a bush", gravity=(0, -g), parameters={"R": radius, "c": PART * radius})
    m.ground.points(O=(0.3 * radius, -0.2 * radius))
    m.body("disc", mass=mass, inertia=0.7 * mass * radius**2, points={"C": (0, arm)})
    pair = ("disc.C", "ground.O") if turned else ("ground.O", "disc.C")
    m.clearance("B", *pair, radius="R", clearance="c", **fields)
    return m


def at(
    scale: tuple[float, float, float], x: float, y: float, angle: float = 0.0, arm: float = 0.0
) -> dict[str, float]:
    """The disc with its point C at (x, y) from the centre of the bush."""
    radius = scale[1]
    center = np.array([0.3 * radius + x, -0.2 * radius + y])
    x, y = center - arm * np.array([-np.sin(angle), np.cos(angle)])
    return {
        "disc.x": x,
        "disc.y": y,
        "disc.angle": angle,
        "disc.vx": 0,
        "disc.vy": 0,
        "disc.omega": 0,
    }


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("turned", [False, True])
def test_the_depth_under_a_weight(scale: tuple[float, float, float], turned: bool) -> None:
    mass, radius, g = scale
    clearance = PART * radius
    stiffness = mass * g / (0.01 * clearance) ** 1.5
    m = hanging(scale, turned, stiffness=stiffness)
    # a bush hangs on its pin as a pin hangs in its bush
    rest = kp.equilibrium(m, kp.assemble(m, at(scale, 0, -0.5 * clearance))).state
    assert_allclose(rest["disc.y"] + 0.2 * radius, -1.01 * clearance, rtol=1e-9)
    assert_allclose(rest["B.gap"], -0.01 * clearance, rtol=1e-7)
    assert_allclose(rest["B.force"], mass * g, rtol=1e-8)
    # on body j, as the force of a revolute joint
    sign = -1 if turned else 1
    assert_allclose([rest["B.fx"], rest["B.fy"]], [0, sign * mass * g], atol=1e-8 * mass * g)
    # the contact of the same circles
    m.ground.curves(ring={"circle": (0.3 * radius, -0.2 * radius, radius)})
    m.contact("same", "disc.C", "ground.ring", radius="R - c", side="left", stiffness=stiffness)
    if not turned:
        start = kp.assemble(m, from_state=rest)
        assert_allclose(start["same.force"], start["B.force"], rtol=1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_rigid_pin_without_friction_is_a_bead_on_a_circle(
    scale: tuple[float, float, float],
) -> None:
    mass, radius, g = scale
    length, top = PART * radius, 0.8
    m = hanging(scale, restitution=0)
    start = kp.assemble(m, at(scale, length * np.sin(top), -length * np.cos(top)))
    period = 4 * np.sqrt(length / g) * ellipk(np.sin(top / 2) ** 2)
    x = 0.3 * radius
    sol = kp.dynamics(m, start, t_end=2.6 * period, events={"low": f"disc.x - {x}"}, method=EXACT)
    assert_allclose(np.diff(sol.events["low"].t), period / 2, rtol=1e-8)
    low = sol.events["low"].states[0]
    assert_allclose(low["B.force"], mass * g * (3 - 2 * np.cos(top)), rtol=1e-8)
    assert_allclose(sol["B.gap"], 0, atol=1e-9 * radius)
    assert_allclose(sol["disc.omega"], 0, atol=1e-9 * np.sqrt(g / length))


@pytest.mark.parametrize("scale", SCALES)
def test_a_pin_that_rolls_in_its_bush(scale: tuple[float, float, float]) -> None:
    """The length c is shorter by rolling: (m + J/r²) c θ̈ = -m g sin θ."""
    _, radius, g = scale
    length, top = PART * radius, 0.8
    pin = radius - length
    m = hanging(scale, restitution=0, friction=3)
    start = kp.assemble(m, at(scale, length * np.sin(top), -length * np.cos(top)))
    slow = 1 + 0.7 * (radius / pin) ** 2
    period = 4 * np.sqrt(slow * length / g) * ellipk(np.sin(top / 2) ** 2)
    x = 0.3 * radius
    sol = kp.dynamics(m, start, t_end=2.6 * period, events={"low": f"disc.x - {x}"}, method=EXACT)
    assert_allclose(np.diff(sol.events["low"].t), period / 2, rtol=1e-7)
    assert sol["B.sticking"].min() == 1
    # the pin turns against the way of its centre: r φ = -c θ
    theta = np.arctan2(sol["disc.x"] - x, -sol["disc.y"] - 0.2 * radius)
    assert_allclose(pin * sol["disc.angle"], length * (top - theta), atol=1e-8 * length)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("sense", [1, -1])
def test_a_shaft_runs_down_at_the_angle_of_friction(
    scale: tuple[float, float, float], turned: bool, sense: int
) -> None:
    """A turning pin climbs to tan φ = μ; the weight has the arm r sin φ, of a bush R sin φ."""
    mass, radius, g = scale
    mu, length = 0.3, PART * radius
    phi = sense * np.arctan(mu) * (-1 if turned else 1)
    m = hanging(scale, turned, restitution=0, friction=mu)
    place = length * np.array([-np.sin(phi), -np.cos(phi)])
    rate = 40 * np.sqrt(g / radius)
    start = kp.assemble(m, at(scale, *place) | {"disc.omega": sense * rate})
    arm = radius * (1 if turned else 1 - PART) * np.sin(np.arctan(mu))
    slowing = mass * g * arm / (0.7 * mass * radius**2)
    t_end = 0.5 * rate / slowing
    sol = kp.dynamics(m, start, t_end=t_end, method=EXACT)
    assert_allclose(sol["disc.omega"], sense * (rate - slowing * sol.t), atol=1e-8 * rate)
    assert_allclose(sol["disc.x"] - 0.3 * radius, place[0], atol=1e-8 * radius)
    assert_allclose(sol["B.force"], mass * g * np.cos(phi), rtol=1e-8)
    assert_allclose(np.abs(sol["B.tangential"]), mass * g * np.abs(np.sin(phi)), rtol=1e-8)
    heat = 0.5 * 0.7 * mass * radius**2 * rate**2 * 0.75
    assert_allclose(sol["B.dissipated"][-1], heat, rtol=1e-7)


@pytest.mark.parametrize("scale", SCALES)
def test_a_shaft_wears_its_bush(scale: tuple[float, float, float]) -> None:
    mass, radius, g = scale
    mu, length, k = 0.3, PART * radius, 2e-13
    depth = 1e-2 * length
    load = mass * g / np.sqrt(1 + mu**2)
    law = {"stiffness": load / depth, "exponent": 1, "friction": mu, "wear": k}
    m = hanging(scale, **law)
    place = -(length + depth) * np.array([mu, 1]) / np.sqrt(1 + mu**2)
    rate = 10 * np.sqrt(g / radius)
    start = kp.assemble(m, at(scale, *place) | {"disc.omega": rate})
    fine = kp.DOP853(rtol=1e-9, atol=1e-15)
    sol = kp.dynamics(m, start, t_end=4 * np.sqrt(radius / g), method=fine)
    # friction takes the energy μ N s
    lost = 0.5 * 0.7 * mass * radius**2 * (rate**2 - sol["disc.omega"][-1] ** 2)
    assert lost > 0.1 * 0.35 * mass * radius**2 * rate**2
    assert_allclose(sol["B.sliding_distance"][-1], lost / (mu * load), rtol=1e-7)
    assert_allclose(sol["B.wear_volume"][-1], k * lost / mu, rtol=1e-7)
    assert sol["B.sliding_distance"][0] == 0
    m = hanging(scale, restitution=0.5, friction=mu, wear=k)
    with pytest.raises(kp.ModelError, match="wear: the load of a contact with restitution"):
        kp.assemble(m)


def impacts(
    place: np.ndarray, speed: np.ndarray, length: float, e: float, t_end: float
) -> tuple[list[float], np.ndarray]:
    """The times of impacts of a point in a circle, and its last velocity."""
    t, times = 0.0, []
    while True:
        a, b, c = speed @ speed, place @ speed, place @ place - length**2
        step = (-b + np.sqrt(b**2 - a * min(c, 0.0))) / a
        if t + step > t_end:
            return times, speed
        t, place = t + step, place + step * speed
        times.append(t)
        normal = place / length
        place = normal * length
        speed = speed - (1 + e) * (normal @ speed) * normal


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("e", [0.7, 1.0])
def test_impacts_within_the_bush(scale: tuple[float, float, float], e: float) -> None:
    mass, radius, _ = scale
    length = PART * radius
    m = hanging((mass, radius, 0.0), restitution=e)
    place, speed = length * np.array([0.2, -0.3]), length * np.array([1.0, 0.4])
    start = at(scale, *place) | {"disc.vx": speed[0], "disc.vy": speed[1]}
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=17, method=EXACT)
    times, last = impacts(place, speed, length, e, 17.0)
    assert len(times) >= 7
    assert_allclose(sol.events["B.hit"].t, times, rtol=1e-9)
    assert_allclose([sol["disc.vx"][-1], sol["disc.vy"][-1]], last, rtol=1e-8)
    lost = 0.5 * mass * (speed @ speed - last @ last)
    assert_allclose(sol.energy.dissipated[-1], lost, rtol=1e-8, atol=1e-12 * mass * speed @ speed)


@pytest.mark.parametrize("scale", SCALES)
def test_a_body_that_hangs_in_a_bush_is_a_double_pendulum(
    scale: tuple[float, float, float],
) -> None:
    mass, radius, g = scale
    length, arm = PART * radius, 3 * radius
    m = hanging(scale, arm=arm, restitution=0)
    theta, angle = 0.4, -0.3
    start = at(scale, length * np.sin(theta), -length * np.cos(theta), angle, arm)
    t_end = 8 * np.sqrt(radius / g)
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=t_end, output_step=t_end / 50, method=EXACT)
    inertia = 0.7 * mass * radius**2

    def slopes(_: float, y: Any) -> Any:
        a, b, ra, rb = y
        mixed = mass * length * arm * np.cos(a - b)
        twist = mass * length * arm * np.sin(a - b)
        matrix = [[mass * length**2, mixed], [mixed, inertia + mass * arm**2]]
        forces = [
            -twist * rb**2 - mass * g * length * np.sin(a),
            twist * ra**2 - mass * g * arm * np.sin(b),
        ]
        return [ra, rb, *np.linalg.solve(matrix, forces)]

    y0, tight = [theta, angle, 0, 0], {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    truth = solve_ivp(slopes, (0, t_end), y0, t_eval=sol.t, **tight).y
    x = 0.3 * radius + length * np.sin(truth[0]) + arm * np.sin(truth[1])
    assert not sol.events["B.release"].t.size
    assert_allclose(sol["disc.x"], x, atol=1e-7 * radius)
    assert_allclose(sol["disc.angle"], truth[1], atol=1e-7)


def crank(ideal: bool = False, **fields: Any) -> kp.Model:
    """A slider-crank at constant speed with clearance between crank and coupler."""
    m = kp.Model("slider-crank", gravity=(0, 0), parameters={"w": 30.0})
    m.ground.points(O=(0, 0), S=(0, 0))
    m.bar("crank", length=0.05, mass=0.3, ends=("O", "A"))
    m.bar("rod", length=0.12, mass=0.21, ends=("A", "B"))
    m.body("block", mass=0.14, inertia=1e-4, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.translational("slide", "ground.S", "block.B")
    m.revolute("wrist", "rod.B", "block.B")
    m.coordinate_driver("motor", "crank.angle", value="w*t")
    if ideal:
        m.revolute("pin", "crank.A", "rod.A")
    else:
        m.clearance("pin", "crank.A", "rod.A", **fields)
    return m


def test_a_slider_crank_with_clearance() -> None:
    """Compliant impacts in the crank pin, against two coordinates of the test's own."""
    radius, c, k, damping, w = 0.01, 5e-4, 5e8, 0.4, 30.0
    rest = kp.assemble(crank(ideal=True))
    m = crank(radius=radius, clearance=c, stiffness=k, damping=damping)
    start = kp.assemble(m, from_state=rest)
    t_end = 0.05
    sol = kp.dynamics(m, start, t_end=t_end, output_step=1e-3, method=EXACT)
    rod, block, length = 0.21, 0.14, 0.12

    def force(t: float, y: Any) -> Any:
        s, phi, vs, rate = y
        along = np.array([np.cos(phi), np.sin(phi)])
        across = np.array([-along[1], along[0]])
        arm, turn = 0.05 * np.array([np.cos(w * t), np.sin(w * t)]), w * t
        d = np.array([s, 0]) - length * along - arm
        v = np.array([vs, 0]) - length * rate * across
        v = v - 0.05 * w * np.array([-np.sin(turn), np.cos(turn)])
        size = np.hypot(*d)
        depth = size - c
        if depth <= 0:
            return np.zeros(2), along, across
        out = d / size
        return -out * max(0.0, k * depth**1.5 * (1 + damping * (out @ v))), along, across

    def slopes(t: float, y: Any) -> Any:
        f, along, across = force(t, y)
        half = 0.5 * length
        mixed = -rod * half * across[0]
        matrix = [[rod + block, mixed], [mixed, rod * length**2 / 3]]
        push = [f[0] + rod * half * -along[0] * y[3] ** 2, -length * across @ f]
        return [y[2], y[3], *np.linalg.solve(matrix, push)]

    y0 = [start["block.x"], start["rod.angle"], start["block.vx"], start["rod.omega"]]
    truth = solve_ivp(
        slopes, (0, t_end), y0, t_eval=sol.t, method="RK45", rtol=1e-9, atol=1e-12, max_step=1e-5
    ).y
    assert len(sol.events["pin.hit"].t) >= 3
    assert_allclose(sol["block.x"], truth[0], atol=1e-7)
    assert_allclose(sol["rod.angle"], truth[1], atol=1e-6)
    assert np.abs(sol.energy.balance).max() < 1e-9
    assert sol.newton_euler.largest < 1e-9


def test_what_is_refused() -> None:
    scale = SCALES[0]
    for field, value, words in [
        ("radius", -1.0, "radius: -1 m; must be > 0"),
        ("clearance", 0, "use revolute"),
        ("clearance", 0.02, "must be below radius, 0.02 m"),
        ("clearance", 1e-11, "must be above"),
        ("friction", -0.1, "friction: must not be negative"),
        ("restitution", 1.5, "must be from 0 to 1"),
    ]:
        m = kp.Model("bad")
        m.ground.points(O=(0, 0))
        m.body("disc", mass=1, inertia=1, points={"C": (0, 0)})
        given = {"radius": 0.02, "clearance": 1e-3, "restitution": 0.5, field: value}
        m.clearance("B", "ground.O", "disc.C", **given)
        with pytest.raises(kp.ModelError, match=words):
            kp.assemble(m)
    m = hanging(scale)
    with pytest.raises(kp.ModelError, match=r"joints\.B\.stiffness: missing"):
        kp.assemble(m)
    for law in ({"stiffness": 1e8}, {"restitution": 0.5}):
        m = hanging(scale, **law)
        with pytest.raises(kp.AssemblyError, match=r"joint B: the depth .* is -0\.030000 m"):
            kp.assemble(m, at(scale, 0.05, 0))
    m = hanging(scale, restitution=0.5)
    start = kp.assemble(m, at(scale, 0.0015, 0))
    with pytest.raises(kp.AssemblyError, match=r"beyond B .* its gap is -5\.000e-4"):
        kp.dynamics(m, start, t_end=1)


def test_a_pin_with_a_small_clearance_carries_the_force_of_a_revolute_joint() -> None:
    forces = []
    for ideal in (True, False):
        m = kp.Model("pendulum", gravity=(0, -9.81))
        m.ground.points(O=(0, 0))
        m.bar("rod", mass=2, length=1, ends=("O", "E"))
        if ideal:
            m.revolute("B", "ground.O", "rod.O")
        else:
            m.clearance("B", "ground.O", "rod.O", radius=0.01, clearance=1e-5, stiffness=1e11)
        angle, depth = -0.9, 1e-5
        start = {"rod.angle": angle, "rod.omega": 3}
        if not ideal:
            out = np.array([0.5 * np.cos(angle), 0.5 * np.sin(angle) - depth])
            speed = 1.5 * np.array([-np.sin(angle), np.cos(angle)])
            start |= {"rod.x": out[0], "rod.y": out[1], "rod.vx": speed[0], "rod.vy": speed[1]}
        sol = kp.dynamics(m, kp.assemble(m, start), t_end=0.3)
        forces.append([np.trapezoid(sol[f"B.{name}"], sol.t) for name in ("fx", "fy")])
    assert_allclose(forces[1], forces[0], rtol=0.05)


@pytest.mark.parametrize("scale", SCALES)
def test_a_stiff_pin_with_friction_rattles(scale: tuple[float, float, float]) -> None:
    """Its modes end at each release, where the gap is a rounding error."""
    mass, radius, g = scale
    stiffness = 1613 * mass * g / (PART * radius) ** 1.5
    speed = 1 / np.sqrt(g * PART * radius)
    m = hanging(scale, arm=25 * radius, friction=0.1, stiffness=stiffness, damping=0.1 * speed)
    start = at(scale, 0, -PART * radius, arm=25 * radius)
    start["disc.vx"] = np.sqrt(g * radius)
    t_end, fine = 11 * np.sqrt(radius / g), kp.DOP853(rtol=1e-9, atol=1e-15)
    sol = kp.dynamics(m, kp.assemble(m, start), t_end=t_end, method=fine)
    assert len(sol.events["B.release"].t) > 3
    assert np.abs(sol.energy.balance).max() < 1e-4 * mass * g * radius
    assert (np.abs(sol["B.tangential"]) <= 0.1001 * sol["B.force"] + 1e-6 * mass * g).all()


def test_a_case_without_equations_shows_an_empty_jacobian(tmp_path: Path) -> None:
    m = hanging(SCALES[0], stiffness=1e9)
    path = tmp_path / "pin.toml"
    kp.Case(m, {"set": {"disc.x": 0.006, "disc.y": -0.0045, "disc.angle": 0}}).save(path)
    assert "0 × 3" in kempe("show", path).stdout
    # the file keeps the joint in its section
    assert "[joints.B]" in path.read_text("utf-8")
    assert kp.load(path).start()["B.gap"] > 0
