"""Attributes of elements with their defaults, and the list of unread parts."""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np

from kempe import _core
from kempe.base.arrays import Floats
from kempe.mjcf.xml import Node


class Unread:
    """What a case lacks: line, text, and whether the motion is the same without it."""

    def __init__(self) -> None:
        self.found: list[tuple[int, str, bool]] = []

    def lost(self, node: Node, what: str) -> None:
        """Something that changes the motion."""
        self.found.append((node.line, f"{titled(node)}: {what}", False))

    def harmless(self, node: Node, what: str) -> None:
        """Something that does not change the motion."""
        self.found.append((node.line, f"{titled(node)}: {what}", True))


def titled(node: Node) -> str:
    """The element with its name, if it has one."""
    name = node.attributes.get("name")
    return f"{node.tag} {name}" if name else node.tag


class Given:
    """The attributes of an element. Those that nobody reads are reported by ``rest``."""

    def __init__(self, node: Node, attributes: dict[str, str], unread: Unread) -> None:
        self.node, self.unread = node, unread
        self.left = dict(attributes)

    def text(self, name: str, otherwise: str = "") -> str:
        """The text of an attribute."""
        return self.left.pop(name, otherwise)

    def numbers(self, name: str, otherwise: Iterable[float], count: int | None = None) -> Floats:
        """Numbers of an attribute; the default if it is absent or wrong."""
        given = self.left.pop(name, None)
        default = np.array(list(otherwise), dtype=float)
        if given is None:
            return default
        try:
            found = np.array([float(word) for word in given.split()])
        except ValueError:
            found = np.array([np.nan])
        if (count is not None and len(found) != count) or not np.isfinite(found).all():
            self.unread.lost(self.node, f"{name}={given!r} is not {count or 'a list of'} numbers")
            return default
        return found

    def direction(
        self, name: str, otherwise: Iterable[float], count: int, of: int | None = None
    ) -> Floats:
        """Numbers of an attribute, the first ``of`` of which must not all be zero."""
        default = np.array(list(otherwise), dtype=float)
        found = self.numbers(name, default, count)
        if found[:of].any():
            return found
        self.unread.lost(self.node, f"{name} is zero; it must be a direction")
        return default

    def number(self, name: str, otherwise: float = 0.0) -> float:
        """One number of an attribute."""
        return float(self.numbers(name, [otherwise], 1)[0])

    def flag(self, name: str, otherwise: bool) -> bool:
        """Whether an attribute is true."""
        return self.left.pop(name, "true" if otherwise else "false") == "true"

    def skip(self, *names: str) -> None:
        """Attributes that do not change the motion."""
        for name in names:
            self.left.pop(name, None)

    def zero(self, *names: str) -> None:
        """Attributes that must be zero or absent."""
        for name in names:
            if self.numbers(name, [0.0]).any():
                self.unread.lost(self.node, f"{name} is not supported")

    def rest(self) -> None:
        """Report attributes that were not read."""
        for name in self.left:
            self.unread.lost(self.node, f"{name} is not supported")


class Names:
    """Names that kempe allows, each used once."""

    def __init__(self) -> None:
        self.used = {"ground", "energy", "drift", "t"}
        self.last: dict[str, int] = {}

    def new(self, wanted: str) -> str:
        """A name like the wanted one."""
        name = re.sub(r"\W", "_", wanted, flags=re.ASCII) or "part"
        name = f"_{name}" if name[0].isdigit() else name
        name = f"{name}_" if _core.is_reserved(name) else name
        base = name
        while name in self.used:
            self.last[base] = self.last.get(base, 1) + 1
            name = f"{base}_{self.last[base]}"
        self.used.add(name)
        return name
