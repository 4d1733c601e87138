"""Python functions as laws of forces, in models that are not saved."""

from __future__ import annotations

import pickle
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import isfinite
from types import FunctionType, MethodType, ModuleType
from typing import TYPE_CHECKING, Any, NoReturn, TypeAlias

import numpy as np

from kempe import _core
from kempe._upwards import CALLS
from kempe.base.arrays import Floats
from kempe.errors import ModelError, Problem
from kempe.model.values import CHECKS, number, refuse, two

if TYPE_CHECKING:
    from kempe.model.compiled import CompiledModel
    from kempe.results.state import State

#: A law ``f(t, state)``.
PythonLaw: TypeAlias = "Callable[[float, State], float]"
#: Its derivatives ``g(t, state)``.
PythonSlopes: TypeAlias = "Callable[[float, State], Mapping[str, float]]"


class FunctionWarning(UserWarning):
    """A controller remembers an earlier run, so that two identical runs have different results."""


@dataclass(frozen=True)
class Function:
    """A law ``f(t, state)`` with its derivatives, so that ``kp.gradient`` can differentiate it.

    Implicit methods use the derivatives too, in place of differences.

    Args:
        f: the function.
        slopes: ``slopes(t, state)``, the derivatives of f at a state: {quantity: ∂f/∂quantity}. The
            quantities are those that f reads, such as ``"rod.omega"``, and ``"t"``. A quantity that
            is missing has the derivative 0.

    Raises:
        ModelError: an argument is not a function.
    """

    f: PythonLaw
    slopes: PythonSlopes | None = None

    def __post_init__(self) -> None:
        """Check the fields."""
        for field in ("f", "slopes"):
            value = getattr(self, field)
            if not callable(value) and (field == "f" or value is not None):
                refuse(f"Function.{field}", f"{value!r} is not a function of t and state")

    def __call__(self, t: float, state: State) -> float:
        """The value of the law."""
        return self.f(t, state)


@dataclass(frozen=True)
class Sampled:
    """A law that is evaluated at ``start + k * period``, k = 0, 1, 2, …, and constant in between.

    Steps of every method end at these times. The held value is a first-order state of the force,
    such as ``controller.torque_held``; it is 0 before the first sample.

    A controller may have a memory, such as an integral. Its method ``reset()``, if it has one, is
    called at the start of each run, so that each run starts afresh. Without this method a run that
    starts with the memory of an earlier run gives a ``FunctionWarning``.

    Args:
        f: the function ``f(t, state)``, called once at each sample with the state there.
        period: time between two samples, s.
        start: time of the first sample, s.

    Raises:
        ModelError: ``f`` is not a function, or a number is invalid.
    """

    f: PythonLaw
    period: float
    start: float = 0.0

    def __post_init__(self) -> None:
        """Check the fields."""
        if not callable(self.f):
            refuse("Sampled.f", f"{self.f!r} is not a function f(t, state)")
        for field in ("period", "start"):
            value = number(getattr(self, field), f"Sampled.{field}")
            if isinstance(value, str):
                refuse(f"Sampled.{field}", f"{value!r} is not a number")
            object.__setattr__(self, field, float(value))
        if self.period <= 0.0:
            refuse("Sampled.period", f"{self.period:g} s; must be > 0")


class FunctionLaw:
    """A Python function in place of a law in the tree of a model.

    Attributes:
        path: such as ``forces.controller.torque``.
        f: the function.
        slopes: its derivatives, if they are known.
        sampling: period and start; None if it is called at each evaluation.
    """

    def __init__(self, path: str, given: PythonLaw | Sampled) -> None:
        self.path = path
        sampled = isinstance(given, Sampled)
        self.sampling = (given.period, given.start) if sampled else None  # type: ignore[union-attr]
        of: Any = given.f if sampled else given  # type: ignore[union-attr]
        self.f: PythonLaw = of.f if isinstance(of, Function) else of
        self.slopes: PythonSlopes | None = of.slopes if isinstance(of, Function) else None
        self._left: bytes | None = None  # the memory that the last run left, if it changed
        self.runs = 0  # the runs that have begun

    @property
    def is_differentiable(self) -> bool:
        """Whether its derivatives are known."""
        return self.slopes is not None and self.sampling is None

    def partials(self, t: float, state: State) -> dict[str, float]:
        """Its derivatives at a state, by quantity.

        Raises:
            ModelError: they are not finite numbers by name.
        """
        found: Any = self.slopes(t, state) if self.slopes else {}
        where = f"{self.path}: slopes of the function {self!r}"
        if not isinstance(found, Mapping):
            raise ModelError(f"{where} returned {found!r}; they must return {{quantity: number}}")
        for name, x in found.items():
            if not isinstance(name, str) or not isinstance(x, int | float) or not isfinite(x):
                raise ModelError(
                    f"{where} returned {x!r} for {name!r} at t = {t:.9g} s; they must return "
                    "finite numbers by the names of quantities"
                )
        return {name: float(x) for name, x in found.items()}

    def begin(self) -> tuple[bytes, bool]:
        """Begin a run: the controller forgets earlier ones.

        Returns its memory, and whether this is what an earlier run left.
        """
        self.runs += 1
        owner = self.f.__self__ if isinstance(self.f, MethodType) else self.f
        if callable(reset := getattr(owner, "reset", None)):
            reset()
            return b"", False
        before = memory(self.f)
        return before, before == self._left

    def end(self, before: bytes) -> None:
        """End a run that began with a memory."""
        after = memory(self.f) if before else before
        self._left = after if after != before else None

    def __deepcopy__(self, memo: object) -> FunctionLaw:
        return self  # a copied model calls the same function

    def __reduce__(self) -> NoReturn:
        refuse_saving([self])

    def __repr__(self) -> str:
        name = getattr(self.f, "__name__", type(self.f).__name__)
        return f"<Python function {name!r}>"


#: A number, a formula, or a Python function ``f(t, state)``.
Law: TypeAlias = "float | str | PythonLaw | Function | Sampled"
#: Two of them.
LawPair: TypeAlias = "Sequence[float | str | PythonLaw | Function | Sampled]"


#: The sections whose laws may be Python functions.
_WITH_FUNCTIONS = "forces."


def law(value: object, path: str) -> float | str | FunctionLaw:
    """A number, a formula, or for a force a Python function."""
    if not callable(value) and not isinstance(value, Sampled):
        return value if isinstance(value, FunctionLaw) else number(value, path)
    if not path.startswith(_WITH_FUNCTIONS):
        refuse(
            path,
            "a Python function can only be a law of a force: derivatives of the laws of joints and "
            "drivers are needed; write a formula or a table",
        )
    return FunctionLaw(path, value)


def law_pair(value: object, path: str) -> tuple[float | str | FunctionLaw, ...]:
    """Two numbers, formulas or Python functions."""
    first, second = two(value, path, "two numbers or formulas")
    return law(first, f"{path}[0]"), law(second, f"{path}[1]")


#: The check for each kind of field of an element.
ELEMENT_CHECKS: Mapping[str, Callable[[object, str], Any]] = {
    **CHECKS,
    "law": law,
    "law_pair": law_pair,
}


def memory(f: Any) -> bytes:
    """The attributes and enclosed variables of a function or callable object, as pickled bytes.

    Objects that cannot be pickled, such as those of local classes, count by their attributes.
    """
    parts, ahead, seen = [b"memory"], [f], set[int]()
    while ahead:
        one = ahead.pop()
        if id(one) in seen:
            continue
        seen.add(id(one))
        if isinstance(one, MethodType):
            ahead += [one.__self__, one.__func__]
        elif isinstance(one, FunctionType):
            ahead += [one.__dict__, *(_content(cell) for cell in one.__closure__ or ())]
        else:
            try:
                parts.append(pickle.dumps(one))
            except Exception:
                ahead += _parts(one)
    return b"".join(parts)


def _parts(one: Any) -> Iterable[Any]:
    """The parts of an object that cannot be pickled; models and modules have none."""
    if isinstance(one, dict):
        return one.values()
    if isinstance(one, list | tuple | set):
        return one
    is_foreign = not isinstance(one, ModuleType) and not type(one).__module__.startswith("kempe")
    return vars(one).values() if is_foreign and hasattr(one, "__dict__") else ()


def _content(cell: Any) -> Any:
    try:
        return cell.cell_contents
    except ValueError:  # it is still empty
        return None


def refuse_saving(laws: list[FunctionLaw]) -> NoReturn:
    """Raise the ``ModelError`` for saving a model with Python functions."""
    _refuse_functions(laws, "cannot be saved or pickled", ", or save the arrays of the solution")


def refuse_derivatives(laws: list[FunctionLaw]) -> None:
    """Raise the ``ModelError`` for derivatives of a model with functions that have none."""
    sampled = [law for law in laws if law.sampling is not None]
    without = [law for law in laws if not law.is_differentiable]
    if sampled:
        _refuse_functions(sampled, "cannot be differentiated, because it is sampled", "")
    if without:
        otherwise = ", or give its derivatives: kp.Function(f, slopes=g)"
        _refuse_functions(without, "cannot be differentiated", otherwise)


def _refuse_functions(laws: list[FunctionLaw], cannot: str, otherwise: str) -> NoReturn:
    named = ", ".join(law.path for law in laws)
    is_one = len(laws) == 1
    what = f"is a Python function, {laws[0]!r}" if is_one else "are Python functions"
    raise ModelError(
        f"{named} {what}, which {cannot}",
        hint=f"write {'a formula or a table in its' if is_one else 'formulas or tables in their'} "
        f"place{otherwise}",
        problems=tuple(Problem(f"{law!r} {cannot}", law.path) for law in laws),
    )


def without(value: Any) -> Any:
    """A tree with a text in place of each function."""
    if isinstance(value, Mapping):
        return {key: without(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [without(entry) for entry in value]
    return repr(value) if isinstance(value, FunctionLaw) else value


class Functions:
    """The functions of a model, as the core calls them.

    Attributes:
        laws: the functions with their places: element, field, number of the entry in a list.
    """

    def __init__(self, tree: Mapping[str, Any]) -> None:
        self.laws = list(_found(tree))
        self._compiled: Callable[[], CompiledModel | None] = lambda: None

    def listed(self) -> list[FunctionLaw]:
        """The functions."""
        return [law for _, _, _, law in self.laws]

    def described(self) -> list[tuple[Any, ...]]:
        """For the core: element, field, number of the entry, function, derivatives, sampling."""
        return [(*place, law.f, self._row(law), law.sampling) for *place, law in self.laws]

    def _row(self, law: FunctionLaw) -> Callable[[float, State], list[float]] | None:
        """The derivatives of a law by t, q, v, z and the parameters, at a state."""
        if not law.is_differentiable:
            return None

        def row(t: float, state: State) -> list[float]:
            partials = law.partials(t, state)
            compiled = self._own()
            x = np.concatenate([[t], state.q, state.v, state.z])
            try:
                by = _core.measure_slopes(compiled.core, list(partials), x)
            except ModelError as error:
                told = f"{law.path}: slopes of the function {law!r}: {error.args[0]}"
                error.args = (told, *error.args[1:])
                raise
            found: list[float] = (np.array(list(partials.values())) @ by).tolist()
            return found if partials else [0.0] * (len(x) + len(compiled.parameters))

        return row

    @contextmanager
    def run(self) -> Iterator[list[str]]:
        """A run of the model. Gives a text for each controller that does not begin it afresh."""
        begun = [(law, *law.begin()) for law in self.listed() if law.sampling is not None]
        try:
            yield [
                f"{law.path}: the controller {law!r} has the memory of an earlier run, so that the "
                "result may differ from that of a first run; give it a method reset(), which is "
                "called at the start of each run"
                for law, _, remembers in begun
                if remembers
            ]
        finally:
            for law, before, _ in begun:
                law.end(before)

    def belong_to(self, compiled: CompiledModel) -> None:
        """Use this model for states; the reference to it is weak, to avoid a reference cycle."""
        self._compiled = weakref.ref(compiled)

    def _own(self) -> CompiledModel:
        """The compiled model."""
        compiled = self._compiled()
        if compiled is None:
            raise ModelError("the model of this function no longer exists")
        return compiled

    def state(self, x: Floats) -> State:
        """The state with t, q, v and z."""
        compiled = self._own()
        n = 1 + compiled.n_q
        v, z = x[n : n + compiled.n_q], x[n + compiled.n_q :]
        state: State = CALLS["state"](compiled, x[0], x[1:n], v, z=z)
        return state


def _found(tree: Mapping[str, Any]) -> Iterator[tuple[str, str, int | None, FunctionLaw]]:
    for name, entry in tree["forces"].items():
        for field, value in entry.items():
            if isinstance(value, FunctionLaw):
                yield name, field, None, value
            for k, part in enumerate(value) if isinstance(value, list | tuple) else ():
                if isinstance(part, FunctionLaw):
                    yield name, field, k, part
