"""An event and the option `stop` with the same condition are both listed."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest

METHODS: list[kp.Option] = [
    kp.RK45(),
    kp.DOP853(rtol=1e-9, atol=1e-12),
    kp.RK4(step=1e-3),
    kp.Radau(),
    kp.GeneralizedAlpha(),
    kp.Auto(),
]


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_a_condition_that_stops_the_run_is_listed_as_an_event_too(method: kp.Option) -> None:
    rng = np.random.default_rng(5)
    for _ in range(8):
        size = 10 ** rng.uniform(-2, 3)
        m = kp.Model("arm", gravity=(0, -9.81))
        m.ground.points(O=(0, 0))
        m.bar("arm", mass=size, length=size, ends=("O", "P"))
        m.revolute("O", "ground.O", "arm.O")
        condition = f"arm.angle < {rng.uniform(-1.4, 0.9)!r}"
        sol = kp.dynamics(
            m,
            kp.assemble(m, set={"arm.angle": 1}),
            t_end=size**0.5,
            method=method,
            stop=condition,
            events={"e": condition},
        )
        assert sol.status == 1
        assert list(sol.events["e"].t) == list(sol.events["stop"].t) == [sol.t[-1]], condition
