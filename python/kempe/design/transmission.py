"""Transmission of motion: transmission angle, velocity ratio, toggle positions.

The transmission angle μ at the joint of a coupler and an output link is the angle between their
lines (Alt, 1932; Norton, *Design of Machinery*, section 3.3). If the output is guided by a slide,
its line is the normal of the slide. 90° is best; textbooks recommend at least 40°.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats, fixed
from kempe.design.locate import Limits, instants, limits, zeros
from kempe.design.places import Place, is_pin, line_at, others_at, point_of
from kempe.errors import ModelError
from kempe.model.compiled import CompiledModel
from kempe.model.values import mapping
from kempe.results.extrema import Extreme
from kempe.results.motion import Motion
from kempe.results.quantities import named
from kempe.results.solution import Solution
from kempe.results.state import State
from kempe.results.variable import Variable

#: Links are in line if the sine of the angle between them is below this.
_IN_LINE = 1e-6
#: A rate below this fraction of the largest rate counts as zero.
_STILL = 1e-12


@dataclass(frozen=True, repr=False)
class TransmissionAngle:
    """The angle between two links at their joint, over a motion.

    Attributes:
        joint: the joint.
        variable: the quantity in ``t``.
        t: instants close enough for a smooth curve, (n,), s.
        angle: angle between the links, from 0 to π, (n,), rad.
        limits: the least and the largest ``angle``, found on the interpolant.
        worst: the least ``transmission``, with its instant.
    """

    joint: str
    variable: Variable
    t: Floats
    angle: Floats
    limits: Limits
    worst: Extreme

    @property
    def deviation(self) -> Floats:
        """Deviation of the angle from π/2, positive for larger angles, (n,), rad."""
        return fixed(self.angle - np.pi / 2.0)

    @property
    def transmission(self) -> Floats:
        """The acute angle between the lines, (n,), rad."""
        return fixed(np.pi / 2.0 - np.abs(self.deviation))

    def __repr__(self) -> str:
        least = np.degrees(self.worst.value)
        return f"<TransmissionAngle at {self.joint}: at least {least:.4g}°>"


def transmission_angle(
    solution: Solution, joint: str, *, lines: Mapping[str, Place] | None = None
) -> TransmissionAngle:
    """The transmission angle at a pin between a coupler and an output link.

    The line of a link goes from the joint to its other pin; if the link is guided by a slide, its
    line is the normal of the slide.

    Args:
        solution: the motion.
        joint: a revolute joint.
        lines: for a body with several other joints, a point on its line, such as
            ``{"coupler": "coupler.B"}``.

    Raises:
        ModelError: the joint is not a pin, or the line of a body is not unique.
    """
    info = solution.joint(joint).info
    if not is_pin(info):
        raise ModelError(
            f"{joint} is not a revolute joint", name=joint, hint="name a pin of two links"
        )
    given = mapping(lines, "lines", "{'coupler': 'coupler.B'}")
    for body in given:
        if body not in (info.i, info.j):
            raise ModelError(f"lines: {joint} does not connect {body}", name=body)
    read = partial(_angle, joint, given)
    t = instants(solution)
    return TransmissionAngle(
        joint,
        solution.variable,
        fixed(t),
        fixed(read(solution(t))),
        limits(solution, read),
        limits(solution, lambda motion: np.pi / 2.0 - np.abs(read(motion) - np.pi / 2.0)).least,
    )


def transmitting(model: CompiledModel) -> list[str]:
    """Pins at which another link moves a link that is guided by ground and has no driver."""
    return _core.transmitting(model.core)


def _angle(joint: str, lines: Mapping[str, Place], motion: Motion) -> Floats:
    """The angle between the lines of both bodies at a pin, from 0 to π."""
    info = motion.compiled.constraints[joint]
    a, b = (_line(motion, joint, body, lines.get(body)) for body in (info.i, info.j))
    cross = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return np.asarray(np.arctan2(np.abs(cross), (a * b).sum(axis=-1)))


def _line(motion: Motion, joint: str, body: str, place: Place | None) -> Floats:
    """The direction of a link from a pin, (…, 2)."""
    own = motion.body(body)
    if place is not None:
        here = motion.compiled.constraints[joint]
        at = here.point_i if here.i == body else here.point_j
        return point_of(motion, place).position - own.at(at).position
    turn = own.angle + line_at(motion.compiled, body, joint)
    return np.stack([np.cos(turn), np.sin(turn)], axis=-1)


def velocity_ratio(motion: Motion, output: str, input: str) -> Floats:  # noqa: A002
    """Rate of the output over rate of the input, (n_t,).

    For example, ``velocity_ratio(sol, "rocker.angle", "crank.angle")`` is dφ_rocker/dφ_crank. The
    ratio of a length and an angle is in m/rad.

    Args:
        motion: a solution, or the motion at some times.
        output: a position quantity or its rate, such as "slider.x" or "slider.vx".
        input: a position quantity or its rate.

    Returns:
        The ratio; ±∞ where only the rate of the input is zero.

    Raises:
        ModelError: there is no such quantity, or both rates are zero at an instant.
    """
    return _ratio(motion, output, input)


def mechanical_advantage(motion: Motion, output: str, input: str) -> Floats:  # noqa: A002
    """Effort at the output over effort at the input of a mechanism without losses, (n_t,).

    By the principle of virtual power, it equals the rate of the input over the rate of the output
    (Norton, *Design of Machinery*, section 6.5). It is negative if a positive effort at the input
    causes a negative effort at the output. At a toggle position it is ±∞.

    Args:
        motion: a solution, or the motion at some times.
        output: a position quantity or its rate, such as "slider.x".
        input: a position quantity or its rate.

    Raises:
        ModelError: there is no such quantity, or both rates are zero at an instant.
    """
    return _ratio(motion, input, output)


def _ratio(motion: Motion, over: str, under: str) -> Floats:
    numerator, denominator = _rate(motion, over), _rate(motion, under)
    still = [
        np.abs(rate) <= _STILL * float(np.abs(rate).max(initial=0.0))
        for rate in (numerator, denominator)
    ]
    both = np.atleast_1d(still[0] & still[1])
    if both.any():
        t = float(np.atleast_1d(motion.t)[int(both.argmax())])
        of = motion.variable
        raise ModelError(
            f"{over} and {under} both stand still at {of.name} = {t:g} {of.unit}",
            hint="compute the motion over the value of the input, with over= and range=",
        )
    with np.errstate(divide="ignore"):
        found: Floats = np.divide(numerator, np.where(still[1], 0.0, denominator))
    return fixed(found)


def _rate(motion: Motion, name: str) -> Floats:
    return np.asarray(named(motion, rate_name(motion.compiled, name)).read(), dtype=np.float64)


def rate_name(model: CompiledModel, name: str) -> str:
    """The rate of a position quantity, such as "crank.omega" of "crank.angle"; rates unchanged."""
    owner, _, quantity = name.rpartition(".")
    rates = {"x": "vx", "y": "vy", "angle": "omega"}
    element = model.constraints.get(owner) or model.forces.get(owner)
    for of in element.measured if element is not None else ():
        rates[of.names[0]] = of.names[1]
    if quantity in dict(element_coordinates(model, owner)):
        rates[quantity] = f"{quantity}_rate"
    return f"{owner}.{rates.get(quantity, quantity)}"


def element_coordinates(model: CompiledModel, name: str) -> tuple[tuple[str, str], ...]:
    """Names and units of the internal coordinates of a joint."""
    info = model.constraints.get(name)
    return () if info is None else info.coordinates


@dataclass(frozen=True, repr=False)
class Toggle:
    """An instant at which the rate of the output is zero: the mechanical advantage is unbounded.

    Attributes:
        t: the instant, s, or the value of the driven quantity.
        value: value of the output at this instant, m or rad.
        in_line: pairs of links that are in line, such as ``("crank", "coupler")``.
        state: the state of the mechanism at this instant.
    """

    t: float
    value: float
    in_line: tuple[tuple[str, str], ...]
    state: State

    def __repr__(self) -> str:
        links = "; ".join(" and ".join(pair) for pair in self.in_line)
        return f"<Toggle at {self.t:.10g}: {f'{links} in line' if links else 'output at rest'}>"


def toggles(solution: Solution, output: str) -> list[Toggle]:
    """The toggle positions of a mechanism: the instants at which the output reverses.

    Args:
        solution: the motion, over time or over the value of the input.
        output: a position quantity, such as "rocker.angle" or "slider.x".

    Raises:
        ModelError: there is no such quantity, or it is constant.
    """
    rate = rate_name(solution.compiled, output)
    motion = solution(instants(solution))
    size = float(np.abs(motion[rate]).max(initial=0.0))
    if size <= _STILL * float(np.abs(motion.v).max(initial=0.0)):
        raise ModelError(f"{output} does not move", name=output, hint="name a moving quantity")
    found = zeros(solution, lambda motion: motion[rate])
    states = [solution(float(t)) for t in found]
    return [
        Toggle(float(state.t), float(state[output]), _in_line(state), state)
        for state in states
        if isinstance(state, State)
    ]


def _in_line(state: State) -> tuple[tuple[str, str], ...]:
    """Pairs of links whose pins are on one line."""
    model, found = state.compiled, []
    for name, info in model.joints.items():
        links = (info.i, info.j)
        pinned = is_pin(info) and all(_is_link(model, body, name) for body in links)
        if pinned and abs(np.sin(float(_angle(name, {}, state)))) < _IN_LINE:
            found.append(links)
    return tuple(found)


def _is_link(model: CompiledModel, body: str, joint: str) -> bool:
    others = others_at(model, body, joint)
    return body in model.bodies and len(others) == 1 and is_pin(others[0])
