"""Names and texts are plain: no empty or grand names, no stilted English."""

import re
import subprocess
from pathlib import Path

import pytest
from house.places import ROOT, sources
from house.prose import prose

EMPTY_WORDS = {"util", "utils", "helper", "helpers", "common", "misc", "stuff", "tools"}
GRAND_NAMES = re.compile(r"\b(?:struct|enum|trait|class)\s+\w*(?:Manager|System|Context|Engine)\b")

#: Words after "is no" in plain sentences.
PLAIN_AFTER_NO = r"longer|more\b|other|such|need|larger|worse|better|reason|excuse"
#: Stilted expressions and a plain alternative. A blank matches any white space.
STILTED = {
    r"(?:is|are|was|were|be|been|being) told": "is reported",
    r"tells": "gives, contains, prints",
    r"told (?:of|in|with|with|by|as)": "reported",
    r"who (?:asks|wants|says)": "a condition with a noun",
    r"(?:asks|asked) (?:for|of)": "requests, needs, contains",
    r"waits? for none": "a statement",
    r"wants": "needs, expects",
    r"who (?:\w+ ){0,4}for": "a condition with a noun",
    r"knows": "contains, has",
    r"(?:do|does) not know": "a statement without knowledge",
    r"says? so": "the statement itself",
    r"(?:is|are|was|were|not) doubted": "causes a warning",
    r"closed? in to": "located",
    r"nothing (?:is )?said": "a default",
    r"(?:code|model|file|message|method|page|report|solution|core) says": "contains, states",
    r"(?:is|be) said": "is stated",
    r"that what": "a noun",
    r"of what (?:is|was|are|were)": "a noun",
    r"as (?:it|they) stands?": "unchanged",
    r"stands? (?:alike|apart|for itself|between|behind|below|in)": "is",
    r"(?:may|can|must|cannot|to) stand": "is allowed",
    r"should (?:one|it|there) not": "a condition with if",
    r"(?:goes?|went|put) together": "assemble",
    r"worked out": "computed",
    r"(?<!more.)alike": "in the same way",
    r"but for": "except",
    r"for good": "permanently",
    r"shall": "must, has to, is to",
    r"lets go": "is released, separates, slips",
    r"gets nothing": "has no, is unchanged",
    r"the begin": "the beginning",
    r"(?:would|will|does|do) not do(?=[:;.,])": "cannot be used",
    rf"(?<!here.)(?<!that.)(?:is|are) no (?!{PLAIN_AFTER_NO})\w+": "is not a",
    r"is right(?=[;.:\n])": "is valid, is correct",
}

#: Kinds of files with prose.
SUFFIXES = {".rs", ".py", ".pyi", ".js", ".ts", ".tsx", ".md", ".toml", ".sh", ""}
#: This file contains the expressions themselves.
OWN = "tests/house/test_language.py"


def tracked() -> list[str]:
    """Names of the tracked files that contain prose."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    names = [name for name in listed.stdout.split("\0") if name and name != OWN]
    return [
        name
        for name in names
        if Path(name).suffix in SUFFIXES
        and not name.startswith("LICENSE")
        and (ROOT / name).is_file()
    ]


def stilted(text: str) -> list[tuple[int, str, str]]:
    """Line, expression and alternative of every stilted expression in a text."""
    found = []
    # most of the prose of code is blank, and a comparison that ignores case takes twice the time
    text = re.sub(r"[ \t]+", " ", text).lower()
    for pattern, plain in STILTED.items():
        expression = re.compile(rf"\b(?:{pattern})\b".replace(" ", r"\s+"))
        for match in expression.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            found.append((line, " ".join(match[0].split()), plain))
    return sorted(found)


def test_no_file_or_folder_has_an_empty_name() -> None:
    names = [path.relative_to(ROOT) for path in sources(".rs", ".py")]
    inside = {path for path in names if path.parts[0] != "tools"}
    assert not [
        path for path in inside if EMPTY_WORDS & {part.partition(".")[0] for part in path.parts}
    ]


def test_no_type_has_a_grand_name() -> None:
    text = {path: path.read_text(encoding="utf-8") for path in sources(".rs", ".py")}
    assert not [path for path, code in text.items() if GRAND_NAMES.search(code)]


def test_a_grand_name_is_found() -> None:
    assert GRAND_NAMES.search("pub struct " + "SolverManager;")
    assert not GRAND_NAMES.search("pub struct Systematic;")


def test_the_english_is_plain() -> None:
    found = [
        f"{name}:{line}: {text!r}; rather: {plain}"
        for name in tracked()
        for line, text, plain in stilted(prose(ROOT / name))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("The error\nis told in words.", 2),
        ("who asks for none", 1),
        ("the mechanism goes\ntogether", 1),
        ("first\ncase.toml is right; go on", 2),
        ("Should one not exist, the error comes then.", 1),
        ("a search that\nknows nothing", 2),
        ("who looks for a joint", 1),
        ("A run that stops says so.", 1),
        ("Lines would not do: they are open.", 1),
        ("The lid\nshall close.", 2),
    ],
)
def test_a_stilted_expression_is_found(text: str, line: int) -> None:
    assert stilted(text)[0][0] == line


@pytest.mark.parametrize(
    "text",
    ["The point lies to the right.", "There is no such body.", "The list is no longer used."],
)
def test_a_plain_expression_is_accepted(text: str) -> None:
    assert not stilted(text)


@pytest.mark.parametrize(
    ("suffix", "text", "kept"),
    [
        (".py", 'told = 1  # is told\ns = "x is told"\n', 2),
        (".rs", '/// It is\n/// told.\nlet told = "it is told";\n', 2),
        (".md", "It is told.\n", 1),
    ],
)
def test_comments_and_strings_are_checked(
    suffix: str, text: str, kept: int, tmp_path: Path
) -> None:
    file = tmp_path / f"file{suffix}"
    file.write_text(text, encoding="utf-8")
    assert len(stilted(prose(file))) == kept


if __name__ == "__main__":
    for unchecked in tracked():
        for where, expression, plain in stilted(prose(ROOT / unchecked)):
            print(f"{unchecked}:{where}: {expression!r}; rather: {plain}")
