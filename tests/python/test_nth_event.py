"""A run ends at the n-th event of a condition."""

import math
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe


def oscillator(mass: float, size: float) -> tuple[kp.Model, dict[str, float], float]:
    """x = size cos(ω t) with ω = 2 rad/s: zeros at (n - 1/2) π / ω."""
    m = kp.Model("oscillator", parameters={"k": 4.0 * mass})
    m.body("block", mass=mass, inertia=mass, points={"O": (0, 0)})
    m.ground.points(A=(0, 0))
    m.translational("slide", "ground.A", "block.O")
    m.force("spring", "block.O", force=("-k*block.x", 0))
    return m, {"block.x": size}, 2.0


def saved(folder: Path, event: kp.Event) -> Path:
    """A case file of a run with the event ``zero``."""
    m, start, _ = oscillator(1.0, 1.0)
    case = kp.Case(m, {"set": start}, [kp.Dynamics(t_end=20.0, events={"zero": event})])
    case.save(folder / "swing.toml")
    return folder / "swing.toml"


@pytest.mark.parametrize("n", [1, 2, 5])
@pytest.mark.parametrize("mass", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("size", [1e-3, 1e3])
def test_a_run_ends_at_the_nth_zero(n: int, mass: float, size: float) -> None:
    m, start, omega = oscillator(mass, size)
    event = kp.Event("block.x", stop=n)
    sol = kp.dynamics(m, kp.assemble(m, set=start), t_end=20.0, events={"zero": event})
    assert sol.status == 1
    assert len(sol.events["zero"].t) == n
    assert float(sol.t[-1]) == pytest.approx((n - 0.5) * math.pi / omega, rel=1e-5)
    assert float(sol.events["zero"].t[-1]) == float(sol.t[-1])


def test_a_file_and_the_command_line_count_too(tmp_path: Path) -> None:
    omega = 2.0
    file = saved(tmp_path, kp.Event("block.x", stop=3))
    assert "stop = 3" in file.read_text()
    sol = kp.load(file).run()[0]
    assert float(sol.t[-1]) == pytest.approx(2.5 * math.pi / omega, rel=1e-5)
    told = kempe("run", file, "--no-figures", "-o", tmp_path / "out")
    assert "the event zero stopped the run" in told.stdout


@pytest.mark.parametrize("stop", [0, -1, 1.5, "3", None])
def test_another_number_is_refused_with_what_it_must_be(stop: Any) -> None:
    m, start, _ = oscillator(1.0, 1.0)
    state = kp.assemble(m, set=start)
    with pytest.raises(kp.ModelError, match=r"zero\.stop.*the number of the event.*from 1"):
        kp.dynamics(m, state, t_end=1.0, events={"zero": kp.Event("block.x", stop=stop)})


def test_an_entry_of_an_event_has_known_fields_only() -> None:
    m, start, _ = oscillator(1.0, 1.0)
    state = kp.assemble(m, set=start)
    for entry, told in (
        ({"condition": "block.x", "stopp": 2}, r"field of .*zero 'stopp'; did you mean 'stop'"),
        ({"stop": 2}, r"zero: no condition"),
        (3, r"zero: 3; must be a condition"),
    ):
        with pytest.raises(kp.ModelError, match=told):
            kp.dynamics(m, state, t_end=1.0, events={"zero": entry})  # type: ignore[dict-item]
    sol = kp.dynamics(
        m,
        state,
        t_end=9.0,
        events={"zero": {"condition": "block.x", "stop": 2}},  # type: ignore[dict-item]
    )
    assert float(sol.t[-1]) == pytest.approx(1.5 * math.pi / 2.0, rel=1e-5)


@pytest.mark.parametrize("stop", ["0", "-2", "2.5", '"3"'])
def test_a_file_with_another_number_is_refused(stop: str, tmp_path: Path) -> None:
    file = saved(tmp_path, kp.Event("block.x", stop=7))
    file.write_text(file.read_text().replace("stop = 7", f"stop = {stop}"))
    with pytest.raises(kp.FileError, match=r"the number of the event that ends the run, from 1"):
        kp.load(file)
