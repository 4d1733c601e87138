"""Friction at rest: its modes at states outside of runs, and the range of reactions beside it.

Where friction without a regularising velocity is at rest, a run decides whether it sticks, or in
which direction it begins to slide. The same holds at any state. While drivers hold it, it may carry
any part of the load up to its limit; reports give the middle of this range.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe import _core
from kempe.results.phases import Phases
from kempe.results.phases import phases as of_settings

if TYPE_CHECKING:
    from kempe.base.arrays import Floats
    from kempe.results.motion import Motion

#: Ranges of multipliers below this part of the largest one are rounding errors.
_NOTHING = 1e-9


def phases(motion: Motion) -> Phases | None:
    """The phases of the rows of a motion outside of a run; None if no friction is at rest.

    Raises:
        SingularityError: no friction agrees with the reactions.
    """
    core = motion.compiled.core
    parameters, released, modes = core.setting
    if modes:  # a run has decided
        return None
    found = _core.States(core, *motion._rows()).friction_modes()
    if not any(own for _, own in found):
        return None
    settings = [(row, (parameters, released, own)) for row, own in found]
    return of_settings(motion.compiled, settings, len(np.atleast_1d(motion.t)))


def multiplier_range(motion: Motion) -> tuple[Floats, Floats] | None:
    """The least and the largest multipliers; see ``Motion.multiplier_range``."""
    if motion._decided is None and not motion.compiled.core.setting[2]:
        return None
    found: list[Sequence[Floats] | None] = []

    def ask(states: _core.States, lam: Floats) -> Sequence[Floats]:
        ends = states.friction_range(motion._passing)
        found.append(ends)
        return ends or (lam, lam)

    low, high = motion._asked(ask, motion.lam)
    return (low, high) if any(ends is not None for ends in found) else None


def joints(motion: Motion) -> frozenset[str]:
    """Joints and drivers whose multipliers have a range."""
    ends = motion.multiplier_range
    if ends is None:
        return frozenset()
    low, high = ends
    wide = high - low > _NOTHING * np.abs(motion.lam).max(initial=0.0)
    all_ = motion.compiled.constraints
    return frozenset(name for name, info in all_.items() if wide[:, info.rows].any())
