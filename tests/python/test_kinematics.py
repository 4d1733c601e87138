"""Driven motions without integration: closed forms, limits, and the refusals."""

import json
from pathlib import Path
from typing import Literal

import kempe as kp
import numpy as np
import pytest

R, L = 0.1, 0.3


def slider_crank(speed: float = 3.0) -> kp.Model:
    """A crank of 0.1 m, a rod of 0.3 m and a piston on a line through the shaft."""
    m = kp.Model("slider-crank", gravity=(0.0, -9.81), parameters={"speed": speed})
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=0.5, length=R, ends=("O", "A"))
    m.bar("rod", mass=0.8, length=L, ends=("A", "B"))
    m.body("piston", mass=1.2, inertia=0.01, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "piston.B")
    m.translational("S", "ground.O", "piston.B", axes=(0, 0))
    m.coordinate_driver("motor", "crank.angle", value="0.2 + speed*t")
    return m


def piston(angle: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Position of the piston and its derivatives by the angle of the crank."""
    sin, cos = np.sin(angle), np.cos(angle)
    root = np.sqrt(L**2 - (R * sin) ** 2)
    x = R * cos + root
    first = -R * sin - R**2 * sin * cos / root
    second = -R * cos - R**2 * (cos**2 - sin**2) / root - R**4 * (sin * cos) ** 2 / root**3
    return x, first, second


def started(m: kp.Model) -> kp.State:
    return kp.assemble(m, guess={"piston.x": 0.4})


def test_positions_velocities_and_accelerations_over_time() -> None:
    m = slider_crank()
    sol = kp.kinematics(m, started(m), t_end=4.0, output_step=0.1)
    assert sol.t == pytest.approx(np.arange(41) * 0.1, abs=1e-15)
    x, first, second = piston(0.2 + 3 * sol.t)
    assert sol["piston.x"] == pytest.approx(x, abs=1e-13)
    assert sol["piston.vx"] == pytest.approx(3 * first, abs=1e-12)
    assert sol["piston.ax"] == pytest.approx(9 * second, abs=1e-11)
    between = sol(0.1234)
    assert between["piston.x"] == pytest.approx(piston(0.2 + 3 * np.array(0.1234))[0], abs=1e-12)


def test_over_a_driver_the_value_takes_the_place_of_the_time() -> None:
    m = slider_crank()
    values = np.linspace(1.0, -5.0, 7)
    for over in ("motor", "crank.angle"):
        sol = kp.kinematics(m, started(m), over=over, range=(1.0, -5.0), n=7)
        assert sol.t == pytest.approx(values, abs=1e-15)
        assert sol["crank.angle"] == pytest.approx(values, abs=1e-13)
        assert sol["crank.omega"] == pytest.approx(np.ones(7), abs=1e-13)
        x, first, second = piston(values)
        assert sol["piston.x"] == pytest.approx(x, abs=1e-13)
        assert sol["piston.vx"] == pytest.approx(first, abs=1e-12)
        assert sol["piston.ax"] == pytest.approx(second, abs=1e-11)


def test_over_a_quantity_without_a_driver() -> None:
    m = kp.Model("cylinder")
    m.ground.points(O=(0, 0), Q=(0.6, -0.8))
    m.bar("boom", mass=10, length=2, ends=("O", "T"), points={"C": (-0.2, 0)})
    m.revolute("O", "ground.O", "boom.O")
    m.spring_damper("cylinder", "ground.Q", "boom.C", stiffness=0)
    start = kp.assemble(m, guess={"boom.angle": 0.3})
    sol = kp.kinematics(m, start, over="cylinder.length", range=(0.9, 1.2), n=4)
    assert sol["cylinder.length"] == pytest.approx(np.linspace(0.9, 1.2, 4), abs=1e-12)
    # the law of cosines at O: sides 1 m and 0.8 m
    inner = np.arccos((1 + 0.64 - sol.t**2) / 1.6)
    assert sol["boom.angle"] == pytest.approx(inner - np.arctan2(0.8, 0.6), abs=1e-12)


def test_the_length_of_a_distance_joint_is_driven_by_its_law() -> None:
    m = kp.Model("boom", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), Q=(0.6, -0.8))
    m.bar("boom", mass=10, length=2, ends=("O", "T"), points={"C": (-0.2, 0)})
    m.revolute("O", "ground.O", "boom.O")
    m.distance("cylinder", "ground.Q", "boom.C", length="1 + 0.1*t")
    start = kp.assemble(m, guess={"boom.angle": 0.3})
    sol = kp.inverse_dynamics(m, start, over="cylinder.length", range=(1.0, 1.1), n=3)
    assert sol["cylinder.length"] == pytest.approx([1.0, 1.05, 1.1], abs=1e-12)


def test_efforts_are_those_of_forward_dynamics() -> None:
    m = slider_crank(speed=20.0)
    start = started(m)
    inverse = kp.inverse_dynamics(m, start, t_end=0.5, output_step=0.01)
    forward = kp.dynamics(m, start, t_end=0.5, output_step=0.01, method=kp.DOP853(rtol=1e-11))
    for name in ("motor.effort", "motor.power", "A.force", "B.fx", "S.torque", "O.fy"):
        scale = np.abs(forward[name]).max()
        assert inverse[name] == pytest.approx(forward[name], abs=1e-8 * scale), name
    work = forward.energy.work
    assert inverse.energy.work == pytest.approx(work, abs=1e-8 * np.abs(work).max())
    assert np.abs(inverse.energy.balance).max() < 1e-10 * inverse.energy.kinetic.max()


def test_a_limit_has_its_value_and_the_motion_before() -> None:
    m = slider_crank()
    with pytest.raises(kp.SingularityError, match="dead point, crank and rod in line") as caught:
        kp.kinematics(m, started(m), over="S.displacement", range=(0.38, 0.5), n=13)
    assert caught.value.value == pytest.approx(R + L, abs=1e-12)
    assert caught.value.solution.t[-1] == pytest.approx(0.40, abs=0.011)
    with pytest.raises(kp.SingularityError, match="in line") as caught:
        kp.kinematics(m, started(m), over="S.displacement", range=(0.38, 0.1), n=13)
    assert caught.value.value == pytest.approx(L - R, abs=1e-12)


def test_in_a_case(tmp_path: Path) -> None:
    m = slider_crank()
    case = kp.Case(
        m,
        {"guess": {"piston.x": 0.4}},
        [
            kp.Kinematics(over="motor", range=(0.2, 2.2), n=3, name="sweep"),
            kp.InverseDynamics(t_end=1, output_step=0.5, after="start", name="turn"),
        ],
    )
    case.save(tmp_path / "case.toml")
    results = kp.load(tmp_path / "case.toml").run()
    assert results["sweep"]["crank.angle"] == pytest.approx([0.2, 1.2, 2.2], abs=1e-13)
    assert results["turn"]["crank.angle"] == pytest.approx([0.2, 1.7, 3.2], abs=1e-13)
    results["turn"].save(tmp_path / "turn.npz")
    again = kp.load_solution(tmp_path / "turn.npz")
    assert again["motor.effort"] == pytest.approx(results["turn"]["motor.effort"], rel=1e-12)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({}, "t_end: missing"),
        ({"over": "motor"}, "range: missing"),
        ({"range": (0, 1)}, "over: missing"),
        ({"over": "motor", "range": (0, 1), "t_end": 3}, "not together|excludes"),
        ({"over": "motor", "range": (0, 1), "n": 1}, "whole number from 2"),
        ({"t_end": -1}, "lies before"),
        ({"t_end": 1, "output_step": 0}, "output_step"),
        ({"over": "crank.mass", "range": (0, 1)}, "over: there is no quantity .crank.mass."),
    ],
)
def test_impossible_options_are_refused(options: dict[str, object], message: str) -> None:
    m = slider_crank()
    with pytest.raises(kp.ModelError, match=message):
        kp.kinematics(m, started(m), **options)  # type: ignore[arg-type]


def test_a_mechanism_with_a_freedom_is_refused_with_the_remedy() -> None:
    m = kp.Model("pendulum")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    with pytest.raises(kp.ModelError, match=r"leave 1 degree of freedom.*coordinate_driver"):
        kp.kinematics(m, kp.assemble(m), t_end=1)
    m.coordinate_driver("motor", "rod.angle", value="t")
    assert kp.kinematics(m, kp.assemble(m), t_end=1)["rod.angle"][-1] == pytest.approx(1)


def test_states_of_forces_do_not_follow_from_the_motion() -> None:
    m = slider_crank()
    m.motor("dc", "crank", voltage=12, resistance=1, inductance=0.1, torque_constant=0.5)
    with pytest.raises(kp.ModelError, match="dc: its states do not follow"):
        kp.inverse_dynamics(m, started(m), t_end=1)


def test_the_analyses_of_a_type_with_those_they_start_from() -> None:
    kinematics = {"type": "kinematics", "t_end": 1}
    entries = {
        "first": {"type": "dynamics", "t_end": 1},
        "second": kinematics,
        "third": {"type": "dynamics", "t_end": 3},
        "other": kinematics | {"from": "start"},
    }
    case = kp.Case(slider_crank(), {"guess": {"piston.x": 0.4}}, entries)
    assert list(case.of_type("kinematics").analyses) == ["first", "second", "other"]
    assert list(case.of_type("dynamics").analyses) == ["first", "second", "third"]
    with pytest.raises(kp.ModelError, match=r"type inverse_dynamics.*t_end: missing"):
        case.of_type("inverse_dynamics")
    added = case.of_type("inverse_dynamics", {"t_end": 2}).analyses
    assert added == {"inverse_dynamics": {"type": "inverse_dynamics", "t_end": 2, "from": "start"}}


def test_on_the_command_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from kempe.cli import app

    monkeypatch.chdir(tmp_path)
    turn = kp.InverseDynamics(t_end=2, output_step=0.5, name="turn")
    fall = kp.Dynamics(t_end=0.1, after="start", name="fall")
    kp.Case(slider_crank(), {"guess": {"piston.x": 0.4}}, [turn, fall]).save("crank.toml")
    assert app.run(["inverse_dynamics", "crank.toml", "-q", "--figures", "none"]) == 0
    written = np.genfromtxt("out/crank/solution.csv", delimiter=",", names=True)
    assert len(written) == 5
    assert app.run(["kinematics", "crank.toml", "-q"]) != 0
    options = ["-q", "--figures", "none", "-o", "added"]
    assert app.run(["kinematics", "crank.toml", "--t-end", "0.5", *options]) == 0
    added = np.genfromtxt("added/solution.csv", delimiter=",", names=True)
    assert [added["t_s"][0], added["t_s"][-1]] == [0, 0.5]
    # the method belongs to the simulation only
    assert app.run(["run", "crank.toml", "--method", "rk4", "--step", "0.01", *options]) == 0
    fall = json.loads(Path("added/fall/summary.json").read_text(encoding="utf-8"))
    assert fall["statistics"]["method"] == "rk4"


def test_a_linkage_with_two_drivers_for_one_freedom() -> None:
    """The sum of both efforts is that of one driver; which part each has is not determined."""
    length = 0.3

    def parallelogram(redundancy: Literal["refuse", "allow"]) -> kp.Model:
        m = kp.Model("parallelogram", redundancy=redundancy)
        m.ground.points(A=(0, 0), D=(1, 0))
        m.bar("crank", mass=2, length=length, ends=("A", "B"))
        m.bar("coupler", mass=5, length=1, ends=("B", "C"))
        m.bar("rocker", mass=3, length=length, ends=("D", "C"))
        m.revolute("A", "ground.A", "crank.A")
        m.revolute("B", "crank.B", "coupler.B")
        m.revolute("C", "coupler.C", "rocker.C")
        m.revolute("D", "ground.D", "rocker.D")
        for name in ("crank", "rocker"):
            m.coordinate_driver(f"{name}_motor", f"{name}.angle", value="1 + t + 0.5*t^2")
        return m

    guess = {"crank.angle": 1.0, "rocker.angle": 1.0}
    with pytest.raises(kp.RedundancyError, match="crank_motor, rocker_motor") as caught:
        kp.assemble(parallelogram("refuse"), guess=guess)
    assert "1 of their equations adds nothing" in str(caught.value)
    m = parallelogram("allow")
    start = kp.assemble(m, guess=guess)
    sol = kp.inverse_dynamics(m, start, t_end=1, output_step=0.1)
    assert np.allclose(sol["rocker.angle"], 1 + sol.t + 0.5 * sol.t**2, atol=1e-12)
    total = sol["crank_motor.effort"] + sol["rocker_motor.effort"]
    assert np.allclose(total, (2 / 3 + 5 + 3 / 3) * length**2, rtol=1e-9)
    assert not sol["crank_motor"].unique
    assert not sol["rocker_motor"].unique


def test_too_many_outputs_are_refused() -> None:
    m = slider_crank()
    with pytest.raises(kp.ModelError, match=r"output_step: .*at least 1e-6 of the time"):
        kp.kinematics(m, started(m), t_end=1.0, output_step=1e-7)
