"""Pin loads, free bodies and load cases against formulas by hand, and their balance."""

from dataclasses import replace
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe import design
from kempe.design.wrenches import imbalance, inertia, loads
from python.test_design_dynamics import J2, M2, SPEED, G, by_hand
from python.test_kinematics import R, piston, slider_crank, started
from scipy.integrate import quad


@pytest.fixture(scope="module")
def turn() -> kp.Solution:
    m = slider_crank(speed=SPEED)
    return kp.inverse_dynamics(m, started(m), t_end=f"2*pi/{SPEED}", output_step=0.005)


def test_a_pin_load_is_in_the_frame_of_the_body(turn: kp.Solution) -> None:
    found = design.pin_load(turn, "A", on="rod")
    motion = turn(found.t)
    hand = by_hand(0.2 + SPEED * found.t)
    x = piston(0.2 + SPEED * found.t)[0]
    e = x - R * np.exp(1j * (0.2 + SPEED * found.t))
    # rod and piston: the guide pushes in y only, so that x and moments give the force at A
    m2a, m3a = hand["ma"][1], hand["ma"][2]
    fx = (m2a + m3a).real
    b_on_rod_x = -m3a.real
    # moments about A of the rod
    weight = 1j * M2 * G
    torque = J2 * hand["alpha"] + (np.conj(e / 2) * (m2a + weight)).imag
    b_on_rod_y = (torque + e.imag * b_on_rod_x) / e.real
    fy = (m2a + weight).imag - b_on_rod_y
    expected = (fx + 1j * fy) * np.exp(-1j * motion["rod.angle"])
    scale = np.abs(expected).max()
    assert found.force @ [1, 1j] == pytest.approx(expected, abs=1e-9 * scale)
    assert found.extremes["max"].value == pytest.approx(np.abs(expected).max(), rel=1e-5)
    assert found.extremes["x_min"].value <= expected.real.min() + 1e-9 * scale
    hand_values = {
        "max": np.abs(expected).max(),
        "x_max": expected.real.max(),
        "x_min": expected.real.min(),
        "y_max": expected.imag.max(),
        "y_min": expected.imag.min(),
    }
    assert set(found.extremes) == set(hand_values)
    for case, value in hand_values.items():
        extreme = found.extremes[case]
        assert extreme.value == pytest.approx(value, abs=1e-4 * scale), case
        near = (found.force @ [1, 1j])[np.abs(found.t - extreme.t).argmin()]
        read = {"m": np.abs(near), "x": near.real, "y": near.imag}[case[0]]
        assert read == pytest.approx(extreme.value, abs=0.05 * scale), case
    assert np.exp(1j * found.direction) == pytest.approx(expected / np.abs(expected), abs=1e-9)
    assert np.abs(found.direction).max() <= np.pi
    assert found.magnitude == pytest.approx(np.abs(expected), abs=1e-9 * scale)
    other = design.pin_load(turn, "A", on="crank")
    assert other.magnitude == pytest.approx(found.magnitude, abs=1e-9 * scale)


def test_the_table_of_pin_loads_has_names_of_quantities(turn: kp.Solution, tmp_path: Path) -> None:
    design.write_pin_loads(turn, tmp_path / "pins.csv")
    header = (tmp_path / "pins.csv").read_text("utf-8").partition("\n")[0].split(",")
    rows = np.loadtxt(tmp_path / "pins.csv", delimiter=",", skiprows=1)
    assert header[0] == "t [s]"
    for k, name in enumerate(header[1:], 1):
        assert rows[:, k] == pytest.approx(turn[name.partition(" ")[0]], abs=1e-12)
    assert "A.body_fx_on_rod [N]" in header


@pytest.mark.parametrize(
    "example", ["engine", "cam_roller", "excavator", "squeezer", "motor_press"]
)
def test_load_cases_balance_in_their_files(example: str, tmp_path: Path) -> None:
    """The sums of the written rows are zero, and the fields give the resultants."""
    sol = kp.load(f"examples/{example}.toml").run()[0]
    body = list(sol.compiled.bodies)[1]
    paths = design.export_load_cases(sol, tmp_path, [body])
    cases = design.load_cases(sol, body)
    assert len(paths) == len(cases) > 0
    info = sol.compiled.bodies[body]
    for path in paths[:10]:
        rows = np.genfromtxt(path, delimiter=",", skip_header=5, usecols=range(2, 11))
        text = path.read_text("utf-8").splitlines()
        x, y, fx, fy, moment = rows[:, :5].T
        size = np.hypot(fx, fy).max()
        assert abs(fx.sum()) <= 1e-9 * size
        assert abs(fy.sum()) <= 1e-9 * size
        reach = (np.abs(x) + np.abs(y)).max() + 1e-3
        assert abs((moment + x * fy - y * fx).sum()) <= 1e-9 * (size * reach + np.abs(moment).max())
        assert text[-1].startswith("inertia,inertia,")
        assert -info.mass * rows[-1, 5:7] == pytest.approx(rows[-1, 2:4], rel=1e-12, abs=1e-12)
        assert -info.inertia * rows[-1, 7] == pytest.approx(rows[-1, 4], rel=1e-12, abs=1e-15)


def test_a_load_case_out_of_balance_is_not_written(turn: kp.Solution, tmp_path: Path) -> None:
    case = design.load_cases(turn, "rod", "A")[0]
    assert case.residual < 1e-13
    wrong = replace(case.loads[0], force=case.loads[0].force * (1 + 1e-8))
    bad = replace(case, loads=(wrong, *case.loads[1:]))
    with pytest.raises(kp.ModelError, match="are not in balance with its inertia"):
        bad.to_csv(tmp_path / "bad.csv")
    assert not (tmp_path / "bad.csv").exists()
    case.to_csv(tmp_path / "good.csv")
    with pytest.raises(kp.ModelError, match="ground does not move"):
        design.free_body(turn, "ground")


@pytest.mark.parametrize(
    "example", ["cam_roller", "excavator", "jansen_leg", "planetary_gear", "squeezer"]
)
def test_all_bodies_balance(example: str) -> None:
    sol = kp.load(f"examples/{example}.toml").run()[0]
    motion = sol(np.linspace(float(sol.t[0]), float(sol.t[-1]), 7))
    for body in sol.compiled.bodies:
        assert imbalance(loads(motion, body), inertia(motion, body)) < 1e-12


def test_the_force_of_a_flat_face_acts_at_its_point_of_contact() -> None:
    """The contact moves along the face, to e cos φ beside the guide, which carries the moment."""
    m = kp.Model("eccentric cam", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    rim = {"rim": {"circle": (0.02, 0, 0.05)}}
    m.body("cam", mass=2, inertia=0.01, points={"O": (0, 0)}, curves=rim)
    m.body("follower", mass=0.8, inertia=0.001, points={"P": (0, 0)})
    m.revolute("shaft", "ground.O", "cam.O")
    m.translational("guide", "ground.O", "follower.P", axes=("90*deg", "90*deg"))
    m.flat_on_curve("contact", "follower.P", "cam.rim")
    m.coordinate_driver("motor", "cam.angle", value="pi/2 + 10*t")
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=0.6, output_step=0.05)
    for body in ("cam", "follower"):
        assert imbalance(loads(sol, body), inertia(sol, body)) < 1e-13
    (contact,) = (load for load in loads(sol, "follower") if load.name == "contact")
    arm = 0.02 * np.cos(np.pi / 2 + 10 * sol.t)
    assert contact.moment == pytest.approx(arm * contact.force[:, 1], abs=1e-13)
    found = design.shaking(sol)
    lift = -0.8 * 100 * 0.02 * np.sin(np.pi / 2 + 10 * found.t)
    assert found.force[:, 1] == pytest.approx(-lift, abs=1e-10)
    assert found.moment == pytest.approx(np.zeros(len(found.t)), abs=1e-10)
    files = [case.residual for case in design.load_cases(sol, "follower")]
    assert max(files) < 1e-12


def test_the_centripetal_field_of_a_turning_bar() -> None:
    """A bar turned about its end at constant speed: the pin carries m ω² l/2 along the bar."""
    m = kp.Model("bar")
    m.ground.points(O=(0, 0))
    m.bar("bar", mass=2.0, length=0.5, ends=("O", "P"))
    m.revolute("O", "ground.O", "bar.O")
    m.coordinate_driver("d", "bar.angle", value="10*t")
    sol = kp.inverse_dynamics(m, kp.assemble(m), t_end=0.6)
    found = design.pin_load(sol, "O", on="bar")
    assert found.force == pytest.approx(np.tile([-2 * 100 * 0.25, 0], (len(found.t), 1)), abs=1e-11)
    case = design.free_body(sol, "bar", 0.3)
    (row,) = [line for line in case._text().splitlines() if line.startswith("inertia")]
    numbers = [float(word) for word in row.split(",")[2:]]
    assert numbers[5:] == pytest.approx([-25.0, 0.0, 0.0, 100.0], abs=1e-10)
    assert quad(lambda s: 4.0 * 100 * s, 0, 0.5)[0] == pytest.approx(50.0)


def test_load_cases_whose_names_are_alike_have_files_of_their_own(tmp_path: Path) -> None:
    m = kp.Model("chain", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    end = "ground.O"
    for body, joint in (("a b", "A"), ("a_b", "A_x"), ("A_b", "a")):
        m.bar(body, mass=1, length=1, ends=("P", "Q"))
        m.revolute(joint, end, f"{body}.P")
        end = f"{body}.Q"
    start = kp.assemble(m, {f"{body}.angle": 0.3 for body in ("a b", "a_b", "A_b")})
    found = kp.dynamics(m, start, t_end=0.2, output_step=0.01)
    cases = [case for body in found.compiled.bodies for case in design.load_cases(found, body)]
    paths = design.export_load_cases(found, tmp_path)
    assert len({str(path).lower() for path in paths}) == len(paths) == len(cases) == 25
    for case, path in zip(cases, paths, strict=True):
        assert path.read_text().startswith(f"# loads on {case.body}, case {case.name}, at t")
