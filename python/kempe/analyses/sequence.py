"""The analyses of a case: their entries, and their order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from kempe.errors import ModelError

if TYPE_CHECKING:
    from kempe.analyses.option import Analysis


def of_type(entries: Mapping[str, Mapping[str, Any]], kind: str) -> dict[str, dict[str, Any]]:
    """The analyses of one type with those that they start from; each names its start."""
    names = list(entries)
    before = dict(zip(names, ["start", *names], strict=False))
    starts = {name: entries[name].get("from", before[name]) for name in names}
    kept = {"start"}
    for name in names:
        at = name if entries[name]["type"] == kind else "start"
        while at not in kept:
            kept.add(at)
            at = starts[at]
    return {name: {**entries[name], "from": starts[name]} for name in names if name in kept}


def read_entries(
    analyses: Sequence[Analysis] | Mapping[str, Mapping[str, Any]],
) -> dict[str, dict[str, Any]]:
    """The entries of a file by name, from analyses or from such entries."""
    from kempe.analyses.option import Analysis
    from kempe.model.values import listed, mapping, plain, reference

    form = "{'type': 'dynamics', 't_end': 1}"
    if isinstance(analyses, Mapping):
        found = {}
        for name, entry in analyses.items():
            path = f"analyses.{reference(name, 'name of an analysis')}"
            found[name] = plain(mapping(entry, path, form), path)
        return found
    entries: dict[str, dict[str, Any]] = {}
    for analysis in listed(analyses, "analyses"):
        if not isinstance(analysis, Analysis):
            raise ModelError(f"{analysis!r} is not an analysis", hint="kp.Dynamics(…) makes one")
        if analysis.name in entries:
            raise ModelError(
                f"analyses.{analysis.name}: the name is taken", hint="give name= to each"
            )
        entries[analysis.name] = analysis.tree()
    return entries
