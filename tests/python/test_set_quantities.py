"""``set`` and ``guess`` of quantities of points and elements, and contradictory drivers."""

from __future__ import annotations

from pathlib import Path

import kempe as kp
import pytest
from kempe.case import parsed

FILE = """kempe = 1
[bodies.ground]
points = { O = [0, 0], E = [2, 0] }
[bodies.rod]
type = "bar"
mass = 1
length = 1
ends = ["O", "P"]
[joints.A]
type = "revolute"
i = "ground.O"
j = "rod.O"
[forces.rope]
type = "spring_damper"
i = "ground.E"
j = "rod.P"
stiffness = 1
free_length = 1
"""

TWO_DRIVERS = """
[drivers.one]
type = "coordinate_driver"
coordinate = "A.angle"
value = 1
[drivers.two]
type = "coordinate_driver"
coordinate = "rod.angle"
value = 1.15
"""


def model(text: str = FILE) -> kp.Model:
    return parsed(text, "toml", "rod.toml", {}).model


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("A.angle", 0.5236),
        ("A.angle", 9.0),
        ("rod.P.x", 0.6),
        ("rod.P.y", -0.3),
        ("rope.length", 1.7),
    ],
)
def test_a_quantity_that_is_set_has_its_value(key: str, value: float) -> None:
    state = kp.assemble(model(), set={key: value}, guess={"rod.angle": 0.7})
    assert state[key] == pytest.approx(value, abs=1e-12)


def test_rates_formulas_and_guesses() -> None:
    state = kp.assemble(model(), set={"A.angle": "30*deg", "A.omega": "2"})
    assert state["A.angle"] == pytest.approx(0.5235987755982988, abs=1e-12)
    assert state["A.omega"] == pytest.approx(2, abs=1e-12)
    state = kp.assemble(model(), set={"rope.rate": 0.5}, guess={"A.angle": 1.2})
    assert state["A.angle"] == pytest.approx(1.2, abs=1e-9)
    assert state["rope.rate"] == pytest.approx(0.5, abs=1e-12)


def test_files_and_other_starts(tmp_path: Path) -> None:
    path = tmp_path / "rod.toml"
    path.write_text(FILE + '[start]\nset = { "A.angle" = "30*deg" }\nguess = { rod.P.y = -1 }\n')
    case = kp.load(path)
    assert case.start()["A.angle"] == pytest.approx(0.5235987755982988, abs=1e-12)
    other = case.with_start({"A.angle": 0.25})
    assert other.start()["A.angle"] == pytest.approx(0.25, abs=1e-12)
    other.save(tmp_path / "saved.toml")
    assert kp.load(tmp_path / "saved.toml").start()["A.angle"] == pytest.approx(0.25, abs=1e-12)
    with pytest.raises(kp.ModelError, match=r"'A.force' is a result.*line 20") as caught:
        path.write_text(path.read_text().replace("A.angle", "A.force"))
        kp.load(path)
    assert caught.value.problems[0].line == 20


def test_drivers_that_contradict_each_other_have_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "rod.toml"
    path.write_text(FILE + TWO_DRIVERS)
    with pytest.raises(kp.AssemblyError) as caught:
        kp.load(path).start()
    assert str(caught.value) == (
        f"{path}: driver one and driver two contradict each other: where driver one holds, driver "
        "two would have to change by 0.15 rad; remove one of them"
    )
    assert [(p.path, p.line) for p in caught.value.problems] == [
        ("drivers.one", 20),
        ("drivers.two", 24),
    ]
    with pytest.raises(kp.AssemblyError, match=r"^driver one and driver two contradict") as plain:
        kp.assemble(kp.load(path).model)
    assert [p.line for p in plain.value.problems] == [None, None]
