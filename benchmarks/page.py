"""The page docs/benchmarks.md, from the numbers of one run."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from crossings import crossings
from problems import ACCEPTED, COST, problem
from record import Record
from shows import targets

HEAD = """# Benchmarks

<!-- Written by benchmarks/run.py from benchmarks/results.json; change those, not this page. -->

kempe against other tools on the same mechanisms, against the same truth, in one process and in
turn. Times are medians of CPU time of one thread, without building the model and without
compilation, runs of less than 50 ms right after one that is not timed; ratios within one run are
what counts. What the error is stands with each problem;
"gap" is the largest distance that any joint opened, at any output. "rtol or step" is the one or the
other, as the tool wants it; atol is a thousandth of rtol. kempe, the floor and the plain SciPy
program give positions, velocities, accelerations and multipliers at all reported times, the other
tools positions and velocities alone; so does kempe where it says "states".

```sh
pip install 'kempe[bench]'
python benchmarks/run.py                     # all of it, half an hour; Rust for the floor
python benchmarks/run.py --quick             # a look, on the flagship
python benchmarks/run.py --problems flagship --tools kempe,mujoco
python benchmarks/run.py --page              # page and figures again, from the numbers
```
"""

FLOOR = """## The floor

`benchmarks/floor/` is the flagship and nothing else, by hand, in Rust, with the compiler flags of
kempe: the same equations (Cartesian, augmented, Baumgarte), the same Dormand–Prince steps, the same
output. "Floor" eliminates the pinned bars in closed form and has a sine of its own; "straight" is
the block elimination that a careful programmer writes first, with the library's sine: a program of
the speed by which the targets were set (140 to 170 ns). "Native" lets the compiler use every
instruction of this processor, which kempe as it is shipped does not do. An evaluation alone
computes accelerations and multipliers at states of a run, each call waiting for the one before, as
the stages of an integrator do. `cargo run --release` in that folder prints these numbers.
"""


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table of Markdown."""
    lines = [list(head)]
    lines.append(["---"] * len(lines[0]))
    lines += [list(row) for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def machine(found: dict[str, Any]) -> str:
    """Where and when, with versions."""
    at = found["machine"]
    versions = ", ".join(f"{tool} {version}" for tool, version in found["versions"].items())
    lines = [
        f"Measured on {found['date']}: {at['processor']}, {at['cores']} cores, {at['system']},"
        f" Python {at['python']}; {versions}. Medians of up to {found['repeat']} turns; runs of"
        " more than two seconds once."
    ]
    lines += [f"Missing: {tool}: {why}." for tool, why in found["missing"].items()]
    return "\n".join(lines) + "\n"


def shown(found: dict[str, Any], records: list[Record]) -> str:
    """Targets with verdicts."""
    rows = [(t.what, t.asked, t.measured, t.verdict) for t in targets(found, records)]
    return (
        "## Targets\n\nA peer counts at its cheapest setting whose error does not exceed"
        " kempe's.\n\n" + table(("", "asked for", "measured", ""), rows)
    )


def floor(found: dict[str, Any]) -> str:
    """Evaluations and runs of the floor."""
    at, native = found["floor"], found["floor"]["native"]
    rows = []
    for name, key in (("floor", "chain"), ("straight", "straight"), ("kempe", "kempe")):
        cells = [name, f"{at['evaluation'][f'{key}_ns']:.0f}"]
        cells.append(f"{native['evaluation'][f'{key}_ns']:.0f}")
        cells += [f"{1e3 * run[key]['seconds']:.2f}" for run in at["runs"]]
        cells += [f"{run[key]['ns_per_evaluation']:.0f}" for run in at["runs"][1:2]]
        cells.append(f"{run_error(at, key)}")
        rows.append(cells)
    head = ("", "evaluation alone, ns", "native, ns", "15 s at 1e-3, ms", "1e-6, ms", "1e-9, ms")
    head += ("1e-6, ns for each evaluation", "error at 1e-6, rad")
    windows = "; ".join(f"N = {n}: {ns:.0f} ns" for n, ns in sorted_windows(at))
    last = f"kempe's evaluation for each window of N parallelograms: {windows}."
    return f"{FLOOR}\n{table(head, rows)}\n{last}\n"


def sorted_windows(at: dict[str, Any]) -> list[tuple[int, float]]:
    """By N."""
    return sorted((int(n), ns) for n, ns in at["windows"].items())


def run_error(at: dict[str, Any], key: str) -> str:
    """Of the floor's programs; kempe's stands with the problem."""
    error = at["runs"][1][key].get("error_rad")
    return f"{error:.1e}" if error else "see below"


def results(records: list[Record], name: str) -> str:
    """All settings on one problem."""
    told = problem(name)
    rows = []
    for r in [r for r in records if r.problem == name]:
        tolerance = f"{r.tolerance:g}" if r.tolerance else ""
        if r.good:
            numbers = (f"{1e3 * r.seconds:.3g}", f"{r.error:.1e}", f"{r.gap:.1e}")
        else:
            numbers = ("", (r.failure or "").replace("|", "/")[:100], "")
        rows.append((r.curve, tolerance, *numbers))
    head = ("", "rtol or step", "CPU time, ms", "error", "gap, m")
    image = f"![Error against CPU time: {told.title}](images/benchmarks/{name}.png)"
    crossed = crossings(records, name)
    ahead = (
        "\n".join(f"- {text}" for text in crossed) or "No peer is ahead of kempe's default method."
    )
    return (
        f"## {told.title}\n\nError: {told.error_of}.\n\n{image}\n\nWhere a peer is ahead of kempe's"
        f" default method at equal error:\n\n{ahead}\n\n{table(head, rows)}"
    )


def cost(records: list[Record]) -> str:
    """Cost against N."""
    rows = []
    for name in COST:
        for r in records:
            if r.problem == name and r.good and r.error <= ACCEPTED:
                n = name.removeprefix("windows_")
                rows.append((n, r.curve, f"{r.tolerance:g}", f"{r.seconds:.3g}", f"{r.error:.1e}"))
    head = ("N", "", "rtol or step", "CPU s for 1 s", "error of B0, m")
    return (
        "## Cost against N\n\nThe N-four-bar over its first second, which contains one singular"
        f" position; settings with an error of B0 below {ACCEPTED:g} m.\n\n"
        "![Cost against N](images/benchmarks/cost.png)\n\n" + table(head, rows)
    )


def tried(found: dict[str, Any]) -> str:
    """What was tried for each tool."""
    lines = "\n".join(f"- {tool}: {text}." for tool, text in found["tried"].items())
    return f"## Settings that were tried\n\n{lines}\n"


def page(found: dict[str, Any], records: list[Record]) -> str:
    """The whole page."""
    measured = list(dict.fromkeys(r.problem for r in records))
    parts = [HEAD, machine(found), shown(found, records)]
    parts += [floor(found)] if found.get("floor") else []
    parts += [results(records, name) for name in measured if name not in COST]
    parts += [cost(records)] if set(measured) & set(COST) else []
    return "\n".join([*parts, tried(found)])
