"""Contacts that rest while others hit."""

import kempe as kp
import numpy as np
import pytest

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e3, 0.01)]
BLOCK = [(-0.31, -0.2), (0.3, -0.2), (0.3, 0.2), (-0.31, 0.2)]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("impacts", ["sequential", "simultaneous"])
@pytest.mark.parametrize("friction", [{}, {"friction": 0.3}])
def test_a_block_at_rest_is_not_hit_where_a_ball_bounces(
    scale: tuple[float, float, float], impacts: str, friction: dict[str, float]
) -> None:
    mass, size, rate = scale
    m = kp.Model("rest", gravity=(0.03 * size * rate**2, -size * rate**2))
    m.ground.curves(floor={"line": ((99 * size, 0), (-99 * size, 0))})
    rim = {"polygon": [(x * size, y * size) for x, y in BLOCK]}
    m.body("block", mass=1.3 * mass, inertia=0.1 * mass * size**2, curves={"rim": rim})
    m.body("ball", mass=0.7 * mass, inertia=0.01 * mass * size**2, points={"C": (0, 0)})
    m.contact("rests", curves=["block.rim", "ground.floor"], restitution=0.5, **friction)
    m.contact("hits", "ball.C", "ground.floor", radius=0.1 * size, restitution=0.8, **friction)
    at = {"block.y": 0.2 * size, "ball.x": 3 * size, "ball.y": 1.1 * size}
    still = ("x", "y", "angle", "vx", "vy", "omega")
    start = {f"{body}.{name}": 0.0 for body in ("block", "ball") for name in still} | at
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=7 / rate, impacts=impacts)
    assert len(sol.events["hits.hit"].t) >= 3
    assert not len(sol.events["rests.hit"].t)
    assert not len(sol.events["rests.release"].t)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("angle", np.linspace(-0.4, 0.4, 5))
def test_a_lever_that_a_ball_lifts_from_its_stop_is_released(
    scale: tuple[float, float, float], angle: float
) -> None:
    mass, size, rate = scale
    m = kp.Model("lever", gravity=(0, -size * rate**2))
    m.ground.points(O=(0, 0))
    ends = {"A": (-0.7 * size, 0), "B": (0.6 * size, 0)}
    face = {"top": {"line": (ends["B"], ends["A"])}}
    body = {"mass": mass, "inertia": 0.2 * mass * size**2, "center": (-0.1 * size, 0)}
    m.body("lever", **body, points=ends | {"O": (0, 0)}, curves=face)
    m.revolute("pin", "ground.O", "lever.O")
    m.stop("rest", "lever.angle", upper=float(angle), restitution=0.0)
    m.point_mass("ball", mass=mass)
    m.contact("hit", "ball.P", "lever.top", radius=0.05 * size, restitution=0.0)
    at = {"lever.angle": float(angle), "lever.omega": 0}
    at |= {"ball.x": 0.4 * size, "ball.y": size, "ball.vx": 0, "ball.vy": 0}
    start = kp.assemble(m, set=at)
    sol = kp.dynamics(m, start, t_end=1.6 / rate, impacts="simultaneous")
    (t,) = sol.events["hit.hit"].t[:1]
    np.testing.assert_allclose(sol.events["rest.release"].t[:1], [t], rtol=1e-12)
    assert not (sol.events["rest.hit"].t == t).any()
