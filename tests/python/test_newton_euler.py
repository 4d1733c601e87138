"""Newton's and Euler's equations of each body hold with the reactions that a solution reports."""

from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest
from stress.mechanisms import KINDS

from examples import n_four_bar

#: The largest residual of a solution, relative to the largest force (moment) on the body.
BALANCED = 1e-9
#: Random mechanisms that are not stiff.
QUICK = (2, 5, 6, 8, 10)


def wheels(m: kp.Model) -> None:
    m.ground.points(O=(0, 0), P=(0.5, 0), Q=(0.9, 0))
    for name, mass in (("one", 2), ("two", 3), ("three", 1)):
        m.body(name, mass=mass, inertia=0.02 * mass, center=(0.02, 0.01), points={"C": (0, 0)})
    for joint, point, wheel in (("O", "O", "one"), ("P", "P", "two"), ("Q", "Q", "three")):
        m.revolute(joint, f"ground.{point}", f"{wheel}.C")


def gears() -> kp.Model:
    m = kp.Model("gears", gravity=(0, -9.81))
    wheels(m)
    m.gear("mesh", "one.C", "two.C", radii=(0.2, 0.3), pressure_angle="20*deg")
    m.belt("belt", "two.C", "three.C", radii=(0.1, 0.15))
    m.coordinate_driver("motor", "one.angle", value="3*t + sin(t)")
    m.torque("load", "three", torque="-2 - three.omega")
    return m


def coupled() -> kp.Model:
    m = kp.Model("coupled", gravity=(0, -9.81))
    wheels(m)
    m.coupling("ratio", terms={"one.angle": 2, "two.angle": 1, "Q.angle": -0.5}, value="0.1*t^2")
    m.coordinate_driver("follow", "two.angle", value="sin(t) + 0.3*one.angle")
    return m


def sliding() -> kp.Model:
    m = kp.Model("sliding", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), S=(0, 0))
    m.body("block", mass=3, inertia=0.1, center=(0.1, 0.05), points={"C": (0, 0), "R": (0, 0.2)})
    m.body("wheel", mass=1, inertia=0.01, points={"C": (0, 0)})
    m.point_mass("bob", mass=0.5, at=(0.3, -0.5))
    m.translational("slide", "ground.S", "block.C")
    m.rolling("road", "ground.O", "wheel.C", radius=0.2)
    m.spring_damper("tow", "block.C", "wheel.C", stiffness=50, damping=2, free_length=1)
    m.distance("rope", "block.C", "bob.P", length="0.6 + 0.05*sin(3*t)")
    m.bushing("soft", "block.R", "wheel.C", stiffness=(20, 30, 0), damping=(1, 1, 0))
    return m


STARTS: dict[str, tuple[Callable[[], kp.Model], dict[str, float]]] = {
    "gears": (gears, {}),
    "coupled": (coupled, {}),
    "sliding": (sliding, {"block.x": 0, "block.vx": 1, "wheel.x": 1}),
}


@pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
@pytest.mark.parametrize("name", STARTS)
def test_elements_on_several_bodies_are_balanced(name: str) -> None:
    make, at = STARTS[name]
    model = make()
    solution = kp.dynamics(model, kp.assemble(model, set=at), t_end=1, output_step=0.02)
    assert solution.newton_euler.largest <= BALANCED
    assert solution.newton_euler.force_scale.min() > 0.1  # there are forces to be balanced


@pytest.mark.filterwarnings("ignore::kempe.AssemblyWarning")
@pytest.mark.parametrize("kind", KINDS)
def test_random_mechanisms_are_balanced(kind: str) -> None:
    checked = 0
    for seed in QUICK:
        drawn = KINDS[kind](np.random.default_rng(seed))
        try:
            start = kp.assemble(drawn.model, set=drawn.set, guess=drawn.guess)
            solution = kp.dynamics(drawn.model, start, t_end=0.2)
        except kp.KempeError:
            continue
        checked += 1
        assert solution.newton_euler.largest <= BALANCED, seed
    assert checked > 2


def pendulum() -> tuple[kp.Model, kp.Solution]:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("O", "ground.O", "rod.A")
    return m, kp.dynamics(m, kp.assemble(m, set={"rod.angle": 0.0}), t_end=1, output_step=0.1)


def test_scales_and_residuals_are_those_of_a_pendulum() -> None:
    _, solution = pendulum()
    found = solution.newton_euler
    size = np.hypot(*solution["O"].force(on="rod").T)
    assert found.force_scale[0] == pytest.approx(size.max(), rel=1e-14)
    angle, alpha = solution["rod.angle"], solution["rod.alpha"]
    np.testing.assert_allclose(alpha, -1.5 * 9.81 * np.cos(angle), rtol=1e-12)
    # the moment of the pin about the mass centre is J α with J = m L²/12
    assert found.moment_scale[0] == pytest.approx(np.abs(alpha).max() * 2 / 12, rel=1e-12)


def test_a_wrong_reaction_is_found() -> None:
    model, solution = pendulum()
    state = solution(0.3)
    motion = kp.Motion(model, np.array([0.3]), state.q[None], state.v[None])
    lam = motion.lam.copy()
    lam[0, 0] += 1.0
    motion.__dict__["_dynamics"] = motion.a, lam
    found = motion.newton_euler
    assert found.force[0, 0] == pytest.approx(1.0, rel=1e-12)
    arm = abs(0.5 * np.sin(state["rod.angle"]))
    assert found.moment[0, 0] == pytest.approx(arm, rel=1e-9)


def test_a_wrong_torque_is_found() -> None:
    m = coupled()
    state = kp.assemble(m)
    motion = kp.Motion(m, np.array([0.0]), state.q[None], state.v[None])
    lam = motion.lam.copy()
    row = [*motion.compiled.row_names()].index("follow.angle")
    lam[0, row] += 0.25
    motion.__dict__["_dynamics"] = motion.a, lam
    found = motion.newton_euler
    assert found.force.max() < 1e-12
    np.testing.assert_allclose(found.moment[0], [0.3 * 0.25, 0.25, 0], atol=1e-12)
    assert found.largest == max(found.moment[0] / found.moment_scale)


def test_a_coupling_acts_on_the_bodies_of_its_quantities() -> None:
    model = coupled()
    solution = kp.dynamics(model, kp.assemble(model), t_end=1)
    # 2 one.angle + two.angle - 0.5 Q.angle, where Q joins three to ground
    effort = solution["ratio"].lam[:, 0]
    for body, factor in {"one": 2, "two": 1, "three": -0.5, "ground": -2.5}.items():
        np.testing.assert_allclose(solution["ratio"].torque(on=body), -factor * effort, rtol=1e-12)
        assert not solution["ratio"].force(on=body).any()


def test_the_balance_is_reported() -> None:
    _, solution = pendulum()
    over_time = solution.drift.balance
    assert over_time.shape == solution.t.shape
    assert solution.summary["newton_euler"] == over_time.max() <= BALANCED
    np.testing.assert_array_equal(solution["drift.balance"], over_time)
    assert isinstance(solution.final["drift.balance"], float)


def test_a_driver_acts_on_the_bodies_of_its_law() -> None:
    model = coupled()
    solution = kp.dynamics(model, kp.assemble(model), t_end=1)
    follow = solution["follow"]
    # two.angle - 0.3 one.angle: the torque on one is -0.3 times that on two, ground takes the rest
    on = {body: follow.torque(on=body) for body in ("one", "two", "ground")}
    np.testing.assert_allclose(on["one"], -0.3 * on["two"], rtol=1e-12)
    np.testing.assert_allclose(on["ground"], -on["one"] - on["two"], rtol=1e-12)


def test_a_long_chain_is_balanced() -> None:
    model = n_four_bar.windows(20)
    solution = kp.dynamics(model, n_four_bar.upright(model, 20), t_end=2, output_step=0.1)
    assert solution.newton_euler.largest <= BALANCED
