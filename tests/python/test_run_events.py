"""Events of runs: times, directions, order, stops; in Python, in files and in saved solutions."""

from __future__ import annotations

import copy
import math
import pickle
import warnings
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.draw.scene import scene
from scipy.special import ellipk

G = 9.81
FOUR_BAR = ROOT / "examples" / "four_bar.toml"
#: Times at which the rocker of the flagship passes 270° after release from rest, s, from an
#: independent program.
THROUGH = [0.077841704204374, 0.235129538323398, 0.380960319608237, 0.532666729571221]
METHODS: list[kp.Option] = [
    kp.RK45(rtol=1e-9, atol=1e-12),
    kp.DOP853(rtol=1e-9, atol=1e-12),
    kp.RK4(step=1e-3),
    kp.Radau(rtol=1e-9, atol=1e-12),
    kp.GeneralizedAlpha(step=1e-4),
    kp.Auto(),
]


def ball(height: float = 5.0) -> kp.Model:
    m = kp.Model("ball", gravity=(0, -G), parameters={"h": height})
    m.point_mass("ball", mass=2, at=(0, "h"))
    return m


def dropped(**options: Any) -> kp.Solution:
    m = ball()
    start = kp.assemble(m, set={"ball.x": 0, "ball.y": 5})
    return kp.dynamics(m, start, **{"t_end": 1.5, **options})


def pendulum(length: float = 1.2) -> kp.Model:
    """A uniform bar about its end: as a simple pendulum of two thirds of its length."""
    m = kp.Model("pendulum", gravity=(0, -G))
    m.ground.points(O=(0, 0))
    m.bar("bar", mass=3, length=length, ends=("O", "P"))
    m.revolute("pin", "ground.O", "bar.O")
    return m


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_free_fall_through_a_height_by_every_method(method: kp.Option) -> None:
    sol = dropped(method=method, events={"low": "ball.y < 1"})
    event = sol.events["low"]
    np.testing.assert_allclose(event.t, [math.sqrt(2 * 4 / G)], rtol=0, atol=1e-12)
    assert isinstance(event.states[0], kp.State)
    assert event.states[0].t == event.t[0]
    assert abs(event.states[0]["ball.y"] - 1) < 1e-11
    assert abs(event.states[0]["ball.vy"] + math.sqrt(8 * G)) < 1e-10
    assert (sol.status, sol.t[-1]) == (0, 1.5)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_a_pendulum_passes_the_lowest_point_at_odd_quarters_of_its_period(
    method: kp.Option,
) -> None:
    m, begin = pendulum(), 1.2
    sol = kp.dynamics(
        m,
        kp.assemble(m, set={"bar.angle": begin - math.pi / 2}),
        t_end=3.0,
        method=method,
        events={
            "low": "bar.angle + pi/2",
            "up": kp.Event("bar.angle + pi/2", direction="rising"),
            "back": {"condition": "bar.angle + pi/2", "direction": "falling"},
            "fast": "bar.omega^2 > 8",
            "taut": "pin.force > 50",
        },
    )
    quarter = float(ellipk(math.sin(begin / 2) ** 2)) * math.sqrt(0.8 / G)
    expected = quarter * np.array([1, 3, 5])
    within = {"generalized_alpha": 1e-6, "rk4": 1e-9, "auto": 1e-8}.get(method.kind, 1e-8)
    np.testing.assert_allclose(sol.events["low"].t, expected, rtol=0, atol=within)
    np.testing.assert_array_equal(sol.events["back"].t, sol.events["low"].t[::2])
    np.testing.assert_array_equal(sol.events["up"].t, sol.events["low"].t[1::2])
    # ω² = 3 (g/l) (cos θ - cos θ0)
    angle = math.acos(8 * 1.2 / (3 * G) + math.cos(begin))
    for state in sol.events["fast"].states:
        theta = state["bar.angle"] + math.pi / 2
        assert abs(abs(theta) - angle) < 1e-5
        assert theta * state["bar.omega"] < 0  # on the way down
    assert len(sol.events["fast"].t) == 3
    for state in sol.events["taut"].states:
        # along the bar m g cos θ + m (l/2) ω², across it m g/4 sin θ
        theta = state["bar.angle"] + math.pi / 2
        along = 3 * G * math.cos(theta) + 3 * 0.6 * state["bar.omega"] ** 2
        assert abs(math.hypot(along, 3 * G / 4 * math.sin(theta)) - 50) < 1e-4
        assert theta * state["bar.omega"] < 0
    assert len(sol.events["taut"].t) == 3


def test_the_rocker_of_the_flagship_passes_270_degrees() -> None:
    case = kp.load(FOUR_BAR)
    start = case.start()
    options: dict[str, Any] = {"t_end": 0.6, "events": {"hit": "rocker.angle - 270*deg"}}
    by_default = kp.dynamics(case.model, start, **options)
    np.testing.assert_allclose(by_default.events["hit"].t, THROUGH, rtol=0, atol=1e-10)
    for method in (kp.Auto(rtol=1e-12, atol=1e-15), kp.DOP853(rtol=1e-12, atol=1e-15)):
        tight = kp.dynamics(case.model, start, method=method, **options)
        np.testing.assert_allclose(tight.events["hit"].t, THROUGH, rtol=0, atol=1e-12)


def test_the_run_stops_exactly_at_an_event() -> None:
    for condition, effect in (("ball.y < 1", {}), ("ball.y - 1", {})):
        sol = dropped(events={"low": kp.Event(condition, stop=True)}, **effect)
        assert (sol.status, sol.success) == (1, True)
        assert sol.message == "the event low stopped the run at t = 0.903047 s"
        assert sol.t[-1] == sol.events["low"].t[0] == sol.final.t
        assert abs(sol.t[-1] - math.sqrt(8 / G)) < 1e-12
        assert np.count_nonzero(sol.t == sol.t[-1]) == 1
        assert abs(sol["ball.y"][-1] - 1) < 1e-12
        assert sol.dense is not None and sol.dense.t[-1] == sol.t[-1]
    stopped = dropped(stop="ball.y < 1", output_step=0.1)
    assert stopped.message.startswith("the event stop stopped the run")
    np.testing.assert_allclose(stopped.t, [*np.arange(10) * 0.1, math.sqrt(8 / G)], atol=1e-12)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
def test_the_end_of_a_stopped_run_is_at_the_condition(method: kp.Option) -> None:
    case = kp.load(FOUR_BAR)
    sol = kp.dynamics(
        case.model, case.start(), t_end=1, method=method, stop="rocker.angle > 270*deg"
    )
    assert sol.t[-1] == sol.events["stop"].t[0]
    assert abs(sol["rocker.angle"][-1] - 1.5 * math.pi) < 1e-12
    assert abs(sol.t[-1] - THROUGH[0]) < (1e-5 if method.kind == "generalized_alpha" else 1e-8)


def test_what_is_true_at_the_start_is_no_event() -> None:
    sol = dropped(
        events={
            "above": "ball.y > 1",
            "still": "ball.vy",  # zero at the start, and never again
            "down": "ball.vy <= 0",
            "early": "t > 0.25",
            "late": "t > 2",
        }
    )
    times = {name: event.t.tolist() for name, event in sol.events.items()}
    assert times["above"] == times["still"] == times["down"] == times["late"] == []
    np.testing.assert_allclose(times["early"], [0.25], rtol=0, atol=1e-15)


def test_conditions_may_jump() -> None:
    """The whole metres below the ball: 4 from the start on, 3 below 4 m and so on."""
    sol = dropped(
        t_end=1.0,
        events={
            "below_2": "floor(ball.y) < 2",
            "at_most_2": "floor(ball.y) <= 2",
            "sign": "sign(ball.y - 3)",
        },
    )
    for name, height in (("below_2", 2), ("at_most_2", 3), ("sign", 3)):
        expected = math.sqrt(2 * (5 - height) / G)
        np.testing.assert_allclose(sol.events[name].t, [expected], rtol=0, atol=1e-12)


def test_all_zeros_within_one_step_are_found() -> None:
    """Free fall is one long step of DOP853."""
    sol = dropped(
        method=kp.DOP853(first_step=1.5),
        events={
            "fast": "sin(40*pi*t + 0.1)",
            "pair": "(ball.y - 3)*(ball.y - 2.999)",
            "graze": "(ball.y - 3)^2 - 1e-9",
        },
    )
    assert sol.statistics["steps"] <= 4
    expected = (np.arange(1, 61) * math.pi - 0.1) / (40 * math.pi)
    np.testing.assert_allclose(sol.events["fast"].t, expected, rtol=0, atol=1e-13)
    for name, heights in (("pair", (3, 2.999)), ("graze", (3 + 1e-9**0.5, 3 - 1e-9**0.5))):
        found = [math.sqrt(2 * (5 - height) / G) for height in heights]
        np.testing.assert_allclose(sol.events[name].t, found, rtol=0, atol=1e-10)


def test_each_turn_of_a_fast_rotor_is_found() -> None:
    """At constant speed a step is as long as the run."""
    m = kp.Model("rotor")
    m.ground.points(O=(0, 0))
    m.body("rotor", mass=1, inertia=2, points={"O": (0, 0)})
    m.revolute("shaft", "ground.O", "rotor.O")
    start = kp.assemble(m, set={"rotor.angle": 0.3, "rotor.omega": 500})
    turn = kp.Event("sin(rotor.angle/2)", direction="rising")
    sol = kp.dynamics(m, start, t_end=1, events={"turn": turn})
    expected = (4 * math.pi * np.arange(1, 40) - 0.3) / 500
    np.testing.assert_allclose(sol.events["turn"].t, expected[expected < 1], rtol=0, atol=1e-11)


def test_events_at_one_time_are_in_the_stated_order() -> None:
    seen: list[str] = []

    def called(name: str) -> kp.Event:
        return kp.Event("t > 0.5", action=lambda _: seen.append(name))  # type: ignore[func-returns-value]

    dropped(events={"second": called("second"), "first": called("first")})
    assert seen == ["second", "first"]
    sol = dropped(events={"halt": kp.Event("t > 0.5", stop=True), "other": "t > 0.5"})
    assert sol.events["halt"].t == sol.events["other"].t


QUANTITIES = [
    "coupler.x",
    "coupler.C.vy",
    "coupler.C.ax",
    "crank.omega",
    "rocker.alpha",
    "D.angle",
    "A.alpha",
    "spring.omega",
    "C.force",
    "B.fx",
    "A.fy",
    "B.torque",
    "spring.torque",
    "spring.power",
    "spring.energy",
    "energy.kinetic",
    "energy.potential",
    "energy.dissipated",
]


def test_conditions_know_every_quantity() -> None:
    """At the times of an event the quantity has the value of the condition."""
    case = kp.load(FOUR_BAR)
    start = case.start()
    before = kp.dynamics(case.model, start, t_end=0.5)
    values = {name: float((before[name].min() + before[name].max()) / 2) for name in QUANTITIES}
    constant = [name for name in QUANTITIES if np.ptp(before[name]) < 1e-9]
    assert constant == ["B.torque"]
    events = {f"e{k}": f"{name} - {values[name]!r}" for k, name in enumerate(QUANTITIES)}
    sol = kp.dynamics(case.model, start, t_end=0.5, events={**events, "e": "energy.total > 1e9"})
    assert not len(sol.events["e"].t)
    for k, name in enumerate(QUANTITIES):
        event = sol.events[f"e{k}"]
        if name in constant:
            continue
        assert len(event.t), name
        if name.startswith("energy."):
            found = getattr(sol.energy_at(event.t), name.split(".")[1])
        else:
            found = np.array([state[name] for state in event.states])
        scale = np.abs(sol[name]).max()
        np.testing.assert_allclose(found, values[name], rtol=0, atol=1e-6 * scale, err_msg=name)


def test_results_of_joints_and_drivers_are_known() -> None:
    m = kp.Model("driven", gravity=(0, -G), parameters={"w": 3})
    m.ground.points(O=(0, 0))
    m.bar("arm", mass=2, length=1, ends=("O", "P"))
    m.revolute("pin", "ground.O", "arm.O")
    m.coordinate_driver("motor", "arm.angle", value="w*t")
    events = {
        "effort": "motor.effort < 5",
        "power": "motor.power - 6",
        "drift": "drift.position > 1",
    }
    sol = kp.dynamics(m, kp.assemble(m), t_end=1, events=events)
    # the moment of the weight about the pin, m g l/2 cos φ
    expected = math.acos(5 / (2 * G / 2)) / 3
    np.testing.assert_allclose(sol.events["effort"].t, [expected], rtol=0, atol=1e-9)
    expected = math.acos(2 / (2 * G / 2)) / 3
    np.testing.assert_allclose(sol.events["power"].t, [expected], rtol=0, atol=1e-9)
    assert not len(sol.events["drift"].t)


@pytest.mark.parametrize(
    ("condition", "match"),
    [
        ("ball.z > 1", "ball.z"),
        ("bal.y > 1", r"did you mean 'ball.y'"),
        ("ball.y > ", "ends too early"),
        ("1 > 2", "never changes"),
        ("h - 1", "never changes"),
        ("ball.y > 1 > 2", "only two numbers"),
        ("(ball.y > 1) + 1", "comparison"),
        (5, "must be a condition"),
        ({"direction": "rising"}, "condition"),
        ({"condition": "ball.y > 1", "direction": "rising"}, "a comparison has no direction"),
        ({"condition": "ball.y", "direction": "up"}, "up"),
        ({"condition": "ball.y", "halt": True}, "halt"),
    ],
)
def test_a_faulty_condition_is_refused(condition: Any, match: str) -> None:
    with pytest.raises(kp.ModelError, match=match):
        dropped(events={"low": condition})


def test_faulty_requests_are_refused() -> None:
    with pytest.raises(kp.ModelError, match="stop"):
        dropped(stop="ball.y < 1", events={"stop": "t > 1"})
    with pytest.raises(kp.ModelError, match=r"'\.'"):
        dropped(events={"a.b": "t > 1"})
    with pytest.raises(kp.ModelError, match="stop and an action"):
        dropped(events={"a": kp.Event("t > 1", stop=True, action=lambda _: None)})
    with pytest.raises(kp.ModelError, match="a case cannot contain it"):
        kp.Dynamics(1, events={"a": kp.Event("t > 1", action=lambda _: None)}).tree()


def test_events_are_kept_in_files_and_copies(tmp_path: Path) -> None:
    sol = dropped(events={"low": kp.Event("ball.y < 1", stop=True), "never": "t > 9"})
    sol.save(tmp_path / "sol.npz")
    for other in (
        kp.load_solution(tmp_path / "sol.npz"),
        pickle.loads(pickle.dumps(sol)),
        copy.deepcopy(sol),
    ):
        assert (other.status, other.message) == (1, sol.message)
        assert list(other.events) == ["low", "never"]
        np.testing.assert_array_equal(other.events["low"].t, sol.events["low"].t)
        np.testing.assert_array_equal(other.events["low"].states[0].q, sol.final.q)
    assert repr(sol.events["never"]) == "<Event 'never': never>"


def test_events_are_marked_in_figures_and_in_the_player() -> None:
    sol = dropped(events={"low": "ball.y < 1"})
    page = next(page for page in kp.plot.pages(sol) if page.name == "motion")
    figure = page.figure()
    marks = [line for axes in figure.axes for line in axes.lines if line.get_linewidth() == 0.4]
    assert len(marks) == len(figure.axes)
    assert all(abs(line.get_xdata()[0] - sol.events["low"].t[0]) < 1e-12 for line in marks)
    assert [text.get_text() for axes in figure.axes for text in axes.texts].count("low") == 1
    assert scene(sol)["events"] == [{"name": "low", "t": pytest.approx(sol.events["low"].t[0])}]
    assert scene(sol.final)["events"] == []


def test_a_stop_that_is_true_at_the_start_is_reported() -> None:
    with pytest.warns(kp.EventWarning, match="stop: 'ball.y < 6' is true at the start") as told:
        sol = dropped(t_end=0.5, stop="ball.y < 6")
    assert len(told) == 1 and sol.status == 0
    with pytest.warns(kp.EventWarning, match="low: 'ball.y < 2' is true at the start"):
        m = ball(1.0)
        start = kp.assemble(m)
        events = {"low": kp.Event("ball.y < 2", stop=True), "high": "ball.y < 3"}
        kp.dynamics(m, start, t_end=0.1, events=events)


def test_a_release_that_is_true_at_the_start_is_reported() -> None:
    m = ball()
    m.coordinate_driver("hold", "ball.y", value="5 - t", release="ball.y > 2")
    with pytest.warns(kp.EventWarning, match=r"hold\.release: .* and it never released hold"):
        kp.dynamics(m, kp.assemble(m), t_end=1.0)


def test_a_stop_that_happens_later_or_is_false_is_not_reported() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        thrown = ball(1.0)
        start = kp.assemble(thrown, set={"ball.vy": 9.0})
        sol = kp.dynamics(thrown, start, t_end=3.0, stop="ball.y < 2")
        assert sol.t[-1] == pytest.approx((9 + math.sqrt(81 - 2 * G)) / G)
        dropped(t_end=0.1, stop="ball.y < 1", events={"other": "ball.y < 6"})


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.kind)
@pytest.mark.parametrize("t0", [0.0, 1.0, -1e3])
def test_a_strict_comparison_that_is_equal_at_the_start_is_an_event_at_once(
    method: kp.Option, t0: float
) -> None:
    m = kp.Model("ball", gravity=(0, -G))
    m.point_mass("ball", mass=2, at=(0, 0))
    m.coordinate_driver("hand", "ball.x", value="0", release=f"t > {t0}")
    for size in (0.0, 1e-3, 1.0, 1e3):
        for speed in (0.0, -1e-3 * size, -1e3 * size):
            start = kp.assemble(m, set={"ball.y": size, "ball.vy": speed}, t=t0)
            rules = {"low": f"ball.y < {size}", "back": f"ball.vy < {speed}", "late": f"t > {t0}"}
            rules |= {"high": f"ball.y > {size}", "not strict": f"ball.y <= {size}"}
            sol = kp.dynamics(m, start, t_end=t0 + 0.1, method=method, events=rules)
            seen = 2e-4 * 0.1 + 1e-12 * abs(t0)  # a small fraction of the first step
            for name in ("low", "back", "late", "hand.release"):
                assert len(sol.events[name].t) == 1, name
                assert t0 <= sol.events[name].t[0] <= t0 + seen, name
            assert not len(sol.events["high"].t) and not len(sol.events["not strict"].t)
            stopped = kp.dynamics(m, start, t_end=t0 + 0.1, method=method, stop=rules["low"])
            assert stopped.status == 1 and stopped.t[-1] <= t0 + seen
