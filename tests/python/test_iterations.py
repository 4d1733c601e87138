"""Columns of the iterations of an assembly, in each of their forms."""

import re
from pathlib import Path

import kempe as kp
from kempe.analyses.iterations import Iterations, iterations
from kempe.results.assembly_report import Iteration


def test_columns_of_the_iterations_are_residual_step_and_damping(four_bar_file: Path) -> None:
    """The rows by hand, written as text, CSV and LaTeX; the start has no step."""
    made = Iterations((Iteration(0.25, 0.0, 1.0), Iteration(0.0125, 3e-4, 0.5)))
    assert made.csv() == "iteration,residual,step,damping\n0,0.25,0.0,1.0\n1,0.0125,0.0003,0.5\n"
    assert [line.split() for line in made.text().splitlines()[-2:]] == [
        ["0", "2.500e-01"],
        ["1", "1.250e-02", "3.000e-04", "0.5"],
    ]
    rows = made.latex().splitlines()[2:4]
    numbers = [re.findall(r"-?[\d.]+", row) for row in rows]
    assert rows[0].count("&") == rows[1].count("&") == 3
    assert numbers[0][:2] == ["0", "0.25"]
    first, rest = numbers[1][:2], " ".join(numbers[1][2:])
    assert first == ["1", "0.0125"]
    assert rest.endswith("0.5")
    assert "3" in rest
    # The residual of the start is the gap of the guess, and the steps lead to the solution.
    found = iterations(kp.load(four_bar_file)).rows
    assert found[0].step == 0.0
    assert found[-1].residual < found[-1].step
