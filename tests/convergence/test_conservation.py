"""Long runs of a conservative mechanism keep the energy constant and the joints closed.

`python -m benchmarks.validation.conservation` runs a million steps.
"""

import kempe as kp
import pytest

from benchmarks.validation.conservation import conserve, period, released
from benchmarks.validation.convergence import METHODS

BY_NAME = {integrator.name: integrator for integrator in METHODS}


@pytest.fixture(scope="module")
def start() -> kp.State:
    return released()


def test_the_period_agrees_with_the_motion(start: kp.State) -> None:
    turn = period(start)
    method = kp.DOP853(rtol=1e-12, atol=1e-12)
    sol = kp.dynamics(start.model, start, t_end=turn, method=method, stabilization=kp.Projection())
    assert sol.final.q == pytest.approx(start.q, abs=1e-9)
    assert sol.final.v == pytest.approx(start.v, abs=1e-8)
    assert sol(turn / 2)["crank"].angle < start["crank"].angle - 1


def test_dop853_conserves_the_energy(start: kp.State) -> None:
    found = conserve(BY_NAME["DOP853"], start, 100_000)
    assert found.steps == 100_000
    assert found.drift < 1e-10
    assert found.residual < 1e-10


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning")  # damped methods lose energy
@pytest.mark.parametrize("name", sorted(BY_NAME))
def test_every_method_keeps_the_joints_closed(start: kp.State, name: str) -> None:
    found = conserve(BY_NAME[name], start, 2000)
    assert found.residual < 1e-10
    # in twenty periods, order 4 drifts by 5e-6; methods of order 2 are damped and lose up to 7e-3
    assert found.drift < (1e-5 if BY_NAME[name].order_q > 2 else 1e-2)
