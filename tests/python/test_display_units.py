"""Units of tables, figures and CSV files, chosen once."""

import csv
import io
import math
from collections.abc import Iterator

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.base.display_units import chosen_for, display
from kempe.draw.units import scale


@pytest.fixture(autouse=True)
def si_units() -> Iterator[None]:
    yield
    kp.units("SI")


@pytest.mark.parametrize(
    ("chosen", "si", "unit", "value"),
    [
        ("mm", "m", "mm", 1e-3),
        ("mm", "m/s", "mm/s", 1e-3),
        ("mm", "m/s²", "mm/s^2", 1e-3),
        ("in", "m", "in", 0.0254),
        ("deg", "rad", "deg", math.pi / 180),
        ("deg", "rad/s", "deg/s", math.pi / 180),
        ("rpm", "rad/s", "rpm", 2 * math.pi / 60),
        ("rpm", "rad/s^2", "rad/s^2", 1.0),
        ("rev/min", "rad/s", "rev/min", 2 * math.pi / 60),
        ("kN", "N", "kN", 1e3),
        ("kN", "N·m", "N·m", 1.0),
        ("N*mm", "N·m", "N*mm", 1e-3),
        ("N mm", "N·m", "N*mm", 1e-3),
        ("N*mm", "J", "J", 1.0),
        ("kJ", "J", "kJ", 1e3),
        ("ms", "s", "ms", 1e-3),
        ("ms", "m/s", "m/s", 1.0),
        ("mm", "Pa", "Pa", 1.0),
    ],
)
def test_one_of_a_unit_is_so_much_in_si(chosen: str, si: str, unit: str, value: float) -> None:
    kp.units(chosen)
    shown = display(si)
    assert shown.unit == unit
    assert shown.divisor == pytest.approx(value, rel=1e-15)


def test_one_text_means_the_same_as_several() -> None:
    assert kp.units("mm, deg ,rpm").chosen == kp.units("mm", "deg", "rpm").chosen
    assert kp.units().chosen == ("mm", "deg", "rpm")
    kp.units("SI")
    assert chosen_for("m") is None


def test_a_block_ends_with_the_earlier_units() -> None:
    kp.units("cm")
    with kp.units("mm"):
        assert display("m").unit == "mm"
    assert display("m").unit == "cm"


def test_without_a_choice_a_quantity_has_the_usual_unit() -> None:
    assert display("rad", "deg").divisor == pytest.approx(math.pi / 180)
    kp.units("rad")
    assert display("rad", "deg").unit == "rad"


@pytest.mark.parametrize(
    ("names", "message"),
    [
        (("mmm",), r"unknown unit 'mmm'; did you mean 'mm'\?"),
        (("kg/s",), "'kg/s' measures no shown quantity"),
        (("mm", "cm"), "'mm' and 'cm' measure the same quantity; choose one of them"),
        (("m//s",), "'m//s' is not a unit"),
        (("",), "names no unit"),
        ((3,), "not texts"),
    ],
)
def test_a_wrong_unit_is_refused_and_the_earlier_ones_stay(names: tuple, message: str) -> None:
    kp.units("cm")
    with pytest.raises(kp.ModelError, match=message):
        kp.units(*names)
    assert kp.units().chosen == ("cm",)


def test_an_axis_has_the_chosen_unit() -> None:
    kp.units("mm", "deg", "kN")
    assert scale("m", 20.0).axis("x") == "x / mm"
    assert scale("rad", 3.0).axis("φ") == "φ / °"
    assert scale("m/s²", 3.0).axis("a") == "a / (mm/s²)"
    assert scale("N", 1.0).divisor == 1e3
    kp.units("m")
    assert scale("m", 1e-3).axis("x") == "x / m"


def test_a_figure_shows_the_chosen_units() -> None:
    import matplotlib

    matplotlib.use("Agg")
    case = kp.load(ROOT / "examples/slider_crank.toml")
    name = next(iter(case.analyses))
    sol = case.with_analysis(name, t_end=0.1, output_step=0.01).run()[0]
    body = "rod"
    kp.units("mm", "deg", "ms")
    drawn = kp.plot.positions(sol, body, quantity="x")
    assert drawn.get_ylabel() == "x / mm"
    assert drawn.get_xlabel() == "time t / ms"
    motion = sol(drawn.lines[0].get_xdata() / 1e3)
    np.testing.assert_allclose(drawn.lines[0].get_ydata(), motion[body].x * 1e3, rtol=1e-9)
    angle = kp.plot.positions(sol, body, quantity="angle")
    assert angle.get_ylabel() == "φ / °"
    np.testing.assert_allclose(
        angle.lines[0].get_ydata(), np.degrees(motion[body].angle), atol=1e-12
    )
    assert not [axes for axes in angle.child_axes if axes.get_ylabel() == "φ / °"]


def test_printed_tables_have_the_chosen_units(capsys: pytest.CaptureFixture[str]) -> None:
    from kempe.cli.console import answers
    from kempe.cli.findings import show_findings
    from kempe.cli.mechanism import show_configuration
    from kempe.report import summary

    case = kp.load(ROOT / "examples/four_bar.toml").with_analysis("release", t_end=5)
    sol = case.run()[0]
    found = summary(sol)
    kp.units("mm", "rad", "kN", "kN*m", "ms", "kJ")
    show_configuration(answers(), case.start())
    show_findings(answers(), "release", found)
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["crank", "1710.1", "4698.46", "1.22173", "0", "0", "0"] in lines
    reaction = found["peaks"]["reactions"][2]
    assert ["C", "rocker", f"{reaction['force'] / 1e3:.6g}", "0"] in lines
    assert ["joint", "on", "force", "/", "kN", "at", "/", "ms"] in lines
    settled = found["settling"][2]
    row = ["rocker", f"{settled['time'] * 1e3:.6g}", "ms", f"{settled['angle']:.6g}", "rad"]
    assert row in lines
    largest = f"{found['energy']['scale'] / 1e3:.6g}"
    assert any(line[-2:] == [largest, "kJ"] for line in lines)
    spring = found["peaks"]["forces"][0]["torque_by_part"]
    told = ["stiffness", f"{spring['stiffness'] / 1e3:.6g},"]
    assert any(line[-4:-2] == told for line in lines if line[:1] == ["spring"])
    residual = found["peaks"]["residual"]
    assert any(f"{residual['value'] * 1e3:.3g}" in line and "mm" in line for line in lines)


def cells(shown: kp.Labelled) -> tuple[list[str], list[str], np.ndarray]:
    """Names of columns and rows, and numbers, as the CSV has them."""
    header, *lines = csv.reader(io.StringIO(shown.csv()))
    return header[1:], [one[0] for one in lines], np.array([one[1:] for one in lines], dtype=float)


@pytest.mark.parametrize("name", ["slider_crank", "six_bar", "four_bar"])
@pytest.mark.parametrize("units", ["SI", "mm,deg", "cm,kN,N*mm,rpm", "ms,deg/s^2,N*mm"])
def test_matrices_in_display_units_still_belong_together(name: str, units: str) -> None:
    """M a + Φ_qᵀ λ = Q and Φ_q a = γ hold for the numbers that are written."""
    state = kp.load(ROOT / "examples" / f"{name}.toml").start()
    with kp.units(units):
        parts = {n: cells(kp.show(state.model, state, n)) for n in ("kkt", "a", "lam", "rhs", "M")}
    unknowns = np.concatenate([parts["a"][2], parts["lam"][2]])[:, 0]
    found, expected = parts["kkt"][2] @ unknowns, parts["rhs"][2][:, 0]
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())
    n = len(state.q)
    np.testing.assert_array_equal(parts["M"][2], parts["kkt"][2][:n, :n])
    names = {one: [[n.partition(" [")[0] for n in p] for p in parts[one][:2]] for one in parts}
    assert names["kkt"][1] == names["rhs"][1]
    assert names["kkt"][0] == [*names["a"][1], *(f"λ {one}" for one in names["lam"][1])]
    assert names["M"] == [names["a"][1], names["a"][1]]


def test_numbers_of_matrices_have_the_units_beside_them() -> None:
    """A crank of 0.1 m with 2 kg at 60°: its pin is 50 mm and 86.6 mm from its middle at O."""
    state = kp.load(ROOT / "examples" / "slider_crank.toml").start()
    shown = {n: kp.show(state.model, state, n) for n in ("M", "Phi_q", "lam", "Phi", "nu", "gamma")}
    jacobian = kp.show(state.model, state, "Phi_q", assembly={"crank.angle": 1.0})
    values = {name: one.values.copy() for name, one in shown.items()}
    with kp.units("mm,deg,kN"):
        columns, rows, numbers = cells(shown["Phi_q"])
        at = numbers[rows.index("A.x [mm]"), columns.index("crank.angle [deg]")]
        assert abs(at) == pytest.approx(1e2 * math.sqrt(0.75) * math.pi / 180.0)
        columns, rows, numbers = cells(shown["M"])
        at = numbers[rows.index("crank.x [kN]"), columns.index("crank.x [mm/s^2]")]
        assert at == pytest.approx(2e-6)
        assert rows[2] == "crank.angle [N*m]"
        _, rows, numbers = cells(shown["lam"])
        np.testing.assert_allclose(numbers[:-1, 0], values["lam"][:-1] / 1e3)
        assert (rows[0], rows[-1]) == ("O.x [kN]", "guide.angle [N*m]")
        assert [cells(shown[n])[1][0] for n in ("Phi", "nu", "gamma")] == [
            *("O.x [mm]", "O.x [mm/s]", "O.x [mm/s^2]"),
        ]
        assert cells(jacobian)[1][-1] == "set.crank.angle [deg]"
        assert shown["lam"].title == "λ, multipliers, kN and N·m, 8"
        assert shown["gamma"].title.endswith("mm/s² and °/s², 8")
        assert shown["M"].title == "M, mass matrix, in mm, deg, kN, 9 × 9"
        for text in (shown["lam"].text(), shown["lam"].latex(), shown["lam"]._repr_html_()):
            assert "guide.normal [kN]" in text, text
        assert "0.0547" in shown["lam"].text()  # 54.72 N
    assert shown["M"].title == "M, mass matrix, 9 × 9"
    assert cells(shown["lam"])[1][0] == "O.x"
    for name, one in shown.items():
        np.testing.assert_array_equal(one.values, values[name])
