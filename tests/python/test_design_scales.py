"""Numbers of a design in other units of mass, length and time, their words, and the defaults."""

from dataclasses import FrozenInstanceError, fields, replace
from functools import cache
from typing import Any

import kempe as kp
import numpy as np
import pytest
from cams.machines import oscillating, translating
from kempe import design
from kempe.design.balance import Balance, Counterweight
from kempe.results.extrema import Extreme

#: Units of mass, length and time: kg, g, tonnes; m, mm, km; s, ms, hours.
SCALES = [(1e-3, 1e-3, 1e-3), (1e3, 1e3, 3.6e3), (1e3, 1e-3, 60.0), (1e-3, 1e3, 1e-3)]


@cache
def turned(mass: float = 1.0, size: float = 1.0, time: float = 1.0) -> kp.Solution:
    """A turn in 2 s of a slider-crank in gravity, with an offset and a point beside the rod."""
    m = kp.Model("offset slider-crank", gravity=(0, -9.81 * size / time**2))
    m.ground.points(O=(0, 0), G=(0, -0.05 * size))
    m.bar("crank", mass=0.5 * mass, length=0.2 * size, ends=("O", "A"))
    points = {"A": (0, 0), "B": (0.5 * size, 0), "P": (0.2 * size, 0.1 * size)}
    center, inertia = (0.2 * size, 0.03 * size), 0.02 * mass * size**2
    m.body("rod", mass=0.8 * mass, inertia=inertia, center=center, points=points)
    m.body("piston", mass=1.2 * mass, inertia=0.01 * mass * size**2, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "piston.B")
    m.translational("S", "ground.G", "piston.B", axes=(0, 0))
    law = "0.3 + pi*t/T + 0.1*sin(2*pi*t/T)"
    m.coordinate_driver("motor", "crank.angle", value=law.replace("T", repr(time)))
    start = kp.assemble(m, guess={"piston.x": 0.6 * size})
    return kp.inverse_dynamics(m, start, t_end=2.0 * time, output_step=0.1 * time)


def numbers(sol: kp.Solution, time: float) -> dict[str, tuple[Any, str]]:
    """Numbers of all kinds, each with its unit in kg, m and s."""
    path, angle = design.coupler_curve(sol, "rod.P"), design.transmission_angle(sol, "B")
    duty, wheel = design.duty(sol, "motor"), design.flywheel(sol, "motor", fluctuation=0.03)
    shake, pin = design.shaking(sol, "ground.G"), design.pin_load(sol, "A", on="rod")
    toggles = design.toggles(sol, "piston.x")
    centre = design.instant_centre(sol, "ground", "rod")
    found = {
        "length": (path.length, "m"),
        "area": (path.area, "m m"),
        "position": (path.position, "m"),
        "angle": (angle.angle, ""),
        "limits": ([one.value for one in angle.limits], ""),
        "times of limits": ([one.t for one in angle.limits], "s"),
        "toggles": ([one.t for one in toggles], "s"),
        "at toggles": ([one.value for one in toggles], "m"),
        "ratio": (design.velocity_ratio(sol, "piston.x", "crank.angle"), "m"),
        "advantage": (design.mechanical_advantage(sol, "rod.angle", "crank.angle"), ""),
        "centre": (centre.position, "m"),
        "direction": (centre.direction, ""),
        "centrode": (centre.seen_from("rod"), "m"),
        "omega": (centre.omega, "/s"),
        "effort": (duty.effort, "kg m m /s /s"),
        "power": (duty.power, "kg m m /s /s /s"),
        "works": ([duty.driving_work, duty.braking_work], "kg m m /s /s"),
        "means": ([duty.rms, duty.mean, duty.peak.value], "kg m m /s /s"),
        "powers": ([duty.mean_power, duty.peak_power.value], "kg m m /s /s /s"),
        "flywheel": (wheel.inertia, "kg m m"),
        "stored": (wheel.stored, "kg m m /s /s"),
        "slowest": ([wheel.slowest, wheel.fastest], "s"),
        "force": (shake.on_ground, "kg m /s /s"),
        "moment": (shake.moment_on_ground, "kg m m /s /s"),
        "pin": (pin.force, "kg m /s /s"),
        "pins": ([one.value for one in pin.extremes.values()], "kg m /s /s"),
    }
    velocity = design.velocity_polygon(sol, 0.7 * time)
    acceleration = design.acceleration_polygon(sol, 0.7 * time)
    for kind, polygon, unit in (("v", velocity, "m /s"), ("a", acceleration, "m /s /s")):
        found |= {f"{kind} {name}": (x, unit) for name, x in polygon.images.items()}
        sides = [(f"{kind} {side.name} {side.part}", side.vector) for side in polygon.sides]
        found |= {name: (vector, unit) for name, vector in sides}
    return found


@pytest.mark.parametrize("scale", SCALES)
def test_a_design_is_the_same_in_other_units(scale: tuple[float, float, float]) -> None:
    mass, size, time = scale
    one, other = numbers(turned(), 1.0), numbers(turned(*scale), time)
    assert list(one) == list(other)
    factors = {"kg": mass, "m": size, "s": time, "/s": 1 / time}
    for name, (expected, unit) in one.items():
        factor = np.prod([factors[part] for part in unit.split()])
        size_of = np.abs(np.asarray(expected)[np.isfinite(expected)]).max(initial=0.0)
        got = np.asarray(other[name][0]) / factor
        np.testing.assert_allclose(got, expected, rtol=1e-7, atol=1e-8 * size_of, err_msg=name)


def told(made: Any, **fields: Any) -> str:
    """The words of a result with other numbers."""
    return repr(replace(made, **fields))


def test_every_result_has_its_main_numbers_in_its_words() -> None:
    sol = turned()
    path = design.coupler_curve(sol, "rod.P")
    assert told(path, length=1.25, area=None) == "<CouplerCurve of rod.P: 1.25 m long, open>"
    assert told(path, length=2.0, area=-0.5) == ("<CouplerCurve of rod.P: 2 m long, area -0.5 m²>")
    angle = design.transmission_angle(sol, "B")
    assert told(angle, worst=Extreme(np.pi / 6, 1.0)) == "<TransmissionAngle at B: at least 30°>"
    first, _ = design.toggles(sol, "piston.x")
    assert told(first, t=0.5) == "<Toggle at 0.5: crank and rod in line>"
    assert told(first, t=0.5, in_line=()) == "<Toggle at 0.5: output at rest>"
    both = (("a", "b"), ("c", "d"))
    assert told(first, t=2.0, in_line=both) == "<Toggle at 2: a and b; c and d in line>"
    centre = design.instant_centre(sol, "ground", "rod")
    assert repr(centre) == "<InstantCentre of rod seen from ground>"
    polygon = design.velocity_polygon(sol, 0.7)
    assert repr(polygon) == "<Polygon of velocity with o, A, B, P>"
    side = replace(polygon.sides[0], vector=np.array([3.0, -4.0]))
    assert repr(side) == "<Side A (absolute): 5>"
    duty, peak = design.duty(sol, "motor"), Extreme(-7.5, 0.1)
    numbers = {"peak": peak, "rms": 2.5, "work": -3.25}
    assert told(duty, **numbers) == ("<Duty of motor: peak -7.5 N·m, rms 2.5 N·m, work -3.25 J>")
    assert told(duty, **numbers, unit="N", choice="minimum norm", unbounded_at=(0.5,)) == (
        "<Duty of motor: peak -7.5 N, rms 2.5 N, work -3.25 J, minimum norm, "
        "without bound at 0.5 s>"
    )
    wheel = design.flywheel(sol, "motor", fluctuation=0.03)
    assert told(wheel, inertia=4.5, energy=9.0, choice="minimum norm") == (
        "<Flywheel: 4.5 kg·m² for ΔE = 9 J, minimum norm>"
    )
    assert wheel.unique and not replace(wheel, choice="minimum norm").unique
    shake = design.shaking(sol)
    assert told(shake, force=np.array([[1.0, 0.0], [3.0, 4.0]])) == "<Shaking: force up to 5 N>"
    pin = design.pin_load(sol, "A")
    assert told(pin, extremes={"max": Extreme(12.5, 0.3)}) == "<PinLoad of A on rod: up to 12.5 N>"
    body = design.free_body(sol, "rod", 0.5)
    assert repr(body) == "<FreeBody rod at t = 0.5: A, B, gravity>"
    assert repr(body.loads[0]) == "<Load of A>"
    cams = translating(), oscillating("flat")
    for cam, kind, base in zip(
        cams, ("translating roller", "oscillating flat"), (0.03, 0.05), strict=True
    ):
        steep = np.degrees(np.abs(cam.pressure_angle).max())
        found = repr(cam)
        assert found.startswith(f"<Cam: {kind}, base radius {base} m, pressure angle up to ")
        number, sign, more = found.partition("up to ")[2].partition("°")
        assert float(number) == pytest.approx(steep, rel=5e-3) and sign
        assert more == (f"; {len(cam.remarks)} remarks>" if cam.remarks else ">")
    one = {"a": Counterweight(0.25, (0.0, 0.1)), "b": Counterweight(1.5, (0.0, 0.1))}
    made = Balance("moment", one, kp.Case(kp.Model("m")), 12.5, 0.5)
    assert repr(made) == "<Balance: a 0.25 kg, b 1.5 kg; shaking moment 12.5 N·m to 0.5 N·m>"
    assert told(made, of="force", masses={}, after=1.0) == (
        "<Balance: no counterweights; shaking force 12.5 N to 1 N>"
    )
    assert told(made, of="torque").endswith("; effort of the drive 12.5 to 0.5>")


def test_results_cannot_be_changed() -> None:
    """Their attributes keep their values."""
    sol = turned()
    found = [
        *(design.coupler_curve(sol, "rod.P"), design.transmission_angle(sol, "B")),
        *(design.duty(sol, "motor"), design.flywheel(sol, "motor", fluctuation=0.03)),
        *(design.shaking(sol), design.pin_load(sol, "A"), design.free_body(sol, "rod")),
        *design.free_body(sol, "rod").loads,
        *(design.free_body(sol, "rod").inertia, design.instant_centre(sol, "ground", "rod")),
        *(polygon := design.velocity_polygon(sol, 0.7)).sides,
        *(polygon, design.toggles(sol, "piston.x")[0], design.gear_train(2.0), translating()),
        Counterweight(0.25, (0.0, 0.1)),
    ]
    kinds = {type(one).__name__ for one in found} | {"Balance", "Limits"}
    classes = {name for name in design.__all__ if isinstance(getattr(design, name), type)}
    assert kinds == classes
    assert Balance.__dataclass_params__.frozen  # type: ignore[attr-defined]
    for one in found:
        name = fields(one)[0].name
        with pytest.raises(FrozenInstanceError):
            setattr(one, name, None)


def test_arguments_that_are_left_out_have_the_documented_values() -> None:
    """The origin, body j, the first instant, all joints of a body, and the pins of links."""
    sol = turned()
    shake, origin = design.shaking(sol), design.shaking(sol, (0.0, 0.0), fine=True)
    np.testing.assert_array_equal(shake.moment, origin.moment)
    assert shake.about == (0.0, 0.0) and len(shake.t) > len(sol.t)
    assert np.abs(shake.moment - design.shaking(sol, "ground.G").moment).max() > 0.1
    assert len(design.shaking(sol, fine=False).t) == len(sol.t)
    assert design.pin_load(sol, "A").on == "rod" and design.pin_load(sol, "B").on == "piston"
    for of in (design.velocity_polygon, design.acceleration_polygon):
        for given in (sol, sol.initial):
            assert of(given).t == 0.0
    assert design.free_body(sol, "rod").t == 0.0 and design.free_body(sol, "rod").name == ""
    names = [f"{joint}_{case}" for joint in "AB" for case in ("max", "x_max", "x_min")]
    cases = [case.name for case in design.load_cases(sol, "rod")]
    assert set(names) < set(cases) and len(cases) == 10
    wheel = design.flywheel(sol, "motor", fluctuation=0.03)
    assert wheel.speed == pytest.approx(np.pi, rel=1e-12)
    pins = {"crank": "crank.O", "rod": "rod.B"}
    plain = design.transmission_angle(sol, "A").angle
    np.testing.assert_allclose(design.transmission_angle(sol, "A", lines=pins).angle, plain)


@pytest.mark.parametrize("scale", SCALES)
def test_ratios_are_those_of_the_rates_of_all_coordinates(
    scale: tuple[float, float, float],
) -> None:
    sol = turned(*scale)
    rates = {"x": "vx", "y": "vy", "angle": "omega", "vx": "vx", "vy": "vy", "omega": "omega"}
    for name, rate in rates.items():
        found = design.velocity_ratio(sol, f"rod.{name}", "crank.angle")
        np.testing.assert_allclose(found, sol[f"rod.{rate}"] / sol["crank.omega"], rtol=1e-12)
    found = design.velocity_ratio(sol, "S.displacement", "O.angle")
    np.testing.assert_allclose(found, sol["piston.vx"] / sol["crank.omega"], rtol=1e-9)
