"""Pin loads: the force of each joint on its bodies over a motion, in the frame of the body.

In the frame of a body the force shows where and by how much a pin or bearing is loaded. The load
cases are the instants at which the magnitude or a component of the force is extreme.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType

import numpy as np

from kempe.base import files
from kempe.base.arrays import Floats, fixed
from kempe.base.names import one_of
from kempe.design.free_body import FreeBody, free_body
from kempe.design.locate import instants, interpolated, limits
from kempe.errors import ModelError
from kempe.results.extrema import Extreme
from kempe.results.motion import Motion
from kempe.results.remarks import remark, unbounded_at
from kempe.results.solution import Solution
from kempe.results.table import Column, column, remarked, write_columns
from kempe.results.variable import Variable
from kempe.results.views.frames import checked_body

#: The extreme cases of a joint on a body.
CASES = ("max", "x_max", "x_min", "y_max", "y_min")


@dataclass(frozen=True, repr=False)
class PinLoad:
    """The force of a joint on a body over a motion, in the frame of the body.

    Attributes:
        joint: the joint or driver.
        on: the body.
        variable: the quantity in ``t``.
        t: instants close enough for a smooth curve, (n,), s.
        force: (n, 2), N, in the axes of the body.
        moment: moment about the joint point, (n,), N·m.
        extremes: the extreme values with their instants, found on the interpolant: "max" of the
            magnitude, "x_max", "x_min", "y_max" and "y_min" of the components. They exclude values
            beside singular positions that have no bound.
        choice: which of the possible forces is given; empty if it is unique.
        unbounded_at: times of singular positions beside which the force has no bound.
    """

    joint: str
    on: str
    variable: Variable
    t: Floats
    force: Floats
    moment: Floats
    extremes: Mapping[str, Extreme]
    choice: str
    unbounded_at: tuple[float, ...]

    @property
    def unique(self) -> bool:
        """Whether the force is unique."""
        return not self.choice

    @property
    def magnitude(self) -> Floats:
        """Magnitude of the force, (n,), N."""
        return fixed(np.hypot(*self.force.T))

    @property
    def direction(self) -> Floats:
        """Angle of the force in the frame of the body, from -π to π, (n,), rad."""
        return fixed(np.arctan2(self.force[:, 1], self.force[:, 0]))

    def __repr__(self) -> str:
        told = remark(self.choice, times=self.unbounded_at, variable=self.variable)
        largest = f"up to {self.extremes['max'].value:.6g} N"
        return f"<PinLoad of {self.joint} on {self.on}: {largest}{told}>"


def pin_load(solution: Solution, joint: str, on: str | None = None) -> PinLoad:
    """The force of a joint on a body over a motion, in the frame of the body.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        joint: the joint or driver.
        on: the body; body j when None.

    Raises:
        ModelError: there is no such joint, or the joint does not act on the body.
        SingularityError: the reaction of the joint is not unique.
    """
    info = interpolated(solution).constraint(joint).info
    body = checked_body(info, info.j if on is None else on)
    t = instants(solution)
    found = solution(t).constraint(joint)
    return PinLoad(
        joint,
        body,
        solution.variable,
        fixed(t),
        found.force(on=body, frame="body"),
        fixed(found.torque(on=body)),
        MappingProxyType(_extremes(solution, joint, body)),
        solution.constraint(joint).choice,
        unbounded_at(solution, joint, ["force"]),
    )


def _extremes(solution: Solution, joint: str, body: str) -> dict[str, Extreme]:
    reads: dict[str, Callable[[Motion], Floats]] = {
        "magnitude": partial(_component, joint, body, None),
        "x": partial(_component, joint, body, 0),
        "y": partial(_component, joint, body, 1),
    }
    poles = unbounded_at(solution, joint, ["force"])
    of = {name: limits(solution, read, poles) for name, read in reads.items()}
    return {
        "max": of["magnitude"].largest,
        "x_max": of["x"].largest,
        "x_min": of["x"].least,
        "y_max": of["y"].largest,
        "y_min": of["y"].least,
    }


def _component(joint: str, body: str, k: int | None, motion: Motion) -> Floats:
    force = motion.constraint(joint).force(on=body, frame="body")
    return np.hypot(*force.T) if k is None else np.asarray(force[:, k])


def pin_loads(solution: Solution) -> list[PinLoad]:
    """The loads of all joints on all their moving bodies; see ``pin_load``."""
    model = interpolated(solution).compiled
    return [
        pin_load(solution, joint, body)
        for joint, info in model.joints.items()
        for body in dict.fromkeys(info.bodies)
        if body in model.bodies
    ]


def pin_table(solution: Solution) -> list[Column]:
    """The forces of all joints in the frames of their bodies at the outputs, as columns.

    The first column is the time or the driven quantity; the others have names of quantities, such
    as ``A.body_fx_on_rod``, and display units. Columns have the remarks of the table of a solution.
    """
    model, of = solution.compiled, solution.variable
    found = [column(of.name, of.unit, solution.t)]
    for joint, info in model.joints.items():
        for body in dict.fromkeys(info.bodies):
            if body in model.bodies:
                view = solution.constraint(joint)
                force = view.force(on=body, frame="body")
                moment = np.asarray(view.torque(on=body))
                found += [
                    remarked(solution, f"{joint}.body_fx_on_{body}", "N", force[:, 0]),
                    remarked(solution, f"{joint}.body_fy_on_{body}", "N", force[:, 1]),
                    remarked(solution, f"{joint}.torque_on_{body}", "N*m", moment),
                ]
    return found


def write_pin_loads(solution: Solution, path: Path | str) -> None:
    """Write the table of pin loads as CSV; see ``pin_table``.

    Raises:
        FileError: the file cannot be written; an existing file is not changed.
    """
    write_columns(pin_table(solution), path)


def load_cases(solution: Solution, body: str, joint: str | None = None) -> list[FreeBody]:
    """The extreme cases of the joints of a body, each with all loads on the body.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        body: a moving body.
        joint: a joint of the body; all of its joints when None.

    Returns:
        For each joint the load cases "JOINT_max", "JOINT_x_max", "JOINT_x_min", "JOINT_y_max" and
        "JOINT_y_min".

    Raises:
        ModelError: there is no such body or joint.
        SingularityError: reactions are not unique.
    """
    model = interpolated(solution).compiled
    if not model.body(body).number:
        raise ModelError(f"{body} does not move", name=body, hint="name a moving body")
    own = [name for name, info in model.joints.items() if body in info.bodies]
    names = own if joint is None else [one_of(f"joint of {body}", joint, own)]
    return [
        free_body(solution, body, extreme.t, name=f"{name}_{case}")
        for name in names
        for case, extreme in pin_load(solution, name, body).extremes.items()
    ]


def export_load_cases(
    solution: Solution, folder: Path | str, bodies: list[str] | None = None
) -> list[Path]:
    """Write the load cases of bodies for finite elements, one CSV file for each body and case.

    Each file is in balance with the inertia loads to 1e-9 of its largest load; this is checked.

    Args:
        solution: a motion of ``inverse_dynamics`` or ``dynamics``.
        folder: the folder, created if missing; the files are ``BODY/CASE.csv``.
        bodies: the bodies; all moving bodies when None.

    Raises:
        ModelError: there is no such body, or a load case is not in balance.
        FileError: a file cannot be written.
    """
    into, taken = files.checked_path(folder, "write"), set[Path]()
    return [_written(into, case, taken) for case in _all_cases(solution, bodies)]


def _all_cases(solution: Solution, bodies: list[str] | None) -> Iterator[FreeBody]:
    for body in solution.compiled.bodies if bodies is None else dict.fromkeys(bodies):
        yield from load_cases(solution, body)


def _written(into: Path, case: FreeBody, taken: set[Path]) -> Path:
    """Write a file whose name is like those of the case, and not that of another case."""
    folder, name, k = into / _plain(case.body), _plain(case.name), 1
    path = folder / f"{name}.csv"
    # some systems do not distinguish upper and lower case
    while (plain := Path(str(path).lower())) in taken:
        k += 1
        path = folder / f"{name}_{k}.csv"
    taken.add(plain)
    case.to_csv(path)
    return path


def _plain(name: str) -> str:
    """A name that can be the name of a file."""
    return "".join(c if c.isalnum() or c in "-_" else "_" for c in name)
