"""The demand on a drive over a motion: efforts, powers, work, and the flywheel that smooths it.

The work is ∫ P dt, the root mean square of the effort √(∫ T² dt / ∫ dt). For the flywheel, ΔE is
the range of the energy E(θ) = ∫ (T - T_m) dθ, where T_m is the mean of T over the cycle. A flywheel
of inertia J = ΔE / (C_s ω²) keeps the fluctuation of the speed at C_s = (ω_max - ω_min)/ω about its
mean ω (Norton, *Design of Machinery*, 11.11; Shigley and Uicker, *Theory of Machines and
Mechanisms*, ch. 18).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from kempe.base.arrays import Floats, fixed
from kempe.base.names import unknown
from kempe.design.locate import instants, integral, interpolated, limits, zeros
from kempe.design.transmission import rate_name
from kempe.errors import ModelError
from kempe.results.extrema import Extreme
from kempe.results.motion import Motion
from kempe.results.quantities import named
from kempe.results.remarks import choice_of, poles, remark
from kempe.results.solution import Solution
from kempe.results.variable import Variable

Read = Callable[[Motion], Floats]


@dataclass(frozen=True, repr=False)
class Duty:
    """The effort and power of a driver or motor over a motion.

    Attributes:
        name: the driver or force element.
        variable: the quantity in ``t``. In a motion over a driven quantity, the rate of this
            quantity is 1, and the powers refer to this rate.
        unit: unit of the effort, "N*m" or "N".
        t: instants close enough for a smooth curve, (n,), s.
        rate: rate of the coordinate of the driver or motor, (n,), rad/s or m/s.
        effort: (n,), N·m or N; positive if it increases the coordinate.
        power: effort × rate, (n,), W; negative where the drive brakes.
        peak: the effort of largest magnitude with its sign, and its instant.
        peak_power: the power of largest magnitude with its sign, and its instant.
        rms: root mean square of the effort over t.
        mean: mean of the effort over t.
        mean_power: mean of the power over t, W.
        work: work over the whole motion, J.
        driving_work, braking_work: the positive and the negative part of the work, J.
        choice: which of the possible efforts is given; empty if it is unique.
        unbounded_at: times of singular positions beside which the effort has no bound. The peaks
            exclude values there; means, root mean square and works do not.
    """

    name: str
    variable: Variable
    unit: str
    t: Floats
    rate: Floats
    effort: Floats
    power: Floats
    peak: Extreme
    peak_power: Extreme
    rms: float
    mean: float
    mean_power: float
    work: float
    driving_work: float
    braking_work: float
    choice: str
    unbounded_at: tuple[float, ...]

    @property
    def unique(self) -> bool:
        """Whether the effort is unique."""
        return not self.choice

    @property
    def points(self) -> Floats:
        """Speed and effort at each instant, (n, 2), as in the diagrams of motor catalogues."""
        return fixed(np.column_stack([self.rate, self.effort]))

    @property
    def quadrants(self) -> tuple[int, ...]:
        """The quadrants of speed and effort that occur, 1 to 4; 2 and 4 brake."""
        rate, effort = self.rate, self.effort
        noise = [1e-9 * float(np.abs(values).max(initial=0.0)) for values in (rate, effort)]
        signs = ((1, 1), (-1, 1), (-1, -1), (1, -1))
        return tuple(
            k
            for k, (x, y) in enumerate(signs, 1)
            if np.any((x * rate > noise[0]) & (y * effort > noise[1]))
        )

    def __repr__(self) -> str:
        unit = self.unit.replace("*", "·")
        told = f"peak {self.peak.value:.6g} {unit}, rms {self.rms:.6g} {unit}"
        beside = remark(self.choice, times=self.unbounded_at, variable=self.variable)
        return f"<Duty of {self.name}: {told}, work {self.work:.6g} J{beside}>"


def duty(solution: Solution, name: str) -> Duty:
    """Efforts, powers and work of a driver, or of a motor, actuator or torque.

    Args:
        solution: the motion, such as one cycle, of ``inverse_dynamics`` or ``dynamics``.
        name: a driver, or a force element that measures the coordinate on which it acts.

    Raises:
        ModelError: there is no such driver or element, or the element has no effort and rate.
    """
    names = _names(interpolated(solution), name)
    effort, rate, unit = _reads(solution, names)

    def power(motion: Motion) -> Floats:
        return np.asarray(effort(motion) * rate(motion))

    t = instants(solution)
    found, passed = solution(t), tuple(poles(solution, effort))
    turns = [float(t[0]), *_inner(zeros(solution, power), t), float(t[-1])]
    works = integral(solution, power, turns)
    ends = [float(t[0]), float(t[-1])]
    span = ends[1] - ends[0]
    square = float(integral(solution, lambda motion: effort(motion) ** 2, ends)[0])
    return Duty(
        name,
        solution.variable,
        unit,
        fixed(t),
        fixed(rate(found)),
        fixed(effort(found)),
        fixed(power(found)),
        _peak(solution, effort, passed),
        _peak(solution, power, passed),
        float(np.sqrt(square / span)),
        float(integral(solution, effort, ends)[0]) / span,
        float(works.sum()) / span,
        float(works.sum()),
        float(works[works > 0.0].sum()),
        float(works[works < 0.0].sum()),
        choice_of(solution, names[0]),
        passed,
    )


def _inner(found: Floats, t: Floats) -> Floats:
    """The instants strictly within a motion."""
    low, high = sorted((float(t[0]), float(t[-1])))
    return found[(found > low) & (found < high)]


def _peak(solution: Solution, read: Read, passed: tuple[float, ...]) -> Extreme:
    both = limits(solution, read, passed)
    return max(both.largest, both.least, key=lambda extreme: abs(extreme.value))


def _names(solution: Solution, name: str) -> tuple[str, str]:
    """The quantities that are effort and rate of a driver or force element."""
    model = solution.compiled
    driver = model.tree.get("drivers", {}).get(name, {})
    if name in model.drivers and "coordinate" in driver:
        return f"{name}.effort", rate_name(model, driver["coordinate"])
    if name in model.forces and len(model.forces[name].measured) == 1:
        (of,) = model.forces[name].measured
        return f"{name}.{'torque' if of.unit == 'rad' else 'force'}", f"{name}.{of.names[1]}"
    if name in (*model.drivers, *model.forces):
        raise ModelError(
            f"{name} has no coordinate of its own, so that it has no single effort and rate",
            name=name,
            hint=f'its power is the quantity "{name}.power"',
        )
    raise unknown("driver or force element", name, [*model.drivers, *model.forces])


def _reads(solution: Solution, names: tuple[str, str]) -> tuple[Read, Read, str]:
    """Effort and rate as functions, and the unit of the effort."""
    unit = named(solution, names[0]).unit

    def effort(motion: Motion) -> Floats:
        return np.asarray(named(motion, names[0]).read(), dtype=np.float64)

    def rate(motion: Motion) -> Floats:
        return np.asarray(named(motion, names[1]).read(), dtype=np.float64)

    return effort, rate, unit


@dataclass(frozen=True, repr=False)
class Flywheel:
    """A flywheel for a given fluctuation of the speed.

    Attributes:
        inertia: its moment of inertia, kg·m².
        energy: ΔE, the energy that the flywheel must release and store, J.
        speed: mean speed, rad/s.
        fluctuation: C_s = (ω_max - ω_min)/ω.
        mean_torque: mean of the torque over the angle of the cycle, which the motor delivers, N·m.
        slowest, fastest: instants of the least and the largest speed, s, or values of the driven
            quantity.
        variable, t: the quantity in t, and instants close enough for a smooth curve, (n,).
        torque: torque on the shaft without a flywheel, (n,), N·m.
        stored: energy that the flywheel has stored since the first instant, (n,), J.
        choice: which of the possible torques is given; empty if it is unique.
    """

    inertia: float
    energy: float
    speed: float
    fluctuation: float
    mean_torque: float
    slowest: float
    fastest: float
    variable: Variable
    t: Floats
    torque: Floats
    stored: Floats
    choice: str

    @property
    def unique(self) -> bool:
        """Whether the torque is unique."""
        return not self.choice

    def __repr__(self) -> str:
        told = f"{self.inertia:.6g} kg·m² for ΔE = {self.energy:.6g} J"
        return f"<Flywheel: {told}{remark(self.choice)}>"


def flywheel(
    solution: Solution, driver: str, *, fluctuation: float, speed: float | None = None
) -> Flywheel:
    """The flywheel on the shaft of a driver that keeps the speed nearly constant.

    The motion is a cycle at constant speed, computed by ``inverse_dynamics``. The mechanism and its
    loads need the torque of the driver; a motor with the flywheel delivers the mean of this torque.
    The returned inertia does not include the inertia of the mechanism.

    Args:
        solution: one or more whole cycles.
        driver: the driver of the shaft.
        fluctuation: C_s = (ω_max - ω_min)/ω, such as 0.02.
        speed: mean speed ω, rad/s. When None, the mean speed of the solution, which must then be a
            motion over time.

    Raises:
        ModelError: the driver does not turn a shaft in one direction, the fluctuation is not
            between 0 and 1, or the speed is missing.
    """
    effort, rate, unit = _reads(solution, _names(interpolated(solution), driver))
    if unit != "N*m":
        raise ModelError(
            f"{driver} turns no shaft", name=driver, hint="name the driver of an angle"
        )
    if not 0.0 < fluctuation < 1.0:
        raise ModelError(
            f"fluctuation: {fluctuation!r} is not between 0 and 1", hint="write 0.02 for 2 %"
        )
    t = instants(solution)
    ends = [float(t[0]), float(t[-1])]
    found = solution(t)
    rates = rate(found)
    if rates.min() <= 0.0 <= rates.max():
        raise ModelError(f"{driver} does not turn in one direction all the time", name=driver)
    angle = float(integral(solution, rate, ends)[0])
    mean = float(integral(solution, lambda m: effort(m) * rate(m), ends)[0]) / angle
    omega = _speed(solution, angle, speed)

    def excess(motion: Motion) -> Floats:
        """Rate of the energy that the flywheel releases."""
        return np.asarray((effort(motion) - mean) * rate(motion))

    marks = np.array([ends[0], *_inner(zeros(solution, excess), t), ends[1]])
    given = np.concatenate([[0.0], np.cumsum(integral(solution, excess, [*marks]))])
    energy = float(np.ptp(given))
    return Flywheel(
        energy / (fluctuation * omega**2),
        energy,
        omega,
        fluctuation,
        mean,
        float(marks[given.argmax()]),
        float(marks[given.argmin()]),
        solution.variable,
        fixed(t),
        fixed(effort(found)),
        fixed(-_along(solution, excess, t)),
        choice_of(solution, _names(solution, driver)[0]),
    )


def _speed(solution: Solution, angle: float, speed: float | None) -> float:
    if speed is None and solution.variable.is_time:
        return abs(angle / float(solution.t[-1] - solution.t[0]))
    if speed is None or not 0.0 < speed < np.inf:
        raise ModelError(
            "speed: missing" if speed is None else f"speed: {speed!r} is not positive",
            hint="give the mean speed in rad/s; the solution is over a quantity, at rate 1",
        )
    return float(speed)


def _along(solution: Solution, read: Read, t: Floats) -> Floats:
    """An integral from the first to each instant."""
    nodes, weights = np.polynomial.legendre.leggauss(4)
    half = np.diff(t)[:, None] / 2.0
    times = t[:-1, None] + half + half * nodes
    pieces = (half * weights * np.asarray(read(solution(times.ravel()))).reshape(times.shape)).sum(
        1
    )
    return np.concatenate([[0.0], np.cumsum(pieces)])
