"""Settings of other tools that need less time than kempe's default at equal or smaller error."""

from __future__ import annotations

from record import Record
from shows import DEFAULT, cheapest, label


def crossings(records: list[Record], problem: str) -> list[str]:
    """One sentence for each curve of another tool that beats kempe's default method somewhere."""
    here = [r for r in records if r.problem == problem and r.good]
    mine = [r for r in here if r.curve in DEFAULT]
    sentences = []
    for curve in dict.fromkeys(r.curve for r in here if r.tool != "kempe"):
        ahead = [r for r in here if r.curve == curve and beats(r, mine)]
        for peer in sorted(ahead, key=lambda r: r.error):
            sentences.append(sentence(peer, cheapest(mine, lambda r, e=peer.error: r.error <= e)))
    return sentences


def beats(peer: Record, mine: list[Record]) -> bool:
    """Whether kempe's default method needs more time for this error, or does not reach it."""
    # an error as large as the motion itself does not count
    if peer.error > 0.1:
        return False
    equal = cheapest(mine, lambda r: r.error <= peer.error)
    return equal is None or equal.seconds > peer.seconds


def sentence(peer: Record, mine: Record | None) -> str:
    """The sentence for one curve, with numbers."""
    theirs = f"{label(peer)} has an error of {peer.error:.1e} in {1e3 * peer.seconds:.3g} ms"
    if mine is None:
        return f"{theirs}; kempe's default method does not reach that error."
    ratio = mine.seconds / peer.seconds
    return (
        f"{theirs}; kempe's default method takes {1e3 * mine.seconds:.3g} ms, {ratio:.2f} × of it."
    )
