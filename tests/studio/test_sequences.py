"""Cases with several analyses: the page starts each of them where Python starts it."""

import warnings
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from studio.agreement import TOLERANCE, coordinates, sizes
from studio.window import Studio

ROOT = Path(__file__).parents[2]

ROD = """kempe = 1
gravity = [0, -9.81]
[bodies.ground]
points = { A = [0, 0] }
[bodies.rod]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[joints.A]
type = "revolute"
i = "ground.A"
j = "rod.A"
"""

#: The driver that the first analysis releases must stay released in the second.
RELEASED = (
    ROD
    + """[drivers.hold]
type = "coordinate_driver"
coordinate = "rod.angle"
value = "0"
[analyses.drop]
type = "dynamics"
t_end = 0.5
output_step = 0.1
release = ["hold"]
[analyses.more]
type = "dynamics"
t_end = 1
output_step = 0.1
"""
)

#: The motion starts in the position of rest.
AT_REST = (
    ROD
    + """[forces.push]
type = "torque"
j = "rod"
torque = "0.5*sin(3*t)"
[start]
guess = { "rod.angle" = "-80 deg" }
[analyses.rest]
type = "equilibrium"
[analyses.motion]
type = "dynamics"
t_end = 1
output_step = 0.1
"""
)

#: The joints drift in the first analysis, so that its end does not meet the constraints.
DRIFTED = (
    (ROOT / "examples" / "four_bar.toml").read_text(encoding="utf-8").partition("[analyses")[0]
    + """[analyses.release]
type = "dynamics"
t_end = 1
output_step = 0.01
method = { type = "rk45", rtol = 1e-3, atol = 1e-6 }
stabilization = { type = "baumgarte", alpha = 1, beta = 20 }
[analyses.again]
type = "dynamics"
t_end = 2
output_step = 0.1
"""
)


#: The first analysis ends while the drive gives its largest effort; the second goes on there.
LIMITED = (
    ROD
    + """[drivers.motor]
type = "coordinate_driver"
coordinate = "A.angle"
value = "0.8*sin(4*t)"
limit = 5.5
[analyses.begin]
type = "dynamics"
t_end = 1
output_step = 0.1
[analyses.more]
type = "dynamics"
t_end = 2
output_step = 0.1
"""
)


def with_several() -> dict[str, str]:
    """All case files of the examples and tests that have at least two analyses."""
    paths = [*(ROOT / "examples").glob("*.toml"), *(ROOT / "tests").rglob("*.toml")]
    found = {path.stem: path.read_text(encoding="utf-8") for path in sorted(paths)}
    return {name: text for name, text in found.items() if text.count("[analyses.") > 1}


CASES = {"released": RELEASED, "at_rest": AT_REST, "drifted": DRIFTED, "limited": LIMITED}
CASES |= with_several()


def test_the_cases_contain_files() -> None:
    assert "slamming_door" in CASES


@pytest.mark.filterwarnings("ignore::kempe.AccuracyWarning", "ignore::kempe.AssemblyWarning")
@pytest.mark.parametrize("name", CASES)
def test_each_analysis_gives_the_numbers_of_python(one: Studio, tmp_path: Path, name: str) -> None:
    path = tmp_path / f"{name}.toml"
    path.write_text(CASES[name], encoding="utf-8")
    case = kp.load(path)
    assert one.load(CASES[name]) == {"problems": [], "unassembled": None}
    names = coordinates(case)
    for analysis, result in case.run().items():
        ran = one.call("name => kempe.run(name)", analysis)
        assert one.page.locator("#analysis").input_value() == analysis
        assert ran["error"] is None
        if hasattr(result, "folds") and len(ran["positions"]) == 1:
            continue  # a remark says that the positions are not drawn
        if not isinstance(result, kp.Solution):
            native = np.array([float(result.final[one]) for one in names])
            found = np.array(ran["positions"][-1]["pose"]["q"])
            off = np.abs(found - native) / sizes(names, native[:, None])
        else:
            found = one.call("names => kempe.values(names)", names)
            native = np.array([result[one] for one in names])
            np.testing.assert_allclose(found["t"], result.t, rtol=TOLERANCE)
            off = np.abs(np.array(found["rows"]) - native).max(axis=1) / sizes(names, native)
        assert off.max() < TOLERANCE, (analysis, names[int(off.argmax())])


def last_angle(one: Studio, case: str, analysis: str) -> list[float]:
    """The first and the last angle of the rod in an analysis."""
    one.load(case)
    one.call("name => kempe.run(name)", analysis)
    row = one.call("kempe.values(['rod.angle'])")["rows"][0]
    return [row[0], row[-1]]


def test_a_released_driver_stays_released(one: Studio) -> None:
    assert last_angle(one, RELEASED, "more") == pytest.approx([-1.6611, -3.1334], abs=5e-5)


def test_a_motion_starts_at_rest(one: Studio) -> None:
    assert last_angle(one, AT_REST, "motion") == pytest.approx([-np.pi / 2, -1.4018], abs=5e-5)


def remarks(one: Studio) -> list[str]:
    """The remarks beside the result."""
    found: list[str] = one.page.locator("#remarks li").all_inner_texts()
    return found


def test_a_repair_of_joints_is_remarked(one: Studio, tmp_path: Path) -> None:
    path = tmp_path / "drifted.toml"
    path.write_text(DRIFTED, encoding="utf-8")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        kp.load(path).run()
    [drift, repair] = [str(each.message) for each in caught]
    assert "the joints are open" in drift
    assert repair.startswith("again: ")
    assert "the nearest state that" in repair
    one.load(DRIFTED)
    one.mode("read")
    assert remarks(one) == [drift]
    one.page.locator("#analysis").select_option("again")
    one.page.locator("#run").click()
    one.settle()
    assert remarks(one) == [f"release: {drift}", repair]
    one.load(RELEASED)
    one.mode("read")
    assert remarks(one) == []


def test_an_unknown_analysis_is_refused(one: Studio) -> None:
    one.load(RELEASED)
    assert one.call("kempe.run('less')") is None
    assert "there is no analysis 'less'" in one.message()
