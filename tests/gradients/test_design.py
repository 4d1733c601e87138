"""Slopes of numbers of ``kp.design`` that columns of sweeps express, against their differences."""

from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from sizes import some

SCALES = [(1.0, 1.0, 1.0), (1e-3, 1e3, 30.0)]
#: The start, and the time of a turn.
GUESS = {"coupler.angle": "50 deg", "rocker.angle": "-90 deg"}
#: Each number, and its column.
NUMBERS: dict[str, tuple[str, Callable[[kp.Solution], float]]] = {
    "peak effort": ("motor.effort.peak", lambda s: abs(kp.design.duty(s, "motor").peak.value)),
    "rms effort": ("motor.effort.rms", lambda s: kp.design.duty(s, "motor").rms),
    "driving work": (
        "max(motor.power, 0).integral",
        lambda s: kp.design.duty(s, "motor").driving_work,
    ),
    "peak power": ("motor.power.peak", lambda s: abs(kp.design.duty(s, "motor").peak_power.value)),
    "pin load": ("B.force.max", lambda s: pin(s)["max"].value),
    "pin load along a body": (
        "(-(B.fx*cos(coupler.angle) + B.fy*sin(coupler.angle))).max",
        lambda s: pin(s)["x_max"].value,
    ),
    "shaking force": (
        "hypot(D.fx - O.fx, D.fy - O.fy + g*(m1 + m2 + m3)).max",
        lambda s: most(np.hypot(*kp.design.shaking(s, "ground.O").force.T)),
    ),
    "transmission angle": (
        "acos(-cos(coupler.angle - rocker.angle)).min",
        lambda s: kp.design.transmission_angle(s, "B").limits.least.value,
    ),
    "velocity ratio": (
        "(rocker.omega/crank.omega).max",
        lambda s: most(kp.design.velocity_ratio(s, "rocker.angle", "crank.angle")),
    ),
    "length of a curve": (
        "hypot(coupler.P.vx, coupler.P.vy).integral",
        lambda s: kp.design.coupler_curve(s, "coupler.P").length,
    ),
    "area of a curve": (
        "(0.5*(coupler.P.x*coupler.P.vy - coupler.P.y*coupler.P.vx)).integral",
        lambda s: float(kp.design.coupler_curve(s, "coupler.P").area or 0.0),
    ),
}
#: Extremes that kp.design gives on a fine raster only.
COARSE = {"shaking force", "velocity ratio"}


def pin(solution: kp.Solution) -> Any:
    return kp.design.pin_load(solution, "B", on="coupler").extremes


def most(values: Any) -> float:
    """The largest value of a fine raster, by a parabola through its neighbours."""
    k = int(np.argmax(values))
    a, b, c = values[k - 1 : k + 2]
    return float(b + (c - a) ** 2 / (8 * (2 * b - a - c)))


def crank_rocker(scale: tuple[float, float, float]) -> kp.Case:
    size, mass, rate = scale
    numbers = {"g": 9.0 * rate**2 * size, "w": rate, "L2": 0.3 * size, "L3": size}
    numbers |= {"L4": 0.75 * size, "m1": mass, "m2": 2 * mass, "m3": 1.5 * mass}
    m = kp.Model("crank-rocker", gravity=(0, "-g"), parameters=numbers)
    m.ground.points(O=(0, 0), D=(size, 0))
    m.bar("crank", mass="m1", length="L2", ends=("O", "A"))
    point = {"P": (0.12 * size, 0.5 * size)}
    m.bar("coupler", mass="m2", length="L3", ends=("A", "B"), points=point)
    m.bar("rocker", mass="m3", length="L4", ends=("B", "D"))
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "coupler.A")
    m.revolute("B", "coupler.B", "rocker.B")
    m.revolute("D", "rocker.D", "ground.D")
    m.coordinate_driver("motor", "crank.angle", value="w*t + 0.4")
    end = 2 * np.pi / rate
    return kp.Case(m, {"guess": GUESS}, [kp.InverseDynamics(t_end=end, output_step=end / 500)])


@pytest.mark.parametrize("scale", some(SCALES[::-1], 1))
def test_numbers_of_design_are_columns_with_slopes(scale: tuple[float, float, float]) -> None:
    case, variables = crank_rocker(scale), ["L2", "m2"]
    columns = [column for column, _ in NUMBERS.values()]
    g = kp.gradient(case, columns, variables)
    assert not g.remarks

    def read(name: str, factor: float) -> Any:
        varied = case.with_parameters({name: g.variables[name] * factor})
        with_these = varied.run()["inverse_dynamics"]
        return np.array([of(with_these) for _, of in NUMBERS.values()])

    own = read("L2", 1.0)
    for k, (name, (column, _)) in enumerate(NUMBERS.items()):
        rel = 1e-6 if name in COARSE else 1e-8
        assert g.measures[column] == pytest.approx(own[k], rel=rel), name
    for variable in variables:
        x, h = g.variables[variable], 1e-3
        near = (read(variable, 1 + h) - read(variable, 1 - h)) / (2 * h * x)
        wide = (read(variable, 1 + 2 * h) - read(variable, 1 - 2 * h)) / (4 * h * x)
        true = (4 * near - wide) / 3
        for k, (name, (column, _)) in enumerate(NUMBERS.items()):
            rel = 1e-3 if name in COARSE else 1e-6
            close = rel * (abs(true[k]) + abs(own[k]) / x)
            assert abs(g[column, variable] - true[k]) <= close, (name, variable)
