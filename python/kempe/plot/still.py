"""Panels without information: all zero, constant, or equal to another panel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arrays import Floats
from kempe.draw.units import Scale, scale
from kempe.model.compiled import ACCELERATIONS, COORDINATES, RATES
from kempe.plot.body_motion import QUANTITIES
from kempe.plot.panel import CONSTANT, Panel
from kempe.results.fine import fine

if TYPE_CHECKING:
    from kempe.results.motion import Motion

#: A quantity below this fraction of the largest value of its kind in the mechanism is zero.
NOTHING = 1e-9


def largest_values(motion: Motion) -> dict[str, float]:
    """The largest magnitude of each kind of quantity in the mechanism, by SI unit."""
    motion = fine(motion)
    found: dict[str, float] = {}

    def note(unit: str, values: Floats) -> None:
        found[unit] = max(found.get(unit, 0.0), float(np.abs(values).max(initial=0.0)))

    for name in motion.compiled.bodies:
        body = motion.body(name)
        for quantity in (*COORDINATES, *RATES, *ACCELERATIONS):
            note(motion.variable.rate(QUANTITIES[quantity][1]), getattr(body, quantity))
    for name, joint in motion.compiled.constraints.items():
        reaction = motion.constraint(name)
        for on in dict.fromkeys((joint.i, joint.j)):
            note("N", reaction.force(on=on))
            note("N·m", reaction.torque(on=on))
    for name, info in motion.compiled.forces.items():
        note("N·m", motion.force(name).torque(on=info.j))
    # A torque and its rounding error follow from forces and their lever arms.
    turning = found.get("N", 0.0) * found.get("m", 0.0)
    found["N·m"] = max(found.get("N·m", 0.0), turning)
    return found


def drawn_and_left_out(
    panels: Sequence[Panel], largest: Mapping[str, float], fixed: Mapping[str, Scale]
) -> tuple[list[Panel], str]:
    """The panels with information, and a sentence about the other panels.

    Constants are drawn if the page has no other panels. If all panels are zero, only the first is
    drawn.

    Args:
        panels: the panels of a page.
        largest: the largest magnitude of each quantity in the mechanism, by SI unit.
        fixed: units of axes by SI unit; others are chosen for each value.
    """
    kept: list[Panel] = []
    zero, constant, equal = list[str](), list[str](), list[str]()
    still, flat = list[Panel](), list[Panel]()
    for panel in panels:
        twin = next((other for other in kept if _same(panel, other)), None)
        if panel.peak <= NOTHING * largest.get(panel.unit, 0.0):
            zero.append(panel.name)
            flat.append(panel)
        elif all(_is_constant(curve.values) for curve in panel.curves):
            unit = fixed.get(panel.unit) or scale(panel.unit, panel.peak)
            constant.append(f"{panel.name} = {unit.written(sum(panel.span) / 2.0)}")
            still.append(panel)
        elif twin is not None:
            equal.append(f"{panel.name} (equal to {twin.name})")
        else:
            kept.append(panel)
    if not kept:
        kept, constant = still, []
    if not kept:
        kept, zero = flat[:1], zero[1:]
    families = (("zero", zero), ("constant", constant))
    told = [f"{', '.join(names)} ({word})" for word, names in families if names]
    return kept, f"Not drawn: {'; '.join([*told, *equal])}." if told or equal else ""


def _is_constant(values: Floats) -> bool:
    return bool(np.ptp(values) <= CONSTANT * np.abs(values).max(initial=0.0))


def _same(one: Panel, other: Panel) -> bool:
    if one.unit != other.unit or len(one.curves) != len(other.curves):
        return False
    room = NOTHING * max(one.peak, other.peak)
    pairs = zip(one.curves, other.curves, strict=True)
    return all(bool(np.abs(a.values - b.values).max(initial=0.0) <= room) for a, b in pairs)
