"""Gaps of two smooth curves, or of one with a line or polygon, against own programs."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from contact.convex import (
    EGG,
    ROUND,
    THIN,
    TRIANGLE,
    TURN,
    distance,
    ellipse,
    on_egg,
    on_ellipse,
    placed,
    posed,
    separation,
    sides,
)
from sizes import count


def pair(one: Any, other: Any, **fields: Any) -> kp.Model:
    m = kp.Model("pair")
    m.body("a", mass=2, inertia=0.3, curves={"rim": one})
    m.body("b", mass=3, inertia=0.5, curves={"rim": other})
    m.contact("touch", curves=["a.rim", "b.rim"], **(fields or {"restitution": 0}))
    return m


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
    for _ in range(count(20, 400)):
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
            for _ in range(count(4, 60)):
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
