"""Progress of a simulation: the simulated time on stderr, if that is a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from kempe.cli.console import remarks


class Clock:
    """Displays the simulated time; called with the time reached, s."""

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
        self._begin = 0.0

    def __call__(self, t: float) -> None:
        """Display the time reached."""
        for task in self._progress.task_ids[-1:]:
            self._progress.update(task, completed=t - self._begin, reached=f"t = {t:.3f} s")

    @contextmanager
    def running(self, name: str, begin: float, end: object) -> Iterator[None]:
        """Display the progress of an analysis while the block runs.

        Args:
            name: name of the analysis.
            begin: start time, s.
            end: end time, s; for a formula no percentage is displayed.
        """
        self._begin = begin
        total = end - begin if isinstance(end, int | float) else None
        with self._progress:
            task = self._progress.add_task(name, total=total, reached="")
            try:
                yield
            finally:
                self._progress.remove_task(task)


@contextmanager
def counting(name: str) -> Iterator[Callable[[int, int], None]]:
    """Display the share of a work that is done, as of the frames of a video, while the block runs.

    Args:
        name: name of the work.

    Yields:
        A function to call with the number of finished parts and the total number.
    """
    console = remarks()
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn())
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as progress:
        task = progress.add_task(name, total=None)
        yield lambda done, all_of_them: progress.update(task, completed=done, total=all_of_them)
