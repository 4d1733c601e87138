"""The equations of joints and drivers as formulas with the names of a model.

The formulas themselves are declared beside each element in the core; here the names of bodies and
points are put in, the coordinates of ground are zero, and arms that are zero fall away.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from kempe import _core
from kempe.labelled import terms
from kempe.labelled.terms import ONE, ZERO, Style, Term
from kempe.labelled.written import named

if TYPE_CHECKING:
    from kempe.compiled import CompiledModel, ConstraintInfo
    from kempe.model import Model

COORDINATES = ("x", "y", "angle", "vx", "vy", "omega")
GROUND = "ground"


@dataclass(frozen=True)
class Equations:
    """The equations of a joint or driver.

    Attributes:
        name: of the joint or driver.
        type: such as "revolute".
        rows: names of the equations, such as ``C.x``.
        columns: names of the coordinates of its two bodies, without those of ground.
        residual: Φ of each equation.
        jacobian: ∂Φ/∂q of each equation by column.
        gamma: γ of each equation.
        points: the joint's points that occur, as ``coupler.C``, in the frames of their bodies, m.
        note: what the formulas leave out; empty if nothing.
    """

    name: str
    type: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    residual: tuple[Term, ...]
    jacobian: tuple[tuple[Term, ...], ...]
    gamma: tuple[Term, ...]
    points: Mapping[str, tuple[float, float]]
    note: str = ""

    def text(self) -> str:
        """Lines of text, in the language of expressions."""
        lines = [f"{self.name} ({self.type})"]
        for k, row in enumerate(self.rows):
            lines.append(f"  Φ[{row}] = {terms.write(self.residual[k], TEXT)}")
            lines += [
                f"    ∂Φ[{row}]/∂({column}) = {terms.write(entry, TEXT)}"
                for column, entry in zip(self.columns, self.jacobian[k], strict=True)
                if entry != ZERO
            ]
            lines.append(f"    γ[{row}] = {terms.write(self.gamma[k], TEXT)}")
        if self.points:
            told = (f"{name} = ({x:.6g}, {y:.6g}) m" for name, (x, y) in self.points.items())
            lines.append(f"  with {', '.join(told)} in the frame of its body")
        return "\n".join([*lines, *([f"  {self.note}"] if self.note else [])])

    def latex(self) -> str:
        """Displayed formulas for amsmath."""
        lines = []
        for k, row in enumerate(self.rows):
            label = named(row)
            lines.append(rf"\Phi_{{{label}}} &= {terms.write(self.residual[k], LATEX)}")
            entries = zip(self.columns, self.jacobian[k], strict=True)
            lines += [
                rf"\frac{{\partial \Phi_{{{label}}}}}{{\partial {_symbol(column)}}}"
                rf" &= {terms.write(entry, LATEX)}"
                for column, entry in entries
                if entry != ZERO
            ]
            lines.append(rf"\gamma_{{{label}}} &= {terms.write(self.gamma[k], LATEX)}")
        body = " \\\\\n".join(f"  {line}" for line in lines)
        head = f"% {self.name} ({self.type}){': ' if self.note else ''}{self.note}"
        return f"{head}\n\\begin{{align*}}\n{body}\n\\end{{align*}}\n"


def equations(model: Model | CompiledModel) -> list[Equations]:
    """The equations of all joints and drivers of a model, in the order of Φ.

    Args:
        model: the mechanism.
    """
    from kempe.analyses import compiled_model

    compiled = compiled_model(model)
    tree = json.loads(compiled.case)
    return [_of(info, tree[info.group][info.name], tree) for info in compiled.constraints.values()]


@cache
def declared(group: str, kind: str) -> tuple[Mapping[str, Any], ...]:
    """The formulas that an element declares: residual, jacobian and gamma of each equation."""
    tables = json.loads(_core.catalogue())[group]
    return tuple(next(table["formulas"] for table in tables if table["name"] == kind))


def _of(info: ConstraintInfo, entry: Mapping[str, Any], tree: Mapping[str, Any]) -> Equations:
    names, points = _names(info, entry)
    all_formulas = declared(info.group, info.type)
    columns = [f"{body}.{c}" for body in (info.i, info.j) for c in COORDINATES[:3]]
    kept = [k for k, column in enumerate(columns) if not column.startswith(f"{GROUND}.")]

    def made(text: str) -> Term:
        return terms.put(terms.parse(text), names)

    residual = tuple(made(f["residual"]) for f in all_formulas)
    return Equations(
        name=info.name,
        type=info.type,
        rows=tuple(f"{info.name}.{name}" for name, _ in info.equations),
        columns=tuple(columns[k] for k in kept),
        residual=residual,
        jacobian=tuple(tuple(made(f["jacobian"][k]) for k in kept) for f in all_formulas),
        gamma=tuple(made(f["gamma"]) for f in all_formulas),
        points={name: at for name, at in points.items() if _occurs(name, residual)},
        note=_note(entry, tree),
    )


def _occurs(point: str, residual: tuple[Term, ...]) -> bool:
    return any(name.startswith(f"{point}.") for term in residual for name in term.names())


def _names(
    info: ConstraintInfo, entry: Mapping[str, Any]
) -> tuple[dict[str, Term], dict[str, tuple[float, float]]]:
    """What the names in a declared formula are in this joint, and the points that it uses."""
    names: dict[str, Term] = {}
    points: dict[str, tuple[float, float]] = {}
    axes = entry.get("axes", (0.0, 0.0))
    sides = (("i", info.i, info.point_i, axes[0]), ("j", info.j, info.point_j, axes[1]))
    for side, body, point, axis in sides:
        for c in COORDINATES:
            names[f"{side}.{c}"] = ZERO if body == GROUND else Term("name", word=f"{body}.{c}")
        names[f"{side}.axis"] = _formula(axis)
        label = str(entry.get(side, f"{body}.joint"))
        points[label] = point
        for component, value in zip("xy", point, strict=True):
            known = Term("name", word=f"{label}.{component}")
            names[f"{side}.s.{component}"] = ZERO if value == 0.0 else known
    if "coordinate" in entry:
        names |= _driver(entry)
    return names, points


def _driver(entry: Mapping[str, Any]) -> dict[str, Term]:
    coordinate = str(entry["coordinate"])
    value = _formula(entry["value"])
    driven = coordinate.rpartition(".")[2]
    flags = {f"is_{c}": ONE if c == driven else ZERO for c in COORDINATES[:3]}
    return {"j.coordinate": Term("name", word=coordinate), "value": value, **flags}


def _formula(value: object) -> Term:
    """A number or formula of the file; a text that is not understood stands as it is."""
    try:
        return terms.parse(str(value))
    except ValueError:
        return Term("name", word=str(value))


def _note(entry: Mapping[str, Any], tree: Mapping[str, Any]) -> str:
    bodies = {body for body in tree.get("bodies", {}) if body != GROUND}
    used = {name.rpartition(".")[0] for name in _formula(entry.get("value", 0)).names()}
    others = sorted(used & bodies)
    if not others:
        return ""
    return f"the law depends on {', '.join(others)}: its derivatives are further columns"


def _symbol(name: str) -> str:
    """``crank.angle`` as a symbol with an index; a parameter stands upright."""
    body, _, coordinate = name.rpartition(".")
    symbols = {
        "x": "x",
        "y": "y",
        "angle": r"\varphi",
        "vx": r"\dot{x}",
        "vy": r"\dot{y}",
        "omega": r"\dot{\varphi}",
    }
    if name in ("t", "pi"):
        return {"t": "t", "pi": r"\pi"}[name]
    if not body or coordinate not in symbols:
        return named(name)
    if "." in body and coordinate in ("x", "y"):
        return f"{coordinate}'_{{{named(body)}}}"
    return f"{symbols[coordinate]}_{{{named(body)}}}"


def _latex_call(name: str, inside: str) -> str:
    if name == "ddt":
        return rf"\frac{{\mathrm{{d}}^2}}{{\mathrm{{d}}t^2}}\left({inside}\right)"
    known = name in ("sin", "cos", "tan", "exp", "log", "ln", "sinh", "cosh", "tanh")
    return (rf"\{name}" if known else rf"\mathrm{{{name}}}") + rf"\left({inside}\right)"


def _text_call(name: str, inside: str) -> str:
    return f"d²/dt²({inside})" if name == "ddt" else f"{name}({inside})"


TEXT = Style(
    name=str,
    times="*",
    brackets=("(", ")"),
    power="{}^{}",
    quotient="{}/{}",
    call=_text_call,
)
LATEX = Style(
    name=_symbol,
    times=r" \, ",
    brackets=(r"\left(", r"\right)"),
    power="{{{}}}^{{{}}}",
    quotient=r"\frac{{{}}}{{{}}}",
    call=_latex_call,
)
