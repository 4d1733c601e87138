"""Combinations of parameters that data cannot determine, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats
from kempe.base.names import few

#: Singular values of columns of length 1 below which a combination has no effect on the data. The
#: slopes are exact up to the tolerance of a run.
SMALL = 1e-6
#: Parts of a direction, relative to its largest, that are left out.
_NEGLIGIBLE = 1e-3
#: Relative difference within which relative changes are equal.
_EQUAL = 2e-3


@dataclass(frozen=True)
class Determined:
    """What data determine.

    Attributes:
        covariance: of the parameters, (n, n); infinite on its diagonal for those that are not
            determined.
        free: whether each parameter is not determined, (n,).
        texts: what is not determined, in words.
    """

    covariance: Floats
    free: NDArray[np.bool_]
    texts: tuple[str, ...]


def determined(
    names: Sequence[str], magnitudes: Floats, values: Floats, jacobian: Floats
) -> Determined:
    """What residuals with these derivatives determine.

    Args:
        names: the parameters.
        magnitudes: how large they are before the fit; 0 where this is not known.
        values: their values.
        jacobian: the derivatives of residuals in standard deviations, (n_residuals, n).
    """
    n = len(names)
    lengths = np.linalg.norm(jacobian, axis=0)
    scales = lengths * magnitudes  # a value that is 0 says nothing about its effect
    idle = (lengths == 0.0) | ((scales < SMALL**2 * scales.max(initial=0.0)) & (magnitudes > 0.0))
    kept = np.flatnonzero(~idle)
    units = lengths[kept]
    columns = jacobian[:, kept] / units
    columns = np.pad(columns, ((0, max(0, len(kept) - len(columns))), (0, 0)))
    _, sizes, rows = np.linalg.svd(columns, full_matrices=False)
    lost = sizes < SMALL * sizes.max(initial=0.0)
    projector = rows[lost].T @ rows[lost]
    free = idle.copy()
    free[kept] = np.diag(projector) > _NEGLIGIBLE**2
    texts = [f"{names[k]} has no effect on the data" for k in np.flatnonzero(idle).tolist()]
    texts += _told([names[k] for k in kept.tolist()], values[kept], units, projector)
    weights = np.divide(1.0, sizes**2, out=np.zeros_like(sizes), where=~lost)
    covariance = np.zeros((n, n))
    covariance[np.ix_(kept, kept)] = (rows.T * weights) @ rows / np.outer(units, units)
    covariance[free, free] = np.inf
    return Determined(covariance, free, tuple(texts))


def _told(names: Sequence[str], values: Floats, units: Floats, projector: Floats) -> Iterator[str]:
    """Each group of parameters that can change together without an effect.

    Args:
        names: the parameters.
        values: their values.
        units: the changes of the residuals per unit of each.
        projector: onto the changes without an effect, each parameter times its unit.
    """
    for group in _groups(np.abs(projector) > _NEGLIGIBLE):
        own, block = [names[k] for k in group.tolist()], projector[np.ix_(group, group)]
        dimension = round(float(np.trace(block)))
        if dimension == 1:
            direction = block[np.argmax(np.diag(block))] / units[group]
            yield _of_direction(own, values[group], direction)
        else:
            count = len(own) - dimension
            plural = "combination is" if count == 1 else "combinations are"
            yield f"only {count} {plural} determined of {few(own)}"


def _groups(linked: NDArray[np.bool_]) -> Iterator[NDArray[np.intp]]:
    """The parameters that are linked with each other."""
    left = set(np.flatnonzero(linked.any(axis=0)).tolist())
    while left:
        group, ahead = set[int](), [min(left)]
        while ahead:
            k = ahead.pop()
            if k not in group:
                group.add(k)
                ahead += np.flatnonzero(linked[k]).tolist()
        left -= group
        yield np.array(sorted(group))


def _of_direction(names: Sequence[str], values: Floats, direction: Floats) -> str:
    """One direction: products and quotients if relative changes are equal, otherwise a sum."""
    if np.all(values != 0.0):
        relative = direction / values
        relative = relative / relative[np.argmax(np.abs(relative))]
        if np.all(np.abs(np.abs(relative) - 1.0) < _EQUAL):
            first, *others = zip(names, relative > 0.0, strict=True)
            marks = "/" if others and all(up == first[1] for _, up in others) else "*"
            if len(names) == 2:
                return f"only {first[0]}{marks}{others[0][0]} is determined"
            pairs = [f"{first[0]}{'/' if up == first[1] else '*'}{name}" for name, up in others]
            return f"only {' and '.join(pairs)} are determined, not {few(names)} themselves"
    if len(names) == 2:
        factor = -direction[0] / direction[1]
        sign = "+" if factor > 0.0 else "-"
        return f"only {names[0]} {sign} {abs(factor):.4g} {names[1]} is determined"
    parts = direction / direction[np.argmax(np.abs(direction))]
    told = ", ".join(f"{name} by {x:.4g}" for name, x in zip(names, parts, strict=True))
    return f"{few(names)} can change together without an effect: {told}"
