"""The reference values, which the tests use as well."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]


@cache
def reference(name: str) -> Any:
    """One file of tests/reference."""
    return json.loads((ROOT / "tests" / "reference" / f"{name}.json").read_text("utf-8"))
