"""Events and phases in files and on the command line."""

from __future__ import annotations

import json
import math
from pathlib import Path

import kempe as kp
import pytest
from kempe.cli import main

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


def test_the_command_line_lists_events_and_says_what_stopped_the_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    analysis = """
[analyses.fall]
type = "dynamics"
t_end = 2
stop = "ball.y < 0"
events = { low = "ball.y < 1", never = "t > 9" }
"""
    Path("drop.toml").write_text(text(analysis))
    assert main(["run", "drop.toml", "--figures", "none", "-o", "out"]) == 0
    printed = capsys.readouterr().out
    assert "the event stop stopped the run at t = 1.009638 s" in printed
    assert "low" in printed and "0.903047" in printed and "never" not in printed
    summary = json.loads(Path("out/summary.json").read_text())
    assert summary["events"]["low"] == [pytest.approx(math.sqrt(8 / G), abs=1e-12)]
    assert summary["success"] is True
    kept = kp.load_solution("out/solution.npz")
    assert (kept.status, kept.events["stop"].t[0]) == (1, kept.t[-1])


def test_phases_of_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A bar that a driver holds swings after its release, as a bar without the driver does."""
    monkeypatch.chdir(tmp_path)
    Path("bar.toml").write_text("""
kempe = 1
gravity = [0, -9.81]
[parameters]
c = 0
[bodies.ground]
points = { O = [0, 0] }
[bodies.bar]
type = "bar"
mass = 1
length = 1
ends = ["O", "P"]
[joints.pin]
type = "revolute"
i = "ground.O"
j = "bar.O"
[forces.brake]
type = "torsion_spring"
i = "ground"
j = "bar"
damping = "c"
[drivers.turn]
type = "coordinate_driver"
coordinate = "bar.angle"
value = "2*t"
release = "bar.angle > 1"
[analyses.whole]
type = "dynamics"
t_end = 1
[analyses.braked]
type = "dynamics"
t_end = 1.5
parameters = { c = 1 }
[analyses.again]
type = "dynamics"
from = "start"
t_end = 0.3
release = ["turn"]
""")
    assert main(["check", "bar.toml"]) == 0
    assert main(["run", "bar.toml", "--figures", "none", "-o", "out"]) == 0
    assert "turn.release" in capsys.readouterr().out
    whole, braked, again = (
        kp.load_solution(f"out/{name}/solution.npz") for name in ("whole", "braked", "again")
    )
    assert abs(whole.events["turn.release"].t[0] - 0.5) < 1e-12
    # ω² = 4 - 3 g (sin φ - sin 1) after the release
    state = whole.final
    omega = 4 - 3 * G * (math.sin(state["bar.angle"]) - math.sin(1))
    assert abs(state["bar.omega"] ** 2 - omega) < 1e-6
    assert not whole["brake.torque"].any()
    assert abs(braked["brake.torque"] + braked["bar.omega"]).max() < 1e-9
    assert not braked["turn.effort"].any() and not again["turn.effort"].any()
    assert abs(again["bar.alpha"][0] + 1.5 * G) < 1e-9
    assert again["bar.omega"][0] == 2.0


BOUNCE = """
[forces.floor]
type = "stop"
coordinate = "ball.y"
lower = 0
restitution = 0.8
[analyses.fall]
type = "dynamics"
t_end = 2.2
events = { "low" = "ball.y < 1", "never" = "ball.y > 9" }
"""


def test_a_run_writes_its_events_as_a_table(tmp_path: Path) -> None:
    """A ball from 5 m passes 1 m and hits the floor."""
    file, folder = tmp_path / "bounce.toml", tmp_path / "out"
    file.write_text(text(BOUNCE))
    command = ["run", str(file), "-o", str(folder), "--no-figures", "-q", "--units", "mm"]
    assert main(command) == 0
    header, *lines = (folder / "events.csv").read_text().splitlines()
    assert header == "event,t [s],ball.x [mm],ball.y [mm],ball.vx [mm/s],ball.vy [mm/s]"
    rows = [line.split(",") for line in lines]
    assert [row[0] for row in rows] == ["low", "floor.hit"]
    times = [math.sqrt(8 / G), math.sqrt(10 / G)]
    for row, t, height in zip(rows, times, (1.0, 0.0), strict=True):
        assert float(row[1]) == pytest.approx(t, abs=1e-12)
        assert float(row[3]) == pytest.approx(1e3 * height, abs=1e-9)
        assert float(row[5]) == pytest.approx(-1e3 * G * t, rel=1e-12)
    summary = json.loads((folder / "summary.json").read_text())
    assert "events.csv" in summary["files"]


def test_a_run_without_events_writes_no_table_of_them(tmp_path: Path) -> None:
    file, folder = tmp_path / "drop.toml", tmp_path / "out"
    file.write_text(text('[analyses.fall]\ntype = "dynamics"\nt_end = 0.1\n'))
    assert main(["run", str(file), "-o", str(folder), "--no-figures", "-q"]) == 0
    assert not (folder / "events.csv").exists()
    (folder / "events.csv").write_text("of an earlier run")
    assert main(["run", str(file), "-o", str(folder), "--no-figures", "-q"]) == 0
    assert not (folder / "events.csv").exists()


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_the_table_of_events_is_in_the_order_of_time(scale: float, tmp_path: Path) -> None:
    """A ball that is thrown up passes heights twice; events are declared in another order."""
    from kempe.results.event_table import write_events

    m = kp.Model("ball", gravity=(0, -G))
    m.point_mass("ball", mass=scale)
    speed = math.sqrt(2 * G * scale)
    start = kp.assemble(m, {"ball.x": 0.0, "ball.y": 0.0, "ball.vy": speed})
    heights = {"high": 0.75, "low": 0.25, "half": 0.5}
    events = {name: f"ball.y - {share * scale}" for name, share in heights.items()}
    sol = kp.dynamics(m, start, t_end=2 * speed / G, events=events)
    assert write_events(sol, tmp_path / "events.csv")
    lines = [line.split(",") for line in (tmp_path / "events.csv").read_text().splitlines()[1:]]
    expected = []
    for name, share in heights.items():
        away = math.sqrt(2 * (1 - share) * scale / G)  # from the top
        expected += [(speed / G - away, name), (speed / G + away, name)]
    assert [line[0] for line in lines] == [name for _, name in sorted(expected)]
    for line, (t, name) in zip(lines, sorted(expected), strict=True):
        assert float(line[1]) == pytest.approx(t, rel=1e-9), name
        assert float(line[3]) == pytest.approx(heights[name] * scale, rel=1e-9), name
