"""Peaks and settling times are those of the motion, not of the outputs."""

import math
from collections.abc import Callable

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.report import summary
from kempe.results.extremes import Sampled
from kempe.results.motion import Motion
from kempe.results.settling import settling


def run(name: str, output_step: float | None) -> kp.Solution:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    sol = case.with_analysis(next(iter(case.analyses)), output_step=output_step, t_end=3).run()[0]
    assert sol.success
    return sol


@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "six_bar", "pendulum"])
def test_peaks_do_not_depend_on_the_outputs(name: str) -> None:
    coarse, fine = summary(run(name, 0.5)), summary(run(name, 0.01))
    for one, other in zip(
        coarse["peaks"]["reactions"] + coarse["peaks"]["forces"],
        fine["peaks"]["reactions"] + fine["peaks"]["forces"],
        strict=True,
    ):
        assert one["force"] == pytest.approx(other["force"], rel=1e-6, abs=1e-6)
        assert abs(one["torque"]) == pytest.approx(abs(other["torque"]), rel=1e-6, abs=1e-6)
    for key in ("largest_kinetic", "largest_kinetic_at"):
        assert coarse["energy"][key] == pytest.approx(fine["energy"][key], rel=1e-5)
    for one, other in zip(coarse["settling"], fine["settling"], strict=True):
        assert (one["time"] or 0.0) == pytest.approx(other["time"] or 0.0, rel=1e-7)


QUANTITIES: list[tuple[str, str, Callable[[Motion], np.ndarray]]] = [
    ("four_bar", "C", lambda m: np.linalg.norm(m.joint("C").force(on="rocker"), axis=1)),
    ("four_bar", "damping", lambda m: m.force("spring").damping_torque(on="rocker")),
    ("four_bar", "omega", lambda m: m.body("crank").omega),
    ("slider_crank", "piston", lambda m: m.body(list(m.model.bodies)[-1]).ax),
    ("six_bar", "D", lambda m: np.linalg.norm(m["D"].force(on=m["D"].info.j), axis=1)),
]


@pytest.mark.parametrize(
    ("name", "_", "read"), QUANTITIES, ids=lambda v: v if type(v) is str else ""
)
def test_a_peak_is_that_of_a_million_samples(
    name: str, _: str, read: Callable[[Motion], np.ndarray]
) -> None:
    sol = run(name, 0.1)
    found = Sampled(sol).peak(read)
    times = np.linspace(sol.t[0], sol.t[-1], 100_001)
    coarse = np.abs(read(sol(times)))
    near = np.linspace(*times[np.clip(coarse.argmax() + np.array([-1, 1]), 0, 100_000)], 20_001)
    values = read(sol(near))
    k = np.abs(values).argmax()
    assert found.value == pytest.approx(values[k], rel=1e-7)
    assert read(sol(np.array([found.t])))[0] == found.value
    assert abs(found.value) >= abs(values[k]) * (1 - 1e-9)
    assert abs(found.value) >= np.abs(read(sol)).max()


def test_the_peak_of_a_pendulum_is_the_closed_form() -> None:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1.5, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    start = kp.assemble(m, set={"rod.angle": 0})
    sol = kp.dynamics(m, start, t_end=1.1, output_step=0.25, method=kp.DOP853(rtol=1e-10))
    found = summary(sol)
    # From rest at the height of the pin: at the bottom m g + m ω² L/2 with ω² = 3 g/L, so 5/2 m g.
    reaction = found["peaks"]["reactions"][0]
    assert reaction["force"] == pytest.approx(2.5 * 2 * 9.81, rel=1e-8)
    assert found["energy"]["largest_kinetic"] == pytest.approx(2 * 9.81 * 0.75, rel=1e-8)
    quarter = math.sqrt(2 * 1.5 / (3 * 9.81)) * 1.8540746773013719  # K(sin 45°)
    assert reaction["force_at"] == pytest.approx(quarter, abs=1e-5)
    assert found["energy"]["largest_kinetic_at"] == pytest.approx(quarter, abs=1e-5)


def test_a_settling_time_is_the_closed_form() -> None:
    m = kp.Model("wheel")
    m.ground.points(A=(0, 0))
    m.body("wheel", mass=1, inertia=2, points={"A": (0, 0)})
    m.revolute("A", "ground.A", "wheel.A")
    m.torsion_spring("brake", "ground", "wheel", stiffness=0, damping=4)
    start = kp.assemble(m, set={"wheel.angle": 0, "wheel.omega": 3})
    sol = kp.dynamics(m, start, t_end=20, output_step=2, method=kp.DOP853(rtol=1e-11))
    assert summary(sol)["settling"][0]["time"] == pytest.approx(math.log(200) / 2, rel=1e-6)


def test_the_time_of_entry_is_found_between_samples() -> None:
    t = np.linspace(0, 10, 21)
    found = settling(t, np.exp(-2 * t), between=lambda at: np.exp(-2 * at))
    assert found.time == pytest.approx(-math.log(0.005 + 0.995 * math.exp(-20)) / 2, rel=1e-9)
    assert settling(t, np.exp(-2 * t)).time == 3.0


def test_a_run_that_ends_before_it_begins_is_refused(model: kp.Model, start: kp.State) -> None:
    with pytest.raises(kp.ModelError, match="t_end"):
        kp.dynamics(model, start, t_end=-0.5, output_step=0.1)


def test_without_an_interpolant_peaks_are_those_of_the_outputs(
    model: kp.Model, start: kp.State
) -> None:
    sol = kp.dynamics(model, start, t_end=1, output_step=0.1, dense_output=False)
    force = np.linalg.norm(sol["C"].force(on="rocker"), axis=1)
    found = next(r for r in summary(sol)["peaks"]["reactions"] if r["joint"] == "C")
    assert (found["force"], found["force_at"]) == (force.max(), sol.t[force.argmax()])


@pytest.mark.parametrize("stabilization", [kp.Projection(), kp.Baumgarte(10, 200)])
def test_the_residual_is_that_of_the_states(
    model: kp.Model, start: kp.State, stabilization
) -> None:
    sol = kp.dynamics(
        model, start, t_end=1, output_step=0.25, method=kp.RK45(), stabilization=stabilization
    )
    fine = kp.dynamics(model, start, t_end=1, method=kp.RK45(), stabilization=stabilization)
    peaks = summary(sol)["peaks"]
    assert peaks["residual"]["value"] == pytest.approx(
        fine.drift.position.max(), rel=1e-3, abs=1e-11
    )
    assert peaks["residual_rate"] == pytest.approx(fine.drift.velocity.max(), rel=1e-3, abs=1e-9)


def test_a_coupler_that_only_translates_does_not_turn() -> None:
    m = kp.Model("parallel", gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(4, 0))
    m.bar("left", mass=1, length=2, ends=("A", "B"))
    m.bar("coupler", mass=1, length=4, ends=("B", "C"))
    m.bar("right", mass=1, length=2, ends=("C", "D"))
    for name, i, j in [("A", "ground", "left"), ("B", "left", "coupler")]:
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    m.revolute("C", "coupler.C", "right.C")
    m.revolute("D", "right.D", "ground.D")
    start = kp.assemble(m, set={"left.angle": "60*deg"}, guess={"coupler.angle": 0})
    for stabilization in (kp.Projection(), kp.Baumgarte(10, 200)):
        sol = kp.dynamics(m, start, t_end=0.5, method=kp.RK45(), stabilization=stabilization)
        left, coupler, _ = summary(sol)["settling"]
        assert coupler == {"body": "coupler", "moves": False, "time": None, "angle": 0.0}
        assert left["moves"]
