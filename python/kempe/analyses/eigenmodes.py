"""Vectors of the eigenvalues of linear equations M ü + C u̇ + K u = 0 and ẋ = A x."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats

Complexes: TypeAlias = NDArray[np.complex128]

#: Largest relative part of a matrix that counts as a rounding error.
_ROUNDING = 1e-12


def vectors_of(
    values: Complexes, mass: Floats, damping: Floats, stiffness: Floats, a: Floats
) -> Complexes:
    """The part of the independent coordinates in the vectors of eigenvalues, (n_modes, f).

    Without damping and first-order states, and with a symmetric stiffness, the vectors are those of
    a symmetric matrix, which is more accurate. Otherwise they are those of A.

    Args:
        values: eigenvalues, (n_modes,), 1/s.
        mass: M, (f, f).
        damping: C, (f, f).
        stiffness: K, (f, f).
        a: A of x = (u, u̇, z), (n, n).
    """
    f = len(mass)
    if f and len(a) == 2 * f and not np.any(damping) and _is_symmetric(mass, stiffness):
        found, vectors = _undamped(mass, (stiffness + stiffness.T) / 2.0)
    else:
        found, columns = np.linalg.eig(a)
        vectors = columns[:f].T
    chosen: list[int] = []
    for value in values:  # each vector once, because equal eigenvalues have several
        apart = np.abs(found - value)
        apart[chosen] = np.inf
        chosen.append(int(apart.argmin()))
    return vectors[chosen].astype(complex)


def _is_symmetric(mass: Floats, stiffness: Floats) -> bool:
    """Whether K is symmetric up to rounding, in units in which the diagonal of M is 1."""
    unit = 1.0 / np.sqrt(np.diag(mass))
    scaled = unit[:, None] * stiffness * unit
    return bool(np.abs(scaled - scaled.T).max() <= _ROUNDING * np.abs(scaled).max())


def _undamped(mass: Floats, stiffness: Floats) -> tuple[Complexes, Floats]:
    """Both roots s of M s² + K = 0 for each square, and their vectors."""
    lower = np.linalg.cholesky((mass + mass.T) / 2.0)
    half = np.linalg.solve(lower, stiffness)
    reduced = np.linalg.solve(lower, half.T)
    squares, rotated = np.linalg.eigh((reduced + reduced.T) / 2.0)
    roots = np.sqrt(-squares.astype(complex))
    shapes = np.linalg.solve(lower.T, rotated).T
    return np.concatenate([roots, -roots]), np.concatenate([shapes, shapes])
