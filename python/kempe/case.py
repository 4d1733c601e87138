"""A case: a model, a start and any number of analyses. A file contains one case."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from kempe import _core
from kempe.analyses.assembly import Coordinates, assemble
from kempe.analyses.configurations import ConfigurationsResult
from kempe.analyses.dynamics import simulate
from kempe.analyses.equilibrium_result import EquilibriumResult
from kempe.analyses.kinematics import follow
from kempe.analyses.limits import LimitsResult
from kempe.analyses.mobility import MobilityResult
from kempe.analyses.modes import ModesResult
from kempe.analyses.option import Analysis, Option
from kempe.analyses.options import Dynamics
from kempe.analyses.reachable import ReachableResult
from kempe.analyses.record import Progress, Record, run_analysis
from kempe.analyses.sequence import of_type, read_entries
from kempe.analyses.start import Start, read_start
from kempe.base import files
from kempe.base.arguments import explain_methods
from kempe.base.arrays import Floats
from kempe.base.names import few, one_of
from kempe.errors import FileError, KempeError, ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.model import Model
from kempe.model.values import Number, data, mapping, numbers, plain
from kempe.results.named_results import Results
from kempe.results.result import Result
from kempe.results.solution import Solution
from kempe.results.state import State

FORMATS = {".toml": "toml", ".json": "json"}
#: The sections that ask for runs, slopes, linkages or answers, and an example.
_REQUESTS = ("sweep", "gradient", "optimize", "fit", "synthesis", "exercise")
_FORM = "{'variables': …, 'measures': […]}"
#: The class of each result that is not a motion, by the type of the analysis.
_RESULTS: dict[str, Callable[[Record], Result]] = {
    "equilibrium": EquilibriumResult,
    "modes": ModesResult,
    "limits": LimitsResult,
    "mobility": MobilityResult,
    "configurations": ConfigurationsResult,
    "reachable": ReachableResult,
}


@explain_methods
class Case:
    """A model, a start and analyses. Each analysis starts where the one before it ended.

    Args:
        model: the mechanism.
        start: a ``Start``, or a mapping with ``set`` and ``guess``.
        analyses: ``Dynamics`` or other analyses, in order; or a mapping of names to entries as in
            a file.
        sweep, gradient, optimize, fit, synthesis, exercise: these sections, as in a file.

    Attributes:
        model: the mechanism.
        unread: what ``load`` left out of a file of another tool, each with its line.
        recorded: results that such a file carries, by the name of their quantity; first ``t``.

    Raises:
        FileError, ModelError: the case is invalid; the error contains all ``problems``.
    """

    unread: tuple[str, ...] = ()
    recorded: Mapping[str, Floats] = MappingProxyType({})

    def __init__(
        self,
        model: Model,
        start: Start | Mapping[str, Coordinates] | None = None,
        analyses: Sequence[Analysis] | Mapping[str, Mapping[str, Any]] = (),
        sweep: Mapping[str, Any] | None = None,
        gradient: Mapping[str, Any] | None = None,
        *,
        optimize: Mapping[str, Any] | None = None,
        fit: Mapping[str, Any] | None = None,
        synthesis: Mapping[str, Any] | None = None,
        exercise: Mapping[str, Any] | None = None,
    ) -> None:
        if not isinstance(model, Model):
            raise ModelError(f"{model!r} is not a model", hint="kp.Model(…) makes one")
        self.model = model
        self._start = read_start(start)
        self._entries = read_entries(analyses)
        asked = zip(_REQUESTS, (sweep, gradient, optimize, fit, synthesis, exercise), strict=True)
        self._asked = {key: plain(mapping(of or {}, key, _FORM), key) for key, of in asked}
        self._core().check(model.compile().core)

    @classmethod
    def _loaded(cls, core: _core.Case, folder: Path) -> Case:
        tree = json.loads(core.tree())
        case = cls.__new__(cls)
        case.model = Model.from_tree(tree, core, folder)
        case._start = read_start(tree.get("start"))
        case._entries = dict(tree.get("analyses", {}))
        case._asked = {key: dict(tree.get(key, {})) for key in _REQUESTS}
        return case

    def __copy__(self) -> Case:
        """A case with a copy of the model, which can be changed without changing this case."""
        return copy.deepcopy(self)

    @property
    def analyses(self) -> Mapping[str, Mapping[str, Any]]:
        """The analyses by name, as in a file; a copy."""
        return {name: dict(entry) for name, entry in self._entries.items()}

    @property
    def sweep(self) -> Mapping[str, Any]:
        """The sweep of the file, which ``kp.sweep(case)`` runs; a copy."""
        return copy.deepcopy(self._asked["sweep"])

    @property
    def gradient(self) -> Mapping[str, Any]:
        """The gradient of the file, which ``kp.gradient(case)`` computes; a copy."""
        return copy.deepcopy(self._asked["gradient"])

    @property
    def optimize(self) -> Mapping[str, Any]:
        """The optimisation of the file, which ``kp.optimize(case)`` solves; a copy."""
        return copy.deepcopy(self._asked["optimize"])

    @property
    def fit(self) -> Mapping[str, Any]:
        """The fit of the file, for ``kp.fit(case, data)``; a copy."""
        return copy.deepcopy(self._asked["fit"])

    @property
    def synthesis(self) -> Mapping[str, Any]:
        """The task that ``kp.synthesis.from_case(case)`` solves; a copy."""
        return copy.deepcopy(self._asked["synthesis"])

    @property
    def exercise(self) -> Mapping[str, Any]:
        """The questions of the file, for ``kp.Exercise(case)``; a copy."""
        return copy.deepcopy(self._asked["exercise"])

    def tree(self) -> dict[str, Any]:
        """A copy of the case as nested mappings, structured as a file.

        Raises:
            ModelError: a law is a Python function, which a file cannot contain.
        """
        return self._with_rest(self.model.tree())

    def _with_rest(self, tree: dict[str, Any]) -> dict[str, Any]:
        """The tree of a model with start and analyses."""
        start = self._start.tree()
        tree |= {"start": start} if start else {}
        tree |= {"analyses": data(self._entries)} if self._entries else {}
        return tree | {key: data(of) for key, of in self._asked.items() if of}

    def start(self) -> State:
        """The assembled mechanism.

        Raises:
            AssemblyError: the mechanism does not close. If drivers contradict each other,
                ``problems`` gives their lines in the file.
        """
        try:
            return assemble(self.model, self._start.set, self._start.guess)
        except KempeError as error:
            self._locate(error)
            raise

    def _locate(self, error: KempeError) -> None:
        """Add file and lines to the problems of an error of assembly."""
        source = self.model._source
        if source is None:
            return
        places = [source[0].place(problem.path) for problem in error.problems]
        located = zip(error.problems, places, strict=True)
        error.problems = tuple(
            replace(problem, line=place[1], column=place[2]) if place else problem
            for problem, place in located
        )
        file = next((place[0] for place in places if place), None)
        if file is not None:
            error.args = (f"{file}: {error.args[0]}", *error.args[1:])

    @property
    def held(self) -> Mapping[str, Number]:
        """The coordinates and rates that are set at the start."""
        return dict(self._start.set)

    def run(self, progress: Progress | None = None) -> Results:
        """Run all analyses, in order.

        Args:
            progress: called repeatedly with the time reached, s.

        Raises:
            KempeError: an analysis failed; an IntegrationError contains its ``solution``.
        """
        return Results(dict(self.each(progress)))

    def each(
        self, progress: Progress | None = None, start: State | None = None
    ) -> Iterator[tuple[str, Solution | Result]]:
        """Run the analyses one by one and yield each solution or other result at once.

        An analysis starts in the state in which the one before it ended. Joints can drift in an
        analysis, for example with Baumgarte's stabilization. The next analysis then starts in the
        nearest state that satisfies the constraints, and an ``AssemblyWarning`` gives the gap.

        Args:
            progress: called repeatedly with the time reached, s.
            start: the assembled mechanism; assembled here when None.
        """
        return ((name, found) for name, found, _ in self.found(progress, start))

    def found(
        self, progress: Progress | None = None, start: State | None = None
    ) -> Iterator[tuple[str, Solution | Result, Callable[[str], float]]]:
        """As ``each``, with the function that reads a number of a result; not of a solution."""
        compiled = self.model.compile()
        contained = json.dumps(self.model.with_points(self._with_rest(self.model.shown())))
        model = compiled.in_case(contained)
        begin = start or self.start()
        text, after = self._core().analyses()
        entries, ends = json.loads(text).get("analyses", {}), list[State]()
        for (name, entry), before in zip(entries.items(), after, strict=True):
            at = begin if before is None else ends[before]
            after_name = None if before is None else name
            solution, number = _run(model, at, entry, progress, after_name)
            yield name, solution, number
            ends.append(solution.final)

    def with_parameters(self, parameters: Mapping[str, Number]) -> Case:
        """A copy of the case with other values of some parameters; ``start()`` uses them.

        Raises:
            ModelError: a value is invalid, or there is no parameter of that name.
        """
        return self._with(model=self.model.with_parameters(parameters))

    def _with(self, **parts: Any) -> Case:
        """A copy of the case with another ``model``, ``start`` or ``analyses``."""
        kept = {"model": self.model, "start": self._start, "analyses": self._entries}
        return Case(**{**kept, **parts}, **self._asked)

    def with_analysis(self, name: str, **changes: Any) -> Case:
        """A copy of the case with some fields of one analysis changed, such as ``t_end=30``.

        Raises:
            ModelError: there is no analysis of that name, or a field has an invalid value.
        """
        one_of("analysis", name, self._entries)
        given: dict[str, Any] = {}
        for key, value in changes.items():
            path = f"analyses.{name}.{key}"
            given[key] = value.tree(path) if isinstance(value, Option) else plain(value, path)
        return self._with(analyses={**self._entries, name: {**self._entries[name], **given}})

    def of_type(self, kind: str, absent: Mapping[str, Number] | None = None) -> Case:
        """A copy of the case with the analyses of one type and the analyses that they start from.

        Args:
            kind: the type.
            absent: fields of the analysis that is added, from the start of the case, if the case
                has no analysis of this type.

        Raises:
            ModelError: the case has no such analysis, and ``absent`` lacks required fields.
        """
        entries = of_type(self._entries, kind)
        if entries:
            return Case(self.model, self._start, entries)
        added = {"type": kind, **(absent or {}), "from": "start"}
        try:
            return Case(self.model, self._start, {kind: added})
        except KempeError as error:
            hint = f'add one: [analyses.{kind}] with type = "{kind}"'
            told = f"the case has no analysis of type {kind}, and one without options is impossible"
            raise ModelError(f"{told}: {error.args[0]}", hint=hint) from error

    def with_start(self, coordinates: Coordinates) -> Case:
        """A copy with other coordinates and rates set at the start: ``{"crank.angle": 1}``.

        They replace the values of the same names in ``set`` and in ``guess``; all other values
        remain.

        Raises:
            ModelError: there is no such coordinate, or a value is not a number or a formula.
        """
        guess = {key: value for key, value in self._start.guess.items() if key not in coordinates}
        return self._with(start=Start({**self._start.set, **coordinates}, guess))

    def save(self, path: Path | str, *, form: str | None = None) -> None:
        """Write the complete case as TOML or JSON: as ``form``, or by the suffix of the name.

        Files of tables are not copied; the case refers to them relative to its own folder.

        Raises:
            FileError: the file cannot be written; an existing file is then unchanged.
        """
        form = form or format_of(path, "write")
        tree = self.model.beside(self.tree(), Path(path).parent)
        core = _core.Case(json.dumps(tree, allow_nan=False), "json", None)
        files.write_text(path, core.write(form))

    def text(self) -> str:
        """The case as TOML, as ``save`` writes it.

        Raises:
            ModelError: a law is a Python function, which a file cannot contain.
        """
        self.tree()
        return self._core().write("toml")

    def _core(self) -> _core.Case:
        tree = self._with_rest(self.model.shown())
        return _core.Case(json.dumps(tree, allow_nan=False), "json", None)

    def _repr_html_(self) -> str:
        return self.model._repr_html_()

    def __repr__(self) -> str:
        names = few(self._entries) or "none"
        return f"<Case {self.model.title!r}; analyses: {names}>"


def _run(
    model: CompiledModel,
    start: State,
    entry: Mapping[str, Any],
    progress: Progress | None,
    after: str | None,
) -> tuple[Solution | Result, Callable[[str], float]]:
    """Run an analysis of a case; ``after`` is its name if it starts at the end of another one."""
    kind = entry["type"]
    if kind in _RESULTS:
        record = run_analysis(model, start, entry, progress, after=after)
        return _RESULTS[kind](record), record.number
    run = simulate if kind == Dynamics.kind else follow
    return run(model, start, entry, progress, after), _no_number


def _no_number(text: str) -> float:
    raise ModelError(f"{text}: a motion has no such number", hint="read a quantity of the solution")


def parsed(
    text: str,
    form: str,
    origin: str | None,
    parameters: Mapping[str, Number] | None = None,
    folder: Path | None = None,
) -> Case:
    """The case in a text.

    Args:
        text: the text of a file.
        form: "toml" or "json".
        origin: name of the file, for messages; None if the text is not that of a file.
        parameters: other values for some of its parameters.
        folder: the folder of the files of tables; by default the current folder.

    Raises:
        FileError, ModelError: as in ``load``.
    """
    core = _core.Case(text, form, origin)
    case = Case._loaded(core, folder or Path())
    given = numbers(parameters, "parameters")
    if given:
        case.model = case.model.with_parameters(given)
    core.check(case.model.compile().core)
    return case


def schema() -> str:
    """The JSON Schema (draft 2020-12) of a case, for editors."""
    return _core.schema()


def format_of(path: Path | str, doing: str) -> str:
    """The format of a case, by the ending of its name.

    Raises:
        FileError: the ending is another one.
    """
    where = files.checked_path(path, doing)
    suffix = where.suffix.lower()
    if suffix in FORMATS:
        return FORMATS[suffix]
    if where.is_dir():
        raise files.trouble(path, doing, IsADirectoryError())
    raise FileError(f"cannot {doing} {path}: the name must end in .toml or .json", name=str(path))
