"""Slopes of motions that change: hits, stick and slip, releases, conditions, laws that switch."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_truth import agrees

EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
#: Sizes in m, masses in kg and rates in 1/s.
SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 30.0), (1e2, 1e-3, 0.1)]


def block(numbers: dict[str, float], **more: Any) -> kp.Model:
    """A mass m that slides along x."""
    m = kp.Model("block", gravity=(0, 0), parameters=numbers, **more)
    m.ground.points(O=(0, 0))
    m.body("block", mass="m", inertia=1.0, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "block.P")
    return m


@pytest.mark.parametrize("scale", SCALES)
def test_an_oscillator_with_friction_that_comes_to_rest(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "k": mass * rate**2, "R": mass * rate**2 * size}
    m = block(numbers)
    m.generalized_force("spring", "block.x", value="-k * block.x")
    m.friction("rubs", "guide", kinetic=1.0, load="R")
    start = {"block.x": 12.0 * size, "block.vx": 6.0 * size * rate}
    case = kp.Case(m, {"set": start}, [kp.Dynamics(t_end=30.0 / rate, method=EXACT)])
    g = kp.gradient(case, ["block.x.final", "block.vx.final"], [*numbers, *start])

    def final(**of: Any) -> Any:
        # the swings are about ±R/k; each is shorter than the one before by 2 R/k
        rest = of["R"] / of["k"]
        swing = (of["block.x"] + rest) ** 2 + of["m"] * of["block.vx"] ** 2 / of["k"]
        return 15 * rest - np.sqrt(swing)

    agrees(g, "block.x.final", final, {**numbers, **start}, 1e-9)
    if scale == SCALES[0]:
        assert g["block.x.final", "block.x"] == pytest.approx(-0.907959385, abs=1e-9)
        assert g["block.x.final", "block.vx"] == pytest.approx(-0.419058177, abs=1e-9)


def ball(numbers: dict[str, float], **law: Any) -> kp.Model:
    """A ball above a floor."""
    m = kp.Model("ball", gravity=(0, "-g"), parameters=numbers)
    m.body("ball", mass="m", inertia=1.0)
    m.stop("floor", "ball.y", lower=0.0, **law)
    return m


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("hits", [1, 2, 5])
def test_the_height_of_a_ball_after_hits(hits: int, scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "g": 9.0 * size * rate**2, "e": 0.8}
    start = {"ball.y": 2.0 * size, "ball.vy": 0.3 * size * rate}
    top = kp.Event("ball.vy", direction="falling", stop=hits + 1)
    run = kp.Dynamics(t_end=20 / rate, method=EXACT, events={"top": top})
    case = kp.Case(ball(numbers, restitution="e"), {"set": start}, [run])
    measures = ["ball.y.final", "ball.vy.max", "ball.vy.t_min", "ball.vy.t_max"]
    g = kp.gradient(case, measures, [*numbers, *start])
    every = {**numbers, **start}

    def drop(of: dict[str, Any]) -> Any:
        return of["ball.y"] + of["ball.vy"] ** 2 / (2 * of["g"])

    def first(**of: Any) -> Any:
        return (of["ball.vy"] + np.sqrt(2 * of["g"] * drop(of))) / of["g"]

    agrees(g, "ball.y.final", lambda **of: drop(of) * of["e"] ** (2 * hits), every, 1e-9)
    agrees(g, "ball.vy.t_min", first, every, 1e-9)
    agrees(g, "ball.vy.t_max", first, every, 1e-9)
    fastest = lambda **of: of["e"] * np.sqrt(2 * of["g"] * drop(of))  # noqa: E731
    agrees(g, "ball.vy.max", fastest, every, 1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_ball_on_a_spring(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "g": 9.0 * size * rate**2, "k": 400.0 * mass * rate**2}
    start = {"ball.y": 2.0 * size}
    run = kp.Dynamics(t_end=1.2 / rate, method=EXACT)
    case = kp.Case(ball(numbers, stiffness="k"), {"set": start}, [run])
    measures = ["floor.force.max", "floor.force.t_max", "ball.y.final", "ball.vy.final"]
    g = kp.gradient(case, measures, [*numbers, *start])
    every = {**numbers, **start}

    def parts(of: dict[str, Any]) -> Any:
        speed, w = np.sqrt(2 * of["g"] * of["ball.y"]), np.sqrt(of["k"] / of["m"])
        deep = of["m"] * of["g"] / of["k"]
        # the depth is deep - swing cos(w t + phase)
        phase = np.arctan(speed / w / deep)
        swing = np.sqrt(deep**2 + (speed / w) ** 2)
        return speed, w, deep, swing, phase

    def force(**of: Any) -> Any:
        _, _, deep, swing, _ = parts(of)
        return of["k"] * (deep + swing)

    def deepest(**of: Any) -> Any:
        speed, w, _, _, phase = parts(of)
        return speed / of["g"] + (np.pi - phase) / w

    def flight(of: dict[str, Any]) -> Any:
        speed, w, _, _, phase = parts(of)
        return speed, 1.2 / rate - speed / of["g"] - 2 * (np.pi - phase) / w

    def height(**of: Any) -> Any:
        speed, time = flight(of)
        return speed * time - of["g"] * time**2 / 2

    def speed(**of: Any) -> Any:
        speed, time = flight(of)
        return speed - of["g"] * time

    agrees(g, "floor.force.max", force, every, 1e-9)
    agrees(g, "floor.force.t_max", deepest, every, 1e-7)
    agrees(g, "ball.y.final", height, every, 1e-8)
    agrees(g, "ball.vy.final", speed, every, 1e-8)


@pytest.mark.parametrize("scale", SCALES)
def test_a_force_that_is_switched_on_and_off(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "F": mass * size * rate**2, "a": 0.4 / rate, "b": 0.9 / rate}
    numbers["x1"] = 0.7 * size
    m = block(numbers)
    m.generalized_force("push", "block.x", value="if(t > a, F, 0) * if(t < b, 1, 0)")
    # beyond x1 a constant force brakes
    m.generalized_force("brake", "block.x", value="if(block.x > x1, -F / 3, 0)")
    case = kp.Case(m, {"set": {"block.x": 0.0}}, [kp.Dynamics(t_end=2.5 / rate, method=EXACT)])
    g = kp.gradient(case, ["block.x.final", "block.vx.max", "block.vx.final"], list(numbers))

    def speed(of: dict[str, Any]) -> Any:
        return of["F"] / of["m"] * (of["b"] - of["a"])

    def braked(of: dict[str, Any]) -> Any:
        # x1 is passed after the push
        pushed = of["F"] / of["m"] * (of["b"] - of["a"]) ** 2 / 2
        return 2.5 / rate - of["b"] - (of["x1"] - pushed) / speed(of)

    def final(**of: Any) -> Any:
        time = braked(of)
        return of["x1"] + speed(of) * time - of["F"] / 3 / of["m"] * time**2 / 2

    agrees(g, "block.vx.max", lambda **of: speed(of), numbers, 1e-10)
    agrees(g, "block.x.final", final, numbers, 1e-9)
    slowed = lambda **of: speed(of) - of["F"] / 3 / of["m"] * braked(of)  # noqa: E731
    agrees(g, "block.vx.final", slowed, numbers, 1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_driver_that_is_released_at_a_position(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "a": 0.8 * size * rate**2, "x1": 0.5 * size, "k": 3.0 * mass * rate**2}
    m = block(numbers)
    m.generalized_force("spring", "block.x", value="-k * block.x")
    m.coordinate_driver("push", "block.x", value="a * t^2 / 2", release="block.x > x1")
    case = kp.Case(m, analyses=[kp.Dynamics(t_end=3 / rate, method=EXACT)])
    g = kp.gradient(case, ["block.x.final", "push.effort.max"], list(numbers))

    def final(**of: Any) -> Any:
        begin = np.sqrt(2 * of["x1"] / of["a"])
        w, time = np.sqrt(of["k"] / of["m"]), 3 / rate - begin
        return of["x1"] * np.cos(w * time) + of["a"] * begin / w * np.sin(w * time)

    agrees(g, "block.x.final", final, numbers, 1e-9)
    effort = lambda **of: of["m"] * of["a"] + of["k"] * of["x1"]  # noqa: E731
    agrees(g, "push.effort.max", effort, numbers, 1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_ball_that_a_driven_table_hits(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "g": 9.0 * size * rate**2, "e": 0.6, "u": 0.7 * size * rate}
    numbers["h"] = 1.5 * size
    m = kp.Model("table", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0))
    floor = {"line": ((3 * size, 0), (-3 * size, 0))}
    m.body("table", mass=mass, inertia=1.0, points={"P": (0, 0)}, curves={"top": floor})
    m.body("ball", mass="m", inertia=1.0, points={"C": (0, 0)})
    m.translational("guide", "ground.O", "table.P", axes=(np.pi / 2, np.pi / 2))
    m.translational("slide", "ground.O", "ball.C", axes=(np.pi / 2, np.pi / 2))
    m.coordinate_driver("lift", "table.y", value="u * t")
    m.contact("touch", "ball.C", "table.top", restitution="e")
    run = kp.Dynamics(t_end=1.1 / rate, method=EXACT)
    case = kp.Case(m, {"set": {"ball.y": "h", "ball.vy": 0.0}}, [run])
    measures = ["ball.y.final", "energy.dissipated.final", "energy.work.final"]
    g = kp.gradient(case, measures, list(numbers))

    def hit(of: dict[str, Any]) -> Any:
        """The time of the impact, and the speed of approach."""
        time = (np.sqrt(of["u"] ** 2 + 2 * of["g"] * of["h"]) - of["u"]) / of["g"]
        return time, of["g"] * time + of["u"]

    def final(**of: Any) -> Any:
        time, speed = hit(of)
        left = 1.1 / rate - time
        return of["u"] * time + (of["u"] + of["e"] * speed) * left - of["g"] * left**2 / 2

    def lost(**of: Any) -> Any:
        return of["m"] * hit(of)[1] ** 2 * (1 - of["e"] ** 2) / 2

    agrees(g, "ball.y.final", final, numbers, 1e-9)
    agrees(g, "energy.dissipated.final", lost, numbers, 1e-9)

    def lifted(**of: Any) -> Any:
        push = of["m"] * (1 + of["e"]) * hit(of)[1]
        return mass * of["g"] * of["u"] * 1.1 / rate + push * of["u"]

    agrees(g, "energy.work.final", lifted, numbers, 1e-9)


@pytest.mark.parametrize("scale", SCALES)
def test_a_run_that_continues_with_another_spring(scale: tuple[float, float, float]) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "F": mass * size * rate**2, "x1": 0.6 * size, "k": 0.0}
    numbers["k2"] = 5.0 * mass * rate**2
    m = block(numbers)
    m.generalized_force("spring", "block.x", value="F - k * block.x")
    push = kp.Dynamics(t_end=3 / rate, method=EXACT, stop="block.x > x1", name="push")
    swing = kp.Dynamics(t_end=4 / rate, method=EXACT, parameters={"k": "k2"}, name="swing")
    case = kp.Case(m, {"set": {"block.x": 0.0}}, [push, swing])
    variables = ["m", "F", "x1", "k2"]
    g = kp.gradient(case, ["block.x.final", "block.vx.final"], variables)
    of_push = kp.gradient(case, ["block.vx.final"], variables, analysis="push")

    def swung(of: dict[str, Any]) -> Any:
        begin = np.sqrt(2 * of["x1"] * of["m"] / of["F"])
        w, rest = np.sqrt(of["k2"] / of["m"]), of["F"] / of["k2"]
        speed, time = of["F"] / of["m"] * begin, 4 / rate - begin
        return speed, w, rest, time

    def final(**of: Any) -> Any:
        speed, w, rest, time = swung(of)
        return rest + (of["x1"] - rest) * np.cos(w * time) + speed / w * np.sin(w * time)

    every = {name: numbers[name] for name in variables}
    agrees(of_push, "block.vx.final", lambda **of: swung(of)[0], every, 1e-9)
    agrees(g, "block.x.final", final, every, 1e-9)
