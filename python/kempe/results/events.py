"""Events of a run: events that were requested, and events that its joints declare.

The core locates requested events. The declared events are found here: the source file of an element
declares an event for a result that becomes negative. For example, a roller whose normal force
becomes negative has the event ``lift_off``, since the curve would have to pull the roller. The run
continues.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats, fixed
from kempe.base.names import Named
from kempe.errors import KempeError
from kempe.results.fine import fine

if TYPE_CHECKING:
    from kempe.results.motion import Motion
    from kempe.results.solution import Solution
    from kempe.results.state import State

#: A value counts as negative if its magnitude exceeds this fraction of the largest multiplier.
_NOISE = 1e-9
#: A bracket is divided until it is this short, s; and the largest number of divisions.
_SHORTEST, _ROUNDS = 1e-13, 60

Read = Callable[["Motion"], Floats]


class EventWarning(UserWarning):
    """A run had an event after which its result is no longer the motion of the real mechanism."""


@dataclass(frozen=True, repr=False)
class EventTimes:
    """The times of an event of a run.

    Attributes:
        name: its name, such as ``hit``, or joint and event, such as ``cam.lift_off``.
        t: its times, (n_events,), s.
    """

    name: str
    t: Floats
    _impulses: Floats
    _read: Callable[[], tuple[State, ...]]

    @cached_property
    def states(self) -> tuple[State, ...]:
        """The state at each time; at the impact of a contact, the state before the impact."""
        return self._read()

    def impulse(self, joint: str, *, on: str) -> Floats:
        """The impulse of a joint on a body at each time, (n_events, 2), N·s, global.

        It is zero for an event without an impact.

        Args:
            joint: a joint or driver, or a contact or stop.
            on: one of its bodies.

        Raises:
            ModelError: there is no such joint, or ``on`` is not one of its bodies.
        """
        found = np.zeros((len(self.t), 2))
        for k, (state, impulse) in enumerate(zip(self.states, self._impulses, strict=False)):
            rows = *state._rows(), None, np.atleast_2d(impulse)
            found[k] = _core.States(state.compiled.core, *rows).impulse(joint, on)[0, :2]
        return fixed(found)

    def __repr__(self) -> str:
        times = ", ".join(f"{t:g}" for t in self.t[:3])
        more = ", …" if len(self.t) > 3 else ""
        return f"<Event {self.name!r}: {f't = {times}{more} s' if len(self.t) else 'never'}>"


def events(solution: Solution) -> Mapping[str, EventTimes]:
    """All events of a run by name; an event that did not occur is empty.

    Times of results that become negative are found on the interpolant of the integrator. Without an
    interpolant, they are the outputs at which the value is negative for the first time.
    """
    found = {}
    for name, t, q, v, z, impulses in solution._run.events:
        if name in found:
            continue  # a further part of a contact, whose events are those of the first part
        read = partial(_states_before, solution, t, q, v, z)
        found[name] = EventTimes(name, fixed(t), fixed(impulses), read)
    for joint, info in solution.compiled.constraints.items():
        for (quantity, _), event in zip(info.results, info.events, strict=True):
            if event is not None:
                name = f"{joint}.{event}"
                times = _times(solution, partial(_result, joint, quantity))
                read = partial(_states, solution, times)
                none = np.zeros((len(times), solution.compiled.n_multipliers))
                found[name] = EventTimes(name, fixed(np.array(times)), fixed(none), read)
    return MappingProxyType(Named("event", found))


def warnings_of(solution: Solution) -> list[str]:
    """A warning for each event that a joint declares and that occurred."""
    found = []
    sought = {name for name, *_ in solution._run.events}
    for event in solution.events.values():
        if len(event.t) and event.name not in sought:
            count = "once" if len(event.t) == 1 else f"{len(event.t)} times"
            joint, _, kind = event.name.rpartition(".")
            found.append(
                f"{event.name}: {count}, first at t = {event.t[0]:.6g} s; from there the joint "
                f"{joint} holds bodies together that would separate "
                f"({kind.replace('_', ' ')}), and the run goes on; a contact with restitution in "
                f"place of the joint lets them separate and meet again"
            )
    return found


def beyond_limits(solution: Solution, entry: Mapping[str, Any]) -> list[str]:
    """A warning for each driver whose effort is beyond its limit in a prescribed motion."""
    found = []
    drivers = [info for info in solution.compiled.constraints.values() if info.is_limited]
    for name, info in ((info.name, info) for info in drivers):
        effort, limit = solution[f"{name}.effort"], solution[f"{name}.limit"]
        excess = np.abs(effort) - limit
        k = int(excess.argmax())
        if excess[k] > _NOISE * np.abs(effort).max():
            unit = "N" if info.equations[0][1] == "m" else "N·m"
            over, value = entry.get("over"), f"{solution.t[k]:.6g}"
            place = f"t = {value} s" if over is None else f"{over} = {value}"
            found.append(
                f"{name} needs {abs(effort[k]):.6g} {unit} at {place}, and its limit is "
                f"{limit[k]:.6g} {unit}; a run of dynamics shows the motion with the limit"
            )
    return found


def true_at_start(solution: Solution, entry: Mapping[str, Any]) -> list[str]:
    """A warning for each stop and release that had no effect because it was true at the start.

    Args:
        solution: the solution.
        entry: the options of its run.
    """
    stops = {"stop": entry.get("stop")} | {
        name: event["condition"]
        for name, event in entry.get("events", {}).items()
        if isinstance(event, Mapping) and event.get("stop")
    }
    effects = {name: ("stopped the run", text) for name, text in stops.items() if text}
    for name, driver in solution.compiled.tree.get("drivers", {}).items():
        if (text := driver.get("release")) and name not in solution.initial.compiled.released:
            effects[f"{name}.release"] = f"released {name}", text
    found = []
    for name, (effect, condition) in effects.items():
        if not len(solution.events[name].t) and _holds(solution.initial, condition):
            found.append(
                f"{name}: '{condition}' is true at the start, and it never {effect}: it counts "
                f"when it becomes true, so it has to become false first"
            )
    return found


def _holds(state: State, condition: str) -> bool:
    """Whether a comparison is true at a state; False for an expression."""
    expression, core = f"if({condition}, 1, 0)", state.compiled.core
    try:
        names, *_ = _core.measure(core, expression)
        values = np.array([[state[name] for name in names]], dtype=np.float64)
        found = _core.measure_values(core, expression, np.atleast_1d(state.t), values)
    except KempeError:
        return False
    return bool(found[0])


def _result(joint: str, quantity: str, motion: Motion) -> Floats:
    return np.atleast_1d(getattr(motion.constraint(joint), quantity))


def _states_before(solution: Solution, *rows: Floats) -> tuple[State, ...]:
    return tuple(solution._state_before(float(t), *of) for t, *of in zip(*rows, strict=True))


def _states(solution: Solution, times: list[float]) -> tuple[State, ...]:
    if solution.dense is not None:
        return tuple(solution(t) for t in times)  # type: ignore[misc]  # one time gives a State
    rows = [int(np.flatnonzero(solution.t == t)[0]) for t in times]
    return tuple(solution._state_of(k) for k in rows)


def _times(solution: Solution, read: Read) -> list[float]:
    """Times at which a value becomes negative; the first time if it is negative from the start."""
    try:
        motion = fine(solution)
        values = read(motion)
        noise = _NOISE * float(np.abs(motion.lam).max(initial=0.0))
    except KempeError:  # no unique multipliers
        return []
    negative = values < -noise
    first = np.flatnonzero(negative & ~np.concatenate([[False], negative[:-1]]))
    found = []
    for k in first:
        at = float(motion.t[k])
        # the last instant before with a value that is not negative
        before = np.flatnonzero(values[:k] >= 0.0)
        if motion is not solution and len(before):
            at = _crossing(solution, read, float(motion.t[before[-1]]), at)
        found.append(at + 0.0)  # no -0.0
    return found


def _crossing(solution: Solution, read: Read, low: float, high: float) -> float:
    """The time at which a value crosses zero, between one with a value ≥ 0 and one below.

    Regula falsi with halved weights (Illinois), so that the bracket shrinks from both sides.
    """

    def value(t: float) -> float:
        return float(read(solution(np.array([t])))[0])

    at_low, at_high, kept = value(low), value(high), 0
    for _ in range(_ROUNDS):
        if abs(high - low) <= _SHORTEST or at_low == at_high:
            break
        t = (low * at_high - high * at_low) / (at_high - at_low)
        now = value(t)
        if now >= 0.0:
            low, at_low = t, now
            at_high = at_high / 2.0 if kept > 0 else at_high
            kept = 1
        else:
            high, at_high = t, now
            at_low = at_low / 2.0 if kept < 0 else at_low
            kept = -1
        if now == 0.0:
            return t
    return high
