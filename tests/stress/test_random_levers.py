"""Levers that hit a rough wall: the sliding ends together with the approach.

Friction acts against the sliding. With the ratio r of the work of friction to that of the normal
impulse, compression takes the impulse P = I ω / (g (1 + r)) and expansion e P, of which friction
uses the part r. The lever at the normal impulse is g.
"""

import kempe as kp
import numpy as np
import pytest
from sizes import count

SEEDS = range(count(12, 200))


def lever(seed: int) -> tuple[kp.Model, dict[str, float], dict[str, float]]:
    """A lever, its start, and what determines its impact."""
    rng = np.random.default_rng([35, seed])
    size, mass = (10 ** rng.uniform(-3, 3, 2)).tolist()
    friction = float(rng.choice([0.1, 0.4, 1.0]))
    restitution = float(rng.choice([0, 0.3, 0.8]))
    m = kp.Model("lever")
    m.ground.points(O=(0, 0))
    inertia = mass * size**2 * float(rng.uniform(0.2, 2))
    m.body("lever", mass=mass, inertia=inertia, points={"O": (0, 0), "P": (size, 0)})
    m.revolute("pin", "ground.O", "lever.O")
    # the angle at which the tip touches, and that between the normal of the wall and its path
    touch, lean = rng.uniform(-3, 3), rng.uniform(-1.4, 1.4)
    tip = size * np.array((np.cos(touch), np.sin(touch)))
    out = touch + np.pi / 2 + lean  # the direction from the lever into the wall
    along = 9 * size * np.array((-np.sin(out), np.cos(out)))
    m.ground.curves(wall={"line": (tuple(tip + along), tuple(tip - along))})
    law = {"friction": friction, "restitution": restitution}
    m.contact("touch", "lever.P", "ground.wall", **law)
    omega = float(rng.uniform(0.5, 2))
    start = {"lever.angle": touch - 0.1, "lever.omega": omega}
    known = {"omega": omega, "r": friction * abs(np.tan(lean)), "e": restitution}
    known |= {"mu": friction, "unit": inertia * omega / size / np.cos(lean)}
    return m, start, known


@pytest.mark.parametrize("impacts", ["sequential", "simultaneous"])
def test_friction_acts_against_the_sliding(impacts: str) -> None:
    for seed in SEEDS:
        m, set_, known = lever(seed)
        start = kp.assemble(m, set_)
        run = kp.dynamics(m, start, t_end=0.11 / known["omega"], impacts=impacts)
        r, e = known["r"], known["e"]
        after = -e * known["omega"] * max(0.0, (1 - r) / (1 + r))
        assert np.isclose(run["lever.omega"][-1], after, rtol=1e-7, atol=1e-9), seed
        compression = known["unit"] / (1 + r)
        normal, friction = compression * (1 + e), known["mu"] * compression * (1 - e)
        if r >= 1:
            friction = compression * (known["mu"] - e * known["mu"] / r)
        impulse = run.events["touch.hit"].impulse("touch", on="lever")[0]
        assert np.isclose(np.hypot(*impulse), np.hypot(normal, friction), rtol=1e-6), seed
