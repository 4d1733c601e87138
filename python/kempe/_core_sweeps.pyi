"""Mobility, measures, sweeps and stepped runs: a part of the interface ``kempe._core``."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from kempe._core import Model, Run

_F = NDArray[np.float64]

def instants(bounds: _F, outputs: _F, numbers: int) -> _F:
    """Instants of an interpolant with these boundaries of steps, close enough for smooth curves.

    ``numbers`` is the count of numbers in the state at an instant. Times with two outputs are among
    them, with the numbers before.
    """

def interpolate(t: _F, y: _F, c: _F, times: _F) -> _F:
    """The rows y of an interpolant, as in ``Run``, at times: (n, n_y)."""

def singular_instants(
    t: _F, regularity: _F, read: Callable[[_F], _F]
) -> tuple[list[int], list[int], list[float]]:
    """The singular positions at instants ``t``; ``read`` gives the regularity at times.

    Returns:
        Places of the instants that are kept; places among them, and times, of the positions.
    """

def maxima(
    t: _F,
    sampled: _F,
    near: list[int],
    near_t: _F,
    resolved: bool,
    read: Callable[[_F], _F],
) -> tuple[_F, _F, list[int], _F]:
    """The largest local maxima of a quantity with the values ``sampled`` at instants ``t``.

    ``near`` and ``near_t`` are places and times of known singular positions; ``read`` gives values
    at times. An error of kempe in it means that there is no value; other exceptions are raised.

    Returns:
        Values and times of the maxima, places and times of singular positions.
    """

def extreme(
    sign: float, t: _F, values: _F, between: tuple[_F, _F, _F, _F, bool] | None = None
) -> tuple[float, float]:
    """The extreme value and its time, for values with the sign that makes it a maximum.

    ``between`` are times and values on the interpolant, values and times of the maxima there, and
    whether singular positions were met.
    """

def changes(values: _F) -> bool:
    """Whether values differ by more than rounding errors."""

def integrals(
    t: _F, values: _F, between: tuple[_F, int, _F, Callable[[_F], _F]] | None = None
) -> list[float] | None:
    """The integral, the mean and the root mean square of values at outputs.

    ``between`` are ends of steps, the degree of their interpolant, times at which steps are not
    halved, and a function that gives values at times: the integrals are then those in the steps,
    None without a value.
    """

def row_norms(rows: _F) -> _F:
    """The lengths of rows, (n,)."""

def settling(
    t: _F,
    values: _F,
    noise: float | None = None,
    between: Callable[[_F], _F] | None = None,
) -> tuple[bool, float | None]:
    """Whether a quantity changes, and its settling time, s; None if it does not settle."""

def sweeps(model: Model, statistics: list[str], reads: bool, slopes: bool) -> bool:
    """Whether ``sweep`` serves a model and statistics; ``reads``: whether it reads quantities.

    With ``slopes``, whether ``gradient`` does.
    """

def sweep(
    model: Model,
    start: str,
    guess: str,
    analyses: str,
    measures: list[str],
    wanted: list[tuple[int | None, str]],
    parameters: list[str],
    coordinates: list[str],
    rows: _F,
    workers: int,
) -> tuple[_F, list[tuple[int, str]], NDArray[np.uint64]]:
    """Run variants of a case on threads.

    Args:
        model: the model of the case.
        start, guess: coordinates and rates at the start, JSON as in a file.
        analyses: the analyses by name, JSON as in a file; the last one is swept.
        measures: expressions of quantities, none of a whole run.
        wanted: statistics, each of a measure by its place; without a place numbers of a result.
        parameters, coordinates: names of the columns of ``rows``; coordinates are entries of
            ``start``.
        rows: values, (n, columns).
        workers: number of threads.

    Returns:
        The numbers, (n, n_wanted); the reasons of rows that failed; the rows that a single run
        decides.
    """

def gradient(
    model: Model,
    start: str,
    guess: str,
    analyses: str,
    measures: list[str],
    wanted: list[tuple[int | None, str]],
    parameters: list[str],
    coordinates: list[str],
    row: _F,
) -> tuple[_F, _F, list[tuple[int, int, str]]]:
    """The numbers of a case and their derivatives; the arguments are those of ``sweep``.

    Args:
        row: values of the parameters, then of the coordinates, (n_variables,).

    Returns:
        The numbers, (n_wanted,); their derivatives, (n_wanted, n_variables), NaN where there is
        none; remarks with the places of number and variable.

    Raises:
        KempeError: the run fails.
    """

def slopes_at(
    model: Model,
    start: str,
    guess: str,
    analyses: str,
    measures: list[str],
    times: _F,
    parameters: list[str],
    coordinates: list[str],
    row: _F,
) -> tuple[_F, _F, str]:
    """Measures of the motion of the last analysis at times, and their derivatives.

    Returns:
        (n_times, n_measures); (n_times × n_measures, n_variables); why there are no derivatives,
        with empty tables, otherwise an empty text.

    Raises:
        KempeError: the run fails, or has no value at a time.
    """

def formula_names(text: str) -> list[str]:
    """The names in a formula, each once."""

def formula_unit(text: str, names: list[str], units: list[str]) -> str:
    """The SI unit of a formula whose names have these units; empty if it is not known."""

def formula_value(text: str, names: list[str], values: list[float]) -> tuple[float, list[float]]:
    """The value of a formula, and its derivatives by its names."""

def measure(model: Model, text: str) -> tuple[list[str], str, bool, bool]:
    """Quantities of an expression, and its SI unit.

    Then whether it uses quantities of a whole run, and whether it needs accelerations or
    multipliers.
    """

def measure_values(model: Model, text: str, t: _F, quantities: _F) -> _F:
    """Values of an expression, (n_t,), for the values of its quantities, (n_t, n)."""

def measure_slopes(model: Model, names: list[str], x: _F) -> _F:
    """Derivatives of quantities at x = (t, q, v, z) by x and the parameters, (n, n_x + n_p)."""

def line_at(model: Model, joint: str, body: str) -> tuple[list[str], float | None]:
    """The pins and slides of a body besides a joint, and its line from there in its frame, rad."""

def transmitting(model: Model) -> list[str]:
    """The pins at which a link without a driver, guided by ground, is moved by another link."""

def configurations(model: Model, held: str, limit: int, t: float) -> tuple[_F, _F, _F, str]:
    """q, v and z of all configurations, one row each, with JSON.

    The JSON has ``complete``, ``left_out`` and ``reports``.
    """

class SavedRun:
    """A state of a stepped run from which it continues."""

class SteppedRun:
    """A run that advances part by part."""

    def __new__(
        cls,
        model: Model,
        options: str,
        at: tuple[float, _F, _F, _F],
        released: Sequence[str],
        actions: tuple[list[str], Callable[..., object]] | None = None,
    ) -> SteppedRun: ...
    t: float
    """The time reached, s."""
    state: tuple[float, _F, _F, _F]
    """Time, q, v and z."""
    works: _F
    """(3,), J: dissipated energy, work of drivers, work of applied forces."""
    setting: tuple[list[tuple[str, float]], list[str], list[tuple[int, str, float, int, float]]]
    """Parameters, released drivers and modes of forces that differ from the model."""
    stopped_by: str | None
    """The event that has stopped the run."""

    def step(self, duration: float) -> list[str]:
        """Advances by a duration, s; returns its doubts."""

    def set(self, parameters: Sequence[tuple[str, float]]) -> None:
        """Gives parameters other values."""

    def save(self) -> SavedRun: ...
    def restore(self, saved: SavedRun) -> None: ...
    def last_part(self) -> Run: ...
