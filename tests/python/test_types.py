"""A type checker finds the types of views, scalars and choices."""

from pathlib import Path

import pytest
from house.places import PACKAGE
from mypy import api

SNIPPET = """
import kempe as kp

m = kp.Model()
start = kp.assemble(m)
sol = kp.dynamics(m, start, t_end=1, singularity="pass")
reveal_type(start.t)
reveal_type(start.body("a").x)
reveal_type(sol.body("a").x)
reveal_type(start.joint("a").torque(on="b"))
reveal_type(sol.model)
sol.joint("a").force(on="b", frame="lokal")
sol.force("a").force(on="b", frame="joint")
kp.dynamics(m, start, t_end=1, singularity="jump")
kp.assemble(m, redundancy="maybe")
kp.Dynamics(1, output="all")
kp.Baumgarte(gains="steps")
sol.to_csv("a.csv", frames=("locals",))
"""


def test_a_type_checker_knows_views_and_choices(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "snippet.py"
    path.write_text(SNIPPET, encoding="utf-8")
    monkeypatch.setenv("MYPYPATH", str(PACKAGE.parent))
    told, _, _ = api.run([str(path), "--strict", "--cache-dir", str(tmp_path / "cache")])
    lines = [line for line in told.splitlines() if line.startswith(str(path))]
    at = {int(line.split(":")[1]): line for line in lines if "Possible" not in line}
    assert 'Revealed type is "float"' in at[7].replace("builtins.", "")
    assert 'Revealed type is "float"' in at[8].replace("builtins.", "")
    assert "ndarray" in at[9]
    assert 'Revealed type is "float"' in at[10].replace("builtins.", "")
    assert "kempe.model.model.Model" in at[11]
    for line in range(12, 19):
        assert "error" in at[line], told
    assert "Literal['stop', 'pass']" in at[14]
    assert "Literal['step'] | None" in at[17]
