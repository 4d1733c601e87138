"""Machines with a motion in closed form, or by an independent integration, and noisy data."""

from functools import cache

import kempe as kp
import numpy as np
from scipy.integrate import solve_ivp

MASS, ARM, G = 0.62, 0.14, 9.81
TRUE = {"J": 0.00512, "c": 0.0021, "rod.angle": np.radians(38)}
TIMES = np.arange(0, 6, 0.05)


@cache
def swing() -> np.ndarray:
    """The angle of the rod on an edge with its true parameters."""

    def rate(_: float, y: list[float]) -> list[float]:
        torque = -MASS * G * ARM * np.sin(y[0]) - TRUE["c"] * y[1]
        return [y[1], torque / (TRUE["J"] + MASS * ARM**2)]

    start = [TRUE["rod.angle"], 0]
    return solve_ivp(rate, (0, 6), start, t_eval=TIMES, rtol=1e-10, atol=1e-12).y[0]


def rod(extra: dict[str, float] | None = None) -> kp.Case:
    """A connecting rod on an edge; its angle is 0 where it hangs."""
    parameters = {"J": 0.004, "c": 0.0, "mass": MASS, **(extra or {})}
    m = kp.Model("rod on an edge", gravity=(0, -G), parameters=parameters)
    m.ground.points(O=(0, 0))
    m.body("rod", mass="mass", inertia="J", points={"O": (0, ARM)})
    m.revolute("edge", "ground.O", "rod.O")
    m.torsion_spring("bearing", "ground", "rod", damping="c")
    return kp.Case(m, {"set": {"rod.angle": 0.6, "rod.omega": 0}}, [kp.Dynamics(t_end=6)])


def film(seed: int, degrees: float = 0.5) -> dict[str, np.ndarray]:
    """Measured angles with errors, in degrees."""
    noise = np.random.default_rng(seed).normal(size=len(TIMES))
    return {"time": TIMES, "phi [deg]": np.degrees(swing()) + degrees * noise}


def angle(table: object, **more: object) -> kp.Data:
    return kp.Data(table, t="time", columns={"rod.angle": "phi [deg]"}, **more)  # type: ignore[arg-type]


#: The true values of the slider.
SLIDER = {"m": 2.0, "c": 1.5, "k": 50.0, "F": 4.0}


def slider(**more: float | str) -> kp.Case:
    """A mass on a spring with a constant force, and parameters that replace its own formulas."""
    parameters: dict[str, float | str] = {**SLIDER, "x0": 0.1, "free": 0.0, "preload": 0.0}
    parameters |= {"k2": 0.0, "c2": 0.0, "m2": 0.0, **more}
    m = kp.Model("slider", parameters=parameters)
    m.ground.points(O=(0, 0))
    m.body("mass", mass="m + m2", inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P")
    law = "F - k*(displacement - free) - k2*displacement - (c + c2)*rate - preload"
    m.generalized_force(
        "push",
        "guide.displacement",
        value=law.replace("displacement", "guide.displacement").replace("rate", "guide.rate"),
    )
    start = {"set": {"guide.displacement": "x0", "guide.rate": 0}}
    return kp.Case(m, start, [kp.Dynamics(t_end=4)])


def slider_data(seed: int, noise: float = 1e-4, n: int = 80) -> kp.Data:
    """The motion of the slider in closed form, with noise."""
    m, c, k, force = SLIDER.values()
    t = np.linspace(0.05, 3.9, n)
    decay, rate = c / (2 * m), np.sqrt(k / m - (c / (2 * m)) ** 2)
    a = 0.1 - force / k
    x = force / k + np.exp(-decay * t) * (
        a * np.cos(rate * t) + a * decay / rate * np.sin(rate * t)
    )
    x += noise * np.random.default_rng(seed).normal(size=n)
    return kp.Data({"t [ms]": 1e3 * t, "x [mm]": 1e3 * x}, columns={"guide.displacement": "x"})


def four_bar() -> kp.Case:
    """A four-bar linkage with a spring and a damper at its rocker, released from rest."""
    m = kp.Model("four-bar", gravity=(0, -9.81), parameters={"k": 1e3, "c": 10.0})
    m.ground.points(A=(0, 0), D=(0.8, 0))
    m.bar("crank", mass=3, length=0.4, ends=("A", "B"))
    m.bar("coupler", mass=5, length=1.0, ends=("B", "C"))
    m.bar("rocker", mass=4, length=0.7, ends=("C", "D"))
    for joint, i, j in (
        ("A", "ground.A", "crank.A"), ("B", "crank.B", "coupler.B"),
        ("C", "coupler.C", "rocker.C"), ("D", "ground.D", "rocker.D"),
    ):  # fmt: skip
        m.revolute(joint, i, j)
    m.torsion_spring("spring", "ground", "rocker", stiffness="k", damping="c", free_angle="270*deg")
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    start = {"set": {"crank.angle": "70*deg"}, "guess": guess}
    return kp.Case(m, start, [kp.Dynamics(t_end=0.5)])
