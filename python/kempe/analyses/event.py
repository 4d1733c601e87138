"""Requests for events of a run: conditions, with their effects."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

from kempe.base.arguments import Explained
from kempe.base.names import one_of
from kempe.errors import ModelError
from kempe.model.values import mapping, reference

if TYPE_CHECKING:
    from kempe.results.state import State

Direction = Literal["both", "rising", "falling"]
#: A function of the state at an event; see ``Event``.
Action: TypeAlias = "Callable[[State], State | Mapping[str, float] | None]"
#: Conditions by name.
Events: TypeAlias = "Mapping[str, str | Event | Mapping[str, Any]]"

_FORM = "{'hit': 'rocker.angle > 270*deg'}"
_STOPS = "must be True, False, or the number of the event that ends the run, from 1"
_FIELDS = ("condition", "direction", "stop")


@dataclass(frozen=True)
class Event(metaclass=Explained):
    """An event that a run detects.

    Attributes:
        condition: a comparison or an expression. A comparison such as ``"C.force > 900"`` has an
            event whenever it becomes true, but no event if it is true at the start. An expression
            such as ``"rocker.angle - 270*deg"`` has an event at each zero.
        direction: the zeros of an expression that are events: "rising", "falling" or "both".
        stop: whether the run ends at the first event, or the number of the event that ends it, such
            as 3 for the third.
        action: a function that is called with the state at the event. It returns None to change
            nothing, a mapping of parameters to their new values, or a state at the same time with
            other positions or velocities. The run continues with them. Only in ``kp.dynamics``.
    """

    condition: str
    direction: Direction = "both"
    stop: bool | int = False
    action: Action | None = None

    def tree(self, path: str) -> str | dict[str, Any]:
        """The event as in a file.

        Args:
            path: its place, for messages.

        Raises:
            ModelError: a value is not allowed in its field.
        """
        if self.action is not None:
            raise ModelError(
                f"{path}: an event with an action, which is a function of Python",
                name=path,
                hint="a case cannot contain it; pass the event to kp.dynamics",
            )
        found: dict[str, Any] = {"condition": reference(self.condition, f"{path}.condition")}
        direction = one_of(f"{path}.direction", self.direction, get_args(Direction))
        if direction != "both":
            found["direction"] = direction
        if self.stop is not False:
            found["stop"] = _stop(self.stop, f"{path}.stop")
        return found if len(found) > 1 else str(found["condition"])


def _stop(value: object, path: str) -> bool | int:
    """True, or a number of events, which the core checks.

    Raises:
        ModelError: another value.
    """
    if isinstance(value, int):
        return value
    raise ModelError(f"{path}: {value!r}; {_STOPS}", name=path)


def events(value: object, path: str) -> dict[str, str | dict[str, Any]]:
    """Events by name as in a file.

    Raises:
        ModelError: a value is not an event.
    """
    return {
        reference(name, path): _event(entry, f"{path}.{name}")
        for name, entry in mapping(value, path, _FORM).items()
    }


def _event(value: object, path: str) -> str | dict[str, Any]:
    if isinstance(value, Event):
        return value.tree(path)
    if isinstance(value, str):
        return value
    if not isinstance(value, Mapping):
        hint = "write a condition such as 'crank.angle > 270*deg', or kp.Event(…)"
        raise ModelError(f"{path}: {value!r}; must be a condition", name=path, hint=hint)
    for key in value:
        one_of(f"field of {path}", key, _FIELDS)
    if "condition" not in value:
        raise ModelError(f"{path}: no condition", name=path, hint=f"write {_FORM}")
    return Event(**value).tree(path)


def with_actions(value: object) -> tuple[object, dict[str, Action]]:
    """Events without their actions, and the actions by name.

    Raises:
        ModelError: an event stops the run and has an action, or the action is not a function.
    """
    if not isinstance(value, Mapping):
        return value, {}
    actions, plain = {}, {}
    for name, event in value.items():
        plain[name] = event
        if isinstance(event, Event) and event.action is not None:
            if not callable(event.action):
                raise ModelError(f"events.{name}.action: {event.action!r} is not a function")
            if event.stop:
                hint = "use one of them"
                raise ModelError(f"events.{name}: stop and an action", name=str(name), hint=hint)
            actions[name] = event.action
            plain[name] = Event(event.condition, event.direction)
    return plain, actions
