"""The translational joint: the closed form of a slider-crank, and the force of the guide."""

import json
import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.analyses.record import AssemblyWarning
from numpy.testing import assert_allclose

FORMS = json.loads(
    (Path(__file__).parents[1] / "reference" / "closed_forms.json").read_text(encoding="utf-8")
)
SLIDER_CRANK = FORMS["slider_crank_r0.1_l0.3_x_dx_ddx_by_crank_deg"]


def slider_crank(**guide: tuple[float, float]) -> kp.Model:
    m = kp.Model("slider-crank", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=0.1, ends=("O", "A"))
    m.bar("rod", mass=2, length=0.3, ends=("A", "B"))
    m.body("slider", mass=3, inertia=0.01, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("guide", "ground.O", "slider.B", **guide)
    return m


@pytest.mark.parametrize("degrees", list(SLIDER_CRANK), ids=lambda d: f"{d}deg")
def test_a_driven_slider_crank_follows_the_closed_form(degrees: str) -> None:
    """x, dx/dθ and d²x/dθ² at 1 rad/s."""
    m = slider_crank()
    m.coordinate_driver("drive", "crank.angle", value=f"{degrees}*deg + t")
    state = kp.assemble(m)
    truth = [float(SLIDER_CRANK[degrees][key]) for key in ("x", "x'", "x''")]
    assert_allclose([state.q[6], state.v[6], state.a[6]], truth, atol=1e-12)
    assert_allclose(np.abs([*state.q[7:], *state.v[7:], *state.a[7:]]), 0.0, atol=1e-12)


def test_the_force_of_the_guide_is_normal_to_it() -> None:
    axes = (math.radians(25), math.radians(-40))
    m = slider_crank(axes=axes)
    state = kp.assemble(m, set={"crank.angle": "60*deg", "crank.omega": 20})
    guide = state["guide"].force(on="slider", frame="joint")
    assert guide[0] == pytest.approx(0.0, abs=1e-9)
    assert abs(guide[1]) > 1.0
    # Newton's law for the slider
    forces = state["guide"].force(on="slider", frame="global") + state["B"].force(
        on="slider", frame="global"
    )
    weight = np.array([0.0, -3 * 9.81])
    assert_allclose(forces + weight, 3 * state.a[6:8], atol=1e-9)
    torque = state["guide"].torque(on="slider")
    assert float(torque) == pytest.approx(0.01 * state.a[8], abs=1e-9)


def test_a_slider_crank_keeps_its_energy() -> None:
    m = slider_crank(axes=(0.3, 0.1))
    start = kp.assemble(m, set={"crank.angle": 1.0, "crank.omega": 40})
    method = kp.RK45(rtol=1e-9, atol=1e-11)
    solution = kp.dynamics(m, start, t_end=1, output_step=0.01, method=method)
    assert np.abs(solution.energy.balance).max() < 1e-7
    assert solution.drift.position.max() < 1e-8
    assert solution["crank"].angle[-1] > 20  # it made several turns


def test_springs_turn_bodies_on_slides_together() -> None:
    """Angle winding that relaxes a spring must not turn a slider relative to its guide."""
    m = slider_crank()
    m.torsion_spring("spring", "ground", "slider", stiffness=1, free_angle="300*deg")
    with pytest.warns(AssemblyWarning, match="spring"):
        state = kp.assemble(m, set={"crank.angle": "60*deg"})
    assert_allclose(state.residuals[0], 0.0, atol=1e-12)


def test_two_guides_of_one_direction_repeat_each_other() -> None:
    m = slider_crank()
    m.translational("second", "ground.O", "slider.B")
    with pytest.raises(kp.RedundancyError, match="guide"):
        kp.assemble(m, set={"crank.angle": "60*deg"})


def test_a_block_slides_on_an_incline_with_constant_acceleration() -> None:
    m = kp.Model("incline", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("block", mass=2, inertia=1, points={"P": (0.1, 0.2)})
    m.translational("slide", "ground.O", "block.P", axes=("-30*deg", 0.0))
    start = kp.assemble(m)
    solution = kp.dynamics(m, start, t_end=1, output_step=0.1)
    travelled = np.linalg.norm(solution["block"].r - solution["block"].r[0], axis=1)
    assert_allclose(travelled, 0.5 * 9.81 * 0.5 * solution.t**2, atol=1e-9)
    normal = solution["slide"].force(on="block", frame="joint")
    assert_allclose(normal[:, 1], 2 * 9.81 * math.cos(math.radians(30)), rtol=1e-9)
