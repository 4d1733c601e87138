"""The table of a solution: reactions by body and frame, paths, units, names that are formulas."""

import csv
from collections.abc import Iterator
from dataclasses import FrozenInstanceError
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.results import table


@pytest.fixture(autouse=True)
def si_units() -> Iterator[None]:
    yield
    kp.units("SI")


@pytest.fixture(scope="module", params=["four_bar", "slider_crank", "six_bar"])
def sol(request: pytest.FixtureRequest) -> kp.Solution:
    case = kp.load(ROOT / "examples" / f"{request.param}.toml")
    return case.with_analysis(next(iter(case.analyses)), t_end=0.2, output_step=0.02).run()[0]


def read(path: Path) -> dict[str, np.ndarray]:
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    values = np.array(rows, dtype=float).T
    assert len(set(header)) == len(header)
    return dict(zip(header, values, strict=True))


def test_reactions_are_written_by_body_and_frame(sol: kp.Solution, tmp_path: Path) -> None:
    sol.to_csv(tmp_path / "s.csv", frames=("global", "body", "joint"))
    table = read(tmp_path / "s.csv")
    for name, joint in sol.model.constraints.items():
        for body in joint.bodies:
            if body == "ground":
                assert f"{name}.fx_on_ground [N]" not in table
                continue
            for frame, mark in (("global", ""), ("body", "body_"), ("joint", "joint_")):
                force = sol[name].force(on=body, frame=frame)
                assert np.array_equal(table[f"{name}.{mark}fx_on_{body} [N]"], force[:, 0])
                assert np.array_equal(table[f"{name}.{mark}fy_on_{body} [N]"], force[:, 1])
            torque = sol[name].torque(on=body)
            assert np.array_equal(table[f"{name}.torque_on_{body} [N*m]"], torque)


def test_newtons_law_holds_in_the_table(sol: kp.Solution, tmp_path: Path) -> None:
    sol.to_csv(tmp_path / "s.csv")
    table = read(tmp_path / "s.csv")
    gravity = np.array(sol.model.gravity)
    for name, body in sol.model.bodies.items():
        center = sol.body(name).at(body.center)
        for k, axis in enumerate("xy"):
            acting = [v for key, v in table.items() if key.endswith(f".f{axis}_on_{name} [N]")]
            total = np.sum(acting, axis=0) + body.mass * gravity[k]
            scale = max(np.abs(acting).max(), body.mass)
            expected = body.mass * center.acceleration[:, k]
            np.testing.assert_allclose(total, expected, atol=1e-9 * scale)


def test_paths_are_written_on_request(sol: kp.Solution, tmp_path: Path) -> None:
    name, body = next(iter(sol.model.bodies.items()))
    point = next(iter(body.points))
    sol.to_csv(tmp_path / "without.csv")
    sol.to_csv(tmp_path / "one.csv", points=[f"{name}.{point}"])
    sol.to_csv(tmp_path / "all.csv", points=True)
    without, one, every = (read(tmp_path / f"{n}.csv") for n in ("without", "one", "all"))
    assert set(one) - set(without) == {f"{name}.{point}.{c} [m]" for c in "xy"}
    assert np.array_equal(one[f"{name}.{point}.y [m]"], sol[name].point(point).position[:, 1])
    count = sum(len(b.points) for b in sol.model.bodies.values())
    assert len(every) == len(without) + 2 * count


def test_the_table_follows_the_display_units(sol: kp.Solution, tmp_path: Path) -> None:
    sol.to_csv(tmp_path / "si.csv")
    kp.units("mm,deg,rpm,kN,N*mm,kJ,ms")
    sol.to_csv(tmp_path / "own.csv")
    si, own = read(tmp_path / "si.csv"), read(tmp_path / "own.csv")
    body = next(iter(sol.model.bodies))
    joint, other = next((n, c.j) for n, c in sol.model.joints.items() if c.j != "ground")
    for name, old, new, factor in [
        ("t", "s", "ms", 1e3),
        (f"{body}.x", "m", "mm", 1e3),
        (f"{body}.vy", "m/s", "mm/s", 1e3),
        (f"{body}.ay", "m/s^2", "mm/s^2", 1e3),
        (f"{body}.angle", "rad", "deg", 180 / np.pi),
        (f"{body}.omega", "rad/s", "rpm", 30 / np.pi),
        (f"{body}.alpha", "rad/s^2", "deg/s^2", 180 / np.pi),
        (f"{joint}.fx_on_{other}", "N", "kN", 1e-3),
        (f"{joint}.torque_on_{other}", "N*m", "N*mm", 1e3),
        ("energy.kinetic", "J", "kJ", 1e-3),
    ]:
        np.testing.assert_allclose(
            own[f"{name} [{new}]"], si[f"{name} [{old}]"] * factor, rtol=1e-14
        )
    frame = sol.to_dataframe()
    assert frame.attrs["units"][f"{body}.omega"] == "rpm"
    np.testing.assert_array_equal(frame[f"{body}.omega"], own[f"{body}.omega [rpm]"])


@pytest.mark.parametrize(
    ("extent", "message"),
    [
        ({"frames": ("lokal",)}, "unknown frame 'lokal'"),
        ({"frames": "global"}, r"write \['global'\]"),
        ({"points": ["crank.Q"]}, "unknown quantity 'crank.Q.x'"),
        ({"points": "crank.B"}, r"write \['crank.B'\]"),
    ],
)
def test_a_wrong_extent_is_refused(
    solution: kp.Solution, tmp_path: Path, extent: dict, message: str
) -> None:
    with pytest.raises(kp.ModelError, match=message):
        solution.to_csv(tmp_path / "s.csv", **extent)
    assert not list(tmp_path.iterdir())


def test_no_cell_is_a_formula_of_a_spreadsheet(tmp_path: Path) -> None:
    names = ["=1+1", "+a", "-b", "@c", 'd,"e', "plain"]
    m = kp.Model(gravity=(0, -9.81))
    for name in names:
        m.body(name, mass=1, inertia=1)
    start = kp.assemble(m)
    sol = kp.dynamics(m, start, t_end=0.1, output_step=0.05)
    sol.to_csv(tmp_path / "s.csv")
    texts = [(tmp_path / "s.csv").read_text(encoding="utf-8"), kp.show(m, start, "M").csv()]
    for text in texts:
        header, *rows = csv.reader(text.splitlines())
        cells = header + [row[0] for row in rows if not row[0][:1].isdigit()]
        assert not [cell for cell in cells if cell[:1] in {*"=+-@"}]
        for name in names:
            mark = "'" if name[0] in "=+-@" else ""
            assert any(cell.startswith(f"{mark}{name}.x") for cell in cells), name


def test_every_column_is_its_quantity(tmp_path: Path) -> None:
    """All columns of a driven rod with two springs: header in order, values by hand."""
    m = kp.Model(gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.torsion_spring("s", "ground", "rod", stiffness=50, damping=3)
    m.spring_damper("line", "ground.O", "rod.P", stiffness=7, free_length=0.5)
    m.coordinate_driver("motor", "rod.angle", value="0.3 + 2*t")
    sol = kp.dynamics(m, kp.assemble(m), t_end=0.4, output_step=0.1)
    sol.to_csv(tmp_path / "s.csv")
    table = read(tmp_path / "s.csv")
    assert list(table) == [
        "t [s]",
        *(f"rod.{name}" for name in ("x [m]", "y [m]", "angle [rad]")),
        *(f"rod.{name}" for name in ("vx [m/s]", "vy [m/s]", "omega [rad/s]")),
        *(f"rod.{name}" for name in ("ax [m/s^2]", "ay [m/s^2]", "alpha [rad/s^2]")),
        *("O.lambda_x [N]", "O.lambda_y [N]", "motor.lambda_angle [N*m]"),
        *("O.fx_on_rod [N]", "O.fy_on_rod [N]", "O.torque_on_rod [N*m]"),
        *("motor.fx_on_rod [N]", "motor.fy_on_rod [N]", "motor.torque_on_rod [N*m]"),
        *("s.torque_on_rod [N*m]", "line.force [N]", "line.torque_on_rod [N*m]"),
        *(f"energy.{n} [J]" for n in ("kinetic", "potential", "dissipated", "work", "total")),
    ]
    t = table["t [s]"]
    phi = 0.3 + 2 * t
    by_hand = {
        "rod.x [m]": np.cos(phi) / 2,
        "rod.vy [m/s]": np.cos(phi),
        "rod.ay [m/s^2]": -2 * np.sin(phi),
        "rod.omega [rad/s]": 2 + 0 * t,
        "s.torque_on_rod [N*m]": -50 * phi - 6,
        "line.force [N]": -3.5 + 0 * t,
        # The motor carries spring, damper and weight: M = 50 φ + 6 + m g cos φ / 2.
        "motor.torque_on_rod [N*m]": 50 * phi + 6 + 9.81 * np.cos(phi),
        "motor.lambda_angle [N*m]": -(50 * phi + 6 + 9.81 * np.cos(phi)),
        "energy.kinetic [J]": 4 / 3 + 0 * t,
        "energy.dissipated [J]": 12 * t,
        "energy.work [J]": 25 * (phi**2 - 0.09) + 12 * t + 9.81 * (np.sin(phi) - np.sin(0.3)),
    }
    for name, values in by_hand.items():
        np.testing.assert_allclose(table[name], values, atol=1e-6, err_msg=name)
    potential = table["energy.potential [J]"]
    expected = 25 * phi**2 + 9.81 * np.sin(phi)
    np.testing.assert_allclose(potential - potential[0], expected - expected[0], atol=1e-9)
    np.testing.assert_allclose(table["energy.total [J]"], table["energy.total [J]"][0], atol=1e-6)


def test_coordinates_of_a_joint_are_columns_with_their_rates() -> None:
    """They come after the bodies and before the multipliers, whatever joints have some."""
    joints = {
        "cam": SimpleNamespace(coordinates=(("u", "m"), ("v", "rad")), bodies=()),
        "pin": SimpleNamespace(coordinates=(), bodies=()),
    }
    compiled = SimpleNamespace(
        bodies={},
        named_bodies={},
        constraints=joints,
        forces={},
        shown_forces={},
        measures={},
        row_names=lambda: ["pin.x"],
        state_names=lambda: ["motor.current"],
    )
    solution: Any = SimpleNamespace(compiled=compiled)
    assert list(table.column_names(solution, table.Extent()))[:6] == [
        *("cam.u", "cam.u_rate", "cam.v", "cam.v_rate"),
        *("pin.lambda_x", "motor.current"),
    ]


def test_the_torque_is_written_once_however_the_frame_is_given(
    sol: kp.Solution, tmp_path: Path
) -> None:
    sol.to_csv(tmp_path / "s.csv", frames=["".join(["glo", "bal"]), "joint"])
    header = list(read(tmp_path / "s.csv"))
    name, joint = next(iter(sol.model.constraints.items()))
    torques = [f"{name}.torque_on_{body} [N*m]" for body in joint.bodies if body != "ground"]
    assert [one for one in header if one.startswith(f"{name}.torque_on")] == torques


def test_columns_and_their_extent_cannot_change(sol: kp.Solution) -> None:
    for one, name in ((table.columns(sol)[0], "unit"), (table.Extent(), "points")):
        with pytest.raises(FrozenInstanceError):
            setattr(one, name, "x")


def test_without_pandas_the_remedy_is_named(
    sol: kp.Solution, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(kp.ModelError, match="pip install pandas"):
        sol.to_dataframe()


def test_a_motion_over_a_quantity_has_it_once_and_all_that_follow() -> None:
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    ends = ["70 deg", "90 deg"]
    found = kp.kinematics(case.model, case.start(), over="crank.angle", range=ends, n=5)
    names = [column.name for column in table.columns(found)]
    assert names[0] == "crank.angle" and names.count("crank.angle") == 1
    assert {"coupler.x", "rocker.angle", "rocker.omega"} <= set(names)


def test_a_column_is_unique_if_nothing_was_chosen() -> None:
    values = np.zeros(2)
    assert table.Column("a", "N", values).unique
    assert not table.Column("a", "N", values, "minimum norm").unique
