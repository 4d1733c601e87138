"""Many contacts with friction that press, stick and slide at once, against the laws of contact."""

import kempe as kp
import numpy as np
import pytest
from sizes import FULL

G = 9.81
SCALES = [(1.0, 1.0), (1e3, 1e-3), (1e-3, 1e3)]
#: Seeds whose modes were not found, each by another fault of the search.
HARD = [(3, 0, SCALES[0]), (4, 21, SCALES[1]), (5, 1, SCALES[2]), (5, 19, SCALES[1])]
ALL = [(n, k, SCALES[k % 3]) for n in range(3, 8) for k in range(24)]
MU = 0.3


@pytest.mark.parametrize(("count", "seed", "scale"), ALL if FULL else HARD)
def test_discs_in_a_box_keep_the_laws(count: int, seed: int, scale: tuple[float, float]) -> None:
    mass, size = scale
    m, at = discs(count, seed, (mass, size))
    start = kp.assemble(m, set=at)
    sol = kp.dynamics(m, start, t_end=3 * np.sqrt(size), output_step=0.01 * np.sqrt(size))
    total = sol.energy.total
    assert np.all(np.diff(total) < 1e-8 * np.max(np.abs(total)))
    weight, speed = 10 * mass * G, np.sqrt(G * size)
    for name in m.forces:
        normal, along, slip = (sol[f"{name}.{of}"] for of in ("force", "tangential", "sliding"))
        assert np.min(sol[f"{name}.gap"]) > -1e-8 * size, name
        assert np.min(normal) > -1e-9 * weight, name
        assert np.all(np.abs(along) <= MU * normal + 1e-8 * weight), name
        slides = (normal > 1e-6 * weight) & (np.abs(slip) > 1e-5 * speed)
        limit = MU * np.where(slides, normal, 0) * np.sign(slip)
        assert np.abs(np.where(slides, along, 0) - limit).max() < 1e-8 * weight, name


def discs(count: int, seed: int, scale: tuple[float, float]) -> tuple[kp.Model, dict[str, float]]:
    """Discs without restitution in a box, in one time unit for all sizes."""
    (mass, size), rng = scale, np.random.default_rng(seed)
    m = kp.Model("box", gravity=(0, -G))
    wide = (0.9 * count + 0.5) * size
    corners = [(0, 0), (0, 5 * size), (wide, 5 * size), (wide, 0)]
    sides = zip(corners, corners[1:] + corners[:1], strict=True)
    # the inside is at the right of each wall
    m.ground.curves(**{f"w{k}": {"line": ends} for k, ends in enumerate(sides)})
    at: dict[str, float] = {}
    for k in range(count):
        r, own = rng.uniform(0.3, 0.45) * size, mass * 10 ** rng.uniform(-1, 1)
        rim = {"rim": {"circle": (0, 0, r)}}
        m.body(f"d{k}", mass=own, inertia=0.5 * own * r**2, points={"C": (0, 0)}, curves=rim)
        others = [f"ground.w{wall}" for wall in range(4)] + [f"d{other}.rim" for other in range(k)]
        for other in others:
            name = f"d{k}_{other.replace('.', '_')}"
            m.contact(name, f"d{k}.C", other, radius=r, friction=MU, restitution=0)
        place = ((0.5 + 0.9 * k) * size, rng.uniform(0.5, 1.5) * size, 0)
        vx, vy, omega = rng.normal(0, 2, 3) * np.sqrt(size)
        rates = (vx, vy, omega / size)
        names = ("x", "y", "angle", "vx", "vy", "omega")
        at |= {f"d{k}.{of}": float(x) for of, x in zip(names, (*place, *rates), strict=True)}
    return m, at
