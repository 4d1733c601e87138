"""Hostile cases and links: each has a fault, so that each has to give a message."""

import base64
import json
import zlib
from collections.abc import Iterator

#: Each would show itself if a browser took it for more than text.
MARKUP = [
    "<img src=x onerror=alert(1)>",
    "<script>alert(1)</script>",
    "<svg onload=alert(1)>",
    "<iframe src=https://example.org>",
    "<a href=javascript:alert(1)>x</a>",
    "<style>*{display:none}</style>",
    "\"><b onmouseover='alert(1)'>",
    "</script><script>alert(1)</script>",
    "{{constructor.constructor('alert(1)')()}}",
    "&lt;img src=x&gt;",
    "${alert(1)}",
    "https://example.org/x.png",
]
#: Names with a meaning for JavaScript or for terminals and layouts.
NAMES = [
    "__proto__",
    "constructor",
    "prototype",
    "toString",
    "hasOwnProperty",
    "\u202eevil",
    "a\u0000b",
    "\x1b[31mred",
    "x" * 5000,
    "\U0001f600" * 300,
    "e\u0301" * 400,
    "a\nb",
]
FORMULAS = [
    "(" * 5000,
    "(" * 5000 + "1" + ")" * 5000,
    "+".join(["1"] * 100_000) + "+",
    "-" * 20_000 + "1",
    "sin(" * 3000 + "1" + ")" * 3000,
    "9^" * 2000 + "9",
    "1e999999",
    "1" * 100_000 + "x",
    "a*" * 5000 + "a",
    "if(" * 2000,
    "alert(1)",
    "__proto__.polluted",
    "constructor('return 1')()",
    "import os",
    "1; while(true);",
    "\u0661\u0662",
    "\u2212" * 50,
    "a.b.c.d.e.f",
    "min(" + ",".join(["1"] * 50_000) + ",",
    "1e",
]
#: Larger than any case of a person: formulas of the page, so that only the page has to hold them.
LARGE = {
    "ten MB of nothing": "'\\n'.repeat(1e7)",
    "ten MB of a title": "'kempe = 1\\ntitle = \"' + 'x'.repeat(1e7) + '\"'",
    "ten MB of comment": "'# ' + 'x'.repeat(1e7)",
    "ten MB of brackets": "'x = ' + '['.repeat(1e7)",
    "ten MB of numbers": "'x = [' + '1, '.repeat(3.3e6) + ']'",
    "a hundred MB": "'x'.repeat(1e8)",
    "two MB of nothing": "'\\n'.repeat(2e6)",
    "two MB of brackets": "'kempe = 1\\nx = ' + '['.repeat(2e6)",
    "two MB of numbers": "'kempe = 1\\nx = [' + '1, '.repeat(6e5) + ']'",
    "two MB of keys": "'kempe = 1\\n' + [...Array(1e5).keys()].map((k) => `k${k} = 1\\n`).join('')",
}


def _link(text: bytes) -> str:
    packed = zlib.compressobj(9, zlib.DEFLATED, -15)
    return _letters(packed.compress(text) + packed.flush())


def _letters(packed: bytes) -> str:
    return "#m=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def texts() -> Iterator[tuple[str, str]]:
    """Faulty cases by name."""
    for name in [*MARKUP, *NAMES]:
        yield f"body {name[:30]!r}", f"kempe = 1\n[bodies.{json.dumps(name)}]\nmass = 1\n"
    for name in MARKUP:
        yield f"key {name[:30]!r}", f"kempe = 1\n{json.dumps(name)} = 1\n"
        quoted = json.dumps(name)
        yield (
            f"reference {name[:30]!r}",
            f"kempe = 1\ntitle = {quoted}\n[joints.A]\ntype = {quoted}\n",
        )
    for formula in FORMULAS:
        quoted = json.dumps(formula)
        yield f"formula {formula[:30]!r}", f"kempe = 1\n[parameters]\na = {quoted}\n"
    yield "parameters in a circle", 'kempe = 1\n[parameters]\na = "b"\nb = "c"\nc = "a"\n'
    bodies = "".join(f"[bodies.b{k}]\nmass = 1\ninertia = 1\n" for k in range(20_000))
    yield "twenty thousand bodies", "kempe = 2\n" + bodies
    yield "deep lists", "kempe = 1\nx = " + "[" * 5000 + "]" * 5000
    yield "deep tables", "kempe = 1\nx = " + "{ a = " * 5000 + "1" + " }" * 5000
    yield "deep keys", "kempe = 1\n" + ".".join(["a"] * 5000) + " = 1\n"
    yield "deep headings", "kempe = 1\n[" + ".".join(["a"] * 5000) + "]\n"
    yield "nothing", ""
    yield "no text", "\x00\x01\x02\x7f"
    yield "a byte order mark twice", "\ufeff\ufeffkempe = 1\nx = 1\n"
    yield "a page", "<!doctype html><script>alert(1)</script>"
    yield "JSON", '{"__proto__": {"polluted": true}}'
    yield "a number without end", "kempe = " + "9" * 100_000


def links() -> Iterator[tuple[str, str]]:
    """Damaged links, bombs and links to faulty cases, by name."""
    good = b"kempe = 1\n"
    yield "no base64", "#m=%%%"
    yield "no deflate", "#m=AAAA"
    yield "nothing", "#m="
    yield "markup", "#m=<img src=x onerror=alert(1)>"
    yield "cut off", _link(good)[:-3]
    yield "a bomb of 50 MB", _link(bytes(50_000_000))[:60_000]
    yield "a bomb that fits", _link(b"#" * 20_000_000)
    yield "a bomb of lines", _link(b"\n" * 12_000_000)
    yield "a bomb of markup", _link(b"<img src=x onerror=alert(1)>" * 400_000)
    yield "too long", "#m=" + "A" * 70_000
    yield "far too long", "#m=" + "A" * 300_000
    yield "no UTF-8", _link(b"\xff\xfe\xfa kempe = 1")
    yield "a faulty case", _link(b'kempe = 1\n[bodies."<img src=x onerror=alert(1)>"]\n')
    yield "a zip", _letters(b"PK\x03\x04" + bytes(100))
    yield "a stored block without end", _letters(b"\x00\xff\xff\x00\x00" * 50)
