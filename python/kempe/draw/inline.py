"""The player within a notebook."""

from __future__ import annotations

import html

#: Height of the player in a notebook, pixels.
_HEIGHT = 460


class InlinePlayer:
    """A page that plays a motion, shown below the cell of a notebook.

    Attributes:
        page: the text of the page; ``kp.animate(sol, "motion.html")`` writes the same to a file.
    """

    def __init__(self, page: str, title: str) -> None:
        self.page = page
        self._title = title

    def _repr_html_(self) -> str:
        return (
            f'<iframe title="{html.escape(self._title)}" srcdoc="{html.escape(self.page)}" '
            f'style="width: 100%; height: {_HEIGHT}px; border: 0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"<InlinePlayer of {self._title!r}: the last value of a cell of a notebook plays>"
