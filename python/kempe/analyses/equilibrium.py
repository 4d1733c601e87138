"""Statics: the equilibrium position of a mechanism, and its stiffness at a point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from kempe import _core
from kempe.analyses.equilibrium_result import EquilibriumResult
from kempe.analyses.options import Equilibrium
from kempe.analyses.record import Progress, check, released, run_analysis
from kempe.base.arguments import explained
from kempe.base.arrays import Floats, fixed
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.model import Model, compiled_model
from kempe.model.values import Number, texts
from kempe.results.state import State

__all__ = ["EquilibriumResult", "PointStiffness", "equilibrium", "stiffness_at"]

#: Compliance in a direction, relative to the largest compliance, that counts as zero.
_RIGID = 1e-12


@explained
def equilibrium(
    model: Model | CompiledModel,
    start: State,
    *,
    hold: Sequence[str] = (),
    over: str | None = None,
    range: tuple[Number, Number] | None = None,  # noqa: A002 - as in a file
    nearest: bool = False,
    progress: Progress | None = None,
) -> EquilibriumResult:
    """The position in which a mechanism comes to rest, or a path of such positions.

    At rest, the rates are zero, drivers hold their coordinates at the time of the start, and
    first-order states such as currents have their stationary values. The search descends the
    potential from the start, so that it leaves maxima and saddles. A start that is itself an
    equilibrium is returned, stable or not.

    With ``over`` and ``range``, the path of equilibria over a parameter is followed by arc length
    from the equilibrium at the first value. The path passes folds, where it turns back, and ends
    where it leaves the range.

    Args:
        model: the mechanism.
        start: an assembled state; its rates are ignored.
        hold: position quantities that a holder keeps at their values of the start, such as
            ``["crank.angle"]``; ``effort`` gives the force or torque of the holder.
        over: a parameter of the model.
        range: first and last value of the parameter, in SI units and rad.
        nearest: find the equilibrium nearest to the start by plain Newton iteration, stable or not.
        progress: function that is called repeatedly, with the number of steps or with the value of
            the parameter.

    Raises:
        SingularityError: there is no equilibrium within reach, or the position is singular.
        AssemblyError: the mechanism does not close.
        ModelError: an argument is invalid.
    """
    entry = Equilibrium(hold or None, over, range, nearest).tree()
    return EquilibriumResult(run_analysis(compiled_model(model), start, entry, progress))


@dataclass(frozen=True)
class PointStiffness:
    """The stiffness at a point: a small force displaces the point by ``compliance @ force``.

    Where the point cannot move, the stiffness is infinite and the compliance zero.

    Attributes:
        compliance: (2, 2), m/N, global axes.
        stiffnesses: (2,), N/m, along the principal directions, ascending; ``inf`` where the point
            cannot move, negative where the position of the point is unstable.
        directions: (2, 2), the principal directions as rows, unit vectors.
    """

    compliance: Floats
    stiffnesses: Floats
    directions: Floats

    def along(self, direction: Sequence[float] | Floats) -> float:
        """Force over displacement along a direction if the force acts along it, N/m."""
        u = np.asarray(direction, dtype=float)
        if u.shape != (2,) or not np.any(u):
            raise ModelError("direction: must be two numbers, not both zero")
        u = u / np.hypot(*u)
        gives = float(u @ self.compliance @ u)
        largest = float(np.abs(self.compliance).max(initial=0.0))
        return float("inf") if abs(gives) <= _RIGID * largest or gives == 0.0 else 1.0 / gives


@explained
def stiffness_at(
    model: Model | CompiledModel, state: State, point: str, *, hold: Sequence[str] = ()
) -> PointStiffness:
    """The stiffness at a point of a mechanism at rest, from the exact reduced stiffness.

    Args:
        model: the mechanism.
        state: a state at rest, such as the result of ``equilibrium``.
        point: a point of a body, such as ``"crank.B"``.
        hold: position quantities that a holder keeps; the state must be at rest with the holder.

    Raises:
        ModelError: there is no such point, or the state is not at rest.
        SingularityError: the point moves without any stiffness.
    """
    compiled = compiled_model(model)
    check(compiled, state, "state")
    compiled = compiled.variant(([], released(compiled, state), []))
    held = texts(hold, "hold")
    at = state.t, state.q, state.v, state.z
    c = np.array(_core.compliance(compiled.core, *at, point, held)).reshape(2, 2)
    values, vectors = np.linalg.eigh(0.5 * (c + c.T))
    rigid = np.abs(values) <= _RIGID * np.abs(values).max(initial=0.0)
    with np.errstate(divide="ignore"):
        stiffnesses = np.where(rigid, np.inf, 1.0 / np.where(rigid, 1.0, values))
    order = np.argsort(stiffnesses)
    return PointStiffness(fixed(c), fixed(stiffnesses[order]), fixed(vectors.T[order]))
