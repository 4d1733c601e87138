"""The size of a mechanism, to which rounding errors are relative."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats

if TYPE_CHECKING:
    from kempe.results.state import State


def largest(*values: Floats) -> float:
    """The largest magnitude of some numbers; 0 without numbers."""
    return max(float(np.abs(some).max(initial=0.0)) for some in values)


def size_of(state: State) -> float:
    """The largest coordinate of a body, or of a point in the frame of its body, m."""
    bodies = state.compiled.all_bodies
    points = [at for info in bodies.values() for at in info.points.values()]
    places = [(state.body(name).x, state.body(name).y) for name in state.compiled.bodies]
    return largest(np.array(points), np.array(places))
