"""Slopes of integrals, means and root mean squares against closed forms."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_truth import SCALES, agrees


@pytest.mark.parametrize("scale", SCALES)
def test_a_bounce_moves_with_the_variables(scale: tuple[float, float, float]) -> None:
    """A ball falls, and rises again: its velocity jumps at a time that moves."""
    size, mass, rate = scale
    numbers = {"g": 2.0 * size * rate**2, "e": 0.5, "h": size}
    m = kp.Model("ball", gravity=(0, "-g"), parameters=numbers)
    m.body("ball", mass=2 * mass, inertia=mass * size**2)
    m.stop("floor", "ball.y", lower=0, restitution="e")
    end, method = 1.5 / rate, kp.DOP853(rtol=1e-12, atol=1e-14 * size)
    run = kp.Dynamics(t_end=end, output_step=0.7 / rate, method=method)
    measures = ["vy.integral", "vy.mean", "vy.rms", "y.integral"]
    measures = [*(f"ball.{one}" for one in measures), "energy.kinetic.integral"]
    g = kp.gradient(kp.Case(m, {"set": {"ball.y": "h"}}, [run]), measures, list(numbers))

    def parts(**of: Any) -> tuple[Any, ...]:
        """Time of the fall, speed and time of the rise, and the integral of the square of vy."""
        fall = np.sqrt(2.0 * of["h"] / of["g"])
        up, rise = of["e"] * of["g"] * fall, end - fall
        square = of["g"] ** 2 * fall**3 / 3 + (up**3 - (up - of["g"] * rise) ** 3) / (3 * of["g"])
        return fall, up, rise, square

    def way(**of: Any) -> Any:
        _, up, rise, _ = parts(**of)
        return -of["h"] + up * rise - of["g"] * rise**2 / 2

    def area(**of: Any) -> Any:
        fall, up, rise, _ = parts(**of)
        below = of["h"] * fall - of["g"] * fall**3 / 6
        return below + up * rise**2 / 2 - of["g"] * rise**3 / 6

    agrees(g, "ball.vy.integral", way, numbers, 1e-9)
    agrees(g, "ball.vy.mean", lambda **of: way(**of) / end, numbers, 1e-9)
    agrees(g, "ball.vy.rms", lambda **of: np.sqrt(parts(**of)[3] / end), numbers, 1e-9)
    agrees(g, "ball.y.integral", area, numbers, 1e-9)
    agrees(g, "energy.kinetic.integral", lambda **of: mass * parts(**of)[3], numbers, 1e-9)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("exponent", [1, 1.5, 2])
def test_the_impulse_of_a_soft_floor(scale: tuple[float, float, float], exponent: float) -> None:
    """The impulse is the change of the momentum without the weight. The ball begins exactly at the
    floor, where only a linear law has a stiffness."""
    size, mass, rate = scale
    numbers = {"m": 2.0 * mass, "g": 2.0 * size * rate**2, "b": 0.7 * size}
    numbers |= {"k": 400.0 * mass * rate**2 * size ** (1 - exponent), "d": 0.3 / (size * rate)}
    m = kp.Model("ball", gravity=(0, "-g"), parameters=numbers)
    m.body("ball", mass="m", inertia=mass * size**2)
    m.stop("floor", "ball.y", lower="b", stiffness="k", exponent=exponent, damping="d")
    end, method = 1.5 / rate, kp.DOP853(rtol=1e-12, atol=1e-14 * size)
    start = {"ball.y": numbers["b"], "ball.vy": -2.0 * size * rate}
    case = kp.Case(m, {"set": start}, [kp.Dynamics(t_end=end, method=method)])
    g = kp.gradient(case, ["floor.force.integral", "ball.vy.final"], list(numbers))
    gained = g.measures["ball.vy.final"] - start["ball.vy"] + numbers["g"] * end
    for name, value in numbers.items():
        own = {"m": gained, "g": numbers["m"] * end}.get(name, 0.0)
        expected = numbers["m"] * g["ball.vy.final", name] + own
        error = g["floor.force.integral", name] - expected
        assert abs(error) < 1e-7 * mass * size * rate / value, name

    run = kp.dynamics(m, kp.assemble(m, start), t_end=end, method=method, slopes=["b"])
    touch = 1.6 * numbers["k"] if exponent == 1 else 0.0
    assert run.slope("floor.force", "b")[0] == pytest.approx(touch, rel=1e-12)


def shaft(**fields: Any) -> kp.Case:
    m = kp.Model("shaft", parameters={"a": 2.0, "b": 0.3})
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=1, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.coordinate_driver("motor", "wheel.angle", value="a*sin(3*t) + b")
    return kp.Case(m, None, [kp.Kinematics(**fields)])


def test_kinks_of_a_formula_cost_no_accuracy() -> None:
    """The mean of |a sin 3t + b| over a period, whose corners lie where the sine is -b/a."""
    g = kp.gradient(
        shaft(t_end=2 * np.pi / 3, output_step=0.3), ["abs(wheel.angle).mean"], ["a", "b"]
    )

    def mean(a: Any, b: Any) -> Any:
        corner = np.arcsin(b / a)
        return 2 / np.pi * (a * np.cos(corner) + b * corner)

    agrees(g, "abs(wheel.angle).mean", mean, {"a": 2.0, "b": 0.3}, 1e-8)


@pytest.mark.parametrize("scale", SCALES)
def test_kinks_at_the_ends_of_steps_have_the_slopes_of_their_steps(
    scale: tuple[float, float, float],
) -> None:
    """A ball starts at rest, where magnitudes of its velocity have a kink, and falls."""
    size, mass, rate = scale
    m = kp.Model("ball", gravity=(0, "-g"), parameters={"g": 2.0 * size * rate**2})
    m.body("ball", mass=mass, inertia=mass * size**2)
    start = {"ball.vx": 0.0, "ball.vy": 0.0}
    end, speeds = 1.5 / rate, ["abs(ball.vy)", "max(ball.vy, 0)", "hypot(ball.vx, ball.vy)"]
    case = kp.Case(m, {"set": start}, [kp.Dynamics(t_end=end)])
    g = kp.gradient(case, [f"{speed}.integral" for speed in speeds], [*start, "g"])
    expected = [[0.0, -end, end**2 / 2], [0.0, 0.0, 0.0], [0.0, -end, end**2 / 2]]
    allowed = 1e-9 * np.array([end, end, end**2])
    assert (abs(g.jacobian - expected) < allowed).all(), (g.jacobian, g.remarks)


@pytest.mark.parametrize("scale", SCALES)
def test_a_law_whose_pieces_join_smoothly_within_a_step(scale: tuple[float, float, float]) -> None:
    """The modified trapezoid: its third derivative has corners, which steps of kinematics miss."""
    size, mass, rate = scale
    numbers = {"h": 0.3 * size, "rise": 1.9 / rate}
    m = kp.Model("follower", parameters=numbers)
    m.ground.points(O=(0, 0))
    m.body("follower", mass=mass, inertia=mass * size**2, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "follower.P")
    m.coordinate_driver("cam", "follower.x", value="h*modified_trapezoid(t/rise)")
    end = 2.7 / rate
    run = kp.Kinematics(t_end=end, output_step=end / 25)
    measures = ["follower.ax.integral", "follower.ax.rms", "follower.x.t_max"]
    g = kp.gradient(kp.Case(m, analyses=[run]), measures, list(numbers))
    peak = 8 * np.pi / (2 + np.pi)

    def rms(h: Any, rise: Any) -> Any:
        return h / rise**2 * peak * np.sqrt(0.75 * rise / end)

    largest = numbers["h"] / numbers["rise"]
    assert abs(g.measures[measures[0]]) < 1e-11 * largest
    assert abs(g[measures[0], "rise"]) < 1e-8 * largest / numbers["rise"]
    assert g.measures[measures[1]] == pytest.approx(rms(**numbers), rel=1e-11)
    agrees(g, measures[1], rms, numbers, 1e-8)
    # the dwell has no first time of its largest value
    assert "is flat near" in g.remarks[measures[2], "rise"]


def test_a_jump_of_a_formula_has_a_remark() -> None:
    texts = ["if(wheel.angle > 1, 1, 0).mean", "wheel.angle.mean"]
    g = kp.gradient(shaft(t_end=2, output_step=0.1), texts, ["a", "b"])
    assert np.isnan(g.jacobian[0]).all() and np.isfinite(g.jacobian[1]).all()
    share = (np.pi - 2 * np.arcsin(0.35)) / 3 / 2
    assert g.measures[texts[0]] == pytest.approx(share, rel=1e-9)
    assert g.remarks[texts[0], "a"].startswith("the value jumps at t = 0.119")


@pytest.mark.parametrize("ends", [(0.5, 2.0), (2.0, 0.5)])
def test_integrals_over_a_quantity_in_both_directions(ends: tuple[float, float]) -> None:
    m = kp.Model("shaft", parameters={"r": 2.0})
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=1, points={"O": (0, 0), "P": ("r", 0)})
    m.revolute("O", "ground.O", "wheel.O")
    run = kp.Kinematics(over="wheel.angle", range=ends, n=7)
    case = kp.Case(m, {"set": {"wheel.angle": ends[0]}}, [run])
    texts = [f"wheel.P.x.{of}" for of in ("integral", "mean", "rms", "final")]
    g = kp.gradient(case, texts, ["r"])
    first, last = ends
    shares = [np.sin(last) - np.sin(first), 0.0, 0.0, np.cos(last)]
    shares[1] = shares[0] / (last - first)
    square = (last - first) / 2 + (np.sin(2 * last) - np.sin(2 * first)) / 4
    shares[2] = np.sqrt(square / (last - first))
    for text, share in zip(texts, shares, strict=True):
        assert g.measures[text] == pytest.approx(2 * share, rel=1e-10), text
        assert g[text, "r"] == pytest.approx(share, rel=1e-10), text
    assert g.units[texts[0]] == "m*rad"
