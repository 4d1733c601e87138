"""Results of statics: an equilibrium position, or a path of equilibria over a parameter."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from kempe.analyses.dynamics import AccuracyWarning
from kempe.analyses.record import Record
from kempe.base.arrays import Floats, fixed
from kempe.base.display_units import display
from kempe.base.warn import warn
from kempe.model.compiled import CompiledModel
from kempe.model.measure_infos import parameter_unit
from kempe.results import quantities
from kempe.results.result import Result
from kempe.results.state import State
from kempe.results.table import Column, column

#: Largest number of lines of one kind in a report.
_MOST = 20
#: Largest number of states of a path in which beams are examined.
_EXAMINED = 10
#: Jump of the bending moment between elements, relative to the largest one, from which on there are
#: too few elements. The error of the displacements is about a hundredth of it.
_COARSE = 0.02
#: Ends of a path.
_ENDS = {
    "last": "the path reached the end of the range",
    "first": "the path turned and came back to the beginning of the range",
    "lost": "the path could not be followed further",
    "long": "the path has very many points and was ended",
}


class EquilibriumResult(Result):
    """An equilibrium position with its stability and efforts, or a path over a parameter.

    On a path, ``stable``, ``eigenvalues`` and the efforts have one entry for each point. A path may
    turn back, so that a parameter value can occur several times.

    Attributes:
        start: the state from which the search started.
        over: the parameter of a path; otherwise None.
        hold: the quantities that a holder keeps.
        coordinates: names of the independent coordinates of the stiffness, (f).
        states: the states of all points; a single state without a path. Their reactions and efforts
            are static.
        values: (n,), the values of the parameter; empty without a path.
        folds: (n_folds,), values of the parameter at which the path turns back.
        branches: values at which the stability changes without a fold: other paths cross there.
        fold_points, branch_points: indices of the folds and branches among the states.
        stable: whether all eigenvalues are positive; (n,) on a path.
        eigenvalues: (f,) or (n, f): eigenvalues of the reduced stiffness on the independent
            coordinates, ascending. The stiffness is the Hessian of the potential if all forces have
            a potential; otherwise the real parts are returned. N*m/rad for an angle, N/m for a
            length.
        stiffness: (f, f) or (n, f, f): the reduced stiffness.
        effort: the force or torque of a holder that keeps each quantity of ``hold``, and the
            effort of each driver by its name; positive if it increases the coordinate. (n,) on
            a path.
        residual: the largest unbalanced force, relative to the largest single force.
        steps, relaxed: steps of Newton's method and of dynamic relaxation; 0 on a path.
        end: text about the end of a path; otherwise "".
        complete: whether a path ended at an end of its range; True without a path.
    """

    kind: ClassVar[str] = "equilibrium"

    def __init__(self, record: Record) -> None:
        start, entry, found = record.initial, record.entry, record.findings
        points = found["points"]
        self.start = start
        self.over: str | None = entry.get("over")
        model, values = record.model, found.get("values", [None])
        models = [model.variant(([(self.over, x)], [], [])) if self.over else model for x in values]
        self.hold: tuple[str, ...] = tuple(entry.get("hold", ()))
        self.states = tuple(
            _state(model, start.t, point) for model, point in zip(models, points, strict=True)
        )
        self.coordinates: tuple[str, ...] = tuple(points[0]["coordinates"])
        self.values: Floats = fixed(np.array(found.get("values", ()), dtype=float))
        self.fold_points: tuple[int, ...] = tuple(found.get("folds", ()))
        self.branch_points: tuple[int, ...] = tuple(found.get("branches", ()))
        self.folds: Floats = fixed(self.values[list(self.fold_points)])
        self.branches: Floats = fixed(self.values[list(self.branch_points)])
        f = len(self.coordinates)
        stiffness = np.array([point["stiffness"] for point in points]).reshape(len(points), f, f)
        eigenvalues = np.array([point["eigenvalues"] for point in points]).reshape(len(points), f)
        self.stiffness: Floats = fixed(self._of(stiffness))
        self.eigenvalues: Floats = fixed(self._of(eigenvalues))
        stable = np.array([point["stable"] for point in points])
        self.stable: Any = stable if self.over else bool(stable[0])
        self.effort: Mapping[str, Any] = self._efforts(points)
        self.residual = max(float(point["residual"]) for point in points)
        self.steps, self.relaxed = int(points[0]["steps"]), int(points[0]["relaxed"])
        why = found.get("why")
        told = _ENDS.get(found.get("end", ""), "")
        self.end = f"{told}: {why}" if why else told
        self.complete = found.get("end", "last") in ("last", "first")
        self._look_at_beams(model)

    def _look_at_beams(self, model: CompiledModel) -> None:
        """Warn of beams with too few elements for their bending."""
        some = np.linspace(0, len(self.states) - 1, _EXAMINED).astype(int)
        for name in (name for name, body in model.bodies.items() if body.type == "beam"):
            views = [self.states[k].beam(name) for k in sorted(set(some))]
            with warnings.catch_warnings():
                # what the forces leave out is reported to those who read them
                warnings.simplefilter("ignore")
                most = [float(np.abs(view.bending_moment).max()) for view in views]
                jumps = [view.error * own for view, own in zip(views, most, strict=True)]
            k = int(np.argmax(jumps))
            if jumps[k] > _COARSE * max(most):
                warn(
                    f"{name} has too few elements: its bending moment jumps by "
                    f"{100 * views[k].error:.2g} % where elements meet; elements = "
                    f"{views[k].enough} makes the jumps about 0.1 %",
                    AccuracyWarning,
                )

    def _of(self, values: Floats) -> Floats:
        """The rows of a path, or the only one."""
        return values if self.over else values[0]

    def _efforts(self, points: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
        rows = [
            {**dict(point["efforts"]), **dict(zip(self.hold, point["holders"], strict=True))}
            for point in points
        ]
        if self.over:
            return {name: fixed(np.array([row[name] for row in rows])) for name in rows[0]}
        return {name: float(value) for name, value in rows[0].items()}

    @property
    def state(self) -> State:
        """The rest position; the last one of a path."""
        return self.states[-1]

    @property
    def final(self) -> State:
        """The rest position; the last one of a path."""
        return self.state

    def quantity(self, name: str) -> Floats:
        """A quantity such as ``crank.angle`` at all points, (n,), SI units.

        Raises:
            ModelError: there is no such quantity.
        """
        return fixed(np.array([float(state[name]) for state in self.states]))

    @cached_property
    def _units(self) -> dict[str, str]:
        names = (*self.coordinates, *self.hold)
        return {name: quantities.named(self.state, name).unit for name in names}

    @property
    def _unit_over(self) -> str:
        """The unit of the parameter of a path; empty for a parameter without one."""
        found = parameter_unit(self.start.compiled, self.over or "")
        return "" if found == "SI" else found

    def unit_of_effort(self, name: str) -> str:
        """N for a length, N*m for an angle."""
        drivers = self.state.compiled.drivers
        if name in drivers:
            return quantities.named(self.state, f"{name}.effort").unit
        return "N*m" if self._units[name] == "rad" else "N"

    def unit_of(self, name: str) -> str:
        """The SI unit of a quantity such as ``crank.angle``."""
        return quantities.named(self.state, name).unit

    def summary(self) -> dict[str, Any]:
        """The result as plain data in SI units and rad."""
        common = {
            "hold": list(self.hold),
            "coordinates": list(self.coordinates),
            "stable": np.asarray(self.stable).tolist(),
            "eigenvalues": self.eigenvalues.tolist(),
            "effort": {name: np.asarray(x).tolist() for name, x in self.effort.items()},
            "residual": self.residual,
        }
        if self.over is None:
            steps = {"steps": self.steps, "relaxed": self.relaxed}
            return {"state": self.state.coordinates(), **common, **steps}
        path = {"over": self.over, "values": self.values.tolist(), "folds": self.folds.tolist()}
        ends = {"branches": self.branches.tolist(), "complete": self.complete, "end": self.end}
        return {**path, **ends, **common}

    def report(self) -> list[str]:
        """The rest position, its stability and efforts; or the path with its folds."""
        return self._path_report() if self.over else self._point_report()

    def _point_report(self) -> list[str]:
        lines = str(self.state).splitlines()
        kind = "stable" if self.stable else "not stable"
        if not self.coordinates:
            kind = "held: no freedom is left"
        elif not self.stable and float(np.min(self.eigenvalues)) == 0.0:
            kind = "indifferent: it can move without any force"
        lines.append(kind)
        shown = zip(self.coordinates, self.eigenvalues, strict=True)
        count = len(self.coordinates)
        if count == 1:
            name, value = next(shown)
            lines.append(f"stiffness along {name}: {value:.6g} {_per(self._units[name])}")
        elif count:
            values = ", ".join(f"{x:.6g}" for x in self.eigenvalues[:_MOST])
            more = f" and {count - _MOST} more" if count > _MOST else ""
            lines.append(f"eigenvalues of the stiffness: {values}{more}")
            lines.append(f"on {', '.join(self.coordinates[:_MOST])}{more}")
        for name, value in self.effort.items():
            who = "the driver" if name in self.state.compiled.drivers else "a holder"
            unit = display(self.unit_of_effort(name))
            applied = f"{value / unit.divisor:.6g} {unit.symbol}"
            lines.append(f"{name}: {who} applies {applied}")
        return lines

    def _path_report(self) -> list[str]:
        shown = display(self._unit_over)
        values = self.values / shown.divisor
        of = f"{self.over} from {values[0]:.6g} to {values[-1]:.6g}{_space(shown.symbol)}"
        lines = [f"{len(values)} points over {of}"]
        for what, places in (("fold", self.fold_points), ("crossing", self.branch_points)):
            for place in places[:_MOST]:
                at = ", ".join(self._where(place))
                value = f"{values[place]:.10g}{_space(shown.symbol)}"
                lines.append(f"{what} at {self.over} = {value}: {at}")
        changes = np.flatnonzero(np.diff(np.asarray(self.stable, dtype=int)))
        kind = "stable" if np.all(self.stable) else "not stable"
        mixed = f"{int(np.sum(self.stable))} points are stable"
        lines += [mixed if len(changes) else f"all points are {kind}", self.end]
        return lines

    def _where(self, place: int) -> list[str]:
        state, found = self.states[place], []
        for name in self.coordinates[:4]:
            shown = display(self._units[name], "deg" if self._units[name] == "rad" else None)
            found.append(f"{name} = {float(state[name]) / shown.divisor:.8g}{_space(shown.symbol)}")
        return found

    def tables(self) -> Mapping[str, Sequence[Column]]:
        """``equilibrium.csv``: positions, stability, eigenvalues and efforts of each point."""
        model = self.state.compiled
        units = model.column_units()
        q = np.array([state.q for state in self.states])
        columns = [] if self.over is None else [column(self.over, self._unit_over, self.values)]
        columns += [
            column(name, unit, q[:, k])
            for k, (name, unit) in enumerate(zip(model.column_names(), units, strict=True))
        ]
        stable = np.atleast_1d(np.asarray(self.stable, dtype=float))
        columns.append(Column("stable", "", stable))
        rows = np.atleast_2d(self.eigenvalues)
        columns += [
            Column(f"eigenvalue_{k + 1}", "", rows[:, k]) for k in range(len(self.coordinates))
        ]
        columns += [
            column(f"{name}.effort", self.unit_of_effort(name), np.atleast_1d(values))
            for name, values in self.effort.items()
        ]
        return {"equilibrium": columns}

    def __repr__(self) -> str:
        title = self.state.compiled.title
        if self.over is None:
            kind = "stable" if self.stable else "not stable"
            return f"<EquilibriumResult of {title!r}: {kind}>"
        count, folds = len(self.values), len(self.folds)
        return f"<EquilibriumResult of {title!r}: {count} points over {self.over}, {folds} folds>"


def _state(model: CompiledModel, t: float, point: Mapping[str, Any]) -> State:
    """A state whose multipliers are those of statics; its accelerations are zero."""
    q = np.array(point["q"], dtype=float)
    state = State(model, t, q, np.zeros(len(q)), z=np.array(point["z"], dtype=float))
    lam = np.zeros(model.n_multipliers)
    lam[: len(point["lam"])] = point["lam"]
    vars(state)["_dynamics"] = fixed(np.zeros(len(q))), fixed(lam)
    return state


def _per(unit: str) -> str:
    return "N·m/rad" if unit == "rad" else "N/m"


def _space(symbol: str) -> str:
    return symbol if symbol in ("°", "") else f" {symbol}"
