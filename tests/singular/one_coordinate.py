"""Mechanisms with one degree of freedom, described by one coordinate s along their branch.

With T = m(s) s'^2 / 2, V(s) and a resistance d(s) s':

    m s'' + m_s s'^2 / 2 + V_s + d s' = 0,

with positions as closed forms in s, derived by SymPy and integrated by SciPy. This formulation has
no constraints and no singular positions, and it is independent of kempe.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

S = sp.Symbol("s", real=True)
G = 9.81


@dataclass(frozen=True)
class Placed:
    """A body as a function of s.

    Attributes:
        name: name of the body.
        mass, inertia: kg, and kg m^2 about the mass centre, where its frame is.
        x, y: of the mass centre, m.
        along: cosine and sine of its angle.
    """

    name: str
    mass: float
    inertia: float
    x: sp.Expr
    y: sp.Expr
    along: tuple[sp.Expr, sp.Expr]

    @property
    def heaviness(self) -> sp.Expr:
        """Contribution of the body to m(s)."""
        c, s = self.along
        turning = c * sp.diff(s, S) - s * sp.diff(c, S)
        moving = sp.diff(self.x, S) ** 2 + sp.diff(self.y, S) ** 2
        return self.mass * moving + self.inertia * turning**2


@dataclass(frozen=True)
class Branch:
    """One branch of the motion of a mechanism.

    Attributes:
        bodies: the moving bodies, in the order of the model.
        potential: potential of the forces other than gravity, J.
        resistance: d(s), N s/m times m^2.
    """

    bodies: tuple[Placed, ...]
    potential: sp.Expr = sp.S.Zero
    resistance: sp.Expr = sp.S.Zero

    def motion(self, s0: float, rate: float, t: np.ndarray) -> np.ndarray:
        """s at the times, from s0 and s' = rate at t[0]."""
        m = sum(body.heaviness for body in self.bodies)
        v = self.potential + sum(G * body.mass * body.y for body in self.bodies)
        terms = [m, sp.diff(m, S), sp.diff(v, S), self.resistance]
        evaluated = sp.lambdify(S, terms, modules="math", cse=True)

        def slope(_: float, y: np.ndarray) -> tuple[float, float]:
            m, m_s, v_s, d = evaluated(float(y[0]))
            return y[1], -(0.5 * m_s * y[1] ** 2 + v_s + d * y[1]) / m

        y0, span = (s0, rate), (t[0], t[-1])
        found = solve_ivp(slope, span, y0, method="DOP853", t_eval=t, rtol=1e-13, atol=1e-14)
        assert found.success
        return np.asarray(found.y[0])

    def places(self, s: np.ndarray) -> np.ndarray:
        """x, y, cosine and sine of every body, (n_t, n_bodies, 4)."""
        evaluated = placing(self)
        return np.array([evaluated(float(x)) for x in s])


@cache
def placing(branch: Branch) -> Callable[[float], list[list[float]]]:
    """The places of all bodies, as a function of s."""
    rows = [[body.x, body.y, *body.along] for body in branch.bodies]
    return sp.lambdify(S, rows, modules="math", cse=True)


def places(q: np.ndarray) -> np.ndarray:
    """The same for coordinates (n_t, 3 n_bodies)."""
    x, y, angle = np.moveaxis(q.reshape(len(q), -1, 3), 2, 0)
    return np.stack([x, y, np.cos(angle), np.sin(angle)], axis=2)
