"""Imports among the files of a crate, with re-exports followed to the file that defines a name."""

import re
from collections.abc import Iterator
from pathlib import Path

from house.places import CORE
from house.rust_source import closing_brace, code_only

#: A module or an item: names under the crate root.
Name = tuple[str, ...]

_PATH = re.compile(r"(?<![\w:$])(crate|super|self)\s*::\s*")
_USE = re.compile(r"(?m)(?:^|(?<=[;{}]))\s*(?:pub(?:\([^)]*\))?\s+)?use\s+([^;]+);")
_CHILD = re.compile(r"(?m)(?:^|(?<=[;{}]))\s*(?:pub(?:\([^)]*\))?\s+)?mod\s+(\w+)\s*;")


def module_of(path: Path, crate: Path) -> Name:
    """The module of a file, such as ("math", "dual")."""
    parts = path.relative_to(crate).with_suffix("").parts
    return parts[:-1] if parts[-1] in ("mod", "lib") else parts


def leaves(tree: str) -> Iterator[tuple[Name, str]]:
    """Path and local name of each item of a use tree, such as `a::{b, c as d}`."""
    head, brace, _ = tree.partition("{")
    base = tuple(re.findall(r"\w+", head))
    if not brace:
        path = [word for word in base if word != "as"]
        renamed = "as" in base
        yield tuple(path[:-1] if renamed else path), path[-1] if path else "*"
        return
    depth, begin, inner = 0, 0, tree[len(head) + 1 : closing_brace(tree, len(head))] + ","
    for at, character in enumerate(inner):
        depth += {"{": 1, "}": -1}.get(character, 0)
        if character == "," and not depth:
            if inner[begin:at].strip():
                yield from (((*base, *path), name) for path, name in leaves(inner[begin:at]))
            begin = at + 1


def absolute(path: Name, here: Name, children: set[str]) -> Name | None:
    """A path from the crate root; None for a path of another crate."""
    if path[0] == "crate":
        return path[1:]
    if path[0] not in ("self", "super"):
        return (*here, *path) if path[0] in children else None
    base = here
    while path and path[0] in ("self", "super"):
        base = base[:-1] if path[0] == "super" else base
        path = path[1:]
    return (*base, *path)


def without_tests(code: str) -> str:
    """The code without modules of unit tests."""
    while match := re.search(r"#\[cfg\(test\)\]\s*mod\s+\w+\s*\{", code):
        code = code[: match.start()] + code[closing_brace(code, match.end() - 1) + 1 :]
    return code


class Source:
    """The imports of one file: its text and its module."""

    def __init__(self, text: str, module: Name) -> None:
        code = without_tests(code_only(text))
        self.module = module
        #: Modules that the file declares.
        self.children = set(_CHILD.findall(code))
        #: Local name → imported item, for each `use`.
        self.used: dict[str, Name] = {}
        for match in _USE.finditer(code):
            for item, name in leaves(match[1]):
                if found := absolute(item, self.module, self.children):
                    self.used[name] = found
        self.body = _USE.sub("", _CHILD.sub("", code))

    def imports(self) -> set[Name]:
        """Everything that the code of the file uses; a re-export alone is not an import."""
        found = {
            item
            for name, item in self.used.items()
            if not self.children or re.search(rf"\b{name}\b", self.body)
        }
        for match in _PATH.finditer(self.body):
            words = re.match(r"(?:\w+\s*::\s*)*\w+", self.body[match.start() :])
            if words and self.body[match.start() + words.end() :][:1] != "!":
                path = tuple(re.findall(r"\w+", words[0]))
                found.add(absolute(path, self.module, self.children) or ())
        for child in self.children:
            if re.search(rf"(?<!::)\b{child}::", self.body):
                found.add((*self.module, child))
        return found


def sources(crate: Path = CORE) -> dict[Name, Source]:
    """All files of a crate by module, without lib.rs."""
    paths = [path for path in sorted(crate.rglob("*.rs")) if path.name != "lib.rs"]
    texts = {module_of(path, crate): path.read_text(encoding="utf-8") for path in paths}
    return {module: Source(text, module) for module, text in texts.items()}


def defined_in(item: Name, files: dict[Name, Source]) -> Name:
    """The module that defines an item, through any number of re-exports."""
    for end in range(1, len(item)):
        source = files.get(item[:end])
        used = source.used.get(item[end], item) if source and source.children else item
        if used[: end + 1] != item[: end + 1] and item[: end + 1] not in files:
            return defined_in((*used, *item[end + 1 :]), files)
    while item and item not in files:
        item = item[:-1]
    return item


def graph(folder: Name, files: dict[Name, Source]) -> dict[str, set[str]]:
    """Which entries of a folder import which others; "mod" is the folder's own file."""

    def entry(module: Name) -> str | None:
        if module[: len(folder)] != folder:
            return None
        return module[len(folder)] if len(module) > len(folder) else "mod"

    edges: dict[str, set[str]] = {}
    for module, source in files.items():
        if name := entry(module):
            targets = {entry(defined_in(item, files)) for item in source.imports() if item}
            edges.setdefault(name, set()).update(t for t in targets if t and t != name)
    return edges


def loops(edges: dict[str, set[str]]) -> list[set[str]]:
    """The strongly connected sets of more than one entry."""
    reached: dict[str, set[str]] = {}
    for start, imported in edges.items():
        seen, todo = set(), list(imported)
        while todo:
            at = todo.pop()
            if at not in seen:
                seen.add(at)
                todo.extend(edges.get(at, ()))
        reached[start] = seen
    found = [{b for b in reached[a] if a in reached.get(b, ())} for a in edges if a in reached[a]]
    return sorted({frozenset(loop): loop for loop in found}.values(), key=sorted)
