"""Mechanisms of Linkage, in files that the tests write themselves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import kempe as kp
import numpy as np
import pytest

#: Lengths of the files per mm.
MM = 96 / 25.4


def written(
    folder: Path,
    connectors: Mapping[int, tuple[float, float, str]],
    links: Sequence[Sequence[int] | tuple[Sequence[int], str]],
    more: str = "",
    inside: Mapping[int, str] | None = None,
) -> Path:
    """A file: connectors with places in mm and attributes, links, and further elements."""
    out = ["<linkage2>", '\t<program zoom="1" scalefactor="1.000000" units="Millimeters"/>']
    for key, (x, y, attributes) in connectors.items():
        content = (inside or {}).get(key, "")
        place = f'x="{x * MM:.6f}" y="{y * MM:.6f}"'
        out.append(f'\t<connector id="{key}" layer="16" {place} {attributes}>{content}</connector>')
    for k, link in enumerate(links):
        ids, attributes = link if isinstance(link[-1], str) else (link, "")
        out.append(f'\t<Link id="{k}" layer="16" linesize="1" {attributes}>')
        out += [f'\t\t<connector id="{key}"/>' for key in ids] + ["\t</Link>"]
    path = folder / "made.linkage2"
    path.write_text("\r\n".join([*out, more, "</linkage2>"]), encoding="utf-8")
    return path


INPUT = 'anchor="true" input="true" rpm="15"'


def limits(a: int, b: int) -> str:
    return f'<slidelimit id="{a}"/><slidelimit id="{b}"/>'


def test_a_four_bar_has_its_lengths_in_metres_and_turns_clockwise(tmp_path: Path) -> None:
    places = {
        0: (0, 0, INPUT),
        1: (30, 0, ""),
        2: (60, 80, 'draw="true"'),
        3: (100, 0, 'anchor="true"'),
    }
    solution = kp.load(written(tmp_path, places, [[0, 1], [1, 2], [2, 3]])).run()["motion"]
    angle = -2 * np.pi * 15 / 60 * solution.t
    assert solution.t[-1] == pytest.approx(4)
    b = 0.03 * np.column_stack([np.cos(angle), np.sin(angle)])
    c = np.column_stack([solution["link1.P2.x"], solution["link1.P2.y"]])
    assert (
        np.abs(np.column_stack([solution["link0.P1.x"], solution["link0.P1.y"]]) - b).max() < 1e-8
    )
    assert np.abs(np.hypot(*(c - b).T) - np.hypot(0.03, 0.08)).max() < 1e-8
    assert np.abs(np.hypot(*(c - [0.1, 0]).T) - np.hypot(0.04, 0.08)).max() < 1e-8


def test_a_slider_runs_between_its_limits(tmp_path: Path) -> None:
    places = {
        0: (0, 0, INPUT),
        1: (0, 20, ""),
        2: (60, 20, 'slider="true"'),
        3: (0, 20, 'anchor="true"'),
        4: (200, 20, 'anchor="true"'),
    }
    path = written(tmp_path, places, [[0, 1], [1, 2], [3, 4]], inside={2: limits(3, 4)})
    solution = kp.load(path).run()["motion"]
    assert np.abs(solution["link1.P2.y"] - 0.02).max() < 1e-8
    angle = np.pi / 2 - 0.5 * np.pi * solution.t
    y = 0.02 * np.sin(angle) - 0.02
    expected = 0.02 * np.cos(angle) + np.sqrt(0.06**2 - y**2)
    assert np.abs(solution["link1.P2.x"] - expected).max() < 1e-8


@pytest.mark.parametrize(("kind", "sense"), [("gears", -1), ("chain", 1)])
def test_wheels_turn_by_their_sizes(tmp_path: Path, kind: str, sense: int) -> None:
    places = {0: (0, 0, INPUT), 1: (10, 0, ""), 2: (30, 40, 'anchor="true"'), 3: (30, 50, "")}
    links = [([0, 1], 'gear="true"'), ([2, 3], 'gear="true"')]
    wheels = '<link id="0" size="1"/><link id="1" size="3"/>'
    ratio = f'<ratios><ratio type="{kind}">{wheels}</ratio></ratios>'
    solution = kp.load(written(tmp_path, places, links, ratio)).run()["motion"]
    assert np.allclose(solution["link0.angle"], -0.5 * np.pi * solution.t, atol=1e-9)
    assert np.allclose(solution["link1.angle"], sense / 3 * solution["link0.angle"], atol=1e-9)


def test_a_link_slides_on_two_anchors(tmp_path: Path) -> None:
    places = {
        0: (0, 0, ""),
        1: (50, 20, ""),
        2: (100, 0, ""),
        3: (30, 0, 'anchor="true" slider="true"'),
        4: (70, 0, 'anchor="true" slider="true"'),
        5: (150, 20, INPUT),
        6: (150, 30, ""),
    }
    inside = {3: limits(0, 2), 4: limits(0, 2)}
    path = written(tmp_path, places, [[0, 1, 2], [3], [4], [5, 6], [1, 6]], inside=inside)
    solution = kp.load(path).run()["motion"]
    assert np.abs(solution["link0.angle"]).max() < 1e-9
    assert np.abs(solution["link0.y"]).max() < 1e-9
    angle = np.pi / 2 - 0.5 * np.pi * solution.t
    rod = np.hypot(0.1, 0.01)
    x = 0.15 + 0.01 * np.cos(angle) - np.sqrt(rod**2 - (0.01 * np.sin(angle)) ** 2)
    assert np.abs(solution["link0.P1.x"] - x).max() < 1e-8


def test_an_actuator_grows_by_its_stroke(tmp_path: Path) -> None:
    places = {0: (0, 0, 'anchor="true"'), 1: (40, 0, ""), 2: (0, 30, 'anchor="true"')}
    links = [[0, 1], ([2, 1], f'actuator="true" throw="{10 * MM}" cpm="15"')]
    case = kp.load(written(tmp_path, places, links))
    assert any("does not return" in text for text in case.unread)
    solution = case.run()["motion"]
    length = np.hypot(solution["link0.P1.x"], solution["link0.P1.y"] - 0.03)
    assert np.allclose(length, 0.05 + 0.01 * solution.t / 2, atol=1e-8)
    assert solution.t[-1] == pytest.approx(2)


def test_what_is_fastened_moves_with_its_link(tmp_path: Path) -> None:
    places = {
        0: (0, 0, INPUT),
        1: (20, 0, ""),
        2: (20, 10, 'fastenlink="0"'),
        3: (50, 0, ""),
        4: (60, 0, ""),
    }
    links = [[0, 1], ([3, 4], 'fastenlink="0"')]
    solution = kp.load(written(tmp_path, places, links)).run()["motion"]
    angle = -0.5 * np.pi * solution.t
    assert np.allclose(
        solution["link0.P2.y"], 0.02 * np.sin(angle) + 0.01 * np.cos(angle), atol=1e-8
    )
    assert np.allclose(solution["link1.P3.x"], 0.05 * np.cos(angle), atol=1e-8)


@pytest.mark.parametrize(
    ("attributes", "message"),
    [
        ('slideradius="50"', "slideradius"),
        ('limitangle="40"', "limitangle"),
        ('fastenconnector="1"', "fastenconnector"),
        ('x="a lot"', "already defined|duplicat"),
    ],
)
def test_what_has_no_equal_is_named(tmp_path: Path, attributes: str, message: str) -> None:
    places = {0: (0, 0, INPUT), 1: (20, 0, attributes)}
    with pytest.raises(kp.FileError, match=message):
        kp.load(written(tmp_path, places, [[0, 1]]))


def test_entities_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "bomb.linkage2"
    path.write_text('<!DOCTYPE a [<!ENTITY a "&a;&a;">]><linkage2>&a;</linkage2>')
    with pytest.raises(kp.FileError, match="DTD"):
        kp.load(path)


def test_repeated_numbers_and_other_ratios_are_named(tmp_path: Path) -> None:
    places = {0: (0, 0, INPUT), 1: (30, 0, ""), 2: (90, 0, 'anchor="true"')}
    path = written(tmp_path, places, [[0, 1], [2, 1]])
    own = path.read_text()
    ratio = '<ratios><ratio type="{}"{}><link id="0" size="1"/><link id="1" size="1"/>{}</ratio>'
    for text, message in (
        (own.replace('connector id="1" layer', 'connector id="0" layer', 1), "another connector 0"),
        (own.replace('Link id="1"', 'Link id="0"'), "another link 0"),
        (own.replace("</linkage2>", ratio.format("cone", "", "") + "</ratios></linkage2>"), "cone"),
        (
            own.replace(
                "</linkage2>", ratio.format("gears", ' slip="1"', "") + "</ratios></linkage2>"
            ),
            "the attribute slip",
        ),
        (
            own.replace(
                "</linkage2>", ratio.format("gears", "", "<idler/>") + "</ratios></linkage2>"
            ),
            "<idler>",
        ),
    ):
        path.write_text(text)
        with pytest.raises(kp.FileError, match=message):
            kp.load(path)
