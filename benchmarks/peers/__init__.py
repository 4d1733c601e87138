"""One adapter for each tool.

An adapter is a module with NAME, TRIED (what was tried to find its best settings), `missing()`,
`version()`, `settings(problem, quick)`, `prepare(problem, setting)`, which builds everything and
returns the run that is timed, and `motion(problem, found)`, which reads what the run returned.
"""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

TOOLS = (
    "kempe_itself",
    "mujoco_tree",
    "exudyn_planar",
    "casadi_sundials",
    "numba_dormand_prince",
    "numpy_scipy",
)


def tools(names: list[str] | None = None) -> list[ModuleType]:
    """The adapters with these NAMEs, all when None."""
    found = [import_module(f"peers.{name}") for name in TOOLS]
    known = {tool.NAME for tool in found}
    if unknown := set(names or ()) - known:
        raise SystemExit(f"unknown tools: {', '.join(sorted(unknown))}; there are {sorted(known)}")
    return [tool for tool in found if names is None or tool.NAME in names]
