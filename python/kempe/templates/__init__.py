"""The examples of the source tree, for ``kempe new``; a test compares them with ``examples/``."""

from __future__ import annotations

from pathlib import Path

from kempe import files
from kempe.names import one_of

#: The name of each example and the file that ``kempe new`` writes.
FILES = {
    "pendulum": "pendulum.toml",
    "slider_crank": "slider_crank.toml",
    "four_bar": "four_bar.toml",
    "six_bar": "six_bar.toml",
    "scotch_yoke": "scotch_yoke.toml",
    "quick_return": "quick_return.toml",
    "cam_roller": "cam_roller.toml",
    "planetary_gear": "planetary_gear.toml",
    "watt_six_bar": "watt_six_bar.toml",
    "peaucellier": "peaucellier.toml",
    "jansen_leg": "jansen_leg.toml",
    "toggle_press": "toggle_press.toml",
    "excavator": "excavator.toml",
    "boom": "boom.toml",
    "engine": "engine.toml",
    "motor_press": "motor_press.toml",
    "garage_door": "garage_door.toml",
    "squeezer": "squeezer.toml",
    "n_four_bar": "n_four_bar.py",
}
NAMES = tuple(FILES)


def template(name: str) -> str:
    """The text of an example: a case (TOML with comments) or a program (Python).

    Args:
        name: one of ``NAMES``.

    Raises:
        ModelError: there is no such example.
    """
    one_of("example", name, NAMES)
    file = FILES[name]
    # A program is stored as text, so that it is not a module of the package.
    stored = f"{file}.txt" if file.endswith(".py") else file
    return files.read_text(Path(__file__).with_name(stored))


def title(name: str) -> str:
    """The title of an example, on one line.

    Args:
        name: one of ``NAMES``.
    """
    text = template(name)
    if FILES[name].endswith(".py"):
        return text.split('"""', 2)[1].splitlines()[0].rstrip(".")
    from kempe.case import parsed

    return parsed(text, "toml", name).model.title
