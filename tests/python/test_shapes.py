"""Bodies from shapes: mass, mass centre and inertia against integrals, files, errors."""

from __future__ import annotations

import itertools
import math
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import dblquad, quad
from scipy.special import ellipk

RHO, T = 7850.0, 0.004
#: Not convex, clockwise, far from the origin compared with its size.
POLYGON = [(2.0, 1.0), (2.05, 1.12), (2.0, 1.3), (2.25, 1.25), (2.4, 1.05), (2.2, 1.15)]


def weighed(*shapes: dict[str, Any], **parameters: float | str) -> Any:
    m = kp.Model("shapes", parameters=parameters)
    m.body("b", shapes=shapes)
    return m.compile().bodies["b"]


def placed(corners: Any, at: tuple[float, float], angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray(corners) @ np.array([[c, s], [-s, c]]) + at


def spans(corners: np.ndarray, y: float) -> Iterator[tuple[float, float]]:
    """The intervals of x inside a polygon at a height."""
    found = []
    for (xa, ya), (xb, yb) in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        if (ya <= y) != (yb <= y):
            found.append(xa + (y - ya) / (yb - ya) * (xb - xa))
    found.sort()
    return zip(found[::2], found[1::2], strict=True)


def integral(corners: np.ndarray, power: int, times: int) -> float:
    """∫ xᵖ yᵗ dA over a polygon, strip by strip."""

    def of_strip(y: float) -> float:
        parts = (b ** (power + 1) - a ** (power + 1) for a, b in spans(corners, y))
        return sum(parts) / (power + 1) * y**times

    heights = np.unique(corners[:, 1])
    return sum(quad(of_strip, a, b)[0] for a, b in itertools.pairwise(heights))


def moments(corners: np.ndarray) -> tuple[float, np.ndarray, float]:
    """Area, centre and second moment about the centre by integration."""
    area = integral(corners, 0, 0)
    centre = np.array([integral(corners, 1, 0), integral(corners, 0, 1)]) / area
    second = integral(corners, 2, 0) + integral(corners, 0, 2)
    return area, centre, second - area * float(centre @ centre)


@pytest.mark.parametrize("at", [(0.0, 0.0), (0.7, -0.4)])
@pytest.mark.parametrize("angle", [0.0, 0.6])
@pytest.mark.parametrize("turned", [False, True])
def test_polygons_and_plates_equal_integrals(
    at: tuple[float, float], angle: float, turned: bool
) -> None:
    corners = POLYGON[::-1] if turned else POLYGON
    plate = [(-0.15, -0.05), (0.15, -0.05), (0.15, 0.05), (-0.15, 0.05)]
    place = {"at": at, "angle": angle, "density": RHO, "thickness": T}
    for edge, shape in (
        (corners, {"type": "polygon", "points": corners}),
        (plate, {"type": "plate", "width": 0.3, "height": 0.1}),
    ):
        area, centre, second = moments(placed(edge, at, angle))
        found = weighed({**shape, **place})
        assert found.mass == pytest.approx(RHO * T * area, rel=1e-11)
        np.testing.assert_allclose(found.center, centre, rtol=0, atol=1e-11)
        assert found.inertia == pytest.approx(RHO * T * second, rel=1e-8)


@pytest.mark.parametrize(("inner", "outer"), [(0.0, 0.2), (0.15, 0.2)])
def test_discs_and_rings_equal_integrals(inner: float, outer: float) -> None:
    ring = {"type": "ring", "inner": inner, "outer": outer}
    shape = ring if inner else {"type": "disc", "radius": outer}
    at = (0.3, -0.1)
    found = weighed({**shape, "density": RHO, "thickness": T, "at": at, "angle": 1.0})

    def moment(power: int) -> float:
        return float(dblquad(lambda r, _: r ** (power + 1), 0, 2 * np.pi, inner, outer)[0])

    assert found.mass == pytest.approx(RHO * T * moment(0), rel=1e-12)
    assert found.inertia == pytest.approx(RHO * T * moment(2), rel=1e-12)
    np.testing.assert_allclose(found.center, at, rtol=1e-15)


def test_a_rod_equals_its_integral() -> None:
    """Also by its density and cross-section, turned and shifted."""
    rod = {"type": "rod", "length": 0.8, "at": (1, 2), "angle": 0.7}
    mass = RHO * 1e-4 * 0.8
    second = quad(lambda s: s * s, -0.4, 0.4)[0] * RHO * 1e-4
    for matter in ({"mass": mass}, {"density": RHO, "area": 1e-4}):
        found = weighed({**rod, **matter})
        assert found.mass == pytest.approx(mass, rel=1e-14)
        assert found.inertia == pytest.approx(second, rel=1e-12)
        np.testing.assert_allclose(found.center, (1, 2), rtol=1e-15)


def test_a_body_of_pieces_is_the_whole() -> None:
    """An L is one polygon, or two plates, or a plate with a hole; wherever its frame is."""
    steel = {"density": RHO, "thickness": T}
    corners = [(0, 0), (0.3, 0), (0.3, 0.1), (0.1, 0.1), (0.1, 0.4), (0, 0.4)]
    whole = weighed({"type": "polygon", "points": corners, **steel})
    two = weighed(
        {"type": "plate", "width": 0.3, "height": 0.1, "at": (0.15, 0.05), **steel},
        {"type": "plate", "width": 0.3, "height": 0.1, "at": (0.05, 0.25), "angle": np.pi / 2}
        | steel,
    )
    cut = weighed(
        {"type": "plate", "width": 0.3, "height": 0.4, "at": (0.15, 0.2), **steel},
        {"type": "plate", "width": 0.2, "height": 0.3, "at": (0.2, 0.25), "density": -RHO}
        | {"thickness": T},
    )
    away = placed(corners, (5, -3), 2.0)
    moved = weighed({"type": "polygon", "points": away, **steel})
    for other in (two, cut, moved):
        assert other.mass == pytest.approx(whole.mass, rel=1e-12)
        assert other.inertia == pytest.approx(whole.inertia, rel=1e-10)
    for other in (two, cut):
        np.testing.assert_allclose(other.center, whole.center, rtol=1e-12)
    np.testing.assert_allclose(moved.center, placed([whole.center], (5, -3), 2.0)[0], rtol=1e-12)


def test_a_disc_with_a_hole_is_a_ring() -> None:
    """A hole by its mass or density; the hole out of the middle moves the mass centre."""
    ring = weighed({"type": "ring", "inner": 0.1, "outer": 0.3, "mass": 8})
    cut = weighed(
        {"type": "disc", "radius": 0.3, "mass": 9}, {"type": "disc", "radius": 0.1, "mass": -1}
    )
    assert (cut.mass, cut.inertia) == pytest.approx((ring.mass, ring.inertia), rel=1e-14)
    off = weighed(
        {"type": "disc", "radius": 0.3, "mass": 9},
        {"type": "disc", "radius": 0.1, "mass": -1, "at": (0.2, 0)},
    )
    assert off.center == pytest.approx((-0.2 / 8, 0.0), abs=1e-16)
    about_origin = 9 * 0.3**2 / 2 - (0.1**2 / 2 + 0.2**2)
    assert off.inertia == pytest.approx(about_origin - 8 * (0.2 / 8) ** 2, rel=1e-14)


def test_formulas_and_units_in_every_number() -> None:
    m = kp.Model("wheel", parameters={"R": "100 mm", "rho": "7850 kg/m^3", "phi": "30 deg"})
    m.body(
        "b",
        shapes=[
            {"type": "disc", "radius": "R", "density": "rho", "thickness": "5 mm"},
            {"type": "polygon", "points": [(0, 0), ("R", 0), (0, "2*R")], "mass": "5*R"}
            | {"at": ("R", "-10 mm"), "angle": "phi"},
            {"type": "rod", "length": "2*R", "density": "rho", "area": "1 cm^2"},
        ],
    )

    def check(r: float) -> None:
        at = placed([(r / 3, 2 * r / 3)], (r, -0.01), np.pi / 6)[0]
        masses = np.array([7850 * 0.005 * np.pi * r * r, 5 * r, 7850 * 2 * r * 1e-4])
        centres = np.array([(0, 0), at, (0, 0)])
        own = masses * [r * r / 2, (r * r + 4 * r * r) / 18, r * r / 3]
        centre = masses @ centres / masses.sum()
        whole = own.sum() + masses @ ((centres - centre) ** 2).sum(axis=1)
        found = m.with_parameters({"R": r}).compile().bodies["b"]
        assert found.mass == pytest.approx(masses.sum(), rel=1e-13)
        np.testing.assert_allclose(found.center, centre, rtol=1e-12)
        assert found.inertia == pytest.approx(whole, rel=1e-12)

    for r in (0.1, 0.2, 0.37):
        check(r)


def test_a_pendulum_of_shapes_has_the_period_of_theory() -> None:
    """T = 4 √(J_A/(m g d)) K(sin²(θ/2)); J_A by the theorem of Huygens and Steiner."""
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    steel = {"density": RHO, "thickness": T}
    m.body(
        "b",
        points={"A": (0, 0)},
        shapes=[
            {"type": "plate", "width": 0.04, "height": 0.5, "at": (0, -0.25), **steel},
            {"type": "disc", "radius": 0.1, "at": (0, -0.5), **steel},
        ],
    )
    m.revolute("A", "ground.A", "b.A")
    plate, disc = RHO * T * 0.04 * 0.5, RHO * T * np.pi * 0.1**2
    about = plate * ((0.04**2 + 0.5**2) / 12 + 0.25**2) + disc * (0.1**2 / 2 + 0.5**2)
    weight = 9.81 * (plate * 0.25 + disc * 0.5)
    small = kp.modes(m, kp.assemble(m, set={"b.angle": 0}))
    assert small.omega[0] == pytest.approx(math.sqrt(weight / about), rel=1e-9)
    swing = 1.2
    period = 4 * math.sqrt(about / weight) * ellipk(math.sin(swing / 2) ** 2)
    start = kp.assemble(m, set={"b.angle": swing})
    sol = kp.dynamics(m, start, t_end=period, method=kp.DOP853(rtol=1e-11, atol=1e-12))
    assert sol["b.angle"][-1] == pytest.approx(swing, rel=1e-9)
    assert sol["b.omega"][-1] == pytest.approx(0, abs=1e-7)


def test_shapes_are_kept_in_files_copies_and_pickles(tmp_path: Path) -> None:
    m = kp.Model("kept", parameters={"R": 0.1})
    shapes = [
        {"type": "disc", "radius": "R", "density": 7850, "thickness": "5 mm"},
        {"type": "polygon", "points": [(0, 0), ("R", 0), (0, 1)], "mass": 1, "at": (0, "R")},
    ]
    m.body("b", shapes=shapes, points={"P": (0, 0)}, outline={"path": "M 0 0 L 1 0 1 1 Z"})
    m.body("c", mass=1, inertia=1, outline=[(0, 0), ("R", 0), (0, 1)])
    m.point_mass("d", mass=1, outline={"circle": (0, 0, "R")})
    m.bar("e", mass=1, length=1, ends=("A", "B"), outline={"circle": (0, 0, 1)})
    m.ground.outline(np.array([[0, 0], [1, 0], [1, -1]]))
    m.ground.points(O=(0, 0))
    for suffix in ("toml", "json"):
        kp.Case(m).save(tmp_path / f"kept.{suffix}")
        again = kp.load(tmp_path / f"kept.{suffix}").model
        assert again.tree() == m.tree()
        assert again.compile().bodies["b"].inertia == m.compile().bodies["b"].inertia
    assert pickle.loads(pickle.dumps(m)).tree() == m.tree()
    assert pickle.loads(pickle.dumps(m.compile().bodies["b"])) == m.compile().bodies["b"]
    text = (tmp_path / "kept.toml").read_text(encoding="utf-8")
    assert "R" in text.split("shapes")[1]


def test_shapes_as_an_array_of_tables(tmp_path: Path) -> None:
    path = tmp_path / "wheel.toml"
    path.write_text(
        "kempe = 1\n[[bodies.b.shapes]]\ntype = 'disc'\nradius = 0.1\nmass = 2\n"
        "[[bodies.b.shapes]]\ntype = 'rod'\nlength = 1\nmass = 1\n",
        encoding="utf-8",
    )
    found = kp.load(path).model.compile().bodies["b"]
    assert (found.mass, found.inertia) == pytest.approx((3.0, 0.01 + 1 / 12))


DISC = {"type": "disc", "radius": 0.1, "mass": 2}
BOW = [(0, 0), (1, 1), (1, 0), (0, 1)]  # its signed area is 0


def polygon(*points: tuple[float, float]) -> dict[str, Any]:
    return {"type": "polygon", "points": points, "mass": 1}


@pytest.mark.parametrize(
    ("shapes", "place", "words"),
    [
        ([{**DISC, "radius": 0}], "shapes.0.radius", "shape 1 (disc): 0 m; must be > 0"),
        ([DISC, {**DISC, "radius": -1}], "shapes.1.radius", "shape 2 (disc): -1 m; must be > 0"),
        ([DISC, {**DISC, "type": "disk"}], "shapes.1.type", "shape 2 'disk'"),
        ([DISC, {**DISC, "radios": 1}], "shapes.1.radios", "unknown field 'radios' of disc"),
        ([{"type": "disc", "mass": 1}], "shapes.0.radius", "missing; disc needs it"),
        ([{"radius": 0.1, "mass": 1}], "shapes.0.type", "missing"),
        ([{**DISC, "density": 1}], "shapes.0.density", "remove mass or density"),
        ([{**DISC, "thickness": 1}], "shapes.0.thickness", "no effect beside mass"),
        (
            [{"type": "disc", "radius": 1, "density": 1}],
            "shapes.0.density",
            "shape 1 (disc): needs thickness; add thickness",
        ),
        ([{"type": "rod", "length": 1, "density": 1}], "shapes.0.density", "needs area; add area"),
        ([{"type": "disc", "radius": 1}], "shapes.0", "give mass, or density and thickness"),
        (
            [{"type": "disc", "radius": 1, "density": 1, "thickness": -1}],
            "shapes.0.thickness",
            "a hole has a negative density",
        ),
        ([{"type": "ring", "inner": 2, "outer": 1, "mass": 1}], "shapes.0.outer", "> inner"),
        ([polygon((0, 0), (1, 0))], "shapes.0.points", "at least three points"),
        ([polygon((0, 0), (1, 0), (2, 0))], "shapes.0.points", "lie on one line"),
        ([polygon((0, 0), (1, 0), (1, 0), (0, 1))], "shapes.0.points", "corners 2 and 3 coincide"),
        (
            [DISC, polygon(*BOW)],
            "shapes.1.points",
            "shape 2 (polygon): its sides 1-2 and 3-4 cross",
        ),
        ([DISC, {**DISC, "mass": -3}], "shapes", "sum to -1.000000000 kg"),
        ([DISC, {**DISC, "mass": -2}], "shapes", "make the holes (negative masses) lighter"),
        (
            [DISC, {**DISC, "mass": -1, "at": (5, 0)}],
            "shapes",
            "place the holes (negative masses) within",
        ),
        ([], "shapes", "an empty list"),
    ],
)
def test_faulty_shapes_are_refused(shapes: list[Any], place: str, words: str) -> None:
    m = kp.Model("faulty")
    m.body("b", shapes=shapes)
    with pytest.raises(kp.ModelError) as caught:
        m.compile()
    assert f"bodies.b.{place}: " in str(caught.value)
    assert words in str(caught.value)


@pytest.mark.parametrize("key", ["mass", "inertia", "center"])
def test_shapes_are_instead_of_mass_inertia_and_center(key: str) -> None:
    m = kp.Model("both")
    m.body("b", shapes=[DISC], **{key: (1, 2) if key == "center" else 1})
    with pytest.raises(kp.ModelError, match=f"bodies.b.{key}: .*remove {key}, or remove shapes"):
        m.compile()


def test_without_shapes_mass_and_inertia_are_required() -> None:
    m = kp.Model("nothing")
    m.body("b", mass=1)
    with pytest.raises(kp.ModelError, match=r"bodies.b.inertia: missing; body needs it"):
        m.compile()


@pytest.mark.parametrize(
    ("shapes", "words"),
    [("disc", "list of shapes"), ([1], "mapping"), ([{"radius": None}], "radius")],
)
def test_values_that_are_no_shapes(shapes: Any, words: str) -> None:
    with pytest.raises(kp.ModelError, match=words):
        kp.Model("no").body("b", shapes=shapes)
