"""The site is complete, small and builds without warnings."""

import json
import re
import subprocess
from pathlib import Path

import kempe as kp
import pytest
from docs.pages import PAGES
from house.places import ROOT
from kempe import _core
from sizes import only_full

#: One process builds the site.
pytestmark = [pytest.mark.xdist_group("site"), only_full]

#: Largest size of the site without videos, bytes.
LARGEST = 20_000_000
VIDEOS = {".gif", ".mp4", ".webm"}


def test_it_builds_without_a_warning(built: subprocess.CompletedProcess[str]) -> None:
    assert (built.returncode, built.stdout, built.stderr) == (0, "", "")


def test_it_is_small(site: Path) -> None:
    files = [path for path in site.rglob("*") if path.is_file() and path.suffix not in VIDEOS]
    assert sum(path.stat().st_size for path in files) < LARGEST


def test_every_page_of_the_documentation_is_on_it(site: Path) -> None:
    sources = [page.relative_to(ROOT / "docs") for page in PAGES if page != ROOT / "README.md"]
    pages = [page.with_suffix(".html") for page in sources if page.name != "README.md"]
    pages += [page.with_name("index.html") for page in sources if page.name == "README.md"]
    assert [page for page in pages if not (site / page).is_file()] == []


def test_every_public_name_has_an_entry(site: Path) -> None:
    pages = "".join(page.read_text("utf-8") for page in (site / "python-api").glob("*.html"))
    entries = set(re.findall(r'id="kempe\.([\w.]+)"', pages))
    catalogue = json.loads(_core.catalogue())
    modules = ("design", "plot", "report")
    names = set(kp.__all__) - {"__version__", "draw", "errors", *modules}
    names |= {f"{name}.{inner}" for name in modules for inner in getattr(kp, name).__all__}
    elements = [kind for section in ("joints", "drivers", "forces") for kind in catalogue[section]]
    names |= {f"Model.{element['name']}" for element in elements}
    assert names - entries == set(), "add them to tools/site/api_pages.py"


def test_entries_have_signatures(site: Path) -> None:
    text = re.sub(r"<[^>]+>", "", (site / "python-api" / "analyses.html").read_text("utf-8"))
    assert re.search(r"dynamics\(\s*model: Model \| CompiledModel,\s*start: State,", text)


def test_it_loads_no_file_of_another_host(site: Path) -> None:
    loaded = re.compile(r'<(?:script|link|img|iframe)[^>]*(?:src|href)="(https?://[^"]*)"')
    found = {
        url for page in site.rglob("*.html") for url in loaded.findall(page.read_text("utf-8"))
    }
    assert found == set()
