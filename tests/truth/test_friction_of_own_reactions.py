"""Friction with the reaction of its own joint as load, in all joints of a mechanism."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest
from quiet import within
from sizes import some

MU, STATIC = 0.15, 0.2
ON = {"A": "crank", "B": "rod", "C": "slider", "D": "slider"}
#: Factors of mass, length and time.
SCALES = [
    (mass, length, time)
    for mass in (1e-3, 1.0, 1e3)
    for length in (1e-3, 1e3)
    for time in (1e-3, 1.0)
]


def run(scale: tuple[float, float, float], smooth: bool, kinetic: float | None = MU) -> kp.Solution:
    """A slider-crank with friction in its three pins and in its slide, in scaled units."""
    mass, length, time = scale
    m = kp.Model("slider-crank", gravity=(0, -9.81 * length / time**2))
    m.ground.points(A=(0, 0))
    m.bar("crank", mass=mass, length=0.3 * length, ends=("A", "B"))
    m.bar("rod", mass=2 * mass, length=0.8 * length, ends=("B", "C"))
    m.body("slider", mass=1.5 * mass, inertia=0.01 * mass * length**2, points={"C": (0, 0)})
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "rod.B")
    m.revolute("C", "rod.C", "slider.C")
    m.translational("D", "ground.A", "slider.C")
    if kinetic is not None:
        smoothed = {"velocity": 0.01 * length / time} if smooth else {}
        stribeck = {"stribeck": 0.05 * length / time, "static": STATIC}
        for joint in "ABC":
            m.friction(f"f{joint}", joint, kinetic=kinetic, radius=0.03 * length, **smoothed)
        m.friction("fD", "D", kinetic=kinetic, guide=0.1 * length, **stribeck, **smoothed)
    start = kp.assemble(
        m,
        set={"crank.angle": "80 deg", "crank.omega": 9 / time},
        guess={"rod.angle": "-20 deg", "slider.x": 0.8 * length},
    )
    return kp.dynamics(m, start, t_end=0.4 * time)


@pytest.mark.parametrize("scale", some(SCALES, 4))
@pytest.mark.parametrize("smooth", [True, False])
def test_each_friction_agrees_with_its_reaction(
    scale: tuple[float, float, float], smooth: bool
) -> None:
    """The friction in the balance of the bodies is that of the reactions in the same balance."""
    sol = run(scale, smooth)
    length, time = scale[1:]
    usual = length / time
    rates = {
        "A": sol["crank.omega"],
        "B": sol["rod.omega"] - sol["crank.omega"],
        "C": sol["slider.omega"] - sol["rod.omega"],
        "D": sol["slider.vx"],
    }
    for joint, rate in rates.items():
        slide = joint == "D"
        arm = 1.0 if slide else 0.03 * length
        speed = arm * rate
        # where friction reverses, a row has the sign before it
        rows = np.flatnonzero(np.abs(speed) > 1e-6 * usual)
        sense = np.tanh(speed / (0.01 * usual)) if smooth else np.sign(speed)
        force = sol[joint].force(on=ON[joint])
        load = np.hypot(force[:, 0], force[:, 1])
        coefficient = np.full_like(load, MU)
        if slide:
            load = np.maximum(load, 2 * np.abs(sol["D"].torque(on="slider")) / (0.1 * length))
            coefficient += (STATIC - MU) * np.exp(-((speed / (0.05 * usual)) ** 2))
        right = -arm * coefficient * load * sense
        found = sol[f"f{joint}.force" if slide else f"f{joint}.torque"]
        assert len(rows) > 20
        within = 1e-10 * np.abs(right).max()
        np.testing.assert_allclose(found[rows], right[rows], rtol=0, atol=within)
    assert np.abs(sol.newton_euler.force).max() < 1e-10 * np.abs(sol["B"].force(on="rod")).max()


@pytest.mark.alone
def test_the_time_of_an_evaluation() -> None:
    """Friction in all four joints takes about six times as long as none."""

    def cost(kinetic: float | None) -> float:
        counts = run((1.0, 1.0, 1.0), True, kinetic).statistics
        return float(counts["seconds"] / counts["evaluations"])

    def ratio() -> float:
        return min(cost(MU) for _ in range(9)) / min(cost(None) for _ in range(9))

    assert within(15.0, ratio)
