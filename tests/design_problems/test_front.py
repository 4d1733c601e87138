"""Pareto fronts against closed forms."""

from pathlib import Path

import kempe as kp
import matplotlib.pyplot as plt
import numpy as np
import pytest
from design_problems.conftest import SECTION, written
from design_problems.test_loads import SCALES, crane
from kempe.sweeps.problems import front
from sizes import count, some

#: Generations after which these simple fronts are covered; all of them in full size.
GENERATIONS = count(25, front._GENERATIONS)


def hanging(size: float, mass: float) -> kp.Case:
    """The crane at rest."""
    return kp.Case(crane(size, mass).model, None, [kp.Equilibrium(name="rest")])


@pytest.mark.parametrize(("size", "mass"), some(SCALES[::-1], 1))
def test_a_front_in_closed_form(size: float, mass: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Stiffness k costs, and the block sinks by m g / k: their product is constant.

    The limit cuts the front, and ``lift`` shifts nothing at rest, so that all points have the same
    product.
    """
    monkeypatch.setattr(front, "_GENERATIONS", GENERATIONS)
    case, k = hanging(size, mass), 100.0 * mass / size
    best = kp.optimize(
        case, {"k": (k / 10, k * 10, "log")}, minimize=["k", "-block.y"], analysis="rest",
        subject_to=f"block.y >= {-0.5 * size!r}", seed=3,
    )  # fmt: skip
    found = best.front
    assert len(found) == len(best.candidates) > 30
    weight = 10 * mass
    assert np.array(found["k"] * found["-block.y"]) == pytest.approx(weight, rel=1e-9)
    assert found["-block.y"].max() == pytest.approx(0.5 * size, rel=2e-2)
    assert found["-block.y"].max() <= 0.5 * size * (1 + 1e-6)
    assert found["k"].max() == pytest.approx(10 * k, rel=2e-2)
    gaps = np.diff(np.log(found["k"]))
    assert gaps.min() > 0 and gaps.max() < 0.5
    one = best.candidates[len(found) // 2]
    assert one.case.run()["rest"].state["block.y"] == pytest.approx(-one.objectives["-block.y"])
    plt.close(kp.plot.optimization(best))


def test_a_front_in_two_dimensions(monkeypatch: pytest.MonkeyPatch) -> None:
    """(1 + x) + y² and (1 - x) + y²: the front is y = 0, where both add to 2."""
    monkeypatch.setattr(front, "_GENERATIONS", GENERATIONS)
    m = kp.Model("slide", parameters={"x": 0.3, "y": 0.5})
    m.ground.points(O=(0, 0))
    m.body("slide", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.generalized_force("spring", "guide.displacement", value="x - guide.displacement")
    case = kp.Case(m, None, [kp.Equilibrium(name="rest")])
    best = kp.optimize(
        case, {"x": (-1, 1), "y": (-1, 1)}, maximize=["slide.x - y^2", "-slide.x - y^2"], seed=1
    )
    sums = best.front["slide.x - y^2"] + best.front["-slide.x - y^2"]
    assert len(best.front) > 30 and np.abs(sums).max() < 1e-6
    assert best.front["x"].min() < -0.98 and best.front["x"].max() > 0.98
    # the choices at random, without the search by slopes from each point
    monkeypatch.setattr(front, "_GENERATIONS", 2)
    monkeypatch.setattr(front, "_polished", lambda _, found: list(found))
    first, again = (
        kp.optimize(
            case, {"x": (-1, 1), "y": (-1, 1)}, maximize=["slide.x - y^2", "-slide.x - y^2"], seed=1
        )
        for _ in range(2)
    )
    assert (again.front == first.front).all().all()


def test_a_front_of_a_file(
    folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from kempe.cli.app import run

    monkeypatch.setattr(front, "_GENERATIONS", 5)  # a front of this form is tested above

    section = SECTION.replace('"over.effort.rms"', '["over.effort.rms", "k"]')
    written(folder, section)
    assert run(["check", "lamp.toml"]) == 0
    assert run(["optimize", "lamp.toml"]) == 0
    told = capsys.readouterr().out
    assert "Front of over.effort.rms, k" in told and "points" in told
    lines = (folder / "out/lamp/optimize/front.csv").read_text().splitlines()
    assert lines[0] == "k,h,over.effort.rms,k" and len(lines) > 20


def test_limits_that_no_run_meets_and_wrong_requests() -> None:
    case = hanging(1, 1)
    with pytest.raises(kp.ModelError, match=r"none of .* satisfies all limits.*relax the limits"):
        kp.optimize(
            case, {"k": (90, 110)}, minimize=["k", "-block.y"], analysis="rest",
            subject_to="block.y >= 0",
        )  # fmt: skip
    for given, message in (
        ({"minimize": ["k", "k"]}, "given twice"),
        ({"minimize": []}, "there are none"),
        ({"minimize": ["k", "-k"], "method": "slsqp"}, "slsqp has one objective"),
    ):
        with pytest.raises(kp.ModelError, match=message):
            kp.optimize(case, {"k": (90, 110)}, **given)
