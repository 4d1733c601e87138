"""Measures kempe and its peers, draws the figures and writes docs/benchmarks.md.

    python benchmarks/run.py [--quick] [--problems a,b] [--tools a,b] [--repeat 5] [--no-floor]
                             [--json FILE] [--docs FOLDER] [--keep] [--page]

`--quick` measures kempe and SciPy on the flagship at coarse settings, without the floor. `--page`
measures nothing and writes the page and the figures from the JSON file. `--keep` keeps the results
in the file for problems that are not measured, and those of the floor if it is not measured.
"""

from __future__ import annotations

import os

# one thread for all libraries; must be set before they are imported
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import argparse
import datetime
import json
import platform
from pathlib import Path
from typing import Any

import figures
import floor_program
import turns
from page import page
from peers import tools
from problems import ACCEPTED, COST, NAMES, problem
from record import Record
from shows import targets

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "benchmarks" / "results.json"


def processor() -> str:
    """The model of the processor."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text("utf-8").splitlines() if info.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def measure(asked: argparse.Namespace) -> dict[str, Any]:
    """Measure everything; the results are stored after every problem."""
    chosen = tools(["kempe", "scipy"] if asked.quick and not asked.tools else asked.tools)
    missing = {tool.NAME: why for tool in chosen if (why := tool.missing())}
    present = [tool for tool in chosen if tool.NAME not in missing]
    for tool, why in missing.items():
        print(f"missing: {tool}: {why}")
    with_floor = not (asked.quick or asked.no_floor)
    found: dict[str, Any] = {
        "date": datetime.date.today().isoformat(),
        "machine": {
            "processor": processor(),
            "cores": os.cpu_count(),
            "system": f"{platform.system()} {platform.machine()}",
            "python": platform.python_version(),
        },
        "versions": {tool.NAME: tool.version() for tool in present},
        "missing": missing,
        "tried": {tool.NAME: tool.TRIED for tool in present},
        "repeat": asked.repeat,
        "floor": floor_program.measure(asked.repeat) if with_floor else None,
        "records": [],
    }
    if asked.keep:
        keep(found, json.loads(asked.json.read_text("utf-8")), asked.problems or [])
    for name in asked.problems or (["flagship"] if asked.quick else [*NAMES, *COST]):
        print(f"{name} …", flush=True)
        records = turns.measure(problem(name), present, asked.repeat, asked.quick)
        found["records"] += [record.json() for record in records]
        asked.json.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", "utf-8")
    return found


def keep(found: dict[str, Any], before: dict[str, Any], again: list[str]) -> None:
    """Add previous results that are not measured again."""
    found["floor"] = found["floor"] or before["floor"]
    found["repeat"] = max(found["repeat"], before["repeat"])
    found["records"] = [r for r in before["records"] if r["problem"] not in again]
    for table in ("versions", "tried", "missing"):
        found[table] = {**before[table], **found[table]}


def write(found: dict[str, Any], docs: Path) -> None:
    """Write page and figures."""
    records = [Record(**record) for record in found["records"]]
    images = docs / "images" / "benchmarks"
    for name in dict.fromkeys(r.problem for r in records):
        if name not in COST:
            of = problem(name)
            mine = [r for r in records if r.problem == name]
            figures.work_precision(mine, of.title, of.error_of, images / f"{name}.png")
    if against := [r for r in records if r.problem in COST]:
        figures.cost(against, images / "cost.png", ACCEPTED)
    (docs / "benchmarks.md").write_text(page(found, records), "utf-8")
    for target in targets(found, records):
        print(f"{target.verdict:<12} {target.what}: {target.measured} (target: {target.asked})")


def words(text: str) -> list[str]:
    """A list with commas."""
    return text.split(",")


def main() -> None:
    """Measure, write and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="kempe and SciPy, coarse, flagship")
    parser.add_argument("--problems", type=words, help=f"of {', '.join((*NAMES, *COST))}")
    parser.add_argument("--tools", type=words, help="by name; all when absent")
    parser.add_argument("--repeat", type=int, default=5, help="number of runs; the median counts")
    parser.add_argument("--no-floor", action="store_true", help="skip the floor program")
    parser.add_argument("--json", type=Path, default=RESULTS, help="file for the results")
    parser.add_argument("--docs", type=Path, default=ROOT / "docs", help="folder for the page")
    parser.add_argument(
        "--keep", action="store_true", help="keep the results of other problems in the file"
    )
    parser.add_argument(
        "--page", action="store_true", help="write page and figures from stored results"
    )
    asked = parser.parse_args()
    if not asked.page:
        measure(asked)
    write(json.loads(asked.json.read_text("utf-8")), asked.docs)


if __name__ == "__main__":
    main()
