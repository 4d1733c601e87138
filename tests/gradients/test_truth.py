"""Slopes against closed forms, which complex steps differentiate without kempe."""

from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from scipy.special import ellipe, ellipk

#: Sizes in m, masses in kg and rates in 1/s over which each form is tested.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e-3, 30.0), (1e3, 1e3, 0.03), (1e-3, 1e3, 1.0)]
EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)


def slope(f: Callable[..., Any], numbers: dict[str, float], name: str) -> float:
    """The derivative of a closed form by a complex step."""
    step = 1e-30 * abs(numbers[name] or 1.0)
    return float(np.imag(f(**{**numbers, name: numbers[name] + 1j * step})) / step)


def agrees(
    g: kp.Gradient, measure: str, f: Callable[..., Any], numbers: dict[str, float], rel: float
) -> None:
    """Compare a measure and its slopes with a closed form of the variables."""
    assert g.measures[measure] == pytest.approx(float(np.real(f(**numbers))), rel=rel)
    true = {name: slope(f, numbers, name) for name in numbers}
    largest = max(abs(x * numbers[name]) for name, x in true.items())
    for name, x in true.items():
        size = largest / abs(numbers[name])
        assert g[measure, name] == pytest.approx(x, rel=rel, abs=rel * size), (measure, name)
    assert not [pair for pair in g.remarks if pair[0] == measure]


def pendulum(size: float, mass: float, rate: float) -> tuple[kp.Case, dict[str, float]]:
    """A compound pendulum that starts at rest, and its numbers; it passes the lowest point."""
    numbers = {
        "m": 2.0 * mass,
        "J": 0.3 * mass * size**2,
        "d": 0.7 * size,
        "g": 9.0 * rate**2 * size,
    }
    m = kp.Model("pendulum", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.body("rod", mass="m", inertia="J", points={"O": ("-d", 0)})
    m.revolute("O", "ground.O", "rod.O")
    start = {"rod.angle": -np.pi / 2 + 0.8, "rod.omega": 0.0}
    run = kp.Dynamics(t_end=0.8 / rate, output_step=0.05 / rate, method=EXACT, name="swing")
    return kp.Case(m, {"set": start}, [run]), {**numbers, "rod.angle": start["rod.angle"]}


def rate_below(m: Any, inertia: Any, d: Any, g: Any, angle: Any) -> Any:
    """The rate of a pendulum at its lowest point, from energy."""
    return np.sqrt(2.0 * m * g * d * (1.0 - np.sin(-angle)) / (inertia + m * d**2))


@pytest.mark.parametrize("scale", SCALES)
def test_the_largest_rate_and_force_of_a_pendulum(scale: tuple[float, float, float]) -> None:
    case, numbers = pendulum(*scale)
    g = kp.gradient(case, ["rod.omega.min", "O.force.max"], list(numbers))

    def rate(**of: Any) -> Any:
        return -rate_below(of["m"], of["J"], of["d"], of["g"], of["rod.angle"])

    def force(**of: Any) -> Any:
        return of["m"] * (of["g"] + of["d"] * rate(**of) ** 2)

    agrees(g, "rod.omega.min", rate, numbers, 1e-8)
    agrees(g, "O.force.max", force, numbers, 1e-8)


@pytest.mark.parametrize("scale", SCALES)
def test_a_quarter_of_the_period_of_a_pendulum(scale: tuple[float, float, float]) -> None:
    case, numbers = pendulum(*scale)
    g = kp.gradient(case, ["rod.omega.t_min"], list(numbers))
    J, m, d, gravity = (numbers[name] for name in ("J", "m", "d", "g"))
    amplitude = numbers["rod.angle"] + np.pi / 2
    k = np.sin(amplitude / 2)
    inertia, moment = J + m * d**2, m * gravity * d
    quarter = np.sqrt(inertia / moment) * ellipk(k**2)
    of_k = ellipe(k**2) / (k * (1 - k**2)) - ellipk(k**2) / k
    true = {
        "J": quarter / (2 * inertia),
        "m": quarter / 2 * (d**2 / inertia - 1 / m),
        "d": quarter / 2 * (2 * m * d / inertia - 1 / d),
        "g": -quarter / (2 * gravity),
        "rod.angle": np.sqrt(inertia / moment) * of_k * np.cos(amplitude / 2) / 2,
    }
    assert g.measures["rod.omega.t_min"] == pytest.approx(quarter, rel=1e-6)
    for name, x in true.items():
        size = quarter / abs(numbers[name])
        assert g["rod.omega.t_min", name] == pytest.approx(x, rel=0, abs=1e-6 * size), name


@pytest.mark.parametrize("scale", SCALES)
def test_a_damped_oscillator(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": 2.0 * mass, "k": 18.0 * mass * rate**2, "c": 1.2 * mass * rate}
    numbers |= {"slide.x": 0.3 * size, "slide.vx": -0.5 * size * rate}
    given = {name: numbers[name] for name in "mkc"}
    m = kp.Model("oscillator", gravity=(0, 0), parameters=given)
    m.ground.points(O=(0, 0))
    m.body("slide", mass="m", inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.generalized_force("spring", "slide.x", value="-k*slide.x - c*slide.vx")
    start = {name: numbers[name] for name in ("slide.x", "slide.vx")}
    run = kp.Dynamics(t_end=1.1 / rate, output_step=0.1 / rate, method=EXACT)
    t = 1.1 / rate

    def motion(at: Any = t, **of: Any) -> Any:
        decay = of["c"] / (2 * of["m"])
        turns = np.sqrt(of["k"] / of["m"] - decay**2)
        x, v = of["slide.x"], of["slide.vx"]
        return np.exp(-decay * at) * (
            x * np.cos(turns * at) + (v + decay * x) / turns * np.sin(turns * at)
        )

    g = kp.gradient(kp.Case(m, {"set": start}, [run]), ["slide.x.final"], list(numbers))
    agrees(g, "slide.x.final", motion, numbers, 1e-9)


def slider_crank(size: float, mass: float, rate: float, analysis: str) -> tuple[kp.Case, Any]:
    """A slider-crank whose only mass is its slider; the crank turns once and a bit."""
    numbers = {"r": 0.2 * size, "l": 0.5 * size, "load": 3.0 * mass, "w": 4.0 * rate}
    m = kp.Model("slider-crank", gravity=(0, 0), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.body("crank", mass=0, inertia=0, points={"O": (0, 0), "A": ("r", 0)})
    m.body("rod", mass=0, inertia=0, points={"A": (0, 0), "B": ("l", 0)})
    m.body("slider", mass="load", inertia=mass * size**2, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("guide", "ground.O", "slider.B")
    m.coordinate_driver("motor", "crank.angle", value="0.3 + w*t")
    run = {"kinematics": kp.Kinematics, "inverse_dynamics": kp.InverseDynamics}[analysis]
    turn = run(t_end=1.7 / rate, output_step=0.02 / rate)
    guess = {"slider.x": 0.69 * size}
    return kp.Case(m, {"guess": guess}, [turn]), numbers


def slide(r: Any, l: Any, w: Any, t: float) -> tuple[Any, Any, Any]:  # noqa: E741
    """Position and acceleration of the slider, and the cosine of the angle of the rod."""
    at = 0.3 + w * t
    s, c = r * np.sin(at), r * np.cos(at)
    root = np.sqrt(l**2 - s**2)
    second = -((c**2 - s**2) / root + (s * c) ** 2 / root**3) * w**2
    return c + root, -c * w**2 + second, root / l


@pytest.mark.parametrize("scale", SCALES)
def test_position_and_force_of_a_slider_crank(scale: tuple[float, float, float]) -> None:
    case, numbers = slider_crank(*scale, "inverse_dynamics")
    measures = ["slider.x.final", "slider.x.max", "slider.x.min", "B.force.final"]
    g = kp.gradient(case, measures, list(numbers))
    t = 1.7 / scale[2]
    agrees(g, "slider.x.final", lambda load, **of: slide(**of, t=t)[0] + 0 * load, numbers, 1e-9)
    agrees(g, "slider.x.max", lambda **of: of["r"] + of["l"], numbers, 1e-9)
    agrees(g, "slider.x.min", lambda **of: of["l"] - of["r"], numbers, 1e-9)

    def force(load: Any, **of: Any) -> Any:
        _, acceleration, cosine = slide(**of, t=t)
        found = load * acceleration / cosine
        return found * np.sign(np.real(found))

    agrees(g, "B.force.final", force, numbers, 1e-8)


def rocker(a: Any, b: Any, c: Any, d: Any, start: Any) -> Any:
    """The angle of the rocker of a four-bar, by Freudenstein's equation."""
    ax, ay = a * np.cos(start), a * np.sin(start)
    k1, k2, k3 = 2 * c * (ax - d), 2 * c * ay, b**2 - c**2 - (ax - d) ** 2 - ay**2
    # k1 cos θ + k2 sin θ + k3 = 0 with the pin of the rocker at (d, 0)
    root = np.sqrt(k1**2 + k2**2 - k3**2)
    return 2 * np.arctan((k2 - root) / (k1 - k3))


@pytest.mark.parametrize("scale", SCALES)
def test_the_angle_of_a_four_bar(scale: tuple[float, float, float]) -> None:
    """The start of a run closes the linkage, so that its slopes are those of the assembly."""
    size, mass, rate = scale
    numbers = {"a": 0.3 * size, "b": 0.9 * size, "c": 0.6 * size, "d": 1.0 * size, "start": 1.1}
    m = kp.Model("four-bar", gravity=(0, 0), parameters=numbers)
    m.ground.points(A=(0, 0), D=("d", 0))
    for name, length, ends in (("crank", "a", "AB"), ("coupler", "b", "BC"), ("rocker", "c", "DC")):
        m.bar(name, mass=mass, length=length, ends=tuple(ends))
    for name, i, j in (
        ("A", "ground", "crank"),
        ("B", "crank", "coupler"),
        ("C", "coupler", "rocker"),
    ):
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    m.revolute("D", "ground.D", "rocker.D")
    start = {"set": {"crank.angle": "start", "crank.omega": 0.0}, "guess": {"rocker.angle": 1.2}}
    run = kp.Dynamics(t_end=1e-3 / rate, output_step=1e-3 / rate)
    g = kp.gradient(kp.Case(m, start, [run]), ["rocker.angle.final"], list(numbers))

    agrees(g, "rocker.angle.final", rocker, numbers, 1e-10)


def rod(size: float, mass: float, rate: float, **statics: Any) -> tuple[kp.Case, dict[str, float]]:
    """A rod on a torsion spring that rests, and its numbers."""
    torque = mass * size**2 * rate**2
    numbers = {"m": 2.0 * mass, "l": 1.3 * size, "k": 12.0 * torque, "g": 8.0 * size * rate**2}
    m = kp.Model("rod", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass="m", length="l", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("spring", "ground", "rod", stiffness="k", free_angle=0)
    rest = kp.Equilibrium(**statics)
    return kp.Case(m, {"set": {"rod.angle": -0.3}}, [rest]), numbers


@pytest.mark.parametrize("scale", SCALES)
def test_a_rod_at_rest(scale: tuple[float, float, float]) -> None:
    case, numbers = rod(*scale)
    g = kp.gradient(case, ["rod.angle", "O.force", "rod.P.y", "spring.torque"], list(numbers))
    angle, (m, length, k, gravity) = g.measures["rod.angle"], numbers.values()
    moment = m * gravity * length / 2
    assert k * angle + moment * np.cos(angle) == pytest.approx(0.0, abs=1e-9 * moment)
    stiffness = k - moment * np.sin(angle)
    of_moment = -moment * np.cos(angle) / stiffness
    true = {"m": of_moment / m, "l": of_moment / length, "g": of_moment / gravity}
    true["k"] = -angle / stiffness
    for name, x in true.items():
        assert g["rod.angle", name] == pytest.approx(x, rel=1e-9), name
        assert g["spring.torque", name] == pytest.approx(
            -k * x - (angle if name == "k" else 0.0), rel=1e-9
        )
        height = length * np.cos(angle) * x + (np.sin(angle) if name == "l" else 0.0)
        assert g["rod.P.y", name] == pytest.approx(height, rel=1e-9), name
    force = {"m": gravity, "g": m, "l": 0.0, "k": 0.0}
    for name, x in force.items():
        assert g["O.force", name] == pytest.approx(x, rel=1e-9, abs=1e-9 * m * gravity / length)


@pytest.mark.parametrize("scale", SCALES)
def test_the_effort_that_holds_a_rod(scale: tuple[float, float, float]) -> None:
    case, numbers = rod(*scale, hold=["rod.angle"])
    names = [*numbers, "rod.angle"]
    g = kp.gradient(case, ["effort.rod.angle"], names)
    angle, (m, length, k, gravity) = -0.3, numbers.values()
    moment = m * gravity * length / 2

    assert g.measures["effort.rod.angle"] == pytest.approx(k * angle + moment * np.cos(angle))
    whole = moment * np.cos(angle)
    true = {"m": whole / m, "l": whole / length, "g": whole / gravity, "k": angle}
    true["rod.angle"] = k - moment * np.sin(angle)
    for name, x in true.items():
        assert g["effort.rod.angle", name] == pytest.approx(x, rel=1e-9), name


def test_the_slider_crank_of_the_sensitivity_solvers() -> None:
    """The slider-crank of the sensitivity examples of SUNDIALS (`idasSlCrank_FSA_dns`).

    The numbers were computed apart from kempe, by complex steps and by extrapolation.
    """
    m = kp.Model("slider-crank", parameters={"k": 1.0, "c": 1.0})
    m.ground.points(O=(0, 0))
    m.body("crank", mass=1, inertia=1, points={"O": (0, 0), "M": (0.25, 0), "B": (0.5, 0)})
    ends = {"P": (0, 0), "A": (-1, 0), "H": (-0.5, 0), "F": (1, 0)}
    m.body("rod", mass=1, inertia=2, points=ends)
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.B", "rod.A")
    m.pin_in_slot("slide", "ground.O", "rod.P")
    m.spring_damper("spring", "crank.M", "rod.H", stiffness="k", damping="c", free_length=1)
    m.force("push", "rod.F", force=(1, 0))
    run = kp.Dynamics(t_end=10, method=kp.DOP853(rtol=1e-13, atol=1e-14), name="run")
    start = {"set": {"crank.angle": np.pi / 2}, "guess": {"rod.x": 1.0, "rod.angle": -0.5}}
    whole = "energy.kinetic.integral"
    g = kp.gradient(kp.Case(m, start, [run]), ["crank.angle.final", whole], ["k", "c"])
    assert g.measures[whole] == pytest.approx(3.3366067994828, abs=1e-12)
    assert g[whole, "k"] == pytest.approx(0.3334481061284, abs=1e-12)
    assert g[whole, "c"] == pytest.approx(-0.3637540339710, abs=1e-12)
    assert g.measures["crank.angle.final"] == pytest.approx(1.2756758486502, abs=1e-12)
    assert g["crank.angle.final", "k"] == pytest.approx(-0.1739779292603, abs=1e-12)
    assert g["crank.angle.final", "c"] == pytest.approx(-0.2687606670919, abs=1e-12)


@pytest.mark.parametrize("scale", SCALES)
def test_a_condition_ends_the_motion_at_a_time_that_moves(
    scale: tuple[float, float, float],
) -> None:
    size, mass, rate = scale
    numbers = {"g": 9.0 * size * rate**2, "h": 2.0 * size, "low": 0.5 * size}
    m = kp.Model("drop", gravity=(0, "-g"), parameters=numbers)
    m.body("ball", mass=mass, inertia=mass * size**2)
    vx = 3.0 * size * rate
    start = {"ball.y": "h", "ball.vx": vx}
    run = kp.Dynamics(
        t_end=10 / rate, output_step=0.01 / rate, method=EXACT, stop="ball.y < low", name="fall"
    )
    case = kp.Case(m, {"set": start}, [run])
    measures = ["ball.x.final", "ball.vy.final", "ball.x.max", "ball.vy.t_min", "ball.x.mean"]
    measures += ["ball.x.rms", "ball.x.integral", "energy.kinetic.integral"]
    g = kp.gradient(case, measures, list(numbers))

    def time(**of: Any) -> Any:
        return np.sqrt(2.0 * (of["h"] - of["low"]) / of["g"])

    agrees(g, "ball.x.final", lambda **of: vx * time(**of), numbers, 1e-9)
    agrees(g, "ball.x.max", lambda **of: vx * time(**of), numbers, 1e-9)
    agrees(g, "ball.vy.final", lambda **of: -of["g"] * time(**of), numbers, 1e-9)
    agrees(g, "ball.vy.t_min", time, numbers, 1e-9)
    agrees(g, "ball.x.mean", lambda **of: vx * time(**of) / 2.0, numbers, 1e-9)
    agrees(g, "ball.x.rms", lambda **of: vx * time(**of) / np.sqrt(3.0), numbers, 1e-9)
    agrees(g, "ball.x.integral", lambda **of: vx * time(**of) ** 2 / 2.0, numbers, 1e-9)

    def kinetic(**of: Any) -> Any:
        t = time(**of)
        return mass / 2.0 * (vx**2 * t + of["g"] ** 2 * t**3 / 3.0)

    agrees(g, "energy.kinetic.integral", kinetic, numbers, 1e-9)


@pytest.mark.parametrize("size", [1e-3, 1.0])
def test_implicit_steps_give_the_slopes_of_explicit_steps(size: float) -> None:
    numbers = {"l": size, "m": 2.0, "k": 4e4 * size**2, "c": 300.0 * size**2}
    m = kp.Model("stiff", gravity=(0, -9.81 * size), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.bar("upper", mass="m", length="l", ends=("O", "A"))
    m.bar("lower", mass="m", length="l", ends=("A", "B"))
    m.revolute("O", "ground.O", "upper.O")
    m.revolute("A", "upper.A", "lower.A")
    m.torsion_spring("hinge", "upper", "lower", stiffness="k", damping="c")
    start = {"upper.angle": -1.0, "lower.angle": -0.9, "upper.omega": 0.0, "lower.omega": 0.0}
    measures = [
        "upper.angle.final",
        "lower.omega.final",
        "O.force.final",
        "energy.dissipated.final",
    ]
    found = [
        kp.gradient(
            kp.Case(m, {"set": start}, [kp.Dynamics(t_end=1, method=method, name="run")]),
            measures,
            [*numbers, "upper.angle"],
        )
        for method in (EXACT, kp.Radau(rtol=1e-10, atol=1e-12 * size))
    ]
    explicit, implicit = (one.jacobian for one in found)
    scale = np.abs(explicit * [*numbers.values(), 1.0]).max(axis=1, keepdims=True)
    error = np.abs(implicit - explicit) * [*numbers.values(), 1.0] / scale
    assert error.max() < 1e-7
    assert not found[1].remarks


@pytest.mark.parametrize("scale", SCALES)
def test_the_place_of_the_largest_holding_torque(scale: tuple[float, float, float]) -> None:
    """Positions at rest follow one another over an angle: the torque is a cos(angle) + k angle."""
    size, mass, rate = scale
    numbers = {"m": 2.0 * mass, "L": size, "k": 3.0 * mass * (size * rate) ** 2}
    g0 = 9.0 * size * rate**2
    m = kp.Model("arm", gravity=(0, -g0), parameters=numbers)
    m.ground.points(O=(0, 0))
    m.bar("arm", mass="m", length="L", ends=("O", "P"))
    m.revolute("O", "ground.O", "arm.O")
    m.torsion_spring("spring", "ground", "arm", stiffness="k", free_angle=0)
    turn = kp.InverseDynamics(over="arm.angle", range=(-0.4, 1.5), n=20, static=True)
    case = kp.Case(m, {"set": {"arm.angle": 0.0}}, [turn])
    g = kp.gradient(case, ["over.effort.t_max", "over.effort.max"], list(numbers))

    def place(**of: Any) -> Any:
        return np.arcsin(of["k"] / (of["m"] * g0 * of["L"] / 2))

    def most(**of: Any) -> Any:
        at = place(**of)
        return of["m"] * g0 * of["L"] / 2 * np.cos(at) + of["k"] * at

    agrees(g, "over.effort.t_max", place, numbers, 1e-6)
    agrees(g, "over.effort.max", most, numbers, 1e-9)
