"""Loads that contacts and friction at rest share in more than one way."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe import _core

if TYPE_CHECKING:
    from kempe.results.motion import Motion
    from kempe.results.phases import Phases

#: Largest number of phases that are examined.
_EXAMINED = 11
#: Modes of forces at rest whose equations depend on other equations.
_DEPENDENT = {"idle", "carries", "follows"}


def shared(motion: Motion, phases: Phases | None) -> frozenset[str]:
    """The joints, drivers and forces with such loads.

    The first and last state of a phase are examined; with many phases, those of eleven of them.
    """
    rows = motion._rows()
    if phases is None:
        cores = {0: motion.compiled.core}
        of_row = np.zeros(len(rows[0]), dtype=int)
    else:
        used = np.unique(phases.of_row)
        depend = [
            phase
            for phase in used.tolist()
            if any(mode in _DEPENDENT for _, mode, *_ in phases.models.setting(phase)[2])
        ]
        places = np.linspace(0, len(depend) - 1, _EXAMINED).round().astype(int)
        some = {depend[k] for k in places} if depend else set()
        cores = {phase: phases.models[phase].core for phase in some}
        of_row = phases.of_row
    found: frozenset[str] = frozenset()
    for phase, core in cores.items():
        own = np.flatnonzero(of_row == phase)[[0, -1]]
        found = found.union(_core.States(core, *(of[own] for of in rows)).not_unique()[2])
    return found
