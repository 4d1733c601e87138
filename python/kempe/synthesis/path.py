"""Path synthesis: linkages whose coupler point passes given points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from kempe import _core
from kempe.base.arguments import explained
from kempe.model.given import value
from kempe.model.values import Number, refuse
from kempe.synthesis import assemble, nine, tasks
from kempe.synthesis.found import Found, ended_early
from kempe.synthesis.six_bar import search as six_bars
from kempe.synthesis.tasks import Complexes


@explained
def path(
    points: Sequence[Sequence[Number]],
    family: str = "four_bar",
    angles: Sequence[Number] | None = None,
    *,
    offsets: str = "free",
    pivots: Mapping[str, Sequence[Number]] | None = None,
    parts: Mapping[str, Any] | None = None,
    starts: int | None = None,
    seed: int = 0,
    progress: tasks.Progress | None = None,
    **limits: Any,
) -> Found:
    """Linkages whose coupler point passes points, in the given order.

    With crank angles, all solutions for five points are found, by elimination. Fewer points leave
    choices, which are sampled; up to four can be exact if the angles are measured from the x axis.
    Without angles, up to nine points can be exact. All solutions for nine points are found, by
    continuation from stored solutions of other points, and ``followed`` counts them. For fewer
    points, the method of Levenberg and Marquardt starts from four-bars through five of them, so
    that solutions may be missing. More points are approximated by least squares. The search starts
    from four-bars of an atlas whose coupler curves resemble the curve through the points, which is
    closed if its ends are as near as the points. ``synthesis/src/path/`` and
    ``synthesis/src/nine/`` contain the searches.

    Six-bars are approximated by least squares for any number of points. Starts are those of an
    atlas of random six-bars whose coupler curves resemble the one through the points. The analyses
    ``limits`` and ``kinematics`` of each case give its defects. Solutions may be missing.

    Args:
        points: x and y, m.
        family: "four_bar", or a six-bar: "watt_1", "watt_2", "stephenson_1", "stephenson_2" or
            "stephenson_3".
        angles: angle of the crank at each point, rad, or texts such as "30 deg"; None if free.
        offsets: "free" if only differences of the angles count, "fixed" if they are measured from
            the x axis.
        pivots: fixed ground pivots, ``{"O": (x, y), "D": (x, y)}``, m; O belongs to the crank.
        parts: prescribed bodies of a six-bar: the distance of its first two points, m, the least
            and the largest one, or all its points in a frame of its own, as in
            ``{"crank": 0.1, "arm": (0.2, 0.4), "link": {"A": (0, 0), "B": (0.3, 0), "C": ...}}``.
        starts: number of starts; None for as many as the task usually needs. With a number, nine
            points are searched from starts, too.
        seed: of samples and starts.
        progress: called with the number of starts that were tried, and that of all.
        limits: ``defects``, ``transmission_angle``, ``grashof``, ``within``, ``direction`` and
            ``masses``; ``limits`` describes them.

    Raises:
        ModelError: no linkage was found, or an argument is invalid.
        KeyboardInterrupt: Ctrl-C was pressed; ``result`` has what was found so far, or is None.
    """
    more: dict[str, Any] = {
        "offsets": offsets,
        "pivots": pivots,
        "parts": parts,
        "starts": starts,
        "seed": seed,
    }
    return solved(points, family, angles, follows=True, progress=progress, **more, **limits)


def solved(
    points: Sequence[Sequence[Number]],
    family: str = "four_bar",
    angles: Sequence[Number] | None = None,
    *,
    offsets: str = "free",
    pivots: Mapping[str, Sequence[Number]] | None = None,
    parts: Mapping[str, Any] | None = None,
    starts: int | None = None,
    seed: int = 0,
    progress: tasks.Progress | None = None,
    follows: bool,
    **limits: Any,
) -> Found:
    """The same; ``follows`` says whether stored solutions are followed, which the studio lacks."""
    bodies = assemble.families(family, ("four_bar", *six_bars.FAMILIES), limits, parts)
    asked, places = assemble.limits(**limits), tasks.points(points)
    if offsets not in ("free", "fixed"):
        refuse("offsets", f"{offsets!r}; must be 'free' or 'fixed'")
    if starts is not None and starts < 1:
        refuse("starts", f"{starts}; at least one")
    cranks = [] if angles is None else _angles(angles, len(places))
    if bodies is not None:
        task = six_bars.Asked(bodies, asked, pivots, parts, starts, seed, progress)
        return six_bars.path(task, places, cranks, fixed=offsets == "fixed")
    fixed = tasks.pivots(pivots, "O D")
    either = angles is None and not fixed
    follows = follows and either and starts is None
    bars, complete, followed, stopped = None, False, None, None
    if follows and len(places) == 9:
        bars, followed, stopped = nine.four_bars(places, progress)
        complete = followed.found == followed.paths
    if bars is None or not (len(bars.o) or stopped):
        given, free = tasks.pairs_in(places), offsets == "free"
        found, every, stopped = _core.path_four_bars(
            given, cranks, free, tasks.both(fixed), starts, seed, progress
        )
        bars, complete = assemble.traced(found, len(places)), complete or every
    if follows and not stopped and len(places) == 8 and bars.error.min() > _exact(places):
        better, stopped = nine.through_eight(places, progress)
        bars = better or bars
    made = assemble.collected(
        bars, asked, either=either, complete=complete, task=places, followed=followed
    )
    if stopped is not None:
        raise ended_early(stopped, made if len(bars.o) else None)
    return made


def _exact(places: Complexes) -> float:
    """The error below which a four-bar is exact, m."""
    return 1e-10 * tasks.size(places)


def _angles(given: Sequence[Number], n: int) -> list[float]:
    if len(given) != n:
        refuse("angles", f"{len(given)} for {n} points; one for each point")
    return [value(x, f"angles[{k}]", "rad") for k, x in enumerate(given, 1)]
