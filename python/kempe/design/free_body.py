"""The free-body diagram of a body at an instant: all forces on it, its inertia loads, and files.

In the file each load is a row in the axes of the body. The last rows are the weight and the inertia
load, both as resultants at the mass centre and as fields for finite elements. The fields are
gravity g and the acceleration a + α × (p - c) - ω² (p - c) of a point p, with the acceleration a of
the mass centre c. D'Alembert's load is minus density times this acceleration. All loads together
are in balance.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import numpy as np

from kempe.base import files
from kempe.base.arrays import Floats, fixed
from kempe.design.wrenches import Inertia, Load, imbalance, inertia, loads
from kempe.errors import ModelError
from kempe.model.values import instance
from kempe.results.motion import Motion
from kempe.results.remarks import by_choice, unbounded_at, when
from kempe.results.solution import Solution
from kempe.results.state import State
from kempe.results.variable import Variable

#: A load case is written if its error of balance is at most this share of its largest load.
BALANCED = 1e-9

_HEADER = (
    "load,kind,x [m],y [m],fx [N],fy [N],moment [N*m],"
    "ax [m/s^2],ay [m/s^2],alpha [rad/s^2],omega2 [rad^2/s^2]"
)


@dataclass(frozen=True, repr=False)
class FreeBody:
    """A body with all forces on it at an instant.

    Attributes:
        body: the body.
        name: name of the load case, such as "A_max"; empty by default.
        variable, t: the quantity that defines the instant, and its value, s.
        state: the whole mechanism at the instant.
        loads: the forces of joints, drivers and elements, and the weight, in global axes.
        inertia: m a and J α.
        residual: error of Newton's and Euler's equations, relative to the largest force (moment) on
            the body at the instant.
        not_unique: the joints, drivers and forces whose loads are not unique, each with the choice
            among the possible values: "minimum norm", "second-order load left out", "middle of
            friction at rest" or "one way to share the load".
        unbounded_at: times of singular positions of the solution beside which a load has no bound,
            by joint or driver.
    """

    body: str
    name: str
    variable: Variable
    t: float
    state: State
    loads: tuple[Load, ...]
    inertia: Inertia
    residual: float
    not_unique: Mapping[str, str]
    unbounded_at: Mapping[str, tuple[float, ...]]

    @property
    def remarks(self) -> tuple[str, ...]:
        """What loads over a driven quantity contain, and which are not unique or have no bound."""
        told = [f"loads {self.variable.condition}"] if self.variable.condition else []
        for choice, _, which in by_choice(self.not_unique):
            told.append(f"not unique, {choice}: {', '.join(which)}")
        if self.unbounded_at:
            times = sorted({t for each in self.unbounded_at.values() for t in each})
            names = ", ".join(self.unbounded_at)
            told.append(f"without bound {when(times, self.variable)}: {names}")
        return tuple(told)

    def in_body(self, vector: Floats) -> Floats:
        """Components of a global vector in the axes of the body, (2,)."""
        return _turned_back(vector, float(self.state.body(self.body).angle))

    def place(self, load: Load) -> Floats:
        """The point at which a load acts, in the frame of the body, (2,), m."""
        view = self.state.body(self.body)
        return _turned_back(load.place - view.r, float(view.angle))

    def to_csv(self, path: Path | str) -> None:
        """Write the load case for finite elements; see ``kempe.design.free_body``.

        Raises:
            ModelError: the loads are not in balance with the inertia loads to 1e-9.
            FileError: the file cannot be written; an existing file is not changed.
        """
        error = imbalance(list(self.loads), self.inertia)
        if not max(error, self.residual) <= BALANCED:
            raise ModelError(
                f"the loads on {self.body} at {self.variable.name} = {self.t:g} are not in balance "
                f"with its inertia: error {max(error, self.residual):.2g} of the largest load",
                name=self.body,
                hint="make the load case with kp.design.load_cases, and do not change it",
            )
        files.write_text(path, self._text())

    def _text(self) -> str:
        of = self.variable
        info = self.state.compiled.bodies[self.body]
        case = f", case {self.name}" if self.name else ""
        lines = [
            f"# loads on {self.body}{case}, at {of.name} = {self.t:.17g} {of.unit}",
            "# axes of the body; forces act on the body; its origin is (0, 0)",
            f"# mass {info.mass:.17g} kg, inertia {info.inertia:.17g} kg*m^2 about the mass centre",
            "# gravity and inertia: resultants at the mass centre, or fields in the last columns",
            *(f"# {told}" for told in self.remarks),
            _HEADER,
        ]
        lines += [self._row(load) for load in self.loads if load.kind != "gravity"]
        weight = next((load for load in self.loads if load.kind == "gravity"), None)
        if weight is not None:
            gravity = self.in_body(np.array(self.state.compiled.gravity))
            lines.append(self._row(weight, (*gravity, 0.0, 0.0)))
        lines.append(self._inertia_row())
        return "\n".join(lines) + "\n"

    def _row(self, load: Load, field: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)) -> str:
        x, y = self.place(load)
        fx, fy = self.in_body(load.force)
        numbers = (x, y, fx, fy, float(load.moment), *field)
        name = files.csv_cell(load.name)
        return f"{name},{load.kind}," + ",".join(f"{float(number):.17g}" for number in numbers)

    def _inertia_row(self) -> str:
        view, of = self.state.body(self.body), self.inertia
        zero = Load("inertia", "inertia", fixed(-of.force), fixed(-of.moment), of.centre)
        a = self.in_body(of.acceleration)
        return self._row(zero, (*a, float(view.alpha), float(view.omega) ** 2))

    def __repr__(self) -> str:
        names = ", ".join(load.name for load in self.loads)
        told = "".join(f"; {told}" for told in self.remarks)
        return f"<FreeBody {self.body} at {self.variable.name} = {self.t:g}: {names}{told}>"


def _turned_back(vector: Floats, angle: float) -> Floats:
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = np.asarray(vector)
    return np.array([cos * x + sin * y, cos * y - sin * x])


def free_body(
    solution_or_state: Solution | State, body: str, t: float | None = None, *, name: str = ""
) -> FreeBody:
    """A body with all forces on it at an instant.

    Args:
        solution_or_state: a solution or a state.
        body: a moving body.
        t: the instant in a solution, s; the first instant when None.
        name: name of the load case.

    Raises:
        ModelError: there is no such moving body, or the instant is not within the solution.
        SingularityError: reactions are not unique.
    """
    instance(solution_or_state, (Solution, State), "a solution or a state")
    state: Motion = solution_or_state
    if isinstance(solution_or_state, Solution):
        state = solution_or_state.initial if t is None else solution_or_state(float(t))
    assert isinstance(state, State)
    if not state.compiled.body(body).number:
        raise ModelError(f"{body} does not move", name=body, hint="name a moving body")
    found, own = loads(state, body), inertia(state, body)
    names = [load.name for load in found if load.name in state.compiled.constraints]
    choices = solution_or_state.choices
    passed = {name: unbounded_at(solution_or_state, name) for name in names}
    return FreeBody(
        state.body(body).name,
        name,
        state.variable,
        float(state.t),
        state,
        tuple(found),
        own,
        imbalance(found, own),
        MappingProxyType({load.name: choices[load.name] for load in found if load.name in choices}),
        MappingProxyType({name: times for name, times in passed.items() if times}),
    )
