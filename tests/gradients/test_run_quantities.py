"""Slopes of energies of a run, also of one element, and of frequencies, against closed forms."""

from typing import Any

import kempe as kp
import numpy as np
import pytest
from gradients.test_events import EXACT, SCALES, block
from gradients.test_truth import agrees, pendulum


@pytest.mark.parametrize("scale", SCALES)
def test_a_force_that_switches_dissipates(scale: tuple[float, float, float]) -> None:
    """The power of a friction force jumps at a time that moves."""
    size, mass, rate = scale
    numbers = {
        "m": mass,
        "R": mass * rate**2 * size,
        "R2": 3.0 * mass * rate**2 * size,
        "x1": 0.5 * size,
    }
    m = block(numbers)
    m.friction("rubs", "guide", kinetic=1.0, load="if(block.x > x1, R2, R)")
    m.friction("also", "guide", kinetic=1.0, load=f"{0.1 * mass * rate**2 * size}")
    start, end = {"block.vx": 2.0 * size * rate}, 0.6 / rate
    run = kp.Dynamics(t_end=end, output_step=end / 7, method=EXACT)
    case = kp.Case(m, {"set": {"block.x": 0.0, **start}}, [run])
    measures = ["rubs.dissipated.final", "rubs.dissipated.max", "rubs.dissipated.peak"]
    g = kp.gradient(case, measures, [*numbers, *start])
    drag = 0.1 * mass * rate**2 * size

    def loss(**of: Any) -> Any:
        first, then = (of["R"] + drag) / of["m"], (of["R2"] + drag) / of["m"]
        v1 = np.sqrt(of["block.vx"] ** 2 - 2 * first * of["x1"])
        rest = end - (of["block.vx"] - v1) / first
        return of["R"] * of["x1"] + of["R2"] * (v1 * rest - then * rest**2 / 2)

    for measure in measures:
        agrees(g, measure, loss, {**numbers, **start}, 1e-9)
    begin = kp.assemble(m, set={"block.x": 0.0, **start})
    sol = kp.dynamics(m, begin, t_end=end, output_step=end / 7, method=EXACT, slopes=["x1", "R2"])
    along = sol.slope("rubs.dissipated", "x1")
    assert along[0] == 0.0 and along[-1] == pytest.approx(g["rubs.dissipated.final", "x1"])


@pytest.mark.parametrize("scale", SCALES)
def test_a_run_ends_where_an_element_has_dissipated_enough(
    scale: tuple[float, float, float],
) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "c": 0.7 * mass * rate, "E": 0.3 * mass * (size * rate) ** 2}
    m = block(numbers)
    m.spring_damper("drag", "ground.O", "block.P", damping="c", stiffness=0.0, free_length=0.0)
    start = {"block.x": size, "block.vx": size * rate}
    run = kp.Dynamics(t_end=2 / rate, stop="drag.dissipated > E", method=EXACT)
    end, all_numbers = 2.0 / rate, {**numbers, **start}
    then = kp.Dynamics(t_end=end, method=EXACT, name="then")
    case = kp.Case(m, {"set": start}, [run, then])
    measures = ["block.x.final", "drag.dissipated.final"]
    g = kp.gradient(case, measures, list(all_numbers), analysis="dynamics")

    def place(**of: Any) -> Any:
        left = np.sqrt(of["block.vx"] ** 2 - 2 * of["E"] / of["m"])
        return of["block.x"] + of["m"] * (of["block.vx"] - left) / of["c"]

    agrees(g, "block.x.final", place, all_numbers, 1e-8)
    agrees(g, "drag.dissipated.final", lambda **of: of["E"], all_numbers, 1e-8)

    def rest(**of: Any) -> Any:
        """The energy that is dissipated after this time, which moves, up to a fixed time."""
        last = of["block.vx"] * np.exp(-of["c"] * end / of["m"])
        return of["m"] * (of["block.vx"] ** 2 - last**2) / 2 - of["E"]

    g = kp.gradient(case, measures, list(all_numbers), analysis="then")
    agrees(g, "drag.dissipated.final", rest, all_numbers, 1e-8)


@pytest.mark.parametrize("scale", SCALES)
def test_frequency_and_largest_energies_of_an_oscillator(
    scale: tuple[float, float, float],
) -> None:
    size, mass, rate = scale
    numbers = {"m": mass, "k": 30.0 * mass * rate**2, "c": 0.4 * mass * rate}
    m = block(numbers)
    m.generalized_force("spring", "block.x", value="-k * block.x - c * block.vx")
    start = {"block.x": size}
    run = kp.Dynamics(t_end=5 / rate, output_step=0.02 / rate, method=EXACT)
    measures = ["block.x.frequency", "block.ax.frequency", "energy.kinetic.max"]
    g = kp.gradient(
        kp.Case(m, {"set": {**start, "block.vx": 0.0}}, [run]), measures, [*numbers, *start]
    )

    def turns(**of: Any) -> Any:
        return np.sqrt(of["k"] / of["m"] - (of["c"] / of["m"] / 2) ** 2)

    def kinetic(**of: Any) -> Any:
        w, decay = turns(**of), of["c"] / of["m"] / 2
        t = np.arange(251) * 0.02 / rate
        v = -of["block.x"] * of["k"] / of["m"] / w * np.exp(-decay * t) * np.sin(w * t)
        all_of = of["m"] * v**2 / 2
        return all_of[np.argmax(all_of.real)]

    all_numbers = {**numbers, **start}
    agrees(g, "block.x.frequency", lambda **of: turns(**of) / (2 * np.pi), all_numbers, 1e-8)
    agrees(g, "block.ax.frequency", lambda **of: turns(**of) / (2 * np.pi), all_numbers, 1e-8)
    agrees(g, "energy.kinetic.max", kinetic, all_numbers, 1e-8)


def test_the_frequency_of_a_large_swing_is_that_of_differences() -> None:
    """The fit leaves a remainder, because the swing is not a sinusoid."""
    case, numbers = pendulum(1.0, 1.0, 1.0)
    case = case.with_analysis("swing", t_end=17.0, output_step=0.05)
    g = kp.gradient(case, ["rod.angle.frequency"], ["d", "g", "rod.angle"])
    for name in g.variables:
        far = [numbers[name] * (1 + h) for h in (2e-3, -2e-3, 1e-3, -1e-3)]
        found = kp.sweep(case, {name: far}, ["rod.angle.frequency"])["rod.angle.frequency"]
        wide, near = (
            (found[0] - found[1]) / (far[0] - far[1]),
            (found[2] - found[3]) / (far[2] - far[3]),
        )
        assert g["rod.angle.frequency", name] == pytest.approx((4 * near - wide) / 3, rel=1e-7)


def test_what_has_no_derivative_says_why() -> None:
    m = block({"m": 1.0, "k": 4.0})
    m.generalized_force("spring", "block.x", value="-k * block.x")
    m.spring_damper("drag", "ground.O", "block.P", damping=0.3, stiffness=0.0, free_length=0.0)
    m.stop("wall", "block.x", lower=0.2, restitution=0.9)
    start = {"set": {"block.x": 1.0, "block.vx": 0.0}}
    case = kp.Case(m, start, [kp.Dynamics(t_end=5, output_step=0.1, method=EXACT)])
    told = {
        "energy.balance.final": "a balance is an error",
        "energy.kinetic.t_max": "time of an output",
        "energy.kinetic.settling": "time of an output",
        "drag.dissipated.mean": "sum over the outputs",
        "block.x.frequency": "move with events",
        "block.y.frequency": "there is no oscillation",
    }
    g = kp.gradient(case, list(told), ["k"])
    assert np.isnan(g.jacobian).all()
    for measure, text in told.items():
        assert text in g.remarks[measure, "k"], measure
    sol = case.run()["dynamics"]
    assert g.measures["energy.kinetic.t_max"] == sol.t[np.argmax(sol["energy.kinetic"])]
