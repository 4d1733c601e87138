"""The N-four-bar (IFToMM benchmark A02), which passes positions with all bars on one line."""

import json
from pathlib import Path

import kempe as kp
import pytest

from examples.n_four_bar import upright, windows

TRUTH = json.loads((Path(__file__).parents[1] / "reference" / "n_four_bar.json").read_text())


@pytest.mark.parametrize("n", [1, 2, 40])
def test_singular_positions_are_passed(n: int) -> None:
    model = windows(n)
    sol = kp.dynamics(model, upright(model, n), t_end=10, output_step=1)
    assert sol.statistics["steps"] < 200
    assert sol.statistics["method"] == "dop853"
    crank = sol["crank0"]
    for t, truth in TRUTH["N"][str(n)]["B0"].items():
        if float(t) == int(float(t)) <= 10:
            k = int(float(t))
            assert 2 * crank.x[k] == pytest.approx(float(truth["x"]), abs=1e-7)
            assert 2 * crank.y[k] == pytest.approx(float(truth["y"]), abs=1e-7)


def test_at_rest_on_one_line_it_stops_unless_it_shall_pass() -> None:
    model = windows(1)
    with pytest.warns(kp.AssemblyWarning, match="singular position"):
        flat = kp.assemble(
            model, set={"crank0.angle": 0}, guess={"crank1.angle": 0, "coupler0.angle": 0}
        )
    options = {"t_end": 0.1, "method": kp.DOP853(), "stabilization": kp.Projection()}
    with pytest.raises(kp.SingularityError, match=r"at rest.*joints A0, A1, B0, C0; at crank0 x ="):
        kp.dynamics(model, flat, **options)
    assert kp.dynamics(model, flat, **options, singularity="pass").success
    with pytest.raises(kp.ModelError, match="singularity"):
        kp.dynamics(model, flat, **options, singularity="perhaps")
