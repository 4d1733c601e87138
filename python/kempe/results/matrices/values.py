"""The matrices of the equations of motion at one instant, with the names of rows and columns."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from kempe import _core
from kempe._upwards import CALLS
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats, fixed
from kempe.model.values import Number, numbers

if TYPE_CHECKING:
    from kempe.results.state import State


@explain_methods
@dataclass(frozen=True, repr=False)
class Matrices:
    """M a + Φ_qᵀ λ = Q, Φ_q a = γ (Haug 6.3.18), read-only, in SI units.

    Attributes:
        M: (n_q, n_q).
        Phi: (m,), m or rad.
        Phi_q: (m, n_q).
        nu: -Φ_t, (m,).
        gamma: right side of the acceleration equation, (m,).
        Q: (n_q,), N and N·m.
        kkt: the coefficient matrix of (6.3.18), (n_q + m, n_q + m).
        rows: names of the equations, such as ``A.x``. In a run, friction that sticks and contacts
            at rest have equations too, and a driver at its limit has none. The rows of ``set=``
            come last.
        units: units of the equations, m or rad.
        columns: names of the coordinates, such as ``crank.angle``.
    """

    M: Floats
    Phi: Floats
    Phi_q: Floats
    nu: Floats
    gamma: Floats
    Q: Floats
    kkt: Floats
    rows: tuple[str, ...]
    units: tuple[str, ...]
    columns: tuple[str, ...]

    def __repr__(self) -> str:
        return f"<Matrices: {len(self.columns)} coordinates, {len(self.rows)} equations>"

    def _repr_html_(self) -> str:
        return str(CALLS["html"](self))

    @property
    def rank(self) -> int:
        """Rank of Φ_q."""
        return int(np.linalg.matrix_rank(self.Phi_q)) if self.Phi_q.size else 0

    @property
    def degrees_of_freedom(self) -> int:
        """Coordinates that the constraints leave free in this position."""
        return len(self.columns) - self.rank


def matrices(state: State, held: Mapping[str, Number]) -> Matrices:
    """The matrices at a state, with rows for the coordinates held as in an assembly."""
    text = json.dumps(numbers(held, "set"), allow_nan=False)
    found = _core.matrices(state.compiled.core, float(state.t), state.q, state.v, state.z, text)
    names = ("M", "Phi", "Phi_q", "nu", "gamma", "Q", "kkt")
    arrays = {name: fixed(found[name]) for name in names}
    rows, units = zip(*found["rows"], strict=True) if found["rows"] else ((), ())
    columns = tuple(state.compiled.column_names())
    return Matrices(**arrays, rows=rows, units=units, columns=columns)
