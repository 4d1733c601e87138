"""The player: a page that shows a motion, in a single file that needs no network.

All names of a user are data: the scene is JSON in a script element that no browser executes, with
every ``<`` escaped, and the page inserts names as text. The content security policy of the page
forbids all requests, and all scripts except its own, which the policy identifies by a hash.

The script and the style are bundled from ``studio/src/player``, which shares its painters with the
studio; ``npm run build`` in ``studio/`` writes them.
"""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
from importlib import resources
from pathlib import Path
from typing import Any

from kempe._version import __version__
from kempe.base import files
from kempe.base.arguments import explained
from kempe.draw.frame import frame_items
from kempe.draw.numbers import rounded_all
from kempe.draw.sampling import Span
from kempe.draw.scene import Scene, scene
from kempe.results.solution import Solution
from kempe.results.state import State


@explained
def player(
    solution: Solution | State,
    path: Path | str,
    *,
    speed: float = 1.0,
    span: Span | None = None,
    labels: bool = True,
) -> Path:
    """Write a page that plays a motion; any browser can open it, also without a network.

    Args:
        solution: the motion; a state is shown at rest.
        path: the file, such as ``animation.html``.
        speed: 2 plays twice as fast at the start; it can be changed on the page.
        span: first and last time that are shown, s; the whole motion by default.
        labels: whether to write the numbers of bodies and the names of joints and elements.

    Returns:
        The path.

    Raises:
        FileError: the file cannot be written; an existing file is then unchanged.
    """
    shown = scene(solution, span=span)
    shown["playback"]["rate"] *= speed
    files.write_text(path, page(shown, labels=labels))
    return files.checked_path(path, "write")


def page(shown: Scene, *, labels: bool = True) -> str:
    """The text of the page that shows a scene, with its display list."""
    shown = {**_remarked(shown), "display": rounded_all(frame_items(shown, labels=labels))}
    style, script = _asset("player.css"), _asset("player.js")
    policy = (
        f"default-src 'none'; script-src '{_hash(script)}'; style-src '{_hash(style)}'; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    parts = {
        "policy": policy,
        "version": html.escape(__version__),
        "title": html.escape(shown["title"] or "Linkage"),
        "style": style,
        "scene": _json_for_html(shown),
        "script": script,
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], _asset("player.html"))


def _remarked(shown: Scene) -> Scene:
    """The scene with a remark after the names of joints and drivers without a unique reaction.

    Their ends get the same names, by which the page finds the forces.
    """
    choices = shown["choices"]

    def remarked(one: dict[str, Any], key: str) -> dict[str, Any]:
        name = one[key]
        return {**one, key: f"{name} ({choices[name]})"} if name in choices else one

    joints = [remarked(joint, "name") for joint in shown["joints"]]
    channels = [
        remarked(one, "of") if one["group"] == "reactions" else one for one in shown["channels"]
    ]
    ends = [remarked(end, "element") for end in shown["ends"]]
    return {**shown, "joints": joints, "channels": channels, "ends": ends}


def _json_for_html(shown: Scene) -> str:
    """JSON in ASCII that cannot end the HTML element around it."""
    text = json.dumps(shown, allow_nan=False, separators=(",", ":"), ensure_ascii=True)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _asset(name: str) -> str:
    return (resources.files("kempe.draw") / "assets" / name).read_text(encoding="utf-8")


def _hash(text: str) -> str:
    """The name of an inline script or style in a content security policy."""
    digest = hashlib.sha256(text.encode("utf-8")).digest()
    return f"sha256-{base64.b64encode(digest).decode('ascii')}"
