"""Tables in Python: values, files, saving, pickling and wrong input."""

import json
import pickle
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.model.lookup_tables import TableFile
from numpy.polynomial import Polynomial

ANGLES = [0, 90, 180, 270, 360]
LIFTS = [0, 10, 20, 10, 0]


def slide(value: str = "lift(3*t)") -> kp.Model:
    """A slide along x that follows a law; its table is still missing."""
    m = kp.Model("slide")
    m.ground.points(O=(0, 0))
    m.body("slide", mass=2, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.coordinate_driver("cam", "slide.x", value=value)
    return m


def with_lift(**changes: Any) -> kp.Model:
    m = slide()
    given: dict[str, Any] = {"x": ANGLES, "y": LIFTS, "x_unit": "deg", "y_unit": "mm"}
    m.table("lift", **({**given, "periodic": True} | changes))
    return m


def points_in(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def test_a_driver_follows_a_table() -> None:
    m = with_lift(interpolation="quintic")
    sol = kp.dynamics(m, kp.assemble(m), t_end=2.5, output_step=0.01)
    lift = m.tables["lift"]
    np.testing.assert_allclose(sol["slide.x"], lift(3 * sol.t), atol=1e-11)
    np.testing.assert_allclose(sol["slide.vx"], 3 * lift(3 * sol.t, derivative=1), atol=1e-10)
    np.testing.assert_allclose(sol["slide.ax"], 9 * lift(3 * sol.t, derivative=2), atol=1e-9)
    force = sol.driver("cam").force(on="slide")[:, 0]
    np.testing.assert_allclose(force, 18 * lift(3 * sol.t, derivative=2), atol=1e-8)


def test_a_quintic_table_is_the_parabola_through_three_points() -> None:
    m = slide()
    m.table("lift", x=np.array([-1.0, 0.5, 2.0]), y=(3.0, -1.0, 4.0), interpolation="quintic")
    parabola = Polynomial.fit([-1.0, 0.5, 2.0], [3.0, -1.0, 4.0], 2)
    x = np.linspace(-1, 2, 31).reshape(1, 31)
    for order, curve in enumerate([parabola, parabola.deriv(), parabola.deriv(2)]):
        np.testing.assert_allclose(m.tables["lift"](x, derivative=order), curve(x), atol=1e-12)
    assert m.tables["lift"].range == (-1.0, 2.0)
    assert np.isnan(m.tables["lift"](2.1))
    assert "'lift': quintic, -1 to 2" in repr(m.tables["lift"])


def test_a_table_is_known_in_parameters_forces_and_printed_equations() -> None:
    m = kp.Model(parameters={"k": "2*lift(90*deg)", "h": "1 mm"})
    m.table("lift", x=ANGLES, y=LIFTS, x_unit="deg", y_unit="mm", periodic=True)
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("A", "B"))
    m.revolute("O", "ground.O", "rod.A")
    m.coordinate_driver("turn", "rod.angle", value="lift(t)/h")
    assert m.parameters["k"] == pytest.approx(0.02, abs=1e-15)
    (turn,) = [told for told in kp.equations(m) if told.name == "turn"]
    assert "lift(t)/h" in turn.text()
    assert "lift''(t)/h" in turn.text()


@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_a_case_keeps_its_tables(tmp_path: Path, suffix: str) -> None:
    case = kp.Case(with_lift(interpolation="monotone"))
    path = tmp_path / f"case{suffix}"
    case.save(path)
    assert kp.load(path).tree() == case.tree()
    entry = case.tree()["tables"]["lift"]
    assert list(entry) == ["x", "y", "x_unit", "y_unit", "interpolation", "periodic"]


def test_defaults_are_not_written() -> None:
    m = with_lift(periodic=False, x_unit=None, y_unit=None, outside="refuse")
    assert m.tree()["tables"]["lift"] == {"x": ANGLES, "y": LIFTS}


def test_a_model_with_tables_is_pickled_and_changed() -> None:
    m = with_lift()
    m.compile()
    copy = pickle.loads(pickle.dumps(m))
    assert copy.tree() == m.tree()
    assert copy.tables["lift"](1.0) == m.tables["lift"](1.0)
    compiled = pickle.loads(pickle.dumps(m.compile()))
    assert compiled.tables["lift"](1.0) == m.tables["lift"](1.0)
    m.table("other", x=[0, 1], y=[0, 1], interpolation="linear")
    assert list(m.tables) == ["lift", "other"]


CSV = "# measured\nangle / deg,lift,note\n0,0,start\n90,10,\n\n180,20,top\n270,10,\n360,0,end\n"
COLUMNS = ("angle / deg", "lift")


def in_file(file: Path | str, **changes: Any) -> kp.Model:
    m = slide()
    units = {"x_unit": "deg", "y_unit": "mm", "periodic": True}
    m.table("lift", file=file, **({"columns": COLUMNS, **units} | changes))
    return m


def test_points_are_read_from_a_file(tmp_path: Path) -> None:
    m = in_file(points_in(tmp_path / "lift.csv", CSV))
    x = np.linspace(0, 7, 50)
    np.testing.assert_array_equal(m.tables["lift"](x), with_lift().tables["lift"](x))


@pytest.mark.parametrize(
    "text",
    ["0,0\n90,10\n180,20\n270,10\n360,0\n", "angle;lift\n0;0\n90;10\n180;20\n270;10\n360;0\n"],
)
def test_the_first_two_columns_are_taken(tmp_path: Path, text: str) -> None:
    m = in_file(points_in(tmp_path / "lift.csv", text), columns=None)
    assert m.tables["lift"](np.pi) == pytest.approx(0.02, abs=1e-15)


def test_a_saved_case_refers_to_the_file_from_its_own_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "data").mkdir()
    points_in(tmp_path / "data" / "lift.csv", CSV)
    monkeypatch.chdir(tmp_path)
    case = kp.Case(in_file("data/lift.csv"))
    case.save("cases/cam.toml")
    written = (tmp_path / "cases" / "cam.toml").read_text(encoding="utf-8")
    assert 'file = "../data/lift.csv"' in written
    assert "x =" not in written
    monkeypatch.chdir("/")
    again = kp.load(tmp_path / "cases" / "cam.toml")
    assert again.model.tables["lift"](np.pi) == pytest.approx(0.02, abs=1e-15)
    # elsewhere, and with another parameter
    again.save(tmp_path / "cam.json")
    entry = json.loads((tmp_path / "cam.json").read_text(encoding="utf-8"))["tables"]["lift"]
    assert entry["file"] == "data/lift.csv"
    assert list(kp.load(tmp_path / "cam.json").tree()["tables"]["lift"])[:2] == ["file", "columns"]


def test_results_need_no_file(tmp_path: Path) -> None:
    file = points_in(tmp_path / "lift.csv", CSV)
    case = kp.Case(in_file(file), analyses=[kp.Dynamics(0.5, output_step=0.1)])
    path = tmp_path / "case.toml"
    case.save(path)
    loaded = kp.load(path)
    (sol,) = loaded.run().values()
    sol.save(tmp_path / "run.npz")
    text = pickle.dumps(loaded.model)
    file.unlink()
    stored = kp.load_solution(tmp_path / "run.npz")
    np.testing.assert_array_equal(stored["slide.x"], sol["slide.x"])
    assert stored.model.tables["lift"](np.pi) == pytest.approx(0.02, abs=1e-15)
    assert pickle.loads(text).tables["lift"](np.pi) == pytest.approx(0.02, abs=1e-15)
    with pytest.raises(
        kp.FileError, match=r"tables.lift: cannot read .*lift.csv: it does not exist"
    ):
        kp.load(path)


def test_a_parameter_of_a_case_with_a_file_is_changed(tmp_path: Path) -> None:
    points_in(tmp_path / "lift.csv", CSV)
    m = slide("h*lift(3*t)")
    m.table("lift", file=tmp_path / "lift.csv", x_unit="deg")
    tree = m.tree() | {"parameters": {"h": 1}}
    case = kp.Case(kp.Model.from_tree(tree, folder=tmp_path))
    case.save(tmp_path / "case.toml")
    changed = kp.load(tmp_path / "case.toml", parameters={"h": 3})
    assert kp.assemble(changed.model)["slide.vx"] == pytest.approx(
        9 * float(case.model.tables["lift"](0.0, derivative=1)), rel=1e-12
    )


@pytest.mark.parametrize(
    ("text", "columns", "message"),
    [
        ("angle,lift\n0,0\n1,x\n", None, r"line 3 of .*lift.csv: 'x' in column 2 is not a finite"),
        ("angle,lift\n0,0\n1\n", None, r"line 3 of .*: '' in column 2"),
        ("angle,lift\n0,0\n1,nan\n", None, "'nan' in column 2 is not a finite number"),
        ("angle,lift\n0,0\n", ("angle", "lifd"), "has no column 'lifd'; it has 'angle', 'lift'"),
        ("0,0\n1,1\n", ("a", "b"), "has no names of columns; remove columns"),
        ("angle\n0\n", None, "has one column"),
        ("# nothing\n", None, "has no points"),
    ],
)
def test_a_wrong_file_is_refused(
    tmp_path: Path, text: str, columns: tuple[str, str] | None, message: str
) -> None:
    with pytest.raises(kp.FileError, match=message) as caught:
        in_file(points_in(tmp_path / "lift.csv", text), columns=columns)
    assert str(caught.value).startswith("tables.lift: ")


def test_faults_of_points_in_a_file_have_the_line_of_the_case(tmp_path: Path) -> None:
    points_in(tmp_path / "lift.csv", "0,0\n90,10\n80,20\n360,0\n")
    path = tmp_path / "case.toml"
    path.write_text('kempe = 1\n\n[tables.lift]\nfile = "lift.csv"\n', encoding="utf-8")
    message = r"x\[2\] = 80 does not exceed x\[1\] = 90 \(point 3 of lift.csv\) \(line 3"
    with pytest.raises(kp.ModelError, match=message):
        kp.load(path)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"x": [0, 90, 180, 170, 360]},
            r"tables.lift.x.3: x\[3\] = 170 does not exceed x\[2\] = 180",
        ),
        ({"y": [0, 1]}, "tables.lift.y: 2 numbers, but x has 5; give one y for each x"),
        ({"y": [0, 1, 2, 3, 4]}, r"y\[4\] = 4 is not y\[0\] = 0, as a period needs"),
        ({"y": [0, 1, float("nan"), 3, 0]}, r"tables.lift.y\[2\]: nan; must be finite"),
        ({"y": [0, "h", 2, 3, 0]}, r"tables.lift.y\[1\]: 'h' is not a number; write h\*lift\(x\)"),
        ({"x": None}, "tables.lift.x: missing; a table needs it"),
        ({"file": "a.csv"}, "cannot read .*a.csv: it does not exist"),
        ({"x_unit": "degree"}, "tables.lift.x_unit: unknown unit 'degree'; write 'deg'"),
        ({"y_unit": "N"}, "'lift\\(3\\*t\\)' is in N .* must be in m"),
        ({"interpolation": "spline"}, "unknown word 'spline'; it may be linear, cubic"),
        ({"outside": "hold"}, "a periodic table has no outside; remove outside, or periodic"),
        (
            {"interpolation": "linear"},
            'makes the velocity jump .* interpolation = "cubic" in tables',
        ),
        (
            {"x": [0, 180, 360], "y": [0, 1, 0]},
            "3 points; the interpolation periodic cubic needs at",
        ),
        ({"periodic": "yes"}, "tables.lift.periodic: 'yes'; must be True or False"),
    ],
)
def test_wrong_tables_are_refused(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(kp.KempeError, match=message):
        with_lift(**changes).compile()


@pytest.mark.parametrize("name", ["sin", "harmonic", "t", "h", "a b", "1st"])
def test_names_that_formulas_cannot_call_are_refused(name: str) -> None:
    m = kp.Model(parameters={"h": 1})
    m.table(name, x=[0, 1], y=[0, 1])
    with pytest.raises(kp.ModelError, match=r"another name|rename the table or the parameter"):
        m.compile()
    with pytest.raises(kp.ModelError, match="the name is taken by another table"):
        m.table(name, x=[0, 1], y=[0, 1])


def test_names_of_functions_are_refused_for_parameters_only() -> None:
    with pytest.raises(
        kp.ModelError, match="reserved: it is a function of formulas; rename the para"
    ):
        kp.Model(parameters={"harmonic": 1}).compile()
    m = kp.Model()
    m.body("harmonic", mass=1, inertia=1)
    m.torque("push", "harmonic", torque="2*harmonic.omega")
    assert kp.assemble(m, set={"harmonic.omega": 3})["harmonic"].alpha == pytest.approx(6)


def test_a_run_that_leaves_the_range_names_the_table() -> None:
    m = with_lift(periodic=False)
    with pytest.raises(kp.IntegrationError) as caught:
        kp.dynamics(m, kp.assemble(m), t_end=3, output_step=0.01)
    message = str(caught.value)
    assert "the law value of cam has no value there: table 'lift' is read at x = 36" in message
    assert "outside its range from 0 to 360 deg; give the table more points" in message
    assert caught.value.solution.t[-1] == pytest.approx(2 * np.pi / 3, abs=0.011)
    held = with_lift(periodic=False, outside="hold", interpolation="quintic")
    np.testing.assert_allclose(held.tables["lift"]([7.0, -1.0]), 0.0, atol=1e-16)
    assert held.tables["lift"](7.0, derivative=1) == 0.0


def test_the_core_refuses_unknown_tables() -> None:
    core = with_lift().compile().core
    with pytest.raises(kp.ModelError, match="there is no table 'gift'"):
        core.table("gift", 0, np.zeros(1))
    with pytest.raises(kp.ModelError, match="derivative: 6; must be at most 5"):
        core.table("lift", 6, np.zeros(1))


DAMAGED = {
    "a line break in quotation marks": ('x,y\n0,0\n"1\n2",3\n2,4\n', r"line 3 of .*one line"),
    "a quotation mark without its end": ('x,y\n0,"0\n1,1\n2,3\n', r"line 2 of .*one line"),
    "a line break in a name": ('"x\nm",y\n0,0\n1,1\n', r"line 1 of .*one line"),
    "a long field": ("x,y\n0," + "9" * 200_000 + "\n1,1\n", r"line 2 of .*one line"),
    "a long text": ("x,y\n0," + "b" * 1000 + "\n1,1\n", r"line 2 of .*'b{40}…' in column 2"),
    "one column": ("x\n0\n1\n", "one column; write two columns"),
    "tabs": ("0\t1\n1\t2\n", "one column; .*comma or a semicolon"),
    "no numbers": ("x,y\n", "no points; write numbers below"),
    "commas in numbers": ("x;y\n0,5;1,5\n1,0;2\n", r"line 2 .*'0,5'.*decimal point"),
    "a number of Python only": ("x,y\n0,1_000\n1,2\n", r"line 2 .*'1_000'"),
    "a separator of Unicode": ("x,y\n0,0\x1c1,1\n2,2\n", r"line 2 .*column 2"),
}


@pytest.mark.parametrize(("text", "told"), DAMAGED.values(), ids=DAMAGED.keys())
def test_a_damaged_file_is_refused_with_its_line(text: str, told: str, tmp_path: Path) -> None:
    (tmp_path / "lift.csv").write_bytes(text.encode())
    with pytest.raises(kp.FileError, match=told) as caught:
        TableFile.read("lift", {"file": "lift.csv"}, tmp_path)
    assert len(str(caught.value)) < 400 + len(str(tmp_path))


def test_one_name_of_a_column_is_refused(tmp_path: Path) -> None:
    (tmp_path / "lift.csv").write_text("x,y\n0,0\n1,1\n")
    with pytest.raises(kp.FileError, match=r"columns: 1 given; must be 2; name two"):
        TableFile.read("lift", {"file": "lift.csv", "columns": ["x"]}, tmp_path)
