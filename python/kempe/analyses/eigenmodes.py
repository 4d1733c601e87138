"""Eigenvalues and shapes of linear equations M ü + C u̇ + K u = 0 and ẋ = A x."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats

Complexes: TypeAlias = NDArray[np.complex128]

#: Largest relative part of a matrix that counts as a rounding error.
_ROUNDING = 1e-12


def eigenmodes(
    mass: Floats, damping: Floats, stiffness: Floats, a: Floats
) -> tuple[Complexes, Complexes]:
    """Eigenvalues, 1/s, and the part of the independent coordinates in their vectors.

    Of two conjugate eigenvalues, only the one with the positive imaginary part is returned. The
    eigenvalues are sorted by ascending magnitude.

    Without damping and first-order states, and with a symmetric stiffness, the squares s² are
    computed as eigenvalues of a symmetric matrix, which is more accurate. Otherwise the eigenvalues
    s of A are computed.

    Args:
        mass: M, (f, f).
        damping: C, (f, f).
        stiffness: K, (f, f).
        a: A of x = (u, u̇, z), (n, n).

    Returns:
        Eigenvalues (n_modes,) and vectors (n_modes, f).
    """
    f = len(mass)
    if f == 0 and not len(a):
        return np.empty(0, dtype=complex), np.empty((0, 0), dtype=complex)
    alone = len(a) == 2 * f
    if alone and not np.any(damping) and _is_symmetric(mass, stiffness):
        found, vectors = _undamped(mass, (stiffness + stiffness.T) / 2.0)
    else:
        all_values, all_vectors = np.linalg.eig(a)
        one = np.imag(all_values) >= 0.0
        found = all_values[one].astype(complex)
        vectors = all_vectors[:f, one].T.astype(complex)
    order = np.lexsort((found.real, np.abs(found)))
    return found[order], vectors[order]


def _is_symmetric(mass: Floats, stiffness: Floats) -> bool:
    """Whether K is symmetric up to rounding, in units in which the diagonal of M is 1."""
    unit = 1.0 / np.sqrt(np.diag(mass))
    scaled = unit[:, None] * stiffness * unit
    return bool(np.abs(scaled - scaled.T).max() <= _ROUNDING * np.abs(scaled).max())


def _undamped(mass: Floats, stiffness: Floats) -> tuple[Complexes, Complexes]:
    """S of M s² + K = 0: a positive ω² gives one of the pair ±iω, another two real eigenvalues."""
    lower = np.linalg.cholesky((mass + mass.T) / 2.0)
    half = np.linalg.solve(lower, stiffness)
    reduced = np.linalg.solve(lower, half.T)
    squares, rotated = np.linalg.eigh((reduced + reduced.T) / 2.0)
    squares[np.abs(squares) <= _rounding_of(squares)] = 0.0
    shapes = np.linalg.solve(lower.T, rotated).T
    found: list[complex] = []
    vectors = []
    for square, shape in zip(squares, shapes, strict=True):
        root = float(np.sqrt(abs(square)))
        pair = [1j * root] if square > 0.0 else [complex(0.0 - root), complex(root)]
        found += pair
        vectors += [shape] * len(pair)
    return np.array(found, dtype=complex), np.array(vectors, dtype=complex)


def _rounding_of(squares: Floats) -> float:
    """Rounding error of the eigenvalues of a symmetric matrix; zero for a single eigenvalue."""
    if len(squares) == 1:
        return 0.0
    return float(4.0 * len(squares) * np.finfo(float).eps * np.abs(squares).max())
