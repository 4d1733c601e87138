"""The derivatives of the frequency of a measure, from those of its values at the outputs."""

from __future__ import annotations

import numpy as np

from kempe.base.arrays import Floats
from kempe.results.dominant_frequency import slopes_of_frequency
from kempe.results.measures import Measure
from kempe.results.solution import Solution
from kempe.sweeps.plan import NoSlopesError, Plan
from kempe.sweeps.wanted import Wanted

#: Differences of the steps of outputs that are rounding errors, as a part of the duration.
_ROUNDED = 1e-9


def of_frequency(plan: Plan, one: Wanted, row: Floats) -> tuple[float, Floats] | str:
    """The frequency and its derivatives, (n_variables,), or why there are none.

    Raises:
        KempeError: the run fails.
    """
    found = plan.run(row)
    assert isinstance(found, Solution)
    measure = Measure(found, one._info(found.compiled))
    t, steps = measure.t, np.abs(np.diff(measure.t))
    if np.isnan(measure.frequency):
        return "there is no oscillation"
    moves = np.ptp(steps[:-1]) > _ROUNDED * abs(t[-1] - t[0])
    if found.status != 0 or moves:
        return (
            "it is that of the outputs, some of which move with events; a run without events has "
            "its derivative"
        )
    try:
        _, slopes = plan.slopes_at([one.expression], t, row)
    except NoSlopesError as error:
        return str(error.args[0])
    changed = slopes_of_frequency(t, measure.values, slopes[:, 0])
    if changed is None:
        return "no oscillation fits the outputs well enough"
    return measure.frequency, changed
