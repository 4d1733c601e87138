"""Slopes of stiff motions, against closed forms and extrapolated differences."""

import cmath
import warnings
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from gradients.test_known import double_pendulum, told
from gradients.test_random import differences, scales

EXAMPLES = Path(__file__).parents[2] / "examples"
Method = kp.Auto | kp.Radau


def radau(rtol: float) -> kp.Radau:
    return kp.Radau(rtol=rtol, atol=1e-3 * rtol)


def oscillator(method: Method) -> tuple[kp.Case, dict[str, float]]:
    """A mass that creeps behind a damper; its other motion decays in 1e-7 s."""
    values = {"m": 1.0, "c": 1e7, "k": 2e7}
    m = kp.Model("oscillator", parameters=values)
    m.ground.points(O=(0, 0))
    m.body("mass", mass="m", inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P", axes=(0, 0))
    m.spring_damper("damper", "ground.O", "mass.P", stiffness="k", damping="c", free_length=1)
    run = kp.Dynamics(t_end=1, output_step=0.5, method=method)
    return kp.Case(m, {"set": {"mass.x": 1.5, "mass.vx": 0}}, [run]), values


def creep(m: complex, c: complex, k: complex) -> complex:
    """The position after 1 s. The quotient of the rates avoids a difference of large numbers."""
    fast = -(c + cmath.sqrt(c * c - 4 * m * k)) / (2 * m)
    slow = k / (m * fast)
    return 1 + 0.5 * fast / (fast - slow) * cmath.exp(slow)


@pytest.mark.parametrize("method", [kp.Auto(), radau(1e-9)])
def test_a_damped_oscillator(method: Method) -> None:
    case, values = oscillator(method)
    g = kp.gradient(case, ["mass.x.final"], list(values))
    assert not g.remarks
    for name, x in values.items():
        moved = {**values, name: x + 1e-20j * x}
        assert g["mass.x.final", name] == pytest.approx(creep(**moved).imag / (1e-20 * x), rel=1e-8)


def cantilever(method: Method) -> kp.Case:
    """A straight beam that begins to vibrate under its weight; its fastest rate is 2e9 1/s."""
    values = {"L": "0.4 m", "h": "2 mm", "E": "70e9 Pa"}
    m = kp.Model("cantilever", gravity=(0, -9.81), parameters=values)
    m.ground.points(O=(0, 0))
    section = {"rectangle": ["h", "20 mm"]}
    m.beam("beam", length="L", section=section, young="E", density=2700, damping=1e-4, elements=2)
    m.weld("clamp", "ground.O", "beam.A")
    return kp.Case(m, {}, [kp.Dynamics(t_end=0.006, output_step=0.002, method=method)])


def damped_floor(method: Method) -> kp.Case:
    """A mass that falls on a stiff floor, and rests on it."""
    values = {"k": 1e6, "c": 1e3, "height": 0.12}
    m = kp.Model("floor", gravity=(0, -9.81), parameters=values)
    m.ground.points(O=(0, 0))
    m.body("mass", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "mass.P", axes=("pi/2", "pi/2"))
    m.spring_damper(
        "floor",
        "ground.O",
        "mass.P",
        stiffness="k",
        damping="c",
        free_length=0.1,
        only="compression",
    )
    start: dict[str, dict[str, float | str]] = {"set": {"mass.y": "height", "mass.vy": 0}}
    return kp.Case(m, start, [kp.Dynamics(t_end=0.5, output_step=0.05, method=method)])


def flail(method: Method) -> kp.Case:
    """Two rods with a stiff damper between them; the first one hits a stop."""
    values = {"L": 1.0, "c": 2e3, "e": 0.5}
    m = kp.Model("flail", gravity=(0, -9.81), parameters=values)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length="L", ends=("O", "P"))
    m.bar("tip", mass=0.1, length=0.3, ends=("P", "Q"))
    m.revolute("O", "ground.O", "rod.O")
    m.revolute("P", "rod.P", "tip.P")
    m.torsion_spring("spring", "rod", "tip", stiffness=50, damping="c")
    m.stop("stop", "rod.angle", lower=-1.6, restitution="e")
    start = {"set": {"rod.angle": 0.2, "tip.angle": 0.3}}
    return kp.Case(m, start, [kp.Dynamics(t_end=0.9, output_step=0.05, method=method)])


@pytest.mark.parametrize(
    ("make", "method", "measures"),
    [
        (cantilever, kp.Auto(), ["beam.B.y.final", "clamp.torque.max", "beam.B.y.mean"]),
        (damped_floor, kp.Auto(), ["floor.force.max", "mass.y.final", "mass.y.mean"]),
        (flail, radau(1e-8), ["rod.angle.final", "tip.omega.final", "energy.dissipated.final"]),
        (
            flail,
            kp.Auto(),
            ["tip.omega.final", "energy.dissipated.final", "spring.dissipated.final"],
        ),
    ],
)
def test_stiff_mechanisms(
    make: Callable[[Method], kp.Case], method: Method, measures: list[str]
) -> None:
    case = make(method)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        g = kp.gradient(case, measures, list(case.model.parameters))
        true, _ = differences(make(radau(1e-9)), g)
    assert not g.remarks
    assert np.max(np.abs(g.jacobian - true) / scales(g)) < 1e-6


def test_a_snap() -> None:
    """Explicit steps would be 4e6."""
    case = kp.load(EXAMPLES / "bistable_switch.toml").with_analysis(
        "snap", t_end=0.01, output_step=0.01
    )
    g = kp.gradient(case, ["push.effort.final"], ["E"])
    # at rest at a given position, forces are in proportion to the modulus
    share = g["push.effort.final", "E"] * g.variables["E"] / g.measures["push.effort.final"]
    assert not g.remarks and share == pytest.approx(1, rel=0.1)


def test_the_error_of_an_implicit_run_is_told() -> None:
    measure = "second.angle.final"
    loose, tight = (
        kp.gradient(
            double_pendulum(8, 1e-6).with_analysis("dynamics", method=method), [measure], ["L"]
        )
        for method in (radau(1e-4), radau(1e-11))
    )
    off = abs(loose.measures[measure] - tight.measures[measure])
    assert not tight.remarks and off > 1e-3
    assert 0.3 * off < told(loose) < 3 * off
