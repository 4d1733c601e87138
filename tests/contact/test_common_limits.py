"""Contacts whose friction reaches its limit at one time, and corners that bounce to rest."""

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose

#: Masses in kg, sizes in m, rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 100.0), (1e3, 1e3, 0.01)]


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("pads", [1, 2])
@pytest.mark.parametrize("friction", [0.1, 0.37])
def test_a_block_between_two_jaws_slips_at_all_pads_together(
    scale: tuple[float, float, float], pads: int, friction: float
) -> None:
    mass, size, rate = scale
    force = mass * size * rate**2
    stiffness, ramp = 1e3 * force / size, 0.2 * force * rate
    m = kp.Model("jaws")
    m.ground.points(O=(0, 0))
    heights = {k: 0.3 * size * (k - (pads - 1) / 2) for k in range(pads)}
    left = {f"l{k}": (-size, y) for k, y in heights.items()}
    right = {f"r{k}": (size, y) for k, y in heights.items()}
    m.body("block", mass=mass, inertia=0.4 * mass * size**2, points={"C": (0, 0), **left, **right})
    at = {"block.x": 0.0, "block.y": 0.0, "block.angle": 0.0}
    for jaw, names, x in (("left", left, -size), ("right", right, size)):
        face = [(0, -9 * size), (0, 9 * size)]
        face = {"line": face if jaw == "right" else face[::-1]}
        m.body(jaw, mass=mass, inertia=mass * size**2, points={"C": (0, 0)}, curves={"face": face})
        m.translational(f"guide_{jaw}", "ground.O", f"{jaw}.C", axes=(0, 0))
        m.force(f"press_{jaw}", f"{jaw}.C", force=(-np.sign(x) * force, 0))
        contact = {"stiffness": stiffness / pads, "exponent": 1, "damping": 1 / rate / size}
        for name in names:
            m.contact(
                name, f"block.{name}", f"{jaw}.face", side="left", friction=friction, **contact
            )
        at[f"{jaw}.x"] = x - np.sign(x) * force / stiffness
    m.force("load", "block.C", force=(0, f"-{ramp!r}*t"))
    slips = 2 * friction * force / ramp
    end = slips + 1 / rate
    sol = kp.dynamics(m, kp.assemble(m, at), t_end=end, method=kp.DOP853(rtol=1e-11, atol=1e-13))
    for name in (*left, *right):
        assert_allclose(sol.events[f"{name}.slip"].t, slips, rtol=1e-9)
        assert_allclose(sol[f"{name}.force"], force / pads, rtol=1e-9)
    assert_allclose(sol["block.y"][-1], -ramp * (end - slips) ** 3 / (6 * mass), rtol=1e-9)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("impacts", ["sequential", "simultaneous"])
@pytest.mark.parametrize("tilt", [3e-8, 1.3128534416365071e-07, 1e-5, 1e-3])
def test_a_block_that_lands_almost_flat_comes_to_rest(
    scale: tuple[float, float, float], impacts: str, tilt: float
) -> None:
    mass, size, rate = scale
    m = kp.Model("block", gravity=(0, -size * rate**2))
    m.ground.curves(floor={"line": ((20 * size, 0), (-20 * size, 0))})
    rim = [(-0.5, -0.3), (0.5, -0.3), (0.5, 0.2), (-0.5, 0.2)]
    rim = {"polygon": [(x * size, y * size) for x, y in rim]}
    m.body("block", mass=mass, inertia=0.2 * mass * size**2, curves={"rim": rim})
    m.contact("feet", curves=["block.rim", "ground.floor"], restitution=0.8, friction=0.4)
    height = 0.3 * np.cos(tilt) + 0.5 * np.sin(tilt)
    at = {"x": 0, "y": height * size, "angle": tilt, "vx": 0, "vy": 0, "omega": 0.1 * rate}
    start = kp.assemble(m, {f"block.{name}": value for name, value in at.items()})
    sol = kp.dynamics(m, start, t_end=8 / rate, output_step=0.1 / rate, impacts=impacts)
    assert np.diff(sol.energy.total).max() < 1e-9 * mass * size**2 * rate**2
    assert_allclose(sol["block.y"][-1], 0.3 * size, rtol=1e-9)
    assert abs(sol["block.angle"][-1]) < 1e-9
    assert_allclose(sol["feet.force"][-1], mass * size * rate**2, rtol=1e-9)
