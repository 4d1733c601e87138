"""Slopes of the numbers of the four-bar linkage with a spring-damper, against differences."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from sizes import some

EXAMPLE = Path(__file__).parents[2] / "examples" / "four_bar.toml"
MEASURES = [
    "C.force.max",
    "rocker.angle.final",
    "rocker.angle.settling",
    "energy.dissipated.final",
]
VARIABLES = ["k", "c", "L2", "m2", "G", "crank.angle"]


def flagship(folder: Path) -> kp.Case:
    """The example with the mass of the coupler as a parameter, run accurately, and at rest."""
    text = EXAMPLE.read_text(encoding="utf-8")
    text = text.replace("mass = 5\n", 'mass = "m2"\n').replace("G = 20\n", "G = 20\nm2 = 5\n")
    (folder / "case.toml").write_text(text, encoding="utf-8")
    case = kp.load(folder / "case.toml")
    return case.with_analysis(
        "release", method=kp.DOP853(rtol=1e-13, atol=1e-15), stabilization=kp.Projection()
    )


def agrees(case: kp.Case, measures: list[str], name: str) -> None:
    """Compare slopes with differences of fourth order."""
    g = kp.gradient(case, measures, [name])
    assert not g.remarks
    x = g.variables[name]
    step = 1e-3 * x
    swept = kp.sweep(case, {name: [x - 2 * step, x - step, x + step, x + 2 * step]}, measures)
    for measure, value in g.measures.items():
        far, near, up, most = np.asarray(swept[measure])
        slope = (8 * (up - near) - (most - far)) / (12 * step)
        assert g[measure, name] == pytest.approx(slope, rel=1e-8, abs=1e-8 * abs(value / x))


@pytest.mark.parametrize("name", some(VARIABLES, 3))
def test_numbers_of_a_motion(name: str, tmp_path: Path) -> None:
    agrees(flagship(tmp_path), MEASURES, name)


@pytest.mark.parametrize("name", VARIABLES)
def test_the_natural_frequency(name: str, tmp_path: Path) -> None:
    made = flagship(tmp_path)
    analyses = [kp.Equilibrium(), kp.Modes()]
    agrees(kp.Case(made.model, made.tree()["start"], analyses), ["frequency[0]"], name)
