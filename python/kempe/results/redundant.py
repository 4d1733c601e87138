"""Joints and drivers that redundant constraints leave without a unique reaction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe import _core

if TYPE_CHECKING:
    from kempe.results.motion import Motion

#: Largest number of states that are examined.
_EXAMINED = 11


def redundant(motion: Motion) -> frozenset[str]:
    """The names of such joints and drivers."""
    if motion.compiled.redundancy != "allow" or not len(np.atleast_1d(motion.t)):
        return frozenset()
    t, q, _ = motion._rows()
    some = np.unique(np.linspace(0, len(t) - 1, _EXAMINED).round().astype(int))
    model = motion.compiled.core
    return frozenset(_core.not_unique(model, t[some], np.ascontiguousarray(q[some])))
