"""Where the lines of a drawing run, in the plane of the mechanism."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from kempe.arrays import Floats

#: Room around a mechanism, as a share of its size.
_ROOM = 0.14


def placed(poses: Floats, points: Floats | Sequence[float]) -> Floats:
    """Global places r + A(φ) s; poses (…, 3) and points (…, 2) of which one may be many, m."""
    s = np.asarray(points, dtype=np.float64)
    cos, sin = np.cos(poses[..., 2]), np.sin(poses[..., 2])
    x = poses[..., 0] + cos * s[..., 0] - sin * s[..., 1]
    y = poses[..., 1] + sin * s[..., 0] + cos * s[..., 1]
    found: Floats = np.stack([x, y], axis=-1)
    return found


def turned(points: Floats, angle: float) -> Floats:
    """Points (n, 2) turned about the origin by an angle, rad."""
    return placed(np.array([0.0, 0.0, angle]), points)


def smooth(poses: Floats, rates: Floats, t: Floats, pieces: int) -> Floats:
    """Poses of a body between its frames too, by Hermite's cubic polynomials, (n, 3).

    Args:
        poses: at the frames, (n_t, 3), m and rad.
        rates: their time derivatives, (n_t, 3).
        t: times of the frames, (n_t,), s.
        pieces: in how many pieces the motion between two frames is cut.
    """
    s = (np.arange(pieces) / pieces)[None, :, None]
    r = 1.0 - s
    before, after = poses[:-1, None], poses[1:, None]
    slopes = r * rates[:-1, None] - s * rates[1:, None]
    between = r * r * (1.0 + 2.0 * s) * before + s * s * (1.0 + 2.0 * r) * after
    between = between + np.diff(t)[:, None, None] * r * s * slopes
    return np.concatenate([between.reshape(-1, 3), poses[-1:]])


def limits(bounds: Sequence[float], aspect: float) -> Floats:
    """The part of the plane that is seen: bounds with room around, width/height as given.

    Args:
        bounds: least x and y, largest x and y, m.
        aspect: width by height of the picture.
    """
    low, high = np.array(bounds[:2]), np.array(bounds[2:])
    middle, span = (low + high) / 2.0, high - low
    room = _ROOM * (float(span.max()) or 1.0)
    height = max(span[1] + 2.0 * room, (span[0] + 2.0 * room) / aspect)
    half = np.array([aspect * height, height]) / 2.0
    return np.concatenate([middle - half, middle + half])


def support(at: Floats, size: float) -> tuple[Floats, list[Floats]]:
    """The triangle under a joint to ground, and the lines of the ground under it."""
    x, y = at
    triangle = np.array(
        [[x, y], [x - 0.7 * size, y - 1.2 * size], [x + 0.7 * size, y - 1.2 * size]]
    )
    base = y - 1.2 * size
    lines = [np.array([[x - 1.2 * size, base], [x + 1.2 * size, base]])]
    for k in np.linspace(-0.9, 1.2, 6):
        begin = x + k * size
        lines.append(np.array([[begin, base], [begin - 0.4 * size, base - 0.4 * size]]))
    return triangle, lines


def spiral(at: Floats, radius: float, begin: float, turn: float) -> Floats:
    """Archimedes' spiral around a point, (n, 2), m.

    Args:
        at: its middle.
        radius: of its outer end.
        begin: angle of its inner end, rad.
        turn: angle from the inner to the outer end, rad.
    """
    share = np.linspace(0.0, 1.0, min(4000, max(48, int(abs(turn) * 12))))
    r, angle = radius * (0.15 + 0.85 * share), begin + turn * share
    return np.column_stack([at[0] + r * np.cos(angle), at[1] + r * np.sin(angle)])
