"""Drives, flywheels, shaking forces and pin loads against formulas by hand."""

import kempe as kp
import numpy as np
import pytest
from kempe import design
from python.test_kinematics import L, R, piston, slider_crank, started

SPEED = 30.0
G = 9.81
#: Masses of crank, rod and piston of ``slider_crank``, and moments of inertia about the centres.
M1, M2, M3 = 0.5, 0.8, 1.2
J1, J2 = M1 * R**2 / 12, M2 * L**2 / 12


@pytest.fixture(scope="module")
def turn() -> kp.Solution:
    m = slider_crank(speed=SPEED)
    return kp.inverse_dynamics(m, started(m), t_end=f"2*pi/{SPEED}", output_step=0.005)


def by_hand(theta: np.ndarray) -> dict[str, np.ndarray]:
    """Positions, accelerations and the torque of the slider-crank at constant speed.

    Vectors are complex numbers. The torque follows from virtual power: that of the driver is the
    sum of those of the inertia forces and the weights, with the opposite sign.
    """
    w = SPEED
    a, va, aa = (R * np.exp(1j * theta) * (1j * w) ** k for k in range(3))
    x, first, second = piston(theta)
    e = x - a
    turning = ((w * first - va) / e).imag  # rate of the rod: ė = i ω e
    alpha = ((w**2 * second - aa) / e).imag
    g1, vg1, ag1 = a / 2, va / 2, aa / 2
    g2, vg2, ag2 = (a + x) / 2, (va + w * first) / 2, (aa + w**2 * second) / 2

    def power(f: np.ndarray, v: np.ndarray) -> np.ndarray:
        return (np.conj(f) * v).real

    torque = (
        power(M1 * (ag1 + 1j * G), vg1)
        + power(M2 * (ag2 + 1j * G), vg2)
        + power(M3 * (w**2 * second + 1j * G), w * first)
        + J2 * alpha * turning
    ) / w
    force = M1 * ag1 + M2 * ag2 + M3 * w**2 * second
    momentum = M1 * ag1, M2 * ag2, M3 * w**2 * second
    places = g1, g2, x + 0j
    return {"torque": torque, "inertia": force, "alpha": alpha, "ma": momentum, "at": places}


# --- Show: a slider-crank, forward with its own torque, and a robot arm ---------------------------


def test_the_torque_of_a_slider_crank_by_hand(turn: kp.Solution) -> None:
    motion = turn(np.linspace(0, 2 * np.pi / SPEED, 777))
    expected = by_hand(0.2 + SPEED * motion.t)["torque"]
    error = np.abs(motion["motor.effort"] - expected).max() / np.abs(expected).max()
    assert error < 1e-9
    crude = expected - M3 * G * 0.01  # a wrong torque is seen
    assert np.abs(motion["motor.effort"] - crude).max() / np.abs(expected).max() > 1e-3


def formula() -> str:
    """The torque by hand as a formula of the crank angle at constant speed."""
    w = SPEED
    sin, cos = "sin(crank.angle)", "cos(crank.angle)"
    root = f"sqrt({L}^2 - ({R}*{sin})^2)"
    first = f"(-{R}*{sin} - {R}^2*{sin}*{cos}/{root})"
    square = f"({cos}^2 - {sin}^2)"
    second = f"(-{R}*{cos} - {R}^2*{square}/{root} - {R}^4*({sin}*{cos})^2/{root}^3)"
    turning = f"(-{R}*{cos}/{root})"  # dβ/dθ with sin β = -R sin θ / L
    alpha = f"({R}*{sin}/{root} - {R}^3*{cos}^2*{sin}/{root}^3)"
    middle = f"(({first}) - {R}*{sin})/2"
    rod_x = f"(({second}) - {R}*{cos})/2"
    terms = [
        f"{M1}*{G}*{R}/2*{cos}",
        f"{M2}*({w}^2*{rod_x}*{middle} + ({G} - {w}^2*{R}/2*{sin})*{R}/2*{cos})",
        f"{M3}*{w}^2*{second}*{first}",
        f"{J2}*{w}^2*{alpha}*{turning}",
    ]
    return " + ".join(f"({term})" for term in terms)


@pytest.mark.parametrize("law", ["formula", "callable"])
def test_forward_dynamics_with_this_torque_returns_the_motion(turn: kp.Solution, law: str) -> None:
    tree = slider_crank(speed=SPEED).tree()
    del tree["drivers"]
    m = kp.Model.from_tree(tree)
    if law == "formula":
        m.torque("T", "crank", torque=formula())
    else:

        def torque(t: float, _: kp.State) -> float:
            return float(by_hand(np.array(0.2 + SPEED * t))["torque"])

        m.torque("T", "crank", torque=torque)
    start = kp.assemble(m, set={"crank.angle": 0.2, "crank.omega": SPEED}, guess={"piston.x": 0.4})
    end = float(turn.t[-1])
    sol = kp.dynamics(m, start, t_end=end, output_step=0.005, method=kp.DOP853(rtol=1e-12))
    assert sol["crank.angle"] == pytest.approx(0.2 + SPEED * sol.t, abs=1e-7)
    for name, size in (("piston.x", 0.1), ("piston.vx", 3.0), ("rod.angle", 1.0)):
        assert sol[name] == pytest.approx(turn(sol.t)[name], abs=1e-7 * size)


def test_a_robot_arm_agrees_with_lagrange() -> None:
    """Two links with driven angles q1 and q2 (of link 2 against link 1); Lagrange's equations."""
    l1, c1, c2, m1, m2, j1, j2 = 0.7, 0.3, 0.25, 4.0, 3.0, 0.2, 0.1
    m = kp.Model("arm", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.body("upper", mass=m1, inertia=j1, points={"O": (-c1, 0), "E": (l1 - c1, 0)})
    m.body("lower", mass=m2, inertia=j2, points={"E": (-c2, 0)})
    m.revolute("S", "ground.O", "upper.O")
    m.revolute("E", "upper.E", "lower.E")
    m.coordinate_driver("d1", "S.angle", value="0.4 + 1.1*sin(2*t)")
    m.coordinate_driver("d2", "E.angle", value="-0.9 + 0.8*cos(3*t) + 0.5*t")
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=3.0, output_step=0.01)
    t = sol.t
    q1, v1, a1 = 0.4 + 1.1 * np.sin(2 * t), 2.2 * np.cos(2 * t), -4.4 * np.sin(2 * t)
    q2, v2 = -0.9 + 0.8 * np.cos(3 * t) + 0.5 * t, -2.4 * np.sin(3 * t) + 0.5
    a2 = -7.2 * np.cos(3 * t)
    m11 = m1 * c1**2 + j1 + j2 + m2 * (l1**2 + c2**2 + 2 * l1 * c2 * np.cos(q2))
    m12 = j2 + m2 * (c2**2 + l1 * c2 * np.cos(q2))
    h = m2 * l1 * c2 * np.sin(q2)
    g2 = m2 * G * c2 * np.cos(q1 + q2)
    g1 = (m1 * c1 + m2 * l1) * G * np.cos(q1) + g2
    tau1 = m11 * a1 + m12 * a2 - h * (2 * v1 * v2 + v2**2) + g1
    tau2 = m12 * a1 + (m2 * c2**2 + j2) * a2 + h * v1**2 + g2
    for name, tau in (("d1", tau1), ("d2", tau2)):
        error = np.abs(sol[f"{name}.effort"] - tau).max() / np.abs(tau).max()
        assert error < 1e-11, name


# --- duty -----------------------------------------------------------------------------------------


def test_the_duty_of_a_drive(turn: kp.Solution) -> None:
    found = design.duty(turn, "motor")
    theta = np.linspace(0, 2 * np.pi, 4096, endpoint=False)
    torque = by_hand(theta)["torque"]
    assert found.unit == "N*m"
    assert found.rms == pytest.approx(np.sqrt((torque**2).mean()), rel=1e-11)
    assert found.mean == pytest.approx(torque.mean(), abs=1e-11 * found.rms)
    assert found.work == pytest.approx(0.0, abs=1e-10)
    fine = by_hand(np.linspace(0, 2 * np.pi, 500_001))["torque"]
    assert abs(found.peak.value) == pytest.approx(np.abs(fine).max(), rel=1e-10)
    assert found.peak_power.value == pytest.approx(SPEED * found.peak.value, rel=1e-12)
    assert found.driving_work + found.braking_work == pytest.approx(found.work, abs=1e-12)
    positive = np.maximum(fine[:-1], 0).mean() * 2 * np.pi
    assert found.driving_work == pytest.approx(positive, rel=1e-9)
    assert found.quadrants == (1, 4)
    assert found.points.shape == (len(found.t), 2)


def test_the_duty_over_the_angle_and_of_a_torque_element() -> None:
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=2.0, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.torque("T", "wheel", torque="3 + 5*sin(t)")
    sol = kp.dynamics(m, kp.assemble(m, set={"wheel.omega": 1.0}), t_end="2*pi")
    found = design.duty(sol, "T")
    assert found.peak.value == pytest.approx(8.0, rel=1e-9)
    assert found.rms == pytest.approx(np.sqrt(9 + 12.5), rel=1e-9)
    gain = 0.5 * 2.0 * (float(sol["wheel.omega"][-1]) ** 2 - 1)
    assert found.work == pytest.approx(gain, rel=1e-7)
    with pytest.raises(kp.ModelError, match=r"unknown driver or force element 'Q'"):
        design.duty(sol, "Q")


@pytest.mark.parametrize(
    ("quarters", "quadrants"), [(1, (4,)), (2, (3, 4)), (3, (2, 3, 4)), (4, (1, 2, 3, 4))]
)
def test_every_number_of_the_duty_of_a_rocking_wheel(
    quarters: int, quadrants: tuple[int, ...]
) -> None:
    """The angle sin t and J = 2 kg·m²: the rate is cos t, the effort -2 sin t."""
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=2.0, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.coordinate_driver("motor", "wheel.angle", value="sin(t)")
    end = quarters * np.pi / 2
    found = design.duty(kp.inverse_dynamics(m, kp.assemble(m), t_end=end), "motor")
    rate, effort = np.cos(found.t), -2 * np.sin(found.t)
    assert found.points == pytest.approx(np.column_stack([rate, effort]), abs=1e-8)
    assert found.power == pytest.approx(rate * effort, abs=1e-8)
    assert found.quadrants == quadrants
    braking = -((quarters + 1) // 2)  # ∫ -sin 2t dt is -1 and 1 in turn
    driving = quarters // 2
    expected = [driving, braking, driving + braking, (driving + braking) / end]
    works = [found.driving_work, found.braking_work, found.work, found.mean_power]
    assert works == pytest.approx(expected, abs=1e-8)
    assert found.mean == pytest.approx(2 * (np.cos(end) - 1) / end, abs=1e-8)
    assert found.rms == pytest.approx(np.sqrt(2 - np.sin(2 * end) / end), rel=1e-8)
    assert found.peak.value == pytest.approx(-2 * np.sin(found.peak.t), abs=1e-8)
    assert abs(found.peak.value) == pytest.approx(2.0, rel=1e-8)
    assert abs(found.peak_power.value) == pytest.approx(1.0, rel=1e-8)


# --- flywheels ------------------------------------------------------------------------------------


@pytest.mark.parametrize("k", [1, 2, 3])
@pytest.mark.parametrize("over", [True, False])
def test_a_flywheel_for_a_harmonic_load(k: int, *, over: bool) -> None:
    """T = T0 + T1 sin kθ: E = -(T1/k) cos kθ, so that ΔE = 2 T1/k (Norton 11.11)."""
    t0, t1, speed, share = 12.0, 7.0, 25.0, 0.04
    m = kp.Model("shaft")
    m.ground.points(O=(0, 0))
    m.body("shaft", mass=1, inertia=0.3, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "shaft.O")
    m.torque("load", "shaft", torque=f"-({t0} + {t1}*sin({k}*shaft.angle))")
    m.coordinate_driver("motor", "shaft.angle", value=f"{speed}*t")
    start = kp.assemble(m)
    if over:
        sol = kp.inverse_dynamics(m, start, over="motor", range=(0, "2*pi"), n=20)
        found = design.flywheel(sol, "motor", fluctuation=share, speed=speed)
    else:
        sol = kp.inverse_dynamics(m, start, t_end=f"2*pi/{speed}", output_step=0.01)
        found = design.flywheel(sol, "motor", fluctuation=share)
    assert found.mean_torque == pytest.approx(t0, rel=1e-12)
    assert found.energy == pytest.approx(2 * t1 / k, rel=1e-12)
    assert found.inertia == pytest.approx(2 * t1 / k / (share * speed**2), rel=1e-12)
    assert np.ptp(found.stored) == pytest.approx(found.energy, rel=1e-5)
    scale = 1.0 if over else speed
    angle = k * scale * found.t
    assert found.torque == pytest.approx(t0 + t1 * np.sin(angle), rel=1e-9)
    assert found.stored == pytest.approx(t1 / k * (np.cos(angle) - 1.0), abs=1e-9 * t1)
    assert (found.speed, found.fluctuation) == pytest.approx((speed, share), rel=1e-12)
    # the speed is least after the load was above its mean, where sin kθ falls through 0
    assert np.cos(k * found.slowest * scale) == pytest.approx(-1.0, abs=1e-9)
    assert np.cos(k * found.fastest * scale) == pytest.approx(1.0, abs=1e-9)


def test_the_flywheel_keeps_the_speed_within_the_fluctuation() -> None:
    """A shaft that is driven by the mean torque, with the flywheel, to second order in C_s."""
    t0, t1, speed, share = 12.0, 7.0, 25.0, 0.01
    m = kp.Model("shaft")
    m.ground.points(O=(0, 0))
    m.body("shaft", mass=1, inertia=1.0, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "shaft.O")
    m.torque("load", "shaft", torque=f"-({t0} + {t1}*sin(2*shaft.angle))")
    m.coordinate_driver("motor", "shaft.angle", value=f"{speed}*t")
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=f"2*pi/{speed}")
    found = design.flywheel(sol, "motor", fluctuation=share)
    tree = m.tree()
    del tree["drivers"]
    free = kp.Model.from_tree(tree)
    free.torque("drive", "shaft", torque=found.mean_torque)
    tree = free.tree()
    tree["bodies"]["shaft"]["inertia"] = found.inertia
    free = kp.Model.from_tree(tree)
    fast = speed * (1 + share / 2)
    run = kp.dynamics(free, kp.assemble(free, set={"shaft.omega": fast}), t_end=1.0)
    omega = run(np.linspace(0, 1, 4001))["shaft.omega"]
    assert np.ptp(omega) / speed == pytest.approx(share, rel=1e-4)


def test_flywheels_that_make_no_sense_are_refused(turn: kp.Solution) -> None:
    m = slider_crank()
    over = kp.inverse_dynamics(m, started(m), over="motor", range=(0, "2*pi"))
    with pytest.raises(kp.ModelError, match="speed: missing"):
        design.flywheel(over, "motor", fluctuation=0.02)
    with pytest.raises(kp.ModelError, match="not between 0 and 1"):
        design.flywheel(turn, "motor", fluctuation=2.0)
    tree = slider_crank().tree()
    tree["drivers"]["motor"]["value"] = "0.2 + sin(t)"
    rocking = kp.Model.from_tree(tree)
    sol = kp.inverse_dynamics(rocking, started(rocking), t_end="2*pi")
    with pytest.raises(kp.ModelError, match="does not turn in one direction"):
        design.flywheel(sol, "motor", fluctuation=0.02)


# --- shaking --------------------------------------------------------------------------------------


def test_the_shaking_force_of_a_slider_crank_by_hand(turn: kp.Solution) -> None:
    about = 0.03 - 0.07j
    found = design.shaking(turn, (about.real, about.imag))
    hand = by_hand(0.2 + SPEED * found.t)
    scale = np.abs(hand["inertia"]).max()
    assert found.force @ [1, 1j] == pytest.approx(-hand["inertia"], abs=1e-10 * scale)
    moment = -J2 * hand["alpha"]
    for place, force in zip(hand["at"], hand["ma"], strict=True):
        moment = moment - (np.conj(place - about) * force).imag
    assert found.moment == pytest.approx(moment, abs=1e-10 * np.abs(moment).max())
    assert found.weight == pytest.approx(np.tile([0, -(M1 + M2 + M3) * G], (len(found.t), 1)))
    assert found.on_ground == pytest.approx(found.force + found.weight)
    turning = sum(
        -mass * G * (place - about).real
        for mass, place in zip((M1, M2, M3), hand["at"], strict=True)
    )
    assert found.weight_moment == pytest.approx(turning, abs=1e-10 * np.abs(turning).max())
    assert found.moment_on_ground == pytest.approx(
        moment + turning, abs=1e-9 * np.abs(moment).max()
    )
    with pytest.raises(kp.ModelError, match="not a point of ground"):
        design.shaking(turn, "crank.O")


@pytest.mark.parametrize("example", ["cam_roller", "toggle_press", "six_bar", "planetary_gear"])
def test_the_shaking_force_is_the_rate_of_the_momentum(example: str) -> None:
    """Force by the momentum of all bodies, moment by their angular momentum, for any mechanism."""
    sol = kp.load(f"examples/{example}.toml").run()[0]
    times = np.linspace(float(sol.t[2]), float(sol.t[-3]), 9)
    found = design.shaking(sol(times), (0.0, 0.0))
    force, moment = np.zeros((9, 2)), np.zeros(9)
    motion = sol(times)
    for name, info in sol.compiled.bodies.items():
        own = motion.body(name)
        centre = own.at(info.center)
        force -= info.mass * centre.acceleration
        (x, y), (ax, ay) = centre.position.T, centre.acceleration.T
        moment -= info.inertia * own.alpha + info.mass * (x * ay - y * ax)
    assert found.force == pytest.approx(force, abs=1e-9 * np.abs(force).max())
    scale = np.abs(moment).max() + np.abs(force).max() * 0.1
    assert found.moment == pytest.approx(moment, abs=1e-9 * scale)
