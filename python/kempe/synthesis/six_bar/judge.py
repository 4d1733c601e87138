"""Defects of six-bars, by the analyses ``limits`` and ``kinematics`` of their cases."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.analyses.kinematics import kinematics
from kempe.analyses.limits import limits as limits_of
from kempe.base.arrays import Floats, fixed
from kempe.errors import KempeError
from kempe.results.solution import Solution
from kempe.synthesis.six_bar.candidate import SixBar
from kempe.synthesis.six_bar.topology import Topology
from kempe.synthesis.tasks import Complexes

Flags: TypeAlias = NDArray[np.bool_]
#: Directions of bodies that differ by less are the same position.
_SAME = 1e-6
#: Least sine of a transmission angle that is no dead point, as for four-bars.
_DEAD = 1e-6
#: Positions of a full turn for the transmission angle.
_TURN = 361
#: Step along a circuit, rad, and most steps.
_STEP, _MOST = 0.03, 4000


def judged(made: list[SixBar], linkage: Floats, angles: Floats, way: int) -> list[SixBar]:
    """Six-bars of a family with their defects.

    Args:
        made: at the first position, with the crank angles of the positions.
        linkage: their unknowns, (n, size).
        angles: of their bodies at the positions, (n, n_positions, n_bodies).
        way: 1 or -1 if the crank must turn counter-clockwise or clockwise, otherwise 0.
    """
    found, missed = [], np.zeros(angles.shape[:2], dtype=bool)
    for k, one in enumerate(made):
        seen, places = _judged(one, linkage[k], angles[k], way)
        found.append(seen)
        missed[k, places] = True
    rows = np.flatnonzero(missed.any(axis=1))
    if len(rows):
        wanted = np.where(missed[rows, :, None], angles[rows], np.nan)
        there = traced(found[0].family, linkage[rows], angles[rows, 0], wanted)
        for row, reached in zip(rows, there, strict=True):
            kind, flags = ("branch", missed[row]) if reached.all() else ("circuit", ~reached)
            told = f"{kind}: at position {int(np.argmax(flags)) + 1}"
            found[row] = replace(found[row], defects=(told, *found[row].defects))
    return found


def _judged(one: SixBar, linkage: Floats, angles: Floats, way: int) -> tuple[SixBar, list[int]]:
    """A six-bar with its defects, and the positions that its crank does not reach."""
    family, crank = one.family, angles[:, one.family.crank]
    sines = transmission(family, linkage, angles)
    here = np.flatnonzero(sines < _DEAD)
    wrong = {"dead point": int(here[0])} if len(here) else {}
    try:
        case = one.case
        start = case.start()
        range_ = limits_of(case.model, start, over="crank.angle")
    except KempeError:
        return _told(one, {"dead point": 0}, crank, False, 0.0), []
    begin, turns = range_.start, range_.turns or 0
    low = begin if range_.lower is None else range_.lower
    high = begin + 2.0 * np.pi * turns if range_.upper is None else range_.upper
    values = [_values(float(x), low, high) for x in crank]
    ends = (min(min(v, default=begin) for v in values), max(max(v, default=begin) for v in values))
    try:
        runs = [
            kinematics(case.model, start, over="crank.angle", range=(begin, end), n=_TURN)
            for end in ((high,) if turns else ends)
            if end != begin
        ]
    except KempeError:
        return _told(one, wrong or {"dead point": 0}, crank, False, 0.0), []
    reached = [_reached(family, runs, begin, v, at) for v, at in zip(values, angles, strict=True)]
    missed = [k for k, x in enumerate(reached) if x is None]
    if missed:
        return _told(one, wrong, crank, bool(turns), 0.0), missed
    found, late = _ordered(np.array(reached, dtype=float), 2.0 * np.pi * turns, way)
    if late is not None:
        wrong["order"] = late
    least = 0.0
    if turns:
        every = np.stack([runs[0][f"{body}.angle"] for body in family.bodies], axis=1)
        least = float(np.arcsin(min(transmission(family, linkage, every).min(), 1.0)))
    return _told(one, wrong, found, bool(turns), least), []


def _told(one: SixBar, wrong: dict[str, int], crank: Floats, turns: bool, least: float) -> SixBar:
    defects = tuple(f"{kind}: at position {k + 1}" for kind, k in wrong.items())
    return replace(
        one,
        defects=defects,
        crank_angles=fixed(np.array(crank)),
        turns=turns,
        grashof=turns,
        transmission_angle=least,
    )


def _values(angle: float, low: float, high: float) -> list[float]:
    """The angles in a range that differ from one by full turns."""
    first = np.ceil((low - _SAME - angle) / (2.0 * np.pi))
    found = []
    while angle + 2.0 * np.pi * first <= high + _SAME:
        found.append(float(np.clip(angle + 2.0 * np.pi * first, low, high)))
        first += 1.0
    return found


def _reached(
    family: Topology, runs: list[Solution], begin: float, values: list[float], at: Floats
) -> float | None:
    """The value of the crank at which a run has a position."""
    for value in values:
        for run in runs:
            ends = sorted((float(run.t[0]), float(run.t[-1])))
            if value != begin and not ends[0] <= value <= ends[1]:
                continue
            state = run(np.array([min(max(value, ends[0]), ends[1])]))
            now = np.array([state[f"{body}.angle"][0] for body in family.bodies])
            if abs(np.exp(1j * now) - np.exp(1j * at)).max() < _SAME:
                return value
    return begin if not runs else None


def _ordered(values: Floats, period: float, way: int) -> tuple[Floats, int | None]:
    """Crank angles that grow or fall, and the first position that is out of order."""
    steps, best = np.diff(values), None
    for sign in (way,) if way else (1, -1):
        moved = sign * steps
        if period:
            moved %= period
            late = np.flatnonzero(np.cumsum(moved) >= period - 1e-9)
        else:
            late = np.flatnonzero(moved <= 0.0)
        found = values[0] + sign * np.concatenate([[0.0], np.cumsum(moved)])
        key = (len(late), moved.sum())
        if best is None or key < best[0]:
            best = (key, found, int(late[0]) + 1 if len(late) else None)
    assert best is not None
    return best[1], best[2]


def transmission(family: Topology, linkage: Floats, angles: Floats) -> Floats:
    """The least sine of the transmission angles at positions, (n,)."""
    at = {name: z[0] for name, z in family.points(linkage[None], angles[None]).items()}

    def sine(one: Complexes, two: Complexes) -> Floats:
        with np.errstate(all="ignore"):
            return np.asarray(np.nan_to_num(abs((one.conj() * two).imag) / (abs(one) * abs(two))))

    bodies = family.bodies
    if "strut" not in bodies:
        feet = {body: points[0] for body, points in bodies.items()}
        return np.minimum(
            sine(at["B"] - at[feet["link"]], at["B"] - at[feet["rocker"]]),
            sine(at["F"] - at[feet["coupler"]], at["F"] - at[feet["arm"]]),
        )
    found = []
    for near, far, other in (("E", "B", "FC"), ("F", "C", "EB")):
        # the pole is on the line of the other link and on that of the pivots A and D
        one, two = at[other[0]] - at[other[1]], at["D"] - at["A"]
        across = (one.conj() * two).imag
        along = ((at["A"] - at[other[1]]).conj() * two).imag
        # from the pin to the pole, times the sine of both lines
        to = (at[other[1]] - at[near]) * across + one * along
        found.append(sine(at[near] - at[far], to))
    return np.minimum(*found)


def traced(family: Topology, linkage: Floats, start: Floats, wanted: Floats) -> Flags:
    """Whether positions are on the circuits of starts, through dead points too.

    Args:
        family: the bodies.
        linkage: (n, size).
        start: angles of the bodies, (n, n_bodies).
        wanted: positions of each, (n, n_positions, n_bodies); NaN for none.
    """
    now, goal = start.copy(), np.exp(1j * wanted)
    found, ways = ~np.isfinite(wanted[:, :, 0]), np.zeros(start.shape)
    going = np.flatnonzero(~found.all(axis=1))
    for k in range(_MOST):
        own, at = linkage[going], now[going]
        ways[going] = _along(family.gaps(own, at[:, None])[1][:, 0], ways[going])
        way = ways[going][:, None]
        apart = np.angle(goal[going] * np.exp(-1j * at)[:, None])
        along = (apart * way).sum(axis=2)
        beside = abs(apart - along[..., None] * way).max(axis=2)
        found[going] |= (abs(along) <= _STEP) & (beside < 0.2 * _STEP)
        back = np.linalg.norm(np.exp(1j * at) - np.exp(1j * start[going]), axis=1)
        going = going[~found[going].all(axis=1) & ((k < 4) | (back > 0.7 * _STEP))]
        if not len(going):
            break
        guess = now[going] + _STEP * ways[going]
        for _ in range(2):
            gaps, slopes = family.gaps(linkage[going], guess[:, None])
            guess = guess - (np.linalg.pinv(slopes[:, 0]) @ gaps[:, 0, :, None])[..., 0]
        now[going] = guess
    return found


def _along(slopes: Floats, before: Floats) -> Floats:
    """The directions in which linkages move, (n, n_bodies), each as the one before."""
    found = np.linalg.svd(slopes)[2][:, -1]
    return np.where((found * before).sum(axis=1, keepdims=True) >= 0.0, found, -found)
