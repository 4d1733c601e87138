"""A driven parallelogram through its change points: at every tolerance it stays a parallelogram.

A driver prescribes the whole motion, so that crank and rocker turn at its rate and the coupler does
not turn. At each change point the joints lose an equation.
"""

import kempe as kp
import numpy as np
import pytest
from sizes import count

G = 9.81
#: Each method with its order, and its relative tolerances.
METHODS = {
    kp.DOP853: (8, (1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6)),
    kp.RK45: (5, (1e-10, 1e-9, 1e-8, 1e-6)),
}
#: Angle beside a change point, rad, within which rounding errors dominate accelerations.
BESIDE = 0.02


def parallelogram(number: int) -> tuple[kp.Model, kp.State, float, float]:
    """A random one, with the angle of its cranks at the start and their rate."""
    rng = np.random.default_rng(number)
    size = 10 ** rng.uniform(-3, 3)
    crank, frame = size * rng.uniform(0.6, 1.4), size * rng.uniform(1.6, 2.8)
    masses = 10 ** rng.uniform(-3, 3) * 10 ** rng.uniform(-1, 1, 3)
    angle = float(rng.uniform(-np.pi, np.pi))
    rate = float(rng.choice([-1, 1]) * 10 ** rng.uniform(-1, 2) * np.sqrt(G / size))
    m = kp.Model("parallelogram", gravity=(0, -G))
    m.ground.points(A=(0, 0), D=(frame, 0))
    m.bar("crank", mass=float(masses[0]), length=crank, ends=("A", "B"))
    m.bar("coupler", mass=float(masses[1]), length=frame, ends=("B", "C"))
    m.bar("rocker", mass=float(masses[2]), length=crank, ends=("D", "C"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.coordinate_driver("motor", "crank.angle", value=f"{angle} + ({rate})*t")
    guess = {"rocker.angle": angle, "coupler.angle": 0.0, "crank.angle": angle}
    return m, kp.assemble(m, guess=guess), angle, rate


def misses(sol: kp.Solution, angle: float, rate: float) -> list[float]:
    """Largest errors of angles, rad, of rates and of accelerations, in powers of the rate."""
    turned = angle + rate * sol.t
    beside = np.abs(np.sin(turned)) < BESIDE
    rocker, coupler = sol["rocker"], sol["coupler"]
    angles = [rocker.angle - turned, coupler.angle]
    rates = [(rocker.omega / rate - 1)[~beside], (coupler.omega / rate)[~beside]]
    accelerations = [(of.alpha / rate**2)[~beside] for of in (rocker, coupler)]
    return [float(np.abs(each).max()) for each in (angles, rates, accelerations)]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("number", range(count(6, 60)))
def test_every_tolerance_passes_the_change_points(number: int, method: type) -> None:
    model, start, angle, rate = parallelogram(number)
    steps = {}
    order, tolerances = METHODS[method]
    for rtol in tolerances:
        chosen = method(rtol=rtol, atol=1e-2 * rtol)
        times = {"t_end": 20 / abs(rate), "output_step": 0.0517 / abs(rate)}
        sol = kp.dynamics(model, start, method=chosen, **times)
        steps[rtol] = sol.statistics["steps"]
        off, astray, shaken = misses(sol, angle, rate)
        assert off < 1e-6, rtol
        assert astray < 1e-7, rtol
        assert shaken < 1e-4, rtol
    for rtol, taken in steps.items():
        longer = (1e-8 / rtol) ** (1 / order)
        assert taken < 3 * max(longer, 1) * steps[1e-8], steps
