"""The methods of the analyses: equations with their numbers in the literature, and options."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from kempe.base.display_units import Shown
from kempe.lab_report.blocks import Block, Cell, Formulas, Paragraph, Section, Table
from kempe.lab_report.formula import formula
from kempe.lab_report.printed import number, text
from kempe.lab_report.subject import Subject
from kempe.model.catalogue import about, declared
from kempe.results.solution import Solution

_HAUG = (
    "Numbers of equations are those of E. J. Haug, Computer-Aided Kinematics and Dynamics of "
    "Mechanical Systems, 2nd edition."
)
_POSITIONS = r"\Phi(q, t) = 0"
_VELOCITIES = r"\Phi_q \dot q = -\Phi_t \equiv \nu"
_ACCELERATIONS = (
    r"\Phi_q \ddot q = -(\Phi_q \dot q)_q \dot q - 2 \Phi_{qt} \dot q - \Phi_{tt} \equiv \gamma"
)
_MOTION = (
    r"\begin{bmatrix} M & \Phi_q^T \\ \Phi_q & 0 \end{bmatrix} "
    r"\begin{bmatrix} \ddot q \\ \lambda \end{bmatrix} = \begin{bmatrix} Q \\ \gamma \end{bmatrix}"
)
_BAUMGARTE = r"\hat\gamma = \gamma - 2 \alpha (\Phi_q \dot q + \Phi_t) - \beta^2 \Phi"
_REACTIONS = (
    r"F_i'' = -C_i^T A_i^T \Phi_{r_i}^T \lambda",
    r"T_i'' = -\left(\Phi_{\varphi_i}^T - {s_i'}^T B_i^T \Phi_{r_i}^T\right) \lambda",
)
_EFFORTS = r"\Phi_q^T \lambda = Q - M \ddot q"
_ENERGY = (
    r"T + V + W_{\text{dissipated}} - W_{\text{drivers}} - W_{\text{forces}} = \text{const}, \quad "
    r"T = \frac{1}{2} \dot q^T M \dot q"
)
_REST = r"Q - \Phi_q^T \lambda = 0, \quad \Phi(q, t) = 0"
#: The equations of each type of analysis, each with a heading, a formula and a number.
_CONSTRAINTS = (
    ("Constraints of joints and drivers", _POSITIONS, ""),
    ("Velocities", _VELOCITIES, "3.6.10"),
    ("Accelerations", _ACCELERATIONS, "3.6.11"),
)
_RECOVERED = (
    ("Reaction force of a joint on body i in the frame of the joint", _REACTIONS[0], "6.6.8"),
    ("Its torque about the joint point", _REACTIONS[1], "6.6.9"),
)
_EQUATIONS: Mapping[str, tuple[tuple[str, str, str], ...]] = {
    "dynamics": (
        *_CONSTRAINTS,
        ("Equations of motion", _MOTION, "6.3.18"),
        *_RECOVERED,
        ("Energy balance", _ENERGY, ""),
    ),
    "kinematics": _CONSTRAINTS,
    "inverse_dynamics": (
        *_CONSTRAINTS,
        ("Efforts and reactions, from the upper row of", _EFFORTS, "6.3.18"),
        *_RECOVERED,
    ),
    "equilibrium": (("Equilibrium", _REST, "6.3.18 at rest"),),
    "modes": (("Equations of motion, linearised about the state", _MOTION, "6.3.18"),),
}
#: Fields of analyses that have a table of their own.
_CHOICES = ("method", "stabilization")
_GREEK = {"Phi": "Φ", "gamma": "γ", "alpha": "α", "beta": "β"}


def method(subject: Subject) -> Section:
    """The equations that the analyses solve, and a part for each analysis with its options."""
    kinds = dict.fromkeys(entry["type"] for entry in subject.entries.values())
    used = dict.fromkeys(line for kind in kinds for line in _EQUATIONS.get(kind, ()))
    chosen = {_chosen(entry, "stabilization")["type"] for entry in _dynamics(subject)}
    blocks: list[Block] = [Paragraph(_HAUG)]
    for heading, latex, equation in used:
        blocks.append(Formulas(heading, [[formula(latex, equation)]]))
    if "baumgarte" in chosen:
        told = "Stabilization by Baumgarte: in place of γ, the integrator uses"
        blocks.append(Formulas(told, [[formula(_BAUMGARTE, "7.3.8")]]))
        blocks.append(Paragraph("Reported accelerations and multipliers use γ, never γ̂."))
    parts = [
        Section(f"Analysis {name}", list(_analysis(subject, name, entry)))
        for name, entry in subject.entries.items()
    ]
    return Section("Method", blocks, parts)


def _dynamics(subject: Subject) -> Iterator[Mapping[str, Any]]:
    return (entry for entry in subject.entries.values() if entry["type"] == "dynamics")


def _chosen(entry: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """The method or stabilization of an analysis, by default that of its declaration."""
    fields = declared("analyses")[entry["type"]]["fields"]
    usual = next(of["default"] for of in fields if of["name"] == key)
    given = entry.get(key, usual)
    return given if isinstance(given, Mapping) else {"type": given}


def _analysis(subject: Subject, name: str, entry: Mapping[str, Any]) -> Iterator[Block]:
    yield Paragraph(about("analyses", entry["type"]))
    rows = list(_options("analyses", entry))
    used = ""
    for key in _CHOICES:
        if entry["type"] == "dynamics":
            choice = _chosen(entry, key)
            yield Paragraph(f"{key.capitalize()}: {_greek(about(f'{key}s', choice['type']))}")
            rows.append((key, str(choice["type"]), "", "given" if key in entry else "default"))
            rows += [(f"{key}.{of}", *told) for of, *told in _options(f"{key}s", choice)]
    found = subject.results.get(name)
    if isinstance(found, Solution) and "why" in found.statistics:
        used = f"The method was {found.statistics['method']}: {found.statistics['why']}."
    header = ("option", "value", "unit", "")
    yield Table(f"Options of {name}", header, rows)
    yield Paragraph(used)
    if isinstance(found, Solution):
        yield _cost(found)


def _greek(told: str) -> str:
    """A description with the symbols of the literature."""
    for word, symbol in _GREEK.items():
        told = re.sub(rf"(?<!-)\b{word}(?=\b|_)", symbol, told)
    return told.replace("^2", "²")


def _options(group: str, entry: Mapping[str, Any]) -> Iterator[tuple[Cell, ...]]:
    """Name, value, unit and origin of the options that have a value."""
    for of in declared(group)[entry["type"]]["fields"]:
        name, default = of["name"], of["default"]
        if name in _CHOICES:
            continue
        absent = default is None or (isinstance(default, Mapping) and "absent" in default)
        if name in entry or not absent:
            value = entry.get(name, default)
            unit = Shown(of["unit"]).symbol
            yield name, _printed(value), unit, "given" if name in entry else "default"


def _printed(value: Any) -> Cell:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        return number(value)
    if isinstance(value, Mapping):
        return "; ".join(f"{key}: {_plain(of)}" for key, of in value.items())
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def _plain(value: Any) -> str:
    if isinstance(value, Mapping):
        return ", ".join(f"{key} = {_plain(of)}" for key, of in value.items())
    return text(value) if isinstance(value, float) else str(value)


def _cost(found: Solution) -> Table:
    """The cost of a run, without its computing time, which is not reproducible."""
    cost = found.statistics
    names = ("steps", "rejected", "evaluations", "jacobians", "iterations", "factorisations")
    rows = [(name, str(cost[name])) for name in names if cost.get(name)]
    return Table("Cost of the computation", ("", "number"), rows)
