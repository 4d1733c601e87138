"""A spanning tree: MuJoCo has bodies within bodies, and equations for the other joints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from kempe.errors import ModelError
from kempe.model.infos import ConstraintInfo

GROUND = "ground"
#: Joints of a tree in the order of choice: MuJoCo has no exact equation for a slide.
TREE = ("translational", "weld", "revolute")


@dataclass
class Branch:
    """A body in the tree.

    Attributes:
        name: the body.
        joint: the joint that carries it; None for a body that is free in the plane.
        children: the bodies that it carries.
    """

    name: str
    joint: ConstraintInfo | None
    children: list[Branch] = field(default_factory=list)

    def walk(self) -> Iterator[tuple[str, Branch]]:
        """All branches above this one, each after the body that carries it, with its name."""
        for child in self.children:
            yield self.name, child
            yield from child.walk()


def spanning_tree(
    bodies: list[str], joints: Mapping[str, ConstraintInfo]
) -> tuple[Branch, list[ConstraintInfo]]:
    """The tree from ground, and the pins that close its loops.

    Raises:
        ModelError: a slide or a weld closes a loop, for which MuJoCo has no exact equation.
    """
    group = {name: name for name in (GROUND, *bodies)}

    def root(name: str) -> str:
        while group[name] != name:
            name = group[name]
        return name

    neighbours: dict[str, list[tuple[str, ConstraintInfo]]] = {name: [] for name in group}
    closing = []
    for kind in TREE:
        for joint in (joint for joint in joints.values() if joint.type == kind):
            i, j = joint.bodies
            if root(i) == root(j):
                closing.append(joint)
                continue
            group[root(i)] = root(j)
            neighbours[i].append((j, joint))
            neighbours[j].append((i, joint))
    for joint in closing:
        if joint.type != "revolute":
            raise ModelError(
                f"{joint.name}: this {joint.type} joint closes a loop, which MJCF cannot describe",
                name=joint.name,
                hint="close the loop at a revolute joint",
            )
    top, seen = Branch(GROUND, None), {GROUND}
    _grow(top, neighbours, seen)
    for name in bodies:
        if name not in seen:
            free = Branch(name, None)
            seen.add(name)
            top.children.append(free)
            _grow(free, neighbours, seen)
    return top, closing


def _grow(
    top: Branch, neighbours: Mapping[str, list[tuple[str, ConstraintInfo]]], seen: set[str]
) -> None:
    """Add all bodies that joints connect to a branch."""
    waiting = [top]
    while waiting:
        branch = waiting.pop()
        for name, joint in neighbours[branch.name]:
            if name not in seen:
                seen.add(name)
                branch.children.append(Branch(name, joint))
                waiting.append(branch.children[-1])
