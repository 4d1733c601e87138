"""Every method passes change points: garage doors and random linkages, on their branch.

KEMPE_FULL=1 takes all 40 linkages instead of one of each kind.
"""

import kempe as kp
import numpy as np
import pytest
from singular.every_method import LINKAGES, METHODS, compared, verdict
from singular.linkages import four_bar
from sizes import FULL

CHOSEN = [n for n in LINKAGES if FULL or n.startswith("garage") or n.endswith(" 0")]


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning")
@pytest.mark.parametrize("by", METHODS)
def test_every_method_passes(by: str) -> None:
    method, allowed = METHODS[by]
    for name in CHOSEN:
        outcome = compared(name, method)
        assert verdict(outcome, allowed) == "passed", f"{name}: {outcome}"


def stiff_linkage(rate: float) -> tuple[kp.Model, kp.State]:
    """A four-bar with change points, and a bob that a stiff spring-damper holds on its crank."""
    linkage = four_bar((1, 2, 3, 4), 1, 1.0, 9.0)
    at = linkage.start()
    m, inertia = linkage.model, 0.01
    m.body("bob", mass=0.1, inertia=inertia, points={"P": (0, 0)})
    m.revolute("hinge", "crank.B", "bob.P")
    stiffness, damping = rate**2 * inertia / 4, rate * inertia
    m.torsion_spring("hold", "crank", "bob", stiffness=stiffness, damping=damping)
    guess: dict[str, float | str] = {"bob.angle": 1.0}
    for body in ("coupler", "rocker"):
        guess |= {f"{body}.{c}": float(getattr(at[body], c)) for c in ("x", "y", "angle")}
    held: dict[str, float | str] = {"crank.angle": 1.0, "crank.omega": 9.0, "bob.omega": 9.0}
    return m, kp.assemble(m, held, guess)


@pytest.mark.parametrize("by", ["radau", "auto"])
def test_a_stiff_linkage_passes(by: str) -> None:
    model, start = stiff_linkage(5e4)
    grid = {"t_end": 1, "output_step": 0.01}
    truth = kp.dynamics(model, start, **grid, method=kp.DOP853(rtol=1e-8, atol=1e-11))
    sol = kp.dynamics(model, start, **grid, method=METHODS[by][0])
    assert sol.statistics["method"] == "radau"
    assert sol.statistics["steps"] < truth.statistics["steps"] / 3
    assert np.abs(sol.q - truth.q).max() < 1e-4
    assert np.abs(sol.energy.balance).max() < 1e-5
