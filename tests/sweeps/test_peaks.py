"""Extreme values of sweeps, whose variants look closer only where a value may exceed the others."""

import time
from statistics import median

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from quiet import within
from sizes import only_full

STATISTICS = ("max", "min", "peak", "t_max", "t_min")


def linkage(draw: np.random.Generator) -> kp.Case:
    """A pendulum, a double pendulum or a four-bar with a spring, of random mass, size and rate."""
    mass, size, rate = 10.0 ** draw.uniform([-3, -3, -1], [3, 3, 1])
    m = kp.Model("random", gravity=(0, -9.81 * size * rate**2), parameters={"part": 1.0})
    m.ground.points(A=(0, 0), D=(1.9 * size, 0))
    length = size * draw.uniform(0.7, 1.1)
    m.bar("first", mass=f"{mass}*part", length=length, ends=("A", "B"))
    m.revolute("A", "ground.A", "first.A")
    kind = draw.integers(3)
    start = {"first.angle": draw.uniform(-1, 2), "first.omega": draw.uniform(-4, 4) * rate}
    guess = {}
    if kind:
        m.bar("second", mass=mass, length=size * draw.uniform(1.3, 1.8), ends=("B", "C"))
        m.revolute("B", "first.B", "second.B")
        guess = {"second.angle": 0.2}
    if kind == 2:
        m.bar("third", mass=mass, length=size * draw.uniform(1.3, 1.8), ends=("C", "D"))
        m.revolute("C", "second.C", "third.C")
        m.revolute("D", "third.D", "ground.D")
        guess["third.angle"] = -1.5
    stiffness = mass * (size * rate) ** 2 * draw.uniform(1, 50)
    damping = 0.1 * draw.integers(2) * stiffness / rate
    m.torsion_spring("spring", "ground", "first", stiffness=stiffness, damping=damping)
    end = draw.uniform(2, 6) / rate
    step = draw.choice([end / 50, end / 33.3, end / 400])
    run = kp.Dynamics(t_end=end, output_step=step, method=draw.choice([kp.Auto(), kp.RK45()]))
    return kp.Case(m, {"set": start, "guess": guess}, [run])


def compare(seed: int) -> None:
    """Extreme values equal those of a single run, and those of 20 000 instants."""
    case = linkage(np.random.default_rng(seed))
    names = ("A.force", "first.angle", "first.alpha")
    texts = [f"{name}.{of}" for name in names for of in STATISTICS]
    case.model.measures({f"one{k}": name for k, name in enumerate(names)})
    found = kp.sweep(case, {"part": [1.0, 1.2, 0.9, 1.7]}, texts, workers=1)
    for k in range(0, 4, 3):
        if k in found.reasons:
            continue
        solution = found.run(k)
        for place, name in enumerate(names):
            measure = solution.measure(f"one{place}")
            expected = [getattr(measure, of) for of in STATISTICS]
            given = [found[f"{name}.{of}"][k] for of in STATISTICS]
            np.testing.assert_allclose(given, expected, rtol=1e-12, atol=0)
            values = solution(np.linspace(0, solution.t[-1], 20_001))[f"one{place}"]
            room = 1e-6 * np.ptp(values) + 1e-9 * np.abs(values).max()
            assert found[f"{name}.max"][k] >= values.max() - room
            if name != "A.force":  # a magnitude may have a kink at its least value
                assert found[f"{name}.min"][k] <= values.min() + room


@pytest.mark.parametrize("seed", range(12))
def test_random_linkages(seed: int) -> None:
    compare(seed)


@only_full
@pytest.mark.parametrize("seed", range(100, 400))
def test_many_random_linkages(seed: int) -> None:
    compare(seed)


@pytest.mark.alone
def test_a_peak_costs_at_most_three_final_values() -> None:
    """The flagship by the default method, medians of alternating sweeps on one thread."""
    case = kp.load(ROOT / "examples" / "four_bar.toml")
    case = case.with_analysis("release", method=kp.Auto(), stabilization=kp.Projection())

    def spent(measure: str) -> float:
        began = time.process_time()
        kp.sweep(case, {"k": np.linspace(5e5, 2e6, 32)}, [measure], workers=1)
        return time.process_time() - began

    def ratio() -> float:
        turns = [(spent("C.force.final"), spent("C.force.max")) for _ in range(9)]
        final, peak = (median(times) for times in zip(*turns, strict=True))
        return peak / final

    assert within(3.0, ratio)  # 2.4 without other work on the machine; it was 4.9
