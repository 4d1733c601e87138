"""A mechanism without some of the redundant equations of its joints."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import kempe as kp
from kempe.analyses.mobility import Remedy
from kempe.case import parsed


def without(model: kp.Model, state: kp.State, remedies: Sequence[tuple[Remedy, str]]) -> kp.Model:
    """The model without the given equations of some remedies, or the directions of pins."""
    tree = kp.Case(model).tree()
    of_joint: dict[str, list[tuple[Remedy, str]]] = {}
    for remedy, equation in remedies:
        of_joint.setdefault(remedy.joint, []).append((remedy, equation))
    for name, own in of_joint.items():
        section = "drivers" if name in tree.get("drivers", {}) else "joints"
        left = tree[section].pop(name)
        replaced = None if section == "drivers" else freed(left, state, own)
        if replaced is not None:
            tree[section][name] = replaced
    return parsed(json.dumps(tree), "json", "remedied").model


def freed(
    joint: dict[str, Any], state: kp.State, own: Sequence[tuple[Remedy, str]]
) -> dict[str, Any] | None:
    """A joint without some of its equations; None if none is left."""
    kind = joint["type"]
    removed = {equation.rpartition(".")[2] for _, equation in own}
    if kind == "revolute" and len(own) == 1:
        return slot(joint, own[0][0])
    if kind == "translational" and removed == {"angle"}:
        return joint | {"type": "pin_in_slot", "axis": joint.pop("axes", [0])[0]}
    if kind == "translational" and removed == {"normal"}:
        return turned_together(joint, state)
    if kind == "weld" and removed == {"angle"}:
        return {"type": "revolute", "i": joint["i"], "j": joint["j"]}
    if kind == "weld" and removed == {"x", "y"}:
        return turned_together(joint, state)
    if kind == "weld" and len(removed) == 1:
        return guided(joint, state, removed.pop())
    if kind == "weld" and len(removed) == 2:
        return along(joint, state, (removed ^ {"x", "y"}) - {"angle"})
    if kind == "rolling" and removed == {"normal"}:
        return joint | {"type": "rack"}
    return None


def slot(joint: dict[str, Any], remedy: Remedy) -> dict[str, Any]:
    """The pin as a pin in a slot of the body that the remedy names."""
    assert remedy.axis is not None
    assert remedy.body is not None
    i, j = joint["i"], joint["j"]
    if i.split(".")[0] != remedy.body:
        i, j = j, i
    return {"type": "pin_in_slot", "i": i, "j": j, "axis": remedy.axis}


def bodies(joint: dict[str, Any]) -> list[str]:
    return [str(joint[end]).split(".", maxsplit=1)[0] for end in "ij"]


def turned_together(joint: dict[str, Any], state: kp.State) -> dict[str, Any]:
    """Only the difference of the angles stays."""
    i, j = bodies(joint)
    terms = {f"{j}.angle": 1.0} | ({} if i == "ground" else {f"{i}.angle": -1.0})
    value = sum(factor * state[name] for name, factor in terms.items())
    return {"type": "coupling", "terms": terms, "value": value}


def guided(joint: dict[str, Any], state: kp.State, free: str) -> dict[str, Any]:
    """A slide along the global direction x or y of the position."""
    i, j = (0.0 if name == "ground" else state[f"{name}.angle"] for name in bodies(joint))
    way = 0.0 if free == "x" else 1.5707963267948966
    both = {"axes": [way - i, way - j]}
    return {"type": "translational", "i": joint["i"], "j": joint["j"]} | both


def along(joint: dict[str, Any], state: kp.State, free: set[str]) -> dict[str, Any]:
    """A pin in a slot along the global direction x or y of the position."""
    slide = guided(joint, state, free.pop())
    return {"type": "pin_in_slot", "i": joint["i"], "j": joint["j"], "axis": slide["axes"][0]}
