"""``kempe schema``: the JSON Schema of a case, for editors."""

from __future__ import annotations

EXAMPLES = """Examples:

  kempe schema > kempe.schema.json
"""


def schema() -> None:
    """Print the JSON Schema of a case, for checks and completion in editors."""
    from kempe.case import schema as text

    print(text(), end="")
