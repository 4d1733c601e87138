"""The pictures of a mode, as a film that repeats."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from kempe.analyses.mode_shape import ModeShape
from kempe.draw.frame import Frame, Picture
from kempe.draw.numbers import plain
from kempe.draw.pixels import Pixels, format_of
from kempe.draw.scene import Scene, scene

#: Duration of a period on the screen, s.
PERIOD = 2.0


def bounds_of(scenes: Sequence[Scene]) -> list[float]:
    """The area that contains all bounds: least x and y, largest x and y, m."""
    all_bounds = np.array([shown["bounds"] for shown in scenes])
    return [*all_bounds[:, :2].min(axis=0).tolist(), *all_bounds[:, 2:].max(axis=0).tolist()]


def oscillation(shape: ModeShape, count: int) -> Scene:
    """The scene of one period of a mode, in ``count`` frames."""
    states = shape.states(count)
    rest = scene(shape.state)
    ends = [scene(states[k]) for k in sorted({0, count // 4, count // 2, 3 * count // 4})]
    turns = 2.0 * np.pi * np.arange(count) / count
    bodies = shape.state.compiled.bodies
    poses = [
        [[getattr(state.body(name), each) for each in ("x", "y", "angle")] for name in bodies]
        for state in states
    ]
    frames = {
        **rest["frames"],
        "t": (turns / (abs(shape.eigenvalue) or 1.0)).tolist(),
        "poses": plain(np.array(poses), 12),
    }
    return {**rest, "bounds": bounds_of([rest, *ends]), "frames": frames, "traces": []}


def pictures(shape: ModeShape, size: Pixels, fps: float, *, labels: bool) -> Iterator[Picture]:
    """RGBA pictures of one period, (height, width, 4), each valid until the next."""
    wanted, count = format_of(size), max(4, round(PERIOD * fps))
    frame = Frame(oscillation(shape, count), wanted.dpi, wanted.size, labels=labels)
    for k in range(count):
        yield frame.pixels(k)
