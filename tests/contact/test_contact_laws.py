"""Laws of compliant contacts against formulas of the tests' own."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

EXACT = kp.DOP853(rtol=1e-11, atol=1e-16)
#: Masses in kg, radii in m.
SCALES = [(2.0, 0.05), (1e-3, 1e-3), (1e12, 1e3)]
STEEL: dict[str, Any] = {"law": "hertz", "young": "210 GPa", "poisson": 0.3}


def approach(load: float, radii: tuple[float, float], width: float) -> float:
    """The approach of two steel cylinders: half-width of the strip, then each centre to it."""
    modulus = 210e9 / (1 - 0.3**2)
    curvature = 1 / radii[0] + 1 / radii[1]
    half = np.sqrt(4 * load / (width * np.pi * curvature * modulus / 2))
    each = [2 * np.log(4 * radius / half) - 1 for radius in radii]
    return float(load / (np.pi * width * modulus) * sum(each))


def inside(load: float, clearance: float, width: float) -> float:
    """The same for a pin in a bush, with the signed sum of radii."""
    part = load / (np.pi * width * 210e9 / (2 * (1 - 0.3**2)))
    return float(part * (np.log(4 * clearance / part) - 1))


def discs(scale: tuple[float, float], **law: Any) -> kp.Model:
    """A disc above a fixed one."""
    mass, radius = scale
    m = kp.Model("discs", gravity=(0, -9.81), parameters={"L": 0.4 * radius})
    m.ground.points(O=(0, 0))
    m.ground.curves(rim={"circle": (0, 0, 3 * radius)})
    m.body("disc", mass=mass, inertia=mass * radius**2, points={"C": (0, 0)})
    m.contact("touch", "disc.C", "ground.rim", radius=radius, **law)
    return m


@pytest.mark.parametrize("scale", SCALES)
def test_cylinders_under_a_weight(scale: tuple[float, float]) -> None:
    mass, radius = scale
    width = 0.4 * radius
    m = discs(scale, width="L", **STEEL)
    depth = approach(mass * 9.81, (radius, 3 * radius), width)
    start = kp.assemble(m, {"disc.x": 0, "disc.y": 4 * radius - depth, "disc.angle": 0})
    assert_allclose(start["touch.force"], mass * 9.81, rtol=1e-6)
    clearance = 0.02 * radius
    m = kp.Model("pin", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("disc", mass=mass, inertia=mass * radius**2, points={"C": (0, 0)})
    m.clearance(
        "pin", "ground.O", "disc.C", radius=radius, clearance=clearance, width=width, **STEEL
    )
    depth = inside(mass * 9.81, clearance, width)
    start = kp.assemble(m, {"disc.x": 0, "disc.y": -clearance - 0.9 * depth, "disc.angle": 0})
    rest = kp.equilibrium(m, start).state
    assert_allclose(-rest["disc.y"] - clearance, depth, rtol=1e-6)


@pytest.mark.parametrize("scale", SCALES)
def test_cylinders_that_bounce(scale: tuple[float, float]) -> None:
    mass, radius = scale
    width, gravity = 0.4 * radius, 9.81
    scale_of_time = 3 * np.sqrt(mass / (1e11 * width))
    speed, high = 0.5 + 30 * gravity * scale_of_time, 4 * radius * (1 + 1e-6)
    damping = 0.15 / speed
    m = discs(scale, width="L", damping=damping, **STEEL)
    start = kp.assemble(m, {"disc.x": 0, "disc.y": high, "disc.vy": -speed, "disc.angle": 0})
    fall = (high - 4 * radius) / speed
    t_end = fall + 8 * scale_of_time
    sol = kp.dynamics(m, start, t_end=t_end, method=EXACT, events={"deepest": "touch.gap_rate"})
    hit, release = sol.events["touch.hit"].t[0], sol.events["touch.release"].t[0]

    def force(depth: float) -> float:
        most = 1e4 * mass * gravity + 1e12 * width * depth
        over = lambda load: approach(load, (radius, 3 * radius), width) - depth  # noqa: E731
        return float(brentq(over, 1e-12 * most, most, xtol=1e-12 * most, rtol=1e-13))

    def slopes(_: float, y: Any) -> Any:
        depth, rate = y
        load = force(depth) if depth > 1e-13 * radius else 0.0
        return [rate, gravity - load * (1 + damping * rate) / mass]

    def out(_: float, y: Any) -> Any:
        return y[0]

    out.terminal, out.direction = True, -1  # type: ignore[attr-defined]
    arrival = np.sqrt(speed**2 + 2 * gravity * (high - 4 * radius))
    tight = {"rtol": 1e-8, "atol": 1e-10 * speed * scale_of_time}
    own = solve_ivp(slopes, (0, 50 * scale_of_time), [0, arrival], events=out, **tight)
    assert_allclose(release - hit, own.t_events[0][0], rtol=1e-5)
    at_release = sol.events["touch.release"].states[0]
    assert_allclose(at_release["touch.gap_rate"], -own.y_events[0][0][1], rtol=1e-6)
    deepest = sol.events["deepest"].states[0]["touch.gap"]
    assert_allclose(-deepest, own.y[0].max(), rtol=1e-3)
    assert np.abs(sol.energy.balance).max() < 1e-6 * mass * speed**2


def test_a_pin_of_cylinders_rubs() -> None:
    """The friction has the normal force of the law."""
    m = kp.Model("shaft", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("disc", mass=2, inertia=0.01, points={"C": (0, 0)})
    fields = {"radius": 0.05, "clearance": 0.001, "width": 0.02, "friction": 0.2, "damping": 50}
    m.clearance("B", "ground.O", "disc.C", **fields, **STEEL)
    phi = np.arctan(0.2)
    r = 0.001 + inside(2 * 9.81 * np.cos(phi), 0.001, 0.02)
    at = {"disc.x": -r * np.sin(phi), "disc.y": -r * np.cos(phi), "disc.omega": 30}
    sol = kp.dynamics(m, kp.assemble(m, at), t_end=0.1)
    assert_allclose(sol["B.force"], 2 * 9.81 * np.cos(phi), rtol=1e-5)
    assert_allclose(sol["B.tangential"], 2 * 9.81 * np.sin(phi), rtol=1e-5)


def test_what_is_refused() -> None:
    steel: dict[str, Any] = {**STEEL, "width": 0.02}
    for given, words in [
        ({"stiffness": 1e8, "young": 1e9}, 'young: belongs to law = "hertz"'),
        ({**STEEL}, "width: missing"),
        ({**steel, "poisson": 0.6}, "poisson: must be from 0 to 0.5"),
        ({**steel, "young": 0}, "young: must be positive"),
        ({**steel, "stiffness": 1e8}, "stiffness: not together with law"),
        ({**steel, "restitution": 0.5}, "restitution: not together with law"),
        ({**steel, "exponent": 2}, "exponent: not together with law"),
        ({**steel, "damping": -1}, "damping: must not be negative"),
    ]:
        with pytest.raises(kp.ModelError, match=words):
            kp.assemble(discs(SCALES[0], **given))
    for curve, radius, side in [
        ({"line": ((1, 0), (-1, 0))}, 0.1, "right"),
        ({"circle": (0, 0, 1)}, 0, "right"),
        ({"circle": (0, 0, 1)}, 1, "left"),
    ]:
        m = kp.Model("bad")
        m.ground.curves(rim=curve)
        m.body("disc", mass=1, inertia=1, points={"C": (0, 0)})
        m.contact("touch", "disc.C", "ground.rim", radius=radius, side=side, **steel)
        with pytest.raises(kp.ModelError, match="law: hertz is the law of two cylinders"):
            kp.assemble(m)
    m = discs(SCALES[0], law="hertz", young=1e3, poisson=0.3, width=0.02)
    start = kp.assemble(m, {"disc.x": 0, "disc.y": 0.2, "disc.angle": 0})
    with pytest.raises(kp.IntegrationError, match="the law of contact touch has no finite value"):
        kp.dynamics(m, start, t_end=5)
