"""``kempe studio``: the page on loopback and in a folder, with a case in it."""

import json
import re
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import pytest
from house.places import ROOT
from kempe.studio import page
from kempe.studio.case_text import case_text

EXAMPLE = ROOT / "examples" / "four_bar.toml"
#: As small as a page can be that has a place for a case.
BARE = '<title>kempe studio</title><script type="application/json" id="case">null</script>'


@pytest.fixture
def built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "page.html"
    path.write_text(BARE, encoding="utf-8")
    monkeypatch.setattr(page, "PAGE", path)
    return path


def inside(text: str) -> str | None:
    found = re.search(r'id="case">(.*?)</script>', text, re.S)
    assert found
    own: str | None = json.loads(found[1])
    return own


def test_the_page_of_the_sources_has_a_place_for_a_case() -> None:
    source = (ROOT / "studio" / "index.html").read_text(encoding="utf-8")
    assert source.count(page._SLOT) == 1


@pytest.mark.usefixtures("built")
def test_a_case_is_put_into_the_page() -> None:
    assert page.page() == BARE
    text = EXAMPLE.read_text(encoding="utf-8") + "# </script><script>alert(1)</script>\n"
    made = page.page(text)
    assert inside(made) == text
    assert made.count("<script") == BARE.count("<script")


@pytest.mark.usefixtures("built")
def test_an_export_is_one_file(tmp_path: Path) -> None:
    target = page.export(tmp_path / "lecture", case_text(EXAMPLE))
    assert target == tmp_path / "lecture" / "index.html"
    assert [path.name for path in target.parent.iterdir()] == ["index.html"]
    assert inside(target.read_text(encoding="utf-8")) == EXAMPLE.read_text(encoding="utf-8")


def test_a_page_that_was_not_built_is_an_error(built: Path) -> None:
    from kempe.errors import FileError

    built.unlink()
    with pytest.raises(FileError, match="not built") as found:
        page.page()
    assert "tools/build_studio.sh" in str(found.value)
    assert (ROOT / "tools" / "build_studio.sh").stat().st_mode & 0o111


def test_a_case_in_json_becomes_toml(tmp_path: Path) -> None:
    import kempe as kp

    path = tmp_path / "case.json"
    kp.load(EXAMPLE).save(path)
    text = case_text(path)
    assert text.startswith("kempe = 1")
    copy = tmp_path / "case.toml"
    copy.write_text(text, encoding="utf-8")
    assert kp.load(copy).tree() == kp.load(path).tree()


def test_points_of_a_table_in_another_file_are_in_the_text(tmp_path: Path) -> None:
    (tmp_path / "lift.csv").write_text("x,y\n0,0\n1,2\n2,3\n", encoding="utf-8")
    path = tmp_path / "case.toml"
    path.write_text('kempe = 1\n[tables.lift]\nfile = "lift.csv"\n', encoding="utf-8")
    import kempe as kp

    alone = tmp_path / "alone" / "case.toml"
    alone.parent.mkdir()
    alone.write_text(case_text(path), encoding="utf-8")
    assert kp.load(alone).tree()["tables"]["lift"]["y"] == [0, 2, 3]


def test_the_server_serves_the_page_on_loopback_only(built: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from kempe.studio import page\n"
        f"page.PAGE = Path({str(built)!r})\n"
        "from kempe.cli.app import app\n"
        f"app(['studio', {str(EXAMPLE)!r}, '--no-browser'])\n"
    )
    pipe = subprocess.PIPE
    with subprocess.Popen([sys.executable, "-c", code], stderr=pipe, text=True) as server:
        try:
            assert server.stderr is not None
            line = server.stderr.readline()
            found = re.search(r"http://127\.0\.0\.1:\d+/", line)
            assert found, line
            with urllib.request.urlopen(found[0], timeout=10) as reply:
                served = reply.read().decode("utf-8")
            assert inside(served) == EXAMPLE.read_text(encoding="utf-8")
            with pytest.raises(urllib.error.HTTPError, match="404") as missing:
                urllib.request.urlopen(found[0] + "etc/passwd", timeout=10)
            missing.value.close()
        finally:
            server.terminate()
