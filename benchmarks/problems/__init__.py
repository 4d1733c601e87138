"""The measured mechanisms, by name."""

from __future__ import annotations

from dataclasses import replace

from problems.andrews import andrews
from problems.flagship import flagship
from problems.n_four_bar import n_four_bar
from problems.planar import Motion, Problem

__all__ = ["ACCEPTED", "COST", "NAMES", "Motion", "Problem", "problem"]

#: N of the N-four-bar.
WINDOWS = (1, 2, 10, 40, 100, 1000)
NAMES = ("flagship", "andrews", *(f"n_four_bar_{n}" for n in WINDOWS))
#: The same over one second, for the cost against N.
COST = tuple(f"windows_{n}" for n in WINDOWS)
#: A setting counts if the error of B0 is below this limit, m; all tools reach it.
ACCEPTED = 1e-4


def problem(name: str) -> Problem:
    """A problem by its name."""
    if name == "flagship":
        return flagship()
    if name == "andrews":
        return andrews()
    if name in COST:
        return replace(n_four_bar(int(name.removeprefix("windows_")), t_end=1.0), name=name)
    if name in NAMES:
        return n_four_bar(int(name.removeprefix("n_four_bar_")))
    raise SystemExit(f"unknown problem {name!r}; there are {', '.join((*NAMES, *COST))}")
