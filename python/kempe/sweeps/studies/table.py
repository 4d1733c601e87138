"""The outcomes of a study as rows: Markdown, CSV and JSON."""

from __future__ import annotations

import csv
import io
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from kempe.base import files
from kempe.base.display_units import chosen_for, display, heading
from kempe.sweeps.studies.findings import findings, instant
from kempe.sweeps.studies.variants import GROUPS

if TYPE_CHECKING:
    from kempe.sweeps.studies.outcome import Outcome, Outcomes

#: SI units of the numbers in the CSV file; the others have none.
_UNITS = {
    "step": "s",
    "diverged_at": "s",
    "angle_error": "rad",
    "position_error": "m",
    "residual": "m",
    "residual_at": "s",
    "seconds": "s",
}


def header() -> tuple[str, ...]:
    """Heads of the columns, with their display units."""
    return (
        "variant",
        heading("angle error", "rad"),
        heading("position error", "m"),
        heading("residual", "m"),
        "energy error",
        "steps",
        "evaluations",
        heading("time", "s", "ms"),
    )


def cells(outcome: Outcome) -> tuple[str, ...]:
    """One row; for a variant that diverged, the time and the reason."""
    seconds = outcome.seconds / display("s", "ms").divisor
    cost = (str(outcome.steps), str(outcome.evaluations), f"{seconds:.3g}")
    if outcome.diverged:
        return (outcome.variant.name, fate(outcome), "", "", "", *cost)
    metre = display("m").divisor
    measured = (
        outcome.angle_error / display("rad").divisor,
        outcome.position_error / metre,
        outcome.residual / metre,
        outcome.imbalance,
    )
    return (outcome.variant.name, *(f"{value:.2g}" for value in measured), *cost)


def fate(outcome: Outcome) -> str:
    """``diverged at t = 0.15 s: why``."""
    return f"diverged{instant(outcome, 4)}: {outcome.reason}"


def markdown(study: Outcomes) -> str:
    """A table for each group of variants."""
    lines = [f"# Study of {study.analysis}: {study.title}", "", *_about(study)]
    for group, title in GROUPS.items():
        rows = [cells(outcome) for outcome in study.group(group)]
        if not rows:
            continue
        lines += ["", f"## {title[0].upper()}{title[1:]}", ""]
        lines += [_row(header()), _row(["---", *["---:"] * (len(header()) - 1)])]
        lines += [_row(row) for row in rows]
    return "\n".join(lines)


def _about(study: Outcomes) -> list[str]:
    return [
        "Errors are the largest differences of any body from the most accurate run",
        f"({study.reference.variant.name}) over all output times; the residual is the largest |Φ|.",
    ]


def _row(row: Any) -> str:
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |"


def records(study: Outcomes) -> list[dict[str, Any]]:
    """The outcomes as plain data, SI units; None where a variant diverged."""
    return [_record(outcome) for outcome in study.outcomes]


def _record(outcome: Outcome) -> dict[str, Any]:
    way = outcome.variant
    numbers = {
        "angle_error": outcome.angle_error,
        "position_error": outcome.position_error,
        "residual": outcome.residual,
        "residual_at": outcome.residual_at,
        "energy_error": outcome.imbalance,
    }
    return {
        "group": way.group,
        "alpha": way.alpha,
        "beta": way.beta,
        "scheme": way.scheme,
        "projected": way.projected,
        "rtol": way.number if way.scheme != "RK4" else None,
        "step": way.number if way.scheme == "RK4" else None,
        "diverged_at": outcome.diverged_at,
        "reason": outcome.reason,
        **{key: None if math.isnan(value) else value for key, value in numbers.items()},
        "steps": outcome.steps,
        "evaluations": outcome.evaluations,
        "seconds": outcome.seconds,
    }


def csv_text(study: Outcomes) -> str:
    """One line for each variant; empty where there is no number.

    The numbers have display units; the header names those that were chosen.
    """
    out = io.StringIO()
    rows = [_in_display_units(record) for record in records(study)]
    writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


def _in_display_units(record: dict[str, Any]) -> dict[str, Any]:
    found = {}
    for name, value in record.items():
        chosen = chosen_for(_UNITS.get(name, ""))
        if chosen is None:
            found[name] = value
        else:
            converted = None if value is None else value / chosen.divisor
            found[f"{name} [{chosen.unit}]"] = converted
    return found


def json_text(study: Outcomes) -> str:
    """Everything, with the findings."""
    whole = {
        "title": study.title,
        "analysis": study.analysis,
        "findings": findings(study),
        "variants": records(study),
    }
    return files.json_text(whole) + "\n"


def write(study: Outcomes, folder: Path) -> list[Path]:
    """Write the tables; returns the files.

    Raises:
        FileError: a file cannot be written.
    """
    told = [f"- {finding}" for finding in findings(study)]
    texts = {
        "study.md": "\n".join([markdown(study), "", "## Findings", "", *told, ""]),
        "study.csv": csv_text(study),
        "study.json": json_text(study),
    }
    for name, text in texts.items():
        files.write_text(folder / name, text)
    return [folder / name for name in texts]
