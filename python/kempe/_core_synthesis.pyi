"""Python interface of the compiled core: synthesis of linkages."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from kempe._core_cams import *  # noqa: F403

_F = NDArray[np.float64]
_Place = tuple[float, float]
_Dyads = list[list[float]]
#: Whether defects are kept, the least transmission angle, Grashof's condition, limits, direction.
_Limits = tuple[bool, float | None, str | None, list[list[float]] | None, int]
#: Number, whether its rocker is the crank, full turns, Grashof's condition, the least transmission
#: angles over a turn and at the positions, defects, angles of the crank.
RankedLinkage = tuple[int, bool, bool, bool, float, float, list[str], list[float]]

#: (o, a, b, d) of four-bars and the coupler point at all positions, the angles of the moving frame
#: at the first position, errors.
Traces = tuple[_F, list[float], list[float]]

def dyad_conditions(places: list[_Place], angles: list[float]) -> _Dyads:
    """The conditions of poses on (1, w, g, u, v), one for each pose after the first."""

def all_dyads(
    rows: _Dyads,
    poses: int,
    pivot: _Place | None,
    samples: int,
    seed: int,
    ends: list[str],
    what: str,
) -> tuple[_Dyads, bool]:
    """All dyads (1, w, g, u, v) with linear conditions, or samples; whether these are all.

    The first ``poses`` conditions are those of poses, whose name is ``what``; a fixed pivot is in
    their frame. ``ends`` has "pin" and "pivot", whichever is sampled.
    """

def dyads_with_end(rows: _Dyads, end: str, at: list[_Place]) -> _Dyads:
    """The dyads with given ends ("pin" or "pivot"), the shortest one for each."""

def pairs_of_dyads(first: int, second: int | None, seed: int) -> list[tuple[int, int]]:
    """Pairs of places in two lists with these lengths; in one list without a second."""

def four_bars(
    places: list[_Place],
    angles: list[float],
    pivots: tuple[_Place | None, ...],
    samples: int,
    seed: int,
) -> tuple[_F, list[float], bool]:
    """Four-bars through two to five poses: (o, a, b, d) of all, errors, whether these are all."""

def ranked_linkages(
    linkages: _F,
    errors: list[float],
    slides: bool,
    limits: _Limits,
    either: bool,
    complete: bool,
) -> tuple[list[RankedLinkage], list[tuple[str, int]]]:
    """Candidates, best first, and the numbers of linkages that defects and limits exclude.

    ``linkages`` has (o, a, b, end) of each in a row, the end of a slide being its direction.
    """

def path_four_bars(
    places: list[_Place],
    cranks: list[float],
    offset: bool,
    pivots: tuple[_Place | None, ...],
    starts: int | None,
    seed: int,
    progress: Callable[[int, int], None] | None,
) -> tuple[Traces, bool, BaseException | None]:
    """Four-bars whose coupler point passes points, and whether these are all.

    The last part is the exception that ended the search early, such as KeyboardInterrupt.
    ``cranks`` are angles of the crank or none, ``offset`` says whether their origin is free.
    """

def nine_point_four_bars(
    places: list[_Place], stored: bytes, progress: Callable[[int, int], None] | None
) -> tuple[Traces, list[int], BaseException | None]:
    """All four-bars whose coupler point passes nine points, from a stored start.

    The last part is the exception that ended the search early.

    The numbers are those of the four-bars that start, of different ends, of those that were
    followed again, and of real ends.
    """

def near_poses(
    places: list[_Place], angles: list[float], pivots: tuple[_Place | None, ...], linkages: _F
) -> Traces:
    """The four-bars near given ones whose coupler fits poses best; a row has (o, a, b, d)."""

def fit_pairs(
    targets: list[list[float]],
    closing: float,
    linkage: list[float],
    positions: list[list[float]],
    free: list[bool],
    steps: int,
) -> tuple[list[float], list[list[float]], float]:
    """A four-bar near a start whose rocker fits pairs: linkage, positions, sum of squares."""
