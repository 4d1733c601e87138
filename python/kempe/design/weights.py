"""The least squares of quantities that are linear in vectors and in their magnitudes."""

from __future__ import annotations

from itertools import product

import numpy as np

from kempe.base.arrays import Floats

#: Directions of each vector at the starts, and the largest number of starts.
_DIRECTIONS, _STARTS = 12, 200
#: A part of the columns below this share of the largest is a rounding error of runs.
_NOISE = 1e-9
#: Number of starts from which the search begins, the best ones.
_SEARCHED = 8


def least(base: Floats, columns: Floats, *, linear: bool) -> np.ndarray:
    """Vectors, as complex numbers, for the least |b + Σ (A_k x_k + B_k y_k + C_k |x_k + i y_k|)|.

    Args:
        base: b, (n,).
        columns: A, B and C of each vector, (m, 3, n).
        linear: whether C is zero, so that the solution is that of linear equations.
    """
    sizes = np.linalg.norm(columns, axis=2)
    felt = (sizes > _NOISE * max(sizes.max(initial=0.0), float(np.linalg.norm(base)))).any(axis=1)
    found = np.zeros(len(columns), dtype=complex)
    if felt.any():
        found[felt] = _of_felt(base, columns[felt], linear)
    return found


def _of_felt(base: Floats, columns: Floats, linear: bool) -> np.ndarray:
    """The same for vectors that all have an influence."""
    m = len(columns)
    flat = columns[:, :2].reshape(2 * m, -1).T
    if linear:
        found = np.linalg.lstsq(flat, -base, rcond=1e-12)[0]
        return np.asarray(found[0::2] + 1j * found[1::2])
    from scipy.optimize import least_squares, nnls

    size = float(np.linalg.norm(base)) or 1.0
    angles = 2 * np.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    if _DIRECTIONS**m <= _STARTS:
        starts = np.array(list(product(angles, repeat=m)))
    else:
        starts = np.random.default_rng(0).uniform(0, 2 * np.pi, (_STARTS, m))

    def along(directions: Floats) -> tuple[float, np.ndarray]:
        """The least for these directions, whose magnitudes solve a linear problem."""
        parts = np.stack([np.cos(directions), np.sin(directions), np.ones(m)], axis=1)
        matrix = np.einsum("kc,kcn->nk", parts, columns)
        lengths, left = nnls(matrix / size, -base / size)
        return float(left), lengths * np.exp(1j * directions)

    def residual(x: Floats) -> Floats:
        lengths = np.hypot(x[0::2], x[1::2])
        return np.asarray((base + flat @ x + lengths @ columns[:, 2]) / size)

    tried = sorted((along(one) for one in starts), key=lambda one: one[0])
    best_left, best = float(np.linalg.norm(base)) / size, np.zeros(m, dtype=complex)
    for left, start in tried[:_SEARCHED]:
        x = np.column_stack([start.real, start.imag]).ravel()
        found = least_squares(residual, x, xtol=1e-14, ftol=1e-15, gtol=1e-15)
        vectors = found.x[0::2] + 1j * found.x[1::2]
        # a vector of zero length is a corner, at which the search may end above its start
        own = min((np.sqrt(2 * found.cost), 0, vectors), (left, 1, start), key=lambda one: one[:2])
        if own[0] < best_left:
            best_left, best = own[0], own[2]
    return best
