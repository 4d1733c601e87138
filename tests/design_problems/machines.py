"""Machines whose best design has a closed form, over masses, sizes and rates."""

import kempe as kp
import numpy as np
from scipy.optimize import brentq

#: (mass, size, rate) by which a machine is scaled.
SCALES = [(1.0, 1.0, 1.0), (1e3, 1e-3, 10.0), (1e-3, 1e3, 0.1), (50.0, 0.2, 30.0)]


def four_bar(
    mass: float, size: float, rate: float, gravity: float = 0.0
) -> tuple[kp.Case, dict[str, float]]:
    """A driven four-bar linkage with counterweights, and their places for a full force balance.

    Berkof and Lowen (1969): the mass of the uniform coupler counts half at each of its ends, so
    that each crank with its counterweight must have its mass centre in its bearing.
    """
    lengths, masses = np.array([0.3, 1.0, 0.7]) * size, np.array([2.0, 5.0, 3.0]) * mass
    weight = 4.0 * mass
    m = kp.Model(
        "balanced four-bar",
        gravity=(0, -gravity),
        parameters={"front": 0.1 * size, "rear": -0.2 * size},
    )
    m.ground.points(A=(0, 0), D=(0.9 * size, 0))
    for name, length, of, ends in zip(
        ("crank", "coupler", "rocker"), lengths, masses, ("AB", "BC", "DC"), strict=True
    ):
        extra = {"W": ("front" if name == "crank" else "rear", 0)} if name != "coupler" else {}
        points = {ends[0]: (0, 0), ends[1]: (length, 0)} | extra
        shapes = [{"type": "rod", "length": length, "at": [length / 2, 0], "mass": of}]
        if extra:
            radius = {"type": "disc", "radius": 1e-3 * size, "mass": weight}
            shapes.append({**radius, "at": [extra["W"][0], 0]})
        m.body(name, shapes=shapes, points=points)
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    m.coordinate_driver("drive", "crank.angle", value=f"{rate}*t")
    m.measures(shake_x="A.fx + D.fx", shake_y="A.fy + D.fy")
    analysis = kp.InverseDynamics(t_end=2 * np.pi / rate, output_step=2 * np.pi / rate / 36)
    case = kp.Case(m, {"guess": {"coupler.angle": 0.6, "rocker.angle": 1.6}}, [analysis])
    best = {
        "front": -(masses[0] + masses[1]) * lengths[0] / 2 / weight,
        "rear": -(masses[2] + masses[1]) * lengths[2] / 2 / weight,
    }
    return case, best


def slider_crank(mass: float, size: float, rate: float) -> tuple[kp.Case, dict[str, float]]:
    """A fast slider-crank with a spring at its slider, and the spring with the least rms torque.

    The torque of the drive is -x′ (m ẍ + k (x - x₀)). It is linear in k and in k x₀, so that the
    least mean square follows from two linear equations, here by an exact quadrature.
    """
    crank, rod, slider = 0.1 * size, 0.35 * size, 3.0 * mass
    parameters = {"k": slider * rate**2, "free": 0.3 * size}
    m = kp.Model("slider-crank with a spring", parameters=parameters)
    m.ground.points(O=(0, 0), W=(0, 0))
    m.body("crank", mass=0, inertia=0, points={"O": (0, 0), "B": (crank, 0)})
    m.body("rod", mass=0, inertia=0, points={"B": (0, 0), "S": (rod, 0)})
    m.body("slider", mass=slider, inertia=slider * size**2, points={"S": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("B", "crank.B", "rod.B")
    m.revolute("S", "rod.S", "slider.S")
    m.translational("guide", "ground.O", "slider.S")
    m.spring_damper("spring", "ground.W", "slider.S", stiffness="k", free_length="free")
    m.coordinate_driver("drive", "crank.angle", value=f"{rate}*t")
    turn = 2 * np.pi / rate
    case = kp.Case(m, None, [kp.InverseDynamics(t_end=turn, output_step=turn / 200)])
    phi = 2 * np.pi * np.arange(4096) / 4096
    root = np.sqrt(rod**2 - (crank * np.sin(phi)) ** 2)
    x = crank * np.cos(phi) + root
    slope = -crank * np.sin(phi) - crank**2 * np.sin(phi) * np.cos(phi) / root
    wave = np.fft.rfft(x) * -(np.arange(2049.0) ** 2)
    columns = np.stack([slope * x, -slope], axis=1)
    inertia = slope * slider * rate**2 * np.fft.irfft(wave)
    k, force = np.linalg.lstsq(columns, -inertia, rcond=None)[0]
    return case, {"k": k, "free": force / k}


def lamp(mass: float, size: float, g: float, n: int = 45) -> tuple[kp.Case, dict[str, float]]:
    """A lamp on an arm that a spring holds in every position, and the spring.

    A spring of free length zero from a point at height h above the hinge to a point of the arm at r
    has the moment k h r cos φ about the hinge, the weight -m g a cos φ. So the number `n`
    of positions does not matter.
    """
    arm, height, at = 0.8 * size, 0.3 * size, 0.25 * size
    exact = mass * g * arm / (height * at)
    parameters = {"k": 0.4 * exact, "free": 0.1 * size}
    m = kp.Model("lamp", gravity=(0, -g), parameters=parameters)
    m.ground.points(O=(0, 0), H=(0, height))
    m.body(
        "arm", mass=mass, inertia=0.01 * mass * size**2, center=(arm, 0),
        points={"O": (0, 0), "S": (at, 0)},
    )  # fmt: skip
    m.revolute("hinge", "ground.O", "arm.O")
    m.spring_damper("spring", "ground.H", "arm.S", stiffness="k", free_length="free")
    over = kp.InverseDynamics(over="arm.angle", range=(-1.0, 1.2), n=n, static=True)
    return kp.Case(m, {"set": {"arm.angle": -1.0}}, [over]), {"k": exact, "free": 0.0}


def absorber(mass: float, size: float, rate: float) -> tuple[kp.Case, dict[str, float], float]:
    """A pendulum without gravity on a spring with a damper, which stop it within 0.4 rad.

    Also the stiffness, the damping and the torque of the absorber with the least peak. With the
    damping ratio cos θ and cot = cot θ, the largest angle is rate/ω exp(-θ cot), and the
    peak of the torque J rate ω exp(-(3 θ - π) cot). Their product is least at 2 sin 2θ = 4 θ - π.
    """
    inertia, most = mass * size**2, 0.4
    theta = brentq(lambda x: 2 * np.sin(2 * x) - 4 * x + np.pi, 1.0, 1.4)
    cot = 1 / np.tan(theta)
    omega = rate / most * np.exp(-theta * cot)
    exact = {"k": inertia * omega**2, "c": 2 * np.cos(theta) * inertia * omega}
    m = kp.Model("pendulum impact absorber", parameters={"k": 2 * exact["k"], "c": exact["c"]})
    m.ground.points(O=(0, 0))
    m.body("pendulum", mass=mass, inertia=inertia, points={"O": (0, 0)})
    m.revolute("hinge", "ground.O", "pendulum.O")
    m.torsion_spring("absorber", "ground", "pendulum", stiffness="k", damping="c")
    start = {"set": {"pendulum.angle": 0, "pendulum.omega": rate}}
    case = kp.Case(m, start, [kp.Dynamics(t_end=4 * most / rate)])
    return case, exact, inertia * rate * omega * np.exp(-(3 * theta - np.pi) * cot)


def path_generator(first: float, last: float) -> kp.Case:
    """A four-bar linkage over the angle of its crank; names of lengths as in the literature."""
    lengths = {"r1": 14.0, "r2": 2.5, "r3": 13.0, "r4": 13.0, "rcx": 2.0, "rcy": 0.5}
    m = kp.Model("path generator", parameters=lengths)
    m.ground.points(A=(0, 0), D=("r1", 0))
    m.bar("crank", mass=1, length="r2", ends=("A", "B"))
    points = {"B": (0, 0), "C": ("r3", 0), "P": ("rcx", "rcy")}
    m.body("coupler", mass=1, inertia=1, points=points)
    m.bar("rocker", mass=1, length="r4", ends=("D", "C"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    turn = kp.Kinematics(name="turn", over="crank.angle", range=(first, last), n=25)
    start = {"set": {"crank.angle": first}, "guess": {"coupler.angle": 0.5, "rocker.angle": 1.5}}
    return kp.Case(m, start, [turn])


def free_path_generator(**values: float) -> kp.Case:
    """The same over a whole turn, with a ground that has a free place (x0, y0) and turn."""
    case = path_generator(0, 2 * np.pi)
    values = {"x0": 0.0, "y0": 0.0, "turn": 0.0, **values}
    m = kp.Model("free", parameters=values)
    m.ground.points(A=("x0", "y0"), D=("x0 + r1*cos(turn)", "y0 + r1*sin(turn)"))
    m.bar("crank", mass=1, length="r2", ends=("A", "B"))
    m.bar("rocker", mass=1, length="r4", ends=("D", "C"))
    points = {"B": (0, 0), "C": ("r3", 0), "P": ("rcx", "rcy")}
    m.body("coupler", mass=1, inertia=1, points=points)
    for name, i, j in (("A", "ground", "crank"), ("B", "crank", "coupler"),
                       ("C", "coupler", "rocker"), ("D", "ground", "rocker")):  # fmt: skip
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    return kp.Case(m, case._start, case.analyses)
