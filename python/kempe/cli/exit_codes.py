"""Exit codes of the command line.

``./kempe`` adds the code 5: its environment cannot be set up.
"""

from __future__ import annotations

OK = 0
INTERNAL = 1  # internal error; Python's code for an uncaught exception
BAD_INPUT = 2  # wrong arguments or an invalid model; the shell's convention for wrong usage
MECHANICS = 3  # the model is valid, but it cannot be assembled or simulated
FILE = 4  # a file cannot be read or written
INTERRUPTED = 130  # Ctrl-C; the shell's convention: 128 + SIGINT
CLOSED_PIPE = 141  # the reader of the output has gone; the shell's convention: 128 + SIGPIPE
