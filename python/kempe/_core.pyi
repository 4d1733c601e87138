"""Python interface of the compiled core.

Bulk data are NumPy arrays (float64, C order) with time as first axis. Structured data are JSON
texts. Ground has the number 0 and no columns of q; ``describe`` gives the columns of the others.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from kempe._core_exchange import *  # noqa: F403
from kempe._core_sweeps import *  # noqa: F403
from kempe._core_synthesis import *  # noqa: F403

_F = NDArray[np.float64]
_Progress = Callable[[float], None] | None
_View = tuple[tuple[float, float], float, tuple[float, float]]

def version() -> str:
    """Version of the compiled core."""

def instructions() -> str:
    """The instructions for which the core was compiled: ``x86-64-v3``, or the architecture."""

def supports_v3() -> bool:
    """Whether the processor and the operating system support x86-64-v3."""

def catalogue() -> str:
    """All types of a case with their fields, as JSON.

    ``{"bodies": [table], "tables": [table], "joints": …, "drivers": …, "forces": …, "methods": …,
    "stabilizations": …, "analyses": …}`` with ``table = {"name", "doc", "fields": [{"name",
    "shape", "unit", "default", "doc"}]}``; joints and drivers have ``"formulas"`` as ``formulas``
    gives them, in Unicode. Shapes are body, point, coordinate, number, law, pair and others.
    ``"functions": [{"name", "arguments", "doc"}]`` and ``"units": [{"name", "si", "dimension"}]``
    describe the language of formulas; ``si`` is the factor to the SI unit.
    """

def schema() -> str:
    """JSON Schema of a case."""

def is_reserved(name: str) -> bool:
    """Whether no element may have a name: ``t``, ``pi``, ``deg`` and ``ground``."""

_Mode = tuple[int, str, float, int, float]

class Case:
    """A parsed case with a valid structure."""

    def __init__(self, text: str, format: str, origin: str | None) -> None:  # noqa: A002
        """Parse a text.

        Args:
            text: the case.
            format: "toml" or "json".
            origin: name of the file for messages. None for a case built in Python; its messages
                contain paths without line and column.

        Raises:
            FileError: the structure is invalid; ``problems`` lists all problems.
        """

    def tree(self) -> str:
        """JSON of the case with the structure and the order of the file."""

    def write(self, format: str) -> str:  # noqa: A002
        """The case as "toml" or "json" text."""

    def variant(
        self, seed: int, texts: list[str]
    ) -> tuple[list[tuple[str, float, str]], list[str]]:
        """Random parameters (name, SI value, text) for a seed, and texts with these values."""

    def place(self, path: str) -> tuple[str, int, int] | None:
        """File, line and column of the entry at a path; None without a file or an entry."""

    def supply(self, table: str, x: _F, y: _F) -> Case:
        """The same case with the points that the file of a table contains, if there is one."""

    def model(
        self,
        overrides: str,
        functions: list[tuple[Any, ...]] | None = None,
        state: Callable[[_F], object] | None = None,
    ) -> Model:
        """Compile the model with other parameters, ``{"k": 2e6, "c": "k/100"}``.

        Args:
            overrides: values of parameters, as JSON.
            functions: Python functions as laws of forces: element, field, number of the entry in a
                list, function ``f(t, state)``, period and start or None.
            state: makes a state of an array (t, q, v, z).

        Raises:
            ModelError: the model is invalid; ``problems`` lists all problems.
        """

    def check(self, model: Model) -> None:
        """Check start and analyses.

        Raises:
            ModelError: an entry is invalid; ``problems`` lists all problems.
        """

    def analyses(self) -> tuple[str, list[int | None]]:
        """The analyses as JSON, in order; for each the index of the one at whose end it starts."""

class Model:
    """A compiled, immutable model."""

    def describe(self) -> str:
        """Contents of the model with numerical values, as JSON.

        ``{"title", "gravity": [x, y], "parameters": {…}, "n_q", "n_z", "n_rows",
        "bodies": [{"name", "type", "mass", "inertia", "center": [x, y], "points": {"B": [x, y]},
        "curves": {"rim": {"points": [[x, y]], "closed": bool}}, "columns": [start, stop]}],
        "constraints": [{"name", "group": "joints" | "drivers", "type", "i", "j", "bodies": [name],
        "point_i": [x, y], "point_j": [x, y], "axis_i": angle, "axis_j": angle,
        "rows": [start, stop], "equations": [{"name", "unit"}],
        "columns": [start, stop], "coordinates": [{"name", "unit"}],
        "results": [{"name", "unit", "negative": null | event}]}],
        "forces": [{"name", "type", "i", "j", "bodies": [name], "parts": ["stiffness", "damping"],
        "points": null | [[x, y], [x, y]], "places": [start, stop], "states": [{"name", "unit"}],
        "reaction": null | joint}],
        "tables": [{"name", "interpolation", "range": [first, last], "period": null | x}]}``; the
        first body is ground. ``columns`` of a body are its coordinates in q, those of a constraint
        its internal coordinates; ``places`` of a force are its states in z.
        """

    def table(self, name: str, derivative: int, x: _F) -> _F:
        """Values of a table or of one of its derivatives up to the fifth, in SI units, or NaN."""

    def symbols(self) -> str:
        """The symbols that a drawing shows for the elements, in the order of the model, as JSON:
        ``[{"element": name, "mark": word, "i": end, "j": end, "radius": null | m}]``, where an end
        is ``{"body": number, "point": null | [x, y], "axis": angle}``.
        """

    setting: tuple[list[tuple[str, float]], list[str], list[_Mode]]
    """Values of parameters, released drivers and modes by which it differs from the case's."""

    def variant(
        self, parameters: list[tuple[str, float]], released: list[str], modes: list[_Mode]
    ) -> Model:
        """The same model with other parameters, with released drivers and modes of forces.
        Released drivers keep their rows; their multipliers and residuals are zero.

        Raises:
            ModelError: a number is impossible.
        """

    def allowing_redundancy(self) -> Model:
        """The same model with redundant constraints accepted."""

class Run:
    """Result of an integration."""

    t: _F
    """(n_t,), s."""
    q: _F
    """(n_t, n_q)."""
    v: _F
    """(n_t, n_q)."""
    z: _F
    """(n_t, n_z)."""
    dense_t: _F | None
    """(k + 1,), s: the boundaries of the steps."""
    dense_y: _F | None
    """(k, n_y): y = [q, v, z, works] at the start of each step."""
    dense_c: _F | None
    """(k, n_y, 4): y(t_old + θ h) = y_old + h Σ_k c[:, k] θ^(k + 1)."""
    projection: float | None
    """Tolerance of the projection of its states; None with another stabilization."""
    status: str
    """"reached", "event" or "stopped"."""
    message: str
    doubts: list[str]
    statistics: str
    """JSON: ``{"steps", "rejected", "evaluations", "jacobians", "iterations", "factorisations",
    "seconds"}``, with ``"method"`` and ``"why"`` for the automatic choice."""

    settings: list[tuple[int, tuple[list[tuple[str, float]], list[str], list[_Mode]]]]
    """The first row of each phase, with parameters, released drivers and modes of forces in it."""
    events: list[tuple[str, _F, _F, _F, _F, _F]]
    """Name, times (n,) and rows of q, v and z of each event, and impulses of the multipliers."""

    def responses(self, rows: int | None = None) -> tuple[_F, _F]:
        """Accelerations (n_t, n_q) and multipliers (n_t, n_rows), at all or the first times."""

    def energies(self, rows: int | None = None) -> _F:
        """(n_t, 5), J: kinetic, potential, dissipated, work of drivers, work of applied forces."""

def assemble(
    model: Model,
    set: str,  # noqa: A002
    guess: str,
    t: float,
    q: _F | None,
    v: _F | None,
    z: _F | None,
    from_guess: bool = False,
) -> tuple[float, _F, _F, _F, str]:
    """Assemble a mechanism.

    Args:
        model: the mechanism.
        set: prescribed coordinates and rates, JSON ``{"crank.angle": "70*deg"}``.
        guess: starting values of coordinates and rates, in the same form.
        t: time, s.
        q: guess of all coordinates, (n_q,).
        v: guess of all velocities, (n_q,).
        z: first-order states of the result, (n_z,); zeros without a whole guess.
        from_guess: whether the Newton iteration starts from the guess with open loops.

    Returns:
        t, q, v, z and a report as JSON: ``{"iterations": [{"residual", "step", "damping"}],
        "degrees_of_freedom", "modes": [{"bodies", "joint", "side": "left" | "right" | "ahead" |
        "behind", "folded": bool | None}], "warnings": [text]}``.

    Raises:
        AssemblyError, RedundancyError, ModelError.
    """

_At = tuple[float, _F, _F, _F]
#: The compiled model, its case as JSON, the quantity that replaces the time, its unit, its value at
#: the start, and whether the mechanism is at rest at each value.
Driven = tuple[Model, str, str, str, float, bool]

class Record:
    """What an analysis found."""

    run: Run | None
    """The motion; None if the result is not one."""
    driven: Driven | None
    """The mechanism in which a quantity replaces the time."""
    numbers: dict[str, _F]
    """Other numbers by name, (n, width)."""
    findings: str
    """The other findings, as JSON."""
    remarks: list[str]

    def number(self, text: str) -> float:
        """A number of a result that is not a motion, such as ``frequency[0]``."""

def run_analysis(
    model: Model,
    options: str,
    at: _At,
    released: list[str],
    progress: _Progress,
    after: bool = False,
    t_end: float | None = None,
    actions: tuple[list[str], Callable[..., object]] | None = None,
) -> Record:
    """Run an analysis from a state.

    Args:
        model: the mechanism.
        options: JSON, an entry of ``analyses`` as in a file.
        at: t, q (n_q,), v (n_q,) and z (n_z,) of the state.
        released: the drivers that were released before.
        progress: function that is called repeatedly with the time or value reached.
        after: whether it starts at the end of another analysis, where joints may have drifted.
        t_end: end time of dynamics, s; it replaces the value in the options.
        actions: names of events, and the function ``f(name, setting, t, q, v, z)`` called at each:
            it returns values of parameters and None, or a new state (q, v, z).

    Raises:
        KempeError: the analysis failed; ``record`` of the error contains the motion so far.
    """

def rate_unit(unit: str, by: str) -> str:
    """The SI unit of a rate in a motion over a quantity with the unit ``by``: m/s becomes m/rad."""

def driven_by(model: Model, over: str | None, at: _At, released: list[str]) -> Driven:
    """The mechanism in which t is the value of a driver or position quantity.

    By default, ``over`` is the only driver.

    Raises:
        ModelError: there is no such driver or quantity, or several drivers determine the motion
            already.
    """

def compliance(
    model: Model, t: float, q: _F, v: _F, z: _F, point: str, hold: list[str]
) -> list[float]:
    """∂(displacement)/∂(force) of a point at rest, m/N: xx, xy, yx, yy."""

class States:
    """States of a model in rows, with accelerations and multipliers where they are known."""

    def __init__(
        self,
        model: Model,
        t: _F,
        q: _F,
        v: _F,
        z: _F,
        a: _F | None = None,
        lam: _F | None = None,
    ) -> None:
        """Read (n_t,), (n_t, n_q) twice, (n_t, n_z), (n_t, n_q) and (n_t, n_rows).

        Raises:
            ModelError: an array has another shape, or contains a number that is not finite.
        """

    def evaluate(self, passing: bool) -> list[_F]:
        """Accelerations (n_t, n_q), multipliers (n_t, n_rows), with γ, not γ̂; regularity (n_t, 1).

        With ``passing`` near singular positions as well, as in runs that pass them.
        """

    def project(self, tolerance: float) -> list[_F]:
        """q and v, (n_t, n_q), of an interpolant, projected as reported states are."""

    def energies(self, works: _F) -> _F:
        """``Run.energies`` with these ends of the rows of the interpolant, (n_t, n_works)."""

    def residual(self) -> list[_F]:
        """Φ and Φ_q q̇ + Φ_t, (n_t, n_rows) each."""

    def measured(self, name: str) -> _F:
        """Position, rate and acceleration of each position quantity of an element: (n_t, 3 n).

        Without accelerations these are taken as zero.
        """

    def reaction(self, joint: str, on: str, frame: str) -> _F:
        """Force and torque about the joint point of a joint on a body: (n_t, 3), N and N·m."""

    def impulse(self, name: str, on: str) -> _F:
        """The same at impacts, N·s and N·m·s; the multipliers are the impulses."""

    def place(self, joint: str, on: str) -> _F:
        """The point at which the reaction on a body is given, (n_t, 2), global, m."""

    def results(self, joint: str) -> _F:
        """The results of a joint beside its reaction, (n_t, n); ``describe`` names them."""

    def force(self, name: str, on: str, part: str | None, frame: str) -> _F:
        """Force of a force element on a body, and its torque about its place: (n_t, 3).

        It needs multipliers if it depends on a reaction.
        """

    def force_place(self, name: str, on: str) -> _F:
        """The point at which a force element acts on a body, or the body's origin: (n_t, 2), m."""

    def force_results(self, name: str) -> _F:
        """The results of a force element beside its wrenches, (n_t, n); ``describe`` names them."""

    def force_energy(self, name: str) -> _F:
        """Energy that a force element stores, J, and power that it dissipates, W: (n_t, 2)."""

    def newton_euler(self) -> _F:
        """The balances of bodies and coordinates; see ``kempe.results.newton_euler``."""

    def friction_modes(self) -> list[tuple[int, list[_Mode]]]:
        """The modes of friction at rest, by stretches of rows; see ``results.friction_at_rest``."""

    def friction_range(self, passing: bool) -> list[_F] | None:
        """The least and the largest multipliers, (n_t, m), while drivers hold friction at rest."""

    def not_unique(self) -> list[list[str]]:
        """What has no unique load at a state: redundant, of second order, shared at rest."""

    def measure(self, text: str) -> _F:
        """The values of a measure, (n_t,), from accelerations and multipliers if it needs them."""

def matrices(model: Model, t: float, q: _F, v: _F, z: _F, set: str) -> dict[str, Any]:  # noqa: A002
    """``M``, ``Phi``, ``Phi_q``, ``nu``, ``gamma``, ``Q``, ``kkt``; names and units of ``rows``.

    ``set`` has further driver rows, as in ``assemble``.
    """

def formulas(model: Model, name: str, written: dict[str, str], form: str) -> str:
    """Φ, Φ_q and γ of a joint or driver as formulas, as JSON.

    ``{"columns": [text], "definitions": [[name, text]], "rows": [{"residual", "jacobian": [text],
    "gamma"}], "names": [text]}`` with one entry of ``jacobian`` for each column.

    ``written`` has the fields of its entry that are texts, by which points are named; ``form`` is
    "expression", "unicode" or "latex".
    """

def scene(model: Model, poses: _F, efforts: list[tuple[str, _F, _F]]) -> str:
    """The static parts of a scene as JSON; see ``kempe.model.drawing`` for all of these."""

def display(scene: str, poses: _F, view: _View, request: str) -> str:
    """The display list of a scene; ``request`` has the fields of ``Request`` in Rust."""

def view_around(bounds: tuple[float, float, float, float], size: tuple[float, float]) -> _View: ...
def place_texts(anchors: _F, sizes: _F, lines: _F, boxes: _F, area: tuple[float, float]) -> _F: ...
def text_width(words: str, size: float, bold: bool) -> float: ...
def _inject_panic(entry: str | None) -> None: ...
def _raise(kind: str, message: str) -> None: ...
