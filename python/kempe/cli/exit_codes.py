"""What the exit code of the command line means.

``./kempe`` adds one of its own: 5, the set-up could not be done.
"""

from __future__ import annotations

OK = 0
INTERNAL = 1  # a fault in kempe; Python's own code for an uncaught exception
BAD_INPUT = 2  # wrong arguments, or a wrong model; the shell's habit for wrong usage
MECHANICS = 3  # the model is right, but the mechanism cannot do this
FILE = 4  # a file cannot be read or written
INTERRUPTED = 130  # Ctrl-C, as shells count it: 128 + SIGINT
