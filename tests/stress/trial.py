"""One random run through the public interface, and the check of its outcome.

A run may fail with an error of kempe that names the cause. A successful run must contain only
finite numbers and, with projection, closed joints.
"""

import time
import warnings
from collections import Counter
from dataclasses import dataclass, field

import kempe as kp
import numpy as np
from kempe.model.compiled import CompiledModel
from stress.mechanisms import KINDS, Random, chance, power

#: Longest run, s of CPU time.
PATIENCE = 10.0
#: Largest gap of a joint with projection, relative to the size of the mechanism.
CLOSED = 1e-8
#: The same with Baumgarte's stabilization.
APART = 1e-2
#: Largest number of steps of most runs; the others use the default.
STEPS = 2000

#: Errors with which a run may end.
EXPECTED = (
    kp.AssemblyError,
    kp.RedundancyError,
    kp.SingularityError,
    kp.IntegrationError,
)


class TooLongError(Exception):
    """A run took too long."""


@dataclass
class Outcome:
    """The outcome of a run.

    Attributes:
        number: number of the run.
        kind: kind of mechanism.
        options: description of the options.
        ended: "success", or the class of the error.
        message: message of the error.
        seconds: CPU time.
        gap: largest gap of a successful run, relative to the size of the mechanism.
        faults: violations of the requirements.
    """

    number: int
    kind: str
    options: str = ""
    ended: str = "success"
    message: str = ""
    seconds: float = 0.0
    gap: float = 0.0
    faults: list[str] = field(default_factory=list)

    @property
    def projected(self) -> bool:
        return "Projection" in self.options


def method(random: Random, t_end: float) -> kp.RK4 | kp.RK45 | kp.DOP853:
    """A scheme with tolerances and steps from 1e-12 to 1e3 s."""
    step = power(random, -12, 3) if chance(random, 0.3) else t_end * power(random, -4, 0)
    if chance(random, 0.2):
        return kp.RK4(step=step)
    pair = kp.RK45 if chance(random, 0.5) else kp.DOP853
    kind = random.random()
    if kind < 0.3:
        return pair(step=step)
    rtol = power(random, -12, -2)
    bounds = {}
    if kind < 0.5:
        bounds["first_step"] = min(step, t_end)
    if 0.4 < kind < 0.6:
        bounds["max_step"] = step
    return pair(rtol=rtol, atol=rtol * power(random, -6, 0), **bounds)


def stabilization(random: Random) -> kp.Projection | kp.Baumgarte | None:
    kind = random.random()
    if kind < 0.6:
        return kp.Projection()
    if kind < 0.7:
        return kp.Baumgarte()
    if kind < 0.8:
        return kp.Baumgarte(gains="step")
    if kind < 0.9:
        return kp.Baumgarte(alpha=power(random, -2, 4), beta=power(random, -2, 4))
    return None


def options(random: Random) -> dict[str, object]:
    t_end = power(random, -12, 3) if chance(random, 0.3) else power(random, -2, 1)
    chosen: dict[str, object] = {
        "t_end": t_end,
        "method": method(random, t_end),
        "stabilization": stabilization(random),
        "dense_output": chance(random, 0.1),
    }
    if chance(random, 0.5):
        chosen["output_step"] = t_end * power(random, -2.5, 0.5)
    if chance(random, 0.98):
        chosen["max_steps"] = STEPS
    return chosen


def size(model: CompiledModel) -> float:
    """The largest distance of a point from the origin of its frame, m; 1 m if there is none."""
    points = [p for body in model.all_bodies.values() for p in body.points.values()]
    return max((float(np.hypot(*p)) for p in points), default=0.0) or 1.0


def gap(sol: kp.Solution) -> float:
    """Largest |Φ|, lengths relative to the size."""
    units = sol.model.row_units()
    scale = np.array([size(sol.model) if unit == "m" else 1.0 for unit in units])
    return float((np.abs(sol.residuals[0]) / scale).max(initial=0.0))


def following(sol: kp.Solution) -> tuple[np.ndarray, ...]:
    """Derived quantities; empty if an error reports that a state has none."""
    try:
        return sol.a, sol.lam, sol.energy.balance
    except (kp.IntegrationError, kp.SingularityError):
        return ()


def finite(sol: kp.Solution) -> bool:
    tables = (sol.t, sol.q, sol.v, *following(sol))
    if sol.dense is not None:
        tables += (sol.dense.c,)
    return all(bool(np.isfinite(table).all()) for table in tables)


def judge(outcome: Outcome, sol: kp.Solution) -> None:
    if not finite(sol):
        outcome.faults.append("success with numbers that are not finite")
    if sol.success is not True or sol.t[-1] <= sol.t[0]:
        outcome.faults.append("a solution that did not get anywhere")
    outcome.gap = gap(sol)
    most = CLOSED if outcome.projected else APART if "Baumgarte" in outcome.options else 1.0
    if not outcome.gap <= most:
        outcome.faults.append(f"success with a gap of {outcome.gap:.1e}")


def judge_error(outcome: Outcome, error: BaseException) -> None:
    outcome.ended, outcome.message = type(error).__name__, str(error)
    if not isinstance(error, EXPECTED):
        outcome.faults.append(f"{outcome.ended}: {error}")
        return
    if isinstance(error, (kp.IntegrationError, kp.SingularityError)):
        partial = getattr(error, "solution", None)
        if partial is not None and not finite(partial):
            outcome.faults.append("a partial solution with numbers that are not finite")
        if not error.hint:
            outcome.faults.append("an error without a remedy")


def run(seed: int, number: int) -> Outcome:
    """The reproducible run with this number."""
    random = np.random.default_rng([seed, number])
    kind = str(random.choice(list(KINDS)))
    drawn, chosen = KINDS[kind](random), options(random)
    outcome = Outcome(number, kind, ", ".join(f"{k}={v}" for k, v in chosen.items()))
    begin = time.process_time()

    def patience(_: float) -> None:
        if time.process_time() - begin > PATIENCE:
            raise TooLongError(f"more than {PATIENCE} s")

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            start = kp.assemble(drawn.model, set=drawn.set, guess=drawn.guess)
            sol = kp.dynamics(drawn.model, start, **chosen, progress=patience)  # type: ignore[arg-type]
        judge(outcome, sol)
    except Exception as error:
        judge_error(outcome, error)
    outcome.seconds = time.process_time() - begin
    if outcome.seconds > PATIENCE and outcome.ended != "TooLongError":
        outcome.faults.append(f"took {outcome.seconds:.1f} s")
    return outcome


def tally(outcomes: list[Outcome]) -> Counter[str]:
    """Number of runs for each outcome."""
    return Counter(outcome.ended for outcome in outcomes)
