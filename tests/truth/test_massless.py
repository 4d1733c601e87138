"""Mechanisms with massless bodies, against minimal coordinates and dense elimination."""

from __future__ import annotations

import json
import math
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import main
from scipy.integrate import solve_ivp
from truth.light import LIGHT, hung, slack
from truth.massless import CASES, FILE, Case, G, Vector

T_END = 3.0
#: Distance from the minimal coordinates.
EXACT = 1e-9
#: The step count of a massless mechanism, relative to that of its massive twin.
AS_FAST = 1.2

EACH = pytest.mark.parametrize("name", CASES)


def started(case: Case, mass: float) -> tuple[kp.Model, kp.State]:
    model = case.model(mass)
    exact = {key: x for key, x in case.given.items() if key not in case.guessed}
    guess = {key: x for key, x in case.given.items() if key in case.guessed}
    return model, kp.assemble(model, exact, guess)


def run(case: Case, mass: float, method: kp.Method, t_end: float = T_END) -> kp.Solution:
    model, start = started(case, mass)
    return kp.dynamics(model, start, t_end=t_end, output_step=0.1, method=method)


def minimal(case: Case, start: kp.Solution) -> Vector:
    first = [start[name][0] for name in case.coordinates]
    rates = [name.replace("angle", "omega").replace(".x", ".vx") for name in case.coordinates]
    first += [start[name][0] for name in rates]
    span = (0.0, float(start.t[-1]))
    found = solve_ivp(
        case.rates, span, first, "DOP853", t_eval=start.t, rtol=3e-14, atol=1e-14, max_step=0.02
    )
    return found.y[: len(case.coordinates)]


@EACH
def test_the_motion_is_that_of_minimal_coordinates(name: str) -> None:
    case = CASES[name]
    found = run(case, 0.0, kp.DOP853(rtol=1e-12, atol=1e-13))
    moved = np.array([found[coordinate] for coordinate in case.coordinates])
    assert np.ptp(moved) > 1
    assert np.abs(moved - minimal(case, found)).max() < EXACT


@EACH
def test_an_implicit_method_finds_the_same_motion(name: str) -> None:
    case = CASES[name]
    found = run(case, 0.0, kp.Radau(rtol=1e-11, atol=1e-12), t_end=0.5)
    moved = np.array([found[coordinate] for coordinate in case.coordinates])
    assert np.abs(moved - minimal(case, found)).max() < EXACT


@EACH
@pytest.mark.parametrize("method", [kp.Auto(), kp.DOP853(rtol=1e-9), kp.Radau(rtol=1e-7)])
def test_a_massless_body_costs_no_steps(name: str, method: kp.Method) -> None:
    case = CASES[name]
    twin = run(case, case.twin, method).statistics["steps"]
    for mass in (0.0, 1e-12, 1e-6):
        assert run(case, mass, method).statistics["steps"] <= AS_FAST * twin, mass


@EACH
def test_the_energy_is_kept_and_the_reactions_balance(name: str) -> None:
    found = run(CASES[name], 0.0, kp.DOP853(rtol=1e-11, atol=1e-12))
    assert np.abs(found.energy.balance).max() < 1e-9
    assert found.summary["newton_euler"] < 1e-9


@pytest.mark.parametrize("ratio", [10.0**-k for k in range(13)])
@pytest.mark.parametrize("name", [*CASES, *LIGHT])
def test_accelerations_are_those_of_dense_elimination(name: str, ratio: float) -> None:
    if name in CASES:
        _, state = started(CASES[name], ratio)
    else:
        state = kp.assemble(*LIGHT[name](ratio))
    m = state.matrices()
    dense = np.linalg.solve(m.kkt, np.concatenate([m.Q, m.gamma]))
    found = np.concatenate([state.a, state.lam])
    a = slice(0, len(state.a))
    assert np.abs(found - dense)[a].max() < 1e-12 * np.abs(dense[a]).max()
    assert np.abs(found - dense).max() < 1e-12 * np.abs(dense).max()


@pytest.mark.parametrize("ratio", [1e-6, 1e-12])
@pytest.mark.parametrize("name", ["hung", "slack"])
def test_a_light_freedom_costs_no_steps(name: str, ratio: float) -> None:
    counts = []
    for mass in (1e-3, ratio):
        model, given = LIGHT[name](mass)
        found = kp.dynamics(model, kp.assemble(model, given), t_end=1, method=kp.DOP853(rtol=1e-9))
        assert np.abs(found.energy.balance).max() < 1e-7
        counts.append(found.statistics["steps"])
    assert counts[1] <= AS_FAST * counts[0]


def refused(model: kp.Model, given: dict[str, float]) -> str:
    start = kp.assemble(model, given)
    with pytest.raises(kp.SingularityError) as caught:
        kp.dynamics(model, start, t_end=1)
    return str(caught.value)


@pytest.mark.parametrize("gravity", [0.0, -G])
def test_a_massless_body_with_a_freedom_of_its_own_is_refused(gravity: float) -> None:
    for named, (drawn, given) in {"rod.angle": hung(0), "link2.angle": slack(0)}.items():
        model = kp.Model.from_tree(drawn.tree() | {"gravity": [0.0, gravity]})
        message = refused(model, given)
        body = named.split(".")[0]
        assert f"no inertia resists {named}" in message
        assert "set its mass, or hold it with a joint or driver" in message
        # the remedy works
        tree = model.tree()
        tree["bodies"][body]["mass"] = 0.01
        cured = kp.Model.from_tree(tree)
        assert kp.dynamics(cured, kp.assemble(cured, given), t_end=0.2).success


def test_the_inertia_of_a_massless_body_determines_its_angle() -> None:
    model = kp.Model("wheel", gravity=(0, -G))
    model.ground.points(O=(0, 0))
    model.body("wheel", mass=0, inertia=0, points={"O": (0, 0)})
    model.revolute("O", "ground.O", "wheel.O")
    model.torque("push", "wheel", torque=3)
    message = refused(model, {"wheel.angle": 0})
    assert "no inertia resists wheel.angle" in message and "set its inertia" in message
    tree = model.tree()
    tree["bodies"]["wheel"]["inertia"] = 0.5
    cured = kp.Model.from_tree(tree)
    assert kp.assemble(cured, {"wheel.angle": 0})["wheel"].alpha == pytest.approx(6, rel=1e-14)


def test_a_free_massless_point_is_refused_and_a_mass_cures_it() -> None:
    model = kp.Model("points", gravity=(0, -G))
    model.point_mass("stone", mass=1)
    model.point_mass("ghost", mass=0)
    message = refused(model, {"stone.x": 1, "ghost.x": 2})
    assert "no inertia resists ghost.x" in message and "no joint holds it; set its mass" in message


def test_a_heavy_mechanism_beside_a_light_one_changes_nothing() -> None:
    _, alone = started(CASES["coupler"], 1e-3)
    model, given = CASES["coupler"].model(1e-3), CASES["coupler"].given
    model.bar("locomotive", mass=1e9, length=10, ends=("P", "Q"))
    model.revolute("far", "ground.D", "locomotive.P")
    exact = {key: x for key, x in given.items() if key != "rocker.angle"}
    beside = kp.assemble(model, exact | {"locomotive.angle": 0.2}, {"rocker.angle": 2.0})
    assert np.array_equal(beside.a[:9], alone.a)


def test_other_analyses_take_massless_bodies() -> None:
    model, start = started(CASES["coupler"], 0.0)
    assert kp.mobility(model, start).degrees_of_freedom == 1
    modes = kp.modes(model, kp.equilibrium(model, start).state)
    twin, begun = started(CASES["coupler"], 1e-9)
    near = kp.modes(twin, kp.equilibrium(twin, begun).state)
    assert modes.omega == pytest.approx(near.omega, rel=1e-6)
    model.coordinate_driver("motor", "crank.angle", value="0.9 + 3*t")
    driven = kp.assemble(model, {}, {"rocker.angle": 2.0})
    over = kp.kinematics(model, driven, t_end=1, output_step=0.1)
    torque = kp.inverse_dynamics(model, driven, t_end=1, output_step=0.1)["motor.effort"]
    run = kp.dynamics(model, driven, t_end=1, output_step=0.1, method=kp.DOP853(rtol=1e-12))
    assert over["rocker.angle"] == pytest.approx(run["rocker.angle"], abs=1e-9)
    assert torque == pytest.approx(run["motor.effort"], rel=1e-7)


def free_mechanisms() -> dict[str, tuple[kp.Model, dict[str, float]]]:
    """Mechanisms with their starts, by the massless body that they do not determine."""
    ghost = kp.Model("points", gravity=(0, -G))
    ghost.point_mass("stone", mass=1)
    ghost.point_mass("ghost", mass=0)
    return {"ghost": (ghost, {"stone.x": 1, "ghost.x": 2}), "rod": hung(0), "link2": slack(0)}


@pytest.mark.parametrize("body", ["ghost", "rod", "link2"])
def test_check_refuses_what_the_run_refuses(
    body: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, given = free_mechanisms()[body]
    message = refused(model, given)
    assert kp.mobility(model, kp.assemble(model, given)).undetermined[body] in message
    tree = model.tree() | {"kempe": 1, "start": {"set": given}}
    path = tmp_path / "free.json"
    for analyses, code in [({"run": {"type": "dynamics", "t_end": 0.2}}, 3), ({}, 0)]:
        path.write_text(json.dumps(tree | {"analyses": analyses}), "utf-8")
        assert main(["check", str(path)]) == code
        said = " ".join("".join(capsys.readouterr()).split())
        assert f"no inertia resists {body}." in said
    # the remedy works
    tree["bodies"][body]["mass"] = 0.01
    analyses = {"run": {"type": "dynamics", "t_end": 0.2}}
    path.write_text(json.dumps(tree | {"analyses": analyses}), "utf-8")
    assert main(["check", str(path)]) == 0
    assert "no inertia resists" not in capsys.readouterr().out
    assert kp.load(path).run()["run"].success


@pytest.mark.parametrize("body", ["ghost", "rod", "link2"])
def test_modes_and_accelerations_refuse_what_the_run_refuses(body: str) -> None:
    model, given = free_mechanisms()[body]
    start = kp.assemble(model, given)
    for refuses in (lambda: kp.modes(model, start), lambda: start.a):
        with pytest.raises(kp.SingularityError, match=f"no inertia resists {body}.") as caught:
            refuses()
        assert caught.value.name == body
    tree = model.tree()
    tree["bodies"][body]["mass"] = 1e-3
    heavy = kp.Model.from_tree(tree)
    assert np.isfinite(kp.assemble(heavy, given).a).all()


def test_a_file_with_massless_bodies(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "massless.toml"
    path.write_text(FILE, "utf-8")
    assert main(["check", str(path)]) == 0
    assert "error" not in capsys.readouterr().out.lower()
    found = kp.load(path).run()["run"]
    # the crank swings as a pendulum: J = 1/3, torque m g l / 2
    first = [found["crank.angle"][0], 0.0]
    pendulum = solve_ivp(
        lambda _, y: [y[1], -1.5 * G * math.cos(y[0])],
        (0, 1),
        first,
        "DOP853",
        t_eval=found.t,
        rtol=1e-12,
        atol=1e-12,
    )
    assert found["crank.angle"] == pytest.approx(pendulum.y[0], abs=1e-6)
