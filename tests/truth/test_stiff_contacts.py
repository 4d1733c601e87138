"""Strongly damped contacts, stops and laws: `auto` recognises them at about the cost of Radau."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from sizes import some

CONTACTS = ("contact", "stop", "law", "rod", "pair")
#: Factors of mass, length and time.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 1.0), (1e3, 1e-3, 1.0), (1.0, 1e3, 1e3), (1.0, 1e-3, 1e-3)]
DAMPINGS = (1e3, 1e4, 1e5, 1e6)


def falling(kind: str, damping: float, scale: tuple[float, float, float]) -> kp.Model:
    """A ball of 2 kg falls by 10 mm, and comes to rest at a depth of 2 µm; all in scaled units."""
    mass, length, time = scale
    g, k, c = 9.81 * length / time**2, 1e7 * mass / time**2, damping * time / length
    m = kp.Model("falling", gravity=(0, -g))
    if kind == "rod":
        m.ground.points(O=(0, 0))
        m.bar("b", mass=2 * mass, length=length, ends=("O", "P"))
        m.revolute("pin", "ground.O", "b.O")
        m.stop("c", "b.angle", lower=-0.01, stiffness=k * length**2, damping=damping * time)
        return m
    m.point_mass("b", mass=2 * mass, at=(0, 0.01 * length))
    if kind == "contact":
        m.ground.curves(f={"line": ((5 * length, 0), (-5 * length, 0))})
        m.contact("c", "b.P", "ground.f", stiffness=k, exponent=1, damping=c)
    elif kind == "law":
        push = f"if(b.y < 0, max(0, -{k!r}*b.y*(1 - {c!r}*b.vy)), 0)"
        m.force("c", "b.P", force=["0", push])
    else:
        m.stop("c", "b.P.y", lower=0, stiffness=k, damping=c)
    if kind == "pair":
        # it vibrates on the ball, slowly
        m.point_mass("top", mass=mass, at=(0, 0.11 * length))
        m.spring_damper(
            "s", "b.P", "top.P", stiffness=1e3 * mass / time**2, free_length=0.1 * length
        )
    return m


@pytest.mark.parametrize("scale", some(SCALES, 3))
@pytest.mark.parametrize("damping", some(DAMPINGS, 2))
@pytest.mark.parametrize("kind", CONTACTS)
def test_auto_is_as_fast_as_radau(
    kind: str, damping: float, scale: tuple[float, float, float]
) -> None:
    m = falling(kind, damping, scale)
    start, t_end = kp.assemble(m), scale[2]
    found = kp.dynamics(m, start, t_end=t_end)
    # the default tolerances of auto
    radau = kp.dynamics(m, start, t_end=t_end, method=kp.Radau(rtol=1e-8, atol=1e-11 * scale[1]))
    assert found.statistics["method"] == "radau", found.statistics["why"]
    assert found.statistics["steps"] < 1.2 * radau.statistics["steps"] + 50
    exact = kp.dynamics(m, start, t_end=t_end, method=kp.Radau(rtol=1e-10))
    q = "b.angle" if kind == "rod" else "b.y"
    t = np.linspace(0, t_end, 200)
    size = 1.0 if kind == "rod" else scale[1]
    np.testing.assert_allclose(found(t)[q], exact(t)[q], rtol=0, atol=1e-6 * size)
