"""Python functions as laws of forces."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest

METHODS = [
    kp.RK45(1e-10, 1e-12),
    kp.DOP853(1e-10, 1e-12),
    kp.RK4(step=1e-3),
    kp.Radau(1e-10, 1e-12),
    kp.GeneralizedAlpha(step=1e-3),
    kp.Auto(),
]


def pendulum(torque: Any, **parameters: float) -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -9.81), parameters=parameters)
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    m.torque("motor", "rod", torque=torque)
    return m


def feedback(t: float, state: kp.State) -> float:
    return -3 * state["rod.omega"] - 5 * state["rod.angle"] + 2 * math.sin(t)


FORMULA = "-3*rod.omega - 5*rod.angle + 2*sin(t)"


@pytest.mark.parametrize("method", METHODS, ids=lambda method: type(method).__name__)
def test_a_function_is_the_formula(method: Any) -> None:
    solutions = []
    for law in (feedback, FORMULA):
        m = pendulum(law)
        start = kp.assemble(m, set={"rod.angle": 0.3})
        solutions.append(kp.dynamics(m, start, t_end=1, method=method, output_step=0.02))
    computed, written = solutions
    assert np.abs(computed.q - written.q).max() < 1e-10
    for name in ("rod.alpha", "motor.torque", "motor.power", "A.fx", "energy.work"):
        assert computed[name] == pytest.approx(written[name], abs=1e-9), name
    assert computed(0.37)["motor.torque"] == pytest.approx(written(0.37)["motor.torque"], abs=1e-9)


def slide() -> kp.Model:
    m = kp.Model("slide", gravity=(0, -9.81), parameters={"k": 1})
    m.ground.points(O=(0, 0))
    m.body("cart", mass=2, inertia=0.3, points={"S": (0, 0), "P": (0.2, 0.5)})
    m.body("rotor", mass=1, inertia=0.2, points={"O": (0, 0), "Q": (0.3, 0)})
    m.translational("slide", "ground.O", "cart.S")
    m.revolute("pin", "ground.O", "rotor.O")
    return m


#: Each law of a force: the call with a law, its formula, and the same in Python.
LAWS: dict[str, tuple[Callable[[kp.Model, Any], Any], str, Callable[[float, kp.State], float]]] = {
    "force": (
        lambda m, f: m.force("F", "cart.P", force=("sin(t)", f), frame="j"),
        "-4*cart.vx",
        lambda _, s: -4 * s["cart.vx"],
    ),
    "actuator": (
        lambda m, f: m.actuator("F", "ground.O", "cart.P", force=f),
        "-40*(length - 0.6) - 5*rate",
        lambda _, s: -40 * (s["F.length"] - 0.6) - 5 * s["F.rate"],
    ),
    "voltage": (
        lambda m, f: m.motor(
            "F", "rotor", voltage=f, resistance=2, inductance=0.1, torque_constant=0.3
        ),
        "6 - 2*F.current*t",
        lambda t, s: 6 - 2 * s["F.current"] * t,
    ),
    "command": (
        lambda m, f: m.motor("F", "rotor", stall_torque=3, free_speed=40, command=f),
        "0.5*cos(rotor.angle)",
        lambda _, s: 0.5 * math.cos(s["rotor.angle"]),
    ),
    "generalized": (
        lambda m, f: m.generalized_force("F", "slide.displacement", value=f),
        "3*cos(rotor.angle) - cart.x",
        lambda _, s: 3 * math.cos(s["rotor.angle"]) - s["cart.x"],
    ),
    "stiffness": (
        lambda m, f: m.spring_damper("F", "rotor.Q", "cart.P", stiffness=f, free_length=0.4),
        "30 + 10*F.length",
        lambda _, s: 30 + 10 * s["F.length"],
    ),
}


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("method", [kp.DOP853(1e-10, 1e-12), kp.Radau(1e-10, 1e-12)])
def test_every_law_of_a_force(name: str, method: Any) -> None:
    add, formula, function = LAWS[name]
    solutions = []
    for law in (function, formula):
        m = slide()
        add(m, law)
        start = kp.assemble(m, set={"cart.x": 0.5, "rotor.angle": 0.4, "rotor.omega": 2})
        solutions.append(kp.dynamics(m, start, t_end=0.5, method=method, output_step=0.05))
    computed, written = solutions
    assert np.abs(computed.q - written.q).max() < 1e-8
    assert np.abs(computed.q[-1] - computed.q[0]).max() > 0.05
    assert computed.a == pytest.approx(written.a, abs=1e-6)
    assert computed.energy.dissipated == pytest.approx(written.energy.dissipated, abs=1e-8)


def test_functions_are_laws_of_forces_only() -> None:
    m = slide()
    needed = "derivatives of the laws of joints and drivers are needed"
    with pytest.raises(kp.ModelError, match=rf"drivers\.turn\.value: .*{needed}"):
        m.coordinate_driver("turn", "rotor.angle", value=lambda t, _: t)  # type: ignore[arg-type]
    with pytest.raises(kp.ModelError, match=rf"joints\.rod\.length: .*{needed}"):
        m.distance("rod", "cart.P", "rotor.Q", length=kp.Sampled(feedback, 0.1))  # type: ignore[arg-type]
    with pytest.raises(kp.ModelError, match=r"bodies\.b\.mass: a Python function is not allowed"):
        m.body("b", mass=lambda: 1, inertia=1)  # type: ignore[arg-type]


def test_what_is_saved_names_the_functions(tmp_path: Path) -> None:
    m = pendulum(feedback)
    m.force("F", "rod.B", force=(0, kp.Sampled(feedback, 0.1)))
    start = kp.assemble(m)
    solution = kp.dynamics(m, start, t_end=0.1)
    case = kp.Case(m, analyses=[kp.Dynamics(t_end=0.1)])
    attempts: list[Callable[[], Any]] = [
        m.tree,
        m.json,
        case.tree,
        lambda: case.save(tmp_path / "case.toml"),
        lambda: solution.save(tmp_path / "run.npz"),
        lambda: pickle.dumps(m),
        lambda: pickle.dumps(start),
        lambda: pickle.dumps(solution),
    ]
    for attempt in attempts:
        with pytest.raises(kp.ModelError, match="cannot be saved") as caught:
            attempt()
        assert "forces.motor.torque" in str(caught.value)
    with pytest.raises(kp.ModelError, match=r"forces\.motor\.torque, forces\.F\.force\[1\] are"):
        m.tree()
    assert not list(tmp_path.iterdir())


def test_a_model_with_functions_can_be_shown_copied_and_run_in_a_case() -> None:
    m = pendulum(feedback, c=1.0)
    assert "motor" in repr(m) and "points A" in repr(m.ground)
    assert "Python function 'feedback'" in repr(pendulum(0).torque("other", "rod", torque=feedback))
    assert kp.equations(m)[0].name == "A"
    start = kp.assemble(m, set={"rod.angle": 0.3})
    assert start.matrices().Q[-1] == pytest.approx(feedback(0, start))
    other = copy.deepcopy(m.with_parameters({"c": 2}))
    assert other.parameters["c"] == 2
    once = kp.dynamics(other, kp.assemble(other, set={"rod.angle": 0.3}), t_end=0.2)
    case = kp.Case(m, {"set": {"rod.angle": 0.3}}, [kp.Dynamics(t_end=0.2)])
    assert case.run()[0].q[-1] == pytest.approx(once.q[-1], abs=1e-12)
    again = kp.dynamics(m, start, t_end=0.2, redundancy="allow")
    assert again.q[-1] == pytest.approx(once.q[-1], abs=1e-8)


def test_an_exception_stops_the_run_and_keeps_the_solution() -> None:
    def breaks(t: float, _: kp.State) -> float:
        if t > 0.5:
            raise LookupError("no more data")
        return 1.0

    m = pendulum(breaks)
    for method in METHODS:
        with pytest.raises(LookupError, match="no more data") as caught:
            kp.dynamics(m, kp.assemble(m), t_end=1, method=method)
        solution = caught.value.solution  # type: ignore[attr-defined]
        assert 0.1 < solution.t[-1] <= 0.5
        assert solution["motor.torque"] == pytest.approx(1.0)
    with pytest.raises(LookupError):
        kp.assemble(m, t=0.7)["rod"].alpha  # noqa: B018


@pytest.mark.parametrize(
    ("value", "text"), [(math.nan, "nan"), (math.inf, "inf"), (None, "None"), ("3", "'3'")]
)
def test_a_value_that_is_not_a_number(value: Any, text: str) -> None:
    def wrong(t: float, _: kp.State) -> Any:
        return value if t >= 0.25 else 0

    for law in (wrong, kp.Sampled(wrong, 0.05)):
        m = pendulum(law)
        expected = rf"forces\.motor\.torque: the function 'wrong' returned {text} at t = 0\.\d+ s"
        with pytest.raises(kp.ModelError, match=expected) as caught:
            kp.dynamics(m, kp.assemble(m), t_end=1)
        assert caught.value.t == pytest.approx(0.25, abs=0.1)
        assert caught.value.solution.t[-1] <= 0.25  # type: ignore[attr-defined]


def test_a_function_cannot_use_what_depends_on_it() -> None:
    m = pendulum(lambda _, state: state["rod.alpha"])
    with pytest.raises(kp.ModelError, match=r"forces\.motor\.torque: .* needs its own value"):
        kp.dynamics(m, kp.assemble(m), t_end=1)


def test_a_function_may_simulate_another_model() -> None:
    inner = pendulum(feedback)

    def predicts(_: float, state: kp.State) -> float:
        start = kp.assemble(inner, set={"rod.angle": state["rod.angle"]})
        return -float(kp.dynamics(inner, start, t_end=0.01)["rod.omega"][-1])

    m = pendulum(kp.Sampled(predicts, 0.05))
    solution = kp.dynamics(m, kp.assemble(m, set={"rod.angle": 0.3}), t_end=0.2)
    assert solution["motor.torque"][-1] != 0.0


def test_sampled_refuses_other_values() -> None:
    with pytest.raises(kp.ModelError, match=r"Sampled\.period: 0 s; must be > 0"):
        kp.Sampled(feedback, 0)
    with pytest.raises(kp.ModelError, match=r"Sampled\.f: 3 is not a function"):
        kp.Sampled(3, 0.1)  # type: ignore[arg-type]
    with pytest.raises(kp.ModelError, match=r"Sampled\.start"):
        kp.Sampled(feedback, 0.1, "soon")  # type: ignore[arg-type]


def test_a_sampled_mass_follows_the_discrete_system() -> None:
    calls: list[float] = []

    def control(t: float, state: kp.State) -> float:
        calls.append(t)
        return -30 * state["cart.x"] - 4 * state["cart.vx"]

    m = slide()
    m.force("F", "cart.S", force=(kp.Sampled(control, 0.02), 0))
    assert m.state_names() == ["F.force_1_held"]
    start = kp.assemble(m, set={"cart.x": 0.2})
    solution = kp.dynamics(m, start, t_end=1, output_step=0.01)
    assert calls == [k * 0.02 for k in range(50)]
    x, v, h, rows = 0.2, 0.0, 0.02, []
    for _ in range(50):
        u = -30 * x - 4 * v
        rows += [(x, u), (x + v * h / 2 + u * h * h / 16, u)]
        x, v = x + v * h + u * h * h / 4, v + u * h / 2
    expected = np.array(rows)
    assert solution["cart.x"][:-1] == pytest.approx(expected[:, 0], abs=1e-10)
    assert solution["F.fx"][:-1] == pytest.approx(expected[:, 1], abs=1e-9)
    assert solution["F.force_1_held"][:-1] == pytest.approx(expected[:, 1], abs=1e-9)
    # the interpolant holds the value from each sample on
    held = solution([0.1, 0.1199, 0.12])["F.fx"]
    assert held == pytest.approx(expected[[10, 10, 12], 1], abs=1e-9)
    # force × change of place, exactly
    work = np.cumsum(expected[:-1, 1] * np.diff(expected[:, 0]))
    assert solution["energy.work"][1:-1] == pytest.approx(work, abs=1e-9)
    assert np.ptp(solution["energy.total"]) < 1e-9


class Integral:
    """An integrating controller, with the memory of a class."""

    def __init__(self, gain: float = 60.0) -> None:
        self.gain, self.total = gain, 0.0

    def __call__(self, _: float, state: kp.State) -> float:
        error = 0.5 - state["rod.angle"]
        self.total += 0.01 * error
        return 40 * error + self.gain * self.total - 12 * state["rod.omega"]


def enclosed() -> Callable[[float, kp.State], float]:
    """The same controller, with the memory of a closure."""
    total = 0.0

    def law(_: float, state: kp.State) -> float:
        nonlocal total
        total += 0.01 * (0.5 - state["rod.angle"])
        return 40 * (0.5 - state["rod.angle"]) + 60 * total - 12 * state["rod.omega"]

    return law


def controlled(controller: Any, runs: int = 2) -> list[np.ndarray]:
    m = pendulum(kp.Sampled(controller, period=0.01))
    start = kp.assemble(m)
    return [kp.dynamics(m, start, t_end=0.3).q for _ in range(runs)]


def test_a_controller_with_reset_starts_each_run_afresh() -> None:
    class Forgetting(Integral):
        def reset(self) -> None:
            self.total = 0.0

    (first,) = controlled(Integral(), runs=1)
    for q in controlled(Forgetting(), runs=3) + controlled(Forgetting().__call__):
        assert np.array_equal(q, first)
    law = enclosed()
    law.reset = lambda: setattr(law, "told", True)  # type: ignore[attr-defined]
    controlled(law)
    assert law.told  # type: ignore[attr-defined]


def test_a_run_with_the_memory_of_an_earlier_one_gives_a_warning() -> None:
    class Local(Integral):
        """A class that cannot be pickled."""

    for controller in (Integral(), Local(), Integral().__call__, enclosed()):
        with pytest.warns(kp.FunctionWarning, match=r"forces\.motor\.torque: .* reset\(\)") as told:
            first, second = controlled(controller)
        assert len(told) == 1 and told[0].filename == __file__
        assert not np.array_equal(first, second)


def test_a_controller_without_a_memory_of_runs_gives_no_warning() -> None:
    def forgets(t: float, state: kp.State) -> float:
        return Integral()(t, state)

    controlled(feedback)
    controlled(forgets)
    controller = Integral()
    m = pendulum(kp.Sampled(controller, period=0.01))
    for gain in (60.0, 50.0):
        controller.gain, controller.total = gain, 0.0  # the caller resets it
        kp.dynamics(m, kp.assemble(m), t_end=0.1)
