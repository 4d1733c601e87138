"""All four-bars through nine points, and four-bars through eight."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from kempe import _core
from kempe.synthesis import assemble, tasks
from kempe.synthesis.found import Followed
from kempe.synthesis.tasks import Complexes

#: The solutions of general points; ``synthesis/examples/nine_points.rs`` makes them again.
_START = Path(__file__).with_name("nine_points.bin")


def four_bars(
    places: Complexes, progress: tasks.Progress | None
) -> tuple[assemble.Bars, Followed, BaseException | None]:
    """All four-bars through nine points, with the numbers of solutions that were followed.

    The last part is the exception that ended the search early.
    """
    start = _START.read_bytes()
    found, numbers, stopped = _core.nine_point_four_bars(tasks.pairs_in(places), start, progress)
    return assemble.traced(found, len(places)), Followed(*numbers), stopped


def through_eight(
    places: Complexes, progress: tasks.Progress | None
) -> tuple[assemble.Bars | None, BaseException | None]:
    """Four-bars through eight points and one more, on a smooth curve between two of them.

    The widest gaps come first, until there are four-bars; None if there are none. The last part is
    the exception that ended the search early.
    """
    before, left, right, after = (places[k : k + 5] for k in range(4))
    between = (9.0 * (left + right) - before - after) / 16.0
    for gap in np.argsort(-abs(right - left), kind="stable"):
        at = int(gap) + 2
        bars, _, stopped = four_bars(np.insert(places, at, between[gap]), progress)
        if len(bars.o):
            a, b, p = (np.delete(of, at, axis=1) for of in (bars.a, bars.b, bars.p))
            return assemble.Bars(bars.o, a, b, bars.d, p, bars.frame, bars.error), stopped
        if stopped is not None:
            return None, stopped
    return None, None
