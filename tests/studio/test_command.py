"""``kempe studio``: the page on loopback and in a folder, with a case in it."""

import base64
import gzip
import json
import lzma
import os
import re
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import kempe
import pytest
from house.places import ROOT
from kempe.cli import app, exit_codes
from kempe.errors import FileError
from kempe.studio import page, sources
from kempe.studio.case_text import case_text

EXAMPLE = ROOT / "examples" / "four_bar.toml"
#: Bytes of the compressed page.
LARGEST = 1_480_000
#: As small as a page can be that names its sources and has a place for a case.
BARE = (
    '<meta name="generator" content="kempe 9.8.7, sources {}">'
    '<script type="application/json" id="case">null</script>'
)
CARRIED = BARE.format("abc123abc123")
BUILT = BARE.format("def456def456")
OTHER = (
    "studio: this checkout has other sources, 000000000000; kempe studio --build builds their page"
)


@pytest.fixture
def carried(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A page in place of the one that kempe carries; none was built."""
    path = tmp_path / "page.html.gz"
    path.write_bytes(gzip.compress(CARRIED.encode()))
    monkeypatch.setattr(page, "CARRIED", path)
    monkeypatch.setattr(page, "BUILT", tmp_path / "built.html")
    monkeypatch.setattr(sources, "checksum", lambda: "abc123abc123")
    return path


@pytest.fixture
def built(carried: Path) -> Path:
    """A page that was built in the checkout after the carried one."""
    page.BUILT.write_text(BUILT, encoding="utf-8")
    os.utime(carried, (1.7e9, 1.7e9))
    return page.BUILT


def inside(text: str) -> str | None:
    found = re.search(r'id="case">(.*?)</script>', text, re.S)
    assert found
    own: str | None = json.loads(found[1])
    return own


def test_the_page_of_the_sources_has_a_place_for_a_case() -> None:
    source = (ROOT / "studio" / "index.html").read_text(encoding="utf-8")
    assert source.count(page._SLOT) == 1


@pytest.mark.usefixtures("carried")
def test_a_case_is_put_into_the_page() -> None:
    found = page.choose(None)
    assert (found.html, found.version) == (CARRIED, "9.8.7")
    assert found.opening(None) == CARRIED
    text = EXAMPLE.read_text(encoding="utf-8") + "# </script><script>alert(1)</script>\n"
    made = found.opening(text)
    assert inside(made) == text
    assert made.count("<script") == CARRIED.count("<script")


@pytest.mark.parametrize(
    ("now", "html"),
    [
        ("abc123abc123", CARRIED),
        ("def456def456", BUILT),
        ("000000000000", BUILT),  # written last
    ],
)
@pytest.mark.usefixtures("built")
def test_the_page_of_the_present_sources_is_chosen(now: str, html: str) -> None:
    assert page.choose(now).html == html


def test_a_carried_page_that_came_after_the_built_one_is_chosen(built: Path) -> None:
    os.utime(built, (1.6e9, 1.6e9))
    assert page.choose("000000000000").html == CARRIED
    assert page.choose("def456def456").html == BUILT


@pytest.mark.usefixtures("carried")
def test_an_export_is_one_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "lecture"
    assert app.run(["studio", "--export", str(folder), str(EXAMPLE)]) == exit_codes.OK
    assert [path.name for path in folder.iterdir()] == ["index.html"]
    written = (folder / "index.html").read_text(encoding="utf-8")
    assert inside(written) == EXAMPLE.read_text(encoding="utf-8")
    assert capsys.readouterr().err.splitlines() == [
        "studio: the page of kempe 9.8.7, built from sources abc123abc123",
        f"written: {folder / 'index.html'}",
    ]


@pytest.mark.parametrize(
    ("now", "told"),
    [
        ("abc123abc123", []),
        (None, []),  # installed
        ("000000000000", [OTHER]),
    ],
)
@pytest.mark.usefixtures("carried")
def test_other_sources_are_told_with_the_remedy(
    now: str | None,
    told: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(sources, "checksum", lambda: now)
    assert app.run(["studio", "--export", str(tmp_path / "out")]) == exit_codes.OK
    assert capsys.readouterr().err.splitlines()[1:-1] == told


def test_a_missing_page_is_an_error(carried: Path) -> None:
    carried.unlink()
    with pytest.raises(FileError, match=r"is missing.*kempe studio --build"):
        page.choose(None)


@pytest.mark.parametrize(
    "damage", [b"", b"\x1f\x8b", b"<html>", gzip.compress(b"<html>", mtime=0)[:-9]]
)
def test_a_damaged_page_is_an_error(carried: Path, damage: bytes) -> None:
    carried.write_bytes(damage)
    with pytest.raises(FileError, match=r"page\.html\.gz is damaged"):
        page.choose(None)


def test_kempe_carries_a_page_of_its_version() -> None:
    assert page.CARRIED.stat().st_size < LARGEST
    found = page.read(page.CARRIED)
    assert found.version == kempe.__version__, "run tools/release_page.sh"
    assert re.fullmatch("[0-9a-f]{12}", found.sources)
    assert found.html.count(page._SLOT) == 1
    notices = found.html.partition('id="licences">')[2].partition("</script>")[0]
    assert re.search(r"^toml_edit [\d.]+.* \(MIT\)$", notices, re.M)
    assert re.search(r"^preact [\d.]+ \(MIT\)$", notices, re.M)


def test_the_carried_page_has_no_path_of_the_machine_that_built_it() -> None:
    found = re.search(r'id="packed">([\w+/=]+)<', page.read(page.CARRIED).html)
    assert found
    packed = lzma.decompress(base64.b64decode(found[1]))
    assert b"kempe" in packed
    assert re.findall(rb"/[\w.-]+/[\w./-]+\.rs", packed) == []


def test_a_case_in_json_becomes_toml(tmp_path: Path) -> None:
    path = tmp_path / "case.json"
    kempe.load(EXAMPLE).save(path)
    text = case_text(path)
    assert text.startswith("kempe = 1")
    copy = tmp_path / "case.toml"
    copy.write_text(text, encoding="utf-8")
    assert kempe.load(copy).tree() == kempe.load(path).tree()


def test_points_of_a_table_in_another_file_are_in_the_text(tmp_path: Path) -> None:
    (tmp_path / "lift.csv").write_text("x,y\n0,0\n1,2\n2,3\n", encoding="utf-8")
    path = tmp_path / "case.toml"
    path.write_text('kempe = 1\n[tables.lift]\nfile = "lift.csv"\n', encoding="utf-8")
    alone = tmp_path / "alone" / "case.toml"
    alone.parent.mkdir()
    alone.write_text(case_text(path), encoding="utf-8")
    assert kempe.load(alone).tree()["tables"]["lift"]["y"] == [0, 2, 3]


def test_the_server_serves_the_page_on_loopback_only(carried: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from kempe.studio import page\n"
        f"page.BUILT = page.CARRIED = Path({str(carried)!r})\n"
        "from kempe.cli.app import app\n"
        f"app(['studio', {str(EXAMPLE)!r}, '--no-browser'])\n"
    )
    pipe = subprocess.PIPE
    with subprocess.Popen([sys.executable, "-c", code], stderr=pipe, text=True) as server:
        try:
            assert server.stderr is not None
            told = [server.stderr.readline() for _ in range(3)]  # page, other sources, address
            found = re.fullmatch(r"(http://127\.0\.0\.1:\d+/)  \(Ctrl-C.*\n", told[-1])
            assert found, told
            with urllib.request.urlopen(found[1], timeout=10) as reply:
                served = reply.read().decode("utf-8")
            assert inside(served) == EXAMPLE.read_text(encoding="utf-8")
            with pytest.raises(urllib.error.HTTPError, match="404") as missing:
                urllib.request.urlopen(found[1] + "etc/passwd", timeout=10)
            missing.value.close()
        finally:
            server.terminate()
