"""Building the page of the studio in a checkout."""

from __future__ import annotations

import os
import subprocess
import sys

from kempe.errors import FileError
from kempe.studio import sources

#: The exit code of the script if a tool is missing.
MISSING = 5


def build() -> None:
    """Build the page of the present sources with ``tools/build_studio.sh``.

    The script writes its progress, and what is missing, to stderr.

    Raises:
        FileError: there are no sources, a tool is missing, or the build fails.
    """
    if sources.checksum() is None:
        raise FileError(
            "an installed kempe has no sources of the page to build",
            hint="run ./kempe studio --build in a checkout of the repository",
        )
    script = sources.ROOT / "tools" / "build_studio.sh"
    variables = os.environ | {"PYTHON": sys.executable}
    try:
        code = subprocess.run(["sh", str(script)], env=variables, check=False).returncode
    except OSError as error:
        raise FileError(f"{script}: {error.strerror or error}", hint="it needs a shell") from error
    if code == MISSING:
        raise FileError(
            "the page of the studio was not built, because a tool is missing",
            hint="the line above names it; kempe studio without --build needs no tools",
        )
    if code:
        raise FileError(
            "the page of the studio was not built",
            hint="correct what the lines above report, or leave --build out",
        )
