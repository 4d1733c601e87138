"""The scene: everything that a drawing of a motion needs, as plain data ready for JSON.

The player, the pictures and the videos draw only this; ``docs/scene.md`` describes the format.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from kempe.base.arguments import explained
from kempe.base.arrays import Floats
from kempe.base.display_units import chosen_for, display
from kempe.base.names import unknown
from kempe.draw import arrows, channels, sampling
from kempe.draw.ends import ends
from kempe.draw.numbers import plain, round_below, rounded
from kempe.errors import ModelError
from kempe.model.compiled import ACCELERATIONS, COORDINATES, RATES, CompiledModel
from kempe.model.drawing import static_scene
from kempe.model.values import instance, texts
from kempe.results.motion import Motion
from kempe.results.solution import Solution
from kempe.results.state import State
from kempe.results.variable import Variable

Scene: TypeAlias = dict[str, Any]

#: Version of the format.
FORMAT = 2
UNITS = {
    "time": "s",
    "length": "m",
    "angle": "rad",
    "velocity": "m/s",
    "angular_velocity": "rad/s",
    "acceleration": "m/s²",
    "angular_acceleration": "rad/s²",
    "force": "N",
    "torque": "N·m",
}
#: Points are computed from poses; after many turns, angles need more digits than other numbers.
_DIGITS_OF_POSES = 12
#: Length of the arrow of the largest reaction, as a fraction of the size of the drawing.
_LONGEST_ARROW = 0.3
#: Points whose distance is at most this fraction of the drawing are drawn as one.
_SAME_PLACE = 1e-3
#: Largest number of events that are marked.
_MOST_EVENTS = 200
#: Shortest and longest motion that is shown in real time, s.
_SHORTEST, _LONGEST = 2.0, 60.0


@explained
def scene(
    solution_or_state: Solution | State,
    *,
    frames: int | None = None,
    traces: Sequence[str] | None = None,
    span: sampling.Span | None = None,
) -> Scene:
    """Describe a motion, or one instant, for drawing.

    Args:
        solution_or_state: the motion or the state.
        frames: number of frames, evenly spaced; by default 60 for each second, at most 1200, and
            fewer for a mechanism with very many bodies.
        traces: points whose paths are drawn, such as ``["coupler.P"]``; by default every moving
            named point of a body. A point that several bodies share is drawn once.
        span: first and last time that are drawn, s; the whole motion by default.

    Returns:
        The scene; see ``docs/scene.md``. Numbers have nine significant digits.

    Raises:
        ModelError: a traced point or its body does not exist, ``frames`` is less than 1, or the
            span is not within the motion.
    """
    instance(solution_or_state, (Solution, State), "a solution or a state")
    model = solution_or_state.compiled
    undetermined = sampling.undetermined(solution_or_state)
    motion = sampling.sampled(solution_or_state, frames, channels.numbers_per_frame(model), span)
    poses = _of_bodies(motion, COORDINATES)
    static = static_scene(model, poses, arrows.efforts(motion))
    low, high = np.array(static["bounds"]).reshape(2, 2)
    size = float(max(high - low)) or 1.0
    paths = _traces(motion, size, traces)
    peaks = arrows.peaks(solution_or_state, motion, arrows.tracked(static["bodies"], paths))
    return {
        "scene": FORMAT,
        "units": {name: solution_or_state.variable.rate(unit) for name, unit in UNITS.items()},
        **static,
        "length": _chosen_length() or static["length"],
        "traces": paths,
        "variable": _variable(solution_or_state.variable),
        "frames": _frames(motion, poses, solved=not undetermined),
        "interpolation": sampling.interpolation(solution_or_state, motion, size),
        "accuracy": _short(sampling.accuracy(solution_or_state, motion)),
        "undetermined": undetermined,
        "events": _events(solution_or_state, motion),
        "playback": {"rate": playback_rate(float(motion.t[-1] - motion.t[0]))},
        "reaction_scale": _reaction_scale(peaks["reaction"], size),
        "largest": {kind: peak for kind, peak in peaks.items() if kind != "reaction"},
        "ends": ends(solution_or_state, motion),
        "channels": channels.channels(
            motion, sampling.energy(solution_or_state, motion), solved=not undetermined
        ),
        "choices": {n: motion.choices[n] for n in model.constraints if n in motion.choices},
    }


def _frames(motion: Motion, poses: Floats, *, solved: bool) -> dict[str, Any]:
    """Poses, rates, accelerations and forces of joints; without solved equations, no forces."""
    reactions = _reactions(motion)
    return {
        "t": plain(motion.t),
        "poses": plain(poses, _DIGITS_OF_POSES),
        "rates": plain(_of_bodies(motion, RATES)),
        "accelerations": plain(_of_bodies(motion, ACCELERATIONS)),
        "reactions": plain(reactions if solved else np.full_like(reactions, np.nan)),
    }


def _events(drawn: Solution | State, motion: Motion) -> list[dict[str, Any]]:
    """The events within the frames, in the order of time."""
    if isinstance(drawn, State):
        return []
    first, last = float(motion.t[0]), float(motion.t[-1])
    found = [
        (float(t), event.name)
        for event in drawn.events.values()
        for t in event.t
        if first <= t <= last
    ]
    return [{"name": name, "t": rounded(t)} for t, name in sorted(found)[:_MOST_EVENTS]]


def _variable(of: Variable) -> dict[str, Any]:
    """The quantity in ``t`` of the frames, and its unit in drawings."""
    shown = display(of.unit, "deg") if of.unit == "rad" else display(of.unit)
    return {
        "name": of.name,
        "unit": of.unit,
        "shown": shown.symbol,
        "divisor": shown.divisor,
        "condition": of.condition,
    }


def _short(share: float | None) -> float | None:
    return None if share is None or not math.isfinite(share) else float(f"{share:.2g}")


def _chosen_length() -> dict[str, Any] | None:
    """The unit that the user chose for lengths, and its value in m."""
    chosen = chosen_for("m")
    return None if chosen is None else {"unit": chosen.symbol, "metres": chosen.divisor}


def _of_bodies(motion: Motion, quantities: Sequence[str]) -> Floats:
    """Three quantities of each moving body, (n_t, n_bodies, 3)."""
    found = np.empty((len(motion.t), len(motion.compiled.bodies), len(quantities)))
    for k, name in enumerate(motion.compiled.bodies):
        for c, quantity in enumerate(quantities):
            found[:, k, c] = getattr(motion.body(name), quantity)
    return found


def _reactions(motion: Motion) -> Floats:
    """Force of each joint on its body j, global, (n_t, n_joints, 2), N."""
    found = np.zeros((len(motion.t), len(motion.compiled.joints), 2))
    for k, (name, info) in enumerate(motion.compiled.joints.items()):
        found[:, k] = motion.constraint(name).force(on=info.j)
    return found


def _reaction_scale(largest: float, size: float) -> dict[str, float | None]:
    """A round force, and the length of its arrow on the drawing, m."""
    unit = round_below(largest / 2.0) if largest > 0.0 else 1.0
    length = _LONGEST_ARROW * size * (unit / largest if largest > 0.0 else 1.0)
    return {"force": unit, "length": rounded(length)}


def playback_rate(duration: float) -> float:
    """Simulated seconds for each second on the screen: 1 unless the motion is too short or long."""
    if duration <= 0.0 or _SHORTEST <= duration <= _LONGEST:
        return 1.0
    return round_below(duration / (_SHORTEST if duration < _SHORTEST else _LONGEST))


def _traces(motion: Motion, size: float, wished: Sequence[str] | None) -> list[dict[str, Any]]:
    model = motion.compiled
    if wished is None:
        return _moving_points(motion, size)
    return [_trace(model, *_named(model, name)) for name in texts(wished, "traces")]


def _named(model: CompiledModel, name: str) -> tuple[str, str]:
    body, dot, point = name.partition(".")
    if not dot:
        raise ModelError(f"traces: {name!r} must be BODY.POINT, such as 'coupler.P'")
    if point not in model.body(body).points:
        raise unknown(f"point of {body}", point, model.body(body).points)
    return body, point


def _trace(model: CompiledModel, body: str, point: str) -> dict[str, Any]:
    info = model.all_bodies[body]
    at = plain(np.array(info.points[point]))
    return {"name": f"{body}.{point}", "body": info.number, "point": at}


def _moving_points(motion: Motion, size: float) -> list[dict[str, Any]]:
    """Moving points, without points that coincide with an earlier one."""
    near = _SAME_PLACE * size
    # A few frames show whether two points coincide; all of them would take long for many bodies.
    some = np.unique(np.linspace(0, len(motion.t) - 1, 16).round().astype(int))
    kept: list[dict[str, Any]] = []
    paths = np.empty((0, len(some), 2))
    for body, info in motion.compiled.bodies.items():
        for point in info.points:
            path = motion.body(body).point(point).position
            together = np.abs(paths - path[some]).max(axis=(1, 2), initial=0.0) < near
            if np.ptp(path, axis=0).max(initial=0.0) < near or together.any():
                continue
            paths = np.append(paths, path[None, some], axis=0)
            kept.append(_trace(motion.compiled, body, point))
    return kept
