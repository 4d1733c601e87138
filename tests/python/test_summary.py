"""Every number of a summary, on three mechanisms, from the solution or by hand."""

import json

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.report import summary
from kempe.results.extremes import Sampled
from kempe.results.settling import settling
from kempe.results.summary import _turning_by_violation, residual
from python.test_design_scales import SCALES, turned

#: Times at which a motion is sampled.
STEPS = 4001


@pytest.fixture(scope="module", params=["four_bar", "slider_crank", "six_bar"])
def sol(request: pytest.FixtureRequest) -> kp.Solution:
    case = kp.load(ROOT / "examples" / f"{request.param}.toml")
    return case.with_analysis(next(iter(case.analyses)), t_end=1.0, output_step=0.01).run()[0]


@pytest.fixture(scope="module")
def told(sol: kp.Solution) -> dict:
    return json.loads(json.dumps(summary(sol)))


def test_the_head_of_a_summary(sol: kp.Solution, told: dict) -> None:
    assert told["time"] == {"start": 0.0, "end": 1.0, "outputs": 101}
    assert told["title"] == sol.model.title
    assert (told["success"], told["message"]) == (True, sol.message)
    assert told["statistics"] == {k: v for k, v in sol.statistics.items() if k != "singular"}
    assert {"steps", "rejected", "method"} <= told["statistics"].keys()
    model = sol.model
    assert told["mechanism"] == {
        "bodies": list(model.bodies),
        "joints": list(model.joints),
        "drivers": list(model.drivers),
        "forces": list(model.forces),
        "coordinates": 3 * len(model.bodies),
        "equations": 2 * len(model.joints) + len(model.drivers),
        "degrees_of_freedom": 0 if model.drivers else 1,
    }
    for key, k in (("start", 0), ("end", -1)):
        assert told[key] == (sol.initial, sol.final)[k].coordinates()
        for name in model.bodies:
            for quantity in ("x", "y", "angle", "vx", "vy", "omega"):
                if f"{name}.{quantity}" in told[key]:
                    expected = sol[f"{name}.{quantity}"][k]
                    assert told[key][f"{name}.{quantity}"] == pytest.approx(expected, abs=1e-12)


def test_a_later_start_is_reported(sol: kp.Solution) -> None:
    start = kp.assemble(sol.model, from_state=sol.final)
    found = summary(kp.dynamics(sol.model, start, t_end=1.25))
    assert (found["time"]["start"], found["time"]["end"]) == (1.0, 1.25)


def test_peaks_are_the_largest_values_at_many_times(sol: kp.Solution, told: dict) -> None:
    times = np.linspace(0.0, 1.0, STEPS)
    fine = sol(times)
    entries = told["peaks"]["reactions"] + told["peaks"]["forces"]
    assert [e.get("joint") or e["name"] for e in entries] == [
        *sol.model.constraints,
        *sol.model.forces,
    ]
    for entry in entries:
        name = entry.get("joint") or entry["name"]
        view = fine[name]
        assert entry["on"] == view.info.j
        size = np.hypot(*view.force(on=entry["on"]).T)
        torque = view.torque(on=entry["on"])
        for key, values in (("force", size), ("torque", torque)):
            k = int(np.abs(values).argmax())
            assert entry[key] == pytest.approx(values[k], rel=1e-4, abs=1e-9)
            there = sol(np.array([entry[f"{key}_at"]]))[name]
            on = there.torque(on=entry["on"])
            again = np.hypot(*there.force(on=entry["on"]).T) if key == "force" else on
            assert entry[key] == pytest.approx(float(again[0]), rel=1e-6, abs=1e-9)
        for part, value in entry.get("torque_by_part", {}).items():
            values = view.torque(on=entry["on"], part=part)
            expected = values[int(np.abs(values).argmax())]
            assert value == pytest.approx(expected, rel=1e-4, abs=1e-9)


def test_negative_peaks_keep_their_sign() -> None:
    """At rest at 10° from its free angle a spring of 50 N·m/rad pulls back with 8.727 N·m."""
    for side in (1.0, -1.0):
        m = kp.Model()
        m.ground.points(O=(0, 0))
        m.bar("rod", mass=1, length=1, ends=("O", "P"))
        m.revolute("O", "ground.O", "rod.O")
        m.torsion_spring("s", "ground", "rod", stiffness=50, damping=8)
        start = kp.assemble(m, set={"rod.angle": side * np.pi / 18})
        found = summary(kp.dynamics(m, start, t_end=0.5))["peaks"]["forces"][0]
        assert found["torque"] == pytest.approx(-side * 50 * np.pi / 18, rel=1e-9)
        assert found["torque_by_part"]["stiffness"] == pytest.approx(found["torque"])
        assert side * found["torque_by_part"]["damping"] > 0.0


def test_energies_follow_from_the_motion(sol: kp.Solution, told: dict) -> None:
    """T by its definition, the dissipated energy ∫ c ω² dt, and the work ∫ T ω dt of a motor."""
    times = np.linspace(0.0, 1.0, STEPS)
    fine = sol(times)
    kinetic = np.zeros(STEPS)
    for name, body in sol.model.bodies.items():
        view = fine.body(name)
        kinetic += 0.5 * body.mass * (np.asarray(view.at(body.center).velocity) ** 2).sum(axis=1)
        kinetic += 0.5 * body.inertia * np.asarray(view.omega) ** 2
    energy = told["energy"]
    assert energy["largest_kinetic"] == pytest.approx(kinetic.max(), rel=1e-5)
    assert energy["largest_kinetic_at"] == pytest.approx(times[kinetic.argmax()], abs=1e-3)
    lost = sum(
        np.trapezoid(-view.damping_torque(on=name) * fine.body(name).omega, times)
        for view, name in ((fine.force(f), fine.force(f).info.j) for f in sol.model.forces)
    )
    assert energy["dissipated"] == pytest.approx(float(lost), rel=1e-4, abs=1e-9)
    work = sum(
        np.trapezoid(fine.driver(d).torque(on="crank") * fine.body("crank").omega, times)
        for d in sol.model.drivers
    )
    assert energy["work"] == pytest.approx(float(work), rel=1e-4, abs=1e-9)
    assert energy["scale"] == sol.energy.scale
    assert energy["largest_imbalance"] == np.abs(sol.energy.balance).max()
    assert (energy["dissipated"] > 1e-3) == bool(sol.model.forces)
    assert (abs(energy["work"]) > 1e-3) == bool(sol.model.drivers)


def test_the_residual_is_that_of_its_equation(sol: kp.Solution, told: dict) -> None:
    found = told["peaks"]["residual"]
    k = int(np.abs(sol.t - found["at"]).argmin())
    motion = sol if abs(sol.t[k] - found["at"]) < 1e-14 else sol(np.array([found["at"]]))
    joint, _, equation = found["equation"].partition(".lambda_")
    if not equation:
        joint, _, equation = found["equation"].rpartition(".")
    view = motion.constraint(joint)
    names = [name for name, _ in view.info.equations]
    row = names.index(equation)
    values = np.abs(np.asarray(view.residual)[:, row])
    here = values[k] if motion is sol else values[0]
    assert found["value"] == pytest.approx(float(here), rel=1e-2, abs=1e-12)
    assert found["unit"] == view.info.equations[row][1] == ("rad" if equation == "angle" else "m")
    assert found["value"] >= sol.drift.position.max()
    assert told["peaks"]["residual_rate"] >= sol.drift.velocity.max()


def test_the_unit_of_an_angle_in_the_residual() -> None:
    """A slide whose body is turned by 0.01 rad and not shifted: Φ of its angle is the largest."""
    m = kp.Model()
    m.ground.points(O=(0, 0))
    m.body("slider", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slider.P", axes=(0, 0))
    start = kp.assemble(m, set={"slider.x": 0.5})
    sol = kp.dynamics(m, start, t_end=0.1, output_step=0.05)
    opened = kp.results.motion.Motion(m, sol.t, sol.q + np.array([0, 0, 0.01]), sol.v)
    sampled = Sampled(sol)
    sampled.solution, sampled.steps = opened, opened  # type: ignore[assignment]
    found = residual(sampled)
    assert found is not None
    assert (found["unit"], found["at"]) == ("rad", 0.0)
    assert found["value"] == pytest.approx(0.01)


def test_settling_of_a_run_backwards_and_of_angles(sol: kp.Solution, told: dict) -> None:
    for entry in told["settling"]:
        assert entry["angle"] == sol.body(entry["body"]).angle[-1]
        assert entry["moves"] == (np.ptp(sol.body(entry["body"]).angle) > 1e-6)
    t = np.linspace(0.0, -10.0, 2001)
    found = settling(t, np.exp(2 * t))
    assert found.time == pytest.approx(-np.log(200) / 2, abs=5e-3)


@pytest.mark.parametrize(("stop", "settles"), [(0.8, True), (0.95, False)])
@pytest.mark.parametrize("begin", [0.0, 100.0])
def test_a_motion_has_settled_if_it_is_quiet_for_a_tenth_of_the_time(
    stop: float, settles: bool, begin: float
) -> None:
    """It falls evenly until 0.8 or 0.95 of the time; it is in the band at 0.995 of that."""
    t = np.linspace(0.0, 10.0, 5001)
    found = settling(begin + t, 3.0 + np.maximum(1.0 - t / (10.0 * stop), 0.0))
    assert found.moves
    expected = pytest.approx(begin + 9.95 * stop, abs=2.1e-3) if settles else None
    assert found.time == expected


def test_an_open_joint_may_turn_a_body_that_does_not_move() -> None:
    """A gap of 1 mm on a mechanism of 0.4 m turns a body by up to 2 · 0.001 / 0.4 = 0.005 rad."""
    m = kp.Model()
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=0.4, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    sol = kp.dynamics(m, kp.assemble(m, set={"rod.angle": 0}), t_end=0.1)

    class Opened:
        compiled = sol.compiled
        drift = type("D", (), {"position": np.array([0.0, 1e-3])})

    sampled = Sampled(sol)
    sampled.solution = Opened()  # type: ignore[assignment]
    assert _turning_by_violation(sampled) == pytest.approx(0.005)


@pytest.mark.parametrize("value", [0.0, 3.0, 1e9])
def test_a_constant_does_not_settle(value: float) -> None:
    t = np.linspace(0.0, 1.0, 11)
    for ripple, moves in ((0.0, False), (0.5e-12, False), (1e-9, True)):
        values = value + ripple * max(1.0, value) * (t > 0.5)
        assert settling(t, values).moves == moves


def test_a_body_at_rest_has_its_angle() -> None:
    """A slider on a rail at 0.5 rad cannot turn; its angle is that of the rail."""
    m = kp.Model(gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("slider", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slider.P", axes=(0.5, 0))
    sol = kp.dynamics(m, kp.assemble(m, set={"slider.x": 0.2}), t_end=0.3)
    found = summary(sol)["settling"][0]
    assert found == {"body": "slider", "moves": False, "time": None, "angle": pytest.approx(0.5)}


@pytest.mark.parametrize("scale", SCALES)
def test_a_summary_is_the_same_in_other_units(scale: tuple[float, float, float]) -> None:
    mass, size, time = scale
    force, energy = mass * size / time**2, mass * size**2 / time**2
    one, other = summary(turned()), summary(turned(*scale))
    assert one["settling"] == other["settling"] == []
    assert one["mechanism"] == other["mechanism"]
    factors = {"force": force, "torque": energy, "force_at": time, "torque_at": time}
    assert [entry["joint"] for entry in one["peaks"]["reactions"]] == ["O", "A", "B", "S", "motor"]
    for a, b in zip(one["peaks"]["reactions"], other["peaks"]["reactions"], strict=True):
        assert {key: a[key] for key in a if key not in factors} == {
            key: b[key] for key in b if key not in factors
        }
        for key, factor in factors.items():
            assert b[key] == pytest.approx(a[key] * factor, rel=1e-6, abs=1e-9 * factor), key
        assert a["torque"] or a["torque_at"] == 0.0
        # pins carry no torque, not even that of a rounding error
        assert (a["torque"] != 0.0) == (b["torque"] != 0.0) == (a["joint"] == "motor")
    factors = {"largest_kinetic": energy, "work": energy, "scale": energy, "dissipated": energy}
    for key, factor in (factors | {"largest_kinetic_at": time}).items():
        expected = one["energy"][key] * factor
        assert other["energy"][key] == pytest.approx(expected, rel=1e-7, abs=1e-9 * factor), key
    assert other["energy"]["largest_imbalance"] < 1e-8


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1.0, 1e3, 1e9])
def test_bodies_settle_that_no_driver_holds(size: float) -> None:
    """A driven crank, a pendulum on its pin, and a slide that the crank moves by a rod."""
    m = kp.Model("crank and pendulum", gravity=(0, -9.81 * size))
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=0.2 * size, ends=("O", "A"))
    m.bar("rod", mass=1, length=0.5 * size, ends=("A", "B"))
    m.body("slide", mass=1, inertia=size**2, points={"B": (0, 0)})
    m.bar("swing", mass=1, length=0.3 * size, ends=("A", "E"))
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("C", "crank.A", "swing.A")
    m.revolute("B", "rod.B", "slide.B")
    m.translational("S", "ground.O", "slide.B", axes=(0, 0))
    m.coordinate_driver("motor", "crank.angle", value="2*t")
    guess = {"slide.x": 0.6 * size, "crank.angle": 0.0}
    start = kp.assemble(m, set={"swing.angle": -1.0}, guess=guess)
    found = summary(kp.dynamics(m, start, t_end=0.1))
    assert [entry["body"] for entry in found["settling"]] == ["swing"]
    tree = m.tree()
    del tree["drivers"]
    free = kp.Model.from_tree(tree)
    start = kp.assemble(free, set={"swing.angle": -1.0}, guess=guess)
    names = [entry["body"] for entry in summary(kp.dynamics(free, start, t_end=0.1))["settling"]]
    assert names == list(free.bodies)
