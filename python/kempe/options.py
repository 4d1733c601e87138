"""How to simulate: integrators, stabilizations and the simulation itself, as data.

The core checks the numbers, so that a file and a program are refused in the same words.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from kempe.errors import ModelError
from kempe.names import one_of
from kempe.values import Number, number, reference


@dataclass(frozen=True)
class Option:
    """A choice with numbers, ``{ type = "rk45", rtol = 1e-6 }`` in a file."""

    kind: ClassVar[str]

    def tree(self, path: str) -> dict[str, Any]:
        """The choice as in a file; what is None is left out.

        Args:
            path: where it stands, for messages.
        """
        given = vars(self)  # its fields, in order
        checked = {k: number(v, f"{path}.{k}") for k, v in given.items() if v is not None}
        return {"type": self.kind, **checked}


@dataclass(frozen=True)
class RK45(Option):
    """Explicit Runge-Kutta of order 5 with an error estimate of order 4 (Dormand & Prince 1980).

    Attributes:
        rtol: tolerance relative to each component.
        atol: absolute tolerance, m or rad and per s.
        step: constant step, s, whatever the tolerances say; controlled when None.
        first_step: length of the first step, s; chosen when None.
        max_step: longest step, s; none when None.
    """

    rtol: Number = 1e-6
    atol: Number = 1e-9
    step: Number | None = None
    first_step: Number | None = None
    max_step: Number | None = None
    kind: ClassVar[str] = "rk45"


@dataclass(frozen=True)
class DOP853(Option):
    """Explicit Runge-Kutta of order 8 with error estimates of order 5 and 3 (Hairer et al. 1993).

    For tight tolerances and forces that are smooth; between the steps it interpolates with
    order 8, at the start and where steps differ much with 7.

    Attributes:
        rtol: tolerance relative to each component.
        atol: absolute tolerance, m or rad and per s.
        step: constant step, s, whatever the tolerances say; controlled when None.
        first_step: length of the first step, s; chosen when None.
        max_step: longest step, s; none when None.
    """

    rtol: Number = 1e-6
    atol: Number = 1e-9
    step: Number | None = None
    first_step: Number | None = None
    max_step: Number | None = None
    kind: ClassVar[str] = "dop853"


@dataclass(frozen=True)
class Auto(Option):
    """DOP853, and Radau where the equations prove stiff.

    The model is judged at the start, by the fastest damped motion of its linearised equations
    beside the pace of what moves: if that motion is far faster and has died out, Radau begins,
    else DOP853. Where a damped motion holds its steps at the limit of stability, Radau goes on;
    where that does not make them longer, DOP853 takes over again.
    ``sol.statistics["method"]`` tells which came to the end, and ``sol.statistics["why"]`` why.

    Attributes:
        rtol: tolerance relative to each component.
        atol: absolute tolerance, m or rad and per s.
        first_step: length of the first step, s; chosen when None.
        max_step: longest step, s; none when None.
    """

    rtol: Number = 1e-8
    atol: Number = 1e-11
    first_step: Number | None = None
    max_step: Number | None = None
    kind: ClassVar[str] = "auto"


@dataclass(frozen=True)
class RK4(Option):
    """Explicit Runge-Kutta of order 4 with a constant step.

    Attributes:
        step: length of a step, s.
    """

    step: Number
    kind: ClassVar[str] = "rk4"


@dataclass(frozen=True)
class GeneralizedAlpha(Option):
    """Implicit generalized-α of order 2 (Chung & Hulbert 1993) at index 3 (Arnold & Brüls 2007).

    For stiff forces and moderate accuracy. The constraints are among its equations, so that Φ = 0
    holds at every step; velocities are put onto them by the default stabilization, projection.
    Between the steps a cubic polynomial.

    Attributes:
        rho: spectral radius at infinite frequency, in [0, 1); the smaller, the more high
            frequencies are damped.
        rtol: tolerance of a step relative to each component, 1e-4 when None. With ``step`` that of
            Newton's iteration, 1e-10 when None.
        atol: absolute tolerance of a step, m or rad and per s, 1e-7 when None. With ``step`` that
            of Newton's iteration, 1e-12 when None.
        step: constant length of a step, s, without control of the error; chosen steps when None.
        first_step: length of the first step, s; chosen when None.
        max_step: longest step, s; none when None.
    """

    rho: Number = 0.8
    rtol: Number | None = None
    atol: Number | None = None
    step: Number | None = None
    first_step: Number | None = None
    max_step: Number | None = None
    kind: ClassVar[str] = "generalized_alpha"


@dataclass(frozen=True)
class HHT(Option):
    """Implicit method of Hilber, Hughes & Taylor (1977): a case of generalized-α, at index 3.

    Attributes:
        alpha: in [-1/3, 0); the smaller, the more high frequencies are damped.
        rtol: as of ``GeneralizedAlpha``.
        atol: as of ``GeneralizedAlpha``.
        step: constant length of a step, s, without control of the error; chosen steps when None.
        first_step: length of the first step, s; chosen when None.
        max_step: longest step, s; none when None.
    """

    alpha: Number = -0.1
    rtol: Number | None = None
    atol: Number | None = None
    step: Number | None = None
    first_step: Number | None = None
    max_step: Number | None = None
    kind: ClassVar[str] = "hht"


@dataclass(frozen=True)
class Radau(Option):
    """Implicit Radau IIA of order 5 (Hairer & Wanner 1996) at index 2, for stiff forces.

    The velocities meet their constraints at every stage; positions are put onto theirs by
    the default stabilization, projection. Between the steps it interpolates with order 4 for q and
    3 for v.

    Attributes:
        rtol: tolerance of a step relative to each component, 1e-6 when None. With ``step`` that of
            Newton's iteration, 1e-10 when None.
        atol: absolute tolerance of a step, m or rad and per s, 1e-9 when None. With ``step`` that
            of Newton's iteration, 1e-12 when None.
        step: constant length of a step, s, without control of the error; chosen steps when None.
        first_step: length of the first step, s; chosen when None.
        max_step: longest step, s; none when None.
    """

    rtol: Number | None = None
    atol: Number | None = None
    step: Number | None = None
    first_step: Number | None = None
    max_step: Number | None = None
    kind: ClassVar[str] = "radau"


@dataclass(frozen=True)
class Baumgarte(Option):
    """γ̂ = γ - 2α (Φ_q q̇ + Φ_t) - β² Φ (Baumgarte 1972; Haug 7.3.8).

    For explicit methods. ``Baumgarte(gains="step")`` needs no numbers: it takes them from each
    step h that is tried, α = 7/(12 h) and β = 1/(√3 h), and holds the term over the step, so that
    it neither limits the step nor lowers the order of the method.

    Attributes:
        alpha: 1/s; 10 when None.
        beta: 1/s; stability limits the step to about 3/β; 200 when None.
        gains: "step" for gains from the step, without alpha and beta.
    """

    alpha: Number | None = None
    beta: Number | None = None
    gains: str | None = None
    kind: ClassVar[str] = "baumgarte"


@dataclass(frozen=True)
class Projection(Option):
    """Every accepted state is put back onto Φ(q, t) = 0 and Φ_q q̇ + Φ_t = 0 (Eich 1993).

    The nearest state in the metric of the mass matrix is taken. The start and all reported states
    are projected too, and a, λ belong to the reported state; ``sol(t)`` is the integrator's
    interpolant, which leaves the constraints between the steps by the error of the integration.
    What projection does to the energy is booked nowhere: it shows in the balance.

    Attributes:
        tolerance: what is left of the constraints, relative to the size of the mechanism; of angles
            in rad.
    """

    tolerance: Number = 1e-12
    kind: ClassVar[str] = "projection"


@dataclass(frozen=True)
class NoStabilization(Option):
    """γ as it is: the constraints drift with the error of the integration."""

    kind: ClassVar[str] = "none"


@dataclass(frozen=True)
class Dynamics:
    """A simulation, as an entry of ``[analyses]``.

    Attributes:
        t_end: time at which it ends, s.
        output_step: time between outputs, s; every step when None.
        method: the integrator.
        stabilization: of the constraints; none at all when None.
        max_steps: it gives up after that many steps; 1 000 000 over the number
            of moving bodies when None, at least 50 000. So it does after half as many
            rejected ones, if they are over 10 000.
        dense_output: whether to keep the interpolant between the steps.
        name: its name in the case.
        after: where it starts: "start", or the name of an earlier analysis; where the one before
            it ended when None.
        t_start: time at which it starts, s; that of the state it starts from when None.
        singularity: at a singular position where the motion does not decide how it goes on:
            "stop" with a SingularityError, or "pass" on.
    """

    t_end: Number
    output_step: Number | None = None
    method: Option = Auto()
    stabilization: Option | None = Projection()
    max_steps: int | None = None
    dense_output: bool = True
    name: str = "dynamics"
    after: str | None = None
    t_start: Number | None = None
    singularity: str = "stop"

    def tree(self) -> dict[str, Any]:
        """The entry as in a file.

        Raises:
            ModelError: a value is not what its field wants.
        """
        path = f"analyses.{reference(self.name, 'name of an analysis')}"
        entry: dict[str, Any] = {"type": "dynamics"}
        if self.after is not None:
            entry["from"] = reference(self.after, f"{path}.from")
        entry["t_end"] = number(self.t_end, f"{path}.t_end")
        for field in ("t_start", "output_step", "max_steps"):
            if getattr(self, field) is not None:
                entry[field] = number(getattr(self, field), f"{path}.{field}")
        entry["method"] = _option(self.method, f"{path}.method")
        chosen = NoStabilization() if self.stabilization is None else self.stabilization
        entry["stabilization"] = _option(chosen, f"{path}.stabilization")
        if one_of(f"{path}.singularity", self.singularity, ("stop", "pass")) == "pass":
            entry["singularity"] = "pass"
        entry["dense_output"] = bool(self.dense_output)
        return entry


def _option(value: object, path: str) -> dict[str, Any]:
    if not isinstance(value, Option):
        example = "kp.RK45(rtol=1e-6)" if path.endswith("method") else "kp.Projection()"
        raise ModelError(f"{path}: {value!r}", hint=f"pass an object such as {example}")
    return value.tree(path)


def core_options(entry: Mapping[str, Any]) -> dict[str, Any]:
    """The part of an entry that the core wants: all but where it starts."""
    return {key: value for key, value in entry.items() if key != "from"}
