"""Instances of FMUs: states, reset, two at once, ends, errors, memory."""

from __future__ import annotations

import resource
from collections.abc import Callable
from pathlib import Path

import kempe as kp
import pytest
from fmpy.fmi1 import FMICallException
from fmu.hosts import DISCARD, ERROR, Host, hosts
from fmu.machines import MACHINES, VERSIONS, ball, machine
from sizes import count

Exported = Callable[[str, str], Path]
both = pytest.mark.parametrize("version", VERSIONS)


def values(host: Host) -> list[float]:
    return host.get(*host.references)


def advance(host: Host, steps: int) -> None:
    for _ in range(steps):
        host.step(0.01)


@both
@pytest.mark.parametrize("name", MACHINES)
def test_a_state_continues_to_the_last_bit(
    exported: Exported, tmp_path: Path, name: str, version: str
) -> None:
    own = machine(name)
    with hosts(exported(name, version), tmp_path, 2) as (host, other):
        advance(host, 20)
        start = host.get(own.inputs[0])[0]
        host.set(own.inputs[0], 1.01 * start + 0.1)
        advance(host, 1)
        state, t, there = host.state(), host.t, values(host)
        data = host.bytes(state)
        advance(host, 20)
        end = values(host)
        assert end != there
        host.restore(state)
        host.t = t
        assert values(host) == there
        advance(host, 20)
        assert values(host) == end
        read = other.read(data)
        other.restore(read)
        other.t = t
        assert values(other) == there
        advance(other, 20)
        assert values(other) == end
        assert other.bytes(read) == data
        host.free(state)
        other.free(read)


@both
def test_a_state_keeps_contacts_and_events(tmp_path: Path, version: str) -> None:
    case = ball(end="ball.vy > 7")
    kp.export_fmu(case, tmp_path / "ball.fmu", ["e"], ["ball.y", "ball.vy"], version=version)
    with hosts(tmp_path / "ball.fmu", tmp_path / "ball", 2) as (host, other):
        host.set("e", 0.6)  # the ball never rises with 7 m/s
        for _ in range(40):
            host.step(0.1)
        state = host.state()
        other.restore(other.read(host.bytes(state)))
        other.t = host.t
        host.step(0.3)
        other.step(0.3)
        assert values(other) == values(host)
        host.free(state)


@both
def test_a_reset_begins_again_with_the_inputs_of_the_case(
    exported: Exported, tmp_path: Path, version: str
) -> None:
    with hosts(exported("motor_press", version), tmp_path) as (host,):
        before = values(host)
        host.set("stall", 700.0)
        advance(host, 30)
        host.reset()
        host.begin()
        assert values(host) == before
        advance(host, 10)
        stepper = kp.Stepper(machine("motor_press").case)
        for _ in range(10):
            stepper.step(0.01)
        assert host.get("wheel.omega")[0] == stepper["wheel.omega"]


@both
def test_two_instances_do_not_touch_each_other(
    exported: Exported, tmp_path: Path, version: str
) -> None:
    with hosts(exported("inverted_pendulum", version), tmp_path, 2) as (one, other):
        one.set("F", 5.0)
        for _ in range(10):
            one.step(0.01)
            other.step(0.02)
        wanted = []
        for force, dt in ((5.0, 0.01), (0.0, 0.02)):
            stepper = kp.Stepper(machine("inverted_pendulum").case)
            stepper.set("F", force)
            for _ in range(10):
                stepper.step(dt)
            wanted.append(stepper["rod.angle"])
        assert [one.get("rod.angle")[0], other.get("rod.angle")[0]] == wanted


def test_an_event_that_stops_the_run_ends_the_step(tmp_path: Path) -> None:
    kp.export_fmu(ball(end="ball.y < 1.8"), tmp_path / "two.fmu", outputs=["ball.y"])
    with hosts(tmp_path / "two.fmu", tmp_path / "two") as (host,):
        with pytest.raises(FMICallException) as raised:
            host.step(1.0)
        assert raised.value.status == DISCARD
        assert host.fmu.getRealStatus(2) == pytest.approx(0.8, abs=1e-9)
        assert host.fmu.getBooleanStatus(3)
        assert host.get("time", "ball.y") == pytest.approx([0.8, 1.8], abs=1e-9)
    kp.export_fmu(ball(end="ball.y < 1.8"), tmp_path / "three.fmu", (), ["ball.y"], version="3.0")
    with hosts(tmp_path / "three.fmu", tmp_path / "three") as (host,):
        needs_event, ends, early, t = host.fmu.doStep(0.0, 1.0)
        assert (needs_event, ends, early) == (False, True, True)
        assert t == pytest.approx(0.8, abs=1e-9)
        with pytest.raises(FMICallException):
            host.fmu.doStep(t, 0.1)
        assert "stopped the run" in host.messages[-1]


@both
def test_errors_have_a_message_and_leave_the_instance_usable(
    exported: Exported, tmp_path: Path, version: str
) -> None:
    with hosts(exported("motor_press", version), tmp_path) as (host,):
        advance(host, 3)
        before = values(host)

        def refused(act: Callable[[], object], message: str) -> None:
            with pytest.raises(FMICallException) as raised:
                act()
            assert raised.value.status == ERROR
            assert message in host.messages[-1], host.messages

        refused(lambda: host.fmu.doStep(0.5, 0.01), "a step from 0.5 s; the instance is at 0.03 s")
        refused(lambda: host.fmu.doStep(host.t, 0.0), "must be positive")
        refused(lambda: host.set("flywheel", 3.0), "flywheel is fixed during the simulation")
        refused(lambda: host.set("ram.y", 3.0), "outputs cannot be set")
        refused(lambda: host.set("stall", float("nan")), "stall = NaN; must be finite")
        host.references["absent"] = 99
        refused(lambda: host.get("absent"), "no variable with this value reference")
        del host.references["absent"]
        refused(lambda: host.restore(host.read(b"nonsense")), "not a state of this FMU")
        refused(host.begin, "not allowed in the state Step")
        assert values(host) == before
        host.set("stall", -1.0)
        refused(lambda: host.step(0.01), "stall")
        assert host.get("stall") == [500.0]
        advance(host, 3)


@both
def test_a_value_that_opens_a_joint_is_an_error(tmp_path: Path, version: str) -> None:
    case = kp.load("examples/four_bar.toml")
    kp.export_fmu(case, tmp_path / "a.fmu", ["L2"], ["crank.angle"], version=version)
    with hosts(tmp_path / "a.fmu", tmp_path / "a") as (host,):
        host.set("L2", 27.0)
        with pytest.raises(FMICallException):
            host.step(0.01)
        assert "joint B is open" in host.messages[-1] and "L2 = 27" in host.messages[-1]
    with hosts(tmp_path / "a.fmu", tmp_path / "b", begin=False) as (host,):
        host.begin({"L2": 27.0})  # before the start, the mechanism is assembled with it
        host.step(0.01)
        host.reset()
        with pytest.raises(FMICallException):
            host.begin({"L2": 70.0})
        assert "the loop A-B-C-D cannot close" in host.messages[-1]


@both
def test_another_token_or_start_is_refused(
    exported: Exported, tmp_path: Path, version: str
) -> None:
    with hosts(exported("motor_press", version), tmp_path, begin=False) as (host,):
        with pytest.raises(FMICallException):
            if host.is_2:
                host.fmu.setupExperiment(startTime=1.0)
                host.fmu.enterInitializationMode()
            else:
                host.fmu.enterInitializationMode(startTime=1.0)
            host.fmu.exitInitializationMode()
        assert "start time 1 s; the analysis starts at 0 s" in host.messages[-1]


def test_a_tolerance_of_the_host_is_used(exported: Exported, tmp_path: Path) -> None:
    own = machine("inverted_pendulum")
    ends = []
    with hosts(exported("inverted_pendulum", "2.0"), tmp_path, begin=False) as (host,):
        for tolerance in (1e-3, None, 1e-12):
            host.begin(tolerance=tolerance)
            for _ in range(4):
                host.step(0.5)
            ends.append(host.get("rod.angle")[0])
            host.reset()
    case = own.case._with(analyses=[kp.Dynamics(1.0, method=kp.Auto(rtol=1e-12))])
    stepper = kp.Stepper(case)
    for _ in range(4):
        stepper.step(0.5)
    assert ends[2] == stepper["rod.angle"]
    assert abs(ends[1] - ends[2]) < abs(ends[0] - ends[2])


@both
def test_memory_does_not_grow(exported: Exported, tmp_path: Path, version: str) -> None:
    with hosts(exported("inverted_pendulum", version), tmp_path) as (host,):

        def run(steps: int) -> None:
            for k in range(steps):
                host.set("F", 5.0 * (-1) ** k)
                host.step(0.001)
                host.get("rod.angle")
                host.free(host.state())

        steps = count(10_000, 10_000)
        run(1000)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        run(steps)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        assert grown < 2000, f"{grown} KiB for {steps} steps"
