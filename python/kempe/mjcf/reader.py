"""MJCF: a model of MuJoCo as a case."""

from __future__ import annotations

import json
from typing import Any

from kempe.mjcf.forces import read_forces
from kempe.mjcf.structure import Structure
from kempe.mjcf.xml import XmlError, parse

#: Largest text, in characters.
LARGEST = 16_000_000
Result = tuple[str | None, list[tuple[int, str, bool]], list[tuple[str, list[float]]]]


def read(text: str) -> Result:
    """The case as JSON, what it lacks, and no results, as ``_core.exchange_read`` returns them."""
    if len(text) > LARGEST:
        message = f"the file has {len(text) / 1e6:.1f} MB; at most {LARGEST / 1e6:.0f} are read"
        return None, [(0, message, False)], []
    try:
        root = parse(text)
    except XmlError as fault:
        return None, [(fault.line, str(fault), False)], []
    if root.tag != "mujoco":
        return None, [(root.line, f"{root.tag}: the first element must be mujoco", False)], []
    found = Structure(root)
    read_forces(found)
    return json.dumps(_case(found)), sorted(found.unread.found, key=lambda one: one[0]), []


def _case(found: Structure) -> dict[str, Any]:
    gravity = found.plane.point(found.gravity)
    sections = {
        "parameters": found.parameters,
        "bodies": found.bodies,
        "joints": found.joints,
        "forces": found.forces,
        "start": {"guess": found.guess} if found.guess else {},
        "analyses": {"motion": {"type": "dynamics", "t_end": 1.0, "output_step": 0.01}},
    }
    head = {"kempe": 1, "title": found.root.attributes.get("model", "MuJoCo model")}
    head |= {"gravity": gravity} if any(gravity) else {}
    return head | {name: table for name, table in sections.items() if table}
