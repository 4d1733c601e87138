"""Results in the forms of other programs, read back by these programs."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
import scipy.io
import sympy
from pyarrow import parquet


@pytest.fixture(scope="module")
def case() -> kp.Case:
    return kp.load("examples/four_bar.toml")


@pytest.fixture(scope="module")
def solution(case: kp.Case) -> kp.Solution:
    return kp.dynamics(case.model, case.start(), t_end=0.2, output_step=0.05)


def oscillator(mass: float, k: float) -> kp.ModesResult:
    m = kp.Model("oscillator", gravity=(0, 0), parameters={"F": 0})
    m.ground.points(O=(0, 0), W=(-1, 0))
    m.body("cart", mass=mass, inertia=1, points={"S": (0, 0)})
    m.translational("rail", "ground.O", "cart.S")
    m.spring_damper("spring", "ground.W", "cart.S", stiffness=k, free_length=1)
    m.force("push", "cart.S", force=("F", 0))
    start = kp.assemble(m, {"cart.x": 0, "cart.vx": 0})
    return kp.modes(m, start, inputs=["F"], outputs=["cart.x", "cart.vx"])


def test_parquet_keeps_numbers_and_units(solution: kp.Solution, tmp_path: Path) -> None:
    solution.to_parquet(tmp_path / "run.parquet")
    table = parquet.read_table(tmp_path / "run.parquet")
    assert table.column_names[0] == "t"
    assert (table["rocker.angle"].to_numpy() == solution["rocker.angle"]).all()
    assert table.schema.field("rocker.omega").metadata[b"unit"] == b"rad/s"
    with kp.units("deg"):
        solution.to_parquet(tmp_path / "run.parquet")
    table = parquet.read_table(tmp_path / "run.parquet")
    assert table.schema.field("rocker.angle").metadata[b"unit"] == b"deg"
    assert table["rocker.angle"][0].as_py() == pytest.approx(
        np.degrees(solution["rocker.angle"][0])
    )


def test_mat_keeps_numbers_names_and_units(solution: kp.Solution, tmp_path: Path) -> None:
    solution.to_mat(tmp_path / "run.mat")
    found = scipy.io.loadmat(tmp_path / "run.mat", squeeze_me=True, chars_as_strings=True)
    assert (found["rocker_angle"] == solution["rocker.angle"]).all()
    pairs = dict(
        zip(found["names"], zip(found["variables"], found["units"], strict=True), strict=True)
    )
    assert pairs["C.fx_on_rocker"] == ("C_fx_on_rocker", "N")
    assert len(pairs) == len(solution.to_dataframe().columns)


def test_equal_identifiers_are_told_apart(tmp_path: Path) -> None:
    m = kp.Model("names", gravity=(0, 0))
    m.point_mass("a_x", mass=1)
    m.point_mass("a", mass=1)
    start = kp.assemble(m, {"a_x.x": 3, "a_x.y": 0, "a.x": 5, "a.y": 0})
    solution = kp.dynamics(m, start, t_end=1, output_step=1)
    solution.to_mat(tmp_path / "x.mat")
    found = scipy.io.loadmat(tmp_path / "x.mat", squeeze_me=True)
    variable = dict(zip(found["names"], found["variables"], strict=True))
    assert len(set(found["variables"])) == len(found["variables"])
    assert found[variable["a.x"]][0] == 5
    assert found[variable["a_x.x"]][0] == 3


def test_a_sweep_is_a_mat_file(tmp_path: Path) -> None:
    case = kp.load("examples/pendulum.toml")
    swept = kp.sweep(case, {"L": [0.5, 1.0]}, ["rod.omega.max"], workers=1)
    swept.to_mat(tmp_path / "sweep.mat")
    found = scipy.io.loadmat(tmp_path / "sweep.mat", squeeze_me=True)
    assert found["L"].tolist() == [0.5, 1.0]
    assert (found["rod_omega_max"] == swept["rod.omega.max"]).all()
    assert list(map(len, found["reasons"])) == [0, 0]


@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
def test_the_state_space_has_the_poles_and_gain_of_the_oscillator(
    mass: float, tmp_path: Path
) -> None:
    k = 4.0 * mass
    modes = oscillator(mass, k)
    modes.to_mat(tmp_path / "ss.mat")
    found = scipy.io.loadmat(tmp_path / "ss.mat", squeeze_me=True)
    poles = np.linalg.eigvals(found["A"])
    assert sorted(poles.imag) == pytest.approx([-2, 2])
    gain = -found["C"] @ np.linalg.solve(found["A"], found["B"].reshape(2, 1))
    assert gain.ravel() == pytest.approx([1 / k, 0])
    assert list(found["outputs"]) == ["cart.x", "cart.vx"]


def test_the_state_space_is_a_system_of_python_control() -> None:
    control = pytest.importorskip("control")
    system = oscillator(1.0, 4.0).to_control()
    assert system.output_labels == ["cart_x", "cart_vx"]
    assert system.input_labels == ["F"]
    response = control.step_response(system, np.linspace(0, 3, 31))
    assert response.outputs[0, 0] == pytest.approx((1 - np.cos(2 * response.time)) / 4, abs=1e-6)


def test_the_equations_in_sympy_have_the_numbers_of_the_core(case: kp.Case) -> None:
    state = case.start()
    matrices, values = state.matrices(), state.coordinates()
    for equations in kp.equations(case.model):
        found = equations.to_sympy()
        given = {}
        for name, symbol in found.symbols.items():
            owner, _, last = name.rpartition(".")
            point, axis = owner, "xy".find(last)
            given[symbol] = (
                equations.points[point][axis] if point in equations.points else values.get(name)
            )
        for k, row in enumerate(equations.rows):
            at = matrices.rows.index(row)
            assert float(found.residual[k].subs(given)) == pytest.approx(0, abs=1e-9)
            assert float(found.gamma[k].subs(given)) == pytest.approx(matrices.gamma[at], abs=1e-9)
            for j, column in enumerate(found.columns):
                number = float(found.jacobian[k, j].subs(given))
                wanted = matrices.Phi_q[at, matrices.columns.index(column)]
                assert number == pytest.approx(wanted, abs=1e-9)
                slope = sympy.diff(found.residual[k], found.symbols.get(column, sympy.Dummy()))
                assert sympy.simplify(slope - found.jacobian[k, j]) == 0


CALLS: dict[str, tuple[str, Callable[[Any, Path], object]]] = {
    "pyarrow": ("parquet", lambda of, path: of[0].to_parquet(path)),
    "scipy.io": ("design", lambda of, path: of[0].to_mat(path)),
    "xarray": ("xarray", lambda of, _: of[0].to_xarray()),
    "control": ("control", lambda of, _: of[1].to_control()),
    "sympy": ("sympy", lambda of, _: kp.equations(of[0].model)[0].to_sympy()),
}


@pytest.mark.parametrize("package", CALLS)
def test_a_missing_package_is_named_with_its_extra(
    package: str, solution: kp.Solution, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    extra, call = CALLS[package]
    with pytest.raises(kp.ModelError, match=f"needs {package.partition('.')[0]}") as caught:
        call((solution, oscillator(1.0, 1.0)), tmp_path / "file")
    assert f"kempe[{extra}]" in str(caught.value.hint)
    assert not (tmp_path / "file").exists()
