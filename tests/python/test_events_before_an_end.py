"""Events in a step that an impact, a stop or an action ends keep their own times."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from sizes import count

METHODS: list[kp.Option] = [kp.Auto(), kp.DOP853(), kp.RK45(), kp.Radau()]


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_listed_events_before_an_impact_have_their_times(method: kp.Option) -> None:
    """A ball falls and bounces; all its times have closed forms."""
    rng = np.random.default_rng(11)
    for _ in range(count(10, 100)):
        size, e = float(10 ** rng.uniform(-3, 3)), float(rng.uniform(0.5, 0.9))
        g, height = size * float(10 ** rng.uniform(-1, 4)), size * float(rng.uniform(0.5, 2))
        m = kp.Model("ball", gravity=(0, -g))
        m.point_mass("ball", mass=float(10 ** rng.uniform(-3, 3)))
        m.stop("floor", "ball.y", lower=0.0, restitution=e)
        start = kp.assemble(m, {"ball.x": 0, "ball.y": height, "ball.vx": 0, "ball.vy": 0})
        fall = float(np.sqrt(2 * height / g))
        part = float(rng.uniform(0.8, 0.99))
        flight = 2 * e * fall
        right = {
            f"t > {part * fall!r}": part * fall,
            f"ball.y < {(1 - part**2) * height!r}": part * fall,
            f"ball.vy + {part * g * fall!r}": part * fall,
            f"t - {fall + part * flight!r}": fall + part * flight,
        }
        events = {
            f"e{k}": kp.Event(condition, direction="falling" if "vy" in condition else "both")
            for k, condition in enumerate(right)
        }
        sol = kp.dynamics(m, start, t_end=fall + 1.2 * flight, method=method, events=events)
        for (name, event), t in zip(events.items(), right.values(), strict=True):
            assert sol.events[name].t[0] == pytest.approx(t, abs=1e-7 * fall), event
