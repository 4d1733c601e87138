"""Objects in notebooks: a drawing and tables as HTML."""

from __future__ import annotations

import warnings
from html import escape

from numpy import isfinite, nanmax, nanmean, nanmin

from kempe.analyses.assembly import assemble
from kempe.base.html import block, paragraph, table
from kempe.draw.animate import inline
from kempe.errors import KempeError
from kempe.model.model import Model
from kempe.plot import style
from kempe.plot.mechanism import mechanism
from kempe.plot.result_pages import result_pages
from kempe.results.matrices.values import Matrices
from kempe.results.result import Result
from kempe.results.solution import Solution
from kempe.results.state import State
from kempe.sweeps.gradients.result import Gradient
from kempe.sweeps.result import SweepResult

#: Width of a drawing, pixels.
_WIDTH = 480
#: Largest number of columns of a printed Jacobian, and of rows of a sweep.
_WIDEST, _MOST_VARIANTS = 24, 10


def html(of: Model | State | Solution | Result | Matrices | SweepResult | Gradient) -> str:
    """What a notebook shows of an object: a block of HTML."""
    if isinstance(of, Model):
        return of_model(of)
    if isinstance(of, State):
        return of_state(of)
    if isinstance(of, Matrices):
        return of_matrices(of)
    if isinstance(of, SweepResult):
        return of_sweep(of)
    if isinstance(of, Gradient):
        return of_gradient(of)
    return of_solution(of) if isinstance(of, Solution) else of_result(of)


def of_model(model: Model) -> str:
    """Drawing of the assembled mechanism, and its bodies and elements."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            picture = drawing(assemble(model))
        bodies = [
            (
                str(body.shown_number),
                body.name,
                body.type,
                f"{body.mass:.6g}",
                f"{body.inertia:.6g}" if body.has_inertia else "–",
            )
            for body in model.compile().shown_bodies.values()
        ]
    except KempeError as error:  # a model that is not finished
        return block(model.title, paragraph(repr(model)), paragraph(str(error)))
    tables = [table(("", "body", "type", "mass / kg", "inertia / kg·m²"), bodies)]
    rows = [(joint.name, joint.type, joint.i, joint.j) for joint in model.constraints.values()]
    rows += [
        (force.name, force.type, force.i, force.j)
        for force in model.compile().shown_forces.values()
    ]
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
    """The player of a motion, and the extent, cost and accuracy of a run."""
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
    if not len(solution.t) or not solution.compiled.bodies:
        return block(solution.compiled.title, table(("", ""), rows))
    last = f"<details><summary>last position</summary>{drawing(solution.final)}</details>"
    player = inline(solution)._repr_html_() if len(solution.t) > 1 else ""
    return block(solution.compiled.title, player, table(("", ""), rows), last)


def of_result(result: Result) -> str:
    """The first figure of a result that is not a motion, its report, and its first table."""
    parts = [f"<pre>{escape(str(result))}</pre>"]
    pages = result_pages(result)
    if pages:
        parts.append(style.svg(pages[0].figure()))
    for name, columns in list(result.tables().items())[:1]:
        values = zip(*(column.values.tolist() for column in columns), strict=True)
        rows = ([f"{value:.6g}" for value in row] for row in values)
        parts.append(table([column.label for column in columns], rows))
        parts.append(paragraph(f"result.tables() has {name}"))
    return block(result.kind, *parts)


def of_matrices(found: Matrices) -> str:
    """The sizes of the matrices, and Φ_q with the names of its rows and columns."""
    names = ("M", "Phi", "Phi_q", "nu", "gamma", "Q", "kkt")
    sizes = [(name, " × ".join(map(str, getattr(found, name).shape))) for name in names]
    parts = [table(("matrix", "size"), sizes)]
    if len(found.columns) <= _WIDEST:
        rows = zip(found.rows, found.Phi_q.tolist(), strict=False)
        cells = ([name, *(f"{x:.4g}" if x else "·" for x in row)] for name, row in rows)
        parts += [paragraph("Phi_q"), table(("", *found.columns), cells)]
    return block(repr(found).strip("<>"), *parts)


def of_sweep(result: SweepResult) -> str:
    """The range of each measure, and the first rows."""
    ranges = [
        (text, result.units[text], *(f"{of(result[text]):.6g}" for of in (nanmin, nanmean, nanmax)))
        for text in result.measures
        if isfinite(result[text]).any()
    ]
    rows = (
        [*(f"{result[name][k]:.6g}" for name in result.columns), result.reasons.get(k, "")]
        for k in range(min(len(result), _MOST_VARIANTS))
    )
    told = f"{len(result)} variants, {len(result.reasons)} failed"
    first = table((*result.columns, "reason"), rows)
    header = ("measure", "unit", "least", "mean", "largest")
    return block(
        told, table(header, ranges), paragraph("the first rows; result.table has all"), first
    )


def of_gradient(found: Gradient) -> str:
    """The derivatives with their units, and relative."""
    rows = []
    for one in found.slopes():
        numbers = f"{one.value:.6g}", one.unit.symbol, f"{one.relative:.4g}"
        rows.append((one.measure, one.variable, *numbers, one.remark))
    header = ("measure", "variable", "slope", "unit", "relative", "remark")
    return block(repr(found).strip("<>"), table(header, rows))


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
