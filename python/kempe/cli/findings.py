"""Printing of the summary of a solution."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.text import Text

from kempe.cli.console import figure, heading, table
from kempe.display_units import display
from kempe.display_units import heading as units_heading
from kempe.names import few


def show_findings(console: Console, name: str, summary: dict[str, Any]) -> None:
    """Print peaks, energy balance, settling times and cost of one analysis."""
    span = summary["time"]
    seconds = display("s")
    start, end = (figure(span[key] / seconds.divisor) for key in ("start", "end"))
    span_text = f"{name}: {start} to {end} {seconds.symbol}"
    heading(console, f"{span_text}, {span['outputs']} outputs")
    console.print(Text(f"  {summary['message']}", style="" if summary["success"] else "red"))
    _show_peaks(console, summary["peaks"])
    _show_measures(console, summary["measures"])
    _show_events(console, summary["events"])
    _show_accuracy(console, summary)
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


def _show_peaks(console: Console, peaks: dict[str, Any]) -> None:
    reactions, forces = peaks["reactions"], peaks["forces"]
    if reactions:
        heading(console, "Largest reactions")
        names = ((r["joint"], r["on"]) for r in reactions)
        header, cells = _columns(reactions)
        rows = [(*name, *row) for name, row in zip(names, cells, strict=True)]
        table(console, ("joint", "on", *header), rows, left=2)
        _show_unbounded(console, reactions)
        _show_minimum_norm(console, reactions)
    if forces:
        heading(console, "Largest forces")
        header, cells = _columns(forces)
        rows = [(f["name"], f["on"], *row, _parts(f)) for f, row in zip(forces, cells, strict=True)]
        table(console, ("force", "on", *header, _header("torque of parts", "N*m")), rows, left=2)


def _show_unbounded(console: Console, reactions: list[dict[str, Any]]) -> None:
    """The reactions that have no bound beside singular positions."""
    names = [r["joint"] for r in reactions if r["unbounded_at"]]
    times = sorted(t for r in reactions for t in r["unbounded_at"])
    if names:
        span = f"first at {_measured(times[0], 's')}, last at {_measured(times[-1], 's')}"
        text = f"without bound at singular positions, not counted here ({span}): {few(names)}"
        console.print(Text(f"  {text}"))


def _show_minimum_norm(console: Console, reactions: list[dict[str, Any]]) -> None:
    """The reactions that redundant constraints leave open."""
    names = [r["joint"] for r in reactions if not r["unique"]]
    if names:
        text = f"not unique, of the smallest multipliers (minimum norm): {few(names)}"
        console.print(Text(f"  {text}"))


def _show_measures(console: Console, measures: list[dict[str, Any]]) -> None:
    """The statistics of each measure, in the unit of the measure."""
    if not measures:
        return
    heading(console, "Measures")
    of_unit = ("max", "min", "mean", "rms", "final")
    rows = [
        (
            of["name"],
            display(of["unit"]).symbol,
            *(_number(of[name], of["unit"]) for name in of_unit),
            "-" if of["settling"] is None else _number(of["settling"], "s"),
            "-" if of["frequency"] is None else figure(of["frequency"]),
        )
        for of in measures
    ]
    header = ("measure", "unit", *of_unit, _header("settled at", "s"), "frequency / Hz")
    table(console, header, rows, left=2)


def _show_events(console: Console, events: dict[str, list[float]]) -> None:
    occurred = {name: times for name, times in events.items() if times}
    if not occurred:
        return
    heading(console, "Events")
    rows = [
        (name, str(len(times)), _number(times[0], "s"), _number(times[-1], "s"))
        for name, times in occurred.items()
    ]
    header = (_header("first at", "s"), _header("last at", "s"))
    table(console, ("event", "times", *header), rows)


def _columns(peaks: list[dict[str, Any]]) -> tuple[list[str], list[list[str]]]:
    """Header and cells of forces and torques; a column of zeros is omitted."""
    quantities = [("force", "N"), ("torque", "N*m")]
    shown = [pair for pair in quantities if any(peak[pair[0]] for peak in peaks)]
    columns = [
        entry for name, unit in shown for entry in ((name, name, unit), ("at", f"{name}_at", "s"))
    ]
    header = [_header(title, unit) for title, _, unit in columns]
    cells = [[_number(peak[key], unit) for _, key, unit in columns] for peak in peaks]
    return header, cells


def _header(title: str, unit: str) -> str:
    return units_heading(title, unit).replace("·", " ")


def _number(value: float, unit: str, usual: str | None = None) -> str:
    """A number in the display unit."""
    return figure(value / display(unit, usual).divisor)


def _measured(value: float, unit: str, usual: str | None = None) -> str:
    """A number with its display unit."""
    symbol = display(unit, usual).symbol
    return f"{_number(value, unit, usual)}{'' if symbol == '°' else ' '}{symbol}"


def _parts(force: dict[str, Any]) -> str:
    parts = force["torque_by_part"].items()
    return ", ".join(f"{part} {_number(peak, 'N*m')}" for part, peak in parts)


def _show_accuracy(console: Console, summary: dict[str, Any]) -> None:
    heading(console, "Accuracy")
    worst, energy = summary["peaks"]["residual"], summary["energy"]
    if worst is not None:
        shown = display(worst["unit"])
        value = f"{worst['value'] / shown.divisor:.3g} {shown.symbol}"
        text = f"largest residual {value} in {worst['equation']} at {_measured(worst['at'], 's')}"
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
