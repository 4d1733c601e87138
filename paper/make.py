"""Write `paper/paper.md` from `paper/text.md`.

    PYTHONPATH=benchmarks .venv/bin/python -m paper.make

`{name}` in the text stands for a number of `paper/printed.py`. The text has no other numbers.
"""

import re
from pathlib import Path

from paper.printed import numbers

TEXT = Path(__file__).with_name("text.md")
PAPER = Path(__file__).with_name("paper.md")
NOTE = "<!-- Written by paper/make.py from paper/text.md; do not edit. -->"


def paper() -> str:
    """The paper with its numbers."""
    known = numbers()
    head, body = TEXT.read_text("utf-8").split("\n---\n", 1)
    whole = f"{head}\n---\n\n{NOTE}\n{body}"
    return re.sub(r"\{(\w+)\}", lambda found: known[found[1]], whole)


if __name__ == "__main__":
    PAPER.write_text(paper(), "utf-8", newline="\n")
    print(f"{PAPER}: {len(re.findall(r'[A-Za-z]+', PAPER.read_text('utf-8')))} words")
