"""Summaries of analyses as plain data, against closed forms."""

import json
from typing import Any

import kempe as kp
import numpy as np
import pytest
from python.test_reachable import arm, region
from python.test_rest_paths import tilted
from python.test_words_of_results import crank_of, pendulums

G = 9.81
SIZES = [1e-2, 1.0, 40.0]


def plain(result: Any) -> dict[str, Any]:
    """The summary as a file has it."""
    return json.loads(json.dumps(result.summary()))


@pytest.mark.parametrize("size", SIZES)
def test_modes(size: float) -> None:
    """A point mass on a rod of the length ``size``: ω² = g/L, and the torque has 1/(m L²)."""
    m, start = pendulums(1, size)
    omega, inertia = np.sqrt(G / size), 2 * size**2
    found = plain(kp.modes(m, start, inputs=["b0.angle"], outputs=["b0.omega"]))
    (mode,) = found.pop("modes")
    assert mode == {
        "eigenvalue": pytest.approx([0.0, omega]),
        "omega": pytest.approx(omega),
        "frequency": pytest.approx(omega / (2 * np.pi)),
        "damping": 0.0,
    }
    matrices = [np.array(found.pop(name)) for name in "ABCD"]
    expected = [[[0, 1], [-(omega**2), 0]], [[0], [1 / inertia]], [[0, 1]], [[0]]]
    for one, other in zip(matrices, expected, strict=True):
        np.testing.assert_allclose(one, other, rtol=1e-12, atol=1e-12 * omega**2)
    assert found == {
        "type": "modes",
        "t": 0.0,
        "equilibrium": True,
        "stable": False,  # it is not damped
        "coordinates": ["b0.angle"],
        "states": ["b0.angle", "b0.omega"],
        "inputs": ["b0.angle"],
        "outputs": ["b0.omega"],
    }


@pytest.mark.parametrize("size", SIZES)
def test_rests(size: float) -> None:
    m, start = tilted(3.0, size, 0.5)
    most = 3.0 * G * size / 2
    found = plain(kp.equilibrium(m, start))
    assert found.pop("residual") < 1e-9 * most
    assert found.pop("steps") >= 0 and found.pop("relaxed") in (0, 1)
    assert found.pop("state")["rod.angle"] == pytest.approx(0.5 - np.pi / 2)
    assert found.pop("eigenvalues") == pytest.approx([most])
    common = {"hold": [], "coordinates": ["rod.angle"], "effort": {}}
    assert found == {**common, "stable": True}
    path = kp.equilibrium(m, start, over="p", range=(0, 1.5 * most))
    found = plain(path)
    values, eigenvalues = np.array(found.pop("values")), np.array(found.pop("eigenvalues"))
    assert found.pop("folds") == pytest.approx([most])
    # sin² + cos² of the angle from the horizontal
    circle = values**2 + eigenvalues[:, 0] ** 2
    np.testing.assert_allclose(circle, most**2, rtol=1e-9)
    assert found.pop("stable") == (eigenvalues[:, 0] > 0.0).tolist()
    assert found.pop("residual") < 1e-9 * most
    assert found == {**common, "over": "p", "branches": [], "complete": True, "end": path.end}


@pytest.mark.parametrize("scale", SIZES)
def test_regions(scale: float) -> None:
    """Both links turn by angles on a grid, so that the extents are those of its places."""
    over = ("shoulder.angle", "elbow.angle")
    made = region(arm(0.7 * scale, 0.4 * scale), over, ((0, 1.2), (0.3, 2.5)), 31)
    a, b = np.meshgrid(np.linspace(0, 1.2, 31), np.linspace(0.3, 2.5, 31))
    x, y = (scale * (0.7 * of(a) + 0.4 * of(a + b)) for of in (np.cos, np.sin))
    found = plain(made)
    assert found.pop("area") == made.area
    assert found.pop("x") == pytest.approx([x.min(), x.max()], abs=1e-9 * scale)
    assert found.pop("y") == pytest.approx([y.min(), y.max()], abs=1e-9 * scale)
    common = {"type": "reachable", "of": "fore.H", "over": list(over), "complete": True}
    assert found == {**common, "limit": None, "contours": 1}
    extents = "x from {:.6g} to {:.6g} m, y from {:.6g} to {:.6g} m"
    assert made.report() == [
        f"fore.H reaches {made.area:.6g} m² over shoulder.angle and elbow.angle",
        extents.format(x.min(), x.max(), y.min(), y.max()),
    ]
    assert repr(made) == f"<ReachableResult: {made.report()[0]}>"
    tables = {name: {c.name: c for c in columns} for name, columns in made.tables().items()}
    for name, values in (("x", x), ("y", y)):
        one = tables["reachable"][name]
        np.testing.assert_allclose(np.sort(one.values), np.sort(values.ravel()), atol=1e-9 * scale)
        np.testing.assert_array_equal(
            tables["boundary"][name].values, made.boundary[0][:, "xy".index(name)]
        )
        assert one.unit == tables["boundary"][name].unit == "m"
    assert set(tables["boundary"]["contour"].values) == {1.0}


@pytest.mark.parametrize("size", SIZES)
def test_limits(size: float) -> None:
    """The slide moves from 1 to 3, and the crank turns fully."""
    m = crank_of(size)
    start = kp.assemble(m, set={"crank.angle": 0.4}, guess={"slide.x": 3 * size})
    at = size * (np.cos(0.4) + np.sqrt(4.0 - np.sin(0.4) ** 2))
    made = kp.limits(m, start, over="slide.x")
    found = plain(made)
    assert len(found.pop("reasons")) == 2
    assert (found.pop("lower"), found.pop("upper")) == pytest.approx((size, 3 * size), rel=1e-6)
    assert found.pop("start") == pytest.approx(at)
    common = {"type": "limits", "over": "slide.x", "unit": "m", "turns_fully": False}
    assert found == {**common, "turns": None}
    span = f"{size:.7g} m to {3 * size:.7g} m, a range of {2 * size:.7g} m"
    assert made.report()[0] == f"slide.x: {span} (start: {at:.7g} m)"
    turned = kp.limits(m, start, over="crank.angle")
    found = plain(turned)
    assert (found["turns_fully"], found["turns"]) == (True, 1)
    assert (found["lower"], found["upper"], found["unit"]) == (None, None, "rad")
    assert turned.report()[0] == f"crank.angle: turns fully (start: {np.degrees(0.4):.7g}°)"


def test_mobility() -> None:
    m, _ = pendulums(2)
    m.coordinate_driver("motor", "b0.angle", value="0.1*t")
    m.body("loose", mass=1, inertia=1)
    found = plain(kp.mobility(m, kp.assemble(m)))
    assert found == {
        "type": "mobility",
        "gruebler": 9 - 4 - 1,
        "degrees_of_freedom": 4,
        "rank": 5,
        "driven": 1,
        "redundant": [],
        "singular": [],
        "locked": [],
        "loose": ["loose"],
        "undetermined": {},
        "four_bars": [],
    }
