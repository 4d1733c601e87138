"""``kp.compare``: differences that are known, to solutions and to tables of all kinds."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest


def thrown(g: float = 10.0, **options: object) -> kp.Solution:
    """A thrown point: x = 3 t, y = 20 t - g t²/2."""
    m = kp.Model("thrown", gravity=(0, -g))
    m.point_mass("ball", mass=2)
    start = kp.assemble(m, {"ball.x": 0, "ball.y": 0, "ball.vx": 3, "ball.vy": 20})
    return kp.dynamics(m, start, t_end=2, output_step=0.1, **options)  # type: ignore[arg-type]


def differing(found: kp.Comparison) -> list[str]:
    """The quantities that differ by more than rounding errors."""
    pairs = found.largest.items()
    return [name for name, size in pairs if size > 1e-9 and found.relative[name] > 1e-6]


T = np.linspace(0, 2, 37)


def test_the_largest_difference_to_arrays_is_found() -> None:
    y = 20 * T - 5 * T**2
    y[11] += 0.25
    found = kp.compare(thrown(), {"t": T, "ball.x [mm]": 3000 * T, "ball.y": y})
    assert found.largest["ball.x"] == pytest.approx(0, abs=1e-9)
    assert found.largest["ball.y"] == pytest.approx(0.25, rel=1e-9)
    assert found.at["ball.y"] == T[11]
    assert found.relative["ball.y"] == pytest.approx(0.25 / y.max(), rel=1e-9)
    assert found.unread == ()
    assert "ball.y    0.25 m" in str(found)


def test_another_solution_is_compared_by_all_common_quantities() -> None:
    found = kp.compare(thrown(10.0), thrown(10.2))
    assert found.largest["ball.y"] == pytest.approx(0.1 * 4, rel=1e-9)
    assert found.largest["ball.vy"] == pytest.approx(0.4, rel=1e-9)
    assert found.largest["ball.ay"] == pytest.approx(0.2, rel=1e-9)
    assert found.largest["energy.kinetic"] > 0
    assert found.largest["ball.vx"] == pytest.approx(0, abs=1e-9)
    one = kp.compare(thrown(10.0), thrown(10.2), quantities=["ball.y", "2*ball.y - ball.x"])
    assert list(one.largest) == ["ball.y", "2*ball.y - ball.x"]
    assert one.largest["2*ball.y - ball.x"] == pytest.approx(0.8, rel=1e-9)


def test_motions_over_different_quantities_are_not_compared() -> None:
    m = kp.Model("rod")
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    start = kp.assemble(m, {"rod.angle": 0})
    names = ("rod.angle", "rod.P.y")
    over = [kp.kinematics(m, start, over=name, range=(0, 0.5)) for name in names]
    timed = kp.dynamics(m, start, t_end=1, output_step=0.1)
    for one, other, pair in (
        (over[0], over[1], "rod.angle and rod.P.y"),
        (over[0], timed, "rod.angle and t"),
        (timed, over[0], "t and rod.angle"),
    ):
        with pytest.raises(kp.ModelError) as caught:
            kp.compare(one, other)
        assert f"reference: the motions go over different quantities, {pair}" in str(caught.value)
    assert kp.compare(over[0], over[0]).largest["rod.y"] == 0.0


@pytest.mark.parametrize("name", ["four_bar", "slamming_door", "cam_roller", "motor_press"])
def test_the_own_files_have_no_difference(name: str, tmp_path: Path) -> None:
    """Also with impacts, where two rows have the same time, and with forces."""
    case = kp.load(f"examples/{name}.toml")
    found = case.run()
    solution = next(of for of in found.values() if isinstance(of, kp.Solution))
    solution.to_csv(tmp_path / "run.csv")
    for reference in (solution, tmp_path / "run.csv", solution.to_dataframe()):
        compared = kp.compare(solution, reference)
        assert len(compared.largest) > 10
        assert differing(compared) == []
    with kp.units("deg", "mm"):
        compared = kp.compare(solution, solution.to_dataframe())
        assert differing(compared) == []


def test_columns_have_other_names(tmp_path: Path) -> None:
    file = tmp_path / "measured.csv"
    file.write_text(
        "time [ms];phi [cm];note [m]\n0;0;1\n500;150;1\n1000;;1\n2000;601;1\n9000;1;1\n"
    )
    found = kp.compare(thrown(), file, {"ball.x": "phi [cm]"}, t="time")
    assert found.largest == {"ball.x": pytest.approx(0.01, rel=1e-6)}
    assert found.unread == (
        "ball.x in 1 rows without a value",
        "ball.x at 1 times outside of the motion",
    )


def test_what_is_not_compared_is_named() -> None:
    found = kp.compare(thrown(), {"t": T, "ball.x": 3 * T, "ball.w": T, "k": T})
    assert list(found.largest) == ["ball.x"]
    assert "'ball.w'" in found.unread[0] and "'k'" in found.unread[1]
    assert "not compared" in str(found)


@pytest.mark.parametrize(
    ("table", "told"),
    [
        ({"t": T, "ball.x [s]": T}, "the quantity is in m"),
        ({"t": T, "a": T}, "no header is a quantity"),
        ({"t": T + 9, "ball.x": T}, "nothing to compare; ball.x at 37 times outside"),
        ({"time": T, "ball.x": T}, "time"),
        ({"t": T, "ball.vx [Hz]": T}, "it is in Hz as written"),
        ({"t [Hz]": T, "ball.x": T}, "it is in Hz as written"),
        ({"t": T, "ball.x [m]": T, "ball.x [mm]": T}, "both columns of ball.x"),
        ({"t": T, "ball.x": T[1:]}, "values for 37 times"),
        (3, "not a table"),
    ],
)
def test_an_impossible_reference_is_refused(table: object, told: str) -> None:
    with pytest.raises(kp.ModelError, match=told):
        kp.compare(thrown(), table)


def test_values_that_are_missing_are_named() -> None:
    masked = np.ma.masked_less(3 * T, 1e-3)  # the first one is missing
    empty = np.full(37, np.nan)
    found = kp.compare(thrown(), {"t": T, "ball.x": masked, "ball.y": empty})
    assert found.largest == {"ball.x": pytest.approx(0.0, abs=1e-9)}
    assert found.unread == (
        "column 'ball.y', which has no values",
        "ball.x in 1 rows without a value",
    )
    with pytest.raises(kp.ModelError, match=r"ball\.y.* has no values"):
        kp.compare(thrown(), {"t": T, "ball.x": T, "ball.y": empty}, quantities=["ball.y"])


def test_measures_of_other_units_are_refused() -> None:
    runs = []
    for formula in ("ball.x", "ball.vx"):
        model = thrown().compiled.model
        model.measures(same=formula)
        runs.append(kp.dynamics(model, kp.assemble(model), t_end=1))
    with pytest.raises(kp.ModelError, match=r"same: its units differ: m in .*, m/s in"):
        kp.compare(*runs)


def test_a_solution_without_interpolant_is_refused() -> None:
    with pytest.raises(kp.ModelError, match="no interpolant") as caught:
        kp.compare(thrown(dense_output=False), thrown())
    assert "dense_output" in str(caught.value.hint)


def test_the_figure_shows_the_quantities_that_differ_most() -> None:
    y = 20 * T - 5 * T**2 + 0.1
    found = kp.compare(thrown(), {"t": T, "ball.x [mm]": 3000 * T, "ball.y": y})
    made = kp.plot.comparison(found)
    above, below = made.axes[:2]
    assert "ball.y" in above.get_ylabel() and len(made.axes) == 4
    assert below.lines[0].get_ydata() == pytest.approx(np.full(37, -0.1), abs=1e-9)
    assert len(kp.plot.comparison(found, ["ball.x"]).axes) == 2
    with pytest.raises(kp.ModelError, match="quantity of the comparison"):
        kp.plot.comparison(found, ["ball.z"])
