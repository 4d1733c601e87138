"""Print what pyproject.toml requires, one package a line.

`requirements.py run`, or test, packages or release, for another purpose.

tools/lock.sh adds the versions and hashes.
"""

import sys
from pathlib import Path

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib


def requirements(purpose: str) -> list[str]:
    """What must be installed to build and run kempe, or also for another purpose."""
    text = Path(__file__).parent.with_name("pyproject.toml").read_text(encoding="utf-8")
    table = tomllib.loads(text)
    extras = table["project"]["optional-dependencies"]
    if purpose in ("packages", "release"):
        return list(extras[purpose])
    names = table["build-system"]["requires"] + table["project"]["dependencies"]
    if purpose == "test":
        names += extras["test"] + extras["docs"]
    return names


if __name__ == "__main__":
    print("\n".join(requirements(sys.argv[1])))
