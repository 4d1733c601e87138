"""Read-only arrays for results."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.errors import ModelError

Floats: TypeAlias = NDArray[np.float64]

_FLOAT = np.dtype(np.float64)
#: Numbers below this part of the largest of their kind are rounding errors.
ROUNDING = 1e-12


def fixed(values: Any) -> Floats:
    """The values as a read-only float64 array in C order, without a copy if possible."""
    if type(values) is np.ndarray and values.dtype is _FLOAT:
        flags = values.flags
        if flags.c_contiguous and not flags.writeable:
            return values
    view: Floats = np.asarray(values, dtype=np.float64, order="C").view()
    view.setflags(write=False)
    return view


def scalar(values: Any) -> Any:
    """A float for a single number, otherwise a read-only array."""
    return float(values) if np.ndim(values) == 0 else fixed(values)


def rotated(angle: Floats, s: tuple[Any, Any]) -> tuple[Floats, Floats]:
    """A(φ) s for a vector s fixed in a body: its global components."""
    cos, sin = np.cos(angle), np.sin(angle)
    return cos * s[0] - sin * s[1], sin * s[0] + cos * s[1]


def pairs(x: Any, y: Any) -> Floats:
    """Two components side by side, (…, 2)."""
    return fixed(np.stack([x, y], axis=-1))


def finite(name: str, values: object, shape: tuple[int, ...]) -> Floats:
    """Finite numbers of the given shape, as given to a motion.

    Raises:
        ModelError: they are not numbers, not finite, or have another shape.
    """
    try:
        found = np.array(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ModelError(f"{name} must be numbers: {error}") from error
    if found.shape != shape:
        hint = "model.column_names() gives the order of q"
        raise ModelError(f"{name} has shape {found.shape}; must be {shape}", hint=hint)
    if not np.isfinite(found).all():
        raise ModelError(f"{name} contains a number that is not finite")
    return found


def tidy(values: Floats, scale: float = 0.0) -> list[float]:
    """Numbers of one kind, with rounding errors replaced by zeros.

    Args:
        values: the numbers.
        scale: a natural magnitude of the numbers; the largest number is used if it is larger.
    """
    least = ROUNDING * float(np.abs(values).max(initial=scale))
    tidied: list[float] = np.where(np.abs(values) <= least, 0.0, values).tolist()
    return tidied
