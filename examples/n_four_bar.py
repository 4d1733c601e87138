"""N parallelograms in a row, the N-four-bar of the IFToMM benchmarks (A02).

    python examples/n_four_bar.py 40

N + 1 cranks on ground are connected by N couplers. All of them are uniform rods of 1 m and 1 kg.
The cranks start upright and turn at -1 rad/s. Whenever all bars lie on one line, the mechanism has
N + 1 degrees of freedom instead of one. The velocity determines the branch, and all windows remain
parallelograms. The mechanism therefore moves like a single crank with the mass of all bars, and the
energy gives its rate at every angle.
"""

from __future__ import annotations

import sys

import kempe as kp
import numpy as np

GRAVITY = 9.81


def windows(n: int) -> kp.Model:
    """N windows."""
    m = kp.Model(f"{n} windows", gravity=(0, -GRAVITY))
    m.ground.points(**{f"P{k}": (k, 0) for k in range(n + 1)})
    for k in range(n + 1):
        m.bar(f"crank{k}", mass=1, length=1, ends=("A", "B"))
    for k in range(n):
        m.bar(f"coupler{k}", mass=1, length=1, ends=("B", "C"))
    for k in range(n + 1):
        m.revolute(f"A{k}", f"ground.P{k}", f"crank{k}.A")
    for k in range(n):
        m.revolute(f"B{k}", f"crank{k}.B", f"coupler{k}.B")
        m.revolute(f"C{k}", f"coupler{k}.C", f"crank{k + 1}.B")
    return m


def upright(model: kp.Model, n: int) -> kp.State:
    """Cranks upright, turning at -1 rad/s."""
    level: dict[str, float | str] = {f"coupler{k}.angle": 0 for k in range(n)}
    return kp.assemble(model, set={"crank0.angle": "90*deg", "crank0.omega": -1}, guess=level)


def rate(angle: np.ndarray, n: int) -> np.ndarray:
    """Rate of the cranks from the conserved energy J ω² / 2 + W sin φ, rad/s."""
    inertia = (n + 1) / 3 + n
    weight = GRAVITY * ((n + 1) / 2 + n)
    return np.sqrt(1 + 2 * weight * (1 - np.sin(angle)) / inertia)


def main() -> None:
    """Simulate ten seconds and print the error of the rates."""
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    model = windows(n)
    sol = kp.dynamics(model, upright(model, n), t_end=10, output_step=0.01, dense_output=False)
    off = max(
        np.abs(np.abs(sol[f"crank{k}"].omega) - rate(sol[f"crank{k}"].angle, n)).max()
        for k in range(n + 1)
    )
    steps, ms = sol.statistics["steps"], 1e3 * sol.statistics["seconds"]
    print(f"{n} windows, {sol.q.shape[1]} coordinates: {steps} steps, {ms:.1f} ms")
    print(f"turns at t = 10 s: {(np.pi / 2 - sol['crank0'].angle[-1]) / (2 * np.pi):.6f}")
    print(f"largest error of the rates by the energy: {off:.1e} rad/s")


if __name__ == "__main__":
    main()
