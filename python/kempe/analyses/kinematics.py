"""Kinematics and inverse dynamics: the motion that drivers determine, and its efforts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from kempe.analyses.dynamics import slopes_along
from kempe.analyses.options import InverseDynamics, Kinematics
from kempe.analyses.record import Progress, keep_solution, run_analysis, solution_of
from kempe.base.arguments import explained
from kempe.base.warn import warn
from kempe.errors import SingularityError
from kempe.model.compiled import CompiledModel
from kempe.model.model import Model, compiled_model
from kempe.model.values import Number
from kempe.results.events import EventWarning, beyond_limits
from kempe.results.solution import Solution
from kempe.results.state import State

#: Number of outputs over a range or over time, both ends included.
POINTS = 361
#: The method of a solution.
METHOD = "continuation"


@explained
def kinematics(
    model: Model | CompiledModel,
    start: State,
    *,
    t_end: Number | None = None,
    output_step: Number | None = None,
    over: str | None = None,
    range: tuple[Number, Number] | None = None,  # noqa: A002 - as in a file
    n: int = POINTS,
    slopes: Sequence[str] = (),
    progress: Progress | None = None,
) -> Solution:
    """Positions, velocities and accelerations of a mechanism whose drivers determine its motion.

    The motion is computed over time (``t_end``), or over the value of a driver or position quantity
    (``over`` and ``range``). In the second case, ``sol.t`` contains the values, and rates are
    derivatives with respect to the value. The law of the driver is not used, and the laws of other
    drivers keep their value at the start.

    The motion is followed by short steps, so that it stays on its branch. At each output, the
    constraints Φ(q, t) = 0, Φ_q v = ν and Φ_q a = γ are satisfied to rounding (Haug 3.6).

    Args:
        model: the mechanism.
        start: an assembled state.
        t_end: end time, s.
        output_step: time between outputs, s; 1/360 of the interval when None.
        over: name of a driver, or a position quantity such as ``"crank.angle"``.
        range: first and last value, in SI units and rad.
        n: number of values in the range, both ends included.
        slopes: variables whose slopes are kept, such as ``["L2"]``; see ``Solution.slope``.
        progress: function that is called repeatedly with the time reached.

    Raises:
        SingularityError: the motion ends at a limit, such as a dead point. ``value`` is the time or
            value of the limit, ``solution`` the motion up to this limit.
        AssemblyError: the start does not satisfy the constraints.
        ModelError: the drivers leave a freedom, or an argument is invalid.
    """
    entry = Kinematics(t_end, output_step, over, range, n).tree()
    return _with_slopes(compiled_model(model), start, entry, slopes, progress)


@explained
def inverse_dynamics(
    model: Model | CompiledModel,
    start: State,
    *,
    t_end: Number | None = None,
    output_step: Number | None = None,
    over: str | None = None,
    range: tuple[Number, Number] | None = None,  # noqa: A002 - as in a file
    n: int = POINTS,
    static: bool = False,
    slopes: Sequence[str] = (),
    progress: Progress | None = None,
) -> Solution:
    """Efforts of the drivers and reactions of the joints for the motion that the drivers prescribe.

    ``kinematics`` computes the motion; its errors apply here too. The multipliers
    follow from M a + Φ_qᵀ λ = Q at each output. Work is the integral of power by adaptive
    quadrature.

    In a motion over a value instead of time, this value changes at unit rate: efforts and reactions
    contain inertia and damping at 1 rad/s or 1 m/s. With ``static``, the mechanism is at rest at
    each value, and rates, accelerations, and forces that depend on rates are zero: Φ_qᵀ λ = Q.

    Args:
        model: the mechanism.
        start: an assembled state.
        t_end: end time, s.
        output_step: time between outputs, s; 1/360 of the interval when None.
        over: name of a driver, or a position quantity such as ``"crank.angle"``.
        range: first and last value, in SI units and rad.
        n: number of values in the range, both ends included.
        static: whether the mechanism is at rest at each value; needs ``over``.
        slopes: variables whose slopes are kept, such as ``["L2"]``; see ``Solution.slope``.
        progress: function that is called repeatedly with the time reached.

    Raises:
        ModelError: a force has first-order states, such as the current of a motor, which do not
            follow from the motion.
    """
    entry = InverseDynamics(t_end, output_step, over, range, n, static=static).tree()
    return _with_slopes(compiled_model(model), start, entry, slopes, progress)


def _with_slopes(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    slopes: Sequence[str],
    progress: Progress | None,
) -> Solution:
    """The motion with the options of an entry, and its slopes by some variables."""
    along = slopes_along(model, start, entry, slopes)
    solution = follow(model, start, entry, progress)
    solution._slopes = along
    return solution


def follow(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    progress: Progress | None = None,
    after: str | None = None,
) -> Solution:
    """The motion with the options of an entry of a case; see both analyses."""
    kept = model.with_analyses({str(entry["type"]): dict(entry)})
    try:
        record = run_analysis(kept, start, entry, progress, after=after)
    except BaseException as error:  # including interruptions and exceptions of progress
        keep_solution(error, METHOD)
        if isinstance(error, SingularityError):
            error.value = error.t
        raise
    solution = solution_of(record, METHOD)
    if entry["type"] == "inverse_dynamics":
        for text in beyond_limits(solution, entry):
            warn(text, EventWarning)
    return solution
