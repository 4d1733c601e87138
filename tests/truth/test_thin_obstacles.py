"""Driven motions meet obstacles that are thin beside their steps; limits against plane geometry."""

from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest

SIZES = [1.0, 1e-3, 1e3]
#: Half widths of the obstacles, relative to the arm.
WIDTHS = [0.1, 1e-3, 1e-5]
#: The angles of the arm at the start, and of the middle of the obstacle.
BEGIN, AT = 0.2, 1.3
Placed = Callable[[float, float], tuple[kp.Model, float]]


def arm(size: float, **fields: object) -> kp.Model:
    m = kp.Model("arm")
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1, length=size, ends=("A", "B"), **fields)
    m.revolute("J", "ground.O", "arm.A")
    return m


def peg(size: float, width: float) -> tuple[kp.Model, float]:
    """The tip meets a circle on its path; half the angle of the chord of two radii."""
    m = arm(size)
    center = (size * np.cos(AT), size * np.sin(AT))
    m.ground.curves(peg={"circle": (*center, width * size)})
    m.contact("wall", "arm.B", "ground.peg", restitution=0)
    return m, 2 * np.arcsin(width / 2)


def discs(size: float, width: float) -> tuple[kp.Model, float]:
    m = arm(size, curves={"tip": {"circle": (size / 2, 0, width * size)}})
    center = (size * np.cos(AT), size * np.sin(AT))
    m.ground.curves(peg={"circle": (*center, width * size)})
    m.contact("wall", curves=["arm.tip", "ground.peg"], restitution=0)
    return m, 2 * np.arcsin(width)


def edge(size: float, width: float) -> tuple[kp.Model, float]:
    """The tip meets the side of a thin plate that points to the pivot."""
    m = arm(size)
    turn = np.array([[np.cos(AT), -np.sin(AT)], [np.sin(AT), np.cos(AT)]])
    corners = np.array([(0.5, -width), (1.5, -width), (1.5, width), (0.5, width)])
    m.ground.curves(plate={"polygon": [tuple(map(float, p)) for p in size * corners @ turn.T]})
    m.contact("wall", "arm.B", "ground.plate", restitution=0)
    return m, np.arcsin(width)


def level(size: float, width: float) -> tuple[kp.Model, float]:
    """The tip touches a level from below that it exceeds by little."""
    m = arm(size)
    along = {"axes": (AT, 0)}
    m.body("mark", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("way", "ground.O", "mark.P", **along)
    m.pin_in_slot("level", "mark.P", "arm.B", axis="90*deg")
    m.stop("wall", "way.displacement", upper=float(size * np.cos(width)), restitution=0)
    return m, width


def slot(size: float, width: float) -> tuple[kp.Model, float]:
    """The tip leaves the end of a slot."""
    m = arm(size)
    end = float(size * np.cos(width))
    m.body(
        "yoke",
        mass=1,
        inertia=1,
        points={"P": (0, 0)},
        curves={"slot": {"line": ((-end, 0), (end, 0))}},
    )
    m.translational("way", "ground.O", "yoke.P", axes=(AT + np.pi / 2, np.pi / 2))
    m.point_on_curve("wall", "arm.B", "yoke.slot")
    return m, width


PLACED = [peg, discs, edge, level, slot]
#: At 1e-5 rad beside its largest value, a coordinate differs by 5e-11, less than a gap may.
THIN = [
    (placed, width) for placed in PLACED for width in WIDTHS if width > 1e-4 or placed in PLACED[:3]
]


@pytest.mark.parametrize(("placed", "width"), THIN)
@pytest.mark.parametrize("size", SIZES)
def test_the_limits_of_an_arm_are_the_sides_of_an_obstacle(
    placed: Placed, width: float, size: float
) -> None:
    m, half = placed(size, width)
    start = kp.assemble(m, set={"J.angle": BEGIN})
    found = kp.limits(m, start, over="J.angle")
    # a contact may leave its curve by 1e-9 of the length
    error = 3e-9 / width if placed is slot else 1e-6 * width
    assert found.upper == pytest.approx(AT - half, abs=error)
    other = AT - np.pi if placed is slot else AT - 2 * np.pi
    assert found.lower == pytest.approx(other + half, abs=error)


@pytest.mark.parametrize("placed", PLACED)
@pytest.mark.parametrize("analysis", [kp.kinematics, kp.inverse_dynamics])
def test_no_driven_motion_passes_an_obstacle(
    placed: Placed, analysis: Callable[..., kp.Solution]
) -> None:
    m, half = placed(1.0, 1e-3)
    start = kp.assemble(m, set={"J.angle": BEGIN})
    with pytest.raises(kp.SingularityError, match="wall") as caught:
        analysis(m, start, over="J.angle", range=(BEGIN, 2.0), n=3)
    assert caught.value.value == pytest.approx(AT - half, abs=3e-6)
    m.coordinate_driver("motor", "J.angle", value=f"{BEGIN} + 2*t")
    with pytest.raises(kp.SingularityError, match="wall") as caught:
        analysis(m, kp.assemble(m), t_end=1.0, output_step=0.5)
    assert caught.value.solution.final["J.angle"] < AT


@pytest.mark.parametrize("side", [-1, 1])
def test_an_obstacle_beside_the_path_is_no_limit(side: int) -> None:
    m = arm(1.0)
    center = (1 + side * 2e-5) * np.array([np.cos(AT), np.sin(AT)])
    m.ground.curves(peg={"circle": (*map(float, center), 1e-5)})
    m.contact("wall", "arm.B", "ground.peg", restitution=0)
    found = kp.limits(m, kp.assemble(m, set={"J.angle": BEGIN}), over="J.angle")
    assert found.lower is None
    assert found.upper is None
