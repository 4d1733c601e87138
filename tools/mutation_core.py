"""Change the core in small ways and count the changes that the tests find.

    .venv/bin/python tools/mutation_core.py FOLDER --shards 1 2

cargo-mutants lists the changes, the mutants. All of a sample are compiled at once: each changed
function begins with a switch on the environment variable KEMPE_MUTANT. Each mutant runs the tests
of the core, module by module, then the tests in Python, until the first fails. FOLDER receives
two copies of the repository at HEAD, one of them changed, and the outcomes; a second call
continues there.
"""

import argparse
import json
import math
import os
import re
import signal
import subprocess
import sys
from collections import defaultdict
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

ROOT = Path(__file__).resolve().parents[1]
#: Quick modules run first, and those of this program, which find many changes, as if each took
#: no more than this time in s.
_EARLY, _EARLY_TIME = "conformance", 0.1
#: Tests in Python that use the core, by subject. Those of pages in a browser are left out.
_PYTHON = (
    "tests/truth",
    "tests/python",
    "tests/mobility",
    "tests/redundant",
    "tests/convergence",
    "tests/modes",
    "tests/singular",
    "tests/stress",
    "tests/study",
    "tests/cli",
    "tests/schema",
    "tests/lab_report",
    "tests/draw",
)
#: The optimised extension, in less time than `pip install` takes.
_QUICK = {"lto": "false", "codegen-units": "16", "opt-level": "2"}
#: A program is stopped if it computes this many times as long as without a mutant, and some
#: seconds. Waiting for the processor counts only beyond the last factor.
_PATIENCE, _GRACE, _WAITING = 4.0, 20.0, 20.0
#: Memory that a process may use, in KiB: a changed loop may collect without end.
_MEMORY = 6 << 20
#: What became of a mutant that was not found.
_REFUSED, _LEFT = "does not compile", "not tried"
_PASSES_RUST, _SURVIVES = "passes the tests in Rust", "survives"
_SWITCH = """
#[doc(hidden)]
pub fn active_mutant() -> u32 {
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *NUMBER.get_or_init(|| std::env::var("KEMPE_MUTANT").map_or(0, |it| it.parse().unwrap()))
}
"""


#: The first line and column, and those behind the last.
Span: TypeAlias = tuple[tuple[int, int], tuple[int, int]]
#: The index of a line and column in a text.
Index: TypeAlias = Callable[[tuple[int, int]], int]


@dataclass(frozen=True)
class Mutant:
    """A change: the text of `span` in a file becomes `replacement`."""

    number: int
    shard: int
    name: str
    file: str
    span: Span
    replacement: str
    function: Span | None


class Place:
    """The folder of a run."""

    def __init__(self, folder: Path) -> None:
        """Clone the repository, unless it is there."""
        self.plain, self.copy = folder / "plain", folder / "copy"
        self.stored = folder / "outcomes.json"
        for clone in (self.plain, self.copy):
            if not clone.exists():
                subprocess.run(["git", "clone", "-q", str(ROOT), str(clone)], check=True)
        known = json.loads(self.stored.read_text("utf-8")) if self.stored.exists() else {}
        #: What became of each mutant, by its name.
        self.outcomes: dict[str, str] = known.get("outcomes", {})
        #: The time in s that each program computes without a mutant.
        self.times: dict[str, float] = known.get("times", {})

    def store(self) -> None:
        """Write what is known."""
        known = {"outcomes": self.outcomes, "times": self.times}
        self.stored.write_text(json.dumps(known, indent=1), "utf-8")

    def write(self, file: str, text: str) -> None:
        """Change a file of the copy. One that stays the same is not compiled again."""
        if (self.copy / file).read_text("utf-8") != text:
            (self.copy / file).write_text(text, "utf-8")


@dataclass(frozen=True)
class Program:
    """Tests that run together, and the longest time that they may compute in s."""

    name: str
    command: tuple[str, ...]
    folder: Path
    patience: float = 3600.0


def main() -> int:
    """Run the samples and print a table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=_Verbatim)
    parser.add_argument("folder", type=Path, help="for the copies and the outcomes")
    parser.add_argument("--shards", type=int, nargs="+", default=[1], help="1 by default")
    parser.add_argument("--of", type=int, default=400, help="one change in 400 by default")
    parser.add_argument(
        "--files", nargs="+", default=["core/src/**"], help="patterns; the whole core by default"
    )
    parser.add_argument("--jobs", type=int, default=2, help="mutants at a time, 2 by default")
    asked = parser.parse_args()
    os.environ |= {"PYO3_PYTHON": sys.executable, "RUST_BACKTRACE": "0"}
    place = Place(asked.folder.resolve())
    files = [word for file in asked.files for word in ("-f", file)]
    mutants = [one for shard in asked.shards for one in _listed(place, files, shard, asked.of)]
    _build(place, mutants)
    _run(place, mutants, "", asked.jobs, _rust_programs)
    _run(place, mutants, _PASSES_RUST, asked.jobs, _python_programs)
    _print(mutants, place.outcomes)
    return 0


class _Verbatim(argparse.RawDescriptionHelpFormatter):
    """Keeps the lines of the description."""


def _listed(place: Place, files: list[str], shard: int, of: int) -> list[Mutant]:
    """The mutants of a shard. Numbers do not depend on the other shards of a call."""
    command = ["cargo", "mutants", "-p", "kempe", *files, "-e", "**/tests/**", "--list", "--json"]
    command += ["--shard", f"{shard}/{of}", "--sharding", "round-robin"]
    done = subprocess.run(command, cwd=place.plain, check=True, capture_output=True, text=True)
    return [
        Mutant(
            number=1000 * shard + k + 1,
            shard=shard,
            name=one["name"],
            file=one["file"],
            span=_span(one["span"]),
            replacement=one["replacement"],
            function=_span(one["function"]["span"]) if one["function"] else None,
        )
        for k, one in enumerate(json.loads(done.stdout))
    ]


def _span(told: dict[str, dict[str, int]]) -> Span:
    start, end = ((told[key]["line"], told[key]["column"]) for key in ("start", "end"))
    return start, end


def _build(place: Place, mutants: list[Mutant]) -> None:
    """Compile all mutants that can be compiled, and store which cannot."""
    checked = False
    while True:
        left = [one for one in mutants if place.outcomes.get(one.name) not in (_REFUSED, _LEFT)]
        files = {one.file for one in mutants}
        place.outcomes |= dict.fromkeys(_write_switches(place, files, left), _LEFT)
        command = "test --no-run" if checked else "check --features test-elements"
        errors = list(_errors(place.copy, ["cargo", *command.split(), "-p", "kempe"]))
        for one in errors:
            place.outcomes[_changed_at(place.copy, left, one)] = _REFUSED
        place.store()
        print(f"cargo {command}: {len(errors)} errors", flush=True)
        if checked and not errors:
            return
        checked = not errors


def _write_switches(place: Place, files: set[str], mutants: list[Mutant]) -> list[str]:
    """Change the files. The mutants are named that a switch cannot contain.

    A file of which no mutant compiles becomes as it was.
    """
    refused = []
    lib = "core/src/lib.rs"
    place.write(lib, (place.plain / lib).read_text("utf-8") + _SWITCH)
    for file in sorted(files):
        source = (place.plain / file).read_text("utf-8")
        at = _positions(source)
        functions: dict[tuple[int, int], list[Mutant]] = defaultdict(list)
        for one in (one for one in mutants if one.file == file):
            body = _body(source, *map(at, one.function)) if one.function else None
            if body:
                functions[body].append(one)
            else:
                refused.append(one.name)
        result, last = "", len(source)
        for (opening, end), own in sorted(functions.items(), reverse=True):
            if end > last:  # another function is within this one
                refused += [one.name for one in own]
                continue
            result = _switch(source, at, (opening, end), own) + source[end:last] + result
            last = opening
        place.write(file, source[:last] + result)
    return refused


def _body(source: str, begin: int, end: int) -> tuple[int, int] | None:
    """The body of a function with its braces; none if it cannot contain a switch."""
    depth = 0
    for k, letter in enumerate(source[begin:end], start=begin):
        depth += (letter == "(") - (letter == ")")
        if letter == "{" and depth == 0:  # not the pattern of an argument
            # a switch is not constant, and its arms are of one type
            alone = re.search(r"\bconst fn\b|-> .*\bimpl\b", source[begin:k])
            return None if alone else (k, end)
    raise ValueError(source[begin:end])


def _positions(source: str) -> Index:
    """A function that gives the index of a line and column, both counted from 1."""
    starts = [0, *(k + 1 for k, letter in enumerate(source) if letter == "\n")]
    return lambda place: starts[place[0] - 1] + place[1] - 1


def _switch(source: str, at: Index, body: tuple[int, int], own: list[Mutant]) -> str:
    """The body of a function with the changed bodies beside it."""
    arms = ""
    for one in own:
        begin, end = (at(place) for place in one.span)
        changed = source[body[0] : begin] + one.replacement + source[end : body[1]]
        arms += f"{one.number} => // mutant {one.number}\n{changed}\n// end\n"
    return f"{{ match crate::active_mutant() {{\n{arms}_ => {source[slice(*body)]}\n}} }}"


def _errors(copy: Path, command: list[str]) -> Iterator[dict[str, Any]]:
    """Messages of the compiler."""
    full = [*command, "--message-format=json"]
    done = subprocess.run(full, cwd=copy, check=False, capture_output=True, text=True)
    for line in done.stdout.splitlines():
        told = json.loads(line)
        message = told["message"] if told["reason"] == "compiler-message" else {"level": ""}
        if message["level"] == "error" and message["spans"]:
            yield message


def _changed_at(copy: Path, mutants: list[Mutant], message: dict[str, Any]) -> str:
    """The mutant at the place of an error."""
    span = next(one for one in message["spans"] if one["is_primary"])
    while span["expansion"]:
        span = span["expansion"]["span"]
    lines = (copy / span["file_name"]).read_text("utf-8").splitlines()[: span["line_start"]]
    for line in reversed(lines):
        if found := re.search(r"=> // mutant (\d+)$", line):
            return next(one.name for one in mutants if one.number == int(found[1]))
        if line == "// end":
            break
    raise SystemExit(f"an error that is not of a mutant\n{message['rendered']}")


def _rust_programs(copy: Path) -> list[Program]:
    command = ["cargo", "test", "-p", "kempe", "--no-run", "--message-format=json"]
    done = subprocess.run(command, cwd=copy, check=True, capture_output=True, text=True)
    built = [json.loads(line) for line in done.stdout.splitlines()]
    return [
        program
        for one in built
        if one.get("executable") and one["profile"]["test"]
        for program in _modules(one["target"]["name"], one["executable"], copy / "core")
    ]


def _modules(name: str, executable: str, folder: Path) -> Iterator[Program]:
    """One program for the tests of each module of a test program."""
    listed = [executable, "--list", "--format=terse"]
    done = subprocess.run(listed, cwd=folder, check=True, capture_output=True, text=True)
    modules: dict[str, list[str]] = defaultdict(list)
    for line in done.stdout.splitlines():
        if line.endswith(": test"):
            test = line.removesuffix(": test")
            modules[test.partition("::")[0]].append(test)
    for module, tests in sorted(modules.items()):
        # whole names: a part of a name would also select modules within other modules
        command = (executable, "--test-threads=1", "--exact", *tests)
        yield Program(f"{name} {module}", command, folder)


def _python_programs(copy: Path) -> list[Program]:
    options = [f"--config=profile.release.{key}={value}" for key, value in _QUICK.items()]
    command = ["cargo", "build", "-q", "--release", "-p", "kempe-python", *options]
    subprocess.run(command, cwd=copy, check=True)
    built = (copy / "target/release/lib_core.so").read_bytes()
    (copy / "python/kempe/_core.abi3.so").write_bytes(built)
    os.environ |= {"PYTHONPATH": "python:tests", "PYTHONDONTWRITEBYTECODE": "1"}
    pytest = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
    return [Program(name, (*pytest, "-m", "not alone", name), copy) for name in _PYTHON]


def _run(
    place: Place,
    mutants: list[Mutant],
    waiting: str,
    jobs: int,
    built: Callable[[Path], list[Program]],
) -> None:
    """Run programs for the mutants whose outcome is `waiting`."""
    left = [one for one in mutants if place.outcomes.get(one.name, "") == waiting]
    if not left:
        return
    programs = _timed(place, built(place.copy))
    passes = _PASSES_RUST if built is _rust_programs else _SURVIVES
    with ThreadPoolExecutor(jobs) as pool:
        futures = {pool.submit(_outcome, one, programs, passes): one for one in left}
        for future in as_completed(futures):
            mutant = futures[future]
            place.outcomes[mutant.name] = future.result()
            place.store()
            print(f"{mutant.number} {mutant.name}: {future.result()}", flush=True)


def _timed(place: Place, programs: list[Program]) -> list[Program]:
    """The programs in the order in which they run, with their patience. All must pass."""
    for one in programs:
        if one.name in place.times:
            continue
        begin = os.times()
        if failed := _failure(one, 0):
            raise SystemExit(f"{one.name} fails without a mutant: {failed}")
        end = os.times()
        place.times[one.name] = end.children_user - begin.children_user
        place.store()
        print(f"{one.name}: {place.times[one.name]:.1f} s", flush=True)
    ordered = sorted(programs, key=lambda one: _rank(one.name, place.times[one.name]))
    return [replace(one, patience=_PATIENCE * place.times[one.name] + _GRACE) for one in ordered]


def _rank(name: str, time: float) -> float:
    """The time by which the programs are ordered."""
    return min(time, _EARLY_TIME) if name.startswith(_EARLY) else time


def _outcome(mutant: Mutant, programs: list[Program], passes: str) -> str:
    for one in programs:
        if failed := _failure(one, mutant.number):
            return f"found by {one.name}: {failed}"
    return passes


def _failure(program: Program, number: int) -> str:
    """The first test that fails, or an empty text."""
    limits = f"ulimit -v {_MEMORY} && ulimit -t {math.ceil(program.patience)}"
    with subprocess.Popen(
        ["sh", "-c", f'{limits} && exec "$@"', "sh", *program.command],
        cwd=program.folder,
        env=os.environ | {"KEMPE_MUTANT": str(number)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    ) as process:
        try:
            output = process.communicate(timeout=_WAITING * program.patience)[0]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return "takes too long"
    if process.returncode in (0, -signal.SIGXCPU, -signal.SIGKILL):
        return "takes too long" if process.returncode else ""
    found = re.search(r"^test (\S+) .*FAILED|^(?:FAILED|ERROR) (\S+)", output, re.MULTILINE)
    return (found[1] or found[2]) if found else f"ends with {process.returncode}"


def _print(mutants: list[Mutant], outcomes: dict[str, str]) -> None:
    print("\n| shard | changes | compile | found | share |\n|---:|---:|---:|---:|---:|")
    for shard in sorted({one.shard for one in mutants}):
        own = [outcomes[one.name] for one in mutants if one.shard == shard]
        tried = [one for one in own if one not in (_REFUSED, _LEFT)]
        found = sum(one != _SURVIVES for one in tried)
        print(f"| {shard} | {len(own)} | {len(tried)} | {found} | {found / len(tried):.0%} |")
    for title in (_LEFT, _SURVIVES):
        names = [one.name for one in mutants if outcomes[one.name] == title]
        print(f"\n{title}:", *names, sep="\n")


if __name__ == "__main__":
    sys.exit(main())
