"""One adapter for each tool.

An adapter is a module with NAME, TRIED (the settings that were tried), `missing()`, `version()`,
`settings(problem, quick)`, `prepare(problem, setting)` and `motion(problem, found)`. `prepare`
builds everything and returns the function to be timed. `motion` reads the result of this function.
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
    """The adapters with these NAMEs; all for None."""
    found = [import_module(f"peers.{name}") for name in TOOLS]
    known = {tool.NAME for tool in found}
    if unknown := set(names or ()) - known:
        raise SystemExit(f"unknown tools: {', '.join(sorted(unknown))}; there are {sorted(known)}")
    return [tool for tool in found if names is None or tool.NAME in names]
