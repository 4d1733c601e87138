"""``kp.write_mjcf``: a mechanism as a model of MuJoCo."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from kempe.base import files
from kempe.base.arguments import explained
from kempe.errors import ModelError
from kempe.mjcf.trees import GROUND, Branch, spanning_tree
from kempe.model.constants import constant
from kempe.model.infos import BodyInfo, ConstraintInfo, ForceInfo
from kempe.results.state import State

#: x and y of kempe are x and z of MuJoCo, so that z is up; an angle turns about -y.
_AXIS = (0.0, -1.0, 0.0)
#: Stiff equations: the impedance is almost 1, and the time constant twice the step.
_SOLIMP = "0.9999 0.9999 0.001 0.5 2"
#: Fields of forces that are written.
_FIELDS = {
    "torsion_spring": {"stiffness", "damping", "free_angle", "preload"},
    "spring_damper": {"stiffness", "damping", "free_length", "preload"},
    "torque": {"torque"},
}
_PLACES = {"type", "i", "j"}


@explained
def write_mjcf(state: State, path: Path | str, *, timestep: float = 1e-4) -> Path:
    """Write a mechanism as a model of MuJoCo (MJCF).

    The state is the start: zero joint angles and zero displacements. The plane is vertical, with x
    along x and y along z. Bodies are within the bodies that carry them; pins that close loops are
    equations of the type ``connect``. Springs and constant torques are actuators. The key frame
    ``start`` contains rates and torques: ``mujoco.mj_resetDataKeyframe(model, data, 0)``.

    MuJoCo holds its equations approximately. Their gaps, and with them the difference to kempe,
    become smaller with ``timestep``.

    Args:
        state: the state, from ``kp.assemble``, ``case.start()`` or a solution.
        path: the file; its name should end in ``.xml``.
        timestep: the step of MuJoCo, s; equations have twice this time constant.

    Raises:
        ModelError: the model contains an element that MJCF cannot describe, a law that is not
            constant, or a body without mass.
        FileError: the file cannot be written.
    """
    if not isinstance(state, State):
        raise ModelError(f"{state!r} is not a state", hint="kp.assemble(…) returns one")
    if not (isinstance(timestep, int | float) and 0 < timestep < math.inf):
        raise ModelError(f"timestep = {timestep!r}; must be positive, in s")
    root = _Writer(state, float(timestep)).root()
    ET.indent(root)
    target = files.checked_path(path, "write")
    files.write_text(target, ET.tostring(root, encoding="unicode") + "\n")
    return target


def _texts(*numbers: float) -> str:
    return " ".join(repr(float(number) + 0.0) for number in numbers)


def _in_space(x: float, y: float) -> str:
    return _texts(x, 0.0, y)


class _Writer:
    """The parts of a file. Frames of bodies are parallel to those of the world at the start."""

    def __init__(self, state: State, timestep: float) -> None:
        self.state, self.model = state, state.compiled
        self.timestep = timestep
        bodies, joints = self.model.bodies, self._joints()
        for body in bodies.values():
            self._check_mass(body)
        self.tree, self.closing = spanning_tree(list(bodies), joints)
        #: The hinges from ground to each body.
        self.hinges: dict[str, list[str]] = {GROUND: []}
        #: Rates of the joints in the order of MuJoCo.
        self.rates: list[float] = []
        self.controls: list[float] = []

    def _joints(self) -> Mapping[str, ConstraintInfo]:
        for info in self.model.constraints.values():
            if info.group != "joints" or info.type not in ("revolute", "translational", "weld"):
                what = "drivers" if info.group != "joints" else f"joints of type {info.type}"
                raise ModelError(
                    f"{info.name}: {what} cannot be written as MJCF",
                    name=info.name,
                    hint="revolute, translational and weld joints can be",
                )
        return {info.name: info for info in self.model.constraints.values()}

    def _check_mass(self, body: BodyInfo) -> None:
        if body.mass <= 0 or (body.turns and body.inertia <= 0):
            what = "mass" if body.mass <= 0 else "moment of inertia"
            raise ModelError(
                f"{body.name}: a moving body without {what} cannot be written as MJCF",
                name=body.name,
                hint="give it a small one",
            )

    def root(self) -> ET.Element:
        root = ET.Element("mujoco", model=self.model.title or "mechanism")
        ET.SubElement(root, "compiler", angle="radian", autolimits="true")
        gx, gy = self.model.gravity
        ET.SubElement(
            root,
            "option",
            timestep=_texts(self.timestep),
            gravity=_in_space(gx, gy),
            integrator="RK4",
        )
        world = ET.SubElement(root, "worldbody")
        self._points(world, GROUND)
        for child in self.tree.children:
            self._body(world, GROUND, child)
        if self.closing:
            equality = ET.SubElement(root, "equality")
            for joint in self.closing:
                self._connect(equality, joint)
        if self.model.forces:
            tendons, actuators = ET.SubElement(root, "tendon"), ET.SubElement(root, "actuator")
            for force in self.model.forces.values():
                self._force(tendons, actuators, world, force)
        key = {"name": "start", "qvel": _texts(*self.rates)}
        if self.controls:
            key["ctrl"] = _texts(*self.controls)
        ET.SubElement(ET.SubElement(root, "keyframe"), "key", key)
        return root

    # --- places -----------------------------------------------------------------------------------

    def _origin(self, body: str) -> tuple[float, float]:
        return (0.0, 0.0) if body == GROUND else (self.state[f"{body}.x"], self.state[f"{body}.y"])

    def _angle(self, body: str) -> float:
        turns = body != GROUND and self.model.bodies[body].turns
        return float(self.state[f"{body}.angle"]) if turns else 0.0

    def _omega(self, body: str) -> float:
        turns = body != GROUND and self.model.bodies[body].turns
        return float(self.state[f"{body}.omega"]) if turns else 0.0

    def _turned(self, body: str, point: Sequence[float]) -> tuple[float, float]:
        """A point of a body in a frame that is parallel to the world."""
        c, s = math.cos(self._angle(body)), math.sin(self._angle(body))
        return c * point[0] - s * point[1], s * point[0] + c * point[1]

    def _points(self, parent: ET.Element, body: str) -> None:
        for name, place in self.model.all_bodies[body].points.items():
            at = _in_space(*self._turned(body, place))
            ET.SubElement(parent, "site", name=f"{body}.{name}", pos=at)

    # --- bodies and joints ------------------------------------------------------------------------

    def _body(self, parent: ET.Element, carrier: str, branch: Branch) -> None:
        body, (x, y), (x0, y0) = branch.name, self._origin(branch.name), self._origin(carrier)
        info = self.model.bodies[body]
        own = ET.SubElement(parent, "body", name=body, pos=_in_space(x - x0, y - y0))
        inertia = info.inertia if info.turns else info.mass  # that of a point mass does not matter
        ET.SubElement(
            own,
            "inertial",
            pos=_in_space(*self._turned(body, info.center)),
            mass=_texts(info.mass),
            diaginertia=_texts(inertia, inertia, inertia),
        )
        self.hinges[body] = list(self.hinges[carrier])
        if branch.joint is None:
            self._free(own, body)
        else:
            self._carried(own, carrier, branch.joint, body)
        self._points(own, body)
        for child in branch.children:
            self._body(own, body, child)

    def _free(self, own: ET.Element, body: str) -> None:
        """Joints that leave a body free in the plane."""
        for name, axis in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
            at = {"name": f"{body}.{name}", "type": "slide", "axis": _in_space(*axis)}
            ET.SubElement(own, "joint", at)
            self.rates.append(float(self.state[f"{body}.v{name}"]))
        if self.model.bodies[body].turns:
            name = f"{body}.angle"
            ET.SubElement(own, "joint", name=name, type="hinge", axis=_texts(*_AXIS))
            self.rates.append(self._omega(body))
            self.hinges[body].append(name)

    def _carried(self, own: ET.Element, carrier: str, joint: ConstraintInfo, body: str) -> None:
        """The joint between a body and the one that carries it."""
        is_j = joint.bodies[1] == body
        at = joint.point_j if is_j else joint.point_i
        if joint.type == "revolute":
            place = _in_space(*self._turned(body, at))
            attributes = {"name": joint.name, "type": "hinge", "pos": place}
            ET.SubElement(own, "joint", attributes, axis=_texts(*_AXIS))
            self.rates.append(self._omega(body) - self._omega(carrier))
            self.hinges[body].append(joint.name)
        elif joint.type == "translational":
            direction = self._angle(body) + (joint.axis_j if is_j else joint.axis_i)
            axis = math.cos(direction), math.sin(direction)
            ET.SubElement(own, "joint", name=joint.name, type="slide", axis=_in_space(*axis))
            (x, y), (x0, y0) = self._origin(body), self._origin(carrier)
            vx, vy = self._velocity(body)
            vx0, vy0 = self._velocity(carrier)
            omega = self._omega(carrier)
            slides = (vx - vx0 + omega * (y - y0), vy - vy0 - omega * (x - x0))
            self.rates.append(slides[0] * axis[0] + slides[1] * axis[1])

    def _velocity(self, body: str) -> tuple[float, float]:
        if body == GROUND:
            return 0.0, 0.0
        return float(self.state[f"{body}.vx"]), float(self.state[f"{body}.vy"])

    def _connect(self, equality: ET.Element, joint: ConstraintInfo) -> None:
        """A pin that closes a loop. Its first body moves."""
        one, other = joint.bodies
        point = joint.point_i
        if one == GROUND:
            one, other, point = other, one, joint.point_j
        attributes = {"name": joint.name, "body1": one}
        attributes |= {} if other == GROUND else {"body2": other}
        ET.SubElement(
            equality,
            "connect",
            attributes,
            anchor=_in_space(*self._turned(one, point)),
            solref=_texts(2 * self.timestep, 1.0),
            solimp=_SOLIMP,
        )

    # --- forces -----------------------------------------------------------------------------------

    def _force(
        self, tendons: ET.Element, actuators: ET.Element, world: ET.Element, force: ForceInfo
    ) -> None:
        known = _FIELDS.get(force.type)
        if known is None:
            raise ModelError(
                f"{force.name}: {force.type} cannot be written as MJCF",
                name=force.name,
                hint=f"{', '.join(_FIELDS)} can be",
            )
        entry = self.model.tree["forces"][force.name]
        if other := set(entry) - known - _PLACES:
            raise ModelError(
                f"{force.name}: {min(other)} cannot be written as MJCF", name=force.name
            )
        value = {
            key: constant(self.model, f"{force.name}.{key}", entry.get(key, 0.0), "MJCF")
            for key in known
        }
        if force.type == "spring_damper":
            self._line(tendons, world, force)
        else:
            self._relative_angle(tendons, force)
        self._actuator(actuators, force, value)

    def _actuator(
        self, actuators: ET.Element, force: ForceInfo, value: Mapping[str, float]
    ) -> None:
        attributes = {"name": force.name, "tendon": force.name}
        if force.type == "torque":
            ET.SubElement(actuators, "motor", attributes)
            self.controls.append(value["torque"])
            return
        free = value.get("free_length", 0.0)
        if force.type == "torsion_spring":
            free = value["free_angle"] - float(self.state[f"{force.name}.angle"])
        k, c = value["stiffness"], value["damping"]
        ET.SubElement(
            actuators,
            "general",
            attributes,
            gainprm="0 0 0",
            biastype="affine",
            biasprm=_texts(k * free - value["preload"], -k, -c),
        )
        self.controls.append(0.0)

    def _relative_angle(self, tendons: ET.Element, force: ForceInfo) -> None:
        """The angle of body j relative to body i since the start, as a sum of joint angles."""
        signs = dict.fromkeys(self.hinges[force.bodies[-1]], 1)
        for name in self.hinges[force.bodies[0]] if len(force.bodies) > 1 else ():
            signs[name] = signs.get(name, 0) - 1
        if not any(signs.values()):
            raise ModelError(
                f"{force.name}: its bodies do not turn relative to each other", name=force.name
            )
        fixed = ET.SubElement(tendons, "fixed", name=force.name)
        for name, sign in signs.items():
            if sign:
                ET.SubElement(fixed, "joint", joint=name, coef=str(sign))

    def _line(self, tendons: ET.Element, world: ET.Element, force: ForceInfo) -> None:
        """The line between two points, with a site at each."""
        assert force.points is not None
        spatial = ET.SubElement(tendons, "spatial", name=force.name)
        for end, body, point in zip(("i", "j"), force.bodies, force.points, strict=True):
            name = f"{force.name}.{end}"
            at = _in_space(*self._turned(body, point))
            owner = next((b for b in world.iter("body") if b.get("name") == body), world)
            ET.SubElement(owner, "site", name=name, pos=at)
            ET.SubElement(spatial, "site", site=name)
