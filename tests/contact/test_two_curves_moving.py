"""Motions of bodies that touch along smooth curves, against own programs."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from contact.convex import (
    EGG,
    POSES,
    RATES,
    ROUND,
    SCALES,
    THIN,
    TURN,
    G,
    distance,
    ellipse,
    extreme,
    on_egg,
    on_ellipse,
    placed,
    posed,
    roughly_apart,
    touch,
)
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from sizes import count


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_an_impact_of_two_ellipses(mass: float, size: float) -> None:
    m = kp.Model("pair")
    inertia = {"a": 0.12 * mass * size**2, "b": 0.3 * mass * size**2}
    weight = {"a": mass, "b": 2 * mass}
    for name, half in [("a", ROUND), ("b", THIN)]:
        rim = {"rim": ellipse(half, size)}
        m.body(name, mass=weight[name], inertia=inertia[name], curves=rim)
    m.contact("touch", curves=["a.rim", "b.rim"], restitution=0.6)
    scale = np.array([size, size, 1])
    start = posed("a", scale * [0, 1, 0.5], scale * [0.1, -1, 0.3])
    start |= posed("b", scale * [0.1, 0, -0.2], scale * [0, 0.2, 1])
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=1.0)
    hit = sol.events["touch.hit"]
    t, before = hit.t[0], hit.states[0]
    pose = {name: np.array([before[f"{name}.{k}"] for k in POSES]) / scale for name in "ab"}
    whole = (-4.0, 10.0)
    curves = [
        (lambda u: placed(pose["a"], on_ellipse(ROUND, u)), whole),
        (lambda u: placed(pose["b"], on_ellipse(THIN, u)), whole),
    ]
    assert distance(*curves) < 1e-5
    theta, _ = touch((ROUND, pose["a"]), (THIN, pose["b"]))
    n = np.array([np.cos(theta), np.sin(theta)])
    place = extreme(THIN, pose["b"], theta)
    mass_of = [mass, mass, inertia["a"], 2 * mass, 2 * mass, inertia["b"]]
    arms = [size * (place - pose[name][:2]) for name in "ab"]
    lever = [arm[0] * n[1] - arm[1] * n[0] for arm in arms]
    row = np.array([*n, lever[0], *-n, -lever[1]])
    names = [f"{name}.{k}" for name in "ab" for k in RATES]
    v = np.array([before[name] for name in names])
    expected = v - 1.6 * (row @ v) / (row**2 / mass_of).sum() * row / mass_of
    after = np.array([sol(t)[name] for name in names])
    assert_allclose(after / np.tile(scale, 2), expected / np.tile(scale, 2), rtol=0, atol=1e-9)
    assert after @ row == pytest.approx(-0.6 * (row @ v), rel=1e-9)


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_an_ellipse_slides_on_a_plate(mass: float, size: float) -> None:
    a, b = 0.5 * size, 0.3 * size
    inertia = 0.2 * mass * size**2
    m = kp.Model("plate", gravity=(0, -G))
    m.ground.curves(floor={"line": ((90 * size, 0), (-90 * size, 0))})
    m.body("e", mass=mass, inertia=inertia, curves={"rim": ellipse(ROUND, size)})
    m.contact("touch", curves=["e.rim", "ground.floor"], restitution=0)

    def height(q: float) -> tuple[float, float, float]:
        s, c = np.sin(q), np.cos(q)
        h = np.hypot(a * s, b * c)
        slope = (a**2 - b**2) * s * c / h
        return h, slope, ((a**2 - b**2) * (c**2 - s**2) - slope**2) / h

    def rates(_: float, y: Any) -> list[float]:
        q, w = y
        _, g1, g2 = height(q)
        return [w, -mass * g1 * (g2 * w**2 + G) / (inertia + mass * g1**2)]

    q, w = 0.4, 0.5 / np.sqrt(size)
    h, slope, _ = height(q)
    speed = np.sqrt(size)
    start = posed("e", (0, h, q), (0.7 * speed, slope * w, w))
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=2 * speed)
    known = solve_ivp(rates, (0, 2 * speed), [q, w], rtol=1e-11, atol=1e-12, t_eval=sol.t)
    assert_allclose(sol["e.angle"], known.y[0], rtol=0, atol=1e-8)
    assert_allclose(sol["e.x"] / size, 0.7 * speed * sol.t / size, rtol=0, atol=1e-9)
    shapes = np.array([height(x) for x in known.y[0]]).T
    turn = np.array([rates(0, y)[1] for y in known.y.T])
    force = mass * (G + shapes[1] * turn + shapes[2] * known.y[1] ** 2)
    assert_allclose(sol["touch.force"] / (mass * G), force / (mass * G), rtol=0, atol=1e-7)
    assert not len(sol.events["touch.release"].t)


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_cam_turns_a_cam(mass: float, size: float) -> None:
    inertia = 0.1 * mass * size**2
    speed = 2 / np.sqrt(size)
    m = kp.Model("cams")
    points = {"C": (0.1 * size, 0)}
    m.body("drive", mass=mass, inertia=inertia, points=points, curves={"rim": ellipse(ROUND, size)})
    m.body("cam", mass=mass, inertia=inertia, points=points, curves={"rim": ellipse(THIN, size)})
    m.ground.points(A=(0, 0), B=(0.9 * size, 0))
    m.revolute("left", "ground.A", "drive.C")
    m.revolute("right", "ground.B", "cam.C")
    m.coordinate_driver("motor", "drive.angle", value=f"0.3 + {float(speed)!r}*t")
    m.torsion_spring("spring", "ground", "cam", stiffness=5 * mass * G * size, free_angle=0)
    m.contact("touch", curves=["drive.rim", "cam.rim"], restitution=0)

    def gap(turned: float, angle: float) -> float:
        def center(angle: float) -> Any:
            return 0.1 * np.array([np.cos(angle), np.sin(angle)])

        i, j = -center(turned), [0.9, 0] - center(angle)
        return touch((ROUND, (*i, turned)), (THIN, (*j, angle)))[1]

    first = brentq(lambda x: gap(0.3, x), 0, 1.57)
    start = {"drive.angle": 0.3, "cam.angle": first + 1e-9}
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=1.2 / speed)
    touches = np.flatnonzero(sol.t > sol.events["touch.hit"].t[0])
    assert sol["touch.force"][touches].min() > 0
    for k in touches[:: max(1, len(touches) // 6)]:
        turned = sol["drive.angle"][k]
        assert turned == pytest.approx(0.3 + speed * sol.t[k], abs=1e-9)
        assert gap(turned, sol["cam.angle"][k]) == pytest.approx(0, abs=2e-9)
    assert np.abs(sol.energy.balance).max() < 1e-7 * mass * G * size


def test_the_energy_of_a_rolling_egg() -> None:
    m = kp.Model("egg", gravity=(0, -G))
    m.body("egg", mass=2, inertia=0.1, curves={"rim": {"polar": EGG}})
    fields = {"stiffness": 1e4, "exponent": 1.5, "damping": 0.3, "friction": 0.4}
    m.ground.curves(mound={"points": mound(), "periodic": True})
    m.contact("touch", curves=["egg.rim", "ground.mound"], velocity=0.02, **fields)
    start = kp.assemble(m, set=posed("egg", (0.1, 0.5, 0.3), (0.5, 0, 0)))
    sol = kp.dynamics(m, start, t_end=1.5)
    assert len(sol.events["touch.hit"].t) > 1
    assert np.abs(sol.energy.balance).max() < 1e-5 * 2 * G * 0.5
    assert sol.energy.dissipated[-1] > 0.1
    assert np.abs(sol["touch.tangential"]).max() > 0.1


def mound() -> list[tuple[float, float]]:
    """A wide ellipse whose top is the origin."""
    u = np.linspace(0, TURN, 40, endpoint=False)
    return [(float(2 * np.cos(v)), float(0.4 * np.sin(v) - 0.4)) for v in u]


def test_no_touch_is_missed() -> None:
    """Bodies fall fast on others and on a narrow table, turning; none passes into another."""
    fine = np.linspace(0, TURN, 300)
    shapes = {
        "round": (ellipse(ROUND), on_ellipse(ROUND, fine)),
        "thin": (ellipse(THIN), on_ellipse(THIN, fine)),
        "egg": ({"polar": EGG}, on_egg(fine)),
    }
    table = np.array([[-0.8, 0.8, 0.8, -0.8], [-1.0, -1.0, 0.0, 0.0]])
    rng = np.random.default_rng(11)
    hits = 0
    for _ in range(count(4, 80)):
        m = kp.Model("drops", gravity=(0, -G))
        m.ground.curves(table={"polygon": [tuple(map(float, p)) for p in table.T]})
        start = {}
        for k, (name, (rim, _)) in enumerate(shapes.items()):
            m.body(name, mass=1 + k, inertia=0.05 * (1 + k), curves={"rim": rim})
            m.contact(f"{name}_table", curves=[f"{name}.rim", "ground.table"], restitution=0.5)
            pose = [rng.uniform(-0.9, 0.9), 0.8 + 1.6 * k, rng.uniform(-3, 3)]
            rates = [rng.uniform(-0.5, 0.5), rng.uniform(-20, 0), rng.uniform(-40, 40)]
            start |= posed(name, pose, rates)
        names = list(shapes)
        pairs = [(a, b) for k, a in enumerate(names) for b in names[k + 1 :]]
        for a, b in pairs:
            m.contact(f"{a}_{b}", curves=[f"{a}.rim", f"{b}.rim"], restitution=0.5)
        sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=0.4)
        for t in np.linspace(0.01, 0.4, 25):
            state = sol(t)
            places = {
                name: placed([state[f"{name}.{k}"] for k in POSES], shapes[name][1])
                for name in names
            }
            for name in names:
                assert roughly_apart(places[name], table) > -1e-3
            for a, b in pairs:
                assert roughly_apart(places[a], places[b]) > -1e-3
        hits += sum(len(of.t) for name, of in sol.events.items() if name.endswith(".hit"))
    assert hits > 20


def test_curves_in_either_order_move_alike() -> None:
    ends = []
    for order in (1, -1):
        m = kp.Model("pawl", gravity=(0, -G))
        m.ground.curves(
            rack={"polygon": [(-2, -1), (2, -1), (2, 0), (0.5, 0.4), (0.5, 0), (-2, 0)]}
        )
        m.body("e", mass=1, inertia=0.05, curves={"rim": ellipse((0.25, 0.15))})
        m.contact("touch", curves=["e.rim", "ground.rack"][::order], restitution=0.2)
        start = kp.assemble(m, set=posed("e", (-0.4, 0.4, 0.3), (3, 0, -2)))
        sol = kp.dynamics(m, start, t_end=1.0)
        assert sol["touch.gap"].min() > -1e-9
        ends.append([sol[f"e.{k}"][-1] for k in POSES + RATES])
    assert_allclose(ends[0], ends[1], rtol=0, atol=1e-7)


def test_an_egg_stands_where_its_height_is_least() -> None:
    m = kp.Model("egg", gravity=(0, -G))
    m.ground.curves(floor={"line": ((9, 0), (-9, 0))})
    m.body("egg", mass=2, inertia=0.1, points={"C": (0, 0)}, curves={"rim": {"polar": EGG}})
    m.contact("touch", curves=["egg.rim", "ground.floor"], stiffness=1e5, exponent=1)
    m.ground.points(O=(0, 9))
    m.spring_damper("hold", "ground.O", "egg.C", stiffness=1e-3, free_length=0)
    rest = kp.equilibrium(m, kp.assemble(m, set=posed("egg", (0, 0.3, 1.2)))).state
    assert rest["touch.force"] == pytest.approx(2 * G, rel=1e-3)
    u = np.linspace(0, TURN, 200001)
    x, y = on_egg(u)
    # the height above the floor of the egg at an angle is the largest distance downward
    c, s = np.cos(rest["egg.angle"]), np.sin(rest["egg.angle"])
    lowest = np.argmin(s * x + c * y)
    # upright: the lowest place is below the centre of mass
    assert (c * x - s * y)[lowest] == pytest.approx(0, abs=1e-4)


def test_a_cam_with_lobes_tumbles_on_a_plate() -> None:
    """A hollow cam is divided into its lobes, each an open curve with a contact."""
    radius = "(0.3 + 0.05*cos(3*u))"
    names = [f"lobe{k}" for k in range(3)]
    curves = {}
    for k, name in enumerate(names):
        span = [TURN / 3 * k - 0.62, TURN / 3 * k + 0.62]
        curves[name] = {"x": f"{radius}*cos(u)", "y": f"{radius}*sin(u)", "range": span}
    m = kp.Model("lobes", gravity=(0, -G))
    m.body("cam", mass=1, inertia=0.04, curves=curves)
    m.ground.curves(plate={"line": ((9, 0), (-9, 0))})
    for name in names:
        m.contact(f"on_{name}", curves=[f"cam.{name}", "ground.plate"], restitution=0.4)
    start = posed("cam", (0, 0.5, 0.1), (0.5, 0, 3))
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=1.5)
    u = np.linspace(0, TURN, 4000)
    rim = (0.3 + 0.05 * np.cos(3 * u)) * np.array([np.cos(u), np.sin(u)])
    lowest = [placed([sol(t)[f"cam.{k}"] for k in POSES], rim)[1].min() for t in sol.t]
    assert min(lowest) > -1e-7
    gaps = np.min([sol[f"on_{name}.gap"] for name in names], axis=0)
    assert_allclose(gaps, lowest, rtol=0, atol=1e-6)
    assert sum(len(sol.events[f"on_{name}.hit"].t) for name in names) > 3
    assert np.abs(sol.energy.balance).max() < 1e-8
