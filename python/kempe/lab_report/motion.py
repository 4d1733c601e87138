"""The results of a motion: figures, peaks, accuracy, energy, events, measures and settling."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from kempe.base.arrays import ROUNDING
from kempe.base.display_units import display, heading
from kempe.base.names import few
from kempe.lab_report.blocks import Block, Cell, Number, Paragraph, Section, Table
from kempe.lab_report.figures import MOST, Figures
from kempe.lab_report.printed import FEW, number, quantity
from kempe.results.remarks import by_choice, starred, when
from kempe.results.solution import Solution

#: Statistics of a measure that have its unit.
_STATISTICS = ("max", "min", "mean", "rms", "final")
#: Figures that no part of the section repeats.
_LEFT_OUT = ("mechanism", "initial", "final", "x", "y", "angle")


class Told:
    """The summary of a motion, with the unit of its variable.

    Attributes:
        summary: the summary, see ``kempe.report.summary``.
        variable: the variable.
        unit, usual: SI unit of the variable, and the unit where none was chosen.
    """

    def __init__(self, solution: Solution) -> None:
        self.summary: Mapping[str, Any] = solution.summary
        peaks = self.summary["peaks"]
        every = [*peaks["reactions"], *peaks["forces"]]
        self._least = ROUNDING * max((abs(of["force"]) for of in every), default=0.0)
        self._size = max(1e-3, float(np.abs(solution.q).max(initial=0.0)))
        self.variable = solution.variable
        self.unit = solution.variable.unit
        self.usual = "deg" if self.unit == "rad" else None

    def peaks(self, kind: str) -> list[dict[str, Any]]:
        """The largest "reactions" or "forces", with rounding errors replaced by zeros."""
        least = {"force": self._least, "torque": self._least * self._size}
        return [
            {**of, **{name: 0.0 for name, small in least.items() if abs(of[name]) <= small}}
            for of in self.summary["peaks"][kind]
        ]

    def at(self, value: float) -> Cell:
        """A time, or a value of the driven quantity, in a cell."""
        return number(value, self.unit, self.usual)

    def place(self, value: float) -> str:
        """A time, or a value of the driven quantity, in a sentence."""
        return quantity(value, self.unit, self.usual)

    def header(self, word: str = "at") -> str:
        """The head of a column of times."""
        return heading(word, self.unit, self.usual)


def motion(name: str, solution: Solution) -> Section:
    """All results of a motion."""
    told, figures = Told(solution), Figures(solution, name)
    span = told.summary["time"]
    over, over_value = f"over {solution.variable.words}", not solution.variable.is_time
    return Section(
        f"Results of {name}",
        [
            Paragraph(
                f"The motion {over} from {told.place(span['start'])} to {told.place(span['end'])} "
                f"has {span['outputs']} outputs. End: {told.summary['message']}.",
                warning=not told.summary["success"],
            ),
            Paragraph(f"Forces and efforts are {told.variable.condition}." if over_value else ""),
        ],
        [
            Section("Motion", [*figures.named("motion"), *_velocities(solution, figures)]),
            Section("Events", [_events(told)]),
            Section("Settling", [_settling(told)] if solution.variable.is_time else []),
            Section("Forces", [*_forces(told), *figures.beginning("torque_")]),
            Section("Reactions", _reactions(solution, told, figures)),
            Section("Measures", [*_measures(told), *figures.beginning("measure_")]),
            Section("Design", _design(solution, figures)),
            Section("Accuracy", [*_accuracy(told), *figures.named("residual")]),
            Section("Energy", [_energy(told), *figures.named("energy")]),
        ],
    )


def _velocities(solution: Solution, figures: Figures) -> Sequence[Block]:
    captions = {}
    for name, info in solution.compiled.bodies.items():
        of = f"body {info.shown_number}, {name}" if info.is_shown else name
        captions[name] = f"Velocity and acceleration of {of}"
    return figures.about(captions)


def _events(told: Told) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for name, times in told.summary["events"].items():
        rows += [(name, str(k), told.at(t)) for k, t in enumerate(times, 1)][:MOST]
        if len(times) > MOST:
            rows.append((name, f"{MOST + 1} to {len(times)}", f"until {told.place(times[-1])}"))
    return Table("Events", ("event", "no.", told.header()), rows)


def _settling(told: Told) -> Table:
    rows: list[tuple[Cell, ...]] = []
    if not any(of["time"] for of in told.summary["settling"]):
        return Table("Settling", (), rows)
    for of in told.summary["settling"]:
        settled: Cell = "does not turn" if not of["moves"] else "does not settle"
        if of["moves"] and of["time"] is not None:
            settled = told.at(of["time"])
        rows.append((of["body"], settled, number(of["angle"], "rad", "deg")))
    caption = "Settling of the angles, within 0.5 % of the largest deviation from the end"
    header = ("body", told.header("settled at"), heading("last angle", "rad", "deg"))
    return Table(caption, header, rows)


def _forces(told: Told) -> list[Block]:
    peaks = told.peaks("forces")
    header, cells = _peaks(told, peaks)
    rows = []
    for of, row in zip(peaks, cells, strict=True):
        parts = (f"{part} {number(v, 'N*m').text}" for part, v in of["torque_by_part"].items())
        name = starred(of["name"], unique=of["unique"])
        rows.append((name, of["on"], *row, ", ".join(parts)))
    last = f"largest torque of parts / {display('N*m').symbol}"
    table = Table("Largest forces and torques", ("force", "on", *header, last), rows)
    return [table, *_not_unique(peaks, "name", "forces")]


def _reactions(solution: Solution, told: Told, figures: Figures) -> list[Block]:
    peaks = told.peaks("reactions")
    header, cells = _peaks(told, peaks)
    names = [starred(of["joint"], unique=of["unique"]) for of in peaks]
    rows = [(name, of["on"], *row) for name, of, row in zip(names, peaks, cells, strict=True)]
    blocks: list[Block] = [Table("Largest reactions", ("joint", "on", *header), rows)]
    blocks += _remarks(told, peaks, "joint", "which the peaks do not include")
    if solution.compiled.constraints:
        blocks += [*figures.named("reactions"), *figures.beginning("reactions_")]
    return blocks


def _remarks(
    told: Told, rows: Sequence[Mapping[str, Any]], key: str, counted: str
) -> Iterator[Paragraph]:
    """The joints or measures whose reactions are not unique, and those without bound.

    ``counted``: which numbers include values without bound, in words.
    """
    of = "reactions of" if key == "joint" else "reactions in the measures"
    yield from _not_unique(rows, key, of)
    unbounded = [row[key] for row in rows if row["unbounded_at"]]
    if unbounded:
        times = sorted({t for row in rows for t in row["unbounded_at"]})
        passed = f"singular positions ({when(times, told.variable, told.place)})"
        told_of = f"have no bound at {passed}, {counted}"
        yield Paragraph(f"The {of} {few(unbounded)} {told_of}.", warning=True)


def _not_unique(rows: Sequence[Mapping[str, Any]], key: str, of: str) -> Iterator[Paragraph]:
    """What the stars beside the names of rows mean."""
    for _, meaning, names in by_choice({row[key]: row["choice"] for row in rows}):
        yield Paragraph(f"* The {of} {few(names)} are not unique, {meaning}.", warning=True)


def _peaks(told: Told, peaks: Sequence[Mapping[str, Any]]) -> tuple[list[str], list[list[Cell]]]:
    """Header and cells of forces and torques; a column of zeros is left out."""
    kinds = [("force", "N"), ("torque", "N*m")]
    shown = [(name, unit) for name, unit in kinds if any(of[name] for of in peaks)]
    header = [word for name, unit in shown for word in (heading(name, unit), told.header())]
    cells = [
        [
            cell
            for name, unit in shown
            for cell in (number(of[name], unit), told.at(of[f"{name}_at"]))
        ]
        for of in peaks
    ]
    return header, cells


def _measures(told: Told) -> list[Block]:
    rows = []
    for of in told.summary["measures"]:
        values = [number(of[name], of["unit"]) for name in _STATISTICS]
        times = (
            "–" if of.get(name) is None else number(of[name], unit)
            for name, unit in (("settling", "s"), ("frequency", "Hz"))
        )
        whole = of["integral_unit"]
        integral = Number(of["integral"], quantity(of["integral"], whole))
        unit = display(of["unit"]).symbol if of["unit"] else ""
        name = starred(of["name"], unique=of["unique"])
        rows.append((name, of["expression"], unit, *values, integral, *times))
    others = ("integral", "settled at / s", "frequency / Hz")
    header = ("measure", "expression", "unit", *_STATISTICS, *others)
    counted = "which only integrals and means include"
    remarks = _remarks(told, told.summary["measures"], "name", counted)
    return [Table("Measures", header, rows), *remarks]


def _design(solution: Solution, figures: Figures) -> list[Block]:
    """Coupler curves, transmission angles, efforts and other results for design."""
    model = solution.compiled
    known = {*_LEFT_OUT, "motion", "residual", "energy", "reactions", *model.bodies}
    beginnings = ("torque_", "reactions_", "measure_", "x_", "y_", "angle_")
    found = figures.others(lambda about: about in known or about.startswith(beginnings))
    return [*found]


def _accuracy(told: Told) -> list[Block]:
    summary = told.summary
    worst = summary["peaks"]["residual"]
    rows: list[tuple[Cell, ...]] = []
    if worst is not None:
        value = number(worst["value"], worst["unit"], digits=FEW)
        symbol = display(worst["unit"]).symbol
        where = f"{worst['equation']} at {told.place(worst['at'])}"
        rows.append(("largest residual of a constraint", value, symbol, where))
        rate = number(summary["peaks"]["residual_rate"], digits=FEW)
        unit = told.variable.rate("m/s or rad/s")
        rows.append(("largest residual of a velocity equation", rate, unit, ""))
    balance = number(summary["newton_euler"], digits=FEW)
    rows.append(("Newton–Euler balance", balance, "", "of the largest force or moment on a body"))
    blocks: list[Block] = [Table("Accuracy", ("", "value", "unit", ""), rows)]
    singular = [
        (told.at(of["t"]), few(of["joints"]), number(of["error"], digits=FEW))
        for of in summary["singular"]
    ]
    header = (told.header(), "joints", "relative error beside it, about")
    blocks.append(Table("Singular positions that were passed", header, singular[:MOST]))
    return blocks


def _energy(told: Told) -> Table:
    energy = told.summary["energy"]
    largest = f"at {told.place(energy['largest_kinetic_at'])}"
    rows: list[tuple[Cell, ...]] = [
        ("largest kinetic energy", number(energy["largest_kinetic"], "J"), largest),
        ("dissipated until the end", number(energy["dissipated"], "J"), ""),
        ("work of drivers and forces until the end", number(energy["work"], "J"), ""),
        ("scale: largest energy of the run", number(energy["scale"], "J"), ""),
    ]
    balance = number(energy["largest_imbalance"], digits=FEW)
    rows.append(("largest error of the balance, relative to the scale", balance, ""))
    return Table("Energy", ("", heading("value", "J"), ""), rows)
