"""The measures of a sweep that read reactions which redundant constraints leave open."""

from __future__ import annotations

from typing import TYPE_CHECKING

from kempe.measures import measure_info
from kempe.remarks import MINIMUM_NORM, is_unique

if TYPE_CHECKING:
    from kempe.sweeps.result import SweepResult


def not_unique(result: SweepResult) -> tuple[str, ...]:
    """The measures whose values are not unique, examined at the start of the first good variant."""
    good = result.succeeded.nonzero()[0]
    wanted = [one for one in result._plan.wanted if one.statistic]
    model = result._plan.case.model.compile()
    if model.redundancy != "allow" or not wanted or not len(good):
        return ()
    start = result.case(int(good[0])).start()
    read = {one.text: measure_info(start.compiled, one.expression).quantities for one in wanted}
    return tuple(text for text, names in read.items() if not is_unique(start, *names))


def labelled(result: SweepResult, column: str) -> str:
    """The name of a column, with a remark if its values are not unique."""
    return f"{column} [{MINIMUM_NORM}]" if column in result.minimum_norm else column
