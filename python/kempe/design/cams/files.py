"""Cams as DXF drawings and as tables, with the path of a cutter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core, foreign
from kempe.base import files
from kempe.base.arrays import Floats, fixed
from kempe.base.names import one_of
from kempe.design.cams.curves import CamCurves
from kempe.design.cams.laws import TURN
from kempe.design.cams.shape import Complexes
from kempe.model.given import value
from kempe.model.values import Number, refuse

if TYPE_CHECKING:
    from collections.abc import Mapping

#: Metres per unit of a drawing.
_UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}


def write_dxf(cam: CamCurves, path: Path, radius: Number | None, unit: str) -> Path:
    """Write the profiles; see ``Cam.write_dxf``."""
    metres = _UNITS[one_of("unit", unit, _UNITS)]
    cutter = None if radius is None else value(radius, "cutter_radius", "m")
    lines: list[Any] = [
        (layer, True, list(zip(curve.real.tolist(), curve.imag.tolist(), strict=True)), [])
        for layer, curve in _core.cam_walls(cam, cam.angle, cutter)
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
    angle = fixed(np.arange(count) * (TURN / count))
    cutter = None if radius is None else value(radius, "cutter_radius", "m")
    columns = _columns(cam, angle, dict(_core.cam_walls(cam, angle, cutter)))
    rows = zip(*(np.asarray(column).tolist() for column in columns.values()), strict=True)
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    files.write_text(path, "\n".join(lines) + "\n")
    return path


def _columns(cam: CamCurves, angle: Floats, walls: dict[str, Complexes]) -> dict[str, Floats]:
    """Columns by header; the profiles and the paths of a cutter are given."""
    of, unit = cam.at(angle), cam.programme.unit
    found: dict[str, Floats] = {"angle [deg]": np.degrees(angle)}
    for order, name in enumerate(("s", "v", "a", "j")):
        per = "" if order == 0 else "/rad" if order == 1 else f"/rad^{order}"
        found[f"{name} [{unit}{per}]"] = cam.programme.at(angle, order)
    if cam.follower.kind == "roller":
        found |= _places("pitch", of.pitch)
    found |= _places("profile", walls.pop("cam"))
    for name in ("outer", "conjugate"):
        if name in walls:
            found |= _places(name, walls.pop(name))
    found["pressure_angle [deg]"] = np.degrees(of.pressure)
    found["radius_of_curvature [m]"] = of.radius
    for name, path in walls.items():
        found |= _places(name, path)
    return found


def _places(name: str, curve: Complexes) -> Mapping[str, Floats]:
    return {f"{name}_x [m]": curve.real, f"{name}_y [m]": curve.imag}
