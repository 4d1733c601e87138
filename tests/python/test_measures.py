"""Measures: values, statistics with closed forms, units, files and errors."""

import csv
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.results import quantities
from kempe.results.dominant_frequency import dominant_frequency
from kempe.results.variable import TIME, Variable

SPEED = 2 * np.pi  # rad/s: one period a second


def shaker(**measures: str) -> kp.Model:
    """A block whose position is 0.02 + 0.3 sin(2π t)."""
    m = kp.Model("shaker", parameters={"area": "2 cm^2", "factor": 3})
    m.ground.points(O=(0, 0))
    m.body("block", mass=4, inertia=1, points={"C": (0, 0)})
    m.translational("slide", "ground.O", "block.C")
    m.coordinate_driver("motor", "block.x", value="0.02 + 0.3*sin(2*pi*t)")
    m.measures(**measures)
    return m


def oscillator(damping: float) -> kp.Model:
    """A mass of 2 kg on a spring of 800 N/m."""
    m = kp.Model("oscillator")
    m.ground.points(O=(-1, 0), S=(0, 0))
    m.body("mass", mass=2, inertia=1, points={"C": (0, 0)})
    m.translational("slide", "ground.S", "mass.C")
    m.spring_damper("s", "ground.O", "mass.C", stiffness=800, damping=damping, free_length=1)
    m.measures(x="mass.x", force="s.force", stored="s.energy")
    return m


@pytest.mark.parametrize("analysis", ["kinematics", "inverse_dynamics", "dynamics"])
def test_statistics_of_a_sine_are_those_of_the_closed_form(analysis: str) -> None:
    m = shaker(x="block.x", effort="motor.effort")
    run = getattr(kp, analysis)
    sol = run(m, kp.assemble(m), t_end=4, output_step=0.01)
    x = sol.measure("x")
    np.testing.assert_array_equal(sol["x"], sol["block.x"])
    assert x.max == pytest.approx(0.32, abs=1e-9)
    assert x.min == pytest.approx(-0.28, abs=1e-9)
    assert x.peak == x.max
    assert x.mean == pytest.approx(0.02, abs=1e-9)
    assert x.rms == pytest.approx(np.sqrt(0.02**2 + 0.3**2 / 2), abs=1e-9)
    assert x.final == pytest.approx(0.02, abs=1e-9)
    assert x.t_max % 1 == pytest.approx(0.25, abs=1e-5)
    assert x.t_min % 1 == pytest.approx(0.75, abs=1e-5)
    assert x.frequency == pytest.approx(1, rel=1e-9)
    assert np.isnan(x.settling)
    effort = sol.measure("effort")
    assert effort.max == pytest.approx(4 * 0.3 * SPEED**2, rel=1e-6)
    assert effort.mean == pytest.approx(0, abs=1e-9)
    assert effort.rms == pytest.approx(4 * 0.3 * SPEED**2 / np.sqrt(2), rel=1e-9)


def test_extremes_lie_between_the_outputs_too() -> None:
    m = shaker(x="block.x")
    sol = kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.1)
    x = sol.measure("x")
    assert np.abs(sol["x"]).max() < 0.31 < x.max
    assert (x.max, x.t_max) == pytest.approx((0.32, 0.25), abs=1e-5)


@pytest.mark.parametrize("analysis", ["kinematics", "inverse_dynamics", "dynamics"])
def test_integrals_do_not_depend_on_the_outputs(analysis: str) -> None:
    texts = {"x": "block.x", "effort": "motor.effort", "way": "abs(block.vx)"}
    m = shaker(**texts, high="if(block.x > 0.1, 1, 0)", motion="energy.kinetic")
    end = 0.7
    few, many = (
        getattr(kp, analysis)(m, kp.assemble(m), t_end=end, output_step=end / (n - 1))
        for n in (11, 1001)
    )
    for name in (*texts, "high", "motion"):
        one, other = few.measure(name), many.measure(name)
        for of in ("integral", "mean", "rms"):
            assert getattr(one, of) == pytest.approx(getattr(other, of), rel=1e-9), (name, of)
    sine, cosine = np.sin(SPEED * end), np.cos(SPEED * end)
    half = end / 2 - sine * cosine / (2 * SPEED)  # the integral of the square of the sine
    x = few.measure("x")
    integral = 0.02 * end + 0.3 * (1 - cosine) / SPEED
    square = 0.02**2 * end + 2 * 0.02 * 0.3 * (1 - cosine) / SPEED + 0.09 * half
    assert (x.integral, x.integral_unit) == (pytest.approx(integral, rel=1e-9), "m*s")
    assert x.mean == pytest.approx(integral / end, rel=1e-9)
    assert x.rms == pytest.approx(np.sqrt(square / end), rel=1e-9)
    way = few.measure("way")
    assert way.integral == pytest.approx(0.3 * (2 - sine), rel=1e-9)
    high = (np.pi - 2 * np.arcsin(0.08 / 0.3)) / SPEED
    assert few.measure("high").integral == pytest.approx(high, rel=1e-9)
    kinetic = 2 * (0.3 * SPEED) ** 2 * (end - half)
    assert few.measure("motion").integral == pytest.approx(kinetic, rel=1e-9)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("rate", [1e-2, 1.0, 1e2])
def test_a_bounce_costs_integrals_no_accuracy(size: float, rate: float) -> None:
    """A ball falls on ground and rises to a share of its height; its velocity jumps."""
    m = kp.Model("ball", gravity=(0, -2 * size * rate**2))
    m.body("ball", mass=2, inertia=size**2)
    m.stop("floor", "ball.y", lower=0, restitution=0.5)
    m.measures(v="ball.vy", speed="abs(ball.vy)", energy="energy.kinetic")
    method = kp.DOP853(rtol=1e-11, atol=1e-13 * size)
    # it falls for 1/rate and rises for 1/2 of that
    sol = kp.dynamics(
        m, kp.assemble(m, set={"ball.y": size}), t_end=1.5 / rate, method=method,
        output_step=0.7 / rate,
    )  # fmt: skip
    v, speed, energy = (sol.measure(name) for name in ("v", "speed", "energy"))
    assert v.integral == pytest.approx(-0.75 * size, rel=1e-8)
    assert speed.integral == pytest.approx(1.25 * size, rel=1e-8)
    # v² falls from 4 and 1 (size rate)²
    square = (4 / 3 + 1 / 6) * size**2 * rate
    assert v.rms == pytest.approx(np.sqrt(square * rate / 1.5), rel=1e-8)
    assert energy.integral == pytest.approx(square, rel=1e-8)


@pytest.mark.parametrize(
    ("unit", "over_time", "over_angle"),
    [
        ("N", "N*s", "N*rad"),
        ("m/s", "m", "m/s*rad"),
        ("m/s^2", "m/s", "m/s^2*rad"),
        ("W", "J", "J"),
        ("1", "s", "rad"),
        ("rad", "rad*s", "rad^2"),
        ("J/rad", "J/rad*s", "J"),
        ("m/s or rad/s", "m or rad", "m/s*rad or rad/s*rad"),
        ("SI", "SI", "SI"),
    ],
)
def test_the_unit_of_an_integral(unit: str, over_time: str, over_angle: str) -> None:
    assert TIME.integral(unit) == over_time
    assert Variable("crank.angle", "rad").integral(unit) == over_angle


def test_a_damped_oscillator_has_its_frequency_and_settling_time() -> None:
    m = oscillator(damping=4)
    sol = kp.dynamics(m, kp.assemble(m, set={"mass.x": 0.1}), t_end=20, output_step=0.01)
    x = sol.measure("x")
    # m = 2, c = 4, k = 800: σ = 1, ω² = 400 - 1
    omega = np.sqrt(399)
    assert x.frequency == pytest.approx(omega / (2 * np.pi), rel=1e-6)
    t = np.linspace(0, 20, 2_000_001)
    exact = 0.1 * np.exp(-t) * (np.cos(omega * t) + np.sin(omega * t) / omega)
    outside = t[np.abs(exact - exact[-1]) > 0.005 * np.abs(exact - exact[-1]).max()]
    assert x.settling == pytest.approx(outside[-1], abs=1e-4)
    assert x.final == pytest.approx(exact[-1], abs=1e-8)
    assert sol.measure("stored").max == pytest.approx(800 * 0.1**2 / 2, rel=1e-9)


def test_an_oscillation_of_an_energy_has_twice_the_frequency() -> None:
    m = oscillator(damping=0)
    sol = kp.dynamics(m, kp.assemble(m, set={"mass.x": 0.1}), t_end=4, output_step=0.005)
    assert sol.measure("stored").frequency == pytest.approx(2 * 20 / (2 * np.pi), rel=1e-6)
    assert sol.measure("stored").mean == pytest.approx(2, rel=0.02)


@pytest.mark.parametrize(
    ("series", "frequency"),
    [
        (lambda t: np.sin(2 * np.pi * 1.37 * t), 1.37),
        (lambda t: 3 + np.sin(2 * np.pi * 0.32 * t + 0.4), 0.32),
        (lambda t: 5 + np.exp(-0.7 * t) * np.cos(2 * np.pi * 2.1 * t), 2.1),
        (lambda t: t + np.sin(2 * np.pi * 1.7 * t), 1.7),
        (lambda t: np.sin(2 * np.pi * t) + 0.3 * np.sin(2 * np.pi * 3.3 * t), 1.0),
        (lambda t: np.abs(np.sin(2 * np.pi * 1.13 * t)), 2.26),
        (lambda t: 0 * t + 3, np.nan),
        (lambda t: np.exp(-t), np.nan),
        (lambda t: np.sin(2 * np.pi * 0.1 * t), np.nan),
    ],
)
def test_the_strongest_oscillation_is_found(series: object, frequency: float) -> None:
    t = np.linspace(0, 10, 1001)
    found = dominant_frequency(t, series(t))  # type: ignore[operator]
    assert found == pytest.approx(frequency, rel=2e-5, nan_ok=True)


def test_measures_of_a_whole_run_have_extremes_at_the_outputs() -> None:
    m = oscillator(damping=4)
    m.measures(lost="s.dissipated", all="energy.kinetic + energy.potential")
    sol = kp.dynamics(m, kp.assemble(m, set={"mass.x": 0.1}), t_end=5, output_step=0.01)
    lost, everything = sol.measure("lost"), sol.measure("all")
    assert (lost.min, lost.t_min, lost.t_max) == (0, 0, 5)
    assert lost.max == lost.final == pytest.approx(4 - everything.final, rel=1e-6)
    assert (everything.max, everything.t_max) == (pytest.approx(4), 0)
    assert (everything.min, everything.t_min) == (everything.values.min(), 5)


def test_expressions_use_parameters_tables_and_the_time() -> None:
    m = shaker(stress="motor.effort/area", late="step(t - 1)*factor", lift="lift(block.x)")
    m.table("lift", x=(-1, 1), y=(-2, 2), interpolation="linear")
    sol = kp.dynamics(m, kp.assemble(m), t_end=2, output_step=0.25)
    np.testing.assert_allclose(sol["stress"], sol["motor.effort"] / 2e-4, rtol=1e-14)
    np.testing.assert_array_equal(sol["late"][[0, -1]], [0, 3])
    np.testing.assert_allclose(sol["lift"], 2 * sol["block.x"], rtol=1e-14)
    units = {name: info.unit for name, info in sol.compiled.measures.items()}
    assert units == {"stress": "kg*m^-1*s^-2", "late": "SI", "lift": "SI"}


@pytest.mark.parametrize(
    ("expression", "unit"),
    [
        ("slide.force", "N"),
        ("abs(block.omega)", "rad/s"),
        ("motor.effort*block.vx", "W"),
        ("slide.torque", "N*m"),
        ("block.ax - 9.81", "m/s^2"),
        ("slide.force/motor.effort", "1"),
        ("energy.total", "J"),
        ("energy.balance", "1"),
        ("t", "s"),
        ("block.x/block.vx", "s"),
        ("2*block.angle", "rad"),
        ("factor*block.x", "SI"),
    ],
)
def test_the_unit_follows_from_the_quantities(expression: str, unit: str) -> None:
    assert shaker(m=expression).compile().measures["m"].unit == unit


@pytest.mark.parametrize("name", ["four_bar", "cam_roller", "planetary_gear", "motor_press"])
def test_every_quantity_can_be_measured(name: str) -> None:
    case = kp.load(ROOT / f"examples/{name}.toml")
    bare = case.run()[0]
    known = [one for one in quantities.names(bare) if "_on_" not in one and "lambda_" not in one]
    assert {"energy.balance", "drift.balance", "energy.work"} <= set(known)
    tree = case.tree()
    tree["measures"] = {f"m{k}": one for k, one in enumerate(known)}
    model = kp.Model.from_tree(tree)
    analyses = {k: v for k, v in tree["analyses"].items() if k == next(iter(tree["analyses"]))}
    sol = kp.Case(model, tree.get("start"), analyses).run()[0]
    for k, one in enumerate(known):
        # the core evaluates measures, and NumPy the views of bodies: the last bits may differ, by
        # what the terms of a sum are rounded to
        alike = [other for other in known if other.rpartition(".")[2] == one.rpartition(".")[2]]
        largest = max(float(np.abs(sol[other]).max()) for other in alike)
        rounding = 8 * np.finfo(float).eps * largest
        np.testing.assert_allclose(sol[f"m{k}"], sol[one], rtol=0, atol=rounding, err_msg=one)
        assert sol.compiled.measures[f"m{k}"].unit in (quantities.named(sol, one).unit, "SI"), one


def test_a_state_and_a_motion_have_measures() -> None:
    m = shaker(x="2*block.x", speed="abs(block.vx)")
    sol = kp.dynamics(m, kp.assemble(m), t_end=1)
    assert sol.final["x"] == pytest.approx(0.04, abs=1e-9)
    np.testing.assert_allclose(sol(np.array([0.25, 0.5]))["x"], [0.64, 0.04], atol=1e-6)
    assert "speed" in sol
    assert "speed" in sol._ipython_key_completions_()


def test_each_phase_has_its_parameters() -> None:
    m = shaker(scaled="factor*block.x")
    event = kp.Event("t - 0.5", action=lambda _: {"factor": 5})
    sol = kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.125, events={"later": event})
    factor = np.where(sol.t < 0.5, 3, 5)
    inside = sol.t != 0.5
    np.testing.assert_allclose(sol["scaled"][inside], (factor * sol["block.x"])[inside], rtol=1e-14)


def test_a_range_leaves_out_the_measures_of_the_replaced_driver() -> None:
    m = shaker(x="block.x", effort="motor.effort")
    sol = kp.kinematics(m, kp.assemble(m), over="block.x", range=(0, 1), n=11)
    assert sol.measure("x").mean == pytest.approx(0.5, abs=1e-12)


def test_files_keep_measures(tmp_path: Path) -> None:
    m = shaker(x="block.x", f="slide.force")
    case = kp.Case(m, analyses=[kp.Dynamics(t_end=1, output_step=0.1)])
    for suffix in ("toml", "json"):
        case.save(tmp_path / f"case.{suffix}")
        read = kp.load(tmp_path / f"case.{suffix}")
        assert read.tree() == case.tree()
        assert read.model.tree()["measures"] == {"x": "block.x", "f": "slide.force"}
    sol = read.run()[0]
    sol.save(tmp_path / "solution.npz")
    again = kp.load_solution(tmp_path / "solution.npz")
    np.testing.assert_array_equal(again["x"], sol["x"])
    sol.to_csv(tmp_path / "solution.csv")
    rows = list(csv.reader((tmp_path / "solution.csv").read_text().splitlines()))
    assert rows[0][-2:] == ["x [m]", "f [N]"]
    np.testing.assert_array_equal([float(row[-2]) for row in rows[1:]], sol["x"])


def test_the_summary_has_the_statistics() -> None:
    m = shaker(x="block.x")
    sol = kp.dynamics(m, kp.assemble(m), t_end=2, output_step=0.01)
    (found,) = sol.summary["measures"]
    assert (found["name"], found["expression"], found["unit"]) == ("x", "block.x", "m")
    assert found["max"] == sol.measure("x").max
    assert found["settling"] is None


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("slide.forc", "unknown name 'slide.forc'; did you mean 'slide.force'"),
        ("sldie.force", "did you mean 'slide.force'"),
        ("x*2", "a measure cannot use another one"),
        ("slide.force + block.x", "'slide.force' is in N .* but 'block.x' is in m"),
        ("sin(block.x)", "must be a number or an angle"),
        ("block.x > 1", "compar"),
    ],
)
def test_a_wrong_expression_is_an_error(expression: str, message: str) -> None:
    with pytest.raises(kp.ModelError, match=message) as caught:
        shaker(x="block.x", y=expression).compile()
    assert caught.value.problems[0].path == "measures.y"


def test_names_are_shared() -> None:
    m = shaker(x="block.x")
    for name in ("block", "slide", "motor", "x"):
        with pytest.raises(kp.ModelError, match="the name is taken"):
            m.measures({name: "block.x"})
    with pytest.raises(kp.ModelError, match=r"taken by measures\.x"):
        m.body("x", mass=1, inertia=1)
    with pytest.raises(kp.ModelError, match="reserved"):
        m.measures(t="block.x")
    with pytest.raises(kp.ModelError, match="not an expression"):
        m.measures(y=3)  # type: ignore[arg-type]
    assert m.measures() == {"x": "block.x"}


def test_an_unknown_measure_has_a_suggestion() -> None:
    m = shaker(travel="block.x")
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.1)
    with pytest.raises(kp.ModelError, match="unknown measure 'travle'; did you mean 'travel'"):
        sol.measure("travle")


def test_an_expression_without_a_value_is_an_error() -> None:
    m = shaker(root="sqrt(block.x - 1)")
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.1)
    with pytest.raises(kp.ModelError, match="the measure has no value there"):
        _ = sol["root"]
