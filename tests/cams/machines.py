"""Programmes and cams of the tests."""

from typing import Any

import kempe as kp
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
SIZES = (1e-3, 1.0, 1e3)


def programme(lift: Any, rise: Any = "cycloidal", back: Any = "cycloidal") -> list[Any]:
    """Rise within 100°, dwell to 140°, return to 240°, dwell."""
    return [
        ("rise", "100 deg", lift, rise),
        ("dwell", "40 deg"),
        ("return", "100 deg", back),
        ("dwell", "120 deg"),
    ]


def translating(follower: str = "roller", size: float = 1.0, **more: Any) -> kp.design.Cam:
    """A base circle of 30 mm and a lift of 10 mm, times the size."""
    given: dict[str, Any] = {"base_radius": 0.03 * size, **more}
    if follower == "roller":
        given.setdefault("roller_radius", 0.008 * size)
    return kp.design.cam(follower, given.pop("programme", programme(0.01 * size)), **given)


def oscillating(follower: str = "roller", size: float = 1.0, **more: Any) -> kp.design.Cam:
    """A lift of 15° on a pivot at (80, 10) mm, times the size."""
    given: dict[str, Any] = {"arm": 0.07 * size, "pivot": (0.08 * size, 0.01 * size), **more}
    if follower == "flat":
        given = {"base_radius": 0.05 * size, "face": 0.01 * size, **given}
    base = given.pop("base_radius", 0.03 * size)
    if follower == "roller":
        given.setdefault("roller_radius", 0.008 * size)
    return kp.design.cam(follower, programme("15 deg"), base_radius=base, **given)


def cycloid(x: Floats, order: int) -> Floats:
    """The cycloidal law of a unit rise and its derivatives, by hand; 0 or constant outside."""
    y = np.clip(x, 0.0, 1.0)
    turn = 2.0 * np.pi
    inside = [
        y - np.sin(turn * y) / turn,
        1.0 - np.cos(turn * y),
        turn * np.sin(turn * y),
    ]
    return np.asarray(inside[order])


def lift_of(angle: Floats, lift: float, order: int = 0) -> Floats:
    """The lift of ``programme`` by the angle, or its first or second derivative, by hand."""
    beta = np.radians(100.0)
    rise = cycloid(angle / beta, order)
    back = cycloid((angle - np.radians(140.0)) / beta, order)
    return np.asarray(lift * (rise - back) / beta**order)


def moved(cam: kp.design.Cam, motion: kp.Solution) -> tuple[Floats, Floats, Floats]:
    """The lift of a simulated follower with its derivatives by the angle of the cam."""
    speed = cam.drive.speed
    if cam.follower.arm is None:
        s = motion["follower.y"] - motion["follower.y"][0]
        return s, motion["follower.vy"] / speed, motion["follower.ay"] / speed**2
    sense = cam.follower.sense * (-1.0 if cam.clockwise else 1.0)
    s = sense * (motion["follower.angle"] - motion["follower.angle"][0])
    v, a = motion["follower.omega"] / speed, motion["follower.alpha"] / speed**2
    return s, sense * v, sense * a


def turn_of(case: kp.Case) -> kp.Solution:
    """The motion of a case over a turn."""
    motion = case.run()["turn"]
    assert isinstance(motion, kp.Solution)
    return motion
