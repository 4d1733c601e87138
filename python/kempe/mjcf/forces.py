"""Tendons and actuators of MJCF as forces of a case."""

from __future__ import annotations

from typing import Any

from kempe.mjcf.attributes import Given
from kempe.mjcf.structure import Structure
from kempe.mjcf.xml import Node

#: Rates of coordinates.
_RATE = {"angle": "omega", "displacement": "rate", "length": "rate"}
#: A length as a formula, its rate, and what a force on it is: entries of elements by coefficient.
Line = tuple[str, str, list[tuple[float, dict[str, Any]]]]


def read_forces(reader: Structure) -> None:
    """Read the sections ``tendon`` and ``actuator``."""
    tendons: dict[str, Line] = {}
    for section in reader.root.each("tendon"):
        for node in section.children:
            _tendon(reader, node, tendons)
    nodes = [node for section in reader.root.each("actuator") for node in section.children]
    if reader.has_controls and len(nodes) != len(reader.controls):
        reader.not_fitting("ctrl", "actuators")
    for node in nodes:
        _actuator(reader, node, tendons)


def _tendon(reader: Structure, node: Node, tendons: dict[str, Line]) -> None:
    given = reader.given(node)
    name = given.text("name", "tendon")
    spring = given.number("stiffness"), given.number("damping")
    rest = given.numbers("springlength", [-1.0])
    given.skip("rgba", "material", "width", "group", "class", "user")
    given.zero("frictionloss", "armature")
    given.rest()
    line = _sum(reader, node) if node.tag == "fixed" else _spatial(reader, node, name)
    if line is None:
        return
    tendons[name] = line
    if any(spring):
        if node.tag == "fixed" or len(rest) != 1 or rest[0] == 0:
            reader.unread.lost(node, "this spring is not supported; only one length of relaxation")
            return
        free = {} if rest[0] < 0 else {"free_length": float(rest[0])}
        if not free and not reader.relaxed:
            reader.unread.lost(node, "it is relaxed at springref of joints; give its springlength")
            return
        if not free:
            i, j = (reader.sites[site.attributes["site"]][1] for site in node.each("site"))
            free = {"free_length": float(sum((i - j) ** 2) ** 0.5)}
        points = {key: line[2][0][1][key] for key in ("i", "j")}
        entry = {"type": "spring_damper", **points, **free}
        reader.forces[reader.names.new(name)] = entry | {
            key: value for key, value in zip(("stiffness", "damping"), spring, strict=True) if value
        }


def _sum(reader: Structure, node: Node) -> Line | None:
    """A weighted sum of joint coordinates."""
    terms, rates, entries = [], [], []
    for child in node.children:
        move = reader.moves.get(child.attributes.get("joint", ""))
        if child.tag != "joint" or move is None:
            reader.unread.lost(child, "it names no joint that was read")
            return None
        name, coordinate, sense = move
        given = Given(child, child.attributes, reader.unread)
        coef = sense * given.number("coef", 1.0)
        terms.append(f"({coef!r})*{name}.{coordinate}")
        rates.append(f"({coef!r})*{name}.{_RATE[coordinate]}")
        entry = {"type": "generalized_force", "coordinate": f"{name}.{coordinate}"}
        entries.append((coef, entry))
    return f"({' + '.join(terms)})", f"({' + '.join(rates)})", entries


def _spatial(reader: Structure, node: Node, name: str) -> Line | None:
    """The distance of two sites."""
    sites = [reader.sites.get(child.attributes.get("site", "")) for child in node.children]
    if node.tag != "spatial" or len(sites) != 2 or any(site is None for site in sites):
        reader.unread.lost(node, "only tendons between two sites, or sums of joints, are read")
        return None
    (_, one), (_, other) = (site for site in sites if site is not None)
    if not reader.plane.contains(one - other):
        reader.unread.lost(node, "its sites are not in one plane")
        return None
    ends = [reader.point(site[0], name, site[1]) for site in sites if site is not None]
    entry = {"type": "actuator", "i": ends[0], "j": ends[1]}
    return "length", "rate", [(1.0, entry)]


def _actuator(reader: Structure, node: Node, tendons: dict[str, Line]) -> None:
    given = reader.given(node)
    name = given.text("name", node.tag)
    control = reader.controls.pop(0) if reader.controls else 0.0
    line = _line(reader, node, given, tendons)
    law = _law(node, given)
    gear = float(given.numbers("gear", [1.0])[0])
    control = _clamped(given, control, reader.limits)
    given.skip("class", "group", "user")
    given.rest()
    if line is None or law is None:
        reader.unread.lost(node, "it is not a force on a joint or a tendon that was read")
        return
    length, rate, entries = line
    gain, (offset, by_length, by_rate) = law
    terms = [repr(offset)] if offset else []
    if gain:
        parameter = reader.names.new(f"{name}_ctrl")
        reader.parameters[parameter] = float(control)
        terms.append(f"({gain!r})*{parameter}")
    terms += [f"({by_length * gear!r})*{length}"] if by_length else []
    terms += [f"({by_rate * gear!r})*{rate}"] if by_rate else []
    value = " + ".join(terms) or "0"
    for coef, entry in entries:
        key = "force" if entry["type"] == "actuator" else "value"
        law_text = f"({gear * coef!r})*({value})"
        reader.forces[reader.names.new(name)] = {**entry, key: law_text}


def _clamped(given: Given, control: float, automatic: bool) -> float:
    """The control within its range."""
    low, high = given.numbers("ctrlrange", [0.0, 0.0], 2)
    limited = given.text("ctrllimited", "auto")
    if limited == "true" or (limited == "auto" and automatic and (low, high) != (0.0, 0.0)):
        return float(min(max(control, low), high))
    return control


def _line(reader: Structure, node: Node, given: Given, tendons: dict[str, Line]) -> Line | None:
    joint, tendon = given.text("joint"), given.text("tendon")
    if joint in reader.moves:
        fixed = Node("fixed", node.line, {}, [Node("joint", node.line, {"joint": joint})])
        return _sum(reader, fixed)
    return tendons.get(tendon)


def _law(node: Node, given: Given) -> tuple[float, tuple[float, float, float]] | None:
    """Gain of the control, and the bias: constant, by length and by rate."""
    if node.tag == "motor":
        return 1.0, (0.0, 0.0, 0.0)
    if node.tag == "position":
        kp, kv = given.number("kp", 1.0), given.number("kv")
        return kp, (0.0, -kp, -kv)
    if node.tag == "velocity":
        kv = given.number("kv", 1.0)
        return kv, (0.0, 0.0, -kv)
    if node.tag != "general" or given.text("gaintype", "fixed") != "fixed":
        return None
    gain = float(given.numbers("gainprm", [1.0])[0])
    bias = given.numbers("biasprm", [0.0])
    kind = given.text("biastype", "none")
    if kind == "none":
        return gain, (0.0, 0.0, 0.0)
    full = [*map(float, bias), 0.0, 0.0, 0.0][:3]
    return (gain, (full[0], full[1], full[2])) if kind == "affine" else None
