"""Statics against closed forms and against SciPy's minimisation of independent potentials."""

import copy
import json
import pickle
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import main
from scipy.optimize import brentq, minimize_scalar

G = 9.81


def pendulum(length: float = 1.0, mass: float = 2.0) -> kp.Model:
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=mass, length=length, ends=("O", "P"))
    m.revolute("pin", "ground.O", "rod.O")
    return m


def truss(b: float = 1.0, height: float = 0.6, k: float = 150.0) -> kp.Model:
    """A von Mises truss of two springs with a load on the apex."""
    m = kp.Model("truss", parameters={"load": 0.0})
    m.ground.points(A=(0, 0), B=(2 * b, 0), S=(b, 0))
    m.point_mass("apex", mass=1, at=(b, height))
    m.pin_in_slot("slide", "ground.S", "apex.P", axis="90*deg")
    length = float(np.hypot(b, height))
    for name, end in (("left", "A"), ("right", "B")):
        m.spring_damper(name, f"ground.{end}", "apex.P", stiffness=k, free_length=length)
    m.force("load_on_apex", "apex.P", force=[0, "-load"])
    return m


def test_a_pendulum_hangs() -> None:
    m = pendulum()
    found = kp.equilibrium(m, kp.assemble(m, set={"rod.angle": "89.9 deg"}))
    assert isinstance(found, kp.EquilibriumResult)
    assert found.stable is True
    assert abs(found.state["rod.angle"] + np.pi / 2) < 1e-13
    assert found.coordinates == ("rod.angle",)
    assert np.allclose(found.eigenvalues, [2.0 * G / 2], rtol=1e-13)
    assert not found.state.v.any()
    force = found.state["pin"].force(on="rod")
    assert np.allclose(force, [0, 2.0 * G], atol=1e-12)
    assert found.effort == {}
    assert found.final is found.state


def test_what_a_holder_must_apply_is_the_slope_of_the_potential() -> None:
    """A slider-crank with a spring: virtual work with the height of each centre."""
    m = kp.Model("slider-crank", gravity=(0, -G))
    m.ground.points(O=(0, 0), W=(0.8, 0))
    m.bar("crank", mass=1, length=0.1, ends=("O", "A"))
    m.bar("rod", mass=0.5, length=0.3, ends=("A", "B"))
    m.body("piston", mass=0.4, inertia=1e-4, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "piston.B")
    m.translational("S", "ground.O", "piston.B")
    m.spring_damper("spring", "piston.B", "ground.W", stiffness=300, free_length=0.3)

    def potential(angle: complex) -> complex:
        x = 0.1 * np.cos(angle) + np.sqrt(0.09 - 0.01 * np.sin(angle) ** 2)
        height = 0.1 * np.sin(angle) / 2
        return complex(G * (1 + 0.5) * height + 150 * (0.8 - x - 0.3) ** 2)

    for degrees in (20, 75, 140, 250):
        start = kp.assemble(m, set={"crank.angle": f"{degrees} deg"}, guess={"piston.x": 0.35})
        found = kp.equilibrium(m, start, hold=["crank.angle"])
        exact = potential(np.radians(degrees) + 1e-30j).imag / 1e-30
        assert abs(found.effort["crank.angle"] - exact) < 1e-10
        assert found.unit_of_effort("crank.angle") == "N*m"
        # the same, held at the piston: power is effort times rate
        at_piston = kp.equilibrium(m, start, hold=["S.displacement"])
        sin, cos = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
        slope = -0.1 * sin - 0.01 * sin * cos / np.sqrt(0.09 - 0.01 * sin**2)
        assert abs(at_piston.effort["S.displacement"] - exact / slope) < 1e-9


def test_a_driver_gives_its_effort() -> None:
    m = pendulum()
    m.coordinate_driver("motor", "rod.angle", value="0.3 + 2*t")
    found = kp.equilibrium(m, kp.assemble(m))
    assert abs(found.effort["motor"] - 2.0 * G / 2 * np.cos(0.3)) < 1e-12
    assert abs(found.state["motor.effort"] - found.effort["motor"]) < 1e-15
    assert found.stable
    assert found.eigenvalues.shape == (0,)


def test_the_four_bar_with_a_spring_rests_at_the_minimum_of_its_potential() -> None:
    """The flagship against the potential of the crank angle, with the loop solved by hand."""
    case = kp.load("examples/four_bar.toml")
    found = kp.equilibrium(case.model, case.start())
    (l1, l2, l3, ground), (m1, m2, m3), k = (10, 26, 18, 20), (3, 5, 4), 1e6

    def potential(crank: float) -> float:
        b = l1 * np.exp(1j * crank)
        d = ground - b
        along = (abs(d) ** 2 + l2**2 - l3**2) / (2 * abs(d))
        c = b + d / abs(d) * (along + 1j * np.sqrt(l2**2 - along**2))
        turn = np.angle((ground - c) / np.exp(1.5j * np.pi))
        height = m1 * b.imag / 2 + m2 * (b + c).imag / 2 + m3 * c.imag / 2
        return float(G * height + 0.5 * k * turn**2)

    near = float(found.state["crank.angle"])

    def slope(x: float) -> float:
        h = 2e-3
        pairs = [potential(x + n * h) - potential(x - n * h) for n in (1, 2, 3)]
        return (45 * pairs[0] - 9 * pairs[1] + pairs[2]) / (60 * h)

    exact = brentq(slope, near - 1e-3, near + 1e-3, xtol=1e-14)
    assert abs(near - exact) < 1e-10
    rough = minimize_scalar(potential, bounds=(near - 0.1, near + 0.1), method="bounded")
    assert abs(rough.x - near) < 1e-4
    assert found.stable


def test_the_truss_snaps_through() -> None:
    b, height, k = 1.0, 0.6, 150.0
    m = truss(b, height, k)
    start = kp.assemble(m)
    length = np.hypot(b, height)
    angle = np.arccos(np.cbrt(b / length))
    top = 2 * k * np.sin(angle) * (length - b / np.cos(angle))
    found = kp.equilibrium(m, start, over="load", range=(-1.5 * top, 1.5 * top))
    assert found.complete
    assert found.end == "the path reached the end of the range"
    assert np.allclose(found.folds, [top, -top], rtol=1e-9)
    y = found.quantity("apex.y")
    assert np.allclose(
        np.arctan2(y[list(found.fold_points)], b), [angle, -angle], atol=1e-8, rtol=0
    )
    at = np.arctan2(y, b)
    assert np.allclose(found.values, 2 * k * np.sin(at) * (length - b / np.cos(at)), atol=1e-8)
    beyond = np.abs(at) > angle + 1e-6
    assert np.array_equal(found.stable[beyond], np.ones(beyond.sum(), dtype=bool))
    inside = np.abs(at) < angle - 1e-6
    assert not found.stable[inside].any()
    assert inside.any()
    # all rest positions without load: the path passes three
    crossings = np.flatnonzero(np.diff(np.sign(found.values)))
    assert len(crossings) == 3
    # the state of a point has the parameter of its point
    state = found.states[5]
    assert state.compiled.parameters["load"] == found.values[5]


def test_a_truss_of_rigid_bars_with_a_torsion_spring() -> None:
    """Two bars, the right end slides against a spring: P = 2 k (2 L - 2 L cos a - …) tan a."""
    bar, k, begin = 1.0, 400.0, 0.5
    m = kp.Model("rigid", parameters={"load": 0.0})
    m.ground.points(A=(0, 0))
    m.bar("left", mass=1, length=bar, ends=("A", "C"))
    m.bar("right", mass=1, length=bar, ends=("C", "B"))
    m.body("block", mass=1, inertia=1, points={"B": (0, 0)})
    m.revolute("A", "ground.A", "left.A")
    m.revolute("C", "left.C", "right.C")
    m.revolute("B", "right.B", "block.B")
    m.translational("S", "ground.A", "block.B")
    m.spring_damper("spring", "ground.A", "block.B", stiffness=k, free_length=2 * np.cos(begin))
    m.torsion_spring("hinge", "ground", "left", stiffness=3.0, free_angle=begin)
    m.force("load_on_apex", "left.C", force=[0, "-load"])
    start = kp.assemble(m, set={"left.angle": begin}, guess={"right.angle": -begin, "block.x": 1.7})
    found = kp.equilibrium(m, start, over="load", range=(0, 300))

    def load(a: complex) -> complex:  # moment of all forces about a, over L cos a
        spring = k * (2 * np.cos(a) - 2 * np.cos(begin)) * 2 * np.sin(a)
        return complex((spring + 3.0 * (begin - a)) / np.cos(a))

    fold = brentq(lambda a: load(a + 1e-30j).imag / 1e-30, 0.1, 0.45, xtol=1e-15)
    assert found.fold_points
    place = found.fold_points[0]
    assert abs(found.folds[0] - load(fold).real) < 1e-8
    assert abs(found.states[place]["left.angle"] - fold) < 1e-8
    assert np.allclose(found.values, [load(s["left.angle"]).real for s in found.states], atol=1e-8)


def test_parameters_that_are_formulas_of_the_parameter_follow() -> None:
    """The free angle is twice the parameter: the rest angle is too."""
    m = kp.Model("wheel", parameters={"half": 0.1, "free": "2*half"})
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=1, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.torsion_spring("spring", "ground", "wheel", stiffness=5, free_angle="free")
    found = kp.equilibrium(m, kp.assemble(m), over="half", range=(0.1, 0.6))
    assert np.allclose(found.quantity("wheel.angle"), 2 * found.values, atol=1e-12)
    assert not found.fold_points
    assert found.stable.all()


def test_a_pitchfork_is_reported_as_a_crossing() -> None:
    """A column with a torsion spring at its foot buckles at P L = k."""
    m = kp.Model("column", parameters={"load": 0.0})
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=2, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("foot", "ground", "rod", stiffness=7, free_angle="90 deg")
    m.force("push", "rod.P", force=[0, "-load"])
    found = kp.equilibrium(
        m, kp.assemble(m, set={"rod.angle": "90 deg"}), over="load", range=(0, 5)
    )
    assert np.allclose(found.branches, [3.5], atol=1e-6)
    assert not found.fold_points
    exact = 7 - 2 * found.values
    assert np.allclose(found.eigenvalues[:, 0], exact, atol=1e-9)
    buckled = kp.equilibrium(
        m.with_parameters({"load": 5}), kp.assemble(m, set={"rod.angle": "89.9 deg"})
    )
    lean = brentq(lambda x: 7 * x - 10 * np.sin(x), 0.1, 3, xtol=1e-15)
    assert abs(abs(buckled.state["rod.angle"] - np.pi / 2) - lean) < 1e-12
    assert buckled.stable


def test_a_gear_has_its_radial_force_at_rest() -> None:
    """Statics gives the reactions of dynamics where nothing moves."""
    m = kp.Model("gears", gravity=(0, -G))
    m.ground.points(A=(0, 0), B=(0.3, 0))
    for name, at, x in (("one", "A", 0.05), ("two", "B", 0.0)):
        m.body(name, mass=2, inertia=0.1, center=(x, 0), points={at: (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.{at}")
    m.gear("mesh", "one.A", "two.B", radii=[0.1, 0.2])
    m.torsion_spring("spring", "ground", "two", stiffness=10)
    found = kp.equilibrium(m, kp.assemble(m, set={"one.angle": 0.2}))
    state = kp.State(m, 0, found.state.q, found.state.v)
    for joint, body in (("A", "one"), ("B", "two"), ("mesh", "two")):
        still = found.state[joint].force(on=body)
        assert np.allclose(still, state[joint].force(on=body), atol=1e-9)
    assert np.hypot(*found.state["mesh"].force(on="two")) > 1


def test_the_stiffness_at_a_point() -> None:
    """A cantilever of two links with torsion springs, and the rigid direction of one link."""
    m = kp.Model("arm")
    m.ground.points(O=(0, 0))
    m.bar("a", mass=1, length=1, ends=("O", "A"))
    m.bar("b", mass=1, length=2, ends=("A", "B"))
    m.revolute("O", "ground.O", "a.O")
    m.revolute("A", "a.A", "b.A")
    m.torsion_spring("k1", "ground", "a", stiffness=50, free_angle=0.3)
    m.torsion_spring("k2", "a", "b", stiffness=20, free_angle=0.5)
    start = kp.assemble(m, set={"a.angle": 0.3, "b.angle": 0.8})
    rest = kp.equilibrium(m, start)
    assert np.allclose(rest.state.q, start.q, atol=1e-14)
    tip = kp.stiffness_at(m, rest.state, "b.B")
    a, b = np.array([np.cos(0.3), np.sin(0.3)]), 2 * np.array([np.cos(0.8), np.sin(0.8)])
    turned = np.array([[0, -1], [1, 0]])
    jacobian = np.column_stack([turned @ (a + b), turned @ b])  # by the angles of both hinges
    exact = jacobian @ np.diag([1 / 50, 1 / 20]) @ jacobian.T
    assert np.allclose(tip.compliance, exact, rtol=1e-12)
    assert np.allclose(tip.stiffnesses, np.sort(1 / np.linalg.eigvalsh(exact)), rtol=1e-11)
    # the first link alone: rigid along itself, 50 N·m/rad over 1 m across
    elbow = kp.stiffness_at(m, rest.state, "a.A")
    assert np.allclose(elbow.stiffnesses, [50, np.inf])
    assert np.isclose(elbow.along(turned @ a), 50)
    assert elbow.along(a) == np.inf
    held = kp.stiffness_at(m, rest.state, "a.A", hold=["a.angle"])
    assert np.array_equal(held.compliance, np.zeros((2, 2)))
    with pytest.raises(kp.ModelError, match="not at rest"):
        kp.stiffness_at(m, kp.assemble(m, set={"a.angle": 0.4, "b.angle": 0.8}), "b.B")
    with pytest.raises(kp.ModelError, match="not a point"):
        kp.stiffness_at(m, rest.state, "b.Z")
    told = r"hold: 'a\.angle'; must be a list of names; write \['a\.angle'\]$"
    with pytest.raises(kp.ModelError, match=told):
        kp.stiffness_at(m, rest.state, "a.A", hold="a.angle")
    with pytest.raises(kp.ModelError, match=r"hold: 3; must be a list of names$"):
        kp.stiffness_at(m, rest.state, "a.A", hold=3)  # type: ignore[arg-type]


def test_a_follower_force_has_a_stiffness_without_symmetry() -> None:
    """Eigenvalues are those of K, not of its symmetric part."""
    m = kp.Model("follower")
    m.ground.points(O=(0, 0))
    m.bar("a", mass=1, length=1, ends=("O", "A"))
    m.bar("b", mass=1, length=1, ends=("A", "B"))
    m.revolute("O", "ground.O", "a.O")
    m.revolute("A", "a.A", "b.A")
    m.torsion_spring("k1", "ground", "a", stiffness=10)
    m.torsion_spring("k2", "a", "b", stiffness=10)
    m.force("thrust", "b.B", force=[-4, 0], frame="j")
    rest = kp.equilibrium(m, kp.assemble(m, set={"a.angle": 0, "b.angle": 0}))
    # the thrust turns with b: on a it has the moment 4 sin(b - a)
    exact = np.array([[20 - 4, -10 + 4], [-10, 10]])
    assert np.allclose(rest.stiffness, exact, atol=1e-12)
    assert np.allclose(rest.eigenvalues, np.sort(np.linalg.eigvals(exact)), atol=1e-12)


@pytest.mark.parametrize("part", ["file", "python"])
def test_a_case_goes_on_from_the_equilibrium(part: str, tmp_path: Path) -> None:
    m = pendulum()
    analyses = [kp.Equilibrium(name="rest"), kp.Dynamics(t_end=1, output_step=0.5)]
    case = kp.Case(m, {"set": {"rod.angle": "10 deg"}}, analyses)
    if part == "file":
        case.save(tmp_path / "case.toml")
        case = kp.load(tmp_path / "case.toml")
    found = case.run()
    assert isinstance(found["rest"], kp.EquilibriumResult)
    assert np.allclose(found["dynamics"]["rod.angle"], -np.pi / 2, atol=1e-9)


def test_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    m = truss()
    path = tmp_path / "truss.toml"
    kp.Case(m, analyses=[kp.Equilibrium(over="load", range=(-40, 40))]).save(path)
    assert main(["equilibrium", str(path), "--output", str(tmp_path / "out")]) == 0
    output = capsys.readouterr().out
    assert "fold at load = " in output
    names = {file.name for file in (tmp_path / "out").rglob("*") if file.is_file()}
    assert {"equilibrium.csv", "summary.json"} <= names
    assert any(name.endswith("path.png") for name in names)
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    assert len(summary["folds"]) == 2
    assert len(summary["values"]) == len(summary["stable"])


def test_a_file_without_such_an_analysis_gets_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "pendulum.toml"
    kp.Case(pendulum(), {"set": {"rod.angle": "10 deg"}}).save(path)
    assert main(["equilibrium", str(path), "--output", str(tmp_path / "out")]) == 0
    output = capsys.readouterr().out
    assert "stable" in output
    assert "stiffness along rod.angle: 9.81 N·m/rad" in output


def test_errors_name_the_option() -> None:
    m = truss()
    start = kp.assemble(m)
    with pytest.raises(kp.ModelError, match="no parameter 'lod'"):
        kp.equilibrium(m, start, over="lod", range=(0, 1))
    with pytest.raises(kp.ModelError, match="range"):
        kp.equilibrium(m, start, over="load")
    with pytest.raises(kp.ModelError, match="over"):
        kp.equilibrium(m, start, range=(0, 1))
    with pytest.raises(kp.ModelError, match="no length"):
        kp.equilibrium(m, start, over="load", range=(1, 1))
    with pytest.raises(kp.ModelError, match="unknown body 'apx'"):
        kp.equilibrium(m, start, hold=["apx.y"])
    with pytest.raises(kp.ModelError, match="not a State"):
        kp.equilibrium(m, 3)  # type: ignore[arg-type]


def test_a_torque_on_a_free_wheel_has_no_equilibrium() -> None:
    m = kp.Model("wheel")
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=1, points={"O": (0, 0)})
    m.revolute("O", "ground.O", "wheel.O")
    m.torque("drive", "wheel", torque=3)
    start = kp.assemble(m, set={"wheel.angle": 0})
    with pytest.raises(kp.SingularityError, match="no equilibrium") as caught:
        kp.equilibrium(m, start)
    assert caught.value.name == "wheel.angle"
    found = kp.equilibrium(m, start, hold=["wheel.angle"])
    assert found.effort["wheel.angle"] == pytest.approx(-3, abs=1e-12)


def test_results_are_copied_with_their_reactions() -> None:
    m = pendulum()
    m.coordinate_driver("motor", "rod.angle", value="0.3 + 2*t")
    found = kp.equilibrium(m, kp.assemble(m))
    for other in (copy.deepcopy(found), pickle.loads(pickle.dumps(found))):
        assert other.stable == found.stable
        assert np.array_equal(other.state.q, found.state.q)
        assert other.state["motor.effort"] == pytest.approx(found.effort["motor"])
    assert "stable" in repr(found)
