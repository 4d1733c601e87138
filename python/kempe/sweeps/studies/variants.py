"""The variants of a study: stabilization, scheme and tolerance, each with stated numbers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

#: α and β in 1/s: textbook values and zeros, then critically damped values, α = β.
CLASSICAL = ((10.0, 200.0), (1.0, 20.0), (0.0, 0.0))
CRITICAL = ((5.0, 5.0), (20.0, 20.0), (50.0, 50.0), (200.0, 200.0))
#: β in 1/s beside α = 10/s.
BETAS = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
#: Constant steps of RK4, s.
STEPS = (1e-3, 2e-3, 5e-3, 1e-2, 2e-2)
#: Relative tolerances of RK45 and DOP853; the absolute tolerance is a thousandth of them.
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
#: Tolerances of the classical course, of a careful one, and of the most accurate run.
COARSE, FINE, FINEST = 1e-3, 1e-6, 1e-11

GROUPS = {
    "reference": "the most accurate run",
    "stabilization": "stabilization",
    "beta": "sweep of β",
    "step": "constant steps",
    "tolerance": "tolerance",
}


@dataclass(frozen=True)
class Variant:
    """One way to compute an analysis.

    Attributes:
        group: the varied option, a key of ``GROUPS``.
        alpha: of Baumgarte's stabilization, 1/s.
        beta: of Baumgarte's stabilization, 1/s; with α = β = 0 there is none.
        scheme: "RK45", "DOP853" or "RK4".
        number: the relative tolerance, or the step of RK4 in s.
        projected: whether states are projected, in place of Baumgarte's stabilization.
    """

    group: str
    alpha: float
    beta: float
    scheme: str
    number: float
    projected: bool = False

    @property
    def gains(self) -> str:
        """``α = 10, β = 200``, or ``projection``."""
        if self.projected:
            return "projection"
        if self.alpha == self.beta == 0.0:
            return "α = β = 0"
        if self.alpha == self.beta:
            return f"α = β = {self.alpha:g}"
        return f"α = {self.alpha:g}, β = {self.beta:g}"

    @property
    def method(self) -> str:
        """``RK45 rtol 1e-06`` or ``RK4 h = 0.005 s``."""
        told = "h = " if self.scheme == "RK4" else "rtol "
        return f"{self.scheme} {told}{self.number:g}" + (" s" if self.scheme == "RK4" else "")

    @property
    def name(self) -> str:
        """Both in one line."""
        return f"{self.gains}, {self.method}"

    def entry(self) -> dict[str, Any]:
        """The fields of an analysis that it changes, as in a file."""
        method: dict[str, Any] = {"type": "rk4", "step": self.number}
        if self.scheme != "RK4":
            kind = self.scheme.lower()
            method = {"type": kind, "rtol": self.number, "atol": 1e-3 * self.number}
        return {"method": method, "stabilization": self._stabilization()}

    def _stabilization(self) -> dict[str, Any]:
        if self.projected:
            return {"type": "projection"}
        if self.alpha or self.beta:
            return {"type": "baumgarte", "alpha": self.alpha, "beta": self.beta}
        return {"type": "none"}


def variants() -> list[Variant]:
    """All variants that a study computes; the first is the reference."""
    return [Variant("reference", *CLASSICAL[0], "RK45", FINEST), *_all()]


def _all() -> Iterator[Variant]:
    for tolerance in (COARSE, FINE):
        for gains in (*CLASSICAL, *CRITICAL):
            yield Variant("stabilization", *gains, "RK45", tolerance)
        yield _projected("stabilization", "RK45", tolerance)
    for beta in BETAS:
        yield Variant("beta", 10.0, beta, "RK45", FINE)
    for step in STEPS:
        for gains in (*CLASSICAL, CRITICAL[1]):
            yield Variant("step", *gains, "RK4", step)
    for tolerance in TOLERANCES:
        for gains in CLASSICAL[:2]:
            yield Variant("tolerance", *gains, "RK45", tolerance)
        for scheme in ("RK45", "DOP853"):
            yield _projected("tolerance", scheme, tolerance)


def _projected(group: str, scheme: str, number: float) -> Variant:
    return Variant(group, 0.0, 0.0, scheme, number, projected=True)
