"""The progress of a simulation: simulated time on stderr, where that is a terminal."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from kempe.cli.console import remarks


class Clock:
    """Shows the simulated time while it runs; called with the time reached, s."""

    def __init__(self, *, silent: bool) -> None:
        console = remarks()
        self._progress = Progress(
            TextColumn("{task.description}", markup=False),
            BarColumn(),
            TextColumn("{task.fields[reached]}"),
            TimeElapsedColumn(),
            console=console,
            transient=True,
            disable=silent or not console.is_terminal,
        )
        self._begin: float | None = None

    def __call__(self, t: float) -> None:
        """Show the time reached."""
        for task in self._progress.task_ids[-1:]:
            if self._begin is None:
                self._begin = t
            self._progress.update(task, completed=t - self._begin, reached=f"t = {t:.3f} s")

    @contextmanager
    def running(self, name: str, begin: float | None, end: float | None) -> Iterator[None]:
        """Show an analysis from one simulated time to another while the block runs."""
        self._begin = begin
        total = None if end is None or begin is None else end - begin
        with self._progress:
            task = self._progress.add_task(name, total=total, reached="")
            try:
                yield
            finally:
                self._progress.remove_task(task)
