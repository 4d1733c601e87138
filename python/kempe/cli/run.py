"""``kempe run``: run all analyses of a case, print summaries and write the results."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.text import Text

from kempe.cli import figures
from kempe.cli.animate import Form
from kempe.cli.arguments import (
    AbsoluteTolerance,
    AsJson,
    Changes,
    EndTime,
    File,
    MethodName,
    RelativeTolerance,
    Settings,
    Step,
    Units,
    assembled,
    read_case,
    shown_in,
    stem,
)
from kempe.cli.clock import Clock
from kempe.cli.console import answers, heading, list_files, remarks
from kempe.cli.drawings import refuse_impossible
from kempe.cli.failure import document
from kempe.cli.figures import Which
from kempe.cli.solved import refuse_without_analysis
from kempe.errors import KempeError

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.result import Result
    from kempe.results.solution import Solution
    from kempe.results.state import State

EXAMPLES = """Examples:

  kempe run four_bar.toml

  kempe run four_bar.toml --set k=2e6 --set crank.angle=80*deg --t-end 5 -o out/stiff

  kempe run four_bar.toml --method dop853 --rtol 1e-10 --figures all

  kempe run four_bar.toml --units mm,deg,rpm

  kempe run four_bar.toml --json | jq .analyses.release.energy
"""


def run(  # noqa: PLR0917 - typer uses the annotations of options and arguments
    context: typer.Context,
    file: File,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="Folder for results; default out/<FILE>."),
    ] = None,
    settings: Settings = None,
    t_end: EndTime = None,
    method: MethodName = None,
    rtol: RelativeTolerance = None,
    atol: AbsoluteTolerance = None,
    step: Step = None,
    quiet: Annotated[
        bool, typer.Option("--quiet", "-q", help="Write the files but print nothing.")
    ] = False,
    as_json: AsJson = False,
    which: Annotated[
        Which, typer.Option("--figures", help="Which figures and drawings to write.")
    ] = Which.key,
    without: Annotated[
        bool, typer.Option("--no-figures", help="The same as --figures none.")
    ] = False,
    index_base: figures.IndexBase = 1,
    time_axis: figures.TimeAxis = figures.Axis.linear,
    units: Units = None,
    video: Annotated[
        Form | None, typer.Option("--animate", help="Also write a video (mp4) or a GIF.")
    ] = None,
) -> None:
    """Assemble a mechanism, run its analyses and write the results."""
    drawing = figures.Drawing(Which.none if without else which, index_base, time_axis, video)
    with document(as_json) as content, shown_in(units):
        kind = None if context.info_name == "run" else str(context.info_name)
        case = read_case(file, Changes(settings, t_end, method, rtol, atol, step), kind)
        refuse_without_analysis(case, file)
        refuse_impossible(video)
        state = assembled(case)
        console = answers(silent=quiet or as_json)
        _show_start(console, case, state)
        folder, apart = output or Path("out") / stem(file), len(case.analyses) > 1
        finished = _Finished(console, folder, apart, drawing)
        content["analyses"] = finished.summaries
        try:
            for name, solution in _solutions(case, state, Clock(silent=quiet or as_json)):
                finished.finish(name, solution)
        except (KempeError, KeyboardInterrupt) as error:
            _keep_partial(finished, error, list(case.analyses))
            raise


@dataclass
class _Finished:
    """The finished analyses: their summaries are printed and their files written.

    Attributes:
        console: console for the summaries.
        folder: folder for the files.
        apart: whether every analysis has its own subfolder.
        drawing: the wanted figures and drawings.
        summaries: summary and files of each analysis.
    """

    console: Console
    folder: Path
    apart: bool
    drawing: figures.Drawing
    summaries: dict[str, Any] = field(default_factory=dict)

    def finish(self, name: str, found: Solution | Result) -> None:
        from kempe.cli.results import write_result
        from kempe.results.result import Result

        folder = self.folder / name if self.apart else self.folder
        if isinstance(found, Result):
            heading(self.console, name)
            for line in found.report():
                self.console.print(Text(f"  {line}" if line else ""))
            summary, written = found.summary(), write_result(found, folder, self.drawing)
        else:
            summary, written = self._motion(name, found, folder)
        self.summaries[name] = {**summary, "files": [str(path) for path in written]}
        list_files(self.console, written)

    def _motion(
        self, name: str, solution: Solution, folder: Path
    ) -> tuple[dict[str, Any], list[Path]]:
        """Print and write a motion; its summary and files."""
        from kempe.cli.findings import show_findings
        from kempe.cli.results import write_results
        from kempe.report import summary

        found = summary(solution)
        show_findings(self.console, name, found)
        return found, write_results(solution, found, folder, self.drawing)


def _show_start(console: Console, case: Case, state: State) -> None:
    from kempe.cli.mechanism import show_configuration, show_jacobian, show_mechanism

    show_mechanism(console, state)
    show_configuration(console, state)
    show_jacobian(console, state, case.held)


def _solutions(case: Case, state: State, clock: Clock) -> Iterator[tuple[str, Solution | Result]]:
    """The results one after the other; the clock displays the progress of each."""
    each = case.each(clock, state)
    now = float(state.t)
    ends = {"start": now}
    for name, entry in case.analyses.items():
        with clock.running(name, ends.get(entry.get("from", ""), now), entry.get("t_end")):
            done = next(each)
        now = ends[name] = float(done[1].final.t)
        yield done


def _keep_partial(finished: _Finished, error: BaseException, names: list[str]) -> None:
    """Write the solution up to the failure and print its file name."""
    partial = getattr(error, "solution", None)
    name = names[len(finished.summaries)]
    console = remarks()
    if isinstance(error, KeyboardInterrupt):
        console.print(Text("interrupted"))
    if partial is None:
        return
    finished.finish(name, partial)
    of, last = partial.variable, f"{float(partial.t[-1]):g} {partial.variable.unit}"
    reached = last if of.is_time else f"{of.name} = {last}"
    console.print(
        Text(f"the solution up to {reached} is in {finished.summaries[name]['files'][0]}")
    )
