"""Cams as DXF drawings and as tables, with the path of a cutter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import foreign
from kempe.base import files
from kempe.base.arrays import Floats, fixed
from kempe.base.names import one_of
from kempe.design.cams.curves import CamCurves
from kempe.design.cams.laws import TURN
from kempe.design.cams.shape import Complexes, Shape
from kempe.design.cams.sizes import refuse_undercut
from kempe.model.given import value
from kempe.model.values import Number, refuse

if TYPE_CHECKING:
    from collections.abc import Mapping

#: Metres per unit of a drawing.
_UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}


def cutter(cam: CamCurves, radius: float, of: Shape, second: Shape | None) -> dict[str, Complexes]:
    """Paths of the centre of a cutter by layer: outside of the profiles, or inside a groove.

    Raises:
        ModelError: the cutter does not fit.
    """
    if not 0.0 < radius < np.inf:
        refuse("cutter_radius", f"{radius:g} m; must be > 0")
    refuse_undercut(cam)
    roller = cam.follower.roller
    if cam.closure == "groove":
        if radius > roller * (1.0 + 1e-12):
            told = f"{radius:g} m; the groove is as wide as the roller: at most {roller:g} m"
            refuse("cutter_radius", told)
        outer = {"cutter_outer": of.beside(2.0 * roller - radius)} if radius < roller else {}
        return {"cutter": of.beside(radius), **outer}
    for shape in (cam.shape, cam.second):
        if shape is None:
            continue
        hollow = -shape.radius[shape.radius < 0.0]
        if len(hollow) and radius >= hollow.min():
            told = f"{radius:g} m; the profile has a hollow of radius {hollow.min():.6g} m"
            refuse("cutter_radius", f"{told}: take a smaller cutter")
    found = {"cutter": of.beside(radius)}
    if second is not None:
        found["cutter_conjugate"] = second.beside(radius)
    return found


def write_dxf(cam: CamCurves, path: Path, radius: Number | None, unit: str) -> Path:
    """Write the profiles; see ``Cam.write_dxf``."""
    metres = _UNITS[one_of("unit", unit, _UNITS)]
    refuse_undercut(cam)
    curves = {"cam": cam.shape.profile}
    if cam.closure == "groove":
        curves["outer"] = cam.shape.beside(2.0 * cam.follower.roller)
    if cam.second is not None:
        curves["conjugate"] = cam.second.profile
    if radius is not None:
        curves |= cutter(cam, value(radius, "cutter_radius", "m"), cam.shape, cam.second)
    lines: list[Any] = [
        (layer, True, list(zip(curve.real.tolist(), curve.imag.tolist(), strict=True)), [])
        for layer, curve in curves.items()
    ]
    bore = cam.follower.base / 5.0
    circles = [("cam", (0.0, 0.0), bore)]
    texts = [("cam", (0.0, 0.0), bore, "O")]
    files.write_text(path, foreign.dxf_text(metres, lines, circles, texts))
    return path


def write_csv(cam: CamCurves, path: Path, step: Number, radius: Number | None) -> Path:
    """Write the table; see ``Cam.write_csv``."""
    one = value(step, "step", "rad")
    count = round(TURN / one) if one > 0.0 else 0
    if not 1 <= count <= 10**6 or abs(count * one - TURN) > 1e-9 * TURN:
        refuse("step", f"{step!r}; must be a whole part of a turn, such as '1 deg'")
    refuse_undercut(cam)
    angle = fixed(np.arange(count) * (TURN / count))
    columns = _columns(cam, angle)
    if radius is not None:
        second = cam.at(angle, second=True) if cam.second is not None else None
        paths = cutter(cam, value(radius, "cutter_radius", "m"), cam.at(angle), second)
        for name, curve in paths.items():
            columns |= _places(name, curve)
    rows = zip(*(np.asarray(column).tolist() for column in columns.values()), strict=True)
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    files.write_text(path, "\n".join(lines) + "\n")
    return path


def _columns(cam: CamCurves, angle: Floats) -> dict[str, Floats]:
    """Columns by header."""
    of, unit = cam.at(angle), cam.programme.unit
    found: dict[str, Floats] = {"angle [deg]": np.degrees(angle)}
    for order, name in enumerate(("s", "v", "a", "j")):
        per = "" if order == 0 else "/rad" if order == 1 else f"/rad^{order}"
        found[f"{name} [{unit}{per}]"] = cam.programme.at(angle, order)
    if cam.follower.kind == "roller":
        found |= _places("pitch", of.pitch)
    found |= _places("profile", of.profile)
    if cam.closure == "groove":
        found |= _places("outer", of.beside(2.0 * cam.follower.roller))
    if cam.closure == "conjugate":
        found |= _places("conjugate", cam.at(angle, second=True).profile)
    found["pressure_angle [deg]"] = np.degrees(of.pressure)
    found["radius_of_curvature [m]"] = of.radius
    return found


def _places(name: str, curve: Complexes) -> Mapping[str, Floats]:
    return {f"{name}_x [m]": curve.real, f"{name}_y [m]": curve.imag}
