"""``kempe animate`` and ``kp.still``: size, part of the time, one instant, labels."""

import json
import re
import struct
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = ("pendulum", "slider_crank", "six_bar")


@pytest.fixture(scope="module", params=NAMES)
def stored(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp(request.param) / "solution.npz"
    kp.load(EXAMPLES / f"{request.param}.toml").run()[0].save(path)
    return path


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def png_size(path: str) -> tuple[int, int]:
    width, height = struct.unpack(">II", Path(path).read_bytes()[16:24])
    return width, height


def gif_size(path: str) -> tuple[int, int]:
    width, height = struct.unpack("<HH", Path(path).read_bytes()[6:10])
    return width, height


def scene_of(path: str) -> dict[str, object]:
    page = Path(path).read_text(encoding="utf-8")
    found = re.search(r"<script[^>]*application/json[^>]*>(.*?)</script>", page, re.DOTALL)
    assert found is not None
    content: dict[str, object] = json.loads(found[1])
    return content


def test_a_picture_shows_the_instant(stored: Path) -> None:
    solution = kp.load_solution(stored)
    for t in (0.0, 0.3, 0.4567):
        assert main(["animate", str(stored), "--at", str(t), "-o", "a.png"]) == 0
        kp.still(solution(t), "b.png")  # type: ignore[arg-type]  # one time gives a State
        assert Path("a.png").read_bytes() == Path("b.png").read_bytes()
        assert png_size("a.png") == (1440, 810)
        kp.still(solution, "c.png", t + 0.1)
        assert Path("c.png").read_bytes() != Path("a.png").read_bytes()


@pytest.mark.parametrize("size", [(640, 360), (500, 500), (180, 320)], ids=str)
def test_a_picture_and_a_gif_have_the_size(stored: Path, size: tuple[int, int]) -> None:
    text = f"{size[0]}x{size[1]}"
    assert main(["animate", str(stored), "--at", "0.1", "--size", text, "-o", "a.png"]) == 0
    assert png_size("a.png") == size
    words = ["--from", "0.1", "--to", "0.2", "--fps", "3", "--size", text, "-o", "a.gif"]
    assert main(["animate", str(stored), *words]) == 0
    assert gif_size("a.gif") == size


def test_a_part_of_the_time_is_shown(stored: Path) -> None:
    assert main(["animate", str(stored), "--from", "0.25", "--to", "0.75", "-o", "a.html"]) == 0
    frames = scene_of("a.html")["frames"]
    t = np.array(frames["t"])  # type: ignore[index]
    assert (t[0], t[-1]) == (0.25, 0.75)
    solution = kp.load_solution(stored)
    x = np.array(frames["poses"])[:, 0, 0]  # type: ignore[index]
    name = next(iter(solution.initial.coordinates())).partition(".")[0]
    np.testing.assert_allclose(x, solution(t).body(name).x, rtol=1e-8, atol=1e-9)


def test_a_solution_without_interpolant_shows_its_outputs_in_the_part() -> None:
    case = kp.load(EXAMPLES / "pendulum.toml").with_analysis("swing", dense_output=False)
    found = kp.scene(case.run()[0], span=(0.5, 1.0))["frames"]["t"]
    np.testing.assert_allclose(found, np.arange(0.5, 1.0001, 0.01), atol=1e-9)


def test_labels_can_be_left_out(stored: Path) -> None:
    for words, some in (([], True), (["--no-labels"], False)):
        assert main(["animate", str(stored), "-o", "a.html", *words]) == 0
        display = scene_of("a.html")["display"]
        assert any(item["kind"] == "text" for item in display) is some  # type: ignore[attr-defined]
        assert main(["animate", str(stored), "--at", "0", "-o", f"{some}.png", *words]) == 0
    assert Path("True.png").read_bytes() != Path("False.png").read_bytes()


def chain() -> None:
    text = (
        (EXAMPLES / "pendulum.toml").read_text(encoding="utf-8").replace("t_end = 5", "t_end = 1")
    )
    more = '\n[analyses.later]\ntype = "dynamics"\nt_end = 2\n'
    Path("chain.toml").write_text(text + more, encoding="utf-8")


@pytest.mark.parametrize(
    ("words", "files"),
    [
        (["--at", "0.5", "-o", "a.png"], ["a_swing.png"]),
        (["--at", "1.5", "-o", "a.png"], ["a_later.png"]),
        (["--at", "1", "-o", "a.png"], ["a_swing.png"]),
        (["--from", "0.5", "--to", "1.5", "-o", "a.html"], ["a_later.html", "a_swing.html"]),
        (["--from", "1.5", "-o", "a.html"], ["a_later.html"]),
        (["--to", "0.5", "-o", "a.html"], ["a_swing.html"]),
        (["-o", "a.html"], ["a_later.html", "a_swing.html"]),
    ],
    ids=str,
)
def test_several_analyses_show_their_part(words: list[str], files: list[str]) -> None:
    chain()
    assert main(["animate", "chain.toml", *words]) == 0
    assert sorted(path.name for path in Path().glob("a_*")) == files


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--at", "-1"], "-1 s: the analyses reach from 0 to"),
        (["--at", "99"], "99 s: the analyses reach from 0 to"),
        (["--from", "2", "--to", "1"], "2 to 1 s"),
        (["--to", "99"], "0 to 99 s: the analyses reach"),
        (["--from", "nan"], "nan"),
        (["--at", "0", "--to", "1"], "--at is one time"),
        (["--at", "0", "-o", "a.gif"], "end it in .png"),
        (["--size", "640"], "must be WIDTHxHEIGHT"),
        (["--size", "640x", "-o", "a.gif"], "must be WIDTHxHEIGHT"),
        (["--size", "10x640", "-o", "a.gif"], "the width is 10"),
        (["--size", "640x99999", "-o", "a.gif"], "the height is 99999"),
        (["--size", "641x360", "-o", "a.mp4"], "even"),
        (["--size", "640x360", "-o", "a.html"], "a page fits its window"),
    ],
    ids=str,
)
def test_what_cannot_be_shown_is_refused(
    stored: Path, words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["animate", str(stored), *words]) == 2
    assert told in capsys.readouterr().err
    assert list(Path().iterdir()) == []
