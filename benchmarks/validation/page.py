"""The page docs/validation.md from the results."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.validation.comparison import ROOT, Benchmark, Comparison
from benchmarks.validation.conservation import CLOSED, KEPT, STEPS, Conserved
from benchmarks.validation.convergence import PROBLEMS, TOLERANCE, Convergence
from benchmarks.validation.results import Results

#: The comparison with assembly files, which are not part of the repository.
ASSEMBLIES = ROOT / "benchmarks" / "validation" / "assemblies.md"
PAGE = ROOT / "docs" / "validation.md"
#: The figure of each problem, from docs/.
FIGURES = {p.name: f"images/convergence_{p.name.replace('-', '_')}.png" for p in PROBLEMS}

HEAD = """\
# Validation

This page compares results of kempe with published results. The published numbers are in
`tests/reference/` and are independent of kempe. Each row of a table represents several numbers of
one kind and shows the pair with the largest difference. The tests repeat all computations. This
command uses the public Python interface to generate the page, its figures and
`benchmarks/validation/results.json`:

    python -m benchmarks.validation

The exit code is 1 if a difference exceeds the tolerance.
"""

CONVERGENCE = """
## Observed orders

The tables show errors of all integrators with constant steps and projection. The steps are the
coarsest step and three halvings of it. The error is the largest error over the common times of all
runs, relative to the largest value. The reference is DOP853 at rtol 1e-14. The observed order is
the slope of log error over log step, fitted by least squares. It must agree with theory within
{tolerance}. The multipliers in the output are computed from the state, so they converge with the
order of the coordinates.
"""

CONSERVATION = """\
## Conservation

This command repeats the run of one method:

    python -m benchmarks.validation.conservation --method DOP853

The flagship without its spring-damper is released from rest with the crank at -60° and swings
through 83° without damping. The constant step is 1/{steps} of the period of {period:.6f} s. The
states are projected onto the constraints. The residual is the largest |Φ| and must not exceed
{closed:.0e} m. The drift is the largest change of the energy relative to the largest kinetic
energy.
"""


def page(results: Results) -> str:
    """The whole page."""
    numbers = map(section, results.benchmarks)
    observed = (convergence(results.convergence), conservation(results.conservation))
    return "\n".join([HEAD, *numbers, *observed, ASSEMBLIES.read_text("utf-8")])


def section(benchmark: Benchmark) -> str:
    """One benchmark: source, settings, table and missing entries."""
    return "\n".join(_section(benchmark))


def _section(benchmark: Benchmark) -> Iterator[str]:
    yield f"## {benchmark.title}\n"
    yield f"Source (`tests/reference/{benchmark.reference}`): {benchmark.source}.\n"
    yield f"Settings: {benchmark.settings}.\n"
    yield "| quantity | unit | numbers | published | kempe | difference | tolerance |"
    yield "|---|---|---|---|---|---|---|"
    yield from map(row, benchmark.comparisons)
    yield ""
    if benchmark.missing:
        yield "Not reproduced yet:\n"
        yield from (f"- {missing.what}: {missing.reason}" for missing in benchmark.missing)
        yield ""


def row(c: Comparison) -> str:
    """One line of the table."""
    mark = "" if c.holds else " **off**"
    numbers = f"{digits(c.published, c.tolerance)} | {digits(c.kempe, c.tolerance)}"
    return (
        f"| {c.quantity} | {c.unit} | {c.count} | {numbers} "
        f"| {c.difference:.1e}{mark} | {c.tolerance:.0e} |"
    )


def digits(x: float, tolerance: float) -> str:
    """The number with the digits of the tolerance and one more."""
    places = max(1, 1 - int(f"{tolerance:e}".split("e")[1]))
    return f"{x:.{min(places, 15)}f}"


def convergence(found: tuple[Convergence, ...]) -> str:
    """Table and figures of the observed orders."""
    lines = [CONVERGENCE.format(tolerance=TOLERANCE)]
    for problem in PROBLEMS:
        name = problem.name.capitalize()
        lines += [f"### {name}: {problem.told}, {problem.t_end:g} s\n"]
        lines += [f"![error over step]({FIGURES[problem.name]})\n"]
        lines += ["| method | steps | errors of q | errors of λ | order of q | of λ | theory |"]
        lines += ["|---|---|---|---|---|---|---|"]
        lines += [order_row(c, problem.t_end) for c in found if c.problem == problem.name] + [""]
    return "\n".join(lines)


def order_row(c: Convergence, t_end: float) -> str:
    """One method."""
    steps = f"{t_end / c.steps[0]:.0f} … {t_end / c.steps[-1]:.0f}"
    q, lam = (", ".join(f"{error:.0e}" for error in errors) for errors in (c.q, c.lam))
    mark = "" if c.holds else " **off**"
    observed = " | ".join(f"{order:.2f}" for order in c.orders)
    theory = ", ".join(f"{order:g}" for order in c.theory)
    return f"| {c.method} | {steps} | {q} | {lam} | {observed}{mark} | {theory} |"


def conservation(found: tuple[Conserved, ...]) -> str:
    """Table of the long runs."""
    head = CONSERVATION.format(steps=STEPS, period=found[0].period, closed=CLOSED)
    lines = [head, "| method | steps | residual, m | drift | allowed |", "|---|---|---|---|---|"]
    for c in found:
        allowed = f"{KEPT[c.method]:.0e}" if c.method in KEPT else "–"
        mark = "" if c.holds else " **off**"
        lines.append(
            f"| {c.method} | {c.steps} | {c.residual:.1e} | {c.drift:.1e}{mark} | {allowed} |"
        )
    return "\n".join([*lines, ""])
