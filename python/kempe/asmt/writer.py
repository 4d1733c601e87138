"""``kp.write_asmt``: a mechanism as an assembly of OndselSolver and FreeCAD."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from kempe.asmt.formulas import number, translated
from kempe.asmt.parts import GROUND, Parts
from kempe.asmt.sheet import about_z, along
from kempe.base import files
from kempe.base.arguments import explained
from kempe.case import Case
from kempe.errors import ModelError
from kempe.model.constants import constant, value_of
from kempe.model.infos import ConstraintInfo, ForceInfo
from kempe.results.state import State

#: Fields of each type that are written; all have `type`, `i` and `j`.
_FIELDS = {
    "revolute": {"axes"},
    "translational": {"axes"},
    "weld": {"angle"},
    "pin_in_slot": {"axis"},
    "distance": {"length"},
    "gear": {"radii", "teeth", "module", "internal", "offset"},
    "rack": {"radius", "axis", "offset"},
    "coordinate_driver": {"coordinate", "value"},
    "spring_damper": {"stiffness", "damping", "free_length", "preload"},
    "actuator": {"force"},
    "stop": {"coordinate", "lower", "upper", "restitution", "rest_speed"},
}
#: Parts of a case that are written, if only in their effect.
_WRITTEN = {"kempe", "title", "gravity", "bodies", "joints", "drivers", "forces", "start"}
#: The coordinate of a joint that a motion or a limit may have.
_COORDINATES = {"revolute": "angle", "translational": "displacement"}
_KINDS = ("dynamics", "inverse_dynamics", "kinematics")


@explained
def write_asmt(case: Case | State, path: Path | str, *, partial: bool = False) -> tuple[str, ...]:
    """Write a mechanism as an assembly in the format ``.asmt`` of OndselSolver and FreeCAD.

    The plane becomes the xy plane, and numbers are in SI units. Each body is a part with its named
    points as markers. Laws that depend on parameters only are written as numbers. Joints
    ``revolute``, ``translational``, ``weld``, ``pin_in_slot``, ``distance``, ``gear`` and
    ``rack``, drivers of a joint or of a body on such a joint, springs, actuators, and stops with
    ``restitution = 0`` are written. A part that no joint keeps in the plane has a planar joint to
    ground.

    Args:
        case: the case, whose first motion gives the end and the output step; or a state, with an
            end after 1 s.
        path: the file; its name should end in ``.asmt``.
        partial: whether elements that the format cannot contain are left out; otherwise they are
            errors.

    Returns:
        What the file lacks: outlines, further analyses and so on.

    Raises:
        ModelError: an element that the format cannot contain, or a law that it cannot express.
        FileError: the file cannot be written.
    """
    if not isinstance(case, Case | State):
        raise ModelError(f"{case!r} is not a case", hint="kp.load(…) or kp.Case(…) gives one")
    left: list[str] = []
    state = case if isinstance(case, State) else case.start()
    writer = _Writer(state, left, partial)
    if isinstance(case, Case):
        writer.case(case)
    files.write_text(path, writer.text())
    return tuple(left)


class _Writer:
    def __init__(self, state: State, left: list[str], partial: bool) -> None:
        self.state, self.model, self.left, self.partial = state, state.compiled, left, partial
        self.parts = Parts(state, left)
        self.sheet = self.parts.sheet

    def case(self, case: Case) -> None:
        """The times of the first motion, and what a file cannot contain."""
        tree = case.tree()
        self.left += [key for key in tree if key not in _WRITTEN | {"parameters", "analyses"}]
        if tree.get("parameters"):
            self.left.append("parameters: their values are written in place of their names")
        motions = [k for k, e in case.analyses.items() if e["type"] in _KINDS and "t_end" in e]
        for name, entry in case.analyses.items():
            if name != next(iter(motions), ""):
                self.left.append(f"analyses.{name}")
                continue
            self.sheet.t_end = value_of(self.model, entry["t_end"]) or 1.0
            step = value_of(self.model, entry.get("output_step", 0.0))
            self.sheet.step = step or self.sheet.t_end / 100
            kept = {"type", "t_end", "output_step"}
            self.left += [f"analyses.{name}.{key}" for key in entry if key not in kept]

    def text(self) -> str:
        """The text of the file."""
        for info in self.model.constraints.values():
            make = self._driver if info.group == "drivers" else self._joint
            self._each(info, make)
        for force in self.model.forces.values():
            self._each(force, self._force)
        self.parts.finish()
        return self.sheet.text()

    def _each(self, info: Any, make: Callable[[Any, Mapping[str, Any]], None]) -> None:
        """Write an element. If `partial` is set, an error is listed, and the element left out."""
        try:
            known = _FIELDS.get(info.type)
            entry = self.model.tree[info.group if hasattr(info, "group") else "forces"][info.name]
            if known is None:
                raise ModelError(
                    f"{info.name}: elements of type {info.type} cannot be written as asmt",
                    name=info.name,
                )
            if other := set(entry) - known - {"type", "i", "j"}:
                raise ModelError(
                    f"{info.name}: {min(other)} cannot be written as asmt", name=info.name
                )
            make(info, entry)
        except ModelError as error:
            if not self.partial:
                error.hint = error.hint or "partial=True, or --partial, leaves it out"
                raise
            self.left.append(str(error.args[0]))

    def _constant(self, name: str, entry: Mapping[str, Any], key: str, absent: float) -> float:
        return constant(self.model, f"{name}.{key}", entry.get(key, absent), "asmt")

    def _law(self, place: str, law: object, **names: str) -> str:
        return translated(self.model, place, law, {"t": "time", **names})

    # --- joints -----------------------------------------------------------------------------------

    def _joint(self, joint: ConstraintInfo, entry: Mapping[str, Any]) -> None:
        more: dict[str, str] = {}
        i, j = about_z(joint.axis_i), about_z(joint.axis_j)
        match joint.type:
            case "revolute":
                kind = "Revolute"
            case "translational":
                kind, i, j = "Translational", along(joint.axis_i), along(joint.axis_j)
            case "weld":
                # both frames coincide
                kind, j = "Fixed", about_z(0.0)
                i = about_z(self.parts.angle(joint.j) - self.parts.angle(joint.i))
            case "pin_in_slot":
                kind, i, j = "PointInLine", along(joint.axis_i), about_z(0.0)
            case "distance":
                kind, i, j = "RevRev", about_z(0.0), about_z(0.0)
                more["distanceIJ"] = repr(self._constant(joint.name, entry, "length", 0.0))
            case "rack":
                kind, i, j = "RackPinion", about_z(joint.axis_i), about_z(0.0)
                more["pitchRadius"] = repr(self._constant(joint.name, entry, "radius", 0.0))
            case _:
                kind, i, j, more = "Gear", about_z(0.0), about_z(0.0), self._radii(joint, entry)
        self.parts.joint(kind, self.parts.plain(joint.name), self.parts.ends(joint, i, j) | more)
        if kind not in ("PointInLine", "RackPinion", "Gear"):
            self.parts.tie(joint.i, joint.j)

    def _radii(self, joint: ConstraintInfo, entry: Mapping[str, Any]) -> dict[str, str]:
        """The radii of a gear pair; those of an internal pair have opposite signs."""
        given = entry.get("radii", entry.get("teeth"))
        one, other = (constant(self.model, f"{joint.name}.radii", r, "asmt") for r in given)
        half = self._constant(joint.name, entry, "module", 2.0) / 2 if "teeth" in entry else 1.0
        sign = -1 if entry.get("internal") else 1
        return {"radiusI": repr(half * one), "radiusJ": repr(sign * half * other)}

    # --- drivers and stops ------------------------------------------------------------------------

    def _moved(self, place: str, coordinate: str) -> tuple[ConstraintInfo, float, float]:
        """A joint, a factor and a sum: its coordinate in the file is factor × the given one + sum.

        The given coordinate is that of the joint, or of a body that the joint carries on ground.
        """
        owner, _, quantity = coordinate.replace("`", "").rpartition(".")
        joints = self.model.constraints
        if owner in joints and quantity == _COORDINATES.get(joints[owner].type):
            joint = joints[owner]
            # the angle in the file is that between the x axes of the markers
            return joint, 1.0, joint.axis_j - joint.axis_i if quantity == "angle" else 0.0
        body = owner.split(".")[0]
        for joint in joints.values():
            if {joint.i, joint.j} != {body, GROUND}:
                continue
            sense = 1.0 if joint.i == GROUND else -1.0
            if joint.type == "revolute" and (owner, quantity) == (body, "angle"):
                return joint, sense, joint.axis_j - joint.axis_i
            if joint.type == "translational" and quantity in ("x", "y"):
                angle = joint.axis_i if joint.i == GROUND else joint.axis_j
                part = sense * (math.cos(angle) if quantity == "x" else math.sin(angle))
                if abs(part) > 1e-9:
                    shift = self.state[f"{joint.name}.displacement"]
                    return joint, 1 / part, float(shift - self.state[coordinate] / part)
        raise ModelError(
            f"{place}: {coordinate} cannot be written as asmt",
            name=place,
            hint="coordinates of revolute and translational joints can be",
        )

    def _driver(self, driver: ConstraintInfo, entry: Mapping[str, Any]) -> None:
        joint, factor, more = self._moved(driver.name, entry["coordinate"])
        law = self._law(f"{driver.name}.value", entry["value"])
        law = law if factor == 1 else f"{number(factor)}*{law}"
        law = law if more == 0 else f"{law} + {number(more)}"
        turns = joint.type == "revolute"
        fields = {"MotionJoint": self._path(joint.name)}
        fields["RotationZ" if turns else "TranslationZ"] = law
        kind = "RotationalMotion" if turns else "TranslationalMotion"
        self.sheet.sections["Motions"].append((kind, self.parts.plain(driver.name), fields))

    def _path(self, joint: str) -> str:
        return f"/{self.sheet.assembly.name}/{self.parts.plain(joint)}"

    def _stop(self, stop: ForceInfo, entry: Mapping[str, Any]) -> None:
        if self._constant(stop.name, entry, "restitution", 1.0) != 0:
            raise ModelError(
                f"{stop.name}: a stop cannot be written as asmt unless restitution = 0",
                name=stop.name,
            )
        joint, factor, more = self._moved(stop.name, entry["coordinate"])
        kind = "RotationLimit" if joint.type == "revolute" else "TranslationLimit"
        for side in ("lower", "upper"):
            if side not in entry:
                continue
            limit = factor * self._constant(stop.name, entry, side, 0.0) + more
            sign = "=<" if (side == "upper") == (factor > 0) else "=>"
            name = self.parts.plain(stop.name) + ("" if len(entry) < 4 else f" {side}")
            fields = {"MotionJoint": self._path(joint.name), "Limit": number(limit)}
            fields |= {"Type": sign, "Tol": "1.0e-9"}
            self.sheet.sections["Limits"].append((kind, name, fields))

    # --- forces -----------------------------------------------------------------------------------

    def _force(self, force: ForceInfo, entry: Mapping[str, Any]) -> None:
        if force.type == "stop":
            self._stop(force, entry)
            return
        if force.type == "actuator":
            names = {"length": "rIJ(self)", "rate": "vrIJ(self)"}
            tension = f"-{self._law(f'{force.name}.force', entry['force'], **names)}"
        else:
            value = {
                key: number(self._constant(force.name, entry, key, 0.0))
                for key in _FIELDS["spring_damper"]
            }
            tension = (
                f"{value['stiffness']}*(rIJ(self) - {value['free_length']})"
                f" + {value['damping']}*vrIJ(self) + {value['preload']}"
            )
        assert force.points is not None
        ends = zip(("MarkerI", "MarkerJ"), force.bodies, force.points, strict=True)
        turn = about_z(0.0)
        fields = {key: self.parts.path(body, at, turn, force.name) for key, body, at in ends}
        fields |= {"tension": f"({tension})", "twist": "0"}
        entry_of = ("InLineForceTorque", self.parts.plain(force.name), fields)
        self.sheet.sections["ForceTorques"].append(entry_of)
