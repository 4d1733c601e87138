"""``kp.Stepper``: steps and events, compared with closed forms and with ``kp.dynamics``."""

import itertools
import math

import kempe as kp
import numpy as np
import pytest
from sizes import count
from stepping.machines import ball, cart, pendulum
from stress.random_impacts import drawn

SCALES = [1e-3, 1.0, 1e3]


@pytest.mark.parametrize("mass", SCALES)
@pytest.mark.parametrize("dt", SCALES)
def test_an_input_holds_over_each_step(mass: float, dt: float) -> None:
    random = np.random.default_rng(5)
    stepper = kp.Stepper(kp.Case(cart(mass), {"set": {"cart.x": 0, "cart.vx": 0}}))
    x = v = 0.0
    unit = mass / dt**2  # moves the cart by about a metre
    for force in unit * random.uniform(-1, 1, 20):
        stepper.set("F", force)
        stepper.step(dt)
        x, v = x + v * dt + force / mass * dt**2 / 2, v + force / mass * dt
        assert stepper["cart.x"] == pytest.approx(x, rel=1e-9, abs=1e-9)
        assert stepper["cart.vx"] == pytest.approx(v, rel=1e-9, abs=1e-9 / dt)
    assert stepper.t == 20 * dt


def test_equal_steps_end_at_their_multiples() -> None:
    stepper = kp.Stepper(kp.Case(cart(), {"set": {"cart.x": 0, "cart.vx": 0}}))
    for k in range(1, 1001):
        stepper.step(0.1)
        assert stepper.t == k * 0.1
    stepper.step(0.25)
    assert stepper.t == 1000 * 0.1 + 0.25


def test_a_mass_may_change_between_steps() -> None:
    stepper = kp.Stepper(kp.Case(cart(force=6.0), {"set": {"cart.x": 0, "cart.vx": 1}}))
    stepper.step(0.5)  # v = 4, x = 0.5 + 0.75
    stepper.set("mass", 3.0)
    stepper.step(0.5)  # the velocity stays, the acceleration is 2
    assert stepper["cart.vx"] == pytest.approx(5.0, rel=1e-12)
    assert stepper["cart.x"] == pytest.approx(1.25 + 2 + 0.25, rel=1e-12)
    assert stepper.parameters["mass"] == 3.0


@pytest.mark.parametrize("size", SCALES)
@pytest.mark.parametrize("dt", [0.0701, 0.01, 0.3])
def test_impacts_inside_a_step_are_located(size: float, dt: float) -> None:
    g, e = 10.0 * size, 0.8
    stepper = kp.Stepper(ball(5.0 * size, e, g))
    fall = 1.0  # s
    exact = [fall]
    while exact[-1] < 6:
        exact.append(exact[-1] + 2 * fall * e ** len(exact))
    found = []
    while stepper.t < 6:
        before = stepper.t
        stepper.step(dt)
        times = stepper.events["floor.hit"].t.tolist()
        assert all(before <= t <= stepper.t for t in times)
        found += times
    assert found == pytest.approx([t for t in exact if t <= stepper.t], abs=1e-9)
    k = len(found)  # a parabola since the last impact
    v, since = g * fall * e**k, stepper.t - found[-1]
    assert stepper["ball.y"] == pytest.approx(v * since - g * since**2 / 2, abs=1e-8 * size)


@pytest.mark.parametrize(
    "condition", ["t > 0.5", "t >= 0.5", "t - 0.5", "cart.x > 0.5", "cart.x - 0.5"]
)
@pytest.mark.parametrize("dt", [0.1, 0.125, 0.25, 0.3, 0.5])
def test_an_event_at_a_pause_occurs_once(condition: str, dt: float) -> None:
    case = kp.Case(
        cart(force=0.0),
        {"set": {"cart.x": 0, "cart.vx": 1}},
        [kp.Dynamics(1, events={"half": condition})],
    )
    stepper, found = kp.Stepper(case), []
    for _ in range(round(2 / dt)):
        stepper.step(dt)
        found += stepper.events["half"].t.tolist()
    assert found == pytest.approx([0.5], abs=1e-9)


def at_ends(run: kp.Solution, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """q and v at times, after the events there."""
    rows = [np.flatnonzero(np.isclose(run.t, t, rtol=0, atol=1e-12))[-1] for t in ends]
    return run.q[rows], run.v[rows]


@pytest.mark.parametrize("seed", range(count(24, 400)))
def test_steps_give_the_motion_of_a_run(seed: int) -> None:
    """Random mechanisms with friction, stops and contacts.

    Some of them amplify errors. Steps may err ten times as much as a run, from an accurate run.
    """
    _, made, start = drawn(seed)
    dt, n = 0.02, 20
    run = kp.dynamics(made.model, start, t_end=n * dt, output_step=dt)
    tight = kp.Auto(rtol=1e-11, atol=1e-13)
    exact = kp.dynamics(made.model, start, t_end=n * dt, output_step=dt, method=tight)
    case = kp.Case(made.model, {"set": made.set, "guess": made.guess})
    stepper = kp.Stepper(case)
    stepper.reset(start)
    times: dict[str, list[float]] = {name: [] for name in run.events}
    for name, event in stepper.events.items():  # those of the start
        times[name] += event.t.tolist()
    ends = dt * np.arange(1, n + 1)
    (q, v), (to_q, to_v) = at_ends(run, ends), at_ends(exact, ends)
    most_q = 1e-6 + 10 * abs(q - to_q).max()
    most_v = 1e-6 * max(1.0, abs(to_v).max()) + 10 * abs(v - to_v).max()
    for k in range(n):
        stepper.step(dt)
        for name, event in stepper.events.items():
            times[name] += event.t.tolist()
        assert stepper.state.q == pytest.approx(to_q[k], abs=most_q)
        assert stepper.state.v == pytest.approx(to_v[k], abs=most_v)
    for name, event in exact.events.items():
        if len(event.t) == len(run.events[name].t):  # otherwise errors decide their number
            most = 1e-6 + 10 * abs(event.t - run.events[name].t).max(initial=0.0)
            assert times[name] == pytest.approx(event.t.tolist(), abs=most), name


@pytest.mark.parametrize("size", SCALES)
@pytest.mark.parametrize("dt", [0.03, 0.1, 0.35])
def test_a_block_sticks_and_slips_under_changing_forces(size: float, dt: float) -> None:
    """Coulomb friction: static 0.5, kinetic 0.3, of a block that is pulled and let go."""
    mass, g = 2.0, 10.0 * size
    weight = mass * g
    m = kp.Model("block", gravity=(0, -g), parameters={"F": 0})
    m.ground.points(O=(0, 0))
    m.body("block", mass=mass, inertia=0.1 * size**2, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P")
    m.friction("rub", "slide", kinetic=0.3, static=0.5)
    m.force("pull", "block.P", force=("F", 0))
    stepper = kp.Stepper(kp.Case(m, {"set": {"block.x": 0, "block.vx": 0}}))
    random = np.random.default_rng(7)
    x = v = 0.0
    for pull in weight * random.choice([-0.8, -0.4, 0.0, 0.45, 0.7], 30):
        stepper.set("F", pull)
        stepper.step(dt)
        left = dt
        if v == 0.0 and abs(pull) > 0.5 * weight:
            a = (pull - math.copysign(0.3 * weight, pull)) / mass
            x, v, left = x + a * left**2 / 2, a * left, 0.0
        elif v != 0.0:
            a = (pull - math.copysign(0.3 * weight, v)) / mass
            until = -v / a if v * a < 0 else math.inf
            first = min(left, until)
            x, v, left = x + v * first + a * first**2 / 2, v + a * first, left - first
            v = 0.0 if until <= dt else v
            if left > 0 and abs(pull) > 0.5 * weight:  # it turns round
                a = (pull - math.copysign(0.3 * weight, pull)) / mass
                x, v = x + a * left**2 / 2, a * left
        assert stepper["block.x"] == pytest.approx(x, rel=1e-8, abs=1e-8 * size)
        assert stepper["block.vx"] == pytest.approx(v, rel=1e-7, abs=1e-7 * size)
        assert (stepper["rub.sticking"] == 1) == (v == 0.0)


def test_an_action_acts_inside_a_step() -> None:
    def kick(_: kp.State) -> dict[str, float]:
        return {"F": 2.0}

    analysis = kp.Dynamics(1, events={"kick": kp.Event("t > 0.55", action=kick)})
    stepper = kp.Stepper(kp.Case(cart(), {"set": {"cart.x": 0, "cart.vx": 0}}), analysis)
    for _ in range(10):
        stepper.step(0.1)
    assert stepper["cart.x"] == pytest.approx(0.45**2, rel=1e-9)
    assert stepper.parameters["F"] == 2.0


def test_a_driver_is_released_inside_a_step() -> None:
    """A wheel that a driver accelerates at 3 rad/s² runs on at its speed."""
    m = kp.Model("wheel", gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=1, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.O")
    m.coordinate_driver("spin", "wheel.angle", value="1.5*t^2", release="t > 0.25")
    stepper = kp.Stepper(m)
    for _ in range(4):
        stepper.step(0.1)
    assert stepper["wheel.omega"] == pytest.approx(0.75, rel=1e-9)
    assert stepper["wheel.angle"] == pytest.approx(1.5 * 0.25**2 + 0.75 * 0.15, rel=1e-9)
    assert stepper.state.compiled.released == ("spin",)


def test_a_controller_in_a_loop_is_a_sampled_law() -> None:
    def control(x: float, v: float) -> float:
        return -3.0 * x - 0.7 * v

    start = {"set": {"cart.x": 1, "cart.vx": 0}}
    stepper = kp.Stepper(kp.Case(cart(), start))
    for _ in range(50):
        stepper.set("F", control(stepper["cart.x"], stepper["cart.vx"]))
        stepper.step(0.1)
    law = kp.Sampled(lambda _, state: control(state["cart.x"], state["cart.vx"]), period=0.1)
    held = cart(force=law)
    run = kp.dynamics(held, kp.assemble(held, start["set"]), t_end=5)
    assert stepper["cart.x"] == pytest.approx(run["cart.x"][-1], abs=1e-9)
    sampled = kp.Stepper(kp.Case(held, start))
    for dt in itertools.islice(itertools.cycle([0.03, 0.1, 0.07]), 75):
        sampled.step(dt)
    assert sampled["cart.x"] == pytest.approx(run["cart.x"][-1], abs=1e-9)


def test_a_case_is_stepped_with_the_options_of_its_analysis() -> None:
    case = pendulum()
    stepper = kp.Stepper(case, "swing")
    run = case.run()["swing"]
    for _ in range(100):
        stepper.step(0.01)
    assert stepper["rod.angle"] == pytest.approx(run["rod.angle"][100], abs=1e-7)
    with pytest.raises(kp.ModelError, match="swing"):
        kp.Stepper(case, "swung")


def test_an_analysis_after_another_one_starts_at_its_end() -> None:
    first, then = kp.Dynamics(0.5, name="first"), kp.Dynamics(1, name="then")
    case = kp.Case(cart(force=2.0), {"set": {"cart.x": 0, "cart.vx": 0}}, [first, then])
    stepper = kp.Stepper(case, "then")
    assert stepper.t == 0.5
    stepper.step(0.5)
    assert stepper["cart.x"] == pytest.approx(1.0, rel=1e-9)


def test_a_stiff_motion_keeps_its_implicit_method() -> None:
    """A damped slide follows its slow solution; explicit steps would be 1e5 times as many."""
    m = kp.Model("stiff", gravity=(0, 0), parameters={"F": 1.0})
    m.ground.points(O=(0, 0))
    m.body("cart", mass=1e-3, inertia=1, points={"S": (0, 0)})
    m.translational("rail", "ground.O", "cart.S")
    m.force("push", "cart.S", force=("F - 1e4*cart.vx - cart.x", 0))
    stepper = kp.Stepper(kp.Case(m, {"set": {"cart.x": 0, "cart.vx": 0}}))
    for _ in range(20):
        stepper.step(1.0)
    assert stepper["cart.x"] == pytest.approx(1 - math.exp(-20 / 1e4), rel=1e-6)


def test_energies_and_measures_are_those_of_a_run() -> None:
    case = kp.load("examples/four_bar.toml")
    model = case.model
    model.measures(load="C.force", rate="energy.kinetic - energy.dissipated")
    stepper = kp.Stepper(kp.Case(model, case._start))
    run = kp.dynamics(model, case.start(), t_end=0.5, output_step=0.1)
    assert stepper["energy.dissipated"] == 0.0
    for _ in range(5):
        stepper.step(0.1)
    names = ["energy.kinetic", "energy.potential", "energy.dissipated", "energy.work"]
    for name in [*names, "energy.total", "load", "rate", "C.force", "drift.position"]:
        assert stepper[name] == pytest.approx(run[name][-1], rel=1e-6, abs=1e-9), name
    for name in ("energy.balance", "spring.dissipated"):
        with pytest.raises(kp.ModelError):
            stepper[name]
