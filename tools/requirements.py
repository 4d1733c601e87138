"""Print what pyproject.toml requires, one package a line: `requirements.py run` or `… test`.

It needs nothing but the standard library and pip, since it runs before anything is installed.
"""

import sys
from pathlib import Path

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib


def requirements(purpose: str) -> list[str]:
    """What must be installed to build and run kempe, and also to test it for "test"."""
    text = Path(__file__).parent.with_name("pyproject.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    names = table["build-system"]["requires"] + table["project"]["dependencies"]
    if purpose == "test":
        extras = table["project"]["optional-dependencies"]
        names += extras["test"] + extras["docs"]
    return names


if __name__ == "__main__":
    print("\n".join(requirements(sys.argv[1])))
