"""A bob on a light cart falls from the horizontal and turns at 4429 rad/s for a microsecond."""

from itertools import pairwise

import kempe as kp
import numpy as np
import pytest
from scipy.integrate import quad

G, CART = 9.81, 1e-6


def cart_pole() -> tuple[kp.Model, kp.State]:
    """A point mass of 1 kg, 1 m from a cart of 1e-6 kg; released horizontally, at rest."""
    m = kp.Model("light cart-pole", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("cart", mass=CART, inertia=1e-9, points={"P": (0, 0)})
    m.body("pole", mass=1, inertia=0, points={"P": (-1, 0)})
    m.translational("rail", "ground.O", "cart.P")
    m.revolute("pin", "cart.P", "pole.P")
    return m, kp.assemble(m, set={"cart.x": 0, "pole.angle": 0})


def fall(angle: float) -> float:
    """Time from the horizontal to an angle below, s; momentum and energy give the rate.

    With the angle a below the horizontal: (cos² a + mu sin² a) a'² / 2 = G sin a.
    """
    mu = CART / (1 + CART)

    def slowness(root: float) -> float:  # a = root² removes the singularity at the start
        a = root * root
        heavy = np.cos(a) ** 2 + mu * np.sin(a) ** 2
        return 2 * root * np.sqrt(heavy / (2 * G * np.sin(a))) if a > 0 else np.sqrt(2 / G)

    # the fast turn, at cos² ~ mu
    ends = [0, np.sqrt(np.pi / 2 - 0.1), np.sqrt(np.pi / 2 - 0.003), np.sqrt(angle)]
    return sum(quad(slowness, *pair, epsabs=1e-14)[0] for pair in pairwise(ends))


@pytest.mark.parametrize("rtol", [1e-6, 1e-8, 1e-10])
def test_the_motion_agrees_with_the_closed_form(rtol: float) -> None:
    model, start = cart_pole()
    quarter = fall(np.pi / 2)
    sol = kp.dynamics(
        model,
        start,
        t_end=8.5 * quarter,
        output_step=quarter,
        method=kp.Auto(rtol=rtol, atol=1e-3 * rtol),
    )
    assert sol.statistics["steps"] < 5000
    assert np.abs(sol.energy.balance).max() < 1e3 * rtol
    # horizontal again at every even quarter, left and right alternately
    assert sol["pole"].angle[2::4] == pytest.approx(-np.pi, abs=1e4 * rtol)
    assert sol["pole"].angle[4::4] == pytest.approx(0, abs=1e4 * rtol)


def test_the_rate_agrees_with_the_energy() -> None:
    model, start = cart_pole()
    sol = kp.dynamics(model, start, t_end=fall(np.pi / 2) * 1.01)
    fastest = np.abs(sol["pole"].omega).max()
    assert fastest == pytest.approx(np.sqrt(2 * G * (1 + CART) / CART), rel=0.02)
    assert 4300 < fastest < 4430
