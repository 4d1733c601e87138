"""Selection of the instants of a motion that are drawn."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from kempe.base.arrays import Floats, fixed
from kempe.draw.numbers import rounded
from kempe.errors import KempeError, ModelError
from kempe.results.energy import Energy
from kempe.results.motion import Motion
from kempe.results.solution import Solution
from kempe.results.state import State

FRAMES_PER_SECOND = 60
MOST_FRAMES = 1200
#: A mechanism with many bodies has fewer frames, so that a scene has only a few megabytes.
_MOST_NUMBERS = 600_000
_FEWEST_FRAMES = 60
#: Error of accelerations and multipliers between frames, as a fraction of the largest value, above
#: which there are more frames; shortest interval, as a fraction of the motion; most frames added,
#: as a fraction of the frames.
_VISIBLE, _SHORTEST, _MORE = 0.02, 1e-4, 3.0
#: Values below this fraction of the natural scale are rounding errors.
_NOTHING = 1e-9
#: Largest error of interpolated points for which the player may interpolate, as a fraction of the
#: size of the drawing.
_INVISIBLE = 1e-3


#: First and last time, s.
Span: TypeAlias = tuple[float, float]


def sampled(
    drawn: Solution | State,
    frames: int | None,
    numbers_per_frame: int,
    span: Span | None = None,
) -> Motion:
    """The motion at the frames, in the order of time.

    The frames are evenly spaced if the solution has an interpolant; otherwise they are outputs.
    If their number is not given, there are more where forces change fast, such as at impacts.

    Args:
        drawn: a solution, or a state, which is one frame.
        frames: number of frames; chosen when None.
        numbers_per_frame: number of numbers in a frame.
        span: the part of the time that is drawn; the whole motion when None.

    Raises:
        ModelError: ``frames`` is less than 1, or the span is not in the solution.
    """
    if frames is not None and not (isinstance(frames, int) and frames >= 1):
        raise ModelError(f"frames={frames}: must be 1 or more")
    if isinstance(drawn, State):
        t = np.array([drawn.t])
        motion = Motion(drawn.compiled, t, drawn.q[None], drawn.v[None], drawn.z[None])
        known = vars(drawn).get("_dynamics")
        if known is not None:
            vars(motion)["_dynamics"] = tuple(values[None] for values in known)
        if undetermined(drawn):
            # The core takes finite multipliers only; nothing that depends on these is in the scene.
            lam = np.zeros((1, drawn.compiled.n_multipliers))
            vars(motion)["_dynamics"] = np.full((1, len(drawn.q)), np.nan), lam, np.zeros((1, 1))
        return motion
    begin, end = whole = float(drawn.t[0]), float(drawn.t[-1])
    if span is not None:
        begin, end = span
        _refuse_outside(span, whole)
    count = frames or _count(end - begin, numbers_per_frame)
    if drawn.dense is None:
        return _at_outputs(drawn, count, (begin, end))
    if begin == end:
        count = 1
    # Frames have the times that are written, so that the solution there has their numbers.
    written = [rounded(t) for t in np.linspace(begin, end, count).tolist()]
    motion = drawn(np.clip(np.array(written, dtype=np.float64), begin, end))
    try:
        _ = motion.lam
    except KempeError:  # a solution may end in a position in which reactions have no answer
        return _at_outputs(drawn, count, (begin, end))
    return motion if frames else _refined(drawn, motion, _affordable(numbers_per_frame))


def _refined(solution: Solution, motion: Motion, affordable: int) -> Motion:
    """The motion with additional frames where values between the frames are not accurate."""
    most = min(round((1.0 + _MORE) * len(motion.t)), affordable)
    shortest = _SHORTEST * (motion.t[-1] - motion.t[0])
    t = motion.t
    for event in (float(x) for one in solution.events.values() for x in one.t):
        if t[0] < event < t[-1] and len(t) < most and np.abs(t - event).min() > shortest:
            t = np.sort(np.append(t, rounded(event) or 0.0))
    motion = motion if len(t) == len(motion.t) else solution(t)
    while len(motion.t) > 2:
        t = motion.t
        middle = np.array([rounded(x) for x in ((t[:-1] + t[1:]) / 2.0).tolist()])
        try:
            error = _errors(motion, solution(middle))
        except KempeError:  # reactions half-way are undefined
            return motion
        wide = np.diff(t) > 2.0 * shortest
        worst = np.argsort(-np.where(wide, error, 0.0))[: max(0, most - len(t))]
        worst = worst[wide[worst] & (error[worst] > _VISIBLE)]
        if not len(worst):
            break
        motion = solution(np.sort(np.concatenate([t, middle[worst]])))
    return motion


def undetermined(drawn: Solution | State) -> str:
    """The reason why a state alone does not determine accelerations and reactions; or empty."""
    if isinstance(drawn, State):
        try:
            _ = drawn.lam
        except KempeError as error:
            return str(error.args[0])
    return ""


def _count(duration: float, numbers_per_frame: int) -> int:
    # A mechanism may be so fast that it is watched in slow motion, hence the lower bound.
    wished = max(4 * FRAMES_PER_SECOND, math.ceil(duration * FRAMES_PER_SECOND)) + 1
    return min(wished, MOST_FRAMES, _affordable(numbers_per_frame))


def _affordable(numbers_per_frame: int) -> int:
    return max(_FEWEST_FRAMES, _MOST_NUMBERS // max(1, numbers_per_frame))


class _Outputs(Motion):
    """Some outputs of a solution, with the quantities computed there."""

    def __init__(self, solution: Solution, kept: NDArray[np.intp]) -> None:
        rows = (values[kept] for values in (solution.t, solution.q, solution.v, solution.z))
        super().__init__(solution.compiled, *rows)
        self.kept = kept
        if solution._phases is not None:
            self._phases = solution._phases.at(solution._phases.of_row[kept])
        self._computed = fixed(solution.a[kept]), fixed(solution.lam[kept])

    @property
    def a(self) -> Floats:
        return self._computed[0]

    @property
    def lam(self) -> Floats:
        return self._computed[1]


def _refuse_outside(span: Span, whole: Span) -> None:
    first, last = span
    if not whole[0] <= first <= last <= whole[1]:
        asked = f"t = {first:g} s is" if first == last else f"{first:g} to {last:g} s are"
        raise ModelError(f"{asked} not within the motion, {whole[0]:g} to {whole[1]:g} s")


def _at_outputs(solution: Solution, count: int, span: Span) -> Motion:
    inside = (solution.t >= span[0]) & (solution.t <= span[1])
    if not inside.any():
        raise ModelError(
            f"the solution has no output from {span[0]:g} to {span[1]:g} s",
            hint="choose a longer part, or simulate with dense_output = true",
        )
    order = np.flatnonzero(inside)
    kept = order[np.unique(np.linspace(0, len(order) - 1, count).round().astype(int))]
    return _Outputs(solution, kept)


def energy(drawn: Solution | State, motion: Motion) -> Energy | None:
    """Energies at the frames; None for a state, and where an energy is not finite."""
    if isinstance(drawn, State):
        return None
    try:
        if isinstance(motion, _Outputs):
            return drawn.energy.at(motion.kept)
        return drawn.energy_at(motion.t)
    except KempeError:
        return None


def accuracy(drawn: Solution | State, motion: Motion) -> float | None:
    """The largest error of accelerations and multipliers between two frames.

    The page interpolates them by cubic polynomials with central differences as slopes. Columns of
    one unit are compared with their largest value. Where frames are closest, values may jump.

    Returns:
        The largest error half-way between frames that are not the closest possible, as a fraction
        of the largest value; None if the solution has no interpolant, or its reactions are
        undefined half-way.
    """
    if isinstance(drawn, State) or isinstance(motion, _Outputs) or len(motion.t) < 3:
        return None
    t = motion.t
    try:
        error = _errors(motion, drawn((t[:-1] + t[1:]) / 2.0))
    except KempeError:
        return None
    wide = np.diff(t) > 2.0 * _SHORTEST * (t[-1] - t[0])
    return float(error.max(initial=0.0, where=wide))


def _errors(motion: Motion, middle: Motion) -> Floats:
    """The largest error of accelerations and multipliers in each interval, as a fraction.

    Columns of one unit are compared with their largest value, and ignored if they are rounding
    errors of the other units: of rates, or of forces with the size of the mechanism as arm.
    """
    turning = np.array([name.endswith(".angle") for name in motion.compiled.column_names()], bool)
    rows = np.array([unit == "rad" for unit in motion.compiled.row_units()], bool)
    size = _largest(motion.q[:, ~turning]) or 1.0
    spin = _largest(motion.v[:, turning]) ** 2
    # multipliers of forces with modes follow those of the rows
    lam, exact_lam = motion.lam[:, : rows.size], middle.lam[:, : rows.size]
    alpha, a = (_largest(motion.a[:, of]) for of in (turning, ~turning))
    torque, force = (_largest(lam[:, of]) for of in (rows, ~rows))
    found = [np.zeros(len(motion.t) - 1)]
    for values, exact, of, largest, natural in (
        (motion.a, middle.a, turning, alpha, max(spin, a / size)),
        (motion.a, middle.a, ~turning, a, max(spin, alpha) * size),
        (lam, exact_lam, rows, torque, force * size),
        (lam, exact_lam, ~rows, force, torque / size),
    ):
        if largest > _NOTHING * natural:
            error = _error_half_way(motion.t, values[:, of], exact[:, of])
            found.append(error / max(largest, _largest(exact[:, of])))
    return np.asarray(np.max(found, axis=0))


def _largest(values: Floats) -> float:
    return float(np.abs(values).max(initial=0.0))


def _error_half_way(t: Floats, frames: Floats, exact: Floats) -> Floats:
    """The largest error in each interval."""
    h = np.diff(t)[:, None]
    inner = (frames[2:] - frames[:-2]) / (h[1:] + h[:-1])
    ends = np.diff(frames, axis=0) / h
    slopes = np.concatenate([ends[:1], inner, ends[-1:]])
    error: Floats = np.abs(_half_way(frames, slopes, h) - exact).max(axis=1, initial=0.0)
    return error


def _half_way(values: Floats, slopes: Floats, h: Floats) -> Floats:
    """Hermite's polynomial half-way between frames: (q0 + q1)/2 + h (v0 - v1)/8."""
    found: Floats = (values[:-1] + values[1:]) / 2.0 + h * (slopes[:-1] - slopes[1:]) / 8.0
    return found


def interpolation(drawn: Solution | State, motion: Motion, size: float) -> str:
    """Whether the poses between the frames follow from poses and rates: "cubic" or "none".

    Cubic Hermite interpolation is compared with the solution half-way between the frames; a motion
    that is too fast for the number of frames is not interpolated.

    Args:
        drawn: the solution or state from which the frames were taken.
        motion: the motion at the frames.
        size: size of the drawing, m.
    """
    if isinstance(drawn, State) or isinstance(motion, _Outputs) or len(motion.t) < 2:
        return "none"
    middle = _half_way(motion.q, motion.v, np.diff(motion.t)[:, None])
    exact = drawn((motion.t[:-1] + motion.t[1:]) / 2.0).q
    worst = max(
        (_misplaced(middle, exact, motion, name) for name in motion.compiled.bodies), default=0.0
    )
    return "cubic" if worst <= _INVISIBLE * size else "none"


def _misplaced(guess: Floats, exact: Floats, motion: Motion, name: str) -> float:
    """Largest error of the positions of the points of a body, m."""
    info = motion.compiled.bodies[name]
    error = (guess - exact)[:, info.columns]
    shift = np.hypot(error[:, 0], error[:, 1])
    arms = [math.hypot(*corner) for corner in (*info.points.values(), info.center)]
    if not info.turns:
        return float(shift.max())
    chord = 2.0 * np.abs(np.sin(error[:, 2] / 2.0))
    return float((shift + max(arms) * chord).max())
