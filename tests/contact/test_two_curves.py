"""Contacts of two smooth curves, or of one with a line or polygon, against own programs."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize, minimize_scalar
from sizes import count

G = 9.81
TURN = 2 * np.pi
#: Masses and sizes.
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]
#: Half axes of ellipses.
ROUND, THIN = (0.5, 0.3), (0.7, 0.1)
EGG = "0.3 + 0.05*cos(u) + 0.01*cos(2*u)"
TRIANGLE = [(-0.3, -0.2), (0.4, -0.1), (-0.1, 0.35)]
POSES = ["x", "y", "angle"]
RATES = ["vx", "vy", "omega"]


def ellipse(half: tuple[float, float], size: float = 1.0, sign: int = 1) -> dict[str, Any]:
    a, b = half
    x, y = f"{a * size!r}*cos(u)", f"{sign * b * size!r}*sin(u)"
    return {"x": x, "y": y, "range": [0, "2*pi"], "periodic": True}


def on_ellipse(half: tuple[float, float], u: Any) -> Any:
    return np.array([half[0] * np.cos(u), half[1] * np.sin(u)])


def on_egg(u: Any) -> Any:
    return (0.3 + 0.05 * np.cos(u) + 0.01 * np.cos(2 * u)) * np.array([np.cos(u), np.sin(u)])


def placed(pose: Any, points: Any) -> Any:
    x, y, angle = pose
    c, s = np.cos(angle), np.sin(angle)
    return np.array([x + c * points[0] - s * points[1], y + s * points[0] + c * points[1]])


def posed(body: str, pose: Any, rates: Any = (0, 0, 0)) -> dict[str, float]:
    values = [*pose, *rates]
    return {f"{body}.{k}": float(v) for k, v in zip(POSES + RATES, values, strict=True)}


def pair(one: Any, other: Any, **fields: Any) -> kp.Model:
    m = kp.Model("pair")
    m.body("a", mass=2, inertia=0.3, curves={"rim": one})
    m.body("b", mass=3, inertia=0.5, curves={"rim": other})
    m.contact("touch", curves=["a.rim", "b.rim"], **(fields or {"restitution": 0}))
    return m


def sides(corners: Any) -> list[Any]:
    """The sides of a polygon as functions of 0 to 1."""
    ends = np.array(corners, dtype=float)
    both = zip(ends, np.roll(ends, -1, axis=0), strict=True)
    return [lambda t, p=p, q=q: p[:, None] + np.outer(q - p, np.atleast_1d(t)) for p, q in both]


def separation(parts_i: Any, parts_j: Any) -> float:
    """The largest distance between two parallel lines that part two convex bodies, from many
    points of both. Negative if the bodies overlap."""
    i, j = np.hstack(parts_i), np.hstack(parts_j)

    def apart(theta: float) -> float:
        n = np.array([np.cos(theta), np.sin(theta)])
        return float((n @ i).min() - (n @ j).max())

    step = TURN / 720
    all_around = [apart(step * k) for k in range(720)]
    best = step * int(np.argmax(all_around))
    found = minimize_scalar(
        lambda theta: -apart(theta), bounds=(best - step, best + step), options={"xatol": 1e-10}
    )
    return float(-found.fun)


def extreme(half: Any, pose: Any, theta: float) -> Any:
    """The place of an ellipse that is farthest in a direction."""
    own = np.array(half) * [np.cos(theta - pose[2]), np.sin(theta - pose[2])]
    return placed(pose, np.array(half) * own / np.hypot(*own))


def touch(i: Any, j: Any) -> tuple[float, float]:
    """The direction of the normal away from ellipse j, and the gap."""

    def both(theta: float) -> Any:
        n = np.array([np.cos(theta), np.sin(theta)])
        d = extreme(*i, theta + np.pi) - extreme(*j, theta)
        return n @ d, n[0] * d[1] - n[1] * d[0]

    best = max(np.linspace(0, TURN, 2000), key=lambda theta: both(theta)[0])
    theta = brentq(lambda theta: both(theta)[1], best - 0.01, best + 0.01, xtol=1e-15)
    return theta, both(theta)[0]


def distance(i: Any, j: Any) -> float:
    """The distance of two curves (function, range), by a minimum over both parameters."""

    def squared(places: Any) -> float:
        d = i[0](places[0]) - j[0](places[1])
        return float(np.sum(d**2))

    us, ws = np.linspace(*i[1], 200), np.linspace(*j[1], 200)
    p, q = (of[0](places).reshape(2, -1) for of, places in ((i, us), (j, ws)))
    far = np.hypot(p[0][:, None] - q[0], p[1][:, None] - q[1])
    k, n = np.unravel_index(far.argmin(), far.shape)
    found = minimize(
        squared,
        [us[k], ws[n]],
        bounds=[i[1], j[1]],
        method="L-BFGS-B",
        options={"ftol": 0, "gtol": 1e-14},
    )
    return float(np.sqrt(found.fun))


@pytest.mark.parametrize("size", [1.0, 1e3, 1e-3])
def test_the_gap_of_two_ellipses(size: float) -> None:
    m = pair(ellipse(ROUND, size), ellipse(THIN, size, sign=-1), restitution=0)
    with pytest.raises(kp.ModelError, match="other side"):
        kp.assemble(m)
    m = kp.Model("pair")
    m.body("a", mass=2, inertia=0.3, curves={"rim": ellipse(ROUND, size)})
    m.body("b", mass=3, inertia=0.5, curves={"rim": ellipse(THIN, size, sign=-1)})
    given = {"curves": ["a.rim", "b.rim"], "sides": ["right", "left"]}
    m.contact("touch", **given, restitution=0)
    rng, whole = np.random.default_rng(2), (-4.0, 10.0)
    apart = 0
    for _ in range(count(40, 400)):
        i, j = (rng.uniform(-1, 1, 3) * [1, 1, 9] for _ in range(2))
        start = posed("a", i * [size, size, 1]) | posed("b", j * [size, size, 1])
        gap = kp.assemble(m, set=start)["touch.gap"] / size
        if gap > 0:
            far = distance(
                (lambda u, i=i: placed(i, on_ellipse(ROUND, u)), whole),
                (lambda u, j=j: placed(j, on_ellipse(THIN, u)), whole),
            )
            assert gap == pytest.approx(far, abs=1e-9)
            apart += 1
        else:
            u = np.linspace(0, TURN, 20000)
            curves = [placed(i, on_ellipse(ROUND, u))], [placed(j, on_ellipse(THIN, u))]
            assert gap == pytest.approx(separation(*curves), abs=1e-6)
    assert apart > 10


def test_the_gaps_of_other_curves() -> None:
    u = np.linspace(0, TURN, 60, endpoint=False)
    points = [tuple(map(float, p)) for p in on_ellipse(ROUND, u).T]
    flank = {"x": "0.4*cos(u)", "y": "0.2*sin(u)", "range": [-0.4, 1.7]}
    fine = np.linspace(0, TURN, 4000)
    arc = on_ellipse((0.4, 0.2), np.linspace(-0.4, 1.7, 4000))
    triangle = np.hstack([side(np.array([0.0, 1.0])) for side in sides(TRIANGLE)])
    # the body of a line lies behind it, on its left
    ends = np.array([[-0.5, 1.0], [0.3, 0.2]])
    line = np.hstack([ends, ends + 50 * np.array([[0.1], [1.5]])])
    known = {
        "points": ({"points": points, "periodic": True}, on_ellipse(ROUND, fine), True),
        "polar": ({"polar": EGG}, on_egg(fine), True),
        "arc": (flank, arc, True),
        "triangle": ({"polygon": TRIANGLE}, triangle, False),
        "line": ({"line": [(-0.5, 0.3), (1.0, 0.2)]}, line, False),
    }
    rng = np.random.default_rng(5)
    seen = 0
    for one in known:
        for other in known:
            if not (known[one][2] or known[other][2]):
                continue
            m = pair(known[one][0], known[other][0])
            for _ in range(count(6, 60)):
                poses = [rng.uniform(-1, 1, 3) * [1, 1, 9] for _ in range(2)]
                start = posed("a", poses[0]) | posed("b", poses[1])
                gap = kp.assemble(m, set=start)["touch.gap"]
                curves = [placed(poses[0], known[one][1])], [placed(poses[1], known[other][1])]
                far = separation(*curves)
                assert gap == pytest.approx(far, abs=3e-6), (one, other)
                seen += far > 0
    assert seen > 50


@pytest.mark.parametrize("order", [1, -1])
def test_the_depth_of_an_ellipse_on_a_line(order: int) -> None:
    m = kp.Model("plate")
    m.ground.curves(floor={"line": ((9, 0), (-9, 0))})
    m.body("a", mass=1, inertia=1, curves={"rim": ellipse(THIN)})
    m.contact("touch", curves=["a.rim", "ground.floor"][::order], stiffness=1e4, exponent=1)
    rng = np.random.default_rng(3)
    for angle, depth in zip(rng.uniform(-9, 9, 20), rng.uniform(-0.1, 0.1, 20), strict=True):
        height = np.hypot(0.7 * np.sin(angle), 0.1 * np.cos(angle))
        state = kp.assemble(m, set=posed("a", (0.3, height - depth, angle)))
        assert state["touch.gap"] == pytest.approx(-depth, abs=1e-14)


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


def roughly_apart(i: Any, j: Any) -> float:
    """As `separation`, over some directions only: at most that, and less by 1e-3 at most."""
    theta = np.linspace(0, TURN, 360, endpoint=False)
    n = np.array([np.cos(theta), np.sin(theta)]).T
    return float(((n @ i).min(axis=1) - (n @ j).max(axis=1)).max())


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
    for _ in range(count(8, 80)):
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


CONCAVE = {"polar": "0.3 + 0.1*cos(2*u)"}
ANGLE = {"polygon": [(-1, -1), (1, -1), (1, -0.4), (-0.3, -0.4), (-0.3, 1), (-1, 1)]}
FLANK = {"x": "u", "y": "-u^2", "range": [-1, 0.5]}


@pytest.mark.parametrize(
    ("one", "other", "fields", "words"),
    [
        (CONCAVE, ellipse(ROUND), {}, "bulges outward, but not for u = "),
        (ellipse(ROUND), CONCAVE, {}, "the curve of body j"),
        (ellipse(ROUND), {"circle": (0, 0, 2)}, {"sides": ["right", "left"]}, "inside a circle"),
        (ellipse(ROUND), ellipse(THIN), {"friction": 0.1}, "give velocity"),
        (ellipse(ROUND), FLANK, {"stiffness": 1.0, "sides": ["right", "left"]}, "is open"),
        (ellipse(ROUND), FLANK, {}, "other side"),
        (ellipse(ROUND), ANGLE, {"stiffness": 1.0}, "inward corners"),
        ({**ellipse(ROUND), "range": [0, "4*pi"]}, ellipse(THIN), {}, "winds around"),
        (ellipse(ROUND), {"x": "cos(u)", "y": "sin(u)", "range": [0, 9]}, {}, "winds around"),
    ],
)
def test_refused_curves(one: Any, other: Any, fields: Any, words: str) -> None:
    law = {} if "stiffness" in fields else {"restitution": 0.5}
    with pytest.raises(kp.ModelError, match=words):
        kp.assemble(pair(one, other, **fields, **law))
