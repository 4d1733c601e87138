"""Costs on a machine that also does other work.

Other work makes a measured time longer, never shorter. A cost is within a limit if one of several
measurements is, and a program that is too slow fails in all of them.
"""

import time
from collections.abc import Callable

#: Measurements before a cost is too high, and the seconds between them.
TRIES, PAUSE = 5, 2.0


def within(limit: float, cost: Callable[[], float]) -> bool:
    """Whether `cost()` is below `limit` in one of five measurements."""
    for left in reversed(range(TRIES)):
        if cost() < limit:
            return True
        if left:
            time.sleep(PAUSE)
    return False
