"""The command line. This file handles ``--version`` quickly; ``app`` handles everything else."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from kempe._version import __version__
from kempe.cli.exit_codes import OK
from kempe.cli.streams import code_of


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code (see ``exit_codes``).

    Args:
        arguments: words after the program name; by default those of the process.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    return code_of(lambda: _run(words))


def _run(words: list[str]) -> int:
    if words in (["--version"], ["-V"]):
        print(f"kempe {__version__}")
        return OK
    # Imported here because typer and rich are slow to import.
    from kempe.cli.app import run

    return run(words)
