"""Loads that contacts and friction at rest share in several ways have a star everywhere."""

import io
import json

import kempe as kp
import numpy as np
import pytest
from kempe.cli.findings import show_findings
from kempe.lab_report.write import page
from rich.console import Console

G = 9.81
SCALES = [(1.0, 1.0), (1e3, 1e-3), (1e-3, 1e3)]
TOLD = "one way to share the load"


def beam(feet: list[float], pinned: bool, scale: tuple[float, float]) -> kp.Solution:
    """A beam with its centre at 0 on rigid feet without friction, and a pin at its end."""
    mass, size = scale
    m = kp.Model("beam", gravity=(0, -G))
    m.ground.points(O=(-2 * size, 0))
    m.ground.curves(floor={"line": [(9 * size, 0), (-9 * size, 0)]})
    points = {f"P{k}": (x * size, 0.0) for k, x in enumerate(feet)}
    m.body("beam", mass=mass, inertia=mass * size**2, points={"O": (-2 * size, 0), **points})
    for k in range(len(feet)):
        m.contact(f"foot{k}", f"beam.P{k}", "ground.floor", restitution=0)
    if pinned:
        m.revolute("pin", "ground.O", "beam.O")
    time = 0.1 * size**0.5
    return kp.dynamics(m, kp.assemble(m, set={"beam.y": 0.0}), t_end=time, output_step=time)


def not_determined(feet: list[float], pinned: bool) -> set[str]:
    """Loads that change without changing the sum of forces and moments."""
    columns = {f"foot{k}": [(0, 1, x)] for k, x in enumerate(feet)}
    if pinned:
        columns["pin"] = [(1, 0, 0), (0, 1, -2)]
    rows = np.array([row for own in columns.values() for row in own], dtype=float).T
    _, sizes, right = np.linalg.svd(rows)
    left = right[int((sizes > 1e-9).sum()) :]
    owners = [name for name, own in columns.items() for _ in own]
    return {own for k, own in enumerate(owners) if np.abs(left[:, k]).max(initial=0) > 1e-9}


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("pinned", [False, True])
@pytest.mark.parametrize("feet", [[-1.0, 1.0], [-1.0, 0.5, 1.0], [1.0], [-1.0, 0.3, 0.9, 1.5]])
def test_the_loads_that_statics_does_not_determine_have_a_choice(
    feet: list[float], pinned: bool, scale: tuple[float, float]
) -> None:
    if len(feet) == 1 and not pinned:
        feet = [0.0]
    sol = beam(feet, pinned, scale)
    several = not_determined(feet, pinned)
    assert dict(sol.choices) == dict.fromkeys(several, TOLD)
    assert {n for n in sol.compiled.forces if not sol.force(n).unique} == several - {"pin"}
    if pinned:
        assert sol["pin"].unique == ("pin" not in several)
    assert str(sol.statistics.get("notes", "")).count("share the load") == bool(several)
    assert dict(kp.design.free_body(sol, "beam").not_unique) == dict(sol.choices)
    weight = scale[0] * G
    loads = [sol[f"foot{k}.force"][-1] for k in range(len(feet))]
    pin = sol["pin"].force(on="beam")[-1][1] if pinned else 0.0
    arms = np.array(feet) @ loads - 2 * pin
    assert sum(loads) + pin == pytest.approx(weight, rel=1e-9)
    assert abs(arms) < 1e-9 * weight


def brakes(count: int, scale: tuple[float, float]) -> kp.Model:
    mass, size = scale
    m = kp.Model("wheel", gravity=(0, -G), parameters={"part": 0})
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=mass, inertia=mass * size**2, points={"O": (0, 0)}, center=(0.1 * size, 0))
    m.revolute("axle", "ground.O", "wheel.O")
    load = mass * G * 0.1 * size
    for k in range(count):
        m.friction(f"brake{k}", "axle", kinetic=0.9, radius=size, load=load / size)
    return m


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("count", [2, 3])
def test_brakes_that_share_a_load_have_stars(count: int, scale: tuple[float, float]) -> None:
    m = brakes(count, scale)
    sol = kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.5)
    names = {f"brake{k}" for k in range(count)}
    assert dict(sol.choices) == dict.fromkeys(names, TOLD)
    total = sum(sol[name].torque(on="wheel")[-1] for name in names)
    assert total == pytest.approx(scale[0] * G * 0.1 * scale[1], rel=1e-9)
    text = io.StringIO()
    summary = json.loads(json.dumps(dict(sol.summary)))
    show_findings(Console(file=text, width=250), "run", summary)
    for name in names:
        assert f"* {name} " in text.getvalue()
    assert "can share the load in several ways" in text.getvalue()
    html = page(sol, None, None)
    for name in names:
        assert f">* {name}<" in html
    assert f"* The forces {', '.join(sorted(names))} are not unique" in html


@pytest.mark.parametrize(("count", "told"), [(1, {}), (2, {"brake0.torque.final": TOLD})])
def test_a_sweep_marks_shared_loads(count: int, told: dict[str, str]) -> None:
    m = brakes(count, SCALES[0])
    m.torque("more", j="wheel", torque="0.1*part")
    case = kp.Case(m, {}, [kp.Dynamics(t_end=1, output_step=0.5, name="hang")])
    found = kp.sweep(case, {"part": [0, 1]}, measures=["brake0.torque.final", "wheel.angle.final"])
    assert dict(found.choices) == told


def test_one_brake_has_none() -> None:
    m = brakes(1, SCALES[0])
    m.torque("hold", j="wheel", torque=0.5 * G * 0.1)
    assert not kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.5).choices
