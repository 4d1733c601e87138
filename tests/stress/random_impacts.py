"""Random mechanisms with friction, stops and contacts, released at random.

    PYTHONPATH=tests python -m stress.random_impacts 0 2000

tries the seeds from 0 to 1999, lists every fault, and prints how the runs ended,
their largest residuals and the slowest run. The exit code is 1 if there is a fault.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import time
import warnings
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import kempe as kp
import numpy as np
from stress.colliding import KINDS
from stress.rubbing import SIZE, Drawn

#: Largest error of the energies, relative to the largest of them. By default, positions have errors
#: of 1e-8 of the size, and a compliant contact that takes all the energy is 1e-3 of the size deep.
ENERGY = 1e-5
#: Energy of a mechanism that hardly moves, J.
LEAST_ENERGY = 1e-6
#: Deepest place beyond a stop or in a contact with restitution, m or rad.
BEYOND = 1e-6
#: Deepest place in a compliant stop or contact: what the energy of the motion gives, or this part
#: of the size if that is more.
DEEP = 1e-3
#: Largest opening of a joint, m.
OPEN = 1e-9
#: Longest CPU time of a run, s.
PATIENCE = 10.0
T_END = 1.0


@dataclass
class Outcome:
    """The outcome of a seed.

    Attributes:
        seed: the seed.
        kind: kind of the mechanism.
        ended: "done", or the type of the error.
        seconds: CPU time of the run, s.
        residuals: residuals by name, each relative to its limit.
        faults: violations of the requirements; every error of kempe is one.
    """

    seed: int
    kind: str
    ended: str = "done"
    seconds: float = 0.0
    residuals: dict[str, float] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)


def drawn(seed: int, kind: str | None = None) -> tuple[str, Drawn, kp.State]:
    """A mechanism that can be assembled, with its start apart from all stops."""
    random = np.random.default_rng([18, seed])
    while True:
        name = kind or str(random.choice(list(KINDS)))
        made = KINDS[name](random)
        try:
            start = kp.assemble(made.model, set=made.set, guess=made.guess)
        except kp.AssemblyError:
            continue
        if all(start[f"{name}.gap"] > 0 for name in touching(start.compiled)):
            return name, made, start


def touching(compiled: kp.CompiledModel) -> list[str]:
    """The names of stops and contacts."""
    return [name for name, info in compiled.forces.items() if info.type in ("stop", "contact")]


def residuals(made: Drawn, sol: kp.Solution) -> dict[str, float]:
    """Errors of a motion relative to their limits."""
    energy = sol.energy
    parts = (energy.kinetic, energy.potential - energy.potential[0], energy.dissipated, energy.work)
    scale = max(LEAST_ENERGY, energy.scale)
    fine = sol(np.linspace(sol.t[0], sol.t[-1], 1000))
    forces = made.model.tree().get("forces", {})
    total = sum(np.abs(part).max() for part in parts)
    hard, compliant = [0.0], [0.0]
    for name in touching(sol.compiled):
        depth = -float(min(np.min(sol[f"{name}.gap"]), np.min(fine[f"{name}.gap"])))
        if "stiffness" in forces[name]:
            n = forces[name].get("exponent", 1.0 if forces[name]["type"] == "stop" else 1.5)
            by_energy = ((n + 1) * total / forces[name]["stiffness"]) ** (1 / (n + 1))
            compliant.append(depth / max(by_energy, DEEP * SIZE))
        else:
            hard.append(depth / BEYOND)
    return {
        "energy balance": float(np.ptp(energy.total) / scale / ENERGY),
        "energy gained": float(-np.diff(energy.dissipated).min(initial=0.0) / scale / ENERGY),
        "open joints": float(np.abs(sol.drift.position).max() / OPEN),
        "depth, restitution": max(hard),
        "depth, compliant": max(compliant),
    }


def patience(begin: float) -> Callable[[float], None]:
    """A progress function that ends a run which takes too long."""

    def look(t: float) -> None:
        if time.process_time() - begin > PATIENCE:
            raise TimeoutError(f"interrupted at {t:.4f} s")

    return look


def outcome(seed: int, kind: str | None = None) -> Outcome:
    """The run of a seed, judged."""
    name, made, start = drawn(seed, kind)
    out = Outcome(seed, name)
    begin = time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            sol = kp.dynamics(made.model, start, t_end=T_END, progress=patience(begin))
        out.seconds = time.process_time() - begin
        out.residuals = residuals(made, sol)
    except TimeoutError as error:
        out.seconds, out.ended = time.process_time() - begin, str(error)
    except kp.KempeError as error:
        out.seconds = out.seconds or time.process_time() - begin
        out.ended = type(error).__name__
        out.faults.append(f"{out.ended}: {error}".replace("\n", " "))
    out.faults += [
        f"{what} {value:.2g} times its limit"
        for what, value in out.residuals.items()
        if not value <= 1
    ]
    if out.seconds > PATIENCE:
        out.faults.append(f"took {out.seconds:.1f} s")
    return out


def say(text: str) -> None:
    print(text, flush=True)


def summary(outcomes: list[Outcome]) -> None:
    """Print how the runs ended, their largest residuals and the slowest."""
    ended = Counter(o.ended for o in outcomes)
    say(
        f"{len(outcomes)} runs: "
        + ", ".join(f"{count} {what}" for what, count in ended.most_common())
    )
    kinds = Counter(o.kind for o in outcomes)
    say("kinds: " + ", ".join(f"{count} {what}" for what, count in sorted(kinds.items())))
    for what in outcomes[0].residuals or ("energy balance",):
        worst = max(outcomes, key=lambda o: o.residuals.get(what, 0.0))
        value = worst.residuals.get(what, 0.0)
        say(f"largest {what}: {value:.2g} times its limit (seed {worst.seed})")
    slow = max(outcomes, key=lambda o: o.seconds)
    say(f"slowest: {slow.seconds:.2f} s (seed {slow.seed})")
    say(f"faults: {sum(bool(o.faults) for o in outcomes)}")


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--processes", type=int, default=1)
    asked = parser.parse_args()
    outcomes = []
    with multiprocessing.get_context("spawn").Pool(asked.processes) as pool:
        for o in pool.imap_unordered(outcome, range(asked.first, asked.last)):
            outcomes.append(o)
            if o.faults:
                say(f"{o.seed} {o.kind}: {'; '.join(o.faults)}")
    summary(outcomes)
    return int(any(o.faults for o in outcomes))


if __name__ == "__main__":
    sys.exit(main())
