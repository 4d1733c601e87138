"""Tables, sentences and figures of a report have the units that were chosen."""

import re

import kempe as kp
import pytest
from kempe.lab_report.write import page
from lab_report.pages import Page


def case() -> kp.Case:
    m = kp.Model("arm", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=2, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "arm.O")
    m.torsion_spring("damper", "ground", "arm", stiffness=100, damping=30)
    analyses = {
        "rest": {"type": "equilibrium"},
        "held": {"type": "equilibrium", "hold": ["arm.angle"], "from": "start"},
        "reach": {"type": "limits", "over": "arm.angle", "from": "start"},
        "duty": {
            "type": "inverse_dynamics",
            "over": "arm.angle",
            "range": [0.1, 1],
            "n": 5,
            "from": "start",
        },
    }
    return kp.Case(m, start={"set": {"arm.angle": 0.1}}, analyses=analyses)


@pytest.fixture(scope="module")
def text() -> str:
    with kp.units("mm", "deg", "N*mm"):
        return page(case(), None, None)


def test_gravity_has_the_unit_of_its_numbers(text: str) -> None:
    assert "[0, −9810] mm/s² in x and y of ground" in " ".join(Page(text).paragraphs)


def test_equilibria_have_display_units(text: str) -> None:
    rest = case().run()["rest"].state
    table = Page(text).table("equilibrium")
    rows = {row[0].text: (row[1].printed, row[2].text) for row in table.rows}
    assert rows["arm.angle"] == (pytest.approx(rest["arm.angle"] * 57.29578, rel=1e-5), "deg")
    assert rows["arm.x"] == (pytest.approx(rest["arm.x"] * 1000, rel=1e-5), "mm")


def test_efforts_in_the_lines_of_an_equilibrium_have_display_units() -> None:
    held = case().run()["held"]
    with kp.units("N*mm"):
        (line,) = (line for line in held.report() if line.startswith("arm.angle: a holder"))
    value = float(re.search(r"applies (\S+) N·mm", line)[1])
    assert value == pytest.approx(1000 * held.effort["arm.angle"], rel=1e-5)


def test_limits_and_configurations_have_display_units() -> None:
    reach = case().run()["reach"]
    with kp.units("mm", "deg"):
        columns = {of.name: of for of in reach.tables()["limits"][1:]}
    assert columns["arm.x"].unit == "mm"
    assert columns["arm.x"].values[0] == pytest.approx(1000 * reach.path.q[0, 0], rel=1e-12)


def test_a_path_of_equilibria_has_the_unit_of_its_parameter() -> None:
    m = kp.Model("spring", parameters={"L": "0.5 m", "k": 100})
    m.ground.points(O=(0, 0))
    m.body("mass", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "mass.P")
    m.spring_damper("coil", "ground.O", "mass.P", stiffness="k", free_length="L")
    start = kp.assemble(m, set={"mass.x": 0.5})
    found = kp.equilibrium(m, start, over="L", range=(0.5, 0.8))
    with kp.units("mm"):
        assert found.report()[0].endswith("points over L from 500 to 800 mm")
        of_length, *_ = found.tables()["equilibrium"]
    assert (of_length.name, of_length.unit) == ("L", "mm")
    assert of_length.values[[0, -1]] == pytest.approx([500, 800])
    found = kp.equilibrium(m, start, over="k", range=(50, 100))
    assert found.report()[0].endswith("points over k from 50 to 100")


def test_a_motion_over_a_value_says_what_its_forces_contain(text: str) -> None:
    told = " ".join(Page(text).paragraphs)
    assert "Forces and efforts are with inertia and damping at 1 rad/s." in told


def test_figures_over_a_value_say_what_their_forces_contain() -> None:
    solution = case().run()["duty"]
    assert isinstance(solution, kp.Solution)
    (driver,) = solution.model.drivers
    for axes in (
        kp.plot.reactions(solution, "O"),
        kp.plot.all_reactions(solution),
        kp.plot.torques(solution, "damper"),
        kp.plot.effort(solution, driver),
    ):
        written = [one.get_text() for of in axes.figure.axes for one in of.texts]
        assert "with inertia and damping at 1 rad/s" in written
    labels = [of.get_ylabel() for of in kp.plot.velocities(solution, "arm").figure.axes]
    assert any("m/rad" in label for label in labels)
    assert any("rad/rad" in label for label in labels)
