"""The settings of a model of MuJoCo: units, options, defaults, and the first key frame."""

from __future__ import annotations

import math

import numpy as np

from kempe.base.arrays import Floats
from kempe.mjcf.attributes import Given, Unread
from kempe.mjcf.space import Plane, of_axis, of_euler, of_quaternion
from kempe.mjcf.xml import Node

#: Sections that do not change the motion.
_SILENT = {"asset", "visual", "statistic", "custom", "sensor", "size"}
#: Attributes of options and equations that concern the numerical method.
_METHOD = (
    *("timestep", "integrator", "solver", "cone", "jacobian", "iterations", "tolerance"),
    *("ls_iterations", "ls_tolerance", "noslip_iterations", "noslip_tolerance", "impratio"),
    *("ccd_iterations", "sdf_iterations", "sdf_initpoints"),
)


class Settings:
    """The settings, and the list of unread parts."""

    def __init__(self, root: Node) -> None:
        self.root, self.unread = root, Unread()
        self.defaults: dict[str, dict[str, dict[str, str]]] = {"main": {}}
        self.gravity = np.array([0.0, 0.0, -9.81])
        self.degrees, self.euler, self.collides, self.limits = True, "xyz", True, True
        for node in root.children:
            self._section(node)
        self.rates, self.controls = self._key()
        self.has_rates, self.has_controls = bool(self.rates), bool(self.controls)
        self.plane = self._plane()

    def given(self, node: Node, style: str = "main") -> Given:
        """The attributes of an element with those of its default class."""
        name = node.attributes.get("class", style)
        if name not in self.defaults:
            self.unread.lost(node, f"there is no default class {name!r}")
        own = self.defaults.get(name, {}).get(node.tag, {})
        return Given(node, own | node.attributes, self.unread)

    def _section(self, node: Node) -> None:
        if node.tag == "compiler":
            given = Given(node, node.attributes, self.unread)
            self.degrees = given.text("angle", "degree") != "radian"
            self.euler = given.text("eulerseq", "xyz")
            if len(self.euler) != 3 or not set(self.euler.lower()) <= set("xyz"):
                self.unread.lost(node, f"eulerseq={self.euler!r} is not three of the axes x, y, z")
                self.euler = "xyz"
            self.limits = given.flag("autolimits", True)
            given.skip("meshdir", "texturedir", "assetdir", "strippath", "usethread")
            given.rest()
        elif node.tag == "option":
            self._option(node)
        elif node.tag == "default":
            name = node.attributes.get("class", "main")
            self._default(node, self.defaults.get(name, {}), name)
        elif node.tag == "keyframe":
            for key in list(node.each("key"))[1:]:
                self.unread.harmless(key, "only the first key is the start")
        elif node.tag == "contact":
            self.unread.harmless(node, "contacts are not read")
        elif node.tag not in _SILENT | {"worldbody", "equality", "tendon", "actuator"}:
            self.unread.lost(node, "this section is not supported")

    def _option(self, node: Node) -> None:
        given = Given(node, node.attributes, self.unread)
        self.gravity = given.numbers("gravity", self.gravity, 3)
        given.skip(*_METHOD)
        given.zero("wind", "density", "viscosity")
        given.rest()
        for flag in node.each("flag"):
            for name, value in flag.attributes.items():
                if (name, value) == ("contact", "disable"):
                    self.collides = False
                elif (name, value) == ("gravity", "disable"):
                    self.gravity = np.zeros(3)
                elif name not in ("warmstart", "filterparent", "energy", "fwdinv", "eulerdamp"):
                    self.unread.lost(flag, f"{name}={value!r} is not supported")

    def _default(self, node: Node, above: dict[str, dict[str, str]], name: str) -> None:
        own = {tag: dict(values) for tag, values in above.items()}
        for child in node.children:
            if child.tag != "default":
                own[child.tag] = own.get(child.tag, {}) | child.attributes
        self.defaults[name] = own
        for child in node.each("default"):
            self._default(child, own, child.attributes.get("class", ""))

    def _key(self) -> tuple[list[float], list[float]]:
        """Rates and controls of the first key frame."""
        for section in self.root.each("keyframe"):
            for node in section.each("key"):
                given = Given(node, node.attributes, self.unread)
                given.skip("name", "time")
                given.zero("qpos", "act")
                found = list(given.numbers("qvel", [])), list(given.numbers("ctrl", []))
                given.rest()
                return found
        return [], []

    def _plane(self) -> Plane:
        """The plane normal to the first hinge."""
        vertical = Plane(np.eye(3)[0], np.eye(3)[2])
        for world in self.root.each("worldbody"):
            found = self._first_hinge(world, np.eye(3), "main")
            if found is not None:
                node, axis = found
                plane = Plane.across(axis)
                if plane is None:
                    self.unread.lost(node, "its axis is not an axis of the world frame")
                return plane or vertical
        return vertical

    def _first_hinge(self, parent: Node, turn: Floats, style: str) -> tuple[Node, Floats] | None:
        for node in parent.each("body"):
            own = turn @ self.turn(Given(node, node.attributes, Unread()))
            inner = node.attributes.get("childclass", style)
            for joint in node.each("joint"):
                given = Given(joint, self.given(joint, inner).left, Unread())
                if given.text("type", "hinge") == "hinge":
                    axis = given.direction("axis", [0, 0, 1], 3)
                    return joint, own @ (axis / np.linalg.norm(axis))
            found = self._first_hinge(node, own, inner)
            if found is not None:
                return found
        return None

    def turn(self, given: Given) -> Floats:
        """The rotation of a frame within another one."""
        unit = math.pi / 180 if self.degrees else 1.0
        if "quat" in given.left:
            return of_quaternion(given.direction("quat", [1, 0, 0, 0], 4))
        if "axisangle" in given.left:
            *axis, angle = given.direction("axisangle", [0, 0, 1, 0], 4, 3)
            return of_axis(np.array(axis), unit * float(angle))
        if "euler" in given.left:
            return of_euler(unit * given.numbers("euler", [0, 0, 0], 3), self.euler)
        for name in ("xyaxes", "zaxis"):
            if name in given.left:
                given.unread.lost(given.node, f"{name} is not supported; write quat")
                given.skip(name)
        return np.eye(3)
