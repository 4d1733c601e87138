"""Events and phases in files and on the command line."""

from __future__ import annotations

import json
import math
from pathlib import Path

import kempe as kp
import pytest

G = 9.81


def text(case: str) -> str:
    return f"""
kempe = 1
gravity = [0, -9.81]
[bodies.ball]
type = "point_mass"
mass = 2
[start]
set = {{ "ball.x" = 0, "ball.y" = 5 }}
{case}
"""


def test_events_of_a_file(tmp_path: Path) -> None:
    file = tmp_path / "drop.toml"
    file.write_text(
        text("""
[analyses.fall]
type = "dynamics"
t_end = 2
stop = "ball.y < 0"
events = { low = "ball.y < 1", half = { condition = "ball.y - 2.5", direction = "falling" } }
[analyses.on]
type = "dynamics"
t_end = 2
[analyses.on.events.fast]
condition = "ball.vy < -12"
stop = true
""")
    )
    case = kp.load(file)
    results = case.run()
    fall, on = results["fall"], results["on"]
    assert fall.t[-1] == on.t[0]
    assert abs(fall.t[-1] - math.sqrt(10 / G)) < 1e-12
    assert abs(fall.events["half"].t[0] - math.sqrt(5 / G)) < 1e-12
    assert abs(on.t[-1] - 12 / G) < 1e-12
    written = tmp_path / "again.json"
    case.save(written)
    assert kp.load(written).run()["on"].t[-1] == on.t[-1]
    assert json.loads(written.read_text())["analyses"] == case.analyses
    summary = kp.report.summary(fall)
    assert summary["events"] == {name: event.t.tolist() for name, event in fall.events.items()}


@pytest.mark.parametrize(
    ("field", "message"),
    [
        ('events = "ball.y"', "a table of events"),
        ("events = { low = 5 }", "a condition, or a table"),
        ('events = { low = { condition = "ball.y", when = 1 } }', "unknown field 'when'"),
        ('events = { low = { direction = "rising" } }', "an event needs a condition"),
        ('events = { low = { condition = "ball.y", direction = "up" } }', "unknown word 'up'"),
        ('events = { low = "ball.q" }', "ball.q"),
        ("stop = 3", "a condition"),
        ('release = ["motor"]', "there is no driver 'motor'"),
        ('release = "motor"', "a list of names"),
        ("parameters = { k = 3 }", "there is no parameter 'k'"),
    ],
)
def test_faults_of_a_file_are_found_without_a_run(field: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / "drop.toml"
    file.write_text(text(f'[analyses.fall]\ntype = "dynamics"\nt_end = 2\n{field}\n'))
    with pytest.raises((kp.FileError, kp.ModelError)) as caught:
        kp.load(file)
    assert message in str(caught.value)
    assert "line" in str(caught.value)


