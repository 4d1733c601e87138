"""Slopes that need a device of their own, against extrapolated differences and closed forms."""

import kempe as kp
import numpy as np
import pytest
from gradients.test_random import differences

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
DRIVEN = kp.InverseDynamics(t_end=0.5, output_step=0.01, name="run")
FORWARD = kp.Dynamics(t_end=0.5, output_step=0.01, method=EXACT, name="run")


def compare(case: kp.Case, measures: list[str], variables: list[str], most: float) -> None:
    g = kp.gradient(case, measures, variables)
    assert not g.remarks
    true, _ = differences(case, g)
    given = np.abs(list(g.variables.values()))
    scale = np.abs(true * given).max(axis=1, keepdims=True) / given
    assert (np.abs(g.jacobian - true) <= most * scale).all()


@pytest.mark.parametrize("size", [1e-2, 1.0, 1e2])
@pytest.mark.parametrize("analysis", [DRIVEN, FORWARD])
def test_friction_that_depends_on_its_reaction(
    analysis: kp.InverseDynamics | kp.Dynamics, size: float
) -> None:
    numbers = {"r": 0.1 * size, "l": 0.3 * size, "mu": 0.2, "m": 2.0}
    m = kp.Model("rubbing", gravity=(0, -9.81 * size), parameters=numbers)
    m.ground.points(O=(0, 0), S=(0, 0.02 * size))
    m.bar("crank", mass=1, length="r", ends=("O", "A"))
    m.bar("rod", mass="m", length="l", ends=("A", "B"))
    m.body("piston", mass=1, inertia=0.01 * size**2, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "piston.B")
    m.translational("P", "ground.S", "piston.B")
    m.friction("rub", joint="P", kinetic="mu", velocity=0.01 * size)
    m.coordinate_driver("drive", coordinate="crank.angle", value="0.4+9*t")
    case = kp.Case(m, {"guess": {"rod.angle": 0.0, "piston.x": 0.4 * size}}, [analysis])
    compare(case, ["drive.effort.final", "P.force.final", "A.force.final"], list(numbers), 1e-8)


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_rates_that_are_nearest_to_a_guess(mass: float) -> None:
    m = kp.Model("two links", parameters={"l": 0.5, "m": 2.0 * mass})
    m.ground.points(O=(0, 0))
    m.bar("upper", mass=mass, length=0.4, ends=("O", "A"))
    m.bar("lower", mass="m", length="l", ends=("A", "B"))
    m.revolute("O", "ground.O", "upper.O")
    m.revolute("A", "upper.A", "lower.A")
    start = {
        "set": {"upper.angle": -1.0, "lower.angle": -0.2, "lower.B.vy": 1.0},
        "guess": {"lower.omega": 2.0},
    }
    case = kp.Case(m, start, [kp.Dynamics(t_end=1e-6, method=EXACT, name="run")])
    variables = ["l", "m", "lower.B.vy", "upper.angle"]
    compare(case, ["upper.omega.final", "lower.omega.final"], variables, 1e-8)


def test_the_work_of_a_driver() -> None:
    numbers = {"J": 0.3, "w": 4.0}
    m = kp.Model("flywheel", parameters=numbers)
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia="J", points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.coordinate_driver("turn", coordinate="wheel.angle", value="w*t^2/2")
    case = kp.Case(m, None, [kp.Dynamics(t_end=2, output_step=0.1, method=EXACT, name="run")])
    g = kp.gradient(case, ["energy.work.final"], list(numbers))
    assert g.measures["energy.work.final"] == pytest.approx(0.5 * 0.3 * 8.0**2, rel=1e-10)
    assert g["energy.work.final", "J"] == pytest.approx(0.5 * 8.0**2, rel=1e-10)
    assert g["energy.work.final", "w"] == pytest.approx(0.3 * 4.0 * 2.0**2, rel=1e-10)


def test_a_law_that_switches_moves_with_its_time() -> None:
    m = kp.Model("pushed", parameters={"F": 2.0, "at": 0.5})
    m.body("ball", mass=1, inertia=1, points={"P": (0, 0)})
    m.force("push", "ball.P", force=("if(t > at, F, 0)", 0))
    case = kp.Case(m, {"set": {"ball.x": 0}}, [kp.Dynamics(t_end=1, name="run")])
    g = kp.gradient(case, ["ball.x.final"], ["F", "at"])
    assert g.measures["ball.x.final"] == pytest.approx(0.25)
    assert g.jacobian == pytest.approx(np.array([[0.5**2 / 2, -2.0 * 0.5]]), rel=1e-9)
    assert not g.remarks


def test_slopes_of_a_long_run_meet_the_joints() -> None:
    numbers = {"crank": 1.0, "rod": 2.5, "k": 20.0}
    m = kp.Model("swinging", gravity=(0, -9.81), parameters=numbers)
    m.ground.points(O=(0, 0), D=(2, 0))
    m.bar("crank", mass=1, length="crank", ends=("O", "A"))
    m.bar("rod", mass=2, length="rod", ends=("A", "B"))
    m.bar("rocker", mass=1.5, length=2, ends=("B", "D"))
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "rocker.B")
    m.revolute("D", "ground.D", "rocker.D")
    m.torsion_spring("hinge", "ground", "crank", stiffness="k")
    start = {"set": {"crank.angle": 1.2}, "guess": {"rod.angle": 0.3, "rocker.angle": -1.9}}
    loose = kp.DOP853(rtol=1e-4, atol=1e-6)
    case = kp.Case(m, start, [kp.Dynamics(t_end=20, output_step=0.37, method=loose, name="run")])
    for name in ("y.final", "vy.final", "y.mean", "vy.mean"):  # means are read within steps
        both = [f"rod.B.{name}", f"rocker.B.{name}"]
        one, other = kp.gradient(case, both, list(numbers)).jacobian
        assert one == pytest.approx(other, rel=1e-9)


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_rates_that_nothing_holds_stay_where_they_are(mass: float) -> None:
    m = kp.Model("thrown")
    m.body("ball", mass=mass, inertia=0.3 * mass, points={"P": (1, 0)}, center=(0.4, 0.1))
    case = kp.Case(m, {"set": {"ball.vx": 2.0}}, [kp.Dynamics(t_end=1.5, method=EXACT)])
    g = kp.gradient(case, ["ball.x.final", "ball.y.final", "ball.angle.final"], ["ball.vx"])
    assert g.jacobian.ravel() == pytest.approx([1.5, 0.0, 0.0], abs=1e-9)


def test_a_guess_that_the_start_follows_is_named() -> None:
    m = kp.Model("bead", parameters={"r": 2.0})
    m.ground.curves(ring={"circle": [0, 0, "r"]})
    m.body("bead", mass=1, inertia=0.1, points={"P": (0.1, 0)})
    m.point_on_curve("on", "bead.P", "ground.ring")
    start = {"set": {"bead.angle": 0.2, "bead.P.x": 1.0}, "guess": {"on.u_rate": 0.5, "bead.y": 1}}
    case = kp.Case(m, start, [kp.Dynamics(t_end=0.5, method=EXACT)])
    g = kp.gradient(case, ["bead.y.final"], ["r"])
    assert np.isnan(g.jacobian).all()
    assert "prescribe on.u_rate in set" in str(g.remarks)
