"""Arrows of a run, read from the drawing as SVG: magnitude and owner as text, length as a path."""

import re
from pathlib import Path

import kempe as kp
import numpy as np
from studio.window import Studio

EXAMPLES = Path(__file__).parents[2] / "examples"
CASE = EXAMPLES / "slider_crank.toml"
#: The largest force has a fifth of the smaller side of the drawing.
LONGEST = 0.2
STROKE = re.compile(r'<path d="M(\S+) (\S+)L(\S+) (\S+)" fill="none" stroke="(#\w+)"')
TEXT = re.compile(r'fill="#\w+"[^>]*>([\d.]+ k?(?:N|m/s) [^<]*)</text>')


def drawing(one: Studio, tmp_path: Path) -> str:
    with one.page.expect_download() as offer:
        one.page.get_by_role("button", name="SVG", exact=True).click()
    path = tmp_path / "drawing.svg"
    offer.value.save_as(path)
    return path.read_text(encoding="utf-8")


def show(one: Studio, t: float, *kinds: str) -> None:
    for kind in kinds:
        one.page.get_by_label(kind, exact=True).check()
    one.settle()
    slide = "(e, t) => { e.value = t; e.dispatchEvent(new Event('input', { bubbles: true })); }"
    one.page.locator("#scrub").evaluate(slide, t)
    one.settle()


def texts(one: Studio, tmp_path: Path, count: int) -> list[str]:
    """The texts of all arrows, when the core has given the values of so many."""
    found: list[str] = []
    for _ in range(100):
        found = sorted(TEXT.findall(drawing(one, tmp_path)))
        if len(found) == count:
            break
        one.page.wait_for_timeout(100)
    return found


def test_arrows_have_the_forces_and_velocities_of_the_run(one: Studio, tmp_path: Path) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    show(one, 0.4, "Reactions", "Velocities")
    solution = kp.load(CASE).run()["coasting"]
    k = int(np.abs(solution.t - 0.4).argmin())

    def size(name: str, x: str, y: str) -> float:
        return float(np.hypot(solution[f"{name}.{x}"][k], solution[f"{name}.{y}"][k]))

    forces = {"O": "crank", "A": "rod", "B": "slider", "guide": "slider"}
    expected = [f"{size(name, 'fx', 'fy'):#.3g} N on {body}" for name, body in forces.items()]
    # one arrow for two points that a pin joins; crank.O is at rest
    expected += [f"{size(name, 'vx', 'vy'):#.3g} m/s {name}" for name in ("crank.A", "rod.B")]
    assert texts(one, tmp_path, len(expected)) == sorted(expected)


def test_the_scale_has_the_unit_of_the_arrows(one: Studio, tmp_path: Path) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    show(one, 0.4, "Accelerations")
    units = set(re.findall(r">[\d.]+ ([^<]*m/s[^<\s]*)[^<]*</text>", drawing(one, tmp_path)))
    assert units - {"m/s"} == {"m/s²"}


def test_the_length_of_an_arrow_is_its_share_of_the_largest(one: Studio, tmp_path: Path) -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    one.page.get_by_label("Reactions", exact=True).uncheck()
    show(one, 0.4, "Velocities")
    texts(one, tmp_path, 2)
    picture = drawing(one, tmp_path)
    colour = one.call(
        "getComputedStyle(document.documentElement).getPropertyValue('--velocities').trim()"
    )
    lines = [line for line in STROKE.findall(picture) if line[4] == colour]
    solution = kp.load(CASE).run()["coasting"]
    speeds = {
        name: np.hypot(solution[f"{name}.vx"], solution[f"{name}.vy"])
        for name in ("crank.A", "rod.B")
    }
    largest = max(speed.max() for speed in speeds.values())
    k = int(np.abs(solution.t - 0.4).argmin())
    box = one.page.locator("#sheet").bounding_box()
    assert box
    longest = LONGEST * min(box["width"], box["height"])
    head = 4 + 2.4 * 2.4  # px between the end of the line and the tip
    lengths = [
        np.hypot(float(x1) - float(x0), float(y1) - float(y0)) for x0, y0, x1, y1, _ in lines
    ]
    expected = [float(speed[k]) / largest * longest - head for speed in speeds.values()]
    for one_length in expected:
        assert min(abs(length - one_length) for length in lengths) < 0.02 * longest
