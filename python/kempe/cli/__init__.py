"""The command line. This file answers ``--version`` at once; the rest is in ``app``."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from kempe._version import __version__
from kempe.cli.exit_codes import OK


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code (see ``exit_codes``).

    Args:
        arguments: words after the program's name; those of the process by default.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words in (["--version"], ["-V"]):
        print(f"kempe {__version__}")
        return OK
    # Only now: typer and rich take longer to load than the answer above may take.
    from kempe.cli.app import run

    return run(words)
