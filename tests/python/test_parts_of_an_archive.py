"""Events, phases, internal states and properties of a run in a file, and files without them."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from kempe.results.variable import TIME

Changes = Callable[[dict[str, Any]], object]


@pytest.fixture(scope="module")
def hit() -> kp.Solution:
    """A motor with a current turns a rotor against a stop; one event occurs, another never does."""
    m = kp.Model("motor", parameters={"load": 0.1})
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=0.01, points={"O": (0, 0)})
    m.revolute("shaft", "ground.O", "rotor.O")
    m.motor("motor", "rotor", voltage=12, resistance=2, inductance=0.1, torque_constant=0.5)
    m.torque("load", "rotor", torque="-load")
    m.stop("wall", "rotor.angle", upper=1.0, restitution=0.5)
    events = {
        "never": kp.Event("rotor.angle - 9"),
        "half": kp.Event("rotor.angle - 0.5", "rising", action=lambda _: {"load": 0.3}),
        "low": kp.Event("rotor.angle - 0.7"),
    }
    start = kp.assemble(m, {"rotor.angle": 0})
    return kp.dynamics(m, start, t_end=0.5, output_step=0.01, events=events)


def changed(path: Path, change: Changes, drop: tuple[str, ...] = ()) -> None:
    """Change the text of a file, and leave out some of its arrays."""
    with np.load(path) as found:
        arrays = {name: array for name, array in found.items() if name not in drop}
    about = json.loads(str(arrays["about"]))
    change(about)
    np.savez(path, **arrays | {"about": np.array(json.dumps(about))})


def test_events_and_phases_are_read_as_they_were_saved(hit: kp.Solution, tmp_path: Path) -> None:
    hit.save(tmp_path / "s.npz")
    again = kp.load_solution(tmp_path / "s.npz")
    assert list(again.events) == list(hit.events)
    counts = {name: len(event.t) for name, event in hit.events.items()}
    assert counts["never"] == 0 and counts["half"] > 0
    assert len({n for n in counts.values() if n}) > 1  # not the same rows
    for one, other in zip(again._run.events, hit._run.events, strict=True):
        assert one[0] == other[0]
        for read, saved in zip(one[1:], other[1:], strict=True):
            assert read.shape == saved.shape
            assert np.array_equal(read, saved)
    assert again._run.settings == hit._run.settings
    assert len(hit._run.settings) > 1
    assert again._run.projection == hit._run.projection
    assert np.array_equal(again(np.linspace(0, 0.5, 9)).z, hit(np.linspace(0, 0.5, 9)).z)


def test_an_event_that_never_occurs_keeps_its_shape(tmp_path: Path) -> None:
    m = kp.Model("ball", gravity=(0, -9.81))
    m.point_mass("ball", mass=2)
    m.point_mass("other", mass=1)
    start = kp.assemble(m, {"ball.x": 0, "ball.y": 5, "other.x": 1, "other.y": 5})
    sol = kp.dynamics(m, start, t_end=0.1, events={"up": kp.Event("ball.y - 7")})
    sol.save(tmp_path / "s.npz")
    ((name, t, *rows),) = kp.load_solution(tmp_path / "s.npz")._run.events
    assert (name, t.shape, [row.shape for row in rows]) == ("up", (0,), [(0, 4)] * 2 + [(0, 0)] * 2)


def test_a_file_of_version_0_1_is_a_run_over_time_in_one_phase(
    solution: kp.Solution, tmp_path: Path
) -> None:
    def old(about: dict[str, Any]) -> None:
        for name in ("projection", "settings", "variable", "static", "events"):
            del about[name]

    solution.save(tmp_path / "s.npz")
    changed(tmp_path / "s.npz", old, drop=("z",))
    again = kp.load_solution(tmp_path / "s.npz")
    assert again.variable == TIME and not again.variable.static
    assert again._run.settings == [(0, ([], [], []))]
    assert again._run.projection is None
    assert not again.events
    assert again.z.shape == (len(solution.t), 0)
    assert np.array_equal(again.lam, solution.lam)


def setting(**changes: Any) -> Changes:
    """Change the second phase, [row, parameters, released, modes]."""

    def change(about: dict[str, Any]) -> None:
        at = {"row": 0, "parameters": 1}
        for name, value in changes.items():
            about["settings"][1][at[name]] = value

    return change


FAULTS: dict[str, tuple[Changes, str]] = {
    "minus one event": (lambda a: a["events"].append(["x", -1]), "events are damaged"),
    "half an event": (lambda a: a["events"].append(["x", 0.5]), "events are damaged"),
    "a true event": (lambda a: a["events"].append(["x", True]), "events are damaged"),
    "one event more": (lambda a: a["events"].append(["x", 1]), "events are damaged"),
    "one event less": (lambda a: a["events"].pop(1), "events are damaged"),
    "no phase": (lambda a: a.update(settings=[]), "phases are damaged"),
    "a late first phase": (lambda a: a["settings"].pop(0), "phases are damaged"),
    "phases out of order": (
        lambda a: a["settings"].append([0, [], []]),
        "phases are damaged",
    ),
    "a phase twice": (
        lambda a: a["settings"].insert(1, a["settings"][1]),
        "phases are damaged",
    ),
    "a row below": (setting(row=-1), "phases are damaged"),
    "a row beyond": (setting(row=10**6), "phases are damaged"),
    "half a row": (setting(row=0.5), "phases are damaged"),
    "a parameter without a number": (setting(parameters=[["load", "x"]]), "phases are damaged"),
    "a projection of zero": (lambda a: a.update(projection=0.0), "its projection is 0.0"),
    "a negative projection": (lambda a: a.update(projection=-1), "its projection is -1"),
    "a true projection": (lambda a: a.update(projection=True), "its projection is True"),
    "a projection in words": (lambda a: a.update(projection="x"), "its projection is 'x'"),
    "an infinite projection": (lambda a: a.update(projection=10**400), "its projection|damaged"),
    "a variable of one word": (lambda a: a.update(variable=["t"]), "variable is damaged"),
    "a variable in numbers": (lambda a: a.update(variable=["t", 3]), "variable is damaged"),
    "a variable as a text": (lambda a: a.update(variable="ts"), "variable is damaged"),
    "static as a number": (lambda a: a.update(static=1), "variable is damaged"),
    "a count of true": (lambda a: a["statistics"].update(rejected=True), "True rejected"),
}


@pytest.mark.parametrize(("change", "why"), FAULTS.values(), ids=FAULTS.keys())
def test_a_damaged_part_is_refused(
    hit: kp.Solution, tmp_path: Path, change: Changes, why: str
) -> None:
    hit.save(tmp_path / "s.npz")
    changed(tmp_path / "s.npz", change)
    with pytest.raises(kp.FileError, match=why):
        kp.load_solution(tmp_path / "s.npz")


def test_a_phase_may_begin_at_the_last_row(hit: kp.Solution, tmp_path: Path) -> None:
    hit.save(tmp_path / "s.npz")
    changed(tmp_path / "s.npz", lambda a: a["settings"].append([len(hit.t), [["load", 0.3]], []]))
    assert len(kp.load_solution(tmp_path / "s.npz")._run.settings) == len(hit._run.settings) + 1


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_altered_accelerations_are_noticed_at_every_scale(scale: float, tmp_path: Path) -> None:
    """1e-5 of the largest acceleration is refused, 1e-7 is accepted."""
    m = kp.Model("pendulum", gravity=(0, -9.81 * scale))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=scale, length=scale, ends=("A", "B"))
    m.revolute("A", "ground.O", "rod.A")
    sol = kp.dynamics(m, kp.assemble(m, {"rod.angle": 0.1}), t_end=0.1, output_step=0.1)
    for share, is_refused in ((1e-7, False), (1e-5, True)):
        sol.save(tmp_path / "s.npz")
        with np.load(tmp_path / "s.npz") as found:
            arrays = dict(found)
        arrays["a"][0, 1] += share * max(9.81 * scale, float(np.abs(arrays["a"][0]).max()))
        np.savez(tmp_path / "s.npz", **arrays)
        if is_refused:
            with pytest.raises(kp.FileError, match="not those of its model"):
                kp.load_solution(tmp_path / "s.npz")
        else:
            kp.load_solution(tmp_path / "s.npz")


def pendulum() -> tuple[kp.Model, kp.State]:
    m = kp.Model("pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("rod", mass=2, length=0.5, ends=("A", "B"))
    m.revolute("A", "ground.O", "rod.A")
    return m, kp.assemble(m, {"rod.angle": 0.1})


@pytest.mark.parametrize("span", [(0.1, 1.1), (1.1, 0.1)])
def test_a_motion_over_a_quantity_goes_one_way(span: tuple[float, float], tmp_path: Path) -> None:
    """Its values may fall all the way, but not fall and rise."""
    m, start = pendulum()
    found = kp.kinematics(m, start, over="rod.angle", range=span, n=5)
    found.save(tmp_path / "s.npz")
    assert np.array_equal(kp.load_solution(tmp_path / "s.npz").t, found.t)
    with np.load(tmp_path / "s.npz") as stored:
        arrays = dict(stored)
    arrays["t"][1:3] = found.t[2:0:-1]
    np.savez(tmp_path / "s.npz", **arrays)
    with pytest.raises(kp.FileError, match="the times t are not in order"):
        kp.load_solution(tmp_path / "s.npz")


@pytest.mark.parametrize("row", range(9))
def test_each_of_nine_rows_must_agree_with_the_model(row: int, tmp_path: Path) -> None:
    m, start = pendulum()
    kp.dynamics(m, start, t_end=0.4, output_step=0.05).save(tmp_path / "s.npz")
    with np.load(tmp_path / "s.npz") as found:
        arrays = dict(found)
    arrays["a"][row, 2] += 1.0
    np.savez(tmp_path / "s.npz", **arrays)
    with pytest.raises(kp.FileError, match=f"t = {0.05 * row:g} s are not those of its model"):
        kp.load_solution(tmp_path / "s.npz")
