"""The command line of many random inputs in several processes."""

import argparse
import json
import multiprocessing
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any, Protocol, TypeVar


class Outcome(Protocol):
    """The outcome of an input, a dataclass."""

    number: int
    seconds: float
    faults: list[str]


T = TypeVar("T", bound=Outcome)


def say(text: str) -> None:
    print(text, flush=True)


def main(
    about: str,
    run: Callable[[int, int], T],
    report: Callable[[list[T]], None],
    told: Callable[[T], str],
    shown: Callable[[int, int], object] | None = None,
) -> int:
    """Take the inputs of the command line; the exit code, 1 if one has a fault.

    Args:
        about: text of the help.
        run: takes the input with a seed and a number.
        report: prints what is special to these inputs.
        told: the line of an input that has a fault.
        shown: an input as JSON, which ``--only`` prints before it takes the input.
    """
    parser = argparse.ArgumentParser(description=about.split("\n", maxsplit=1)[0])
    parser.add_argument("--runs", type=int, default=100_000)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", type=int, default=4)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--only", type=int, help="one input, which is printed")
    parser.add_argument("--json", type=Path, help="a file for all outcomes")
    asked = parser.parse_args()
    if asked.only is not None:
        if shown is not None:
            say(json.dumps(shown(asked.seed, asked.only), indent=1))
        outcome = run(asked.seed, asked.only)
        say(json.dumps(_plain(outcome), indent=1))
        return 1 if outcome.faults else 0
    outcomes = _all(partial(run, asked.seed), range(asked.first, asked.first + asked.runs), asked)
    if asked.json:
        asked.json.write_text(json.dumps([_plain(o) for o in outcomes]), "utf-8")
    report(outcomes)
    return 1 if _faults(outcomes, told) else 0


def _all(run: Callable[[int], T], numbers: range, asked: argparse.Namespace) -> list[T]:
    outcomes: list[T] = []
    with multiprocessing.get_context("spawn").Pool(asked.processes) as pool:
        for outcome in pool.imap_unordered(run, numbers, chunksize=50):
            outcomes.append(outcome)
            if len(outcomes) % 10_000 == 0:
                say(f"… {len(outcomes)}, faults so far {sum(bool(o.faults) for o in outcomes)}")
    return outcomes


def _faults(outcomes: Sequence[T], told: Callable[[T], str]) -> int:
    """Print the longest input and the faults, and return their number."""
    longest = max(outcomes, key=lambda o: o.seconds)
    say(f"longest: input {longest.number}, {longest.seconds:.2f} s")
    faulty = [o for o in outcomes if o.faults]
    for o in faulty[:50]:
        say(f"FAULT input {o.number}: {told(o)}")
    say(f"{len(outcomes)} inputs, {len(faulty)} with faults")
    return len(faulty)


def _plain(outcome: Any) -> dict[str, Any]:
    return asdict(outcome)
