"""The bodies, joints and equations of a model of MuJoCo."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from kempe.base.arrays import Floats
from kempe.mjcf.attributes import Given, Names
from kempe.mjcf.settings import Settings
from kempe.mjcf.xml import Node

#: Attributes of equations that concern their softness, and of looks.
_SOFT = ("solref", "solimp", "solreflimit", "solimplimit", "solreffriction", "solimpfriction")
_LOOKS = ("rgba", "material", "group", "user", "class", "width", "childclass", "texuniform")


class Carried:
    """A body of the file: its frame in space at the start, and its motion in the plane."""

    def __init__(self, name: str, place: Floats, turn: Floats) -> None:
        self.name, self.place, self.turn = name, place, turn
        self.velocity, self.omega = np.zeros(3), 0.0

    def at(self, point: Floats) -> Floats:
        """A point of its frame in space."""
        return self.place + self.turn @ point


class Structure(Settings):
    """Bodies and joints as in a case. Frames of bodies are parallel to the plane at the start."""

    def __init__(self, root: Node) -> None:
        super().__init__(root)
        self.names = Names()
        self.bodies: dict[str, Any] = {"ground": {"points": {}}}
        self.joints: dict[str, Any] = {}
        self.forces: dict[str, Any] = {}
        self.parameters: dict[str, float] = {}
        self.guess: dict[str, float] = {}
        #: By the names of the file: bodies, sites (body, place), joints (name, coordinate, sense).
        self.known: dict[str, Carried] = {"world": Carried("ground", np.zeros(3), np.eye(3))}
        self.sites: dict[str, tuple[Carried, Floats]] = {}
        self.moves: dict[str, tuple[str, str, int]] = {}
        self.touching: dict[str, Node] = {}
        #: The names of points by body, wanted name and place, and the last number of equal names.
        self.points: dict[tuple[object, ...], str] = {}
        self.equal: dict[tuple[str, str], int] = {}
        #: Whether springs of joints are relaxed at zero coordinates, as tendons then are.
        self.relaxed = True
        for world in root.each("worldbody"):
            self._content(world, self.known["world"], "main")
        if len(self.touching) > 1 and self.collides:
            node = next(iter(self.touching.values()))
            self.unread.lost(node, "geoms of several bodies may touch; contacts are not read")
        for section in root.each("equality"):
            for node in section.children:
                self._equation(node)
        if self.rates:
            self.not_fitting("qvel", "joints")

    def not_fitting(self, name: str, what: str) -> None:
        """Report a list of the key frame that does not have a number for each joint or actuator."""
        key = next(key for section in self.root.each("keyframe") for key in section.each("key"))
        self.unread.lost(key, f"{name} does not have as many numbers as there are {what}")

    def _new(self, node: Node, known: Mapping[str, object]) -> None:
        """Report an element whose name another one of its kind has."""
        if node.attributes.get("name") in known:
            self.unread.lost(node, "another one has this name")

    # --- bodies and joints ------------------------------------------------------------------------

    def _content(self, node: Node, body: Carried, style: str) -> None:
        """Sites, geoms and bodies in a body."""
        for child in node.children:
            if child.tag == "site":
                given = self.given(child, style)
                place = body.at(given.numbers("pos", [0, 0, 0], 3))
                self._new(child, self.sites)
                self.sites[given.text("name")] = body, place
                self.point(
                    body, given.node.attributes.get("name", "site").rpartition(".")[2], place
                )
            elif child.tag == "geom":
                given = self.given(child, style)
                if given.text("contype", "1") != "0" or given.text("conaffinity", "1") != "0":
                    self.touching.setdefault(body.name, child)
                self.unread.harmless(child, "shapes are not read")
            elif child.tag == "body":
                self._body(child, body, style)
            elif child.tag not in ("joint", "inertial", "light", "camera"):
                self.unread.lost(child, "this element is not supported")

    def point(self, body: Carried, wanted: str, place: Floats) -> str:
        """A point of a body, as ``body.point``; one at the same place with this name is used."""
        points = self.bodies[body.name].setdefault("points", {})
        at = self.plane.point(place - body.place)
        base = "".join(c if c.isalnum() and c.isascii() else "_" for c in wanted) or "P"
        base = f"P{base}" if base[0].isdigit() else base
        # equal up to rounding
        scale = 1e-12 * 2.0 ** math.frexp(math.hypot(*at))[1]
        same = body.name, base, scale, *(round(x / scale) if scale else 0 for x in at)
        if same not in self.points:
            name, k = base, self.equal.get((body.name, base), 1)
            while name in points:
                k += 1
                name = f"{base}_{k}"
            self.equal[body.name, base] = k
            self.points[same] = name
            points[name] = at
        return f"{body.name}.{self.points[same]}"

    def _body(self, node: Node, carrier: Carried, style: str) -> None:
        given = self.given(node, style)
        inner = given.text("childclass", style)
        place = carrier.at(given.numbers("pos", [0, 0, 0], 3))
        body = Carried(
            self.names.new(given.text("name", "body")), place, carrier.turn @ self.turn(given)
        )
        given.skip("gravcomp" if given.left.get("gravcomp") == "0" else "", "quat", "user")
        given.rest()
        self._new(node, self.known)
        self.known[node.attributes.get("name", body.name)] = body
        joints = list(node.each("joint"))
        fixed = carrier.name == "ground" and not joints
        self.bodies[body.name] = self._mass(node, body, fixed)
        for free in node.each("freejoint"):
            self.unread.lost(free, "a free joint moves in space")
        before = carrier
        for k, joint in enumerate(joints):
            last = k == len(joints) - 1
            after = body if last else self._between(body)
            self._joint(joint, before, after, inner)
            before = after
        if not joints:
            self._weld(carrier, body)
        for name, value in zip(("x", "y"), self.plane.point(body.place), strict=True):
            self.guess[f"{body.name}.{name}"] = value
        self._content(node, body, inner)

    def _between(self, body: Carried) -> Carried:
        """A body without mass between two joints of a body."""
        found = Carried(self.names.new(f"{body.name}_carrier"), body.place, body.turn)
        self.bodies[found.name] = {"mass": 0.0, "inertia": 0.0}
        for name, value in zip(("x", "y"), self.plane.point(body.place), strict=True):
            self.guess[f"{found.name}.{name}"] = value
        return found

    def _mass(self, node: Node, body: Carried, fixed: bool) -> dict[str, Any]:
        every = list(node.each("inertial"))
        found = every[0] if every else None
        for other in every[1:]:
            self.unread.lost(other, "the body has another inertial")
        if found is None and fixed:
            return {"mass": 0.0, "inertia": 0.0}
        if found is None:
            self.unread.lost(node, "it has no inertial; masses from geoms are not read")
            return {"mass": 1.0, "inertia": 1.0}
        given = Given(found, found.attributes, self.unread)
        center = body.turn @ given.numbers("pos", [0, 0, 0], 3)
        turn = body.turn @ self.turn(given)
        if "fullinertia" in given.left:
            xx, yy, zz, xy, xz, yz = given.numbers("fullinertia", np.zeros(6), 6)
            inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        else:
            inertia = np.diag(given.numbers("diaginertia", np.zeros(3), 3))
        mass = given.number("mass")
        given.skip("quat")
        given.rest()
        normal = turn.T @ self.plane.normal
        return {
            "mass": mass,
            "inertia": float(normal @ inertia @ normal),
            "center": self.plane.point(center),
        }

    def _joint(self, node: Node, before: Carried, after: Carried, style: str) -> None:
        given = self.given(node, style)
        name = self.names.new(given.text("name", f"{after.name}_joint"))
        kind = given.text("type", "hinge")
        axis = after.turn @ given.direction("axis", [0, 0, 1], 3)
        axis = axis / np.linalg.norm(axis)
        place = after.at(given.numbers("pos", [0, 0, 0], 3))
        rate = 0.0
        if self.has_rates:
            if not self.rates:
                self.not_fitting("qvel", "joints")
            rate = self.rates.pop(0) if self.rates else 0.0
        spring = given.number("stiffness"), given.number("damping"), given.number("springref")
        given.skip(*_LOOKS, *_SOFT, "margin", "limited" if "range" not in given.left else "")
        given.zero("armature", "frictionloss", "ref")
        given.rest()
        ends = [self.point(body, name, place) for body in (before, after)]
        if kind == "hinge":
            if (sense := self.plane.sense(axis)) == 0:
                self.unread.lost(node, "its axis is not normal to the plane of the motion")
                sense = 1
            self.joints[name] = {"type": "revolute", "i": ends[0], "j": ends[1]}
            move = name, "angle", sense
            self._turns(before, after, place, sense * rate)
        elif kind == "slide":
            if not self.plane.contains(axis):
                self.unread.lost(node, "its axis is not in the plane of the motion")
            x, y = self.plane.point(axis)
            axes = [math.atan2(y, x)] * 2
            self.joints[name] = {"type": "translational", "i": ends[0], "j": ends[1], "axes": axes}
            move = name, "displacement", 1
            self._turns(before, after, after.place, 0.0)
            after.velocity = after.velocity + rate * axis
            self.guess |= self._velocities(after)
        else:
            self.unread.lost(node, f"joints of type {kind} move in space")
            return
        self._new(node, self.moves)
        self.moves[node.attributes.get("name", name)] = move
        self.relaxed &= spring[2] == 0
        if any(spring[:2]):
            self._spring(move, kind, spring)

    def _turns(self, before: Carried, after: Carried, pivot: Floats, rate: float) -> None:
        """The velocity of a body that turns about a pivot of another one, with a relative rate."""
        normal = self.plane.normal
        after.omega = before.omega + rate
        of_pivot = before.velocity + np.cross(before.omega * normal, pivot - before.place)
        after.velocity = of_pivot + np.cross(after.omega * normal, after.place - pivot)
        self.guess |= self._velocities(after)

    def _velocities(self, body: Carried) -> dict[str, float]:
        vx, vy = self.plane.point(body.velocity)
        values = {"angle": 0.0, "vx": vx, "vy": vy, "omega": body.omega}
        return {f"{body.name}.{name}": value for name, value in values.items()}

    def _spring(
        self, move: tuple[str, str, int], kind: str, of: tuple[float, float, float]
    ) -> None:
        """The spring and the damper of a joint."""
        (name, coordinate, sense), (k, c, rest) = move, of
        unit = math.pi / 180 if self.degrees and kind == "hinge" else 1.0
        speed = {"angle": "omega", "displacement": "rate"}[coordinate]
        value = f"-{k!r}*({name}.{coordinate} - ({sense * unit * rest!r})) - {c!r}*{name}.{speed}"
        self.forces[self.names.new(f"{name}_spring")] = {
            "type": "generalized_force",
            "coordinate": f"{name}.{coordinate}",
            "value": value,
        }

    def _weld(self, one: Carried, other: Carried) -> None:
        ends = [self.point(body, "weld", other.place) for body in (one, other)]
        name = self.names.new(f"{other.name}_weld")
        self.joints[name] = {"type": "weld", "i": ends[0], "j": ends[1]}
        self._turns(one, other, other.place, 0.0)

    # --- equations --------------------------------------------------------------------------------

    def _equation(self, node: Node) -> None:
        given = self.given(node)
        name = given.text("name", node.tag)
        given.skip(*_SOFT, "class")
        if not given.flag("active", True):
            self.unread.harmless(node, "it is not active")
            return
        if node.tag not in ("connect", "weld"):
            self.unread.lost(node, "this equation is not supported")
            return
        pair = [self.known.get(given.text(f"body{k}", "world")) for k in (1, 2)]
        one, other = pair
        if one is None or other is None or "body1" not in node.attributes:
            self.unread.lost(node, "it needs body1 and body2 of the file")
            return
        place = one.at(given.numbers("anchor", [0, 0, 0], 3))
        given.skip("torquescale")
        given.rest()
        ends = [self.point(body, name, place) for body in (one, other)]
        kind = "revolute" if node.tag == "connect" else "weld"
        self.joints[self.names.new(name)] = {"type": kind, "i": ends[0], "j": ends[1]}
