"""XML with the lines of its elements, without document types and entities."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

#: Deepest nesting of elements.
DEEPEST = 200


class XmlError(Exception):
    """A fault of the text, with its line."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(message)
        self.line = line


@dataclass
class Node:
    """An element.

    Attributes:
        tag: its name.
        line: the line at which it begins.
        attributes: its attributes, as written.
        children: the elements in it.
    """

    tag: str
    line: int
    attributes: dict[str, str]
    children: list[Node] = field(default_factory=list)

    def each(self, tag: str) -> Iterator[Node]:
        """The children with a name."""
        return (child for child in self.children if child.tag == tag)


def parse(text: str) -> Node:
    """The root of a text.

    Raises:
        XmlError: it is not well-formed, is nested too deeply, or has a document type.
    """
    parser = expat.ParserCreate()
    top = Node("", 0, {})
    stack = [top]

    def start(tag: str, attributes: dict[str, str]) -> None:
        if len(stack) > DEEPEST:
            raise XmlError(parser.CurrentLineNumber, f"more than {DEEPEST} levels of elements")
        node = Node(tag, parser.CurrentLineNumber, attributes)
        stack[-1].children.append(node)
        stack.append(node)

    def end(_: str) -> None:
        stack.pop()

    def refuse(*_: object) -> None:
        raise XmlError(parser.CurrentLineNumber, "document types and entities are refused")

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = refuse
    try:
        parser.Parse(text.encode(), True)
    except expat.ExpatError as error:
        raise XmlError(error.lineno, expat.errors.messages[error.code]) from error
    return top.children[0]
