"""Observed orders of the integrators on index-3 problems, for q and for λ.

The error of a run with a constant step is the largest error over the common times of all runs,
relative to the largest value, with DOP853 at rtol 1e-14 as reference. The observed order is the
slope of log error over log step by least squares over three halvings. The steps are chosen such
that the smallest errors are above the level of rounding, about 1e-14.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import kempe as kp
import numpy as np
from kempe.analyses.options import Option

#: Number of halvings of the step.
HALVINGS = 3
#: Largest difference of an observed order from theory.
TOLERANCE = 0.15

PROJECTION = kp.Projection(tolerance=1e-14)
EXACT = kp.DOP853(rtol=1e-14, atol=1e-14)


@dataclass(frozen=True)
class Integrator:
    """A method with a constant step.

    Attributes:
        name: common name of the method.
        order_q, order_lam: of theory, for coordinates and for multipliers.
        method: the method with a step, s.
        steps: number of the coarsest steps on each problem, by name.
    """

    name: str
    order_q: float
    order_lam: float
    method: Callable[[float], Option]
    steps: dict[str, int]


#: The methods. The multipliers in the output are computed from the state, so λ converges with the
#: order of q.
METHODS = (
    Integrator("RK4", 4, 4, lambda h: kp.RK4(step=h), {"pendulum": 32, "four-bar": 128}),
    Integrator("RK45", 5, 5, lambda h: kp.RK45(step=h), {"pendulum": 32, "four-bar": 24}),
    Integrator("DOP853", 8, 8, lambda h: kp.DOP853(step=h), {"pendulum": 4, "four-bar": 2}),
    Integrator(
        "generalized-α, ρ = 0.8",
        2,
        2,
        lambda h: kp.GeneralizedAlpha(step=h),
        {"pendulum": 64, "four-bar": 128},
    ),
    Integrator("HHT, α = -0.1", 2, 2, lambda h: kp.HHT(step=h), {"pendulum": 64, "four-bar": 128}),
    Integrator(
        "Radau IIA",
        5,
        5,
        lambda h: kp.Radau(step=h, rtol=1e-12, atol=1e-14),
        {"pendulum": 16, "four-bar": 8},
    ),
)


@dataclass(frozen=True)
class Problem:
    """A mechanism to be integrated.

    Attributes:
        name: its name.
        told: description of the start.
        t_end: end time, s.
        start: the mechanism at its start.
    """

    name: str
    told: str
    t_end: float
    start: Callable[[], kp.State]


def pendulum() -> kp.State:
    """A uniform rod of 1 m at -2 rad, turning at 1 rad/s."""
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2.5, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    return kp.assemble(m, set={"rod.angle": -2, "rod.omega": 1})


def free_four_bar() -> kp.Model:
    """The flagship without its spring-damper."""
    m = kp.Model("four-bar without spring", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(20, 0))
    m.bar("crank", mass=3, length=10, ends=("A", "B"))
    m.bar("coupler", mass=5, length=26, ends=("B", "C"))
    m.bar("rocker", mass=4, length=18, ends=("C", "D"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    return m


def four_bar() -> kp.State:
    """Released with the crank at -1.5 rad."""
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    return kp.assemble(free_four_bar(), set={"crank.angle": -1.5}, guess=guess)


PROBLEMS = (
    Problem("pendulum", "uniform rod of 1 m from -2 rad at 1 rad/s", 1.25, pendulum),
    Problem(
        "four-bar", "flagship without spring, released with the crank at -1.5 rad", 2.5, four_bar
    ),
)


@dataclass(frozen=True)
class Convergence:
    """Errors of one method on one problem.

    Attributes:
        method, problem: names.
        theory: order of q, of λ.
        steps: lengths of the steps, s.
        q, lam: errors of coordinates and multipliers, relative.
    """

    method: str
    problem: str
    theory: tuple[float, float]
    steps: tuple[float, ...]
    q: tuple[float, ...]
    lam: tuple[float, ...]

    @property
    def orders(self) -> tuple[float, float]:
        """Observed orders of q and λ."""
        return slope(self.steps, self.q), slope(self.steps, self.lam)

    @property
    def holds(self) -> bool:
        """Whether both orders agree with theory."""
        pairs = zip(self.orders, self.theory, strict=True)
        return all(abs(observed - theory) <= TOLERANCE for observed, theory in pairs)


def slope(steps: tuple[float, ...], errors: tuple[float, ...]) -> float:
    """Slope of log error over log step, by least squares."""
    return float(np.polyfit(np.log(steps), np.log(errors), 1)[0])


def run(problem: Problem, method: Option, output_step: float) -> tuple[np.ndarray, np.ndarray]:
    """Q and λ at the common times of all runs."""
    start = problem.start()
    sol = kp.dynamics(
        start.model,
        start,
        t_end=problem.t_end,
        output_step=output_step,
        method=method,
        stabilization=PROJECTION,
        dense_output=False,
    )
    return np.asarray(sol.q), np.asarray(sol.lam)


def converge(problem: Problem, integrator: Integrator, halvings: int = HALVINGS) -> Convergence:
    """The errors for each step."""
    coarsest = problem.t_end / integrator.steps[problem.name]
    shared = problem.t_end / min(integrator.steps[problem.name], 8)
    exact = run(problem, EXACT, shared)
    steps = [coarsest / 2**k for k in range(halvings + 1)]
    errors = []
    for step in steps:
        found = run(problem, integrator.method(step), shared)
        pairs = zip(found, exact, strict=True)
        errors.append([float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs])
    q, lam = zip(*errors, strict=True)
    theory = (integrator.order_q, integrator.order_lam)
    return Convergence(integrator.name, problem.name, theory, tuple(steps), q, lam)


def study() -> list[Convergence]:
    """All methods on all problems."""
    return [converge(problem, integrator) for problem in PROBLEMS for integrator in METHODS]
