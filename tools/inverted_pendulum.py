"""The figure of docs/tutorials/inverted_pendulum.md, from the code of that page.

Run ``.venv/bin/python tools/inverted_pendulum.py``; it writes
``docs/images/inverted_pendulum.png``.
"""

import re
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

DOCS = Path(__file__).parents[1] / "docs"
PAGE = DOCS / "tutorials" / "inverted_pendulum.md"
TARGET = DOCS / "images" / "inverted_pendulum.png"
#: The heading after the code whose solution is drawn.
END = "## How large may the tilt be?"


def main() -> None:
    """Run the code of the page and draw its solution."""
    names: dict[str, Any] = {}
    text = PAGE.read_text("utf-8").partition(END)[0]
    for code in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        exec(code, names)
    sol = names["sol"]
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.4), layout="constrained")
    t = np.linspace(0, 3, 3001)
    at = sol(t)
    axes[0].plot(t, np.degrees(at["rod.angle"]) - 90)
    axes[1].plot(t, at["cart.x"])
    first = t <= 0.3
    axes[2].plot(t[first], at["drive.fx"][first])
    for ax, title in zip(axes, ("tilt / °", "place of the cart / m", "force / N"), strict=True):
        ax.set(xlabel="t / s", title=title)
        ax.grid(visible=True, linewidth=0.4)
    figure.savefig(TARGET, dpi=110)


if __name__ == "__main__":
    main()
