"""Python functions with derivatives: their slopes are those of the formula."""

import math
from collections.abc import Mapping
from typing import Any

import kempe as kp
import numpy as np
import pytest

SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 30.0), (1e3, 1e-3, 0.1)]
EXACT = kp.DOP853(rtol=1e-12, atol=1e-14)
VARIABLES = ["m", "L", "g", "rod.angle", "rod.omega"]


class Muscle:
    """A spring that hardens, with drag and a pulse, between ground and the end of the rod."""

    def __init__(self, size: float, mass: float, rate: float) -> None:
        self.k, self.c, self.w = 40 * mass * rate**2, 0.8 * mass * rate, 3 * rate
        self.b, self.s = 20 * mass * rate**2 / size**2, 0.4 * size

    def __call__(self, t: float, state: kp.State) -> float:
        x = float(state["pull.length"]) - self.s
        return -(self.k * x + self.b * x**3) * (1 + 0.3 * math.sin(self.w * t)) - self.c * float(
            state["pull.rate"]
        )

    def slopes(self, t: float, state: kp.State) -> Mapping[str, float]:
        x = float(state["pull.length"]) - self.s
        pulse = 1 + 0.3 * math.sin(self.w * t)
        return {
            "pull.length": -(self.k + 3 * self.b * x**2) * pulse,
            "pull.rate": -self.c,
            "t": -(self.k * x + self.b * x**3) * 0.3 * self.w * math.cos(self.w * t),
        }

    @property
    def formula(self) -> str:
        x = f"(pull.length - {self.s})"
        pulse = f"(1 + 0.3*sin({self.w}*t))"
        return f"-({self.k}*{x} + {self.b}*{x}^3)*{pulse} - {self.c}*pull.rate"

    @property
    def law(self) -> kp.Function:
        return kp.Function(self, slopes=self.slopes)


def pendulum(law: Any, scale: tuple[float, float, float], **more: Any) -> kp.Model:
    """A rod on a pin, drawn by an actuator at its end, whose length depends on L and O."""
    size, mass, rate = scale
    numbers = {"m": 2 * mass, "L": size, "g": 9.0 * rate**2 * size}
    m = kp.Model("pendulum", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0), Q=(0.3 * size, "0.5*L"))
    m.bar("rod", mass="m", length="L", ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O", **more)
    m.actuator("pull", "ground.Q", "rod.P", force=law)
    return m


def start(rate: float) -> dict[str, Any]:
    return {"set": {"rod.angle": 0.2, "rod.omega": 0.5 * rate}}


def same(one: kp.Gradient, other: kp.Gradient, rel: float) -> None:
    assert not one.remarks and not other.remarks
    sizes = np.array([abs(x) or 1.0 for x in other.variables.values()])
    scale = np.abs(other.jacobian * sizes).max(axis=1, keepdims=True) / sizes
    assert (np.abs(one.jacobian - other.jacobian) <= rel * scale).all()
    assert np.abs(other.jacobian).max(axis=1).min() > 0


@pytest.mark.parametrize("scale", SCALES)
def test_slopes_of_a_motion_are_those_of_the_formula(scale: tuple[float, float, float]) -> None:
    rate, muscle = scale[2], Muscle(*scale)
    wanted = ["rod.angle.final", "O.force.max", "pull.force.rms", "rod.angle.t_max"]
    found = []
    for law in (muscle.law, muscle.formula):
        run = kp.Dynamics(t_end=1.3 / rate, output_step=0.05 / rate, method=EXACT)
        case = kp.Case(pendulum(law, scale), start(rate), [run])
        found.append(kp.gradient(case, [*wanted, "energy.work.final"], VARIABLES))
    same(*found, 1e-8)


@pytest.mark.parametrize("scale", SCALES)
def test_through_an_event_an_equilibrium_and_a_driver(scale: tuple[float, float, float]) -> None:
    rate, muscle = scale[2], Muscle(*scale)
    runs = [
        (
            kp.Dynamics(t_end=5 / rate, stop=f"rod.omega < {-1.5 * rate}", method=EXACT),
            ["rod.angle.final", "O.fx.final"],
            VARIABLES,
        ),
        (kp.Equilibrium(), ["rod.angle", "O.force"], ["m", "L", "g"]),
    ]
    for run, wanted, variables in runs:
        cases = [
            kp.Case(pendulum(law, scale), start(rate), [run])
            for law in (muscle.law, muscle.formula)
        ]
        same(*(kp.gradient(case, wanted, variables) for case in cases), 1e-8)
    found = []
    for law in (muscle.law, muscle.formula):
        m = pendulum(law, scale)
        m.coordinate_driver("turn", "rod.angle", value=f"0.2 + {rate}*t")
        turn = kp.InverseDynamics(t_end=1 / rate, output_step=0.1 / rate)
        wanted = ["turn.effort.final", "turn.effort.mean"]
        found.append(kp.gradient(kp.Case(m, {}, [turn]), wanted, ["m", "L", "g"]))
    same(*found, 1e-9)


def test_slopes_over_time_and_implicit_methods() -> None:
    muscle, found = Muscle(1.0, 1.0, 1.0), []
    for law in (muscle.law, muscle.formula):
        m = pendulum(law, SCALES[0])
        begin = kp.assemble(m, **start(1.0))
        run: dict[str, Any] = {"t_end": 1.0, "output_step": 0.1, "method": kp.Radau(1e-11, 1e-13)}
        sol = kp.dynamics(m, begin, **run, slopes=["L", "rod.omega"])
        found.append(
            np.array([sol.q[:, 2], sol.slope("O.fx", "L"), sol.slope("rod.angle", "rod.omega")])
        )
    assert np.abs(found[0] - found[1]).max() < 1e-8 * np.abs(found[1]).max()


def test_calls_of_the_function_for_implicit_methods() -> None:
    calls = []

    def counted(t: float, state: kp.State) -> float:
        calls.append(t)
        return -5.0 * float(state["pull.length"])

    spent = []
    for law in (counted, kp.Function(counted, slopes=lambda *_: {"pull.length": -5.0})):
        m = pendulum(law, SCALES[0])
        calls.clear()
        kp.dynamics(m, kp.assemble(m, **start(1.0)), t_end=1, method=kp.Radau(1e-8, 1e-10))
        spent.append(len(calls))
    assert spent[1] < 0.7 * spent[0]


def wrong(text: str) -> Any:
    return pytest.raises(kp.ModelError, match=text)


def test_refusals_name_the_law_and_a_remedy() -> None:
    def case(law: Any) -> kp.Case:
        m = pendulum(law, SCALES[0])
        return kp.Case(m, start(1.0), [kp.Dynamics(t_end=0.1)])

    def f(_: float, state: kp.State) -> float:
        return float(state["rod.omega"])

    def run(slopes: Any) -> kp.Gradient:
        return kp.gradient(case(kp.Function(f, slopes=slopes)), ["rod.angle.final"], ["L"])

    with wrong(r"forces.pull.force is a Python function.*cannot be differentiated") as caught:
        kp.gradient(case(f), ["rod.angle.final"], ["L"])
    assert "kp.Function(f, slopes=g)" in str(caught.value)
    with wrong(r"cannot be differentiated"):
        kp.gradient(case(kp.Function(f)), ["rod.angle.final"], ["L"])
    with wrong("because it is sampled"):
        kp.gradient(
            case(kp.Sampled(kp.Function(f, lambda *_: {}), 0.01)), ["rod.angle.final"], ["L"]
        )
    with wrong(r"forces.pull.force: slopes of the function .*rod.omga.*"):
        run(lambda *_: {"rod.omga": 1.0})
    with wrong("does not follow from t, q, v and z"):
        run(lambda *_: {"rod.alpha": 1.0})
    with wrong("must return finite numbers"):
        run(lambda *_: {"rod.omega": math.nan})
    with wrong("must return {quantity: number}"):
        run(lambda *_: 1.0)
    with pytest.raises(ZeroDivisionError):
        run(lambda *_: {"rod.omega": 1 / 0})
    with wrong("Function.slopes"):
        kp.Function(f, slopes=1.0)  # type: ignore[arg-type]
    assert run(lambda *_: {"rod.omega": 1.0})["rod.angle.final", "L"] != 0.0


def test_modes_need_second_derivatives() -> None:
    m = pendulum(Muscle(*SCALES[0]).law, SCALES[0])
    case = kp.Case(m, {"set": {"rod.angle": 0.2}}, [kp.Equilibrium(), kp.Modes()])
    g = kp.gradient(case, ["frequency[0]"], ["L"])
    assert np.isnan(g.jacobian).all() and "write formulas" in g.remarks["frequency[0]", "L"]


def test_slopes_with_other_values_of_the_parameters() -> None:
    """A fit and an optimization differentiate at values that the case does not have."""
    muscle, found = Muscle(1.0, 1.0, 1.0), []
    for law in (muscle.law, muscle.formula):
        run = kp.Dynamics(t_end=1.0, output_step=0.05, method=EXACT)
        case = kp.Case(pendulum(law, SCALES[0]), start(1.0), [run])
        best = kp.optimize(case, {"m": (1.0, 4.0)}, target={"rod.angle.final": 0.1})
        found.append(best.values["m"])
    assert found[0] == pytest.approx(found[1], rel=1e-6)
