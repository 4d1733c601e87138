"""Faults of analyses at their first values, which a run finds before its first result."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from kempe.errors import KempeError, ModelError

if TYPE_CHECKING:
    from kempe.case import Case
    from kempe.results.state import State

#: Share of a range that is computed: it contains the first value only, up to rounding.
_SHARE = 1e-9
#: The time of a first step, s.
_INSTANT = 1e-9


def check_beginnings(case: Case, start: State) -> None:
    """Compute the first value of each analysis that begins at the start.

    Raises:
        KempeError: a driven motion, a limit or a region cannot begin, or a value of a parameter is
            impossible.
    """
    from kempe.case import Case
    from kempe.sweeps.numbers import driven_model

    for k, (name, entry) in enumerate(case.analyses.items()):
        later = k > 0 and entry.get("from") != "start"
        if later and entry["type"] != "modes":
            continue
        for parameters in _parameters(entry):
            case.with_parameters(parameters).model.compile()
        if entry["type"] == "limits" and entry.get("over") is not None:
            driven_model(start.compiled, entry["over"])
        begun = _begun(entry, float(start.t))
        if begun is None:
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # those of a run appear when it runs
            try:
                for _ in Case(case.model, case._start, {name: begun}).each():
                    pass
            except KempeError as error:
                # of modes at a later state, only the names of inputs and outputs are checked
                if not later or isinstance(error, ModelError):
                    raise


def _parameters(entry: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The values of parameters at which the analysis begins."""
    if entry["type"] == "dynamics" and entry.get("parameters"):
        return [dict(entry["parameters"])]
    if entry["type"] == "equilibrium" and entry.get("over") and entry.get("range"):
        return [{entry["over"]: entry["range"][0]}]
    return []


def _begun(entry: Mapping[str, Any], t: float) -> dict[str, Any] | None:
    """An analysis of the first value only; None for other types of analyses."""
    begun = {key: value for key, value in entry.items() if key not in {"output_step", "from"}}
    match entry["type"]:
        case "modes":
            return begun
        case "kinematics" | "inverse_dynamics" if entry.get("over") is None:
            return begun | {"t_end": t}
        case "dynamics":
            return {
                "type": "dynamics",
                "t_end": t + _INSTANT,
                **{key: value for key, value in begun.items() if key in {"release", "parameters"}},
            }
        case "kinematics" | "inverse_dynamics":
            return begun | {"range": _first(entry["range"]), "n": 2}
        case "reachable":
            return begun | {"ranges": [_first(pair) for pair in entry["ranges"]], "n": 2}
    return None


def _first(pair: Any) -> list[Any]:
    first, last = (_number(value) for value in pair)
    if isinstance(first, str) or isinstance(last, str):
        return [first, f"({first}) + {_SHARE}*(({last}) - ({first}))"]
    return [first, first + _SHARE * (last - first)]


def _number(value: Any) -> Any:
    """A text without names as a number: a formula may not contain ``"90 deg"``."""
    from kempe.model.given import value as number

    try:
        return number(value, "range", "")
    except ModelError:
        return value
