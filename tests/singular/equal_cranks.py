"""Random sets of equal cranks on one rod, through their change points, against a pendulum.

Two to five equal and parallel cranks carry a rod, which moves without turning. With the angle φ of
the cranks, their masses m and length L, the mass M of the rod and a torsional spring k on the
first:

    (Σ m L²/3 + M L²) φ'' = -(Σ m L/2 + M L) g cos φ - k (φ - φ0)

From three cranks on, constraints are redundant. All links are in line at φ = 0 and φ = π, where the
rod could also turn: the velocity decides. Run as a module, it prints the outcome of 200 sets.
"""

from __future__ import annotations

import warnings
from collections import Counter
from dataclasses import dataclass

import kempe as kp
import numpy as np
from scipy.integrate import solve_ivp

G = 9.81
T_END = 4.0
KINDS = ("free", "spring", "driver")
#: A larger error of an angle, rad, is another motion; the largest that occurs is 3e-6.
ASTRAY = 1e-5


@dataclass(frozen=True)
class Cranks:
    """A set of equal cranks.

    Attributes:
        model, start: with ``redundancy="allow"``.
        number: of cranks.
        angle, rate: of the cranks at the start, rad and rad/s.
        inertia, weight, stiffness: of the pendulum, kg m^2, N m and N m/rad.
        driven: whether the rate is given by a driver.
    """

    model: kp.Model
    start: kp.State
    number: int
    angle: float
    rate: float
    inertia: float
    weight: float
    stiffness: float
    driven: bool

    def truth(self, t: np.ndarray) -> np.ndarray:
        """The angle at the times."""
        if self.driven:
            return self.angle + self.rate * t

        def slope(_: float, y: np.ndarray) -> tuple[float, float]:
            torque = -self.weight * np.cos(y[0]) - self.stiffness * (y[0] - self.angle)
            return y[1], torque / self.inertia

        begin, span = (self.angle, self.rate), (t[0], t[-1])
        found = solve_ivp(slope, span, begin, method="DOP853", t_eval=t, rtol=1e-13, atol=1e-13)
        assert found.success
        return np.asarray(found.y[0])


def cranks(seed: int, redundancy: str = "allow", number: int | None = None) -> Cranks:
    """The set of a seed: free, with a spring or driven."""
    rng, kind = np.random.default_rng(seed), KINDS[seed % len(KINDS)]
    number = int(rng.integers(2, 6)) if number is None else number
    places = np.concatenate([[0.0], np.cumsum(rng.uniform(0.4, 1.6, number - 1))])
    length, masses = float(rng.uniform(0.3, 1.5)), rng.uniform(0.2, 3.0, number)
    mass, inertia = float(rng.uniform(0.2, 5.0)), float(rng.uniform(0.1, 2.0))
    angle = float(rng.uniform(-np.pi, np.pi))
    rate = float(rng.choice([-1, 1]) * rng.uniform(0.5, 8.0))
    stiffness = float(rng.uniform(5.0, 60.0)) if kind == "spring" else 0.0
    m = kp.Model("equal cranks", gravity=(0, -G), redundancy=redundancy)
    m.ground.points(**{f"G{k}": (x, 0.0) for k, x in enumerate(places)})
    points = {f"P{k}": (x, 0.0) for k, x in enumerate(places)}
    m.body("rod", mass=mass, inertia=inertia, points=points)
    for k in range(number):
        m.bar(f"crank{k}", mass=float(masses[k]), length=length, ends=("A", "B"))
        m.revolute(f"A{k}", f"ground.G{k}", f"crank{k}.A")
        m.revolute(f"B{k}", f"crank{k}.B", f"rod.P{k}")
    held: dict[str, float | str] = {"crank0.angle": angle, "crank0.omega": rate}
    guess: dict[str, float | str] = {f"crank{k}.angle": angle for k in range(number)}
    guess["rod.angle"] = 0.0
    if kind == "driver":
        m.coordinate_driver("motor", "crank0.angle", value=f"({angle!r}) + ({rate!r})*t")
        held = {}
    else:
        del guess["crank0.angle"]
    if kind == "spring":
        m.torsion_spring("spring", "ground", "crank0", stiffness=stiffness, free_angle=angle)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", kp.AssemblyWarning)
        start = kp.assemble(m, set=held, guess=guess)
    about = float(masses.sum() * length**2 / 3 + mass * length**2)
    weight = float(G * (masses.sum() * length / 2 + mass * length))
    driven = kind == "driver"
    return Cranks(m, start, number, angle, rate, about, weight, stiffness, driven)


def error(of: Cranks, sol: kp.Solution) -> float:
    """Largest error of the angle of a crank or of the rod, rad."""
    truth = of.truth(sol.t)
    each = [np.abs(sol[f"crank{k}"].angle - truth).max() for k in range(of.number)]
    return float(max(*each, np.abs(sol["rod"].angle).max()))


def run(of: Cranks, **options: object) -> kp.Solution:
    """The motion of a set."""
    return kp.dynamics(of.model, of.start, t_end=T_END, output_step=0.02, **options)


def outcome(seed: int) -> tuple[str, str]:
    """Whether a set passed, stopped with an error or is wrong; and by how much, or why."""
    of = cranks(seed)
    try:
        off = error(of, run(of))
    except kp.KempeError as failure:
        return "stopped", f"{type(failure).__name__}: {failure}"
    return ("passed" if off < ASTRAY else "wrong"), f"{off:.1e} rad"


def main() -> None:
    """Print the outcome of 200 sets."""
    counts: Counter[str] = Counter()
    largest = 0.0
    for seed in range(200):
        what, why = outcome(seed)
        counts[what] += 1
        if what == "passed":
            largest = max(largest, float(why.split()[0]))
        else:
            print(f"{KINDS[seed % len(KINDS)]} set {seed} {what}: {why}")
    print(f"{dict(counts)}, largest error of those that passed {largest:.1e} rad")


if __name__ == "__main__":
    main()
