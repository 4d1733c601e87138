"""``kp.Stepper``: saved states, inputs that are refused, and steps that fail."""

import math
import resource
import signal
import warnings

import kempe as kp
import numpy as np
import pytest
from sizes import count
from stepping.machines import cart, pendulum
from stress.random_impacts import drawn


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


def test_a_state_of_another_mechanism_is_refused() -> None:
    stepper, other = kp.Stepper(pendulum()), kp.Stepper(pendulum(L=2))
    with pytest.raises(kp.ModelError, match="another model"):
        stepper.restore(other.save())
    with pytest.raises(kp.ModelError, match="save"):
        stepper.restore(1.0)  # type: ignore[arg-type]


def test_a_start_of_other_lengths_is_refused_by_reset() -> None:
    stepper, other = kp.Stepper(pendulum()), pendulum(L=2).start()
    stepper.step(0.1)
    before = stepper.state.q.tobytes()
    with pytest.raises(kp.AssemblyError, match="is open by"):
        stepper.reset(other)
    assert (stepper.t, stepper.state.q.tobytes()) == (0.1, before)
    stepper.step(0.1)
    stepper.reset()
    assert stepper.t == 0.0


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


class Integral:
    """A controller with a memory."""

    def __init__(self) -> None:
        self.sum = 0.0

    def reset(self) -> None:
        self.sum = 0.0

    def __call__(self, _: float, state: kp.State) -> float:
        self.sum += 0.1 * (1.0 - float(state["cart.x"]))
        return self.sum


def test_a_controller_of_another_run_or_time_is_named() -> None:
    case = kp.Case(cart(force=kp.Sampled(Integral(), 0.1)), {"set": {"cart.x": 0, "cart.vx": 0}})
    stepper = kp.Stepper(case)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        saved = stepper.save()
        stepper.restore(saved)
        stepper.step(0.3)
        stepper.reset()
        stepper.step(0.3)
    with pytest.warns(kp.FunctionWarning, match=r"not that of t = 0 s"):
        stepper.restore(saved)
    kp.dynamics(case.model, case.start(), t_end=0.2)
    with pytest.warns(kp.FunctionWarning, match="another run has used the controller"):
        stepper.step(0.1)
