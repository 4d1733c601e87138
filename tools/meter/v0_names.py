"""Reads names of Rust functions that are mangled in the version v0 (RFC 2603).

A name becomes readable text, and the module of a crate to which the function belongs.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

#: Part of the text of a closure.
CLOSURE = "{closure}"
#: Module of the functions that neither belong to the crate nor name a part of it.
OTHER = "std and other crates"
#: Module of the functions in `lib.rs`.
ROOT = "lib"

_BASIC = {
    "a": "i8",
    "b": "bool",
    "c": "char",
    "d": "f64",
    "e": "str",
    "f": "f32",
    "h": "u8",
    "i": "isize",
    "j": "usize",
    "l": "i32",
    "m": "u32",
    "n": "i128",
    "o": "u128",
    "p": "_",
    "s": "i16",
    "t": "u16",
    "u": "()",
    "v": "...",
    "x": "i64",
    "y": "u64",
    "z": "!",
}
_POINTERS = {"R": "&", "Q": "&mut ", "P": "*const ", "O": "*mut "}
_DIGITS = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"


@dataclass(frozen=True)
class Name:
    """Text of a name, and the module of the crate in which it is defined: None in other crates."""

    text: str
    home: tuple[str, ...] | None = None


class _Reader:
    """Reads one name from left to right; each method reads one rule of the grammar."""

    def __init__(self, mangled: str, crate: str) -> None:
        if not mangled.startswith("_R"):
            raise ValueError(f"{mangled} is not a name of the version v0")
        self.text, self.crate, self.at = mangled[2:], crate, 0
        self.earlier: dict[tuple[int, str], Name] = {}
        self.closures: list[tuple[str, ...]] = []
        self.named: list[tuple[str, ...]] = []

    def next(self) -> str:
        self.at += 1
        return self.text[self.at - 1]

    def skip(self, character: str) -> bool:
        found = self.text.startswith(character, self.at)
        self.at += found
        return found

    def number(self) -> int:
        """A number to the base 62; `_` alone is 0."""
        value = -1
        while (digit := self.next()) != "_":
            value = max(value, 0) * 62 + _DIGITS.index(digit)
        return value + 1

    def optional_number(self, tag: str) -> None:
        if self.skip(tag):
            self.number()

    def identifier(self) -> str:
        self.optional_number("s")
        self.skip("u")
        length = re.compile(r"0|[1-9]\d*").match(self.text, self.at)
        if not length:
            raise ValueError(f"no identifier at {self.at} in _R{self.text}")
        begin = length.end() + (self.text[length.end() : length.end() + 1] == "_")
        self.at = begin + int(length[0])
        return self.text[begin : self.at]

    def back(self, rule: str) -> Name:
        """What the rule read at an earlier place."""
        key = (self.number(), rule)
        if key not in self.earlier:
            here, self.at = self.at, key[0]
            self.earlier[key] = getattr(self, rule)()
            self.at = here
        return self.earlier[key]

    def path(self) -> Name:
        tag = self.next()
        if tag == "B":
            return self.back("path")
        if tag == "C":
            crate = self.identifier()
            return Name(crate, () if crate == self.crate else None)
        if tag == "N":
            return self.nested()
        if tag == "I":
            generic = self.path()
            return Name(f"{generic.text}<{', '.join(self.list('argument'))}>", generic.home)
        home = None
        if tag in "MX":
            self.optional_number("s")
            home = self.path().home
        elif tag != "Y":
            raise ValueError(f"unknown path {tag} in _R{self.text}")
        own = self.type()
        if tag == "M":
            return Name(f"<{own.text}>", home)
        trait = self.path()
        return Name(f"<{own.text} as {trait.text}>", trait.home if tag == "Y" else home)

    def nested(self) -> Name:
        space = self.next()
        outer, word = self.path(), self.identifier()
        home = outer.home
        if space == "C":
            if home is not None:
                self.closures.append(home)
            return Name(f"{outer.text}::{CLOSURE}", home)
        if home is not None:
            if space == "t" and word.islower():
                home = (*home, word)
            else:
                self.named.append(home)
        # the constructor of a variant has no name of its own
        return Name(f"{outer.text}::{word}" if word else outer.text, home)

    def list(self, rule: str) -> list[str]:
        """Texts up to `E`, without lifetimes."""
        texts = []
        while not self.skip("E"):
            texts.append(getattr(self, rule)().text)
        return [text for text in texts if text]

    def argument(self) -> Name:
        if self.skip("L"):
            self.number()
            return Name("")
        return self.constant() if self.skip("K") else self.type()

    def type(self) -> Name:
        tag = self.next()
        if tag == "B":
            return self.back("type")
        if tag in _BASIC or tag in _POINTERS or tag in "SATFD":
            return Name(self.unnamed(tag))
        self.at -= 1
        return self.path()

    def unnamed(self, tag: str) -> str:
        """Text of a type that has no path."""
        if tag in _BASIC:
            return _BASIC[tag]
        if tag in _POINTERS:
            self.optional_number("L")
            return _POINTERS[tag] + self.type().text
        if tag in "SA":
            entry = self.type().text
            return f"[{entry}]" if tag == "S" else f"[{entry}; {self.constant().text}]"
        if tag == "T":
            return f"({', '.join(self.list('type'))})"
        return self.function() if tag == "F" else self.dynamic()

    def function(self) -> str:
        self.optional_number("G")
        self.skip("U")
        if self.skip("K") and not self.skip("C"):
            self.identifier()
        return f"fn({', '.join(self.list('type'))}) -> {self.type().text}"

    def dynamic(self) -> str:
        self.optional_number("G")
        text = " + ".join(self.list("bound"))
        self.optional_number("L")
        return f"dyn {text}"

    def bound(self) -> Name:
        text = self.path().text
        while self.skip("p"):
            text += f"<{self.identifier()} = {self.argument().text}>"
        return Name(text)

    def constant(self) -> Name:
        tag = self.next()
        if tag == "p":
            return Name("_")
        if tag == "B":
            return self.back("constant")
        if tag not in _BASIC:
            raise ValueError(f"unknown constant {tag} in _R{self.text}")
        sign = "-" if self.skip("n") else ""
        end = self.text.index("_", self.at)
        digits, self.at = self.text[self.at : end], end + 1
        value = int(digits or "0", 16)
        return Name(
            {"b": ["false", "true"][value > 0], "c": repr(chr(value))}.get(tag, f"{sign}{value}")
        )


def read(mangled: str, crate: str) -> tuple[str, str]:
    """Text and module of a function, such as `elements::joints`.

    A function of another crate belongs to the module of the first closure of `crate` that its type
    arguments name, otherwise to that of the first type, if possible outside of `math`.
    """
    reader = _Reader(mangled, crate)
    name = reader.path()
    outside = [home for home in reader.named if home[:1] != ("math",)]
    homes = [name.home] if name.home is not None else reader.closures or outside or reader.named
    return name.text, _module(homes[0]) if homes else OTHER


def _module(home: tuple[str, ...]) -> str:
    return "::".join(home[:2]) or ROOT
