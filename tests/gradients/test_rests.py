"""Slopes of equilibria on a path, with drivers, and of motions that start there."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_random import differences
from gradients.test_truth import SCALES, agrees

Scale = tuple[float, float, float]


def softening(scale: Scale) -> tuple[kp.Case, dict[str, float]]:
    """A slide on a spring that softens: the path over the load turns back at a fold."""
    size, mass, rate = scale
    force = mass * size * rate**2
    numbers = {"k": 3.0 * force / size, "b": 2.0 * force / size**3, "off": 0.1 * size}
    m = kp.Model("softening", gravity=(0, 0), parameters=numbers | {"load": 0.0})
    m.ground.points(O=(0, 0))
    m.body("slide", mass=mass, inertia=mass * size**2, points={"P": ("off", 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.generalized_force("spring", "slide.x", value="load - k*slide.x + b*slide.x^3")
    path = kp.Equilibrium(over="load", range=[-0.5 * force, 3.0 * force])
    return kp.Case(m, {"set": {"slide.x": 0.0}}, [path]), numbers


@pytest.mark.parametrize("scale", SCALES)
def test_the_load_at_a_fold(scale: Scale) -> None:
    case, numbers = softening(scale)
    g = kp.gradient(case, ["folds[0]", "folds[-1]"], list(numbers))

    def fold(k: Any, b: Any, off: Any) -> Any:
        return 2 * k / 3 * np.sqrt(k / (3 * b)) + 0 * off

    agrees(g, "folds[0]", fold, numbers, 1e-9)
    assert np.array_equal(g.jacobian[0], g.jacobian[1])


@pytest.mark.parametrize("scale", SCALES)
def test_the_ends_of_a_path(scale: Scale) -> None:
    """The path begins at the first load, and comes back to it after the fold."""
    case, numbers = softening(scale)
    force = scale[0] * scale[1] * scale[2] ** 2
    names = [*numbers, "load"]
    g = kp.gradient(case, ["slide.x[0]", "slide.P.x[0]", "slide.x[-1]", "values[0]"], names)
    k, b = numbers["k"], numbers["b"]
    for measure in ("slide.x[0]", "slide.x[-1]"):
        x = g.measures[measure]
        assert k * x - b * x**3 == pytest.approx(-0.5 * force, rel=1e-8)
        stiffness = k - 3 * b * x**2
        assert g[measure, "k"] == pytest.approx(-x / stiffness, rel=1e-7)
        assert g[measure, "b"] == pytest.approx(x**3 / stiffness, rel=1e-7)
        assert g[measure, "off"] == g[measure, "load"] == 0.0
    assert g["slide.P.x[0]", "off"] == 1.0
    assert np.array_equal(g.jacobian[3], np.zeros(4))


def test_points_within_a_path_and_counts_have_remarks() -> None:
    case, _ = softening(SCALES[0])
    g = kp.gradient(case, ["slide.x[3]", "steps", "complete", "stable[0]"], ["k"])
    assert np.isnan(g.jacobian).all()
    assert g.remarks["slide.x[3]", "k"].startswith("the path chooses this point")
    assert "does not change gradually" in g.remarks["stable[0]", "k"]


def hanging(scale: Scale, law: str, *analyses: Any) -> tuple[kp.Case, dict[str, float]]:
    """A link that a driver holds, with another one that hangs on it."""
    size, mass, rate = scale
    torque = mass * size**2 * rate**2
    numbers = {"l": size, "k": 3.0 * torque, "g": 9.8 * size * rate**2, "w": rate, "A": 0.3}
    m = kp.Model("hanging", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.bar("upper", mass=mass, length="l", ends=("O", "A"))
    m.bar("lower", mass=2 * mass, length="l", ends=("A", "B"))
    m.revolute("O", "ground.O", "upper.O")
    m.revolute("A", "upper.A", "lower.A")
    fields = {"stiffness": "k", "damping": 0.2 * torque / rate, "free_angle": 0.5}
    m.torsion_spring("spring", "upper", "lower", **fields)
    m.coordinate_driver("drive", "upper.angle", value=law)
    return kp.Case(m, {"set": {"lower.angle": -1.0}}, list(analyses)), numbers


def compare(case: kp.Case, measures: list[str], names: list[str], most: float) -> None:
    g = kp.gradient(case, measures, names)
    assert not g.remarks
    found, _ = differences(case, g)
    values = np.array(list(g.variables.values()))
    scale = np.abs(found * values).max(axis=1, keepdims=True) / np.abs(values)
    assert (np.abs(g.jacobian - found) <= most * scale).all()


@pytest.mark.parametrize("scale", SCALES)
def test_the_effort_of_a_driver_at_rest(scale: Scale) -> None:
    case, numbers = hanging(scale, "A", kp.Equilibrium())
    compare(case, ["effort.drive", "lower.angle"], list(numbers), 1e-8)


@pytest.mark.parametrize("scale", [SCALES[0], SCALES[3]])
def test_modes_of_a_mechanism_that_drivers_hold(scale: Scale) -> None:
    case, numbers = hanging(scale, "A", kp.Equilibrium(name="rest"), kp.Modes())
    compare(case, ["omega[0]", "damping[0]"], list(numbers), 1e-8)


@pytest.mark.parametrize("law", ["A + w*t", "A*cos(w*t)"])
def test_a_motion_from_an_equilibrium_that_drivers_move(law: str) -> None:
    method = kp.DOP853(rtol=1e-12, atol=1e-13)
    run = kp.Dynamics(t_end=0.7, output_step=0.05, method=method, name="run")
    case, numbers = hanging(SCALES[0], law, kp.Equilibrium(name="rest"), run)
    compare(
        case, ["lower.angle.final", "lower.omega.max", "drive.effort.final"], list(numbers), 1e-7
    )


def four_bar(numbers: dict[str, Any], analysis: Any) -> kp.Case:
    m = kp.Model("four-bar", parameters=numbers)
    m.ground.points(A=(0, 0), D=("d", 0))
    for name, length, ends in (("crank", "a", "AB"), ("coupler", "b", "BC"), ("rocker", "c", "DC")):
        m.bar(name, mass=1, length=length, ends=tuple(ends))
    joints = ("A", "ground", "crank"), ("B", "crank", "coupler"), ("C", "coupler", "rocker")
    for name, i, j in (*joints, ("D", "ground", "rocker")):
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    start = {"set": {"crank.angle": 0.6}, "guess": {"rocker.angle": 1.2}}
    return kp.Case(m, start, [analysis])


def test_a_motion_over_a_quantity_follows_formulas_of_parameters() -> None:
    numbers = {"a": 0.5, "b": "1.1*a", "c": 0.6, "d": 1.0}
    case = four_bar(numbers, kp.Kinematics(over="crank.angle", range=[0.6, 0.9]))
    compare(case, ["rocker.angle.final", "coupler.C.y.max"], ["a", "c"], 1e-8)


def test_a_motion_that_ends_at_a_dead_point_fails_as_a_run_does() -> None:
    numbers = {"a": 0.5, "b": 0.55, "c": 0.6, "d": 1.0}
    case = four_bar(numbers, kp.Kinematics(over="crank.angle", range=[0.6, 2.5]))
    with pytest.raises(kp.SingularityError, match=r"crank cannot pass 94\.1.*: dead point"):
        kp.gradient(case, ["rocker.angle.final", "rocker.angle.max"], ["a"])


@pytest.mark.parametrize("scale", SCALES)
def test_gears_at_rest_push_each_other_apart(scale: Scale) -> None:
    """A bar on one wheel, a spring on the other: the radial force of the teeth depends on λ."""
    size, mass, rate = scale
    weight, torque = mass * 9.0 * size * rate**2, mass * (size * rate) ** 2
    numbers = {"m": mass, "k": 7.0 * torque, "L": size, "rest": -0.9, "press": 0.35}
    m = kp.Model("gears", gravity=(0, -weight / mass), parameters=numbers)
    m.ground.points(O=(0, 0), D=(0.7 * size, 0))
    m.bar("arm", mass="m", length="L", ends=("O", "P"))
    m.body("wheel", mass=0, inertia=mass * size**2, points={"D": (0, 0)})
    m.revolute("O", "ground.O", "arm.O")
    m.revolute("D", "ground.D", "wheel.D")
    m.gear("mesh", "arm.O", "wheel.D", radii=(0.4 * size, 0.3 * size), pressure_angle="press")
    m.torsion_spring("spring", "ground", "wheel", stiffness="k", free_angle="rest")
    case = kp.Case(m, {"set": {"arm.angle": 0.6, "wheel.angle": -0.8}}, [kp.Equilibrium()])
    g = kp.gradient(case, ["arm.angle", "mesh.tangential", "D.force"], list(numbers))

    def angle(**of: Any) -> Any:
        found = g.measures["arm.angle"] + 0j
        for _ in range(4):
            arm, ratio = of["m"] * weight / mass * of["L"] / 2, 4 / 3
            sum_of_torques = arm * np.cos(found) + of["k"] * ratio * (ratio * found + of["rest"])
            stiffness = -arm * np.sin(found) + of["k"] * ratio**2
            found = found - sum_of_torques / stiffness
        return found

    def tangential(**of: Any) -> Any:
        return of["k"] * (-4 / 3 * angle(**of) - of["rest"]) / (0.3 * size)

    def pin(**of: Any) -> Any:
        sign = np.sign(np.real(tangential(**of)))
        return sign * tangential(**of) / np.cos(of["press"])

    agrees(g, "arm.angle", angle, numbers, 1e-9)
    told = g.measures["mesh.tangential"]
    sign = np.sign(told * np.real(tangential(**numbers)))
    agrees(g, "mesh.tangential", lambda **of: sign * tangential(**of), numbers, 1e-8)
    agrees(g, "D.force", pin, numbers, 1e-8)
