"""Python interface of the compiled core: cams, as ``kempe.design.cams`` describes them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

_F = NDArray[np.float64]
_Z = NDArray[np.complex128]
_Points = list[tuple[float, float]]
#: What it does, its angle, the change of its lift, the name of its law, derivatives at both ends of
#: a polynomial or a spline, and the points of a spline.
CamSegment = tuple[
    str, float, float | None, str | None, tuple[list[float], list[float]], _Points | None
]
#: Start, end, powers, amplitude, frequency and phase.
_Piece = tuple[float, float, list[float], float, float, float]

def cam_laws() -> list[str]:
    """The named laws of a segment."""

def cam_programme(
    segments: list[CamSegment], angular: bool
) -> tuple[list[_Piece], float, float, _Points]:
    """The pieces, the largest and the smallest lift, and the jumps of the acceleration."""

def cam_lift(programme: Any, angles: _F, order: int) -> _F:
    """The lift, or its derivative of an order, at angles (n,)."""

def cam_sampled(programme: Any, step: float) -> tuple[_F, _F]:
    """Angles of all pieces (n,), and lift and three derivatives at each, (4 n,)."""

def cam_check(cam: Any) -> None:
    """Refuse dimensions that are none, or do not assemble."""

def cam_angles(cam: Any) -> _F:
    """Angles of the cam, dense where derivatives jump, (n,)."""

def cam_shape(
    cam: Any, angles: _F, second: bool
) -> tuple[tuple[_Z, _Z, _Z], tuple[_F, _F, _F, _F, _F]]:
    """Pitch, normal and profile; bend, room, radius, pressure angle and contact; (n,) each."""

def cam_limits(cam: Any) -> tuple[float, float, float, _Points]:
    """Largest pressure angle, least radius of curvature, speed of lift-off, undercut intervals."""

def cam_least_base(cam: Any, steep: float | None, sharp: float) -> float | None:
    """The least base radius within a pressure angle and a radius of curvature, or None."""

def cam_remarks(cam: Any) -> list[str]:
    """What is wrong or doubtful, each with a remedy."""

def cam_case(cam: Any) -> str:
    """The case, as TOML."""

def cam_walls(cam: Any, angles: _F, cutter: float | None) -> list[tuple[str, _Z]]:
    """The profiles at angles by layer, and with a cutter the paths of its centre."""
