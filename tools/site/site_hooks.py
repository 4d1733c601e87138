"""Hooks of MkDocs: the same Markdown pages are read on a code host and on the site.

MkDocs calls these functions while it builds. They fill the navigation, add the Python reference,
the examples and MathJax, and adapt the links to files outside ``docs/``.
"""

from __future__ import annotations

import posixpath
import re
import shutil
from importlib.metadata import files
from pathlib import Path
from typing import Any

import api_pages
import gallery_players
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
#: The script that typesets formulas, with glyphs and without further files.
MATHJAX = "assets/mathjax/tex-svg.js"
_LINK = re.compile(r"(!?)\[([^\]]*)\]\(((?:\.\./)+[^)#\s]*)(#[^)\s]*)?\)")
#: A link whose text is the name of the page or of its folder.
_FILE_NAME = re.compile(r"\[(?:[\w./-]+\.md|[\w-]+/)\]\(([^)#\s]+)(#[^)\s]*)?\)")
_HEADING = re.compile(r"^# +(.*)$", re.M)
_SETTINGS = """<script>
window.MathJax = {
  tex: { inlineMath: [["\\\\(", "\\\\)"]], displayMath: [["\\\\[", "\\\\]"]] },
  options: { ignoreHtmlClass: ".*|", processHtmlClass: "arithmatex", enableMenu: false },
};
</script>"""


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Replace patterns in the navigation, such as ``elements/*.md``, by the files they match.

    A pattern leaves out the pages that are named, and those that an earlier pattern matches.
    """
    config.nav = _expanded(config.nav, Path(config.docs_dir), _named(config.nav))
    return config


def _expanded(entries: list[Any], docs: Path, taken: set[str]) -> list[Any]:
    found: list[Any] = []
    for entry in entries:
        if isinstance(entry, str) and "*" in entry:
            names = {path.relative_to(docs).as_posix() for path in docs.glob(entry)} - taken
            taken |= names
            found += sorted(names)
        elif isinstance(entry, str):
            found.append(entry)
        else:
            ((title, value),) = entry.items()
            inner = _expanded(value, docs, taken) if isinstance(value, list) else value
            found += [{title: inner}] if inner else []
    return found


def _named(entries: list[Any]) -> set[str]:
    """The pages that the navigation names without a pattern."""
    inner = [value for entry in entries if isinstance(entry, dict) for value in entry.values()]
    named = {text for text in (*entries, *inner) if isinstance(text, str) and "*" not in text}
    return named.union(*(_named(value) for value in inner if isinstance(value, list)))


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the Python reference, the examples as downloads, and MathJax."""
    sources = {"python-api/index.md": api_pages.index()} | {
        f"python-api/{name}.md": api_pages.markdown(page) for name, page in api_pages.PAGES.items()
    }
    for uri, content in sources.items():
        files.append(File.generated(config, uri, content=content))
    copies = {
        f"examples/{path.name}": path for path in (ROOT / "examples").iterdir() if path.is_file()
    }
    here = Path(__file__).parent
    copies |= {f"assets/{name}": here / name for name in ("iframe-worker.js", "site.css")}
    copies |= mathjax() | gallery_players.players()
    for uri, path in copies.items():
        files.append(File.generated(config, uri, abs_src_path=str(path)))
    return files


def mathjax() -> dict[str, Path]:
    """The script of MathJax and its licence, by their places on the site."""
    paths = {str(path): Path(str(path.locate())) for path in files("django-static-mathjax") or []}
    package = "mathjax/static/mathjax"
    return {
        MATHJAX: paths[f"{package}/es5/tex-svg.js"],
        "assets/mathjax/LICENSE": paths[f"{package}/LICENSE"],
    }


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Adapt links: titles instead of file names, downloads of examples, other files as text."""
    folder = posixpath.dirname(page.file.src_uri)

    def adapted(link: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(folder, link[3]))
        if not target.startswith(".."):
            return link[0]
        inside = target.removeprefix("../")
        if inside.startswith("examples/") and (ROOT / inside).is_file():
            return f"{link[1]}[{link[2]}]({posixpath.relpath(inside, folder or '.')})"
        return link[2]

    def titled(link: re.Match[str]) -> str:
        path = ROOT / "docs" / folder / link[1]
        heading = _HEADING.search(path.read_text("utf-8")) if path.is_file() else None
        return f"[{heading[1]}]({link[1]}{link[2] or ''})" if heading else link[0]

    return _FILE_NAME.sub(titled, _LINK.sub(adapted, markdown))


def on_post_page(output: str, page: Page, **_: object) -> str:
    """Remove indentation, and load MathJax on pages with formulas only."""
    output = _squeezed(output)
    if 'class="arithmatex"' not in output:
        return output
    script = posixpath.relpath(MATHJAX, posixpath.dirname(page.url) or ".")
    return output.replace("</head>", f'{_SETTINGS}<script async src="{script}"></script></head>', 1)


def _squeezed(html: str) -> str:
    """A page without blank lines and indentation outside preformatted text."""
    parts = re.split(r"(<pre.*?</pre>)", html, flags=re.S)
    return "".join(
        part if part.startswith("<pre") else re.sub(r"\s*\n\s*", "\n", part) for part in parts
    )


def on_post_build(config: MkDocsConfig) -> None:
    """Remove files of the theme that no page loads: source maps, searches in other languages."""
    site = Path(config.site_dir)
    shutil.rmtree(site / "assets" / "javascripts" / "lunr")
    for path in site.rglob("*.map"):
        path.unlink()
