"""The result of a tool, or its failure, becomes its record."""

import time
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import turns
from peers.setting import Setting
from problems import Motion, problem
from problems.truth import reference


def tool(run: Any) -> Any:
    """A tool whose runs are `run`."""
    told = problem("flagship")
    motion = Motion(told.grid, np.tile(told.q0.reshape(3, 3), (len(told.grid), 1, 1)))
    return SimpleNamespace(
        NAME="still",
        settings=lambda *_: [Setting("rest", 1e-3), Setting("rest", 1e-6)],
        prepare=lambda *_: run,
        motion=lambda *_: motion,
    )


def test_a_motion_at_rest_has_its_error_and_no_gap() -> None:
    records = turns.measure(problem("flagship"), [tool(lambda: None)], repeat=3, quick=False)
    assert [record.runs for record in records] == [3, 3]
    angle = np.array(reference("four_bar")["first_second"]["rocker_angle"])
    assert records[0].error == pytest.approx(np.abs(angle - angle[0]).max(), abs=1e-12)
    assert records[0].gap < 1e-14


def test_an_exception_of_a_tool_is_its_result() -> None:
    def fails() -> None:
        raise ArithmeticError("lost at\n 0.7 s")

    (record, _) = turns.measure(problem("flagship"), [tool(fails)], repeat=1, quick=False)
    assert record.failure == "lost at 0.7 s"
    assert record.seconds is None


def test_a_long_run_is_interrupted() -> None:
    with pytest.raises(turns.TooLongError, match="no end within 1 s"), turns.patience(1):
        while True:
            time.process_time()
