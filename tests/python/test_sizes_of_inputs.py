"""Numbers that would need absurd memory or time are refused before any is taken."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import kempe as kp
import pytest
from command_line import kempe
from house.places import ROOT

FOUR_BAR = ROOT / "examples" / "four_bar.toml"
HUGE = [10**7 + 1, 10**9, 2**63, 2**64 + 1, 10**30]


@pytest.fixture(scope="module")
def case() -> kp.Case:
    return kp.load(FOUR_BAR)


@pytest.mark.parametrize("n", HUGE)
def test_numbers_of_values_are_limited(n: int, case: kp.Case) -> None:
    start = case.start()
    with pytest.raises(kp.ModelError, match=r"n: .*whole number from 2 to 1000000"):
        kp.kinematics(case.model, start, over="crank.angle", range=(0, 1), n=n)
    with pytest.raises(kp.ModelError, match=r"n: .*whole number from 2 to 2000"):
        ranges = [(0, 1), (0, 1)]
        over = ["crank.angle", "rocker.angle"]
        kp.reachable(case.model, start, of="coupler.C", over=over, ranges=ranges, n=n)


@pytest.mark.parametrize("n", HUGE)
def test_sizes_of_sweeps_are_limited(n: int, case: kp.Case) -> None:
    texts = ["C.force.max"]
    with pytest.raises(kp.ModelError, match=r"variables\.k\.n: .* from 2 to 10000000"):
        kp.sweep(case, {"k": {"from": 1e5, "to": 1e6, "n": n}}, texts)
    with pytest.raises(kp.ModelError, match="at most 10000000"):
        kp.sweep(case, {"k": {"normal": [1e6, 1e4]}}, texts, design="random", n=n)
    with pytest.raises(kp.ModelError, match=r"workers: .* from 1 to 1024"):
        kp.sweep(case, {"k": [1e6, 2e6]}, texts, workers=n)
    with pytest.raises(kp.ModelError, match="at most 10000000"):
        kp.tolerances(case, {"k": 1e4}, "C.force.max", n=n)


def test_the_size_of_a_grid_is_that_of_all_variables(case: kp.Case) -> None:
    spread: Any = {name: {"from": 1, "to": 2, "n": 1000} for name in ("k", "c", "L2")}
    with pytest.raises(kp.ModelError, match=r"1e\+09 variants; at most 10000000"):
        kp.sweep(case, spread, ["C.force.max"])


COMMANDS = [
    ("sweep", "--over", "k=1e5:1e7:1000000000", "--measure", "C.force.max"),
    ("sweep", "--over", "k=1e5:1e7:1e9", "--measure", "C.force.max"),
    ("sweep", "--over", "k=1e5:1e7:3", "--measure", "C.force.max", "--workers", "10000"),
]


@pytest.mark.parametrize("words", COMMANDS, ids=lambda words: " ".join(words[1:]))
def test_commands_refuse_them(words: tuple[str, ...], tmp_path: Path) -> None:
    ran = kempe(words[0], FOUR_BAR, *words[1:], cwd=tmp_path)
    assert ran.returncode == 2, ran.stderr
    assert ran.stderr.startswith("error: ") and "Traceback" not in ran.stderr


SCRIPT = """
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (3_000_000_000,) * 2)
import kempe as kp
m = kp.Model("gears")
m.ground.points(O=(0, 0), P=(1.0, 0))
for name in ("a", "b"):
    m.body(name, mass=1, inertia=1, points={"O": (0, 0)})
m.revolute("A", "ground.O", "a.O")
m.revolute("B", "ground.P", "b.O")
m.gear("mesh", "a.O", "b.O", teeth=(int(sys.argv[1]),) * 2, module=1.0 / int(sys.argv[1]))
kp.still(kp.assemble(m), "gears.png")
tree = kp.scene(kp.assemble(m))
"""


@pytest.mark.parametrize("teeth", [40, 10**6, 10**12])
def test_many_teeth_are_drawn_as_a_circle(teeth: int, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(teeth)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert 1_000 < (tmp_path / "gears.png").stat().st_size < 1_000_000
