"""Damaged cases: only errors of kempe, no wrong success, and what is saved is loaded unchanged.

`PYTHONPATH=tests python -m stress.fuzz` takes a hundred thousand inputs.
"""

from collections import Counter
from pathlib import Path

import kempe as kp
import pytest
from sizes import count
from stress.fuzz import STAGES, Outcome, passage, run

RUNS = count(400, 2000)


@pytest.fixture(scope="module")
def outcomes() -> list[Outcome]:
    return [run(4, number) for number in range(RUNS)]


def test_no_input_has_a_fault(outcomes: list[Outcome]) -> None:
    faulty = [(o.number, o.faults) for o in outcomes if o.faults]
    assert not faulty


def test_every_stage_is_reached(outcomes: list[Outcome]) -> None:
    reached = Counter(o.reached for o in outcomes)
    assert all(reached[stage] > RUNS // 100 for stage in STAGES), reached
    assert reached["run"] > RUNS // 4


def test_an_input_can_be_repeated(outcomes: list[Outcome]) -> None:
    again = run(4, 17)
    assert (again.reached, again.message) == (outcomes[17].reached, outcomes[17].message)


TEXT = '{"kempe": 1, "bodies": {"ball": {"mass": 1, "inertia": 1}}}'


def test_a_loss_on_saving_is_a_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    passage(fine := Outcome(0), TEXT, tmp_path)
    assert (fine.reached, fine.faults) == ("run", [])

    def lossy(case: kp.Case, path: Path) -> None:
        del case
        text = TEXT if path.suffix == ".json" else "kempe = 1\n[bodies.ball]\nmass = 2\ninertia = 1"
        path.write_text(text, "utf-8")

    monkeypatch.setattr(kp.Case, "save", lossy)
    passage(told := Outcome(0), TEXT, tmp_path)
    assert told.faults == ["again.toml is read back differently"]
