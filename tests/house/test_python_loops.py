"""Modules of the Python package import each other in one direction, inside functions too."""

from itertools import accumulate

import kempe._upwards
from house.places import ROOT
from house.python_imports import Graph, folder, graph, loops, modules

#: Folders and single files from bottom to top; each may import those of earlier rows and itself.
ROWS = (
    ("_core", "_processor", "_upwards", "_version", "errors"),
    ("base",),
    ("foreign", "model"),
    ("results",),
    ("analyses", "mjcf"),
    ("case",),
    ("loading",),
    ("asmt", "design", "draw", "report", "stepping", "studio", "sweeps", "templates"),
    ("exercise", "fmu", "synthesis"),
    ("plot",),
    ("lab_report", "notebook"),
    ("cli",),
    ("__main__", "_compact", "_generate", "_reference"),
)
#: What each may import.
BELOW = dict(
    pair
    for row, below in zip(ROWS, accumulate(ROWS, initial=()), strict=False)
    for pair in ((part, {*below, part}) for part in row)
)
BELOW["_compact"].add("_reference")
BELOW["_generate"] |= {"_compact", "_reference"}
#: Imports upwards that only type checkers read, with the reason for each.
TYPES = {
    ("kempe.model.functions", "kempe.results.state"): "a law f(t, state) receives a State",
    ("kempe.analyses.iterations", "kempe.case"): "it repeats the assembly of a case",
}
#: Calls upwards, which ``kempe/__init__.py`` defines, with the reason for each.
CALLS = {
    "html": "a model, a state or a solution shows a drawing in a notebook",
    "model": "a compiled model that was read from a text has a Model when a user needs it",
    "slopes": "a run keeps its slopes, which sweeps compute",
    "state": "a Python function as a law of a force receives a State",
}

#: The modules that call upwards.
USERS = {
    "kempe.analyses.dynamics",
    "kempe.model.compiled",
    "kempe.model.functions",
    "kempe.model.model",
    "kempe.results.matrices.values",
    "kempe.results.result",
    "kempe.results.solution",
    "kempe.results.state",
    "kempe.sweeps.gradients.result",
    "kempe.sweeps.result",
}

#: The root has no imports of its own: it imports each public name on first use.
TEXTS = {**modules(), "kempe": ""}
GRAPH, WITH_TYPES = graph(TEXTS), graph(TEXTS, types=True)


def upwards(edges: Graph) -> set[tuple[str, str]]:
    return {
        (module, other)
        for module, others in edges.items()
        for other in others
        if "kempe" not in (module, other) and folder(other) not in BELOW[folder(module)]
    }


def test_no_modules_import_each_other_in_a_circle() -> None:
    assert loops(GRAPH) == []


def test_every_folder_imports_only_those_below_it() -> None:
    assert {folder(module) for module in TEXTS} - {""} <= set(BELOW)
    assert upwards(GRAPH) == set()


def test_the_types_of_upper_modules_are_listed() -> None:
    found = upwards(WITH_TYPES)
    packages = {b for _, b in found if any(other.startswith(f"{b}.") for _, other in found)}
    assert {(a, b) for a, b in found if b not in packages} == set(TYPES)


def test_no_module_reads_names_of_the_root() -> None:
    users = {module for module, others in GRAPH.items() if "kempe" in others}
    # the first replaces the core there, the second lists the public names and is imported by none
    assert users == {"kempe._processor", "kempe._compact"}


def test_the_calls_upwards_are_known_and_described() -> None:
    assert set(kempe._upwards.CALLS) == set(CALLS)
    users = {module for module, others in GRAPH.items() if "kempe._upwards" in others}
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    assert users == USERS
    assert not [name for name in CALLS if f"`{name}`" not in text]


def test_a_circle_is_found_through_a_function_and_a_package() -> None:
    texts = {
        "kempe": "",
        "kempe.a": "def f():\n    from kempe.b.inner import g",
        "kempe.b": "from kempe.b import outer",
        "kempe.b.inner": "",
        "kempe.b.outer": "from kempe.a import f",
    }
    assert loops(graph(texts)) == [{"kempe.a", "kempe.b", "kempe.b.outer"}]
    texts["kempe.b.outer"] = "if TYPE_CHECKING:\n    from kempe.a import f"
    assert loops(graph(texts)) == []
    assert loops(graph(texts, types=True)) == [{"kempe.a", "kempe.b", "kempe.b.outer"}]
