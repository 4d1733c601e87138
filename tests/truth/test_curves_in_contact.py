"""Contacts of two curves, with polygons and circles, against closed forms and own programs."""

from itertools import pairwise
from typing import Any

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

G = 9.81
#: Masses and sizes.
SCALES = [(1.0, 1.0), (1e-3, 1e3), (1e3, 1e-3)]
STAR = [
    (r * np.cos(a), r * np.sin(a))
    for r, a in zip([1, 0.4] * 5, np.pi / 5 * np.arange(10), strict=False)
]
ANGLE = [(-1, -1), (1, -1), (1, -0.4), (-0.3, -0.4), (-0.3, 1), (-1, 1)]
FORK = [(-1, -1), (1, -1), (1, 1), (0.3, 1), (0.3, -0.2), (-0.3, -0.2), (-0.3, 1), (-1, 1)]
SQUARE = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]


def scaled(corners: Any, size: float) -> list[tuple[float, float]]:
    return [(float(x) * size, float(y) * size) for x, y in corners]


def rectangle(width: float, height: float) -> list[tuple[float, float]]:
    return [(x * width, y * height) for x, y in SQUARE]


def tilted(angle: float, size: float) -> kp.Model:
    """A line along x, and gravity turned by an angle, so that the line falls towards -x."""
    m = kp.Model("floor", gravity=(-G * np.sin(angle), -G * np.cos(angle)))
    m.ground.curves(floor={"line": ((100 * size, 0), (-100 * size, 0))})
    return m


def block(m: kp.Model, name: str, mass: float, width: float, height: float) -> None:
    inertia = mass * (width**2 + height**2) / 12
    rim = {"polygon": rectangle(width, height)}
    m.body(name, mass=mass, inertia=inertia, curves={"rim": rim})


def placed(body: str, x: float, y: float, angle: float) -> dict[str, float]:
    return {f"{body}.x": x, f"{body}.y": y, f"{body}.angle": angle}


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_block_falls_flat(mass: float, size: float) -> None:
    m = tilted(0, size)
    block(m, "box", mass, size, 0.5 * size)
    m.contact("touch", curves=["box.rim", "ground.floor"], restitution=0)
    start = kp.assemble(m, set=placed("box", 0, 0.45 * size, 0))
    sol = kp.dynamics(m, start, t_end=np.sqrt(size))
    # one event for each corner
    fall = np.sqrt(2 * 0.2 * size / G)
    assert sol.events["touch.hit"].t == pytest.approx([fall, fall], rel=1e-9)
    assert sol["box.y"][-1] == pytest.approx(0.25 * size, rel=1e-12)
    assert sol["touch.gap"][[0, -1]] == pytest.approx([0.2 * size, 0], abs=1e-12 * size)
    assert sol["touch.force"][-1] == pytest.approx(mass * G, rel=1e-9)
    assert sol["touch"].force(on="box")[-1] == pytest.approx([0, mass * G], rel=1e-9)
    assert sol["touch.fy"][-1] == pytest.approx(-mass * G, rel=1e-9)
    impulse = sum(sol.events["touch.hit"].impulse("touch", on="box"))[1] / 2
    assert impulse == pytest.approx(mass * np.sqrt(2 * G * 0.2 * size), rel=1e-9)


@pytest.mark.parametrize(("mass", "size"), SCALES)
@pytest.mark.parametrize("slender", [0.4, 0.7])
def test_a_block_rocks(mass: float, size: float, slender: float) -> None:
    """Housner: the angular momentum about the new corner is that before the impact."""
    m = tilted(0, size)
    width, height = slender * size, size
    block(m, "box", mass, width, height)
    m.contact("touch", curves=["box.rim", "ground.floor"], restitution=0, friction=2)
    angle, arm = 0.1, np.array([width, height]) / 2
    turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    centre = turned @ arm
    start = kp.assemble(m, set=placed("box", centre[0], centre[1], angle))
    sol = kp.dynamics(m, start, t_end=2 * np.sqrt(size))
    hit = sol.events["touch.hit"]
    about = mass * (width**2 + height**2) / 12 + mass * arm @ arm

    def fall(_: float, y: Any) -> list[float]:
        rod = arm[0] * np.cos(y[0]) - arm[1] * np.sin(y[0])
        return [y[1], -mass * G * rod / about]

    def flat(_: float, y: Any) -> float:
        return float(y[0])

    flat.terminal = True  # type: ignore[attr-defined]
    own = solve_ivp(fall, (0, 2 * np.sqrt(size)), [angle, 0], events=flat, rtol=1e-11, atol=1e-13)
    assert hit.t[0] == pytest.approx(own.t_events[0][0], rel=1e-7)
    before = hit.states[0]["box.omega"]
    assert before == pytest.approx(own.y_events[0][0][1], rel=1e-7)
    # r x v with the velocity of the centre about the old corner, from the new corner
    velocity = before * np.array([-arm[1], arm[0]])
    spin = mass * (-arm[0] * velocity[1] - arm[1] * velocity[0])
    after = (spin + (about - mass * arm @ arm) * before) / about
    assert sol(hit.t[0])["box.omega"] == pytest.approx(after, rel=1e-7)
    alpha = np.arctan(slender)
    assert after / before == pytest.approx(1 - 1.5 * np.sin(alpha) ** 2, rel=1e-12)


@pytest.mark.parametrize(("mass", "size"), SCALES)
@pytest.mark.parametrize("mu", [0.3, 0.7])
def test_equal_blocks_on_an_incline(mass: float, size: float, mu: float) -> None:
    """Their corners lie on each other. They slide together, or rest."""
    angle = 0.5
    m = tilted(angle, size)
    for name in ("low", "high"):
        block(m, name, mass, 2 * size, 0.5 * size)
    m.contact("floor", curves=["low.rim", "ground.floor"], restitution=0, friction=mu)
    m.contact("middle", curves=["high.rim", "low.rim"], restitution=0, friction=mu)
    at = placed("low", 0, 0.25 * size, 0) | placed("high", 0, 0.75 * size, 0)
    end = 0.5 * np.sqrt(size)
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=end)
    falls = max(0.0, G * (np.sin(angle) - mu * np.cos(angle)))
    for name, y in (("low", 0.25), ("high", 0.75)):
        assert sol[f"{name}.x"][-1] == pytest.approx(-falls * end**2 / 2, abs=1e-9 * size)
        assert sol[f"{name}.y"][-1] == pytest.approx(y * size, rel=1e-9)
    weight = mass * G * np.cos(angle)
    assert sol["floor.force"][-1] == pytest.approx(2 * weight, rel=1e-7)
    assert sol["middle.force"][-1] == pytest.approx(weight, rel=1e-7)
    along = mass * (falls - G * np.sin(angle))
    assert sol["middle"].force(on="low")[-1] == pytest.approx([along, -weight], rel=1e-6)


def distance(first: Any, second: Any) -> float:
    """The least distance of the corners of each polygon from the edges of the other."""
    least = np.inf
    for one, other in ((first, second), (second, first)):
        for a, b in pairwise([*other, other[0]]):
            for p in one:
                s = np.clip(np.dot(p - a, b - a) / np.dot(b - a, b - a), 0, 1)
                least = min(least, float(np.linalg.norm(p - a - s * (b - a))))
    return least


@pytest.mark.parametrize("shape", [STAR, ANGLE, FORK, SQUARE])
@pytest.mark.parametrize("size", [1.0, 1e-3, 1e3])
def test_gaps_of_polygons(shape: Any, size: float) -> None:
    """Of polygons that are not convex too, in many places."""
    random = np.random.default_rng(7)
    m = kp.Model("gaps")
    m.ground.curves(rim={"polygon": scaled(STAR, size)})
    m.body("part", mass=1, inertia=1, curves={"rim": {"polygon": scaled(shape, size)}})
    m.contact("pair", curves=["part.rim", "ground.rim"], restitution=0)
    for _ in range(12):
        angle, way, far = random.uniform(0, 2 * np.pi, 3)
        x, y = (2.5 + far / 6) * np.array([np.cos(way), np.sin(way)])
        turned = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        own = np.array(shape) @ turned.T + [x, y]
        state = kp.assemble(m, set=placed("part", x * size, y * size, angle))
        wanted = distance(own, np.array(STAR)) * size
        assert state["pair.gap"] == pytest.approx(wanted, abs=2e-7 * size)


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_the_same_disc_in_two_forms(mass: float, size: float) -> None:
    """A disc on a disc, by its centre and by its rim, on either side of the contact."""
    ends = []
    for form in ("point", "curves", "exchanged"):
        m = kp.Model("discs", gravity=(0, -G))
        m.ground.curves(hill={"circle": (0, 0, size)})
        inertia = 0.125 * mass * size**2
        rim = {"circle": (0, 0, 0.5 * size)}
        m.body("disc", mass=mass, inertia=inertia, points={"C": (0, 0)}, curves={"rim": rim})
        law = {"friction": 0.4, "restitution": 0}
        if form == "point":
            m.contact("touch", "disc.C", "ground.hill", radius=0.5 * size, **law)
        else:
            pair = ["disc.rim", "ground.hill"]
            m.contact("touch", curves=pair if form == "curves" else pair[::-1], **law)
        at = placed("disc", 1.5 * size * np.sin(0.1), 1.5 * size * np.cos(0.1), 0)
        sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=1.3 * np.sqrt(size))
        ends.append([sol["disc.x"][-1], sol["disc.y"][-1], size * sol["disc.angle"][-1]])
        force = sol["touch"].force(on="disc")[0]
        assert force @ [np.sin(0.1), np.cos(0.1)] == pytest.approx(mass * G * np.cos(0.1), rel=1e-9)
    assert ends[1] == ends[0]
    assert ends[2] == pytest.approx(ends[0], rel=1e-7)


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_disc_rolls_over_an_edge(mass: float, size: float) -> None:
    """It turns about the corner of a table, sticking: energy gives its rate."""
    m = kp.Model("edge", gravity=(0, -G))
    m.ground.curves(table={"polygon": scaled([(-9, -1), (0, -1), (0, 0), (-9, 0)], size)})
    inertia = 0.5 * mass * size**2
    m.body("disc", mass=mass, inertia=inertia, curves={"rim": {"circle": (0, 0, size)}})
    m.contact("touch", curves=["disc.rim", "ground.table"], restitution=0, friction=3)
    speed = 0.3 * np.sqrt(G * size)
    at = placed("disc", -0.5 * size, size, 0) | {
        "disc.vx": speed,
        "disc.vy": 0,
        "disc.omega": -speed / size,
    }
    tilt = {"tilted": f"disc.x - {size * np.sin(0.5)}"}
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=2 * np.sqrt(size), events=tilt)
    state = sol.events["tilted"].states[0]
    assert np.hypot(state["disc.x"], state["disc.y"]) == pytest.approx(size, rel=1e-9)
    rolling = speed**2 / size**2
    rate = np.sqrt(rolling + 4 / 3 * G / size * (1 - np.cos(0.5)))
    assert -state["disc.omega"] == pytest.approx(rate, rel=1e-7)
    assert sol.events["tilted"].t[0] > 0.5 * size / speed


@pytest.mark.parametrize(("mass", "size"), SCALES)
def test_a_block_slides_off_a_table(mass: float, size: float) -> None:
    """It stays level until its centre passes the edge, and then tilts about the moving edge."""
    m = kp.Model("table", gravity=(0, -G))
    table = scaled([(-5, -1), (0, -1), (0, 0), (-5, 0)], size)
    m.ground.curves(table={"polygon": table})
    block(m, "box", mass, size, size)
    m.contact("touch", curves=["box.rim", "ground.table"], restitution=0)
    speed, half, inertia = 2 * np.sqrt(size), size / 2, size**2 / 6
    at = placed("box", -1.5 * size, half, 0) | {"box.vx": speed, "box.vy": 0, "box.omega": 0}
    passes, end = 1.5 * size / speed, 1.5 * size / speed + 0.15 * np.sqrt(size)
    sol = kp.dynamics(m, kp.assemble(m, set=at), t_end=end)
    assert sol["box.angle"][sol.t < passes] == pytest.approx(0, abs=1e-9)

    def motion(_: float, y: Any) -> list[float]:
        (cx, cy, angle), (vx, vy, omega) = y[:3], y[3:]
        c, s = np.cos(angle), np.sin(angle)
        along, rate = -(cx * c + cy * s), vx * c + vy * s
        push = (G * c + 2 * omega * rate + half * omega**2) / (1 + along**2 / inertia)
        return [vx, vy, omega, -push * s, push * c - G, push * along / inertia]

    begin = [0, half, 0, speed, 0, 0]
    own = solve_ivp(motion, (0, end - passes), begin, rtol=1e-11, atol=1e-14).y[:, -1]
    found = [sol[f"box.{name}"][-1] for name in ("x", "y", "angle")]
    assert found[:2] == pytest.approx(own[:2], rel=1e-6)
    assert found[2] == pytest.approx(own[2], rel=1e-5)


#: Fields of a contact, and words of the error.
REFUSED = [
    ({"curves": ["part.rim", "ground.rim"], "sides": ["left", "right"]}, "outside"),
    ({"curves": ["part.rim", "ground.rim"], "sides": ["right", "up"]}, "'right' or 'left'"),
    ({"curves": ["part.rim", "ground.rim"], "side": "left"}, "takes the place"),
    ({"curves": ["part.rim", "ground.rom"]}, "did you mean 'rim'"),
    ({"curves": ["part.disc", "ground.rim"], "radius": 0.1}, "own radius"),
    ({"curves": ["part.rim", "ground.rim"], "restitution": None, "stiffness": 1e4}, "radius"),
    ({"curves": ["part.rim", "ground.rim"], "wear": 1e-9}, "at one place"),
    ({"curves": ["part.rim", "ground.rim"], "law": "hertz", "young": 1e9}, "at one place"),
    ({"sides": ["right", "right"]}, "curves"),
    ({}, "'i' is missing"),
    ({"i": "part.P", "curve": "ground.rim", "side": "left"}, "outside"),
]


@pytest.mark.parametrize(("fields", "words"), REFUSED)
def test_refused_contacts(fields: dict[str, Any], words: str) -> None:
    m = kp.Model("refused")
    m.ground.curves(rim={"polygon": SQUARE})
    curves: dict[str, Any] = {"rim": {"polygon": SQUARE}, "disc": {"circle": (0, 0, 1)}}
    m.body("part", mass=1, inertia=1, points={"P": (0, 0)}, curves=curves)
    m.contact("pair", **({"restitution": 0} | fields))
    with pytest.raises(kp.ModelError, match=words):
        kp.assemble(m)


def test_the_remedy_for_polygons_with_the_law_of_cylinders() -> None:
    def refused(**fields: Any) -> str:
        m = kp.Model("pair")
        m.ground.curves(rim={"polygon": SQUARE})
        m.body("part", mass=1, inertia=1, curves={"rim": {"polygon": SQUARE}})
        m.contact("pair", curves=["part.rim", "ground.rim"], **fields)
        try:
            kp.assemble(m, {"part.x": 5, "part.y": 0, "part.angle": 0})
        except kp.KempeError as error:
            return str(error)
        return ""

    told = refused(law="hertz", young=1e9, poisson=0.3, width=1)
    assert "give stiffness in place of law" in told
    assert not refused(stiffness=1e6, radius=0.01)


@pytest.mark.parametrize(
    ("corners", "words"),
    [
        ([(0, 0), (0, 1), (1, 0)], "counter-clockwise"),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], "meet"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], "the same"),
        ([(0, 0), (1, 0), (0.5, 0)], "turns back|meet"),
        ([(0, 0), (1, 0)], "at least three"),
        ([(0, 0), ("a", 0), (0, 1)], "must be numbers"),
    ],
)
def test_refused_polygons(corners: Any, words: str) -> None:
    m = kp.Model("refused", parameters={"a": 1})
    m.ground.curves(rim={"polygon": corners})
    m.body("part", mass=1, inertia=1, points={"P": (0, 3)})
    m.contact("touch", "part.P", "ground.rim", restitution=0)
    with pytest.raises(kp.ModelError, match=words):
        kp.assemble(m)


def test_no_joint_on_a_polygon_and_no_law_of_its_gap() -> None:
    m = kp.Model("refused")
    m.ground.curves(rim={"polygon": SQUARE})
    m.body("part", mass=1, inertia=1, points={"P": (0, 3)})
    m.point_on_curve("on", "part.P", "ground.rim")
    with pytest.raises(kp.ModelError, match="corners"):
        kp.assemble(m)
    m = tilted(0, 1)
    block(m, "box", 1, 1, 1)
    m.contact("touch", curves=["box.rim", "ground.floor"], restitution=0)
    m.force("push", "box", force=(0, "touch.gap"))
    with pytest.raises(kp.ModelError, match="has no formula"):
        kp.assemble(m)
