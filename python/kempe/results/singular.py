"""The singular positions that a run passed, and the accuracy that is lost beside them.

Let σ be the smallest singular value of Phi_q with rows scaled to length 1. An error e of the
constraints causes an error of about e/σ² in accelerations and reactions. The run records the
singular positions that its steps meet. A long step may cross a position without a sample beside it;
such a position is found from the multipliers on the interpolant.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import numpy as np

from kempe.base.arrays import Floats
from kempe.results.extrema import singular_times

if TYPE_CHECKING:
    from kempe.results.solution import Solution
    from kempe.results.state import State

#: The smallest σ that counts: beside a singular position, factors have a ridge of its square.
_LEAST = 1e-5
#: Least constraint error after projection, relative to the size of the mechanism.
_ROUNDING = 1e-15
#: Times closer than this fraction of the run belong to one position.
_SAME_TIME = 1e-3
#: Largest σ of a singular position, and of a redundant equation.
_SINGULAR, _REDUNDANT = 0.02, 1e-9
#: Largest number of equations for which singular values are computed; for larger models, the pivots
#: of the run are used.
_MOST_ROWS = 120
#: An equation with less than this fraction of the largest part in a dependence does not take part.
_PART = 1e-3


def singular_positions(solution: Solution) -> list[dict[str, Any]]:
    """The positions, in order: time, joints, and the accuracy at the output nearest to it.

    ``amplification`` is 1/σ² at this ``output``. ``error`` is the error that the residual at this
    output causes, with lengths in m.
    """
    noted = [dict(of) for of in solution.statistics.get("singular", ())]
    if solution.compiled.n_rows <= _MOST_ROWS:
        noted += _missed(solution, [of["t"] for of in noted])
    return [_lost(solution, of) for of in sorted(noted, key=lambda of: float(of["t"]))]


def _missed(solution: Solution, known: list[float]) -> list[dict[str, Any]]:
    """The positions that only the multipliers show."""
    found: list[dict[str, Any]] = []
    for t in singular_times(solution):
        times = [*known, *(of["t"] for of in found)]
        if any(abs(t - other) <= _SAME_TIME * np.ptp(solution.t) for other in times):
            continue
        sigma, parts = _least(solution, float(t))
        if sigma > _SINGULAR:
            continue
        infos = solution(float(t)).compiled.constraints.items()
        largest = _PART * parts.max()
        names = [name for name, info in infos if parts[info.rows].max(initial=0.0) > largest]
        found.append({"t": float(t), "names": names, "slope": None, "residual": 0.0})
    return found


def _least(solution: Solution, t: float) -> tuple[float, Floats]:
    """σ at a time, and the parts of the equations in the dependence there."""
    values, vectors = _decomposed(solution, t)
    ends = (_decomposed(solution, float(end))[0] for end in (solution.t[0], solution.t[-1]))
    redundant = min(int(np.count_nonzero(of < _REDUNDANT)) for of in ends)
    k = min(redundant, len(values) - 1)
    return float(values[k]), np.abs(vectors[:, k])


def _decomposed(solution: Solution, t: float) -> tuple[Floats, Floats]:
    """Singular values of the rows of Phi_q, of length 1, ascending; and the left vectors."""
    state = cast("State", solution(t))  # as at every single time
    rows = np.asarray(state.matrices().Phi_q)
    lengths = np.linalg.norm(rows, axis=1, keepdims=True)
    left, values, _ = np.linalg.svd(rows / np.where(lengths > 0.0, lengths, 1.0))
    whole = np.zeros(len(rows))
    whole[: len(values)] = values
    return whole[::-1], left[:, ::-1]


def _lost(solution: Solution, of: dict[str, Any]) -> dict[str, Any]:
    """The accuracy that is lost beside one position."""
    k = int(np.abs(solution.t - of["t"]).argmin())
    output, residual = float(solution.t[k]), np.abs(solution.residuals[0][k]).max(initial=0.0)
    if solution.compiled.n_rows <= _MOST_ROWS:
        sigma, _ = _least(solution, output)
    else:
        sigma = of["slope"] * abs(output - of["t"])
    amplification = max(1.0, max(sigma, _LEAST) ** -2)
    error = amplification * max(of["residual"], float(residual), _ROUNDING)
    row = {"t": of["t"], "joints": of["names"], "output": output}
    return {**row, "amplification": amplification, "error": error}
