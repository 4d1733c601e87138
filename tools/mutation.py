"""Change the Python front in small ways and count the changes that its tests find.

    .venv/bin/python tools/mutation.py --sample 20 --seed 1 [MODULE …]

Cosmic Ray makes the mutants: another operator, another number, a condition negated, a loop without
a turn. `mutation_operators.py` swaps arguments and leaves out statements. The mutants are made in a
copy of the working tree. Each one runs the tests of its module until the first fails.
`pip install cosmic-ray` installs it.
"""

import argparse
import ast
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import mutation_operators  # noqa: F401 - registers its operators
from cosmic_ray.commands.init import init
from cosmic_ray.mutating import mutate_and_test
from cosmic_ray.work_db import WorkDB
from cosmic_ray.work_item import MutationSpec, TestOutcome

ROOT = Path(__file__).resolve().parents[1]
#: Modules of python/kempe, and the tests that concern each, the quick ones first. The tests of
#: whole pages take long; quicker ones cover the same code.
TESTS = {
    "results/views": (
        "tests/python/test_views.py",
        "tests/python/test_solution.py",
        "tests/python/test_states.py",
        "tests/python/test_table.py",
        "tests/python/test_reaction_frames.py",
        "tests/python/test_element_energies.py",
        "tests/python/test_friction_at_rest.py",
        "tests/python/test_action_points.py",
        "tests/python/test_point_mass.py",
        "tests/python/test_mistakes.py",
    ),
    "results/summary.py": (
        "tests/python/test_settling.py",
        "tests/python/test_summary.py",
        "tests/python/test_driven_or_not.py",
        "tests/python/test_measures.py",
        "tests/python/test_extremes.py",
        "tests/python/test_solution.py",
        "tests/python/test_show.py",
    ),
    "results/table.py": (
        "tests/python/test_table.py",
        "tests/python/test_display_units.py",
        "tests/python/test_xarray.py",
        "tests/python/test_variable.py",
    ),
    "results/archive.py": (
        "tests/python/test_archive.py",
        "tests/python/test_parts_of_an_archive.py",
        "tests/python/test_copies.py",
        "tests/python/test_event_files.py",
        "tests/python/test_motor.py",
    ),
    "plot": (
        "tests/plot/test_contents.py",
        "tests/plot/test_time_axis.py",
        "tests/plot/test_peaks.py",
        "tests/plot/test_dimensions.py",
        "tests/plot/test_grid.py",
        "tests/plot/test_pictures.py",
        "tests/plot/test_rules.py",
        "tests/plot/test_numbers.py",
        "tests/plot/test_functions.py",
        "tests/plot/test_drawings.py",
        "tests/plot/test_units.py",
        "tests/plot/test_design_figures.py",
        "tests/plot/test_key_figures.py",
        "tests/plot/test_marks.py",
        "tests/plot/test_names_of_events.py",
        "tests/sweeps/test_figures.py",
        "tests/refusals/test_plot.py",
        "tests/promise/test_promise.py",
        "tests/study",
    ),
    "sweeps/gradients": ("tests/gradients",),
    "sweeps/studies": ("tests/study",),
    "sweeps": ("tests/sweeps", "tests/refusals/test_sweeps.py", "tests/promise/test_promise.py"),
    "design": (
        "tests/python/test_design_kinematics.py",
        "tests/python/test_design_dynamics.py",
        "tests/python/test_design_example.py",
        "tests/python/test_pin_loads.py",
        "tests/python/test_driven_or_not.py",
        "tests/python/test_motor.py",
        "tests/cams",
        "tests/synthesis/test_balance.py",
        "tests/synthesis/test_gear_train.py",
        "tests/python/test_design_scales.py",
        "tests/refusals/test_design.py",
        "tests/promise/test_promise.py",
    ),
    "sweeps/problems": ("tests/design_problems",),
    "sweeps/fits": ("tests/fits",),
    "synthesis": ("tests/synthesis",),
}
#: A mutant is killed if its tests take this many times as long as before, and some seconds.
_PATIENCE, _GRACE = 4.0, 20.0


@dataclass
class Score:
    """The outcome for one module."""

    all: int = 0
    killed: int = 0
    survivors: list[str] = field(default_factory=list)

    @property
    def tried(self) -> int:
        """The number of mutants that were run."""
        return self.killed + len(self.survivors)


def main() -> int:
    """Run the sample and print a table in Markdown; 1 if the tests fail without a mutant."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=_Verbatim)
    parser.add_argument("modules", nargs="*", default=[], choices=[*TESTS, []])
    parser.add_argument("--sample", type=int, help="mutants for each module; all by default")
    parser.add_argument("--seed", type=int, default=1, help="of the sample")
    asked = parser.parse_args()
    scores: dict[str, Score] = {}
    with tempfile.TemporaryDirectory() as folder:
        _copy(Path(folder))
        os.chdir(folder)
        os.environ |= {"PYTHONPATH": str(Path("python").resolve()), "PYTHONDONTWRITEBYTECODE": "1"}
        for module in asked.modules or list(TESTS):
            found = _run(module, asked.sample, asked.seed)
            if found is None:
                return 1
            scores[module] = found
    _print(scores)
    return 0


class _Verbatim(argparse.RawDescriptionHelpFormatter):
    """Keeps the lines of the description."""


def _copy(folder: Path) -> None:
    """Copy the working tree, with the built extension."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "-c", "-o", "--exclude-standard"],
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    ).stdout.split("\0")
    built = [str(path.relative_to(ROOT)) for path in ROOT.glob("python/kempe/_core*.so")]
    for name in filter(None, listed + built):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


def _run(module: str, sample: int | None, seed: int) -> Score | None:
    command = _command(TESTS[module])
    begin = time.monotonic()
    before = subprocess.run(command.split(), capture_output=True, text=True, check=False)
    if before.returncode:
        print(f"{module}: the tests fail without a mutant\n{before.stdout}", file=sys.stderr)
        return None
    timeout = _PATIENCE * (time.monotonic() - begin) + _GRACE
    mutants = _mutants(Path("python/kempe") / module)
    score = Score(all=len(mutants))
    chosen = mutants if sample is None else _sample(mutants, sample, f"{module} {seed}")
    for mutant in chosen:
        result = mutate_and_test([mutant], _command(_nearest(module, mutant)), timeout)
        killed = result.test_outcome != TestOutcome.SURVIVED
        score.killed += killed
        if not killed:
            score.survivors.append(_told(mutant, result.diff or ""))
        line = _told(mutant, result.diff or "") if not killed else ""
        print(f"{module} {'killed' if killed else 'SURVIVED'} {line}", flush=True)
    return score


def _command(tests: Sequence[str]) -> str:
    return " ".join([sys.executable, "-m pytest -x -q -p no:cacheprovider", *tests])


def _nearest(module: str, mutant: MutationSpec) -> list[str]:
    """The tests of a module, those first that name the changed file."""

    def is_other(test: str) -> bool:
        files = [Path(test)] if test.endswith(".py") else Path(test).glob("*.py")
        return not any(mutant.module_path.stem in file.read_text("utf-8") for file in files)

    return sorted(TESTS[module], key=is_other)


def _mutants(path: Path) -> list[MutationSpec]:
    """All mutants of a module but those of annotations, which nothing evaluates."""
    files = [path] if path.is_file() else sorted(path.glob(_below(path)))
    database = WorkDB(":memory:", WorkDB.Mode.create)
    init(files, database, {})
    silent = {file: _annotations(file) for file in files}
    return [
        mutant
        for item in database.work_items
        for mutant in item.mutations
        if not any(a <= mutant.start_pos <= b for a, b in silent[mutant.module_path])
    ]


def _below(path: Path) -> str:
    """The files of a module: those of its subfolders too, unless these are modules of their own."""
    own = str(path.relative_to("python/kempe"))
    return "*.py" if any(name.startswith(f"{own}/") for name in TESTS) else "**/*.py"


def _annotations(path: Path) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Begin and end of annotations, imports for them and aliases of types."""
    spans = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        found = [getattr(node, "annotation", None), getattr(node, "returns", None)]
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            found.append(node)
        if isinstance(node, ast.AnnAssign) and ast.unparse(node.annotation) == "TypeAlias":
            found.append(node.value)
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "cast":
            found.append(node.args[0])
        spans += [
            ((one.lineno, one.col_offset), (one.end_lineno, one.end_col_offset))
            for one in found
            if isinstance(one, ast.AST)
        ]
    return spans


def _sample(mutants: list[MutationSpec], count: int, seed: str) -> list[MutationSpec]:
    """Mutants at different places, drawn at random."""
    places: dict[object, list[MutationSpec]] = defaultdict(list)
    for mutant in mutants:
        places[mutant.module_path, mutant.start_pos, mutant.end_pos].append(mutant)
    draw = random.Random(seed)
    chosen = draw.sample(list(places), min(count, len(places)))
    return [draw.choice(places[place]) for place in chosen]


def _told(mutant: MutationSpec, diff: str) -> str:
    """The place and the changed line."""
    changed = [line[1:].strip() for line in re.findall(r"^\+(?!\+\+).*", diff, re.MULTILINE)]
    return f"{mutant.module_path}:{mutant.start_pos[0]}: {' '.join(changed)}"


def _print(scores: dict[str, Score]) -> None:
    print("\n| module | mutants | tried | killed | share |\n|---|---:|---:|---:|---:|")
    for module, one in scores.items():
        share = f"{100 * one.killed / one.tried:.0f} %" if one.tried else "-"
        print(f"| `{module}` | {one.all} | {one.tried} | {one.killed} | {share} |")
    print("\nSurvivors:", *(line for one in scores.values() for line in one.survivors), sep="\n")


if __name__ == "__main__":
    sys.exit(main())
