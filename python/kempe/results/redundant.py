"""Joints and drivers whose equations depend on each other, so that reactions are not unique."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe import _core

if TYPE_CHECKING:
    from kempe.results.motion import Motion

#: Largest number of states that are examined.
_EXAMINED = 11


def redundant(motion: Motion) -> tuple[frozenset[str], frozenset[str]]:
    """Their names: of redundant equations, and of equations that hold to second order only."""
    if not len(np.atleast_1d(motion.t)):
        return frozenset(), frozenset()
    rows = motion._rows()
    some = np.unique(np.linspace(0, len(rows[0]) - 1, _EXAMINED).round().astype(int))
    states = _core.States(motion.compiled.core, *(of[some] for of in rows))
    shared, kept, _ = states.not_unique()
    return frozenset(shared), frozenset(kept)
