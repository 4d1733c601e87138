"""The compliant examples against the stiffness of the literature, at three sizes."""

from __future__ import annotations

import math

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from scipy.optimize import brentq
from sizes import FULL, some

SIZES = pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])


def rest(name: str, **parameters: float) -> kp.State:
    """The equilibrium of an example under its whole load."""
    case = kp.load(ROOT / f"examples/{name}.toml", parameters=parameters)
    start = kp.assemble(case.model, guess={"stage.angle": 0} if "leaf" in name else {})
    end = kp.State(case.model, 1.0, start.q, np.zeros_like(start.q))
    return kp.equilibrium(case.model, end).state


@SIZES
def test_the_leaf_spring_guide_has_the_stiffness_of_jones(size: float) -> None:
    # R. V. Jones, J. Sci. Instrum. 28 (1951) 38: two leaves clamped at both ends
    length, thickness, width, young = 0.06 * size, 4e-4 * size, 0.02 * size, 210e9
    stiffness = 24 * young * width * thickness**3 / 12 / length**3
    x = 0.01 * length
    given = {"length": length, "gap": 0.05 * size, "thickness": thickness, "width": width}
    state = rest("leaf_spring_guide", **given, push=stiffness * x)
    assert state["stage.x"] == pytest.approx(x, rel=3e-4)
    assert state["stage.angle"] == pytest.approx(0, abs=1e-6)
    # leaves that keep their length come down by 3 x²/(5 L)
    assert length - state["stage.y"] == pytest.approx(0.6 * x**2 / length, rel=2e-3)
    moment = stiffness * x * length / 4
    assert state["left.stress"] == pytest.approx(6 * moment / (width * thickness**2), rel=3e-3)


@SIZES
def test_the_cross_spring_pivot_has_the_stiffness_of_haringx(size: float) -> None:
    # J. A. Haringx, Appl. Sci. Res. A1 (1949) 313: leaves that cross in their middle
    length, thickness, width, young = 0.05 * size, 2.5e-4 * size, 0.015 * size, 200e9
    bending = young * width * thickness**3 / 12
    angle = 0.02
    given = {"length": length, "thickness": thickness, "width": width}
    state = rest("cross_spring_pivot", **given, torque=2 * bending / length * angle)
    assert state["lever.angle"] == pytest.approx(angle, rel=1e-3)
    # the leaves become arcs, and the centre stays
    face = young * thickness / 2 * angle / length
    assert state["one.stress"] == pytest.approx(face, rel=3e-2)
    moved = math.hypot(state["lever.x"], state["lever.y"] - length * math.sqrt(2) / 4)
    assert moved < 1e-4 * length


def shallow(rise: float, axial: float, d: float) -> tuple[float, float]:
    """Force of a shallow strip of length 1 and EI = 1, and u = sqrt(P) of its compression P.

    The strip w0 = rise (2x - x²) is hinged at x = 0 and clamped at the shuttle, x = 1, which has
    moved down by d. With the compression P = u², w = a + b x + c cos ux + e sin ux
    w″″ + u² w″ = 0, w(0) = 0, w″(0) = w0″, w′(1) = 0 and w(1) = rise - d.
    """

    def shape(u: float) -> tuple[np.ndarray, float]:
        s, c = math.sin(u), math.cos(u)
        rows = [
            [1, 0, 1, 0],
            [0, 0, -(u**2), 0],
            [0, 1, -u * s, u * c],
            [1, 1, c, s],
        ]
        a, b, k, e = np.linalg.solve(rows, [0, -2 * rise, 0, rise - d])
        x, weights = np.polynomial.legendre.leggauss(40)
        x, weights = (x + 1) / 2, weights / 2
        slope = b - k * u * np.sin(u * x) + e * u * np.cos(u * x)
        shorter = float(weights @ ((2 * rise * (1 - x)) ** 2 - slope**2)) / 2
        return np.array([a, b, k, e]), axial * shorter - u**2

    # the branch without a node has u below the first root of tan u = u
    u = brentq(lambda u: shape(u)[1], 1e-3, 4.4)
    _, b, _, _ = shape(u)[0]
    # the vertical force at the hinge: w‴ + u² w′ is constant
    return u**2 * float(b), u


@SIZES
def test_the_bistable_switch_snaps_as_shallow_theory_predicts(size: float) -> None:
    span, width, young = 0.03 * size, 0.01 * size, 2e9
    rise = 0.0125 * span  # shallow
    thickness = rise / 1.6
    given = {"span": span, "thickness": thickness, "width": width, "rise": rise}
    case = kp.load(ROOT / "examples/bistable_switch.toml", parameters=given)
    start = case.start()
    path = kp.equilibrium(case.model, start, over="way", range=(0, 2 * rise))
    force = np.array([-state["push.effort"] for state in path.states])
    axial = 12 * (span / thickness) ** 2
    scale = 2 * young * width * thickness**3 / 12 / span**2
    for at in (0.2, 0.5, 1.0, 1.3, 1.7):
        k = int(np.argmin(np.abs(path.values / rise - at)))
        d = path.values[k] / span
        predicted, _ = shallow(rise / span, axial, d)
        assert force[k] == pytest.approx(predicted * scale, rel=5e-3), at
    # the force is negative before the second position, in which the switch stays
    assert force[-1] > 0 > force.min()
    stays = path.values[np.flatnonzero(force < 0)[-1]]
    zero = brentq(lambda d: shallow(rise / span, axial, d * rise / span)[0], 1.7, 1.99)
    assert stays / rise == pytest.approx(zero, abs=0.05)


@pytest.mark.parametrize(
    ("thickness", "gap", "pull", "mass"),
    some([(1e-3, 3e-3, 3.0, 0.1), (0.9e-3, 2e-3, 2.0, 0.05), (1.2e-3, 2e-3, 6.0, 0.2)], 1),
)
def test_the_compliant_gripper_holds_its_disc_with_what_the_leaves_leave(
    thickness: float, gap: float, pull: float, mass: float
) -> None:
    given = {"thickness": thickness, "gap": gap, "pull": pull, "mass": mass}
    case = kp.load(ROOT / "examples/compliant_gripper.toml", parameters=given)
    end = case.run()["lift"].final
    assert end["disc.y"] == pytest.approx(0.015 + 0.012, abs=2e-4)
    # two guided leaves, stretched by the weight of the jaw and half of the disc
    length, width, young, jaw = 0.05, 0.01, 1.4e9, 0.01
    bending = young * width * thickness**3 / 12
    tension = 9.81 * (jaw + mass / 2)
    stiffness = 24 * bending / length**3 + 6 / 5 * tension / length
    force = (pull - stiffness * gap) / (1 + stiffness / 1e5)
    for pad in ("pad_1", "pad_2"):
        assert end[f"{pad}.force"] == pytest.approx(force, rel=0.02)
        assert abs(end[f"{pad}.tangential"]) == pytest.approx(mass * 9.81 / 2, rel=0.03)


@pytest.mark.parametrize(("share", "lifted"), [*[(0.9, 0.0)] * FULL, (0.95, 0.0), (1.05, 1.0)])
def test_the_compliant_gripper_lifts_what_friction_holds(share: float, lifted: float) -> None:
    mass, friction, gap, length = 0.1, 0.4, 3e-3, 0.05
    stiffness = 24 * 1.4e9 * 0.01 * 1e-9 / 12 / length**3
    stiffness += 6 / 5 * 9.81 * (0.01 + mass / 2) / length
    pull = share * mass * 9.81 / (2 * friction) + stiffness * gap
    case = kp.load(ROOT / "examples/compliant_gripper.toml", parameters={"pull": pull})
    end = case.run()["lift"].final
    assert end["disc.y"] - 0.015 == pytest.approx(0.012 * lifted, abs=1e-3)
