"""Errors of quantities that are computed on first access."""

import kempe as kp
import numpy as np
import pytest


def swinging(stiffness: str) -> kp.Solution:
    """A rod on a spring; its law is undefined at a time that outputs use but steps do not."""
    model = kp.Model("law", gravity=(0, -9.81))
    model.ground.points(O=(0, 0))
    model.bar("rod", mass=1.0, length=1.0, ends=("A", "B"))
    model.revolute("pin", "ground.O", "rod.A")
    model.torsion_spring("spring", "ground", "rod", stiffness=stiffness)
    start = kp.assemble(model, set={"rod.angle": 0.5})
    return kp.dynamics(model, start, t_end=1.0, output_step=0.05, method=kp.RK4(step=0.04))


def test_an_error_of_a_derived_quantity_is_raised_on_access() -> None:
    defined, undefined = swinging("2"), swinging("2 + (t - 0.25) / (t - 0.25)")
    assert defined.success
    assert undefined.success
    assert np.isfinite(undefined.q).all()
    for ask in ("a", "lam"):
        with pytest.raises(kp.IntegrationError, match=r"undefined at t = 0\.25") as caught:
            getattr(undefined, ask)
        assert caught.value.t == pytest.approx(0.25)
        assert caught.value.hint == "check forces and laws at this state"
        before = caught.value.solution
        assert not before.success
        np.testing.assert_array_equal(before.t, undefined.t[:5])
        assert np.isfinite(before.a).all()
        np.testing.assert_array_equal(before.energy.total, undefined.energy.total[:5])
    assert np.isfinite(defined.a).all()
    assert np.isfinite(undefined.energy.total).all()
