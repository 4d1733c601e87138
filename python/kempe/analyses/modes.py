"""Linear equations of small motions about a state: frequencies, damping, shapes, state space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from kempe.analyses.eigenmodes import Complexes, vectors_of
from kempe.analyses.mode_shape import ModeShape
from kempe.analyses.options import Modes
from kempe.analyses.record import Record, check, run_analysis
from kempe.base.arguments import explained
from kempe.base.arrays import Floats, fixed
from kempe.base.exports import identifiers, needed, write_mat
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.model import Model, compiled_model
from kempe.results.result import Result
from kempe.results.state import State
from kempe.results.table import Column

#: Largest number of modes that a report lists.
MOST_LISTED = 20


class ModesResult(Result):
    """Small motions about a state, from the linear equations on independent coordinates u.

    The equations are M ü + C u̇ + K u = 0. With inputs w, outputs y and first-order states z of
    forces, they are ẋ = A x + B w and y = C x + D w with x = (u, u̇, z). All variables are
    differences from the state. The derivatives are exact and include the curvature of the
    constraints; drivers hold their coordinates.

    Attributes:
        state: the state.
        coordinates: names of the independent coordinates, (f).
        locked: names of friction elements that lock their joints, with ``lock_friction``.
        state_names: names of the components of x, (n): coordinates, their rates, z.
        inputs, outputs: names of the components of w and y.
        mass_matrix, damping_matrix, stiffness_matrix: M, C and K of the independent coordinates,
            (f, f).
        A, B, C, D: matrices of the state space; (n, n), (n, inputs), (outputs, n) and (outputs,
            inputs).
        values: values of the outputs at the state.
        rates, acceleration: rates and accelerations of the independent coordinates at the state,
            (f); zero at an equilibrium.
        basis: motion of all coordinates with each independent coordinate, (f, n_q).
        eigenvalues: (n_modes,), 1/s, ascending by magnitude. Of two conjugate eigenvalues, only the
            one with the positive imaginary part is listed; a real eigenvalue is a mode by itself.
        omega: |s| of each mode, rad/s.
        frequency: Im s / 2π of each mode, Hz; 0 for a real eigenvalue.
        damping: damping ratio -Re s / |s| of each mode; negative where it grows, 0 for s = 0.
        stable: whether all modes decay.
        is_equilibrium: whether the mechanism stays at the state: it neither moves nor accelerates.
            Rates and accelerations count as zero up to 1e-6 rad or m times the largest |s| or |s|².
        shapes: (n_modes, n_q): the change of all coordinates in each mode; the largest number of
            each mode is 1. Complex, because the coordinates of a damped mode have phases.
    """

    kind: ClassVar[str] = "modes"

    def __init__(self, record: Record) -> None:
        findings, found = record.findings, record.numbers
        self.state = state = record.at_start
        self.inputs, self.outputs = tuple(findings["inputs"]), tuple(findings["outputs"])
        self.locked: tuple[str, ...] = tuple(findings["locked"])
        self.coordinates: tuple[str, ...] = tuple(findings["coordinates"])
        model, columns = state.compiled, findings["columns"]
        rates, own = model.rate_names(), model.state_names()
        self.state_names = (
            *self.coordinates,
            *(rates[column] for column in columns),
            *(own[place] for place in findings["states"]),
        )
        self.mass_matrix, self.damping_matrix, self.stiffness_matrix = (
            fixed(found[name]) for name in ("mass", "damping", "stiffness")
        )
        self.A, self.B, self.C, self.D = (fixed(found[name]) for name in ("A", "B", "C", "D"))
        self.values, self.basis = fixed(found["values"].ravel()), fixed(found["basis"])
        self.rates, self.acceleration, self.frequency, self.omega, self.damping = (
            fixed(found[name].ravel())
            for name in ("rates", "acceleration", "frequency", "omega", "damping_ratio")
        )
        self.stable: bool = findings["stable"]
        self.is_equilibrium: bool = findings["is_equilibrium"]
        self._moves: bool = findings["moves"]
        self.eigenvalues: Complexes = found["eigenvalues"] @ np.array([1, 1j])
        matrices = self.mass_matrix, self.damping_matrix, self.stiffness_matrix, self.A
        self.shapes: Complexes = _scaled(vectors_of(self.eigenvalues, *matrices) @ self.basis)
        self.eigenvalues.flags.writeable = self.shapes.flags.writeable = False

    @property
    def final(self) -> State:
        """The state."""
        return self.state

    def shape(self, k: int, amplitude: float | None = None) -> ModeShape:
        """A mode as a motion that can be drawn and animated.

        Args:
            k: number of the mode, from 0.
            amplitude: largest change of an angle, rad, or of a position, as a fraction of the size
                of the mechanism; 0.15 when None.

        Raises:
            ModelError: there is no mode with this number.
        """
        if not -len(self.eigenvalues) <= k < len(self.eigenvalues):
            raise ModelError(f"mode {k}: there are {len(self.eigenvalues)} modes, from 0")
        return ModeShape(self.state, self.shapes[k], complex(self.eigenvalues[k]), k, amplitude)

    def transfer(self, s: complex) -> Complexes:
        """C (s I - A)⁻¹ B + D, (outputs, inputs)."""
        unit = np.eye(len(self.A))
        return np.asarray(
            self.C @ np.linalg.solve(s * unit - self.A, self.B) + self.D, dtype=np.complex128
        )

    def to_control(self) -> Any:
        """The state space as a ``StateSpace`` of python-control, with names such as ``crank_y``.

        A name of python-control contains no point, so ``crank.y`` is ``crank_y`` there.

        Raises:
            ModelError: python-control is not installed.
        """
        control = needed("control", "control", "to_control")
        groups = (self.inputs, self.outputs, self.state_names)
        inputs, outputs, states = (identifiers(names) for names in groups)
        matrices = (np.array(of) for of in (self.A, self.B, self.C, self.D))
        return control.ss(*matrices, inputs=inputs, outputs=outputs, states=states)

    def to_mat(self, path: Path | str) -> None:
        """Write the state space as a ``.mat`` file of MATLAB.

        It contains A, B, C, D, and the cell arrays ``inputs``, ``outputs`` and ``states``, so that
        ``ss(A, B, C, D)`` in MATLAB gives the system.

        Raises:
            ModelError: SciPy is not installed.
            FileError: the file cannot be written; an existing file is not changed.
        """
        texts = {"inputs": self.inputs, "outputs": self.outputs, "states": self.state_names}
        matrices = {name: getattr(self, name) for name in ("A", "B", "C", "D")}
        write_mat(path, (), matrices | texts)

    def summary(self) -> dict[str, Any]:
        """The result as plain data."""
        modes = [
            {
                "eigenvalue": [float(s.real), float(s.imag)],
                "omega": float(self.omega[k]),
                "frequency": float(self.frequency[k]),
                "damping": float(self.damping[k]),
            }
            for k, s in enumerate(self.eigenvalues)
        ]
        matrices = {name: getattr(self, name).tolist() for name in ("A", "B", "C", "D")}
        return {
            "type": self.kind,
            "t": self.state.t,
            "equilibrium": self.is_equilibrium,
            "stable": self.stable,
            "coordinates": list(self.coordinates),
            "states": list(self.state_names),
            "inputs": list(self.inputs),
            "outputs": list(self.outputs),
            "modes": modes,
            **matrices,
        }

    def report(self) -> list[str]:
        """The modes in lines."""
        count = len(self.coordinates)
        many = f"{count} independent coordinate{'s' * (count != 1)}"
        locked = [f"locked by friction: {_few(self.locked)}"] if self.locked else []
        if not len(self.A):
            return [
                "no independent coordinate: joints and drivers hold all coordinates",
                *locked,
            ]
        lines = [f"{many}: {_few(self.coordinates)}", *locked]
        if not self.is_equilibrium:
            lines.append(self._off_balance())
        lines += [self._line(k) for k in range(min(len(self.eigenvalues), MOST_LISTED))]
        if len(self.eigenvalues) > MOST_LISTED:
            lines.append(f"and {len(self.eigenvalues) - MOST_LISTED} more modes")
        return lines

    def _off_balance(self) -> str:
        if self._moves:
            return "the mechanism moves at this state: the modes hold for a short time"
        worst = int(np.abs(self.acceleration).argmax())
        unit = "rad/s²" if self.coordinates[worst].endswith("angle") else "m/s²"
        size = f"{self.acceleration[worst]:.3g} {unit}"
        return f"no equilibrium: {self.coordinates[worst]} accelerates with {size}"

    def _line(self, k: int) -> str:
        s, about = self.eigenvalues[k], f"mode {k + 1}:"
        if s.imag > 0.0:
            return (
                f"{about} {self.frequency[k]:.6g} Hz, ω = {self.omega[k]:.6g} rad/s, "
                f"damping ratio {self.damping[k]:.4g}"
            )
        if s.real == 0.0:
            return f"{about} s = 0: it moves freely"
        way = "decays" if s.real < 0.0 else "grows"
        return f"{about} {way} with s = {s.real:.6g} 1/s"

    def tables(self) -> Mapping[str, Sequence[Column]]:
        """The modes with their shapes, and the matrices of the state space."""
        s = self.eigenvalues
        numbers = (
            ("mode", "", np.arange(1.0, len(s) + 1.0)),
            ("real", "1/s", s.real),
            ("imaginary", "1/s", s.imag),
            ("frequency", "Hz", self.frequency),
            ("damping", "", self.damping),
        )
        names = self.state.compiled.column_names()
        parts = (("", self.shapes.real), (".imaginary", self.shapes.imag))
        shapes = [
            Column(f"{name}{part}", "", numbers[:, k])
            for part, numbers in parts
            if np.any(numbers)
            for k, name in enumerate(names)
        ]
        found = {"modes": [*(Column(*each) for each in numbers), *shapes]}
        for name, columns in (("A", self.state_names), ("B", self.inputs)):
            found[name] = _matrix(getattr(self, name), columns)
        if self.outputs:
            found["C"] = _matrix(self.C, self.state_names)
            found["D"] = _matrix(self.D, self.inputs)
        return {name: columns for name, columns in found.items() if columns}

    def __repr__(self) -> str:
        count = len(self.eigenvalues)
        return f"<ModesResult: {count} mode{'s' * (count != 1)} at t = {self.state.t:g} s>"


@explained
def modes(
    model: Model | CompiledModel,
    state: State,
    *,
    n: int | None = None,
    inputs: Sequence[str] = (),
    outputs: Sequence[str] = (),
    lock_friction: bool = False,
    rotating: bool = False,
) -> ModesResult:
    """Frequencies, damping and shapes of small motions about a state, and its state space.

    The state may be an equilibrium, any other position, or a state of a motion such as
    ``sol(0.5)``. The equations have constant coefficients, also if it is not an equilibrium.

    Args:
        model: the mechanism.
        state: a state that satisfies the constraints.
        n: number of modes, the slowest first; all when None.
        inputs: parameters of forces, or position quantities such as ``"crank.angle"``, whose input
            is their generalized force.
        outputs: any quantities, such as ``"rocker.angle"`` or ``"C.fx"``.

        lock_friction: whether friction that sticks at the state locks its joint; otherwise small
            motions slide.
        rotating: whether small motions are those in a frame that rotates with the mechanism, as for
            a blade at speed. All bodies rotate about one point of ground with the same constant
            rate, and there is no gravity.

    Raises:
        SingularityError: the position is singular, no mass moves with a coordinate, or the motion
            of a massless body is not determined.
        AssemblyError: the state does not satisfy the constraints.
        ModelError: an unknown input or output, or a parameter that changes the geometry.
    """
    entry = Modes(n, inputs, outputs, lock_friction, rotating).tree()
    compiled = compiled_model(model)
    check(compiled, state, "state")
    return ModesResult(run_analysis(compiled, state, entry))


def _scaled(shapes: Complexes) -> Complexes:
    """Each shape divided by its largest number."""
    if not shapes.size:
        return np.zeros_like(shapes)
    largest = np.take_along_axis(shapes, np.abs(shapes).argmax(axis=1)[:, None], axis=1)
    # a mode of first-order states alone, such as a current, moves no coordinate
    found: Complexes = shapes / np.where(np.abs(largest) > 0.0, largest, 1.0) + 0.0
    return found


def _matrix(matrix: Floats, columns: Sequence[str]) -> list[Column]:
    return [Column(name, "", matrix[:, k]) for k, name in enumerate(columns)]


def _few(names: Sequence[str]) -> str:
    shown = ", ".join(names[:6])
    return f"{shown}, …" if len(names) > 6 else shown
