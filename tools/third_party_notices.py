"""Write THIRD_PARTY_NOTICES.txt: the licences of the Rust crates in the compiled core.

    .venv/bin/python tools/third_party_notices.py

The crates are those that cargo links into the extension of Python on any system, into the library
inside FMUs, and into the core of pages. Crates that only compile them, such as procedural macros,
are not part of them. Wheels and the page of the studio contain the file. The licences of Rust's
standard library come from the toolchain (tools/build_packages.py).
"""

import json
import re
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "THIRD_PARTY_NOTICES.txt"
#: The extension of Python, the library of FMUs, and the core of pages with its own lock file.
MANIFESTS = ("bindings/python/Cargo.toml", "bindings/fmu/Cargo.toml", "bindings/web/Cargo.toml")
#: Licences that kempe, MIT OR Apache-2.0, may include. The first that a crate offers is taken.
ACCEPTED = ("MIT", "Zlib", "BSD-2-Clause", "BSD-3-Clause", "ISC", "Apache-2.0", "Unicode-3.0")
#: Words that occur in the text of a licence only.
MARKS = {
    "MIT": "Permission is hereby granted, free of charge",
    "Zlib": "This software is provided 'as-is'",
    "BSD-2-Clause": "Redistribution and use in source and binary forms",
    "Apache-2.0": "TERMS AND CONDITIONS FOR USE, REPRODUCTION, AND DISTRIBUTION",
}
#: Crates without a text, and a crate of the same author and licence that contains it.
TEXT_OF = {"i_key_sort": "i_shape", "i_overlay": "i_shape"}
INTRODUCTION = """\
The compiled core of kempe contains the following Rust crates. Each is used under the licence that
its heading names. Crates whose licences have the same text stand above it together, each with its
copyright. kempe itself is licensed under MIT OR Apache-2.0.
"""


@dataclass(frozen=True)
class Crate:
    """A crate with the licences that it offers, as an SPDX expression, and its folder."""

    name: str
    version: str
    offered: str
    folder: Path

    def notice(self) -> tuple[str, list[str]]:
        """The chosen licence and its texts in the crate, one for each part with its own."""
        if "AND" in self.offered or "WITH" in self.offered:
            raise SystemExit(f"{self.name}: decide by hand on its licence {self.offered!r}")
        offered = re.split(r"\s+OR\s+|/", self.offered.strip("()"))
        for licence in ACCEPTED:
            texts = self._texts(licence) if licence in offered else []
            if texts:
                return licence, texts
        raise SystemExit(f"{self.name}: none of its licences {offered} is accepted, or has a text")

    def _texts(self, licence: str) -> list[str]:
        paths = sorted(path for path in self.folder.rglob("LICENSE*") if path.is_file())
        paths = [path for path in paths if not {"test", "tests"} & set(path.parts)]
        texts = [normal(path.read_text("utf-8")) for path in paths]
        return list(dict.fromkeys(text for text in texts if MARKS[licence] in one_line(text)))


def one_line(text: str) -> str:
    """A text without line breaks."""
    return " ".join(text.split())


def normal(text: str) -> str:
    """A text without blanks at the ends of lines."""
    return "\n".join(line.rstrip() for line in text.strip().splitlines())


def linked() -> set[tuple[str, str]]:
    """Names and versions of the crates of others in the compiled cores, on all systems."""
    words = ("tree", "-e", "normal,no-proc-macro", "--target", "all", "--prefix", "none")
    trees = [cargo(*words, "--manifest-path", manifest) for manifest in MANIFESTS]
    lines = [line.split() for tree in trees for line in tree.splitlines()]
    crates = {(name, version.removeprefix("v")) for name, version, *_ in lines}
    return {crate for crate in crates if not crate[0].startswith("kempe")}


def crates() -> list[Crate]:
    """The crates of others in the compiled cores, by name and version."""
    found = [
        Crate(one["name"], one["version"], one["license"] or "", Path(one["manifest_path"]).parent)
        for manifest in MANIFESTS
        for one in json.loads(
            cargo("metadata", "--format-version", "1", "--manifest-path", manifest)
        )["packages"]
    ]
    known = {(crate.name, crate.version): crate for crate in found}
    all_linked = [known[key] for key in sorted(linked())]
    folders = {crate.name: crate.folder for crate in all_linked}
    return [
        replace(crate, folder=folders[TEXT_OF.get(crate.name, crate.name)]) for crate in all_linked
    ]


def cargo(*words: str) -> str:
    """The output of a command of cargo."""
    done = subprocess.run(
        ["cargo", *words, "--locked"], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True
    )
    return done.stdout


def notices() -> str:
    """The content of the file: texts that differ in copyright lines alone are written once."""
    groups: dict[str, list[str]] = {}
    for crate in crates():
        licence, texts = crate.notice()
        heading = f"{crate.name} {crate.version} ({licence})"
        own = "\n\n".join(texts).splitlines()
        holders = [line for line in own if line.startswith("Copyright")]
        common = one_line("\n".join(line for line in own if not line.startswith("Copyright")))
        parts = groups.setdefault(common, [normal("\n".join(own)) + "\n"])
        named = [heading, "-" * len(heading), *holders]
        parts.insert(-1, "".join(f"{line}\n" for line in named))
    return "\n".join([INTRODUCTION, *(part for parts in groups.values() for part in parts)])


if __name__ == "__main__":
    TARGET.write_text(notices(), encoding="utf-8", newline="\n")
