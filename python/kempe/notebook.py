"""Objects in notebooks: a drawing and tables as HTML."""

from __future__ import annotations

import warnings

from kempe.analyses.assembly import assemble
from kempe.base.html import block, paragraph, table
from kempe.errors import KempeError
from kempe.model.model import Model
from kempe.plot import style
from kempe.plot.mechanism import mechanism
from kempe.results.solution import Solution
from kempe.results.state import State

#: Width of a drawing, pixels.
_WIDTH = 480


def html(of: Model | State | Solution) -> str:
    """What a notebook shows of an object: a block of HTML."""
    if isinstance(of, Model):
        return of_model(of)
    return of_state(of) if isinstance(of, State) else of_solution(of)


def of_model(model: Model) -> str:
    """Drawing of the assembled mechanism, and its bodies and elements."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            picture = drawing(assemble(model))
        bodies = [
            (str(body.number), body.name, body.type, f"{body.mass:.6g}", f"{body.inertia:.6g}")
            for body in model.bodies.values()
        ]
    except KempeError as error:  # a model that is not finished
        return block(model.title, paragraph(repr(model)), paragraph(str(error)))
    tables = [table(("", "body", "type", "mass / kg", "inertia / kg·m²"), bodies)]
    rows = [(joint.name, joint.type, joint.i, joint.j) for joint in model.constraints.values()]
    rows += [(force.name, force.type, force.i, force.j) for force in model.forces.values()]
    if rows:
        tables.append(table(("element", "type", "body i", "body j"), rows))
    return block(model.title, picture, *tables)


def of_state(state: State) -> str:
    """Drawing of the mechanism in a state, and the motion of its bodies."""
    header, rows = state.table()
    caption = f"{state.compiled.title}, t = {state.t:g} s"
    unset = "" if state.report is None else str(state.report.unset)
    told = [paragraph(unset)] if unset else []
    return block(caption, drawing(state), table(header, rows), *told)


def of_solution(solution: Solution) -> str:
    """Drawing of the last state, and the extent, cost and accuracy of a run."""
    of = solution.variable
    rows = [
        (
            "time" if of.is_time else of.name,
            f"{solution.t[0]:g} to {solution.t[-1]:g} {of.unit}, {len(solution.t)} outputs",
        ),
        ("end", solution.message),
        ("method", f"{solution.statistics['method']}, {solution.statistics['steps']} steps"),
        ("largest opening of a joint", f"{solution.drift.position.max(initial=0.0):.3g} m or rad"),
    ]
    picture = drawing(solution.final) if len(solution.t) else ""
    return block(solution.compiled.title, picture, table(("", ""), rows))


def drawing(state: State) -> str:
    """The mechanism as an SVG picture; empty if it has no bodies."""
    if not state.compiled.bodies:
        return ""
    with style.applied():
        figure = style.figure(style.WIDTH * 0.6)
        mechanism(state, ax=figure.add_subplot())
    return style.svg(figure).replace(
        "<svg ", f'<svg style="display: block; max-width: {_WIDTH}px" ', 1
    )
