"""FMUs in FMPy: valid, and with the numbers of ``kp.Stepper`` and ``kp.dynamics``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu
from fmu.hosts import hosts
from fmu.machines import MACHINES, VERSIONS, ball, machine

Exported = Callable[[str, str], Path]


def close(found: float, wanted: float, scale: float) -> None:
    assert found == pytest.approx(wanted, rel=1e-9, abs=1e-9 * max(scale, 1e-3))


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", MACHINES)
def test_it_is_valid(exported: Exported, name: str, version: str) -> None:
    assert validate_fmu(str(exported(name, version))) == []


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("step", [0.004, 0.05])
@pytest.mark.parametrize("name", MACHINES)
def test_a_simulation_is_that_of_kempe(
    exported: Exported, name: str, step: float, version: str
) -> None:
    own = machine(name)
    count = round(0.6 / step)
    found = simulate_fmu(
        str(exported(name, version)), stop_time=count * step, step_size=step, output_interval=step
    )
    stepper = kp.Stepper(own.case)
    wanted = np.zeros((count + 1, len(own.outputs)))
    wanted[0] = [stepper[output] for output in own.outputs]
    for k in range(1, count + 1):
        stepper.step(step)
        wanted[k] = [stepper[output] for output in own.outputs]
    for k, output in enumerate(own.outputs):
        scale = np.ptp(wanted[:, k]) + abs(wanted[:, k]).max()
        assert len(found) == count + 1
        np.testing.assert_allclose(found[output], wanted[:, k], rtol=1e-9, atol=1e-9 * scale)


@pytest.mark.parametrize("version", VERSIONS)
def test_inputs_hold_over_a_step(exported: Exported, tmp_path: Path, version: str) -> None:
    own, random = machine("inverted_pendulum"), np.random.default_rng(2)
    stepper = kp.Stepper(own.case)
    with hosts(exported("inverted_pendulum", version), tmp_path) as (host,):
        for force in random.uniform(-15, 15, 40):
            host.set("F", force)
            stepper.set("F", force)
            # a reaction follows the input at once
            close(host.get("pin.fy")[0], stepper["pin.fy"], 4.0)
            dt = float(random.choice([0.001, 0.01, 0.04]))
            host.step(dt)
            stepper.step(dt)
            for value, name in zip(host.get(*own.outputs), own.outputs, strict=True):
                close(value, stepper[name], 1.0)
            assert host.get("F", "time") == [force, stepper.t]


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("dt", [0.0701, 0.31])
def test_events_inside_a_step_are_located(tmp_path: Path, dt: float, version: str) -> None:
    kp.export_fmu(ball(), tmp_path / "ball.fmu", outputs=["ball.y", "ball.vy"], version=version)
    fall, g, e = 1.0, 10.0, 0.8
    hits = [fall]
    while hits[-1] < 6:
        hits.append(hits[-1] + 2 * fall * e ** len(hits))
    with hosts(tmp_path / "ball.fmu", tmp_path / "ball") as (host,):
        for _ in range(int(5 / dt)):
            host.step(dt)
            t = host.get("time")[0]
            n = sum(hit <= t for hit in hits)  # impacts so far
            since, speed = (t - hits[n - 1], g * fall * e**n) if n else (t, 0.0)
            height = speed * since - g * since**2 / 2 + (0 if n else g * fall**2 / 2)
            assert host.get("ball.y", "ball.vy") == pytest.approx(
                [height, speed - g * since], abs=1e-7
            )


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_before_the_start_assemble_the_mechanism(tmp_path: Path, version: str) -> None:
    kp.export_fmu(ball(), tmp_path / "ball.fmu", ["e"], ["ball.y"], version=version)
    with hosts(tmp_path / "ball.fmu", tmp_path / "ball", begin=False) as (host,):
        host.begin({"height": 20.0, "e": 0.5})
        assert host.get("height", "e", "ball.y") == [20.0, 0.5, 20.0]
        host.step(2.0 + 0.5)  # it falls for 2 s, and rises with half the speed
        assert host.get("ball.y")[0] == pytest.approx(10 * 0.5 - 10 * 0.5**2 / 2, abs=1e-9)


def test_measures_and_points_of_tables_are_inside(tmp_path: Path) -> None:
    (tmp_path / "push.csv").write_text("t,F\n0,0\n1,2\n2,0\n")
    text = """
kempe = 1
[tables.push]
file = "push.csv"
columns = ["t", "F"]
interpolation = "linear"
[bodies.ground]
points = { O = [0, 0] }
[bodies.cart]
mass = 0.5
inertia = 1
points = { S = [0, 0] }
[joints.rail]
type = "translational"
i = "ground.O"
j = "cart.S"
[forces.push]
type = "force"
j = "cart.S"
force = ["push(t)", 0]
[measures]
momentum = "0.5 * cart.vx"
[start]
set = { "cart.x" = 0, "cart.vx" = 0 }
"""
    (tmp_path / "cart.toml").write_text(text)
    kp.export_fmu(kp.load(tmp_path / "cart.toml"), tmp_path / "cart.fmu")
    with hosts(tmp_path / "cart.fmu", tmp_path / "cart") as (host,):
        host.step(1.5)
        assert host.get("momentum")[0] == pytest.approx(1 + 0.75, rel=1e-9)
