"""Pictures, videos and GIFs show what the scene says."""

import json
import subprocess
import sys
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from draw.mechanisms import HOSTILE, moving, slider_crank
from house.places import ROOT
from kempe.draw import mp4
from kempe.draw.frame import Frame
from PIL import Image


def white_spots(pixels: np.ndarray, places: np.ndarray) -> list[bool]:
    """Whether a white pin in a dark ring is at each place, (n, 2), in pixels from below."""
    height = pixels.shape[0]
    found = []
    for x, y in places:
        column, row = int(x), height - 1 - int(y)
        around = pixels[row - 9 : row + 10, column - 9 : column + 10, :3]
        found.append(bool((pixels[row, column, :3] > 240).all() and (around < 90).all(-1).any()))
    return found


def test_pins_are_drawn_where_the_solution_has_them(four_bar: kp.Solution) -> None:
    frame = Frame(kp.scene(four_bar))
    for k in (0, 17, -1):
        pixels = np.array(frame.pixels(k))
        t = np.linspace(0, 1, 241)[k]
        state = four_bar(float(t))
        joints = state.model.joints.values()
        places = [state.body(info.j).at(info.point_j).position for info in joints]
        assert all(white_spots(pixels, frame.axes.transData.transform(places)))


def test_frames_differ_and_what_stands_still_does_not(four_bar: kp.Solution) -> None:
    frame = Frame(kp.scene(four_bar), 640 / 7.2)
    first, later = np.array(frame.pixels(0)), np.array(frame.pixels(20))
    assert first.shape == (360, 640, 4)
    assert (first != later).any()
    np.testing.assert_array_equal(first, frame.pixels(0))  # nothing is left behind


def test_a_slider_moves_between_rails_that_stand_still() -> None:
    solution = slider_crank()
    frame = Frame(kp.scene(solution))
    colours = []
    for k in (0, 60):
        state = solution(float(np.linspace(0, 0.5, 241)[k]))
        place = state.body("slider").point("B").position
        x, y = frame.axes.transData.transform(place)
        pixels = np.array(frame.pixels(k))
        colours.append(pixels[pixels.shape[0] - 1 - int(y) - 14, int(x), :3])
    assert (colours[0] == colours[1]).all()
    assert colours[0][1] > colours[0][0] + 40  # the green of body 3


def test_still_pictures_with_any_name(hostile: kp.Solution, tmp_path: Path) -> None:
    frame = Frame(kp.scene(hostile, frames=2))
    frame.save(0, tmp_path / "first.png")
    with Image.open(tmp_path / "first.png") as picture:
        assert picture.size == (1440, 810)
    assert len(HOSTILE["C"]) == 200


def test_gif(tmp_path: Path) -> None:
    path = kp.animate(moving(t_end=0.3), tmp_path / "a.gif", fps=10)
    with Image.open(path) as gif:
        frames = []
        for k in range(gif.n_frames):
            gif.seek(k)
            frames.append((np.array(gif.convert("RGB")), gif.info["duration"]))
    assert frames[0][0].shape == (360, 640, 3)
    assert sum(duration for _, duration in frames) == pytest.approx(3000, abs=400)  # at 0.1 ×
    assert (frames[0][0] != frames[-1][0]).any()


def test_mp4(tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    path = kp.animate(
        moving(t_end=0.3), tmp_path / "a.mp4", speed=3, progress=lambda *counts: seen.append(counts)
    )
    assert path.read_bytes()[4:8] == b"ftyp"
    assert seen[-1] == (len(seen), len(seen))
    asked = subprocess.run(
        [mp4.find_ffmpeg(), "-hide_banner", "-i", str(path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert "1280x720" in asked.stderr
    assert "30 fps" in asked.stderr
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.mp4"]  # no draft is left


def test_html_is_the_player_at_that_speed(four_bar: kp.Solution, tmp_path: Path) -> None:
    text = kp.animate(four_bar, tmp_path / "a.HTML", speed=4).read_text(encoding="utf-8")
    assert '"playback":{"rate":2.0}' in text


def test_without_ffmpeg_both_remedies_are_named(
    four_bar: kp.Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mp4.shutil, "which", lambda _: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(kp.FileError, match=r"apt install ffmpeg.*pip install 'kempe\[video\]'"):
        kp.animate(four_bar, tmp_path / "a.mp4")
    assert not list(tmp_path.iterdir())


def test_an_ffmpeg_that_fails_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    broken = tmp_path / "ffmpeg"
    broken.write_text("#!/bin/sh\necho 'out of luck' >&2\nexit 1\n", encoding="utf-8")
    broken.chmod(0o755)
    monkeypatch.setattr(mp4.shutil, "which", lambda _: str(broken))
    with pytest.raises(kp.FileError, match="out of luck"):
        kp.animate(moving(t_end=0.1), tmp_path / "a.mp4")
    assert [entry.name for entry in tmp_path.iterdir()] == ["ffmpeg"]


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("a.avi", {}, ".mp4"),
        ("a", {}, ".html"),
        ("a.gif", {"fps": 0}, "fps=0"),
        ("a.gif", {"speed": -1}, "speed=-1"),
        ("a.gif", {"speed": 1e-5}, "too many"),
    ],
)
def test_what_cannot_be_is_refused(
    four_bar: kp.Solution, tmp_path: Path, name: str, options: dict[str, float], words: str
) -> None:
    with pytest.raises(kp.ModelError, match=words):
        kp.animate(four_bar, tmp_path / name, **options)
    assert not list(tmp_path.iterdir())


def test_the_command_line(four_bar: kp.Solution, tmp_path: Path) -> None:
    four_bar.save(tmp_path / "solution.npz")
    for words, name in (
        ([], "animation.html"),
        (["-o", "new/film.gif", "--fps", "5"], "new/film.gif"),
        (["-o", "film", "--format", "html"], "film.html"),
    ):
        done = kempe("animate", "solution.npz", *words, cwd=tmp_path)
        assert (done.returncode, done.stdout, done.stderr) == (0, f"{name}\n", "")
        assert (tmp_path / name).stat().st_size > 10_000


def test_run_writes_and_lists_the_drawings(tmp_path: Path) -> None:
    text = (ROOT / "examples" / "four_bar.toml").read_text(encoding="utf-8")
    assert "t_end = 15" in text
    (tmp_path / "bar.toml").write_text(text.replace("t_end = 15", "t_end = 0.05"), encoding="utf-8")
    done = kempe("run", "bar.toml", "--no-figures", "--animate", "gif", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    folder = tmp_path / "out" / "bar"
    listed = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["files"]
    assert listed == ["solution.npz", "solution.csv", "summary.json", "animation.gif"]
    assert all((folder / name).stat().st_size > 0 for name in listed)
