"""The order of the analyses of a case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


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
