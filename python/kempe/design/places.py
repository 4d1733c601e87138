"""Points of bodies by name or by coordinates, and the lines of links between their pins."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats, fixed
from kempe.base.names import few, unknown
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel, ConstraintInfo, Vector
from kempe.model.values import vector
from kempe.results.motion import Motion
from kempe.results.views.body import PointView

#: A point: "coupler.P", or a body and coordinates in its frame: ("coupler", (0.1, 0.2)), m.
Place: TypeAlias = "str | tuple[str, Vector]"


def located(model: CompiledModel, place: Place) -> tuple[str, Vector, str]:
    """The body of a point, its coordinates in the frame of the body, m, and its name.

    Raises:
        ModelError: there is no such body or point.
    """
    if isinstance(place, str):
        body, _, point = place.rpartition(".")
        known = model.body(body or place).points
        if point not in known or not body:
            raise unknown(f"point of {body or place}", point, known)
        return body, known[point], place
    if not isinstance(place, tuple | list) or len(place) != 2 or not isinstance(place[0], str):
        raise ModelError(
            f"point: {place!r} is not a point",
            hint='write "coupler.P", or ("coupler", (0.1, 0.2)) in the frame of the body, m',
        )
    body = model.body(place[0]).name
    s = vector(place[1], f"point of {body}")
    return body, s, f"{body} at ({s[0]:g}, {s[1]:g})"


def point_of(motion: Motion, place: Place) -> PointView:
    """A point of a body of a motion; see ``located``."""
    body, s, name = located(motion.compiled, place)
    return motion.body(body).at(s, name)


def is_pin(info: ConstraintInfo) -> bool:
    """Whether a joint keeps two points coincident, so that its bodies can only turn about it."""
    turns = bool(info.measured) and info.measured[0].names[0] == "angle"
    return info.group == "joints" and turns and not info.coordinates


def mass_and_inertia(motion: Motion, body: str) -> tuple[Floats, Floats]:
    """Mass of a body at each time, (n_t,), kg, and its inertia about the mass centre, kg·m²."""
    count = np.shape(motion.t)
    models = [motion.compiled] if motion._phases is None else motion._phases.models
    of_row = np.zeros(count, dtype=np.intp) if motion._phases is None else motion._phases.of_row
    both = np.array([(m.bodies[body].mass, m.bodies[body].inertia) for m in models])[of_row]
    return fixed(both[..., 0]), fixed(both[..., 1])


def others_at(model: CompiledModel, body: str, joint: str) -> list[ConstraintInfo]:
    """The other joints of a body that fix a point or guide it along a line."""
    names, _ = _core.line_at(model.core, joint, body)
    return [model.constraints[name] for name in names]


def line_at(model: CompiledModel, body: str, joint: str) -> float:
    """The direction of the line of a link from a pin, in the frame of the link, rad.

    Raises:
        ModelError: the link has no other pin or slide, or several.
    """
    names, angle = _core.line_at(model.core, joint, body)
    if angle is None:
        told = f"{len(names)} other joints ({few(names)})" if names else "no other joint"
        raise ModelError(
            f"{body} has {told} besides {joint}, so that its line is not unique",
            name=body,
            hint=f'name a point on its line: lines={{"{body}": "{body}.POINT"}}',
        )
    return angle
