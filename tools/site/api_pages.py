"""The pages of the Python reference: which names each of them describes.

Signatures and texts come from the sources. ``tests/site/test_site.py`` checks that every public
name of kempe is on one of these pages.
"""

from __future__ import annotations

import ast
from pathlib import Path
from typing import NamedTuple

SOURCES = Path(__file__).parents[2] / "python"


class ApiPage(NamedTuple):
    """A page of the reference.

    Attributes:
        title: its heading.
        about: a sentence below the heading.
        names: the objects in order, as ``kempe.NAME``; ``kempe.MODULE.*`` is every name in the
            ``__all__`` of a module.
    """

    title: str
    about: str
    names: tuple[str, ...]


PAGES = {
    "model": ApiPage(
        "Models and cases",
        "A model contains bodies, joints, drivers and forces. A case adds a start and analyses, "
        "and is what a file contains.",
        (
            "kempe.Model",
            "kempe.model.ground.Ground",
            "kempe.Sampled",
            "kempe.Case",
            "kempe.load",
            "kempe.Results",
        ),
    ),
    "elements": ApiPage(
        "Elements",
        "One class for each joint, driver and force. The method of `kp.Model` with the name of its "
        "type adds it: `m.revolute(...)` adds a `Revolute`.",
        ("kempe.model.elements",),
    ),
    "analyses": ApiPage(
        "Analyses",
        "Functions that compute something from a model and a state.",
        (
            "kempe.assemble",
            "kempe.dynamics",
            "kempe.Stepper",
            "kempe.SavedStep",
            "kempe.export_fmu",
            "kempe.kinematics",
            "kempe.inverse_dynamics",
            "kempe.equilibrium",
            "kempe.stiffness_at",
            "kempe.modes",
            "kempe.limits",
            "kempe.reachable",
            "kempe.mobility",
            "kempe.configurations",
            "kempe.study",
            "kempe.Study",
            "kempe.sweep",
            "kempe.SweepResult",
            "kempe.gradient",
            "kempe.Gradient",
            "kempe.optimize",
            "kempe.Path",
            "kempe.Optimum",
            "kempe.fit",
            "kempe.Data",
            "kempe.Fit",
            "kempe.compare",
            "kempe.Comparison",
            "kempe.tolerances",
            "kempe.Tolerances",
            "kempe.allocate",
            "kempe.Allocation",
        ),
    ),
    "synthesis": ApiPage(
        "Synthesis",
        "Linkages for poses, points and pairs of angles: `kp.synthesis`.",
        ("kempe.synthesis.*",),
    ),
    "options": ApiPage(
        "Options and methods",
        "Options of the analyses, methods of integration and stabilizations of the constraints.",
        (
            "kempe.Dynamics",
            "kempe.RK45",
            "kempe.DOP853",
            "kempe.RK4",
            "kempe.Radau",
            "kempe.GeneralizedAlpha",
            "kempe.HHT",
            "kempe.Auto",
            "kempe.Projection",
            "kempe.Baumgarte",
            "kempe.NoStabilization",
            "kempe.Kinematics",
            "kempe.InverseDynamics",
            "kempe.Equilibrium",
            "kempe.Modes",
            "kempe.Limits",
            "kempe.Reachable",
            "kempe.Mobility",
            "kempe.Configurations",
            "kempe.Event",
        ),
    ),
    "results": ApiPage(
        "Results",
        "What the analyses return, and the parts of it.",
        (
            "kempe.Solution",
            "kempe.State",
            "kempe.Motion",
            "kempe.Energy",
            "kempe.Start",
            "kempe.AssemblyReport",
            "kempe.EquilibriumResult",
            "kempe.PointStiffness",
            "kempe.ModesResult",
            "kempe.LimitsResult",
            "kempe.ReachableResult",
            "kempe.MobilityResult",
            "kempe.ConfigurationsResult",
            "kempe.load_solution",
            "kempe.write_report",
            "kempe.report.*",
            "kempe.show",
            "kempe.equations",
            "kempe.Matrices",
            "kempe.Labelled",
            "kempe.Units",
            "kempe.units",
        ),
    ),
    "design": ApiPage("Design", "What a designer reads from a motion.", ("kempe.design.*",)),
    "plot": ApiPage(
        "Figures", "Figures with Matplotlib; one function for each.", ("kempe.plot.*",)
    ),
    "draw": ApiPage(
        "Drawings, players and reports",
        "Drawings, videos, pages that play a motion, and reports.",
        (
            "kempe.animate",
            "kempe.player",
            "kempe.still",
            "kempe.scene",
            "kempe.write_report",
            "kempe.write_dxf",
            "kempe.write_mjcf",
            "kempe.write_asmt",
        ),
    ),
    "errors": ApiPage(
        "Errors and warnings",
        "All errors of kempe, with their attributes. [errors.md](../errors.md) gives messages and "
        "remedies.",
        (
            "kempe.KempeError",
            "kempe.ModelError",
            "kempe.AssemblyError",
            "kempe.RedundancyError",
            "kempe.SingularityError",
            "kempe.IntegrationError",
            "kempe.FileError",
            "kempe.InternalError",
            "kempe.AccuracyWarning",
            "kempe.AssemblyWarning",
            "kempe.EventWarning",
            "kempe.FunctionWarning",
            "kempe.ModelWarning",
        ),
    ),
}


def markdown(page: ApiPage) -> str:
    """The source of a page; mkdocstrings replaces each `:::` by signature and docstring."""
    names = [inner for name in page.names for inner in _expanded(name)]
    blocks = "\n\n".join(f"::: {name}" for name in names)
    return f"# {page.title}\n\n{page.about}\n\n{blocks}\n"


def _expanded(name: str) -> list[str]:
    """The names that a name of a page means; ``__all__`` is read without importing kempe."""
    module, star, _ = name.partition(".*")
    if not star:
        return [name]
    path = SOURCES.joinpath(*module.split("."), "__init__.py")
    for node in ast.parse(path.read_text("utf-8")).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return [f"{module}.{inner}" for inner in ast.literal_eval(node.value)]
    raise LookupError(f"{path} has no __all__")


def index() -> str:
    """The page that lists the others."""
    rows = "\n".join(
        f"| [{page.title}]({name}.md) | {page.about.split('. ')[0].rstrip('.')} |"
        for name, page in PAGES.items()
    )
    return f"""# Python reference

All public names with their signatures, from the sources of this version. After
`import kempe as kp`, they are names of `kp`, such as `kp.dynamics`, or of its modules, such as
`kp.plot.energy`. [Python](../python.md) shows them at work.

| page | content |
|---|---|
{rows}
"""
