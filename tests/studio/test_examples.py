"""The runs of the examples in the page are those of the native core."""

from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from sizes import some
from studio.agreement import TOLERANCE, coordinates, sizes
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
#: Chaotic motions are compared for so long, s.
CHAOTIC = {"double_pendulum": 2.0}
#: Runs that take the module several seconds are compared for so long, s.
LONG = {"geneva_drive": 0.42}
#: With knots of its table in most steps, rounding decides which steps are accepted, and the results
#: differ as much as the tolerances allow: 1e-6. With constant steps, nothing depends on rounding.
CONSTANT_STEP = {"engine": ("rtol = 1e-10, atol = 1e-12", "step = 2e-4")}


def text_of(path: Path) -> str:
    text = path.read_text(encoding="utf-8")
    for old, new in [CONSTANT_STEP[path.stem]] if path.stem in CONSTANT_STEP else []:
        assert old in text
        text = text.replace(old, new)
    return text


NAMES = [path.stem for path in sorted(EXAMPLES.glob("*.toml"))]


@pytest.mark.parametrize("name", some(NAMES, 8))
def test_an_example_runs_in_the_page_as_in_python(one: Studio, tmp_path: Path, name: str) -> None:
    path = tmp_path / f"{name}.toml"
    path.write_text(text_of(EXAMPLES / path.name), encoding="utf-8")
    case = kp.load(path)
    assert one.load(path.read_text(encoding="utf-8")) == {"problems": [], "unassembled": None}
    if name in LONG:
        end = LONG[name]
        solution = kp.dynamics(case.model, case.start(), t_end=end, output_step=end / 500)
        assert one.call("end => kempe.run(end)", end)["status"] == "reached"
    else:
        solution = next(iter(case.each()))[1]
        assert one.call("kempe.run()")["error"] is None
    names = coordinates(case)
    found = one.call("names => kempe.values(names)", names)
    np.testing.assert_allclose(found["t"], solution.t, rtol=0, atol=TOLERANCE * solution.t[-1])
    native = np.array([solution[one] for one in names])
    last = np.searchsorted(solution.t, CHAOTIC.get(name, np.inf))
    at = np.linspace(0, last - 1, 11).astype(int)[1:]
    off = np.abs(np.array(found["rows"]) - native)[:, at].max(axis=1) / sizes(names, native)
    assert off.max() < TOLERANCE, names[int(off.argmax())]
    assert np.ptp(native, axis=1).max() > 1e-3  # it moves
