"""``python -m kempe`` runs the command line."""

import sys

from kempe.cli import main

if __name__ == "__main__":
    sys.exit(main())
