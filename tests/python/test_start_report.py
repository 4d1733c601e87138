"""The start report: what was left unset, what was chosen, and angles that look like degrees."""

import json
import warnings
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.cli import app
from kempe.results.assembly_report import AssemblyReport, Mode
from mobility.named import NAMED
from redundant.pinned import PINNED


def pendulums(count: int = 2) -> kp.Model:
    """A chain of rods of 1 m and 1 kg."""
    m = kp.Model("chain", gravity=(0, -9.81))
    m.ground.points(E0=(0, 0))
    for k in range(count):
        m.bar(f"rod{k}", mass=1, length=1, ends=(f"E{k}", f"E{k + 1}"))
        before = f"rod{k - 1}" if k else "ground"
        m.revolute(f"J{k}", f"{before}.E{k}", f"rod{k}.E{k}")
    return m


def four_bar(**more: object) -> kp.Model:
    m = kp.Model("four-bar")
    m.ground.points(A=(0, 0), D=(4, 0))
    m.bar("crank", mass=1, length=1, ends=("A", "B"), **more)  # type: ignore[arg-type]
    m.bar("coupler", mass=1, length=3.5, ends=("B", "C"))
    m.bar("rocker", mass=1, length=2.5, ends=("D", "C"))
    for pin, i, j in (("A", "ground", "crank"), ("B", "crank", "coupler")):
        m.revolute(pin, f"{i}.{pin}", f"{j}.{pin}")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    return m


def test_the_loose_rod_moves_by_least_energy() -> None:
    # d/dω of the kinetic energy of the second rod is zero at ω = -3/2 cos(φ - φ1) ω1
    for angle in (0.0, 0.4, 2.0):
        start = kp.assemble(
            pendulums(), set={"rod0.angle": 0.3, "rod0.omega": 7, "rod1.angle": 0.3 + angle}
        )
        unset = start.report.unset
        assert (unset.freedoms, unset.free_rates, unset.coordinates) == (0, 1, ())
        (rate,) = unset.rates
        assert (rate.name, rate.unit, rate.source) == ("rod1.omega", "rad/s", "least energy")
        assert rate.value == pytest.approx(-10.5 * np.cos(angle), abs=1e-12)
        assert rate.value == start["rod1.omega"]
        shown = f"{rate.value:.6g}"
        assert str(unset) == f"not set: rod1.omega = {shown} rad/s (least energy)"


def test_sources_of_positions_and_rates() -> None:
    told = str(kp.assemble(four_bar()).report.unset)
    assert told == "not set: crank.angle = 0° (no guess); crank.omega = 0 (at rest)"
    told = str(kp.assemble(four_bar(), guess={"rocker.angle": 2.0}).report.unset)
    assert told == "not set: rocker.angle = 114.592° (guess); rocker.omega = 0 (at rest)"
    told = str(kp.assemble(four_bar(), set={"rocker.angle": 2.0}).report.unset)
    assert told == "not set: rocker.omega = 0 (at rest)"
    # of two guesses that contradict each other, the one that was met is named
    start = kp.assemble(four_bar(), guess={"coupler.angle": 0.9, "crank.angle": 1.0})
    assert start["crank.angle"] == 1.0
    assert "crank.angle = 57.2958° (guess)" in str(start.report.unset)
    # the coupler cannot reach its guess; where it comes nearest, it does not determine the position
    start = kp.assemble(four_bar(), guess={"coupler.angle": 1.2})
    angles = np.linspace(0, 2 * np.pi, 721)
    turned = [kp.assemble(four_bar(), set={"crank.angle": x})["coupler.angle"] for x in angles]
    assert max(turned) - 1e-5 < start["coupler.angle"] < 1.2
    (place,) = start.report.unset.coordinates
    assert (place.name, place.source, place.value) == (
        "crank.angle",
        "nothing",
        start["crank.angle"],
    )
    start = kp.assemble(four_bar(), guess={"A.angle": 1.0})
    assert "crank.angle = 57.2958° (from the guesses)" in str(start.report.unset)
    m = kp.Model("drawn")
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=1, through={"A": (0, 0), "B": (1, 1)})
    m.revolute("A", "ground.A", "rod.A")
    assert "rod.angle = 45° (as drawn)" in str(kp.assemble(m))


def test_nothing_is_told_where_everything_is_set_or_a_state_is_given() -> None:
    start = kp.assemble(four_bar(), set={"crank.angle": 1, "crank.omega": 2})
    assert str(start.report.unset) == ""
    assert "not set" not in str(start)
    again = kp.assemble(four_bar(), from_state=start)
    assert again.report.unset.freedoms == 0
    driven = four_bar()
    driven.coordinate_driver("motor", "crank.angle", value="3*t")
    assert str(kp.assemble(driven).report.unset) == ""


@pytest.mark.parametrize("name", [*NAMED, *PINNED])
def test_to_set_what_was_chosen_gives_the_same_start(name: str) -> None:
    if name in NAMED:
        drawn = NAMED[name]
        m, guess = drawn.model(name), dict.fromkeys(drawn.model(name).compile().column_names(), 0.0)
        first = next(iter(m.compile().bodies))
        rates = {f"{first}.omega": 1.0, f"{first}.vx": 0.3, f"{first}.vy": -0.2}
    else:
        one = PINNED[name]()
        m, guess, rates = one.model, one.start | one.guess, {}
    start = kp.assemble(m, guess=guess | rates, redundancy="allow")
    unset = start.report.unset
    freedoms = start.compiled.n_q - np.linalg.matrix_rank(start.matrices().Phi_q, tol=1e-9)
    assert unset.freedoms == unset.free_rates == freedoms
    chosen = {each.name: each.value for each in (*unset.coordinates, *unset.rates)}
    assert all(start[key] == value for key, value in chosen.items())
    free = {key: value for key, value in guess.items() if key not in chosen}
    again = kp.assemble(m, set=chosen, guess=free, redundancy="allow")
    assert np.abs(again.q - start.q).max() < 1e-9
    assert np.abs(again.v - start.v).max() < 1e-9
    assert again.report.unset.freedoms == again.report.unset.free_rates == 0


def test_a_singular_position_leaves_no_freedom_that_is_not_there() -> None:
    m = four_bar()
    limit = kp.limits(m, kp.assemble(m, set={"crank.angle": 1}), over="rocker.angle").at_upper()
    assert limit is not None
    held = {"rocker.angle": limit["rocker.angle"]}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        start = kp.assemble(m, set=held, guess={"crank.angle": limit["crank.angle"]})
    assert start.report.unset.freedoms == 0


def test_many_freedoms_are_counted() -> None:
    told = str(kp.assemble(pendulums(6)).report.unset)
    assert told.startswith("not set: rod0.angle = 0° (no guess), rod1.angle")
    assert "and 2 more; rod0.omega, rod1.omega, rod2.omega, rod3.omega and 2 more = 0" in told
    told = str(kp.assemble(pendulums(60), set={"rod0.angle": 1}).report.unset)
    assert told == "not set: 59 degrees of freedom, 60 rates"


@pytest.mark.parametrize("value", [70, "70", 70.0, -60, "-22.5", 10, 360])
def test_angles_that_look_like_degrees(value: float | str) -> None:
    with pytest.warns(kp.AssemblyWarning, match="looks like degrees") as caught:
        start = kp.assemble(pendulums(1), set={"rod0.angle": value})
    assert start["rod0.angle"] == float(value), "it is not refused"
    assert f'write "{float(value):g} deg"' in str(caught[0].message)
    with pytest.warns(kp.AssemblyWarning, match=r"rod0\.angle = "):
        kp.assemble(pendulums(1), guess={"rod0.angle": value})


@pytest.mark.parametrize(
    "value", [6.2, -9.0, "70 deg", "70*deg", "4*pi", 4 * np.pi, "20*2*pi", np.radians(400), 47.123]
)
def test_angles_that_are_not_doubted(value: float | str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        kp.assemble(pendulums(1), set={"rod0.angle": value})
        kp.assemble(pendulums(1), set={"rod0.angle": 0, "rod0.omega": 70, "J0.omega": 70})
        kp.assemble(pendulums(1), guess={"rod0.x": 70})


def test_angles_of_elements_that_look_like_degrees() -> None:
    m = pendulums(1)
    m.torsion_spring("spring", "ground", "rod0", stiffness=1, free_angle=-90)
    m.coordinate_driver("motor", "rod0.angle", value=270)
    with pytest.warns(kp.AssemblyWarning) as caught:
        kp.assemble(m)
    (told,) = [str(each.message) for each in caught if "degrees" in str(each.message)]
    assert "drivers.motor.value = 270" in told
    assert "forces.spring.free_angle = -90" in told
    assert 'for degrees, write "270 deg"' in told


def test_in_a_notebook() -> None:
    told = kp.assemble(four_bar())._repr_html_()
    assert "not set: crank.angle = 0° (no guess); crank.omega = 0 (at rest)" in told
    assert (
        "not set" not in kp.assemble(four_bar(), from_state=kp.assemble(four_bar()))._repr_html_()
    )


def test_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = str(ROOT / "examples/four_bar.toml")
    assert app.run(["check", file]) == 0
    assert "\n  not set: crank.omega = 0 (at rest)\n" in capsys.readouterr().out
    assert app.run(["check", file, "--json"]) == 0
    unset = json.loads(capsys.readouterr().out)["assembly"]["unset"]
    assert unset["free_rates"] == 1
    assert unset["rates"][0]["name"] == "crank.omega"
    words = ["--t-end", "0.01", "--no-figures", "-o", str(tmp_path)]
    assert app.run(["run", file, "--set", "crank.angle=70", *words]) == 0
    out = capsys.readouterr().out
    assert "not set: crank.omega = 0 (at rest)" in out
    assert "warning: crank.angle = 70 looks like degrees" in out


def test_many_dyads_are_told_in_part() -> None:
    """Twenty are listed; of the others, the first twenty that are folded have their names."""
    for count, folded in ((20, ()), (21, ()), (30, (22, 27)), (60, range(20, 41)), (9, (3,))):
        modes = tuple(
            Mode((f"a{k}", f"b{k}"), f"J{k}", ("A", "B"), "left", k in folded) for k in range(count)
        )
        report = AssemblyReport((), 0, modes, ())
        lines = str(report).splitlines()
        shown = [line for line in lines if " lies " in line]
        assert shown == [
            f"a{k} and b{k}: J{k} lies to the left of A → B, {'' if k in folded else 'un'}folded"
            for k in range(min(count, 20))
        ]
        more = [line for line in lines if line.startswith("and ")]
        names = [f"J{k}" for k in folded if k >= 20]
        if count <= 20:
            assert not more
        elif not names:
            assert more == [f"and {count - 20} more, none of them folded"]
        else:
            few = ", ".join(names[:20]) + ", …" * (len(names) > 20)
            assert more == [f"and {count - 20} more, of which {len(names)} folded: {few}"]
