"""Counterweights against Berkof and Lowen's conditions."""

from copy import copy
from itertools import product

import kempe as kp
import numpy as np
import pytest
from design_problems.machines import SCALES, four_bar
from kempe.design.weights import least
from scipy.optimize import minimize


def measured(case: kp.Case) -> float:
    (motion,) = case.run().values()
    assert isinstance(motion, kp.Solution)
    return float(np.hypot(*kp.design.shaking(motion).force.T).max())


@pytest.mark.parametrize("scale", SCALES)
def test_counterweights_are_those_of_berkof_and_lowen(scale: tuple[float, float, float]) -> None:
    case, exact = four_bar(*scale)
    case = case.with_parameters({"front": 0.0, "rear": 0.0})
    found = kp.design.balance(case, on=["crank", "rocker"])
    for name, place in (("crank", "front"), ("rocker", "rear")):
        one = found.masses[name]
        assert one.mass * one.at[0] == pytest.approx(4.0 * scale[0] * exact[place], rel=1e-10)
        assert one.at[1] == pytest.approx(0.0, abs=1e-10 * scale[1])
    assert found.after < 1e-10 * found.before
    assert measured(found.case) < 1e-9 * found.before
    assert found.before == pytest.approx(measured(case), rel=1e-6)


def test_a_coupler_with_its_mass_beside_the_line_of_its_pins() -> None:
    """m1 r1 = m2 (r2 - b) a/b and m3 r3 = -m2 r2 c/b, as vectors in the frames of the links."""
    places = np.array([1.01 + 1.62j, 1.11 + 2.02j, 0.90 + 2.25j])
    poses = list(zip(places.real, places.imag, (0.82, 0.63, 0.45), strict=True))
    pivots = {"O": (0, 0), "D": (3, 0)}
    (one,) = kp.synthesis.motion(poses, pivots=pivots, defects="tell")
    found = kp.design.balance(one.case, radius=0.1)
    model = one.case.model.compile()
    o, a, b, d, _ = one.pins
    coupler = model.bodies["coupler"]
    start = one.case.start()
    turn = np.exp(1j * start["coupler.angle"])
    center = start["coupler.x"] + 1j * start["coupler.y"] + turn * complex(*coupler.center)
    ratio = (center - a) / (b - a)
    own = {"crank": (a - o, 1.0 - ratio, o), "rocker": (b - d, ratio, d)}
    for name, (link, share, pivot) in own.items():
        body = model.bodies[name]
        wanted = -(body.mass * 0.5 + coupler.mass * share) * link
        weight = found.masses[name]
        angle = np.exp(1j * start[f"{name}.angle"])
        at = start[f"{name}.x"] + 1j * start[f"{name}.y"] + angle * complex(*weight.at)
        assert weight.mass * (at - pivot) == pytest.approx(wanted, rel=1e-9)
        assert abs(at - pivot) == pytest.approx(0.1)
    assert found.after < 1e-10 * found.before


def test_one_counterweight_leaves_the_least_mean_square() -> None:
    case, _ = four_bar(1.0, 1.0, 1.0)
    case = case.with_parameters({"front": 0.0, "rear": 0.0})
    found = kp.design.balance(case, on=["crank"])
    assert set(found.masses) == {"crank"}
    assert 0.0 < found.after < found.before

    def mean(weight: float) -> float:
        shifted = case.with_parameters({"front": weight})
        (motion,) = shifted.run().values()
        assert isinstance(motion, kp.Solution)
        return float((kp.design.shaking(motion, fine=False).force[:-1] ** 2).mean())

    one = found.masses["crank"]
    best = one.mass * one.at[0] / 4.0
    assert mean(best) < min(mean(best + 0.02), mean(best - 0.02))


def test_wrong_requests_are_explained() -> None:
    case, _ = four_bar(1.0, 1.0, 1.0)
    with pytest.raises(kp.ModelError, match=r"coupler.*crank"):
        kp.design.balance(case, on=["coupler"])
    with pytest.raises(kp.ModelError, match="torque"):
        kp.design.balance(case, of="torques")
    with pytest.raises(kp.ModelError, match=r"radius\.crank"):
        kp.design.balance(case, radius=0.0)
    with pytest.raises(kp.ModelError, match="no motion"):
        kp.design.balance(kp.Case(case.model))
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=1, length=1, ends=("O", "E"))
    m.revolute("O", "ground.O", "arm.O")
    free = kp.Case(m, {"set": {"arm.angle": 0.3}}, [kp.Dynamics(t_end=1)])
    with pytest.raises(kp.ModelError, match=r"change the motion.*inverse_dynamics"):
        kp.design.balance(free)
    with pytest.raises(kp.ModelError, match="exactly one driver, and the case has none"):
        kp.design.balance(free, of="torque")


def arm(mass: float, size: float, value: str, *, static: bool = False) -> kp.Case:
    """A driven arm in gravity, whose mass centre lies beside its axis."""
    m = kp.Model("arm", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    center = (0.4 * size, 0.1 * size)
    points = {"O": (0, 0), "E": (size, 0)}
    m.body("arm", mass=mass, inertia=0.02 * mass * size**2, center=center, points=points)
    m.revolute("O", "ground.O", "arm.O")
    if static:
        m.coordinate_driver("drive", "arm.angle", value="0")
        over = {"over": "arm.angle", "range": (-0.7, 1.1), "n": 40, "static": True}
        return kp.Case(m, None, [kp.InverseDynamics(**over)])
    m.coordinate_driver("drive", "arm.angle", value=value)
    return kp.Case(m, None, [kp.InverseDynamics(t_end=1, output_step=0.005)])


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("static", [True, False])
def test_an_arm_without_torque_has_its_mass_centre_in_its_pivot(
    scale: tuple[float, float, float], static: bool
) -> None:
    mass, size, _ = scale
    found = kp.design.balance(arm(mass, size, "2*pi*t", static=static), of="torque")
    one = found.masses["arm"]
    assert one.mass * np.array(one.at) == pytest.approx(
        [-0.4 * mass * size, -0.1 * mass * size], rel=1e-9
    )
    assert found.before == pytest.approx(9.81 * mass * size * np.hypot(0.4, 0.1), rel=0.2)
    assert found.after < 1e-9 * found.before


def test_the_inertia_of_a_counterweight_counts() -> None:
    case = arm(2.0, 0.5, "0.8*sin(2*pi*t)")
    found = kp.design.balance(case, of="torque", radius=0.3)
    one = found.masses["arm"]
    assert np.hypot(*one.at) == pytest.approx(0.3)
    t = np.linspace(0, 1, 4001)[:-1]
    wave, pace = 2 * np.pi * t, 2 * np.pi
    angle, alpha = 0.8 * np.sin(wave), -0.8 * pace**2 * np.sin(wave)
    own = 2.0 * (0.2 + 0.05j)
    inertia = 0.02 * 2.0 * 0.25 + abs(own) ** 2 / 2.0

    def effort(u: complex) -> np.ndarray:
        pull = 9.81 * ((own + u) * np.exp(1j * angle)).real
        return np.asarray((inertia + abs(u) * 0.3) * alpha + pull)

    def mean(x: np.ndarray) -> float:
        return float((effort(complex(*x)) ** 2).mean())

    starts = product((-0.6, -0.2, 0.2, 0.6), repeat=2)
    best = min(
        (minimize(mean, start, method="Nelder-Mead", tol=1e-13) for start in starts),
        key=lambda one: one.fun,
    )
    assert one.mass * np.array(one.at) == pytest.approx(best.x, abs=1e-4 * abs(own))
    assert mean(one.mass * np.array(one.at)) == pytest.approx(best.fun, rel=1e-6)
    assert found.after == pytest.approx(abs(effort(complex(*best.x))).max(), rel=1e-3)
    assert best.fun < 0.9 * mean(np.zeros(2))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_place_on_a_curve_is_not_a_coordinate_of_a_counterweight(size: float) -> None:
    # an eccentric: its follower rises by the projection of its centre, as in a Scotch yoke
    m = kp.Model("eccentric", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    rim = {"rim": {"circle": (0.3 * size, 0, size)}}
    m.body("cam", mass=2, inertia=size**2, center=(0.3 * size, 0), points={"O": (0, 0)}, curves=rim)
    m.body("follower", mass=1e-9, inertia=1e-9 * size**2, points={"F": (0, 0)})
    m.revolute("O", "ground.O", "cam.O")
    m.translational("guide", "ground.O", "follower.F", axes=("90 deg", "90 deg"))
    m.point_on_curve("touch", "follower.F", "cam.rim")
    m.coordinate_driver("drive", "cam.angle", value="2*pi*t")
    start = {"set": {"cam.angle": 0.0}, "guess": {"follower.y": size}}
    case = kp.Case(m, start, [kp.InverseDynamics(t_end=1, output_step=0.01)])
    assert case.start().compiled.column_names()[-1] == "touch.u"
    found = kp.design.balance(case, of="torque", radius=0.2 * size)
    one = found.masses["cam"]
    assert one.mass * np.array(one.at) == pytest.approx([-0.6 * size, 0], abs=1e-6 * size)
    assert found.after < 1e-6 * found.before


@pytest.mark.parametrize("of", ["moment", "torque"])
def test_two_counterweights_are_better_than_their_neighbours(of: str) -> None:
    case, _ = four_bar(1.0, 1.0, 4.0, gravity=9.81 if of == "torque" else 0.0)
    case = case.with_parameters({"front": 0.0, "rear": 0.0})
    about = (0.3, -0.2)
    found = kp.design.balance(case, of=of, on=["crank", "rocker"], radius=0.2, about=about)

    def mean(changed: kp.Case) -> float:
        (motion,) = changed.run().values()
        assert isinstance(motion, kp.Solution)
        if of == "torque":
            values = motion["drive.effort"]
        else:
            values = kp.design.shaking(motion, about, fine=False).moment
        return float((values[:-1] ** 2).mean())

    def moved(name: str, more: tuple[float, float]) -> kp.Case:
        made = copy(case)
        bodies = case.model.compile().bodies
        for body, one in found.masses.items():
            grown, turned = more if body == name else (0.0, 0.0)
            pivot = {"crank": "A", "rocker": "D"}[body]
            arm = complex(*one.at) - complex(*bodies[body].points[pivot])
            arm *= np.exp(1j * turned)
            center, mass = (arm.real, arm.imag), one.mass * (1 + grown)
            made.model.body(
                f"{body}_own", mass=mass, inertia=0, center=center, points={pivot: (0, 0)}
            )
            made.model.weld(f"{body}_on", f"{body}.{pivot}", f"{body}_own.{pivot}")
        return made

    best = mean(found.case)
    assert mean(moved("", (0, 0))) == pytest.approx(best, rel=1e-9)
    assert best < 0.9 * mean(case)
    for name in found.masses:
        for more in ((0.05, 0), (-0.05, 0), (0, 0.05), (0, -0.05)):
            assert mean(moved(name, more)) > best


@pytest.mark.parametrize("m", [1, 2, 3])
@pytest.mark.parametrize("linear", [True, False])
def test_vectors_of_hand_made_squares(m: int, linear: bool) -> None:
    """Known vectors leave nothing; beside them, and with noise, every step makes it worse."""
    draw = np.random.default_rng(m)
    columns = draw.standard_normal((m, 3, 40))
    if linear:
        columns[:, 2] = 0.0
    known = draw.standard_normal(m) + 1j * draw.standard_normal(m)

    def sum_of(vectors: np.ndarray) -> np.ndarray:
        parts = np.stack([vectors.real, vectors.imag, np.abs(vectors)])
        return np.asarray(np.einsum("ck,kcn->n", parts, columns))

    found = least(-sum_of(known), columns, linear=linear)
    np.testing.assert_allclose(found, known, rtol=1e-7)
    base = -sum_of(known) + draw.standard_normal(40)
    found = least(base, columns, linear=linear)
    best = np.linalg.norm(base + sum_of(found))
    for k in range(m):
        for step in (1e-3, -1e-3, 1e-3j, -1e-3j):
            beside = found + step * (np.arange(m) == k)
            assert np.linalg.norm(base + sum_of(beside)) > best
    # a vector without influence is zero, wherever it is
    silent = np.insert(columns, 1, 0.0, axis=0)
    both = least(-sum_of(known), silent, linear=linear)
    np.testing.assert_allclose(both, np.insert(known, 1, 0.0), rtol=1e-7, atol=0)
    assert not least(np.zeros(40), columns, linear=linear).any()
