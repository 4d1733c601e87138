"""Every example in other units of length and mass: results scaled back are the same.

The factors are powers of two, near a thousand, so that all products and quotients are exact: only
an absolute threshold can change more than a rounding error.
"""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
import tomllib
from scaled import Scaled
from sizes import some

pytestmark = pytest.mark.filterwarnings("ignore")
#: Sections of beams are tables, which ``Scaled`` leaves; ``test_compliant_examples`` varies sizes.
EXAMPLES = [
    path
    for path in sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))
    if 'type = "beam"' not in path.read_text(encoding="utf-8")
]
#: Factors of length and mass.
FACTORS = [(1024.0, 1.0), (1 / 1024, 1024.0), (1 / 1024, 1 / 1024)]


def short(path):
    """The first tenth of the first analysis of an example, without tolerances in metres."""
    tree = tomllib.loads(path.read_text(encoding="utf-8"))
    (name, first), *_ = tree["analyses"].items()
    one = {key: value for key, value in first.items() if key != "output_step"}
    one["t_end"] = f"({first['t_end']})*0.1"
    if "method" in one:
        one["method"] = {key: x for key, x in one["method"].items() if key != "atol"}
    return {**tree, "analyses": {name: one}}


def results(tree, folder):
    path = folder / "case.json"
    path.write_text(json.dumps(tree), encoding="utf-8")
    case = kp.load(path)
    start = case.start()
    found = kp.mobility(start.compiled, start)
    counts = found.gruebler, found.degrees_of_freedom, found.rank, found.locked
    (solution,) = case.run().values()
    return counts, start, solution


@pytest.mark.parametrize("path", some(EXAMPLES, 12), ids=lambda path: path.stem)
def test_examples_do_not_depend_on_units(path, tmp_path):
    tree = short(path)
    counts, start, solution = results(Scaled(tree, 1.0, 1.0).tree, tmp_path)
    is_length = np.array([unit == "m" for unit in start.compiled.column_units()])
    for length, mass in FACTORS:
        scale = np.where(is_length, length, 1.0)
        others, begin, other = results(Scaled(tree, length, mass).tree, tmp_path)
        assert others == counts
        assert len(other.t) == len(solution.t)
        for mine, its in (
            (start.q, begin.q / scale),
            (start.v, begin.v / scale),
            (solution.q, other.q / scale),
            (solution.v, other.v / scale),
        ):
            assert np.abs(its - mine).max() <= 1e-9 * np.abs(mine).max()
