"""The bodies of a model as parts of an assembly, and the markers of its joints."""

from __future__ import annotations

import math

from kempe.asmt.sheet import Rotation, Sheet, Solid, about_z
from kempe.errors import ModelError
from kempe.model.infos import BodyInfo, ConstraintInfo, Vector
from kempe.results.state import State

GROUND = "ground"
#: Signs that separate the parts of a path, and lines and levels of a file.
_SEPARATORS = str.maketrans({"/": "_", "\t": "_", "\n": "_", "\r": "_"})


class Parts:
    """All parts, by the names of their bodies, and what is left out."""

    def __init__(self, state: State, left: list[str]) -> None:
        self.state, self.model, self.left = state, state.compiled, left
        title = self.plain(self.model.title or "") or "Assembly"
        self.solids = {GROUND: Solid(title)}
        self.sheet = Sheet(self.solids[GROUND], gravity=self.model.gravity)
        taken: set[str] = set()
        for body in self.model.bodies.values():
            if not body.is_shown or body.type == "beam":
                name = body.name.split(".")[0]
                raise ModelError(f"{name}: a beam cannot be written as asmt", name=name)
            solid = self._solid(body)
            if solid.name in taken:
                raise ModelError(
                    f"{body.name}: another body has the name {solid.name} in the file",
                    name=body.name,
                    hint="a name in the file contains no '/'",
                )
            taken.add(solid.name)
            self.solids[body.name] = solid
            self.sheet.parts.append(solid)
        for name, solid in self.solids.items():
            for point, at in self.model.all_bodies[name].points.items():
                solid.points[point] = solid.marker(self.plain(point), at, about_z(0.0))
        #: A body, and the one to which joints tie its plane; ground is the last of a chain.
        self.tied = {name: name for name in self.solids}

    def plain(self, name: str) -> str:
        """The name in the file; a change is listed."""
        written = name.translate(_SEPARATORS)
        if written != name:
            self.left.append(f"{name}: its name in the file is {written}")
        return written

    def _solid(self, body: BodyInfo) -> Solid:
        turning = ("angle", "omega") if body.turns else ()
        value = {
            quantity: float(self.state[f"{body.name}.{quantity}"])
            for quantity in ("x", "y", "vx", "vy", *turning)
        }
        angle = value.get("angle", 0.0)
        if abs(angle) > math.pi:
            self.left.append(f"{body.name}: whole turns of its angle at the start, {angle:.6g} rad")
        if body.drawn:
            self.left.append(f"{body.name}: its outline")
        self.left.extend(f"{body.name}: its curve {curve}" for curve in body.curves)
        return Solid(
            self.plain(body.name),
            (value["x"], value["y"]),
            angle,
            (value["vx"], value["vy"]),
            value.get("omega", 0.0),
            body.mass,
            body.inertia,
            body.center,
        )

    def angle(self, body: str) -> float:
        """The angle of a body at the start, rad."""
        return self.solids[body].angle

    def path(self, body: str, at: Vector, turn: Rotation, wanted: str) -> str:
        """The path of a marker at a place of a body."""
        solid = self.solids[body]
        marker = solid.marker(self.plain(wanted), at, turn)
        between = "" if body == GROUND else f"/{solid.name}"
        return f"/{self.solids[GROUND].name}{between}/{marker}"

    def ends(self, joint: ConstraintInfo, i: Rotation, j: Rotation) -> dict[str, str]:
        """The two markers of a joint."""
        return {
            "MarkerI": self.path(joint.i, joint.point_i, i, joint.name),
            "MarkerJ": self.path(joint.j, joint.point_j, j, joint.name),
        }

    def joint(self, kind: str, name: str, fields: dict[str, str]) -> None:
        """Add a joint."""
        self.sheet.sections["Joints"].append((f"{kind}Joint", name, fields))

    def tie(self, one: str, other: str) -> None:
        """A joint keeps two bodies from tilting against each other."""
        self.tied[self._root(one)] = self._root(other)

    def _root(self, body: str) -> str:
        while self.tied[body] != body:
            body = self.tied[body]
        return body

    def finish(self) -> None:
        """Keep point masses from turning, and all other free parts in the plane."""
        for body in self.model.bodies.values():
            if body.turns and self._root(body.name) == self._root(GROUND):
                continue
            kind, what = ("Planar", "plane") if body.turns else ("NoRotation", "angle")
            fields = {
                "MarkerI": self.path(GROUND, (0.0, 0.0), about_z(0.0), "origin"),
                "MarkerJ": self.path(body.name, (0.0, 0.0), about_z(0.0), "origin"),
            }
            fields |= {"offset": "0.0"} if body.turns else {}
            self.joint(kind, f"{self.plain(body.name)} {what}", fields)
            self.tie(body.name, GROUND)
