"""The findings of a study, in sentences with numbers computed from its outcomes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

import numpy as np

from kempe.base.display_units import chosen_for, display

if TYPE_CHECKING:
    from kempe.sweeps.studies.outcome import Outcome, Outcomes

#: Smaller differences from the reference have no meaning, since the reference has errors too.
DOUBT = 1e-9


def findings(study: Outcomes) -> list[str]:
    """Sentences computed from the data; sentences that do not apply are left out."""
    return [
        *_stabilization(study),
        *_sweep(study),
        *_steps(study),
        *_divergence(study),
        *_orders(study),
        *_cheapest(study),
    ]


def _stabilization(study: Outcomes) -> Iterator[str]:
    """The remaining error of each pair of gains, at each tolerance."""
    by_number = groupby(study.group("stabilization"), key=lambda o: o.variant.number)
    for number, group in by_number:
        outcomes = [o for o in group if not o.diverged]
        told = [
            f"{o.variant.gains} {length(o.residual)} in {o.steps} steps"
            for o in sorted(outcomes, key=lambda o: o.residual)
        ]
        if told:
            yield f"With RK45 at rtol {number:g} the constraints open by up to: {'; '.join(told)}."


def _sweep(study: Outcomes) -> Iterator[str]:
    outcomes = [o for o in study.group("beta") if not o.diverged]
    if len(outcomes) < 2:
        return
    low, high = outcomes[0], outcomes[-1]
    best = min(outcomes, key=lambda o: o.position_error)
    yield (
        f"From β = {low.variant.beta:g} to {high.variant.beta:g} at the same tolerance the steps "
        f"change from {low.steps} to {high.steps} and the residual from {length(low.residual)} to "
        f"{length(high.residual)}; the smallest position error, {length(best.position_error)}, "
        f"is that of β = {best.variant.beta:g}."
    )
    stiff = [(a, b) for a, b in pairwise(outcomes) if a.variant.beta >= 200.0]
    if stiff:
        a, b = stiff[0][0], stiff[-1][1]
        power = math.log(b.steps / a.steps) / math.log(b.variant.beta / a.variant.beta)
        why = "stability sets the step" if power > 0.7 else "accuracy still sets the step"
        yield f"Above β = {a.variant.beta:g} the steps grow as β^{power:.2f}: {why}."


def _steps(study: Outcomes) -> Iterator[str]:
    """Comparison of weak and strong gains at each constant step."""
    strong, weak = (_at(study, *gains) for gains in ((10.0, 200.0), (1.0, 20.0)))
    for h in sorted(set(strong) & set(weak)):
        a, b = strong[h], weak[h]
        if a.diverged or b.diverged:
            continue
        verb = "beats" if b.position_error < a.position_error else "loses to"
        yield (
            f"With constant steps of {h:g} s, {b.variant.gains} {verb} {a.variant.gains}: position "
            f"error {length(b.position_error)} against {length(a.position_error)}."
        )


def _at(study: Outcomes, alpha: float, beta: float) -> dict[float, Outcome]:
    group = study.group("step")
    return {
        o.variant.number: o for o in group if (o.variant.alpha, o.variant.beta) == (alpha, beta)
    }


def _divergence(study: Outcomes) -> Iterator[str]:
    for o in study.outcomes:
        if not o.diverged:
            continue
        when = instant(o, 3)
        told = ""
        if o.variant.scheme == "RK4":
            factor = growth(o.variant.alpha, o.variant.beta, o.variant.number)
            told = (
                f"; with β h = {o.variant.beta * o.variant.number:g} the stabilization multiplies"
            )
            told += f" the opening of the joints by {factor:.3g} in each step"
        yield f"{o.variant.method} with {o.variant.gains} diverges{when}: {o.reason}{told}."
    rk4 = [o for o in study.group("step") if o.variant.beta > 0.0]
    if rk4 and not any(o.diverged for o in rk4):
        yield "No constant step of the study diverges."


def growth(alpha: float, beta: float, step: float) -> float:
    """Growth factor of a step of RK4 for Φ̈ + 2α Φ̇ + β² Φ = 0; above 1, Φ grows without bound."""
    root = np.sqrt(complex(alpha**2 - beta**2))
    steps = [step * (-alpha + root), step * (-alpha - root)]
    return float(max(abs(1.0 + z + z**2 / 2.0 + z**3 / 6.0 + z**4 / 24.0) for z in steps))


def _orders(study: Outcomes) -> Iterator[str]:
    """Observed order of RK4: the slope of the error over the step."""
    for gains in ((10.0, 200.0), (1.0, 20.0)):
        # the error of a variant that diverged is NaN, which is not larger
        used = [o for o in _at(study, *gains).values() if o.position_error > DOUBT]
        if len(used) >= 3:
            h, error = _logarithms((o.variant.number, o.position_error) for o in used)
            slope = float(np.polyfit(h, error, 1)[0])
            yield f"RK4 with {used[0].variant.gains} converges with order {slope:.1f} in the step."


def _logarithms(points: Iterable[tuple[float, float]]) -> tuple[list[float], list[float]]:
    x, y = zip(*((math.log(a), math.log(b)) for a, b in points), strict=True)
    return list(x), list(y)


def _cheapest(study: Outcomes) -> Iterator[str]:
    """The fewest evaluations that keep every position within a millimetre and a micrometre."""
    for bound in (1e-3, 1e-6):
        good = [o for o in study.outcomes[1:] if o.position_error <= bound]
        if good:
            best = min(good, key=lambda o: o.evaluations)
            yield (
                f"The cheapest variant with every position within {length(bound)} is "
                f"{best.variant.name}: {best.evaluations} evaluations."
            )


def instant(outcome: Outcome, digits: int) -> str:
    """`` at t = 0.15 s`` of a divergence; empty if its time is unknown."""
    if outcome.diverged_at is None:
        return ""
    time = display("s")
    return f" at t = {outcome.diverged_at / time.divisor:.{digits}g} {time.symbol}"


def length(value: float) -> str:
    """A length in the chosen display unit, or in a unit that suits its magnitude."""
    chosen = chosen_for("m")
    if chosen is not None:
        return f"{value / chosen.divisor:.3g} {chosen.symbol}"
    for unit, scale in (("m", 1.0), ("mm", 1e-3), ("µm", 1e-6)):
        if value >= scale:
            return f"{value / scale:.3g} {unit}"
    return f"{value / 1e-9:.3g} nm"
