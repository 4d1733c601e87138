"""Printing of the summary of a solution."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.text import Text

from kempe.base.display_units import Shown, display
from kempe.base.display_units import heading as units_heading
from kempe.base.names import few
from kempe.cli.console import figure, heading, table
from kempe.results.remarks import not_unique, starred, when
from kempe.results.variable import Variable

#: A value that is this part of the largest of its column is a rounding error.
_ROUNDING = 1e-13


def show_findings(console: Console, name: str, summary: dict[str, Any]) -> None:
    """Print peaks, energy balance, settling times and cost of one analysis."""
    span = summary["time"]
    of = Variable(**summary["variable"], static=summary["static"])
    shown = _shown(of.unit)
    start, end = (figure(span[key] / shown.divisor) for key in ("start", "end"))
    over = "" if of.is_time else f"over {of.name}, "
    gap = "" if shown.symbol == "°" else " "
    heading(
        console, f"{name}: {over}{start} to {end}{gap}{shown.symbol}, {span['outputs']} outputs"
    )
    console.print(Text(f"  {summary['message']}", style="" if summary["success"] else "red"))
    if of.condition:
        console.print(Text(f"  forces and efforts {of.condition}"))
    _show_peaks(console, summary["peaks"], of)
    _show_measures(console, summary["measures"], of)
    _show_events(console, summary["events"], of.unit)
    _show_accuracy(console, summary, of.unit)
    _show_singular(console, summary["singular"], of.unit)
    if of.is_time and summary["settling"]:
        _show_settling(console, summary["settling"])
    cost = summary["statistics"]
    console.print()
    counts = f"{cost['steps']} steps, {cost['rejected']} rejected"
    work = f"{cost['evaluations']} evaluations, {cost['factorisations']} factorisations"
    if cost.get("jacobians"):
        work += f", {cost['jacobians']} tangents, {cost['iterations']} Newton iterations"
    console.print(Text(f"  {counts}, {work}, {cost['seconds']:.3g} s"))
    if "why" in cost:
        console.print(Text(f"  method {cost['method']}: {cost['why']}"))
    for note in cost.get("notes", ()):
        console.print(Text(f"  {note}"))


def _shown(unit: str) -> Shown:
    """The display unit of the time or of a driven quantity; angles are in degrees."""
    return display(unit, "deg") if unit == "rad" else display(unit)


def _show_peaks(console: Console, peaks: dict[str, Any], over: Variable) -> None:
    at, reactions, forces = over.unit, peaks["reactions"], peaks["forces"]
    if reactions:
        heading(console, "Largest reactions")
        names = ((starred(r["joint"], unique=r["unique"]), r["on"]) for r in reactions)
        header, cells = _columns(reactions, at)
        rows = [(*name, *row) for name, row in zip(names, cells, strict=True)]
        table(console, ("joint", "on", *header), rows, left=2)
        _show_remarks(console, reactions, "joint", over, "not counted here")
    if forces:
        heading(console, "Largest forces")
        header, cells = _columns(forces, at)
        names = ((starred(f["name"], unique=f["unique"]), f["on"]) for f in forces)
        last = (_parts(f) for f in forces)
        rows = [(*a, *row, b) for a, row, b in zip(names, cells, last, strict=True)]
        table(console, ("force", "on", *header, _header("torque of parts", "N*m")), rows, left=2)
        for line in not_unique({f["name"]: f["choice"] for f in forces}):
            console.print(Text(f"  {line}"))


def _show_remarks(
    console: Console, rows: list[dict[str, Any]], key: str, of: Variable, counted: str
) -> None:
    """Below a table: the rows without bound at singular positions, and those not unique.

    ``counted``: whether the numbers of the table include values without bound, in words.
    """
    names = [row[key] for row in rows if row["unbounded_at"]]
    times = sorted({t for row in rows for t in row["unbounded_at"]})
    if names:
        span = when(times, of, lambda t: _place(t, of.unit))
        text = f"without bound at singular positions, {counted} ({span}): {few(names)}"
        console.print(Text(f"  {text}"))
    for line in not_unique({row[key]: row["choice"] for row in rows}):
        console.print(Text(f"  {line}"))


def _show_singular(console: Console, passed: list[dict[str, Any]], at: str) -> None:
    """The singular positions that were passed, and the accuracy that is lost beside them."""
    if not passed:
        return
    worst = max(passed, key=lambda one: float(one["error"]))
    names = sorted({name for one in passed for name in one["joints"]})
    first, last = (_place(passed[k]["t"], at) for k in (0, -1))
    where = f"at {first}" if len(passed) == 1 else f"first at {first}, last at {last}"
    count = "1 singular position" if len(passed) == 1 else f"{len(passed)} singular positions"
    console.print(Text(f"  {count} passed ({where}): {few(names)}"))
    text = (
        f"accelerations and reactions beside it: errors of constraints times 1/sigma^2 = "
        f"{worst['amplification']:.2g}, about {worst['error']:.1g} at the output at "
        f"{_place(worst['output'], at)}"
    )
    console.print(Text(f"  {text}"))


def _show_measures(console: Console, measures: list[dict[str, Any]], over: Variable) -> None:
    """The statistics of each measure, in its unit; without times if the motion is over a value."""
    if not measures:
        return
    heading(console, "Measures")
    of_unit = ("max", "min", "mean", "rms", "final")
    rows = [
        (
            starred(of["name"], unique=of["unique"]),
            display(of["unit"]).symbol,
            *(_number(of[name], of["unit"]) for name in of_unit),
            f"{_number(of['integral'], of['integral_unit'])} {display(of['integral_unit']).symbol}",
            *(_over_time(of) if over.is_time else ()),
        )
        for of in measures
    ]
    over_time = (_header("settled at", "s"), "frequency / Hz") if over.is_time else ()
    table(console, ("measure", "unit", *of_unit, "integral", *over_time), rows, left=2)
    _show_remarks(console, measures, "name", over, "counted in integrals and means only")


def _over_time(of: dict[str, Any]) -> tuple[str, str]:
    """The settling time and the frequency of a measure."""
    return _or_none(of["settling"], "s"), _or_none(of["frequency"], "Hz")


def _or_none(value: float | None, unit: str) -> str:
    return "-" if value is None else _number(value, unit)


def _show_events(console: Console, events: dict[str, list[float]], at: str) -> None:
    occurred = {name: times for name, times in events.items() if times}
    if not occurred:
        return
    heading(console, "Events")
    rows = [
        (name, str(len(times)), *(figure(t / _shown(at).divisor) for t in (times[0], times[-1])))
        for name, times in occurred.items()
    ]
    header = tuple(f"{word} / {_shown(at).symbol}" for word in ("first at", "last at"))
    table(console, ("event", "times", *header), rows)


def _columns(peaks: list[dict[str, Any]], at: str) -> tuple[list[str], list[list[str]]]:
    """Header and cells of forces and torques; a column of zeros is omitted."""
    quantities = [("force", "N"), ("torque", "N*m")]
    shown = [pair for pair in quantities if any(peak[pair[0]] for peak in peaks)]
    columns = [
        entry for name, unit in shown for entry in ((name, name, unit), ("at", f"{name}_at", at))
    ]
    usual = "deg" if at == "rad" else None
    header = [_header(title, unit, usual) for title, _, unit in columns]
    largest = {name: max(abs(peak[name]) for peak in peaks) for name, _ in shown}
    cells = [
        [
            _number(_rounded(peak[key], largest.get(key, 0.0)), unit, usual)
            for _, key, unit in columns
        ]
        for peak in peaks
    ]
    return header, cells


def _rounded(value: float, largest: float) -> float:
    """Zero for a rounding error of the other values of its column."""
    return 0.0 if abs(value) < _ROUNDING * largest else value


def _header(title: str, unit: str, usual: str | None = None) -> str:
    return units_heading(title, unit, usual if unit == "rad" else None)


def _number(value: float, unit: str, usual: str | None = None) -> str:
    """A number in the display unit."""
    return figure(value / display(unit, usual if unit == "rad" else None).divisor)


def _place(value: float, unit: str) -> str:
    """A time, or a value of the driven quantity."""
    return _measured(value, unit, "deg" if unit == "rad" else None)


def _measured(value: float, unit: str, usual: str | None = None) -> str:
    """A number with its display unit."""
    symbol = display(unit, usual).symbol
    return f"{_number(value, unit, usual)}{'' if symbol == '°' else ' '}{symbol}"


def _parts(force: dict[str, Any]) -> str:
    parts = force["torque_by_part"].items()
    return ", ".join(f"{part} {_number(peak, 'N*m')}" for part, peak in parts)


def _show_accuracy(console: Console, summary: dict[str, Any], at: str) -> None:
    heading(console, "Accuracy")
    worst, energy = summary["peaks"]["residual"], summary["energy"]
    if worst is not None:
        shown = display(worst["unit"])
        value = f"{worst['value'] / shown.divisor:.3g} {shown.symbol}"
        text = f"largest residual {value} in {worst['equation']} at {_place(worst['at'], at)}"
        console.print(Text(f"  {text}"))
    scale = f"largest energy {_measured(energy['scale'], 'J')}"
    share = f"{summary['newton_euler']:.2g} of the largest force or moment on a body"
    console.print(Text(f"  Newton-Euler balance within {share}"))
    console.print(Text(f"  energy balance within {energy['largest_imbalance']:.2g} of the {scale}"))


def _show_settling(console: Console, settling: list[dict[str, Any]]) -> None:
    heading(console, "Settling, angle within 0.5 % of its largest deviation from the end")
    rows = []
    for body in settling:
        if not body["moves"]:
            settled = "does not turn"
        elif body["time"] is None:
            settled = "does not settle"
        else:
            settled = _measured(body["time"], "s")
        rows.append((body["body"], settled, _measured(body["angle"], "rad", "deg")))
    table(console, ("body", "settled at", "last angle"), rows)
