"""Beams whose sections vary along the arc length, against integrals and Bessel functions."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.special import iv, ivp, jv, jvp

YOUNG, DENSITY = 2.1e11, 7850.0


def tapered(size: float, height: str, elements: int = 6, **fields: object) -> kp.Model:
    m = kp.Model("tapered", parameters={"L": size})
    m.ground.points(O=(0, 0))
    section = kp.Section.rectangle(height=height, width=0.04 * size)
    given = {"young": YOUNG, "density": DENSITY, "shear": False, "elements": elements, **fields}
    m.beam("rod", length="L", section=section, points={"P": "30 %"}, **given)
    m.weld("clamp", "ground.O", "rod.A")
    return m


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_tapered_cantilever_bends_by_mohr(size: float) -> None:
    m = tapered(size, "0.05*L - 0.03*s")
    force = 50 * size**2
    m.force("load", "rod.B", force=(0, -force))
    state = kp.equilibrium(m, kp.assemble(m)).state

    def second(x: float) -> float:
        return 0.04 * (0.05 - 0.03 * x) ** 3 / 12

    down = quad(lambda x: (1 - x) ** 2 / second(x), 0, 1)[0] * force / (YOUNG * size)
    assert -state["rod.B.y"] == pytest.approx(down, rel=2e-5)
    beam = state.beam("rod")
    height = 0.05 * size - 0.03 * beam.s
    stress = 6 * force * (size - beam.s) / (0.04 * size * height**2)
    inside = np.arange(len(beam.s)) % 5 % 4 != 0  # the Gauss points
    assert beam.stress[inside] == pytest.approx(stress[inside], rel=2e-3)


def test_the_mass_of_a_tapered_beam_is_that_of_the_frustum() -> None:
    compiled = tapered(1.0, "0.05 - 0.03*s").compile()
    masses = [body.mass for body in compiled.bodies.values()]
    assert sum(masses) == pytest.approx(DENSITY * 0.04 * 0.035, rel=1e-14)


def test_a_wedge_rings_as_kirchhoff_computed() -> None:
    # height h0 x/L from the tip: w = x^(-1/2) (a J1 + b I1)(2 sqrt(beta x)); clamped at x = L
    def clamped(u: float) -> float:
        # w = 0 and w' = 0 at u = 2 sqrt(beta L): J1 I1' - I1 J1' = 0 up to the common factor
        return float(jv(1, u) * ivp(1, u) - iv(1, u) * jvp(1, u))

    root = brentq(clamped, 4, 5.5)
    exact = (root / 2) ** 2 * 0.05 * np.sqrt(YOUNG / (12 * DENSITY))
    # the sharp tip has no mass: the last hundredth is cut off, which changes little
    m = tapered(0.99, "0.05*(1 - s)", elements=16)
    omega = kp.modes(m, kp.assemble(m)).omega
    assert omega[0] == pytest.approx(exact, rel=2e-3)


def test_stiffness_may_vary_as_given() -> None:
    m = kp.Model("given")
    m.ground.points(O=(0, 0))
    given = {"EI": "2 - s", "mass_per_length": "1 + s", "inertia_per_length": 1e-3}
    m.beam("rod", length=1, elements=4, shear=False, inextensible=True, **given)
    m.weld("clamp", "ground.O", "rod.A")
    m.force("load", "rod.B", force=(0, -1e-3))
    state = kp.equilibrium(m, kp.assemble(m)).state
    down = quad(lambda x: 1e-3 * (1 - x) ** 2 / (2 - x), 0, 1)[0]
    assert -state["rod.B.y"] == pytest.approx(down, rel=2e-6)


@pytest.mark.parametrize(
    ("height", "words"),
    [
        ("0.05*L - 0.06*s", "rectangle of -0.00999"),
        ("0.05*L - 0.06*s", "at s = 1 m; must be > 0"),
        ("0.05*L - 0.06*u", "unknown"),
        ("2 s", "is in s; must be in m"),
    ],
)
def test_impossible_tapers_are_refused(height: str, words: str) -> None:
    with pytest.raises(kp.KempeError) as refused:
        tapered(1.0, height).compile()
    assert words in str(refused.value)


def test_a_parameter_named_s_is_refused() -> None:
    m = kp.Model("named", parameters={"s": 1.0})
    section = kp.Section.rectangle(height="0.05 - 0.03*s", width=0.04)
    m.beam("rod", length=1, section=section, young=YOUNG, density=DENSITY)
    with pytest.raises(kp.KempeError, match="rename the parameter"):
        m.compile()
