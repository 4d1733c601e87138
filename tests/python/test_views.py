"""Numbers of bodies, joints and forces: closed forms of the slider-crank, Newton on the six-bar."""

import copy
import math

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT


@pytest.fixture(scope="module")
def crank() -> kp.Solution:
    """The slider-crank, r = 0.1 m and l = 0.3 m, to 0.3 s."""
    case = kp.load(ROOT / "examples" / "slider_crank.toml")
    return case.with_analysis("coasting", t_end=0.3, output_step=0.01).run()[0]


@pytest.fixture(scope="module")
def six_bar() -> kp.Solution:
    """The six-bar linkage over one turn."""
    case = kp.load(ROOT / "examples" / "six_bar.toml")
    return case.with_analysis("turns", t_end=1.0, output_step=0.01).run()[0]


def turned(vectors: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Components of global vectors in axes turned by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors.T
    return np.stack([c * x + s * y, c * y - s * x], axis=1)


def test_columns_of_a_body_have_their_names(crank: kp.Solution) -> None:
    rod = crank.body("rod")
    for k, names in enumerate((("x", "vx", "ax"), ("y", "vy", "ay"), ("angle", "omega", "alpha"))):
        for array, name in zip((crank.q, crank.v, crank.a), names, strict=True):
            np.testing.assert_array_equal(getattr(rod, name), array[:, 3 + k])
            assert np.ptp(array[:, 3 + k]) > 0.0
    np.testing.assert_array_equal(rod.r, crank.q[:, 3:5])


def test_the_pin_of_a_crank_moves_on_its_circle(crank: kp.Solution) -> None:
    """r_A = r u, v_A = ω r n, a_A = α r n - ω² r u, with n to the left of u."""
    body = crank.body("crank")
    phi, omega, alpha = (np.asarray(one)[:, None] for one in (body.angle, body.omega, body.alpha))
    u = np.hstack([np.cos(phi), np.sin(phi)])
    n = np.hstack([-np.sin(phi), np.cos(phi)])
    pin = body.point("A")
    np.testing.assert_allclose(pin.position - body.r, 0.1 * u, atol=1e-13)
    np.testing.assert_allclose(pin.velocity - body.velocity, 0.1 * omega * n, atol=1e-12)
    expected = 0.1 * (alpha * n - omega**2 * u)
    np.testing.assert_allclose(pin.acceleration - body.acceleration, expected, atol=1e-10)
    aside = body.at((0.02, -0.03))
    np.testing.assert_allclose(aside.position - body.r, 0.02 * u - 0.03 * n, atol=1e-13)
    across = aside.velocity - body.velocity
    np.testing.assert_allclose(across, omega * (0.02 * n + 0.03 * u), atol=1e-12)
    expected = alpha * (0.02 * n + 0.03 * u) - omega**2 * (0.02 * u - 0.03 * n)
    np.testing.assert_allclose(aside.acceleration - body.acceleration, expected, atol=1e-10)


def test_the_slider_is_where_the_triangle_puts_it(crank: kp.Solution) -> None:
    phi = np.asarray(crank.body("crank").angle)
    x = 0.1 * np.cos(phi) + np.sqrt(0.3**2 - (0.1 * np.sin(phi)) ** 2)
    np.testing.assert_allclose(crank.body("slider").x, x, atol=1e-6)


def test_newton_holds_for_every_body(crank: kp.Solution, six_bar: kp.Solution) -> None:
    """m a = Σ F + m g, and J α = Σ T + Σ s × F about the mass centre."""
    for sol in (crank, six_bar):
        for name, body in sol.model.bodies.items():
            center = sol.body(name).at(body.center)
            force = np.tile(body.mass * np.array(sol.model.gravity), (len(sol.t), 1))
            torque = np.zeros(len(sol.t))
            for joint, info in sol.model.constraints.items():
                if name not in (info.i, info.j):
                    continue
                view = sol.constraint(joint)
                point = info.point_i if name == info.i else info.point_j
                arm = sol.body(name).at(point).position - center.position
                on = np.asarray(view.force(on=name))
                force = force + on
                torque = torque + view.torque(on=name) + arm[:, 0] * on[:, 1] - arm[:, 1] * on[:, 0]
            for element, acting in sol.model.forces.items():
                if name in (acting.i, acting.j):
                    torque = torque + sol.force(element).torque(on=name)
            scale = max(1.0, float(np.abs(force).max()))
            np.testing.assert_allclose(
                force, body.mass * np.asarray(center.acceleration), atol=1e-9 * scale
            )
            expected = body.inertia * np.asarray(sol.body(name).alpha)
            np.testing.assert_allclose(torque, expected, atol=1e-9 * scale)


@pytest.mark.parametrize(("joint", "on"), [("C", "plate"), ("C", "coupler"), ("F", "output")])
def test_frames_of_a_reaction_are_those_of_the_body(
    six_bar: kp.Solution, joint: str, on: str
) -> None:
    view = six_bar.joint(joint)
    whole = np.asarray(view.force(on=on))
    expected = turned(whole, np.asarray(six_bar.body(on).angle))
    assert np.abs(expected - whole).max() > 1.0
    np.testing.assert_allclose(view.force(on=on, frame="body"), expected, atol=1e-9)
    np.testing.assert_allclose(view.force(on=on, frame="joint"), expected, atol=1e-9)
    other = view.info.i if on == view.info.j else view.info.j
    np.testing.assert_array_equal(view.force(on=other), -whole)


def spring_on_a_turning_rod() -> tuple[kp.State, np.ndarray]:
    """A spring of 100 N/m from (-1.2, 0.3) m to the end of a rod at -30°, and its force."""
    m = kp.Model(gravity=(0, -9.81))
    m.ground.points(O=(0, 0), A=(-1.2, 0.3))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.spring_damper("s", "ground.A", "rod.P", stiffness=100, damping=2, free_length=0.9)
    state = kp.assemble(m, set={"rod.angle": "-30*deg", "rod.omega": 2.0})
    P = np.array([math.cos(math.pi / 6), -0.5])
    d = P - [-1.2, 0.3]
    length = math.hypot(*d)
    rate = 2.0 * (d @ np.array([0.5, P[0]])) / length
    return state, -(100.0 * (length - 0.9) + 2.0 * rate) * d / length


def test_the_force_of_a_spring_by_hand_in_both_frames_and_on_both_bodies() -> None:
    state, force = spring_on_a_turning_rod()
    view = state.force("s")
    np.testing.assert_allclose(view.force(on="rod"), force, rtol=1e-12)
    np.testing.assert_allclose(view.force(on="ground"), -force, rtol=1e-12)
    c, s = math.cos(math.pi / 6), -0.5
    local = [c * force[0] + s * force[1], c * force[1] - s * force[0]]
    np.testing.assert_allclose(view.force(on="rod", frame="body"), local, rtol=1e-12)
    assert view.torque(on="rod") == 0.0  # about the end of the rod, at which the force acts
    arm = view.place(on="rod") - state.body("rod").r
    moment = arm[0] * force[1] - arm[1] * force[0]
    assert moment == pytest.approx(0.5 * local[1], rel=1e-12)
    parts = [view.force(on="rod", part=part) for part in view.parts]
    np.testing.assert_allclose(np.sum(parts, axis=0), force, rtol=1e-12)
    damping = view.damping_force(on="rod", frame="body")
    np.testing.assert_allclose(damping, view.force(on="rod", frame="body", part="damping"))


def test_a_view_can_be_copied() -> None:
    state, force = spring_on_a_turning_rod()
    again = copy.copy(state.force("s"))
    np.testing.assert_allclose(again.force(on="rod"), force, rtol=1e-12)
    with pytest.raises(AttributeError, match="its parts: stiffness, damping"):
        again.spring_force  # noqa: B018


def test_a_wrong_frame_has_the_right_remedy() -> None:
    state, _ = spring_on_a_turning_rod()
    for view, frame, remedy in (
        (state.force("s"), "local", "write 'body'"),
        (state.force("s"), "ground", "write 'global'"),
        (state.joint("O"), "local", "write 'body'"),
        (state.joint("O"), "ground", "write 'global'"),
    ):
        with pytest.raises(kp.ModelError, match=remedy):
            view.force(on="rod", frame=frame)  # type: ignore[call-overload, arg-type]
    with pytest.raises(kp.ModelError, match="frame"):
        state.force("s").force(on="rod", frame="joint")  # type: ignore[arg-type]


def test_the_residuals_of_an_open_mechanism_by_hand() -> None:
    """A = (0.3, 0) of a rod at 90°, its frame at (0.01, -0.02) m: Φ and its rate at the pin."""
    m = kp.Model()
    m.ground.points(O=(0.0, 0.0))
    m.body("rod", mass=1, inertia=1, points={"A": (0.3, 0)})
    m.revolute("O", "ground.O", "rod.A")
    q, v = np.array([0.01, -0.02, math.pi / 2]), np.array([0.5, 0.7, 2.0])
    state = kp.results.motion.Motion(m, 0.0, q, v)
    view = state.joint("O")
    np.testing.assert_allclose(view.residual, [0.01, 0.28], atol=1e-14)
    np.testing.assert_allclose(view.residual_rate, [0.5 - 0.6, 0.7], atol=1e-14)


def test_rates_of_residuals_are_their_derivatives(crank: kp.Solution) -> None:
    t = np.linspace(0.05, 0.06, 2001)
    fine = crank(t)
    for name in ("A", "B", "guide"):
        view = fine.joint(name)
        rate = np.gradient(np.asarray(view.residual), t, axis=0, edge_order=2)
        assert np.abs(np.asarray(view.residual_rate) - view.residual).max() > 0.0
        np.testing.assert_allclose(
            np.mean(rate, axis=0), np.mean(view.residual_rate, axis=0), atol=1e-5
        )


def test_a_joint_without_coordinates_of_its_own_has_an_empty_array(crank: kp.Solution) -> None:
    for name in crank.model.joints:
        assert crank.joint(name).coordinates.shape == (len(crank.t), 0)
    assert crank.initial.joint("A").coordinates.shape == (0,)


@pytest.mark.parametrize("damping", [0.0, 4.0])
def test_the_power_of_a_damped_oscillator(damping: float) -> None:
    """x = x0 e^(-δt) (cos ωt + δ/ω sin ωt), P = -(k x + c v) v; its integral is what T gains."""
    m = kp.Model("mass", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    m.spring_damper("s", "ground.O", "mass.P", stiffness=50, damping=damping, free_length=1)
    start = kp.assemble(m, set={"mass.x": 1.1})
    sol = kp.dynamics(m, start, t_end=2.0, output_step=1e-3, method=kp.DOP853(rtol=1e-11))
    delta = damping / 4.0
    omega, t = math.sqrt(25.0 - delta**2), sol.t
    x = 0.1 * np.exp(-delta * t) * (np.cos(omega * t) + delta / omega * np.sin(omega * t))
    v = -0.1 * np.exp(-delta * t) * 25.0 / omega * np.sin(omega * t)
    power = sol.force("s").power
    np.testing.assert_allclose(power, -(50.0 * x + damping * v) * v, atol=1e-8)
    np.testing.assert_array_equal(sol["s.power"], power)
    work = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2e3)])
    np.testing.assert_allclose(work, v**2, atol=1e-5)
    assert isinstance(sol.final.force("s").power, float)
    assert sol.final.force("s").power == power[-1]


def test_power_between_two_moving_bodies_is_force_by_rate_and_torque_by_rate() -> None:
    """Free bodies: an oblique spring-damper off their centres, and a torsion spring."""
    m = kp.Model("two", gravity=(0, -9.81))
    for name in "ab":
        m.body(name, mass=1, inertia=0.2, points={"P": (0.3, 0.1)})
    m.spring_damper("s", "a.P", "b.P", stiffness=30, damping=2, free_length=0.4)
    m.torsion_spring("coil", "a", "b", stiffness=3, damping=0.5)
    q, v = [0, 0, 0.3, 1, 0.4, -0.6], [0.4, -0.2, 1.5, -0.3, 0.7, -0.8]
    state = kp.State(m, 0.0, np.array(q, float), np.array(v, float))
    d = state["b"].point("P").position - state["a"].point("P").position
    d_rate = state["b"].point("P").velocity - state["a"].point("P").velocity
    length = np.hypot(*d)
    rate = d @ d_rate / length
    force = -(30.0 * (length - 0.4) + 2.0 * rate)
    assert state.force("s").power == pytest.approx(force * rate)
    torque = -(3.0 * -0.9 + 0.5 * -2.3)
    assert state.force("coil").power == pytest.approx(torque * -2.3)


def test_points_are_named_or_have_their_place(solution: kp.Solution) -> None:
    rocker = solution.body("rocker")
    assert repr(rocker.point("C")) == "<point rocker.C>"
    assert repr(rocker.at((0.5, -2))) == "<point rocker.(0.5, -2.0)>"
