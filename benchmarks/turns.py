"""All tools on one problem, in alternation, within one process.

Other load on the machine then affects all tools equally. Compare medians and ratios.
"""

from __future__ import annotations

import signal
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any

import numpy as np
from peers.setting import Setting
from problems import Problem
from record import Record

#: CPU seconds of a run above which it is not repeated, or repeated three times.
LONG, THRICE = 2.0, 0.2
#: CPU seconds of a run below which each timed run follows a run that is not timed.
BRIEF = 0.05
#: CPU seconds after which a run is interrupted.
PATIENCE = 20


class TooLongError(Exception):
    """A run was interrupted."""


@contextmanager
def patience(seconds: int = PATIENCE) -> Iterator[None]:
    """Interrupt Python code, or code that checks signals, after a number of seconds."""

    def stop(*_: object) -> None:
        raise TooLongError(f"no end within {seconds} s")

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def timed(run: Callable[[], Any]) -> tuple[float, Any]:
    """CPU seconds of a call, and its result."""
    begin = time.process_time()
    found = run()
    return time.process_time() - begin, found


def first(tool: ModuleType, problem: Problem, setting: Setting) -> tuple[Record, Any]:
    """Prepare and run a setting once; return the record without its median, and the run."""
    record = Record(problem.name, tool.NAME, setting.curve, setting.tolerance)
    begin = time.process_time()
    try:
        with patience():
            run = tool.prepare(problem, setting)
            seconds, found = timed(run)
        motion = tool.motion(problem, found)
        if len(motion.t) != len(problem.grid) or not np.isfinite(motion.q).all():
            raise RuntimeError("it stopped early, or its result is not finite")
        record.seconds, record.runs, record.took = seconds, 1, seconds
        record.error, record.gap = problem.error(motion), problem.gap(motion)
        record.more = {name: measure(motion) for name, measure in problem.also.items()}
    except Exception as error:  # any error of a tool is its result
        record.took = time.process_time() - begin
        record.failure = " ".join(str(error).split())[:200] or type(error).__name__
        return record, None
    return record, run


def measure(problem: Problem, tools: list[ModuleType], repeat: int, quick: bool) -> list[Record]:
    """Every setting of every tool on a problem."""
    found = []
    for tool in tools:
        slow: dict[str, float] = {}
        for setting in tool.settings(problem, quick):
            if setting.curve in slow:
                told = f"not run: a coarser one took {slow[setting.curve]:.0f} s"
                record = Record(problem.name, tool.NAME, setting.curve, setting.tolerance)
                record.failure = told
                found.append((record, None))
                continue
            record, run = first(tool, problem, setting)
            found.append((record, run))
            if record.took > PATIENCE / 2:
                slow[setting.curve] = record.took
    repeated(found, repeat)
    return [record for record, _ in found]


def repeated(found: list[tuple[Record, Any]], repeat: int) -> None:
    """Further alternating runs; the medians go into the records."""
    short = [(r, run) for r, run in found if run is not None and (r.seconds or 0) < LONG]
    times: dict[int, list[float]] = {id(record): [] for record, _ in short}
    for turn in range(repeat):
        for record, run in short:
            if turn >= 3 and (record.seconds or 0) > THRICE:
                continue
            if (record.seconds or 0) < BRIEF:
                run()  # fills the caches, which another tool has used
            times[id(record)].append(timed(run)[0])
    for record, _ in short:
        if values := times[id(record)]:
            record.seconds, record.runs = statistics.median(values), len(values)
