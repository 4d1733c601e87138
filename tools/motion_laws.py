"""The figure of docs/laws.md: a slide driven by each motion law.

Run ``.venv/bin/python tools/motion_laws.py``; it writes ``docs/images/motion_laws.png``.
"""

from pathlib import Path

import kempe as kp
import matplotlib.pyplot as plt

LAWS = ("harmonic", "cycloidal", "modified_sine", "modified_trapezoid", "poly345", "poly4567")
TARGET = Path(__file__).parents[1] / "docs" / "images" / "motion_laws.png"


def motion(law: str) -> kp.Solution:
    """A slide that follows a law of s = t in 1 s."""
    m = kp.Model(law)
    m.ground.points(O=(0, 0))
    m.body("slide", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("guide", "ground.O", "slide.P")
    m.coordinate_driver("cam", "slide.x", value=f"{law}(t)")
    return kp.dynamics(m, kp.assemble(m), t_end=1, output_step=0.0025)


def main() -> None:
    """Draw all laws."""
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8), layout="constrained")
    for law in LAWS:
        sol = motion(law)
        for ax, column in zip(axes, ("slide.x", "slide.vx", "slide.ax"), strict=True):
            ax.plot(sol.t, sol[column], label=law, linewidth=1.4)
    for ax, title in zip(axes, ("y", "y′", "y″"), strict=True):
        ax.set(xlabel="s", title=title, xlim=(0, 1))
        ax.grid(visible=True, linewidth=0.4)
    axes[0].legend(frameon=False)
    figure.savefig(TARGET, dpi=110)


if __name__ == "__main__":
    main()
