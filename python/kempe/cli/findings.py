"""Printing of the summary of a solution."""

from __future__ import annotations

import math
from typing import Any

from rich.console import Console
from rich.text import Text

from kempe.cli.console import figure, heading, table


def show_findings(console: Console, name: str, summary: dict[str, Any]) -> None:
    """Print peaks, energy balance, settling times and cost of one analysis."""
    span = summary["time"]
    span_text = f"{name}: {figure(span['start'])} to {figure(span['end'])} s"
    heading(console, f"{span_text}, {span['outputs']} outputs")
    console.print(Text(f"  {summary['message']}", style="" if summary["success"] else "red"))
    _show_peaks(console, summary["peaks"])
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
    if forces:
        heading(console, "Largest forces")
        header, cells = _columns(forces)
        rows = [(f["name"], f["on"], *row, _parts(f)) for f, row in zip(forces, cells, strict=True)]
        table(console, ("force", "on", *header, "torque of parts / N m"), rows, left=2)


def _columns(peaks: list[dict[str, Any]]) -> tuple[list[str], list[list[str]]]:
    """Header and cells of forces and torques; a column of zeros is omitted."""
    quantities = [("force", "force / N"), ("torque", "torque / N m")]
    shown = [pair for pair in quantities if any(peak[pair[0]] for peak in peaks)]
    header = [word for _, title in shown for word in (title, "at / s")]
    cells = [
        [figure(peak[key]) for quantity, _ in shown for key in (quantity, f"{quantity}_at")]
        for peak in peaks
    ]
    return header, cells


def _parts(force: dict[str, Any]) -> str:
    return ", ".join(f"{part} {figure(peak)}" for part, peak in force["torque_by_part"].items())


def _show_accuracy(console: Console, summary: dict[str, Any]) -> None:
    heading(console, "Accuracy")
    worst, energy = summary["peaks"]["residual"], summary["energy"]
    if worst is not None:
        value = f"{worst['value']:.3g} {worst['unit']}"
        text = f"largest residual {value} in {worst['equation']} at {figure(worst['at'])} s"
        console.print(Text(f"  {text}"))
    scale = f"largest energy {figure(energy['scale'])} J"
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
            settled = f"{figure(body['time'])} s"
        # adding 0.0 removes the sign of zero
        angle = math.degrees(body["angle"] if body["moves"] else round(body["angle"], 8) + 0.0)
        rows.append((body["body"], settled, f"{figure(angle)}°"))
    table(console, ("body", "settled at", "last angle"), rows)
