"""The GIF of a motion: frames, durations, and the place of a pin against Python."""

import math
from collections.abc import Iterator
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from PIL import Image, ImageSequence
from studio.window import Studio

CASE = Path(__file__).parents[2] / "examples" / "six_bar.toml"
#: Radius of the ring that is drawn for a pin, px of the page, and where it is searched for.
RING, REACH = 4.5, 9


SHOWN = ("Names", "Numbers", "Grid", "Paths")


@pytest.fixture
def bare(one: Studio) -> Iterator[Studio]:
    """A sheet on which nothing is drawn near the pins."""
    for what in SHOWN:
        one.page.get_by_label(what, exact=True).uncheck()
    yield one
    for what in SHOWN:
        one.page.get_by_label(what, exact=True).check()


def read(one: Studio, speed: str = "1") -> None:
    one.load(CASE.read_text(encoding="utf-8"))
    one.mode("read")
    for what in ("Reactions", "Velocities", "Accelerations"):
        one.page.get_by_label(what, exact=True).uncheck()
    one.settle()
    one.page.locator(".playback select").select_option(speed)


def given(one: Studio, path: Path) -> list[Image.Image]:
    """The frames of the GIF."""
    with one.page.expect_download(timeout=120_000) as download:
        one.page.locator("#gif").click()
    assert Path(download.value.suggested_filename).suffix == ".gif"
    download.value.save_as(path)
    with Image.open(path) as found:
        assert found.info["loop"] == 0
        return [frame.copy() for frame in ImageSequence.Iterator(found)]


def pin_near(frame: Image.Image, x: float, y: float, radius: float) -> tuple[float, float]:
    """Where a white disc with a dark ring is most likely, px."""
    grey = np.asarray(frame.convert("L"), dtype=float)
    turns = np.linspace(0, 2 * math.pi, 24, endpoint=False)

    def score(px: float, py: float) -> float:
        ring = grey[
            np.rint(py + radius * np.sin(turns)).astype(int),
            np.rint(px + radius * np.cos(turns)).astype(int),
        ]
        return float(grey[round(py), round(px)] - ring.mean())

    steps = np.arange(-REACH, REACH + 0.5, 0.5)
    places = [(x + dx, y + dy) for dx in steps for dy in steps]
    return max(places, key=lambda place: score(*place))


def test_a_gif_has_the_motion_of_python(bare: Studio, tmp_path: Path) -> None:
    one = bare
    solution = next(iter(kp.load(CASE).run().values()))
    read(one)
    frames = given(one, tmp_path / "motion.gif")
    sheet = one.page.locator("#sheet").bounding_box()
    assert sheet
    share = min(1.0, 640 / max(sheet["width"], sheet["height"]))
    for frame in frames:
        assert frame.size == pytest.approx(
            (share * sheet["width"], share * sheet["height"]), abs=0.51
        )
    seconds = solution.t[-1] - solution.t[0]
    delay = frames[0].info["duration"] / 1000
    assert {frame.info["duration"] for frame in frames} == {1000 * delay}
    assert 0.04 <= delay <= 0.1
    assert len(frames) * delay == pytest.approx(seconds, abs=0.5 * delay)
    for k in range(0, len(frames), len(frames) // 6):
        t = solution.t[0] + k * seconds / len(frames)
        (x, y) = (np.interp(t, solution.t, solution[f"crank.B.{axis}"]) for axis in "xy")
        px, py = one.screen(float(x), float(y))
        place = share * (px - sheet["x"]), share * (py - sheet["y"])
        assert pin_near(frames[k], *place, share * RING) == pytest.approx(place, abs=1.6), k


def test_a_slower_playback_gives_a_longer_gif(one: Studio, tmp_path: Path) -> None:
    read(one, "0.5")
    seconds = float(one.call("kempe.values(['crank.angle']).then(({ t }) => t.at(-1) - t[0])"))
    frames = given(one, tmp_path / "slow.gif")
    total = sum(frame.info["duration"] for frame in frames) / 1000
    assert total == pytest.approx(2 * seconds, rel=0.02)
    assert len(frames) <= 250


def test_a_gif_is_cancelled_and_the_page_is_as_before(one: Studio) -> None:
    read(one)
    pose = one.call("document.querySelector('.clock').innerText")
    downloads: list[str] = []
    one.page.on("download", lambda file: downloads.append(file.suggested_filename))
    one.page.locator("#gif").click()
    one.wait("/GIF [1-9]/.test(document.querySelector('#gif').innerText)")
    one.page.locator("#gif").click()
    one.wait("document.querySelector('#gif').innerText === 'GIF'")
    one.settle()
    assert one.call("document.querySelector('.clock').innerText") == pose
    assert downloads == []
