"""Slopes of limits against closed forms."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_truth import SCALES, agrees

Numbers = dict[str, float]


def four_bar(numbers: Numbers, over: str, start: float, guess: float = 1.2) -> kp.Case:
    """A four-bar with a crank a, coupler b, rocker c and base d."""
    m = kp.Model("four-bar", gravity=(0, 0), parameters=numbers)
    m.ground.points(A=(0, 0), D=("d", 0))
    for name, length, ends in (("crank", "a", "AB"), ("coupler", "b", "BC"), ("rocker", "c", "DC")):
        m.bar(name, mass=1, length=length, ends=tuple(ends))
    joints = ("A", "ground", "crank"), ("B", "crank", "coupler"), ("C", "coupler", "rocker")
    for name, i, j in joints:
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    m.revolute("D", "ground.D", "rocker.D")
    first = {"set": {"crank.angle": start}, "guess": {"rocker.angle": guess}}
    return kp.Case(m, first, [kp.Limits(over=over)])


def sized(lengths: dict[str, float], size: float) -> Numbers:
    return {name: x * size for name, x in lengths.items()}


@pytest.mark.parametrize("scale", SCALES)
def test_limits_of_a_rocker(scale: tuple[float, float, float]) -> None:
    """At its limits, the crank and the coupler are in line: the cosine rule."""
    numbers = sized({"a": 0.3, "b": 0.9, "c": 0.6, "d": 1.0}, scale[0])
    case = four_bar(numbers, "rocker.angle", 1.1)
    g = kp.gradient(case, ["lower", "upper", "span", "start"], [*numbers, "crank.angle"])

    def angle(side: Any, c: Any, d: Any) -> Any:
        return np.pi - np.arccos((c**2 + d**2 - side**2) / (2 * c * d))

    def upper(a: Any, b: Any, c: Any, d: Any) -> Any:
        return angle(b - a, c, d)

    def lower(a: Any, b: Any, c: Any, d: Any) -> Any:
        return angle(b + a, c, d)

    agrees(g, "upper", upper, numbers, 1e-10)
    agrees(g, "lower", lower, numbers, 1e-10)
    agrees(g, "span", lambda **of: upper(**of) - lower(**of), numbers, 1e-10)
    assert g["upper", "crank.angle"] == g["lower", "crank.angle"] == 0.0
    assert g["start", "crank.angle"] != 0.0


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("start", [0.6, -0.6])
def test_limits_of_a_crank_that_does_not_turn(
    scale: tuple[float, float, float], start: float
) -> None:
    """At its limits, the coupler and the rocker are in line."""
    numbers = sized({"a": 0.5, "b": 0.55, "c": 0.6, "d": 1.0}, scale[0])
    g = kp.gradient(four_bar(numbers, "crank.angle", start), ["lower", "upper"], list(numbers))

    def reach(a: Any, b: Any, c: Any, d: Any) -> Any:
        return np.arccos((a**2 + d**2 - (b + c) ** 2) / (2 * a * d))

    agrees(g, "upper", reach, numbers, 1e-10)
    agrees(g, "lower", lambda **of: -reach(**of), numbers, 1e-10)


def rocker(a: Any, b: Any, c: Any, d: Any, start: Any, sign: float) -> Any:
    """The angle of the rocker on one of its two branches, by Freudenstein's equation."""
    ax, ay = a * np.cos(start), a * np.sin(start)
    k1, k2, k3 = 2 * c * (ax - d), 2 * c * ay, b**2 - c**2 - (ax - d) ** 2 - ay**2
    return 2 * np.arctan((k2 + sign * np.sqrt(k1**2 + k2**2 - k3**2)) / (k1 - k3))


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_start_on_each_branch(scale: tuple[float, float, float], sign: float) -> None:
    numbers = sized({"a": 0.3, "b": 0.9, "c": 0.6, "d": 1.0}, scale[0])
    case = four_bar(numbers, "rocker.angle", 1.1, -sign)
    g = kp.gradient(case, ["start"], [*numbers, "crank.angle"])
    known = {**numbers, "start": 1.1}
    for name in numbers:
        step = 1e-30 * numbers[name]
        true = np.imag(rocker(**{**known, name: known[name] + 1j * step}, sign=sign)) / step
        assert g["start", name] == pytest.approx(true, rel=1e-10)
    true = np.imag(rocker(**{**known, "start": 1.1 + 1e-30j}, sign=sign)) / 1e-30
    assert g["start", "crank.angle"] == pytest.approx(true, rel=1e-10)


def slider_crank(numbers: Numbers, over: str, **stop: Any) -> kp.Case:
    m = kp.Model("slider-crank", gravity=(0, 0), parameters=numbers)
    m.ground.points(O=(0, 0), G=(0, "h"))
    m.body("crank", mass=1, inertia=1, points={"O": (0, 0), "A": ("r", 0)})
    m.body("rod", mass=1, inertia=1, points={"A": (0, 0), "B": ("l", 0)})
    m.body("slider", mass=1, inertia=1, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("guide", "ground.G", "slider.B")
    if stop:
        m.stop("block", "slider.x", restitution=0.5, **stop)
    guess = {"slider.x": numbers["l"] + numbers["r"]}
    return kp.Case(m, {"set": {"crank.angle": 0.5}, "guess": guess}, [kp.Limits(over=over)])


@pytest.mark.parametrize("scale", SCALES)
def test_limits_of_a_slider(scale: tuple[float, float, float]) -> None:
    numbers = sized({"r": 0.2, "l": 0.5, "h": 0.1}, scale[0])
    g = kp.gradient(slider_crank(numbers, "slider.x"), ["lower", "upper"], list(numbers))

    def reach(sign: float, **of: Any) -> Any:
        return np.sqrt((of["l"] + sign * of["r"]) ** 2 - of["h"] ** 2)

    agrees(g, "upper", lambda **of: reach(1.0, **of), numbers, 1e-10)
    agrees(g, "lower", lambda **of: reach(-1.0, **of), numbers, 1e-10)


@pytest.mark.parametrize("scale", SCALES)
def test_a_stop_that_ends_the_motion(scale: tuple[float, float, float]) -> None:
    """The crank turns until the slider reaches the stop at s."""
    numbers = sized({"r": 0.2, "l": 0.5, "h": 1e-9, "s": 0.55}, scale[0])
    case = slider_crank(numbers, "crank.angle", lower="s")
    names = {name: x for name, x in numbers.items() if name != "h"}
    g = kp.gradient(case, ["lower", "upper"], list(names))

    def angle(r: Any, l: Any, s: Any) -> Any:  # noqa: E741
        return np.arccos((r**2 + s**2 - l**2) / (2 * r * s))

    agrees(g, "upper", angle, names, 1e-8)
    agrees(g, "lower", lambda **of: -angle(**of), names, 1e-8)


def test_a_parameter_with_a_formula_counts() -> None:
    numbers: dict[str, Any] = {"a": 0.3, "b": "3*a", "c": 0.6, "d": 1.0}
    g = kp.gradient(four_bar(numbers, "rocker.angle", 1.1), ["upper"], ["a"])
    angle = np.pi - np.arccos((0.36 + 1 - 0.36) / 1.2)
    # d(b - a)/da = 2, and cos(π - θ) = (c² + d² - (b - a)²) / (2 c d)
    assert g.measures["upper"] == pytest.approx(angle)
    assert g["upper", "a"] == pytest.approx(-2 * 0.6 / (0.6 * np.sin(angle)), rel=1e-10)


@pytest.mark.parametrize("apart", [0.0, 1e-15, 1e-13, 1e-11, 1e-9])
def test_limits_that_meet(apart: float) -> None:
    """With a + d = b + c, the limits of the crank meet at 180°."""
    numbers = {"a": 0.5, "b": 0.7, "c": 0.8 - apart, "d": 1.0}
    g = kp.gradient(four_bar(numbers, "crank.angle", 0.6), ["lower", "upper"], list(numbers))
    for k, measure in enumerate(g.measures):
        if np.isfinite(g.jacobian[k]).all():
            true = (numbers["b"] + numbers["c"]) / (0.5 * np.sin(g.measures["upper"]))
            assert abs(g[measure, "b"]) == pytest.approx(true, rel=1e-4)
        else:
            assert all(g.remarks[measure, name] for name in numbers)


def test_no_limit_and_counts_have_remarks() -> None:
    numbers = {"a": 0.3, "b": 0.9, "c": 0.6, "d": 1.0}
    case = four_bar(numbers, "crank.angle", 1.1)
    g = kp.gradient(case, ["upper", "turns", "turns_fully"], ["a"])
    assert g.measures["upper"] == np.inf and np.isnan(g.jacobian).all()
    assert g.remarks["upper", "a"] == "there is no limit on this side"
    for analysis, measure in (
        (kp.Configurations(), "count"),
        (kp.Configurations(), "complete"),
        (kp.Mobility(), "degrees_of_freedom"),
    ):
        found = kp.gradient(
            kp.Case(case.model, {"set": {"crank.angle": 1.1}}, [analysis]), [measure], ["a"]
        )
        assert np.isnan(found.jacobian).all()
        assert "does not change gradually" in found.remarks[measure, "a"]
