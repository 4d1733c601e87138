"""MuJoCo: a tree of hinges; the joints that close loops are `connect` equalities.

Equalities are soft; their time constant is twice the step, the stiffest that MuJoCo accepts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from problems.planar import GROUND, Motion, Pair, Problem

from peers.setting import Setting, affordable, not_installed

NAME = "mujoco"
TRIED = (
    "on flagship and squeezer: RK4, Euler, implicit and implicitfast; Newton, CG and PGS; "
    "solref time constants of 2 h and of the default 0.02 s; impedance 0.9999 and the "
    "default; dense and sparse. RK4 with Newton, 2 h and 0.9999 is shown: Euler and the "
    "implicit ones cost a third of it at the same step with 1 000 and more times its error"
)
CURVE = "MuJoCo RK4"


def missing() -> str | None:
    """The reason if MuJoCo cannot be used."""
    return not_installed("mujoco")


def version() -> str:
    """Version of MuJoCo."""
    import mujoco

    return str(mujoco.__version__)


def settings(problem: Problem, quick: bool = False) -> list[Setting]:
    """One curve over the steps of the problem."""
    steps = affordable(problem, quick)
    return [Setting(CURVE, step, {"integrator": "RK4", "solver": "Newton"}) for step in steps]


class Tree:
    """The joints of the tree, and the joints that close loops."""

    def __init__(self, problem: Problem) -> None:
        self.parent: dict[int, tuple[int, Pair]] = {}
        self.order: list[int] = []
        waiting = list(problem.joints)
        depth = {GROUND: 0}
        # nearest to ground first: the trees stay shallow, and springs to ground act on hinges
        while hung := [e for e in waiting if (e.i in depth) != (e.j in depth)]:
            e = min(hung, key=lambda e: depth.get(e.i, depth.get(e.j, 0)))
            parent, child, s = (e.i, e.j, e.s_j) if e.i in depth else (e.j, e.i, e.s_i)
            self.parent[child] = (parent, s)
            self.order.append(child)
            depth[child] = depth[parent] + 1
            waiting.remove(e)
        self.loops = waiting
        if any(self.parent[t.j][0] != GROUND for t in problem.torsion_springs):
            raise ValueError(
                "a torsion spring's body must be pinned to ground: the hinge carries it"
            )


def seen_from(problem: Problem, body: int, parent: int) -> tuple[float, float, float]:
    """Initial position and angle of a body in the frame of its parent."""
    x, y, angle = problem.bodies[body].q
    if parent == GROUND:
        return x, y, angle
    px, py, turn = problem.bodies[parent].q
    c, s = np.cos(turn), np.sin(turn)
    dx, dy = x - px, y - py
    return c * dx + s * dy, -s * dx + c * dy, angle - turn


def rates(problem: Problem, tree: Tree) -> list[float]:
    """Rates of the hinges at the start."""
    omega = {GROUND: 0.0, **{k: body.v[2] for k, body in enumerate(problem.bodies)}}
    return [omega[k] - omega[tree.parent[k][0]] for k in tree.order]


def xml(problem: Problem, tree: Tree, step: float, options: Any) -> str:
    """The mechanism in MuJoCo's XML format, with all digits."""
    children: dict[int, list[int]] = {}
    for child in tree.order:
        children.setdefault(tree.parent[child][0], []).append(child)
    sites: dict[int, str] = {}
    for k, spring in enumerate(problem.springs):
        for side, body, s in (("i", spring.i, spring.s_i), ("j", spring.j, spring.s_j)):
            site = f'<site name="{side}{k}" pos="{s[0]!r} {s[1]!r} 0"/>'
            sites[body] = sites.get(body, "") + site

    def element(k: int) -> str:
        parent, s = tree.parent[k]
        x, y, angle = map(float, seen_from(problem, k, parent))
        body = problem.bodies[k]
        spring = ""
        for t in problem.torsion_springs:
            if t.j == k:
                free = float(t.free_angle - body.q[2])
                spring = f'stiffness="{t.stiffness!r}" damping="{t.damping!r}" springref="{free!r}"'
        half = 0.5 * angle
        return (
            f'<body name="{body.name}" pos="{x!r} {y!r} 0"'
            f' quat="{float(np.cos(half))!r} 0 0 {float(np.sin(half))!r}">'
            f'<inertial pos="0 0 0" mass="{body.mass!r}"'
            f' diaginertia="{body.inertia!r} {body.inertia!r} {body.inertia!r}"/>'
            f'<joint name="h{k}" axis="0 0 1" pos="{s[0]!r} {s[1]!r} 0" {spring}/>'
            + sites.get(k, "")
            + "".join(map(element, children.get(k, [])))
            + "</body>"
        )

    equalities = ""
    for e in tree.loops:
        first, second, s = (e.j, e.i, e.s_j) if e.i == GROUND else (e.i, e.j, e.s_i)
        name = f'body1="{problem.bodies[first].name}"'
        if second != GROUND:
            name += f' body2="{problem.bodies[second].name}"'
        equalities += (
            f'<connect {name} anchor="{s[0]!r} {s[1]!r} 0" solref="{2 * step!r} 1"'
            ' solimp="0.9999 0.9999 0.001 0.5 2"/>'
        )
    tendons = "".join(
        f'<spatial springlength="{s.free_length!r}" stiffness="{s.stiffness!r}">'
        f'<site site="i{k}"/><site site="j{k}"/></spatial>'
        for k, s in enumerate(problem.springs)
    )
    roots = "".join(map(element, children.get(GROUND, [])))
    return (
        '<mujoco><compiler angle="radian" boundmass="0" boundinertia="0"/>'
        f'<option timestep="{step!r}" gravity="0 {-problem.gravity!r} 0" tolerance="1e-14"'
        f' integrator="{options["integrator"]}" solver="{options["solver"]}">'
        '<flag contact="disable"/></option>'
        f"<worldbody>{sites.get(GROUND, '')}{roots}</worldbody>"
        f"<equality>{equalities}</equality><tendon>{tendons}</tendon></mujoco>"
    )


def prepare(problem: Problem, setting: Setting) -> Callable[[], Any]:
    """A run: the angles of the hinges on the grid."""
    import mujoco

    tree = Tree(problem)
    model = mujoco.MjModel.from_xml_string(xml(problem, tree, setting.tolerance, setting.options))
    data = mujoco.MjData(model)
    hinges = [model.jnt_dofadr[model.joint(f"h{k}").id] for k in tree.order]
    inner = round(problem.output_step / setting.tolerance)
    rows = len(problem.grid)
    start = rates(problem, tree)

    def run() -> np.ndarray:
        mujoco.mj_resetData(model, data)
        data.qvel[hinges] = start
        for torque in problem.torques:
            data.xfrc_applied[model.body(problem.bodies[torque.j].name).id, 5] = torque.torque
        angles = np.empty((rows, len(hinges)))
        angles[0] = data.qpos[hinges]
        for row in range(1, rows):
            mujoco.mj_step(model, data, nstep=inner)
            angles[row] = data.qpos[hinges]
        return angles

    return run


def motion(problem: Problem, angles: np.ndarray) -> Motion:
    """Positions of the bodies, from the angles of the hinges along the tree."""
    tree = Tree(problem)
    q = np.empty((len(angles), len(problem.bodies), 3))
    for column, k in enumerate(tree.order):
        parent, s = tree.parent[k]
        x, y, turn = seen_from(problem, k, parent)
        base = np.zeros((len(angles), 3)) if parent == GROUND else q[:, parent]
        # the hinge is fixed on the parent; the body rotates about it
        c, si = np.cos(turn), np.sin(turn)
        hinge = (x + c * s[0] - si * s[1], y + si * s[0] + c * s[1])
        angle = base[:, 2] + turn + angles[:, column]
        cp, sp = np.cos(base[:, 2]), np.sin(base[:, 2])
        ca, sa = np.cos(angle), np.sin(angle)
        q[:, k, 0] = base[:, 0] + cp * hinge[0] - sp * hinge[1] - ca * s[0] + sa * s[1]
        q[:, k, 1] = base[:, 1] + sp * hinge[0] + cp * hinge[1] - sa * s[0] - ca * s[1]
        q[:, k, 2] = angle
    return Motion(problem.grid, q)
