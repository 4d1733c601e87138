"""The pages of the documentation, split into prose and blocks."""

import re
from dataclasses import dataclass
from pathlib import Path

from house.places import ROOT

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]

_FENCE = re.compile(r"^```(\w*)\s*$")
_FILE = re.compile(r"`([\w/]+\.(?:toml|json))`[^`]*:$")


@dataclass(frozen=True)
class Block:
    """A fenced block.

    Attributes:
        language: the word behind the fence.
        text: its content.
        line: number of its first line in the page.
        lead: the last line of text before the block; empty if the block directly follows another.
    """

    language: str
    text: str
    line: int
    lead: str

    @property
    def file(self) -> str | None:
        """The file for the content; the lead is "Write this as `pendulum.toml`:"."""
        named = _FILE.search(self.lead)
        return named[1] if named else None


def blocks(text: str) -> list[Block]:
    """The fenced blocks of a page in order."""
    found: list[Block] = []
    lead, language, inside = "", None, []
    for number, line in enumerate(text.splitlines(), 1):
        fence = _FENCE.match(line)
        if language is None and fence:
            language, inside = fence[1], []
        elif fence:
            body = "".join(f"{line}\n" for line in inside)
            found.append(Block(language, body, number - len(inside), lead))
            lead, language = "", None
        elif language is not None:
            inside.append(line)
        else:
            lead = line.strip() or lead
    assert language is None, "a fence is not closed"
    return found


def prose(text: str) -> str:
    """A page without its blocks and without code in backticks."""
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M))


def links(text: str) -> list[str]:
    """Targets of the links of a page that are in this repository."""
    targets = re.findall(r"\]\(([^)\s]+)\)", prose(text))
    return [target for target in targets if not target.startswith(("http:", "https:"))]


def anchors(page: Path) -> set[str]:
    """Anchors of the headings of a page, in the form that GitHub generates."""
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.S | re.M)
    headings = re.findall(r"^#+ +(.*)$", text, flags=re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in headings}
