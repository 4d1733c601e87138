"""Texts of PMKS+ mechanisms, written for tests."""

from __future__ import annotations

from collections.abc import Sequence

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
#: Flags of joints.
SLIDE, INPUT, GROUND, WELDED, SEALED = 1, 2, 4, 8, 32
#: Choices of units: lengths, angles, forces, all.
INCH, CENTIMETRE, METRE = "0000", "1011", "2112"


def integer(value: int) -> str:
    """An integer in base 64; a zero in front makes it negative."""
    digits, rest = "", abs(value)
    while not digits or rest:
        rest, digit = divmod(rest, 64)
        digits = DIGITS[digit] + digits
    return f"0{digits}" if value < 0 else digits


def number(value: float) -> str:
    """A number, in thousandths."""
    return integer(round(1000 * value))


def joint(name: str, x: float, y: float, flags: int = 0, angle: float = 0, later: str = "") -> str:
    """A joint; later fields are its slot, its speed and the mass of its block."""
    return f"{DIGITS[flags]}{name},{name},{number(x)},{number(y)},{number(angle)}{later}"


def link(
    joints: str,
    name: str = "",
    *,
    kind: str = "YR",
    values: Sequence[float] = (1, 1, 0, 0),
    parts: str = "",
) -> str:
    """A link of joints with one letter each; its values are mass, inertia and centre."""
    shown = ",".join(number(value) for value in values)
    return f"{kind}{joints},{name or joints},{shown},c5cae9,{','.join(joints)},,{parts}"


def force(
    name: str, on: str, at: Sequence[float], to: Sequence[float], size: float, flags: int = 2
) -> str:
    """A force along the line from one place to another; flag 1 is local, and 2 is outward."""
    shown = ",".join(number(value) for value in (*at, *to, size))
    return f"{DIGITS[flags]}{name},{on},{name},{shown}"


def drawing(
    joints: Sequence[str],
    links: Sequence[str],
    forces: Sequence[str] = (),
    *,
    units: str = CENTIMETRE,
    clockwise: bool = True,
    rpm: int = 10,
    entries: str = "",
    weightless: bool = False,
) -> str:
    """The text of a mechanism without check sums."""
    flags = DIGITS[8 * weightless // 2] + DIGITS[int(clockwise)]
    records = [".".join([*section, ""]) for section in (joints, links, forces)]
    tail = f".{entries}" if entries else ""
    return f"{flags}.Fe,1E8.{integer(rpm)},0.{units}." + ".".join(records) + f".N_{tail}"


def stamped(text: str, hashed: bool = True) -> str:
    """A text with its check sums: the length, and in newer texts the hash FNV-1a."""
    units = text.encode("utf-16-le")
    text += DIGITS[len(units) // 2 % 62]
    if not hashed:
        return text
    value = 0x811C9DC5
    units = text.encode("utf-16-le")
    for k in range(0, len(units), 2):
        value = (value ^ int.from_bytes(units[k : k + 2], "little")) * 0x01000193 % 2**32
    digits = ""
    for _ in range(6):
        value, digit = divmod(value, 62)
        digits = DIGITS[digit] + digits
    return f"{text}*{digits}"
