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
    if not len(np.atleast_1d(motion.t)):
        return frozenset()
    rows = motion._rows()
    some = np.unique(np.linspace(0, len(rows[0]) - 1, _EXAMINED).round().astype(int))
    states = _core.States(motion.compiled.core, *(of[some] for of in rows))
    return frozenset(states.not_unique())
