"""Positions of the lines of a drawing in the plane of the mechanism."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from kempe.base.arrays import Floats


def placed(poses: Floats, points: Floats | Sequence[float]) -> Floats:
    """Global positions r + A(φ) s, m; poses (…, 3) and points (…, 2) are broadcast."""
    s = np.asarray(points, dtype=np.float64)
    cos, sin = np.cos(poses[..., 2]), np.sin(poses[..., 2])
    x = poses[..., 0] + cos * s[..., 0] - sin * s[..., 1]
    y = poses[..., 1] + sin * s[..., 0] + cos * s[..., 1]
    found: Floats = np.stack([x, y], axis=-1)
    return found


def smooth(poses: Floats, rates: Floats, t: Floats, pieces: int) -> Floats:
    """Poses of a body between its frames too, by Hermite's cubic polynomials, (n, 3).

    Args:
        poses: at the frames, (n_t, 3), m and rad.
        rates: their time derivatives, (n_t, 3).
        t: times of the frames, (n_t,), s.
        pieces: number of pieces into which the motion between two frames is divided.
    """
    s = (np.arange(pieces) / pieces)[None, :, None]
    r = 1.0 - s
    before, after = poses[:-1, None], poses[1:, None]
    slopes = r * rates[:-1, None] - s * rates[1:, None]
    between = r * r * (1.0 + 2.0 * s) * before + s * s * (1.0 + 2.0 * r) * after
    between = between + np.diff(t)[:, None, None] * r * s * slopes
    return np.concatenate([between.reshape(-1, 3), poses[-1:]])
