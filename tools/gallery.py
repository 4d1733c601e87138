"""The gallery: a page, a drawing and a player for each example.

Run ``.venv/bin/python tools/gallery.py``; it writes ``docs/gallery/*.md`` and the pictures in
``docs/images/gallery/``. Names on the command line choose some examples. ``--players FOLDER``
writes ``FOLDER/NAME.html`` instead, the players that the pages show on the documentation site in
``gallery/players/``.

A new example needs its file with a comment below the title, which is the paragraph of its page, and
its place in ``FAMILIES``.
"""

from __future__ import annotations

import argparse
import json
import re
import tempfile
import textwrap
from pathlib import Path

import kempe as kp
from kempe.draw.frame import Frame
from kempe.draw.player import page as player_page
from kempe.draw.scene import Scene, scene
from PIL import Image

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
PAGES = ROOT / "docs" / "gallery"
PICTURES = ROOT / "docs" / "images" / "gallery"
#: Inches, dots for each inch, and colours of a drawing and of its thumbnail.
SIZE, DOTS, SMALL_DOTS, COLOURS = (5.6, 3.15), 160, 60, 64
#: Frames of a player, at most, so that it is small.
FRAMES = 121
WIDTH, COLUMNS = 150, 3
_STYLE = 'style="width: 100%; height: 44rem; border: 0"'

CLASSICS = EXAMPLES / "classics"
#: All mechanisms by family, as the studio shows them.
FAMILIES: dict[str, list[str]] = json.loads(
    (ROOT / "studio" / "build" / "families.json").read_text("utf-8")
)
#: The instant of the drawing of an example, as a share of the motion; otherwise the start.
INSTANTS = {
    "six_bar": 0.1,
    "slider_crank": 0.1,
    "quick_return": 0.1,
    "wiper": 0.05,
    "garage_door": 0.15,
    "watt_six_bar": 0.1,
    "peaucellier": 0.15,
    "scotch_yoke": 0.1,
    "klann_leg": 0.1,
    "rack_steering": 0.2,
    "landing_gear": 0.45,
    "oldham_coupling": 0.1,
    "cam_roller": 0.1,
    "geneva_drive": 0.1,
    "excavator": 0.3,
    "boom": 0.5,
    "scissor_lift": 0.6,
    "crane_trolley": 0.2,
    "engine": 0.02,
    "two_cylinder_engine": 0.1,
    "motor_press": 0.5,
    "toggle_press": 0.1,
    "pump_jack": 0.1,
    "slamming_door": 0.1,
    "balanced_lamp": 0.5,
    "roberval_balance": 1.0,
    "trebuchet": 0.5,
    "leaf_spring_guide": 1.0,
    "cross_spring_pivot": 1.0,
    "bistable_switch": 0.35,
    "compliant_gripper": 1.0,
}
#: Paragraphs of examples whose files have no comment below the title, or a short one.
PARAGRAPHS = {
    "four_bar": (
        "Three bars and ground form a loop. A stiff spring between the third bar and ground "
        "drives it from rest, and a damper brings it to rest again after about two seconds. At "
        "the start the pin C carries 25 kN, two hundred times the weight of all bars: reactions "
        "follow from inertia, not from weight."
    ),
    "slamming_door": (
        "A door that nobody holds hits its stop on the floor, and the blow shakes the "
        "hinge. A stop at two thirds of the width, the centre of percussion, spares the hinge. A "
        "rubber buffer, in the second analysis, makes the blow longer and weaker. The drawing "
        "shows the door from above."
    ),
    "pendulum": (
        "The period of a pendulum grows with its amplitude. A slender rod that swings by 30° to "
        "each side takes 1.7 % longer than in small swings. The exact period is an elliptic "
        "integral, and the tests compare the motion with it."
    ),
    "six_bar": (
        "One motor drives two loops. A-B-C-D is a crank-rocker linkage; its rocker is a plate "
        "with a third pin E, which drives the second loop D-E-F-G. The second loop adds two "
        "bodies and three pins, so that the linkage still has one degree of freedom."
    ),
    "slider_crank": (
        "A crank and a rod turn a rotation into a motion to and fro. Because the rod is not "
        "infinitely long, the piston passes the outer half of its stroke in less time than the "
        "inner one. Without losses the speed of the crank varies between 29.6 and 35.6 rad/s: the "
        "flywheel gives the energy that the piston needs, and takes it back."
    ),
}


def names() -> list[str]:
    """All examples that have a page of the gallery."""
    return [
        name for members in FAMILIES.values() for name in members if path(name).parent == EXAMPLES
    ]


def path(name: str) -> Path:
    """The file of a mechanism."""
    found = CLASSICS / f"{name}.toml"
    return found if found.exists() else EXAMPLES / f"{name}.toml"


def text(name: str) -> str:
    """The file of a mechanism as text."""
    return path(name).read_text("utf-8")


def title(name: str) -> str:
    """The title of a mechanism."""
    return kp.load(path(name)).model.title


def paragraph(name: str) -> str:
    """What there is to learn: the comment below the title, or an entry of ``PARAGRAPHS``."""
    if name in PARAGRAPHS:
        return PARAGRAPHS[name]
    found = re.search(r"^((?:# .*\n)+)", text(name), re.M)
    assert found, f"examples/{name}.toml has no comment below its title"
    words = " ".join(found[1].replace("\n# ", "\n").removeprefix("# ").split())
    words = words.removeprefix("To learn: ")
    return words[0].upper() + words[1:]


def page(name: str) -> str:
    """The page of an example."""
    about = title(name)
    parts = (
        f"<!-- @generated by `tools/gallery.py` from `examples/{name}.toml`; do not edit. -->",
        f"# {about}\n",
        f"![{about}](../images/gallery/{name}.png)\n",
        filled(paragraph(name)),
        f'<iframe src="players/{name}.html" title="Player: {about}" loading="lazy" '
        f"{_STYLE}></iframe>\n",
        filled(
            f"`kempe new {name}` writes this case, [{name}.toml](../../examples/{name}.toml), and "
            f"`kempe run {name}.toml` computes the motion. The run writes "
            f"`out/{name}/animation.html`, [the player](../page.md) of the motion."
        ),
        f"```toml\n{text(name)}```\n",
    )
    return "\n".join(parts)


def filled(words: str) -> str:
    """A paragraph in lines of the width of pages."""
    lines = textwrap.fill(words, WIDTH, break_long_words=False, break_on_hyphens=False)
    return f"{lines}\n"


def sheet() -> str:
    """The first page: a thumbnail of each example, by family."""
    parts = [
        "<!-- @generated by `tools/gallery.py`; do not edit. -->\n# Gallery\n",
        filled(
            "Each mechanism has a page with a drawing, a player, one thing to learn and the case "
            "file. The tests compare the mechanics of each with formulas or with an independent "
            "program. `kempe new NAME` writes the file of one; `kempe new` lists all names."
        ),
        filled(
            "The lists below the drawings name more mechanisms, whose files are in "
            "`examples/classics/`. [The studio](../studio.md) shows all of them in motion."
        ),
    ]
    for family, all_members in FAMILIES.items():
        members = [name for name in all_members if path(name).parent == EXAMPLES]
        more = [
            f"* [{about}](../../examples/classics/{name}.toml):{says}"
            for name in all_members
            if name not in members
            for about, _, says in [title(name).partition(":")]
        ]
        cells = [
            f"[![{title(name)}](../images/gallery/small/{name}.png)]({name}.md)<br>"
            f"[{title(name).partition(':')[0]}]({name}.md)"
            for name in members
        ]
        cells += [""] * (-len(cells) % COLUMNS)
        rows = [cells[k : k + COLUMNS] for k in range(0, len(cells), COLUMNS)]
        lines = [f"| {' | '.join(row)} |" for row in rows]
        lines.insert(1, "|---" * COLUMNS + "|")
        parts.append(f"## {family}\n\n" + "\n".join(lines) + "\n")
        if more:
            parts.append("\n".join(more) + "\n")
    return "\n".join(parts)


def motion(name: str) -> kp.Solution:
    """The first motion of an example."""
    results = kp.load(EXAMPLES / f"{name}.toml").run().values()
    return next(result for result in results if isinstance(result, kp.Solution))


def drawings(name: str) -> tuple[Image.Image, Image.Image]:
    """The drawing of an example and its thumbnail, which has no names."""
    shown = scene(motion(name))
    k = round(INSTANTS.get(name, 0.0) * (len(shown["frames"]["t"]) - 1))
    return picture(shown, k, DOTS, labels=True), picture(shown, k, SMALL_DOTS, labels=False)


def picture(shown: Scene, k: int, dots: int, *, labels: bool) -> Image.Image:
    """A frame without title and time, in few colours; without names it has no scale either."""
    frame = Frame(shown, dots, SIZE, labels=labels)
    for words in frame.axes.texts:
        if words.get_verticalalignment() == "top" or not labels:
            words.set_visible(False)
    frame.axes.lines[-1].set_visible(labels)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "frame.png")
        frame.save(k, path)
        with Image.open(path) as image:
            return image.convert("RGB").quantize(COLOURS)


def player(name: str) -> str:
    """The page that plays an example, with fewer frames than that of a run."""
    return player_page(scene(motion(name), frames=FRAMES))


def main() -> None:
    """Write the gallery, or the players."""
    given = argparse.ArgumentParser(description="Write the gallery.")
    given.add_argument("names", nargs="*", default=names(), metavar="NAME")
    given.add_argument("--players", type=Path, metavar="FOLDER", help="write players instead")
    chosen = given.parse_args()
    if chosen.players:
        chosen.players.mkdir(parents=True, exist_ok=True)
        for name in chosen.names:
            (chosen.players / f"{name}.html").write_text(player(name), "utf-8")
        return
    (PICTURES / "small").mkdir(parents=True, exist_ok=True)
    PAGES.mkdir(exist_ok=True)
    (PAGES / "README.md").write_text(sheet(), "utf-8")
    for name in chosen.names:
        (PAGES / f"{name}.md").write_text(page(name), "utf-8")
        large, small = drawings(name)
        large.save(PICTURES / f"{name}.png", optimize=True)
        small.save(PICTURES / "small" / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
