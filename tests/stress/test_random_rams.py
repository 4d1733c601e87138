"""Balls that a driven ram hits at one instant: each has its own restitution and friction.

The driver adds energy, so the kinetic energy may grow in an impact.
"""

import kempe as kp
import numpy as np
import pytest
from sizes import count

SEEDS = range(count(12, 200))


@pytest.mark.parametrize("impacts", ["sequential", "simultaneous"])
def test_each_ball_has_its_own_restitution(impacts: str) -> None:
    for seed in SEEDS:
        rng = np.random.default_rng([36, seed])
        size, unit = (10 ** rng.uniform(-3, 3, 2)).tolist()
        n, speed = int(rng.integers(1, 4)), float(rng.uniform(-2, 2)) * size
        m, m_time = kp.Model("ram"), 0.3
        m.ground.points(O=(0, 0))
        face = {"line": ((0, -9 * size), (0, 9 * size))}
        m.body(
            "ram", mass=unit, inertia=unit * size**2, points={"P": (0, 0)}, curves={"face": face}
        )
        m.translational("guide", "ground.O", "ram.P")
        m.coordinate_driver("drive", "guide.displacement", value=f"{speed!r}*t")
        start: dict[str, float] = {}
        expected, lost = [], 0.0
        for k in range(n):
            mass, radius = unit * float(10 ** rng.uniform(-1, 1)), 0.1 * size
            inertia = mass * radius**2 * float(rng.uniform(0.3, 1))
            e, friction = float(rng.choice([0, 0.3, 1])), float(rng.choice([0, 0.1, 0.6]))
            ball, rate = f"b{k}", float(rng.uniform(0.2, 2)) * size
            m.body(ball, mass=mass, inertia=inertia, points={"C": (0, 0)})
            law = {"friction": friction} if friction else {}
            m.contact(f"c{k}", f"{ball}.C", "ram.face", radius=radius, restitution=e, **law)
            vy, omega = float(rng.normal()) * size, float(rng.normal()) * 5
            start |= {f"{ball}.x": radius + rate * m_time / 2, f"{ball}.y": k * size}
            start |= {f"{ball}.angle": 0, f"{ball}.omega": omega}
            start |= {f"{ball}.vx": speed - rate, f"{ball}.vy": vy}
            push, slip = mass * (1 + e) * rate, vy - radius * omega
            ease = 1 / mass + radius**2 / inertia
            rub = -np.sign(slip) * min(friction * push, abs(slip) / ease)
            lost += mass * (1 - e**2) * rate**2 / 2 - rub * (slip + rub * ease / 2)
            after = (speed + e * rate, vy + rub / mass, omega - radius * rub / inertia)
            expected.append((*after, e))
        run = kp.dynamics(m, kp.assemble(m, start), t_end=m_time, impacts=impacts)
        assert abs(run["energy.balance"]).max() < 1e-9 * unit * size**2, seed
        for k, (vx, vy, omega, _) in enumerate(expected):
            found = [run[f"b{k}.{rate}"][-1] for rate in ("vx", "vy", "omega")]
            assert np.allclose(found[:2], (vx, vy), rtol=1e-9, atol=1e-8 * size), seed
            assert np.isclose(found[2], omega, rtol=1e-9, atol=1e-7), seed
        assert np.isclose(run.energy.dissipated[-1], lost, rtol=1e-8, atol=1e-9 * unit * size**2)


@pytest.mark.parametrize("seed", range(count(4, 40)))
def test_a_stop_behind_the_release_of_a_driver(seed: int) -> None:
    rng = np.random.default_rng([37, seed])
    size, mass = (10 ** rng.uniform(-3, 3, 2)).tolist()
    rate, e, free = (float(rng.uniform(0.2, 0.9)) for _ in range(3))
    m = kp.Model("lever", parameters={"limit": 0.8 * rate})
    m.ground.points(O=(0, 0))
    m.bar("lever", mass=mass, length=size, ends=("O", "P"))
    m.revolute("pin", "ground.O", "lever.O")
    m.coordinate_driver("motor", "pin.angle", value=f"{rate!r}*t", release=f"t > {0.5 * free!r}")
    m.stop("stop", "pin.angle", upper="limit", restitution=e)
    run = kp.dynamics(m, kp.assemble(m), t_end=1)
    assert np.allclose(run.events["stop.hit"].t, 0.8)
    assert np.isclose(run["lever.omega"][-1], -e * rate)
    # the stop is met before the release
    with pytest.raises(kp.SingularityError, match=r"stop closes at .* while motor holds") as caught:
        kp.dynamics(m, kp.assemble(m), t_end=1, parameters={"limit": 0.4 * free * rate})
    assert np.isclose(caught.value.solution.t[-1], 0.4 * free)
