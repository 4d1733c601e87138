"""kempe, called from Python, with the list of its settings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import kempe as kp
import numpy as np
from problems.planar import GROUND, Motion, Pair, Problem

from peers.setting import Setting

NAME = "kempe"
TRIED = (
    "RK45 with Baumgarte (the gains of the problem) and DOP853 with projection, rtol 1e-3 … 1e-11,"
    " atol a thousandth of rtol; and the defaults; with accelerations and multipliers, except where"
    " marked states"
)
#: The curve of the defaults: one point, marked in the plots.
DEFAULT = "kempe default"
BAUMGARTE = "kempe RK45, Baumgarte"
PROJECTION = "kempe DOP853, projection"
#: The curve of the default method and stabilization at various tolerances.
DEFAULT_METHOD = PROJECTION
#: The same with positions and velocities only, as in other tools.
STATES = {DEFAULT: f"{DEFAULT}, states", PROJECTION: f"{PROJECTION}, states"}
TOLERANCES = (1e-3, 1e-4, 5e-5, 2e-5, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11)
FEW = (1e-3, 1e-6)


def missing() -> str | None:
    """None: it can always be used."""
    return None


def version() -> str:
    """Version of kempe."""
    return kp.__version__


def settings(problem: Problem, quick: bool = False) -> list[Setting]:
    """Curves of kempe."""
    alpha, beta = problem.gains
    found = [Setting(DEFAULT, 0.0)]
    for rtol in FEW if quick else TOLERANCES:
        tolerances = {"rtol": rtol, "atol": 1e-3 * rtol}
        rk45 = {
            "method": kp.RK45(**tolerances),
            "stabilization": kp.Baumgarte(alpha=alpha, beta=beta),
        }
        dop853 = {"method": kp.DOP853(**tolerances), "stabilization": kp.Projection()}
        found += [Setting(BAUMGARTE, rtol, rk45), Setting(PROJECTION, rtol, dop853)]
    if problem.name == "flagship":
        both = [setting for setting in found if setting.curve in STATES]
        found += [replace(setting, curve=STATES[setting.curve]) for setting in both]
    return found


def build(problem: Problem) -> kp.Model:
    """The mechanism as a model."""
    model = kp.Model(problem.name, gravity=(0, -problem.gravity))
    names = {GROUND: "ground", **{k: body.name for k, body in enumerate(problem.bodies)}}
    points: dict[int, dict[str, Pair]] = {k: {} for k in names}

    def point(body: int, s: Pair) -> str:
        mine = points[body]
        known = [name for name, at in mine.items() if at == s]
        name = known[0] if known else f"P{len(mine)}"
        mine[name] = s
        return f"{names[body]}.{name}"

    ends = [(point(e.i, e.s_i), point(e.j, e.s_j)) for e in (*problem.joints, *problem.springs)]
    model.ground.points(**points[GROUND])
    for k, body in enumerate(problem.bodies):
        model.body(body.name, mass=body.mass, inertia=body.inertia, points=points[k])
    for k, (i, j) in enumerate(ends[: len(problem.joints)]):
        model.revolute(f"joint{k}", i, j)
    for k, (spring, (i, j)) in enumerate(
        zip(problem.springs, ends[len(problem.joints) :], strict=True)
    ):
        numbers = {"stiffness": spring.stiffness, "free_length": spring.free_length}
        model.spring_damper(f"spring{k}", i, j, **numbers)
    for k, torsion in enumerate(problem.torsion_springs):
        model.torsion_spring(
            f"torsion{k}",
            "ground",
            names[torsion.j],
            stiffness=torsion.stiffness,
            damping=torsion.damping,
            free_angle=torsion.free_angle,
        )
    for k, torque in enumerate(problem.torques):
        model.torque(f"torque{k}", names[torque.j], torque=torque.torque)
    return model


def prepare(problem: Problem, setting: Setting) -> Callable[[], Any]:
    """A run: states on the grid, with accelerations and multipliers unless states are enough."""
    model = build(problem).compile()
    start = kp.State(model=model, t=0.0, q=problem.q0, v=problem.v0)

    states = setting.curve in STATES.values()

    def run() -> kp.Solution:
        solution = kp.dynamics(
            model,
            start,
            t_end=problem.t_end,
            output_step=problem.output_step,
            dense_output=False,
            **setting.options,
        )
        if not states:  # computed on first access
            _ = solution.a, solution.lam
        return solution

    return run


def motion(problem: Problem, solution: kp.Solution) -> Motion:
    """The motion of a run."""
    return Motion(np.asarray(solution.t), solution.q.reshape(-1, len(problem.bodies), 3))
