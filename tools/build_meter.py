"""Measure how large the core is for the compiler, and how long builds and tests take.

    python tools/build_meter.py lines              LLVM lines of the core, by module and scalar
    python tools/build_meter.py code [FILE]        machine code of the extension, by module
    python tools/build_meter.py check [--lines]    compare both with the agreed numbers
    python tools/build_meter.py times              cold build, one changed line, import
    python tools/build_meter.py tests [LOG]        stages of the last ./test, slowest tests of a log

docs/internals/build-times.md describes the measurements and contains the agreed numbers.
"""

from __future__ import annotations

import argparse
import os
import platform
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

sys.path.insert(0, str(ROOT))
from tools.meter import llvm_lines, machine_code  # noqa: E402

#: The one place of the agreed numbers, in a table with these rows.
PAGE = "docs/internals/build-times.md"
CODE, LINES = "bytes of code of the extension", "LLVM lines of the core"
#: The profile of the agreed code, the one that ./kempe uses by default.
PROFILE = "checkout"
#: Growth above the agreed number that is accepted.
TOLERANCE = 0.05
_REMEDY = {
    CODE: "Find the cause with `python tools/build_meter.py code`",
    LINES: "Find the cause with `python tools/build_meter.py lines`",
}
#: Fails also where ./kempe builds for processors without AVX2.
_HAS_EXTENSION = """
ROOT=$1; . "$ROOT/tools/setup.sh"; before=${RUSTFLAGS:-}
choose_instructions; [ "$before" = "${RUSTFLAGS:-}" ] && has_extension
"""
_SLOWEST = 40
_LARGEST = 60
_DURATION = re.compile(r"^(\d+\.\d+)s (?:setup|call|teardown) +(.+?)\s*$", re.MULTILINE)


def grouped(number: int) -> str:
    """The number with spaces between thousands."""
    return f"{number:,}".replace(",", " ")


def table(heads: tuple[str, str], rows: list[tuple[str, str]]) -> str:
    """A table in Markdown, with numbers on the right."""
    lines = [f"| {heads[0]} | {heads[1]} |", "|---|---:|"]
    return "\n".join(lines + [f"| {name} | {number} |" for name, number in rows])


def counted(heads: tuple[str, str], counts: Counter[str]) -> str:
    """A table of the largest counts, and the sum of the others."""
    rows = counts.most_common(_LARGEST)
    others = counts.total() - sum(number for _, number in rows)
    if others:
        rows.append((f"{len(counts) - _LARGEST} others", others))
    return table(heads, [(name, grouped(number)) for name, number in rows])


def agreed(text: str, name: str) -> int:
    """The agreed number in the row of a table with this name."""
    found = re.search(rf"^\| {re.escape(name)} \| ([\d ]+) \|", text, re.MULTILINE)
    if not found:
        raise ValueError(f'{PAGE} has no row "| {name} | number |"')
    return int(found[1].replace(" ", ""))


def fault(name: str, number: int, limit: int) -> str | None:
    """A sentence if the number exceeds the agreed one by more than the tolerance."""
    if number <= limit * (1 + TOLERANCE):
        return None
    percent = 100 * (number / limit - 1)
    return (
        f"{name}: {grouped(number)}, {percent:.1f} % more than the agreed {grouped(limit)}. "
        f"{_REMEDY[name]}, or change the number in {PAGE}, with the reason in the commit."
    )


def why_incomparable(variables: dict[str, str], machine: str, system: str) -> str | None:
    """The reason why the agreed numbers are not valid for builds here."""
    flags = variables.get("RUSTFLAGS", "")
    if (machine, system) != ("x86_64", "Linux"):
        return f"the numbers are for x86_64 and Linux, this is {machine} and {system}"
    if flags and "target-cpu=x86-64-v3" not in flags:
        return f"the numbers are for target-cpu=x86-64-v3, RUSTFLAGS is {flags!r}"
    changed = [name for name in variables if name.startswith("CARGO_PROFILE_")]
    return f"{changed[0]} changes the profile" if changed else None


def why_other_build(root: Path, extension: Path) -> str | None:
    """The reason why the extension is not the one that ./kempe builds from the present sources.

    ./kempe writes a stamp, with a checksum of sources and profile, after the extension.
    """
    command = ["sh", "-c", _HAS_EXTENSION, "sh", str(root)]
    environment = os.environ | {"KEMPE_PROFILE": PROFILE}
    if subprocess.run(command, env=environment, capture_output=True, check=False).returncode:
        return f"./kempe did not build it from these sources, in the profile {PROFILE}, for AVX2"
    if extension.stat().st_mtime > (root / ".venv" / "stamp-build").stat().st_mtime:
        return "it was built after the last set-up by ./kempe, perhaps in another profile"
    return None


def check(with_lines: bool) -> int:
    """Compare with the agreed numbers; 1 if one of them is exceeded."""
    reason = why_incomparable(dict(os.environ), platform.machine(), platform.system())
    if reason:
        print(f"skipped: {reason}")
        return 0
    text = (ROOT / PAGE).read_text(encoding="utf-8")
    numbers = {}
    extension = machine_code.extension(ROOT)
    other = why_other_build(ROOT, extension)
    if other:
        print(f"{CODE}: skipped, because {other}")
    else:
        numbers[CODE] = machine_code.code_bytes(extension)
    if with_lines:
        numbers[LINES] = llvm_lines.of_core(ROOT).lines
    faults = [fault(name, number, agreed(text, name)) for name, number in numbers.items()]
    for (name, number), sentence in zip(numbers.items(), faults, strict=True):
        print(sentence or f"{name}: {grouped(number)}, agreed {grouped(agreed(text, name))}")
    return 1 if any(faults) else 0


def lines() -> int:
    """Print the LLVM lines of the core."""
    found = llvm_lines.of_core(ROOT)
    print(f"{grouped(found.lines)} lines in {grouped(found.functions)} functions\n")
    print(counted(("module", "lines"), found.by_module), end="\n\n")
    print(counted(("scalar", "lines"), found.by_scalar))
    return 0


def code(path: Path | None) -> int:
    """Print the machine code of an extension."""
    path = path or machine_code.extension(ROOT)
    print(f"{grouped(machine_code.code_bytes(path))} bytes of code in {path.name}")
    modules = machine_code.by_module(path)
    print("\n" + counted(("module", "bytes"), modules) if modules else "nm is missing: no modules")
    return 0


def times() -> int:
    """Print the times of builds and of an import."""
    from tools.meter import timing  # not on Windows

    built = timing.builds(ROOT, PROFILE)
    worst = max(timing.CHANGED, key=lambda name: built[name].wall)
    named = {"cold build": built["cold"]}
    named |= {f"one changed line in `{name}`": built[name] for name in timing.CHANGED}
    named |= {f"the longest of them, `{Path(worst).name}`": built[worst]}
    rows = [(name, f"{one.wall:.0f} s, CPU {one.cpu:.0f} s") for name, one in named.items()]
    # the second statement loads the core and NumPy
    for statement in ("import kempe", "from kempe import load"):
        seconds, size = timing.imports(ROOT, statement)
        rows.append((f"`{statement}`", f"{seconds:.3f} s, {size:.0f} MiB"))
    print(table(("measured", f"profile {PROFILE}, {os.cpu_count()} processors"), rows))
    return 0


def stages(text: str) -> list[tuple[str, int]]:
    """Name and seconds of each stage, from lines "seconds name"."""
    pairs = (line.split(" ", 1) for line in text.splitlines() if line)
    return [(name, int(seconds)) for seconds, name in pairs]


def slowest(log: str) -> list[tuple[str, float]]:
    """The slowest tests in the output of `pytest --durations`, with their set-up."""
    seconds: Counter[str] = Counter()
    for number, name in _DURATION.findall(log):
        seconds[name] += float(number)
    return seconds.most_common(_SLOWEST)


def tests(log: Path | None) -> int:
    """Print the stages of the last ./test, and the slowest tests of a log."""
    path = ROOT / ".venv" / "stages"
    if not path.exists():
        print("there are no times of ./test: run it first", file=sys.stderr)
        return 1
    found = stages(path.read_text(encoding="utf-8"))
    rows = [*found, ("**total**", sum(seconds for _, seconds in found))]
    print(table(("stage", "seconds"), [(name, str(seconds)) for name, seconds in rows]))
    if log:
        slow = slowest(log.read_text(encoding="utf-8"))
        print("\n" + table(("test", "seconds"), [(f"`{name}`", f"{s:.1f}") for name, s in slow]))
    return 0


def main(arguments: list[str]) -> int:
    """Run one command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("lines")
    commands.add_parser("code").add_argument("file", type=Path, nargs="?")
    commands.add_parser("check").add_argument("--lines", action="store_true")
    commands.add_parser("times")
    commands.add_parser("tests").add_argument("log", type=Path, nargs="?")
    chosen = parser.parse_args(arguments)
    run = {
        "lines": lines,
        "code": lambda: code(chosen.file),
        "check": lambda: check(chosen.lines),
        "times": times,
        "tests": lambda: tests(chosen.log),
    }
    try:
        return run[chosen.command]()
    except (FileNotFoundError, ValueError, subprocess.CalledProcessError) as error:
        print(error, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
