"""Roberts' cognates: the two other four-bars whose coupler points trace the same curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from kempe.base.arguments import explained
from kempe.errors import KempeError, ModelError
from kempe.model.values import instance
from kempe.synthesis import assemble
from kempe.synthesis.assemble import Bars
from kempe.synthesis.candidate import Candidate
from kempe.synthesis.found import Found

if TYPE_CHECKING:
    from kempe.case import Case

#: P is at a pin if the coupler's triangle is flatter than this share of its side.
_AT_PIN = 1e-9


@explained
def cognates(case: Case | Candidate) -> Found:
    """The two cognates of a four-bar: their point P traces the same curve (Roberts 1875).

    With k = (P - A)/(B - A) as complex numbers, the third ground pivot is O + k (D - O). The first
    cognate has the pivots O and this one, the second one this one and D. The crank of the second
    cognate turns as the crank of the four-bar, that of the first one as its rocker.

    Args:
        case: a candidate, or a case with the bodies ``crank``, ``coupler`` with the point ``P``,
            and ``rocker``, and the joints O, A, B and D.

    Raises:
        ModelError: the case has other names, or P is at a pin.
    """
    from kempe.case import Case

    instance(case, (Candidate, Case), "a candidate or " + "a case, as kp.load(path) returns")
    if isinstance(case, Candidate) and type(case) is not Candidate:
        hint = "choose a four-bar"
        raise ModelError(f"a {case.type} has no cognates that are four-bars", hint=hint)
    pins = case.pins if isinstance(case, Candidate) else _pins(case)
    o, a, b, d, p = (np.array([[at]]) for at in pins)
    far = abs(b - a)
    if not far > 0.0 or min(abs(p - a), abs(p - b)) < _AT_PIN * far:
        hint = "choose another point of the coupler"
        raise ModelError("P is at a pin, so that the four-bar has no cognates", hint=hint)
    both = cognate_bars(Bars(o[:, 0], a, b, d[:, 0], p, np.angle(b - a)[:, 0], np.zeros(1)))
    found = assemble.limits(defects="tell")
    return assemble.collected(both, found, either=False, complete=True, task=p[:, 0])


def cognate_bars(bars: Bars) -> Bars:
    """Both cognates of four-bars, first those at O, then those at D."""
    o, d = bars.o[:, None], bars.d[:, None]
    crank, coupler, rocker = bars.a - o, bars.b - bars.a, bars.b - d
    k = ((bars.p - bars.a) / coupler)[:, :1]
    third = o + k * (d - o)
    pins = (third + k * rocker, o + k * coupler), (third + (1 - k) * crank, d + (k - 1) * coupler)
    return Bars(
        np.concatenate([third[:, 0], third[:, 0]]),
        np.concatenate([pins[0][0], pins[1][0]]),
        np.concatenate([pins[0][1], pins[1][1]]),
        np.concatenate([bars.o, bars.d]),
        np.concatenate([bars.p, bars.p]),
        np.concatenate([np.angle(b[:, 0] - a[:, 0]) for a, b in pins]),
        np.concatenate([bars.error, bars.error]),
    )


def _pins(case: Case) -> list[complex]:
    """O, A, B, D and P at the start of a case."""
    try:
        start = case.start()
        at = ("crank.O", "crank.A", "rocker.B", "rocker.D", "coupler.P")
        return [complex(start[f"{name}.x"], start[f"{name}.y"]) for name in at]
    except (KempeError, AttributeError) as error:
        hint = "name them as kp.synthesis does: crank (O, A), coupler (A, B, P), rocker (B, D)"
        raise ModelError(f"cognates: not a four-bar of synthesis: {error}", hint=hint) from error
