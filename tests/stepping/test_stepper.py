"""``kp.Stepper``: steps, inputs and events, compared with closed forms and with ``kp.dynamics``."""

import itertools
import math
import resource
import signal

import kempe as kp
import numpy as np
import pytest
from sizes import count
from stress.random_impacts import drawn

SCALES = [1e-3, 1.0, 1e3]


def cart(mass: float = 1.0, force: float | str = "F") -> kp.Model:
    """A cart on a rail, which a force pushes."""
    m = kp.Model("cart", gravity=(0, 0), parameters={"F": 0, "mass": mass})
    m.ground.points(O=(0, 0))
    m.body("cart", mass="mass", inertia=1, points={"S": (0, 0)})
    m.translational("rail", "ground.O", "cart.S")
    m.force("push", "cart.S", force=(force, 0))
    return m


def ball(height: float, restitution: float, g: float) -> kp.Case:
    """A ball that falls onto a floor."""
    m = kp.Model("ball", gravity=(0, -g))
    m.point_mass("ball", mass=1)
    m.stop("floor", "ball.y", lower=0.0, restitution=restitution)
    return kp.Case(m, {"set": {"ball.x": 0, "ball.y": height, "ball.vx": 0, "ball.vy": 0}})


def pendulum(**parameters: float) -> kp.Case:
    return kp.load("examples/pendulum.toml", parameters=parameters)


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
    assert stepper.t == pytest.approx(20 * dt, rel=1e-15)


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


@pytest.mark.parametrize("seed", range(count(24, 400)))
def test_steps_give_the_motion_of_a_run(seed: int) -> None:
    """Random mechanisms with friction, stops and contacts."""
    _, made, start = drawn(seed)
    dt, n = 0.02, 20
    run = kp.dynamics(made.model, start, t_end=n * dt, output_step=dt)
    case = kp.Case(made.model, {"set": made.set, "guess": made.guess})
    stepper = kp.Stepper(case)
    stepper.reset(start)
    times: dict[str, list[float]] = {name: [] for name in run.events}
    for name, event in stepper.events.items():  # those of the start
        times[name] += event.t.tolist()
    rates = max(1.0, abs(run.v).max())
    for _ in range(n):
        stepper.step(dt)
        for name, event in stepper.events.items():
            times[name] += event.t.tolist()
        k = np.flatnonzero(np.isclose(run.t, stepper.t, rtol=0, atol=1e-12))[-1]
        assert stepper.state.q == pytest.approx(run.q[k], abs=2e-6)
        assert stepper.state.v == pytest.approx(run.v[k], abs=2e-6 * rates)
    for name, event in run.events.items():
        assert times[name] == pytest.approx(event.t.tolist(), abs=1e-6), name


@pytest.mark.parametrize("seed", range(count(6, 100)))
def test_a_saved_state_continues_to_the_last_bit(seed: int) -> None:
    _, made, start = drawn(100 + seed)
    stepper = kp.Stepper(kp.Case(made.model, {"set": made.set, "guess": made.guess}))
    stepper.reset(start)
    for _ in range(7):
        stepper.step(0.013)
    saved = stepper.save()

    def course() -> list[bytes]:
        found = []
        for k in range(12):
            stepper.step(0.007 if k % 3 else 0.02)
            found += [stepper.state.q.tobytes(), stepper.state.v.tobytes()]
            found += [event.t.tobytes() for event in stepper.events.values()]
        return found

    first = course()
    stepper.restore(saved)
    assert stepper.t == saved.t
    assert course() == first
    other = kp.Stepper(kp.Case(made.model, {"set": made.set, "guess": made.guess}))
    other.restore(saved)
    stepper, later = other, first
    assert course() == later


def test_a_save_does_not_change_the_course() -> None:
    plain, saving = kp.Stepper(pendulum()), kp.Stepper(pendulum())
    for _ in range(100):
        plain.step(0.01)
        saving.save()
        saving.step(0.01)
    assert plain.state.q.tobytes() == saving.state.q.tobytes()


def test_reset_begins_again_with_the_inputs_of_the_case() -> None:
    stepper = kp.Stepper(kp.Case(cart(), {"set": {"cart.x": 0, "cart.vx": 0}}))
    stepper.set("F", 3.0)
    stepper.step(1.0)
    first = stepper["cart.x"]
    stepper.reset()
    assert (stepper.t, stepper["cart.x"], stepper.parameters["F"]) == (0, 0, 0)
    stepper.set("F", 3.0)
    stepper.step(1.0)
    assert stepper["cart.x"] == first == pytest.approx(1.5, rel=1e-12)
    other = kp.assemble(cart(), {"cart.x": 2, "cart.vx": 1})
    stepper.reset(other)
    stepper.step(1.0)
    assert stepper["cart.x"] == pytest.approx(3.0, rel=1e-12)


def test_a_length_that_opens_a_joint_is_refused_by_name() -> None:
    stepper = kp.Stepper(kp.load("examples/four_bar.toml"))
    stepper.step(0.1)
    before = stepper.state
    with pytest.raises(kp.AssemblyError, match=r"L2 = 27: .*joint . is open") as caught:
        stepper.set("L2", 27)
    assert caught.value.name in before.compiled.joints
    assert stepper.parameters["L2"] != 27
    assert (stepper.state.q == before.q).all()
    stepper.step(0.1)


def test_a_driver_that_would_jump_is_refused_by_name() -> None:
    m = kp.Model("wheel", gravity=(0, 0), parameters={"w": 2})
    m.ground.points(O=(0, 0))
    m.body("wheel", mass=1, inertia=1, points={"O": (0, 0)})
    m.revolute("pin", "ground.O", "wheel.O")
    m.coordinate_driver("spin", "wheel.angle", value="w*t")
    stepper = kp.Stepper(m)
    stepper.step(1.0)
    with pytest.raises(kp.AssemblyError, match=r"w = 3: .*driver spin is open by") as caught:
        stepper.set("w", 3)
    assert caught.value.name == "spin"
    assert "with_parameters({'w': 3})" in str(caught.value)
    stepper.step(1.0)
    assert stepper["wheel.angle"] == pytest.approx(4.0, rel=1e-9)


@pytest.mark.parametrize(
    ("parameter", "value", "told"),
    [
        ("f", 1.0, "F"),
        ("F", math.nan, "finite"),
        ("F", "1", "finite"),
        ("mass", -1.0, "mass"),
    ],
)
def test_an_impossible_input_is_refused(parameter: str, value: object, told: str) -> None:
    stepper = kp.Stepper(kp.Case(cart(), {"set": {"cart.x": 0, "cart.vx": 1}}))
    with pytest.raises(kp.ModelError, match=told):
        stepper.set(parameter, value)  # type: ignore[arg-type]
    stepper.step(1.0)
    assert stepper["cart.x"] == pytest.approx(1.0)


@pytest.mark.parametrize("dt", [0.0, -1.0, math.nan, math.inf, 1e-30, "1"])
def test_a_step_without_duration_is_refused(dt: float) -> None:
    stepper = kp.Stepper(kp.Case(cart(), {"set": {"cart.x": 0, "cart.vx": 1}}))
    stepper.step(1.0)
    with pytest.raises(kp.ModelError, match="dt"):
        stepper.step(dt)
    assert stepper.t == 1.0


def test_after_a_failed_step_the_state_is_that_before() -> None:
    """A force that has no value from x = 0.5 m on."""
    m = cart(force="F + sqrt(0.5 - t)")
    stepper = kp.Stepper(kp.Case(m, {"set": {"cart.x": 0, "cart.vx": 0}}))
    for _ in range(4):
        stepper.step(0.1)
    before, saved = stepper.state, stepper.save()
    with pytest.raises(kp.KempeError):
        stepper.step(0.2)
    assert stepper.t == before.t
    assert stepper.state.q.tobytes() == before.q.tobytes()
    stepper.step(0.05)
    after = stepper["cart.x"]
    stepper.restore(saved)
    stepper.step(0.05)
    assert stepper["cart.x"] == after


def test_an_error_of_a_law_leaves_the_state() -> None:
    calls = []

    def law(t: float, _: kp.State) -> float:
        calls.append(t)
        if t > 0.25:
            raise ValueError("no force")
        return 1.0

    stepper = kp.Stepper(kp.Case(cart(force=law), {"set": {"cart.x": 0, "cart.vx": 0}}))
    stepper.step(0.2)
    with pytest.raises(ValueError, match="no force"):
        stepper.step(0.2)
    assert stepper.t == 0.2
    stepper.step(0.05)
    assert stepper["cart.x"] == pytest.approx(0.25**2 / 2)


def test_stop_ends_a_step_and_later_steps_are_refused() -> None:
    analysis = kp.Dynamics(1, stop="cart.x > 0.25", events={"third": kp.Event("sin(20*t)", stop=3)})
    stepper = kp.Stepper(kp.Case(cart(force=0.0), {"set": {"cart.x": 0, "cart.vx": 1}}), analysis)
    stepper.step(0.2)
    assert stepper.stopped_by is None
    saved = stepper.save()
    stepper.step(0.2)
    assert (stepper.stopped_by, stepper.t) == ("stop", pytest.approx(0.25))
    with pytest.raises(kp.ModelError, match=r"event stop stopped the run at t = 0\.25"):
        stepper.step(0.2)
    stepper.restore(saved)
    assert stepper.stopped_by is None
    stepper.reset(kp.assemble(cart(), {"cart.x": -9, "cart.vx": 0}))
    for _ in range(20):  # the third zero is found across the steps
        stepper.step(0.04)
        if stepper.stopped_by:
            break
    assert (stepper.stopped_by, stepper.t) == ("third", pytest.approx(3 * np.pi / 20))


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


def test_a_state_of_another_mechanism_is_refused() -> None:
    stepper, other = kp.Stepper(pendulum()), kp.Stepper(pendulum(L=2))
    with pytest.raises(kp.ModelError, match="another model"):
        stepper.restore(other.save())
    with pytest.raises(kp.ModelError, match="save"):
        stepper.restore(1.0)  # type: ignore[arg-type]


def test_a_step_inside_an_action_is_refused() -> None:
    def again(_: kp.State) -> None:
        stepper.step(0.1)

    analysis = kp.Dynamics(1, events={"again": kp.Event("t > 0.05", action=again)})
    stepper = kp.Stepper(kp.Case(cart(), {"set": {"cart.x": 0, "cart.vx": 1}}), analysis)
    with pytest.raises(kp.ModelError, match="a step is under way"):
        stepper.step(0.1)
    assert stepper.t == 0.0


@pytest.mark.parametrize("name", ["cam_roller", "slamming_door", "four_bar"])
def test_there_are_events_before_the_first_step(name: str) -> None:
    """All by name, and none of them has occurred, also after a state is restored."""
    stepper = kp.Stepper(kp.load(f"examples/{name}.toml"))
    names = list(stepper.events)
    assert not any(len(event.t) for event in stepper.events.values())
    saved = stepper.save()
    stepper.step(0.5)
    assert list(stepper.events) == names
    stepper.restore(saved)
    assert list(stepper.events) == names
    assert not any(len(event.t) for event in stepper.events.values())


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="signals as POSIX has them")
def test_an_interruption_leaves_the_state_before_the_step() -> None:
    stepper = kp.Stepper(pendulum())
    stepper.step(0.5)
    before = stepper.state.q.tobytes()

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    old = signal.signal(signal.SIGALRM, interrupt)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(KeyboardInterrupt):
            stepper.step(1e5)
    finally:
        signal.signal(signal.SIGALRM, old)
    assert (stepper.t, stepper.state.q.tobytes()) == (0.5, before)
    stepper.step(0.1)


def test_the_memory_of_many_steps_is_flat() -> None:
    stepper = kp.Stepper(pendulum())
    for _ in range(2_000):
        stepper.step(0.01)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for k in range(count(20_000, 100_000)):
        stepper.step(0.01)
        if k % 100 == 0:
            stepper.set("L", 1.0)
            _ = stepper["rod.angle"], stepper.events
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 1024, f"{grown} KiB"
