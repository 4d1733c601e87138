"""Wrong arguments of public functions raise errors of kempe, whose messages can be printed."""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import matplotlib
import numpy as np
import pytest
from house.places import ROOT
from kempe import report

matplotlib.use("Agg")
FOUR_BAR = ROOT / "examples" / "four_bar.toml"
CASE = kp.load(FOUR_BAR).with_analysis("release", t_end=0.02)
MODEL, START, RESULTS = CASE.model, CASE.start(), CASE.run()
SOL = RESULTS[0]
BAD: list[Any] = [
    *(None, 3, -1, 1.5, float("nan"), float("inf"), 10**400, 1j, True),
    *("", "x", "a\0b", "\udc80", b"x", [], ["a"], {}, {"a": 1}, {1: 2}, (1, 2, 3)),
    *(object(), lambda t: t, np.zeros(3), np.array("x")),
]


def fresh() -> kp.Model:
    return kp.Model("t", parameters={"L": 1})


CALLS: dict[str, Callable[[Any], object]] = {
    "Model.title": kp.Model,
    "Model.gravity": lambda b: kp.Model(gravity=b),
    "Model.parameters": lambda b: kp.Model(parameters=b),
    "Model.redundancy": lambda b: kp.Model(redundancy=b),
    "ground.points": lambda b: fresh().ground.points(A=b),
    "bar.name": lambda b: fresh().bar(b, mass=1, length=1),
    "bar.mass": lambda b: fresh().bar("a", mass=b, length=1),
    "bar.ends": lambda b: fresh().bar("a", mass=1, length=1, ends=b),
    "body.points": lambda b: fresh().body("a", mass=1, inertia=1, points=b),
    "revolute": lambda b: fresh().revolute("a", b, "x.y"),
    "revolute.axes": lambda b: fresh().revolute("a", "x.y", "x.y", axes=b),
    "spring": lambda b: fresh().torsion_spring("a", "ground", "x", stiffness=b),
    "with_parameters": MODEL.with_parameters,
    "with_parameters2": lambda b: MODEL.with_parameters({"k": b}).compile(),
    "from_tree": lambda b: kp.Model.from_tree(b).compile(),
    "assemble.model": kp.assemble,
    "assemble.set": lambda b: kp.assemble(MODEL, set=b),
    "assemble.set2": lambda b: kp.assemble(MODEL, set={"crank.angle": b}),
    "assemble.guess": lambda b: kp.assemble(MODEL, guess=b),
    "assemble.t": lambda b: kp.assemble(MODEL, t=b),
    "assemble.red": lambda b: kp.assemble(MODEL, redundancy=b),
    "dynamics.model": lambda b: kp.dynamics(b, START, t_end=0.01),
    "dynamics.start": lambda b: kp.dynamics(MODEL, b, t_end=0.01),
    "dynamics.t_end": lambda b: kp.dynamics(MODEL, START, t_end=b, max_steps=3),
    "dynamics.output_step": lambda b: kp.dynamics(MODEL, START, t_end=0.01, output_step=b),
    "dynamics.method": lambda b: kp.dynamics(MODEL, START, t_end=0.01, method=b),
    "dynamics.stab": lambda b: kp.dynamics(MODEL, START, t_end=0.01, stabilization=b),
    "dynamics.max_steps": lambda b: kp.dynamics(MODEL, START, t_end=0.01, max_steps=b),
    "dynamics.dense": lambda b: kp.dynamics(MODEL, START, t_end=0.01, dense_output=b),
    "dynamics.red": lambda b: kp.dynamics(MODEL, START, t_end=0.01, redundancy=b),
    "dynamics.sing": lambda b: kp.dynamics(MODEL, START, t_end=0.01, singularity=b),
    "dynamics.progress": lambda b: kp.dynamics(MODEL, START, t_end=0.01, progress=b),
    "RK45": lambda b: kp.dynamics(MODEL, START, t_end=0.01, method=kp.RK45(rtol=b)),
    "Baumgarte": lambda b: kp.dynamics(MODEL, START, t_end=0.01, stabilization=kp.Baumgarte(b)),
    "State.model": lambda b: kp.State(b, 0, START.q, START.v),
    "State.t": lambda b: kp.State(MODEL, b, START.q, START.v),
    "State.q": lambda b: kp.State(MODEL, 0, b, START.v),
    "State.v": lambda b: kp.State(MODEL, 0, START.q, b),
    "State.z": lambda b: kp.State(MODEL, 0, START.q, START.v, z=b),
    "getitem": lambda b: SOL[b],
    "sol()": SOL,
    "body": SOL.body,
    "joint": SOL.joint,
    "force": SOL.force,
    "driver": SOL.driver,
    "constraint": SOL.constraint,
    "point": lambda b: SOL.body("crank").point(b),
    "at": lambda b: SOL.body("crank").at(b).position,
    "on": lambda b: SOL["C"].force(on=b),
    "frame": lambda b: SOL["C"].force(on="rocker", frame=b),
    "part": lambda b: SOL["spring"].torque(on="rocker", part=b),
    "state": SOL["spring"].state,
    "contains": lambda b: b in SOL,
    "matrices": START.matrices,
    "show.model": lambda b: kp.show(b, START),
    "show.state": lambda b: kp.show(MODEL, b),
    "show.what": lambda b: kp.show(MODEL, START, b),
    "equations": kp.equations,
    "Case.model": kp.Case,
    "Case.start": lambda b: kp.Case(MODEL, b),
    "Case.analyses": lambda b: kp.Case(MODEL, None, b),
    "Case.an": lambda b: kp.Case(MODEL, None, [b]),
    "Case.an2": lambda b: kp.Case(MODEL, None, {"a": b}),
    "Start": lambda b: kp.Case(MODEL, kp.Start(b)).start(),
    "with_analysis": CASE.with_analysis,
    "with_analysis2": lambda b: CASE.with_analysis("release", t_end=b),
    "with_analysis3": lambda b: CASE.with_analysis("release", method=b),
    "case.save": CASE.save,
    "load": kp.load,
    "load.par": lambda b: kp.load(FOUR_BAR, parameters=b),
    "load_solution": kp.load_solution,
    "sol.save": SOL.save,
    "to_csv": SOL.to_csv,
    "to_csv.frames": lambda b: SOL.to_csv("a.csv", frames=b),
    "to_csv.points": lambda b: SOL.to_csv("a.csv", points=b),
    "results": lambda b: RESULTS[b if not isinstance(b, int) else 0],
    "units": kp.units,
    "scene": kp.scene,
    "scene.frames": lambda b: kp.scene(SOL, frames=min(b, 2) if isinstance(b, int) else b),
    "scene.traces": lambda b: kp.scene(START, traces=b),
    "player": lambda b: kp.player(b, "a.html"),
    "player.path": lambda b: kp.player(START, b),
    "animate": lambda b: kp.animate(START, b),
    "summary": report.summary,
    "plot.positions": lambda b: kp.plot.positions(SOL, b),
    "plot.positions2": lambda b: kp.plot.positions(b, "crank"),
    "plot.reactions": lambda b: kp.plot.reactions(SOL, b),
    "plot.torques": lambda b: kp.plot.torques(SOL, b),
    "plot.save": lambda b: kp.plot.save([], b),
    "plot.save2": lambda b: kp.plot.save(b, "x"),
    "plot.select": lambda b: kp.plot.select(kp.plot.pages(SOL), b),
    "plot.energy": kp.plot.energy,
    "plot.pages": kp.plot.pages,
    "plot.mechanism": kp.plot.mechanism,
    "study": kp.study,
    "study2": lambda b: kp.study(CASE, b),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_wrong_argument_raises_an_error_of_kempe(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from matplotlib import pyplot

    monkeypatch.chdir(tmp_path)
    refused = 0
    for value in BAD:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                CALLS[name](value)
        except kp.KempeError as error:
            assert not isinstance(error, kp.InternalError), error
            assert str(error).encode()
            refused += 1
    pyplot.close("all")
    kp.units("SI")
    assert refused > 0 or name in {"Case.start", "contains"}
