"""The numbers of the paper: `PYTHONPATH=benchmarks .venv/bin/python -m paper.printed`.

Each name stands for a number in `paper/text.md`. Numbers of speed come from
`benchmarks/results.json`, which `benchmarks/run.py` writes on a quiet machine, and numbers of
validation from `benchmarks/validation/results.json`. The others are computed here.
"""

import json
import math
from pathlib import Path
from typing import Any

import kempe as kp
import shows
from kempe import _core
from record import Record

ROOT = Path(__file__).parents[1]
SPEED = ROOT / "benchmarks" / "results.json"
VALIDATION = ROOT / "benchmarks" / "validation" / "results.json"
#: Targets of docs/benchmarks.md in the table of the paper, with the words that it uses.
ROWS = {
    "flagship, the default, no option named, angles within 1e-6 rad, gap within 1e-10 m, over the "
    "floor's run": "four-bar, default method: time over that of a program by hand",
    "that run (the default, no option named) against scipy": "four-bar: NumPy and SciPy",
    "that run (the default, no option named) against mujoco, states alone": "four-bar: MuJoCo",
    "that run (the default, no option named) against exudyn, states alone": "four-bar: Exudyn",
    "that run (the default, no option named) against casadi, states alone": "four-bar: CasADi",
    "N = 1 against exudyn": "chain of one window: Exudyn",
    "N = 1 against mujoco": "chain of one window: MuJoCo",
    "evaluation and window, N = 1000": "chain of 1000 windows: time of a window",
    "squeezer to 0.03 s, angles within 1e-10": "Andrews' squeezer to 1e-10 rad",
}


def catalogue() -> dict[str, str]:
    """How many elements, analyses and methods there are."""
    told = json.loads(_core.catalogue())
    sections = ("joints", "forces", "analyses", "methods")
    found = {name: str(len(told[name])) for name in sections}
    return found | {"examples": str(len(list((ROOT / "examples").rglob("*.toml"))))}


def run() -> dict[str, str]:
    """The four-bar linkage of the paper, with the default method, and the pendulum by hand."""
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    sol = kp.dynamics(case.model, case.start(), t_end=15, output_step=0.01)
    found = {
        "end": "15 s",
        "force": f"{sol['C.force'].max():.0f} N",
        "outputs": f"{len(sol.t)}",
        "open": power(sol.drift.position.max()),
        "balance": power(sol.newton_euler.largest),
        "energy": power(abs(sol.energy.balance).max()),
    }
    return found | {"period": f"{period():.4f} s", "period_by_hand": f"{by_hand():.4f} s"}


def pendulum() -> kp.Model:
    """A uniform rod of 1 m on a pin."""
    m = kp.Model("rod", gravity=(0, -9.81))
    m.ground.points(A=(0, 0))
    m.bar("rod", mass=2, length=1, ends=("A", "B"))
    m.revolute("A", "ground.A", "rod.A")
    return m


def period() -> float:
    """The period of small swings of a rod of 1 m."""
    m = pendulum()
    hanging = kp.assemble(m, set={"rod.angle": "-90 deg"})
    return float(2 * math.pi / kp.modes(m, hanging).omega[0])


def by_hand() -> float:
    """The period of such a rod, 2 π √(2 L / 3 g)."""
    return 2 * math.pi * math.sqrt(2 / 3 / 9.81)


def validation() -> dict[str, str]:
    """How many published numbers are compared, and how well some of them agree."""
    told = json.loads(VALIDATION.read_text("utf-8"))
    rows = {one["title"]: one["comparisons"] for one in told["benchmarks"]}
    linkage = {one["quantity"]: one for one in rows[next(t for t in rows if "Four-bar" in t)]}
    angles = linkage["0.05 to 15 s: q"]
    forces = linkage["0.05 to 15 s: λ"]
    drift = next(one for one in told["conservation"] if one["method"] == "DOP853")
    return {
        "published": str(sum(one["count"] for part in rows.values() for one in part)),
        "sources": str(len(rows)),
        "worst_q": power(abs(angles["kempe"] - angles["published"])),
        "worst_force": power(abs(forces["kempe"] / forces["published"] - 1)),
        "million": power(drift["steps"], exact=True),
        "million_drift": power(drift["drift"]),
        "orders": str(len({one["method"] for one in told["convergence"]})),
    }


def speed() -> dict[str, str]:
    """The table of speeds, the date, the machine and the versions of the other programs."""
    found = json.loads(SPEED.read_text("utf-8"))
    records = [Record(**one) for one in found["records"]]
    judged = {one.what: one for one in shows.targets(found, records)}
    lines = ["| what | measured | goal |  |", "|---|---|---|---|"]
    for what, words in ROWS.items():
        one = judged[what]
        measured = one.measured.partition(" (")[0]
        lines.append(f"| {words} | {measured} | {one.asked} | {one.verdict} |")
    machine, versions = found["machine"], found["versions"]
    names = ", ".join(f"{name} {number}" for name, number in versions.items())
    over = len([one for one in lines if one.endswith("not met |")])
    return {
        "not_met": ("none", "one", "two", "three")[over],
        "table_of_speeds": "\n".join(lines),
        "measured_on": f"{found['date']} ({machine['processor']}, {machine['system']}; {names})",
    }


def power(value: float, *, exact: bool = False) -> str:
    """A number as a power of ten in TeX: a bound, rounded up, or the number itself.

    Rounding errors differ between processors; a smaller bound than 1e-12 is not stated.
    """
    exponent = math.log10(value if exact else max(value, 1e-12))
    return f"$10^{{{round(exponent) if exact else math.ceil(exponent)}}}$"


def numbers() -> dict[str, Any]:
    """All numbers by name."""
    return catalogue() | run() | validation() | speed() | {"version": kp.__version__}


if __name__ == "__main__":
    for name, value in numbers().items():
        print(f"{name}: {value}")
