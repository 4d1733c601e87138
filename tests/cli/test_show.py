"""``kempe show`` of a stored solution."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import main
from numpy.testing import assert_allclose


@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "squeezer"])
def test_matrices_of_a_stored_solution_are_those_of_its_states(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    example = Path(__file__).parents[2] / "examples" / f"{name}.toml"
    case = kp.load(example)
    solution = case.run()[0]
    path = tmp_path / "solution.npz"
    solution.save(path)
    flags = {"--jacobian": "Phi_q", "--rhs": "rhs", "--accelerations": "a", "--multipliers": "lam"}
    for t in (0.0, float(solution.t[-1]) / 3.0, float(solution.t[-1])):
        assert main(["show", str(path), "--json", "--t", repr(t), *flags]) == 0
        shown = json.loads(capsys.readouterr().out)
        state = solution(t) if t else solution.initial
        assert shown["t"] == t
        found = {one["name"]: np.array(one["values"]) for one in shown["matrices"]}
        assert set(found) == set(flags.values())
        for key, values in found.items():
            expected = kp.show(case.model, state, key).values  # type: ignore[arg-type]
            assert_allclose(values, expected, rtol=1e-12, atol=1e-12)
    for words in (["--iterations"], ["--symbolic"], ["--jacobian", "--assembly"]):
        assert main(["show", str(path), *words]) == 0
        of_solution = capsys.readouterr().out
        assert main(["show", str(example), *words]) == 0
        assert of_solution == capsys.readouterr().out
    assert main(["show", str(path), "--set", "k=1"]) == 2
    assert main(["show", str(path), "--t", "1e9"]) == 2
