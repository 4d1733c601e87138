"""Small mechanisms in which each force matters to the motion, with all its numbers as variables."""

from typing import Any

import kempe as kp
from gradients.catalogue_joints import Made, Maker, Units

RESTS = ("dynamics", "equilibrium")


def pendulum(of: Units, **given: tuple[float, float]) -> kp.Model:
    """A bar on a pin, with a fixed point beside it."""
    m = of.model(L=(1, of.size), m=(1, of.mass), **given)
    m.ground.points(O=(0, 0), Q=(0.9 * of.size, 0.5 * of.size))
    m.bar("bar", mass="m", length="L", ends=("O", "A"))
    m.revolute("O", "ground.O", "bar.O")
    return m


def swing(of: Units) -> dict[str, float]:
    return {"bar.angle": of.near(-0.8), "bar.omega": of.near(0.7) * of.rate}


def spiral(of: Units) -> Made:
    """A spring whose numbers are laws."""
    k, c = of.torque, of.torque / of.rate
    m = pendulum(of, k=(2, k), k3=(0.5, k), c=(0.3, c), free=(0.2, 1), dfree=(0.1, 1), p=(0.2, k))
    w = of.rate
    m.torsion_spring(
        "spiral",
        "ground",
        "bar",
        stiffness="k + k3 * angle^2",
        damping="c * (1 + 0.1 * angle)",
        free_angle=f"free + dfree * sin({w} * t)",
        preload="p",
    )
    measures = ["bar.angle.final", "spiral.torque.max", "O.force.final"]
    measures += ["spiral.dissipated.final", "spiral.power.integral"]
    return Made(m, measures, swing(of), end=2.0, analyses=RESTS)


def coil(of: Units) -> Made:
    """A spring and damper with laws; a rope beside it slackens and tightens."""
    k, c, s = of.stiffness, of.damping, of.size
    m = pendulum(
        of,
        k=(8, k),
        k3=(2, k / s),
        c=(0.3, c),
        free=(0.7, s),
        p=(0.2, of.force),
        kr=(20, k),
        lr=(1.3, s),
        cr=(0.1, c),
    )
    m.spring_damper(
        "coil",
        "ground.Q",
        "bar.A",
        stiffness="k + k3 * length",
        damping="c",
        free_length="free",
        preload="p",
    )
    m.spring_damper(
        "rope", "ground.Q", "bar.A", stiffness="kr", free_length="lr", damping="cr", only="tension"
    )
    measures = ["bar.angle.final", "coil.force.max", "rope.force.min"]
    measures += ["coil.dissipated.final", "O.force.final", "coil.rate.final"]
    return Made(m, measures, swing(of), end=2.5, changes=True)


def resting_coil(of: Units) -> Made:
    """A spring that holds a bar."""
    k, s = of.stiffness, of.size
    m = pendulum(of, k=(8, k), free=(0.5, s), p=(0.2, of.force))
    m.spring_damper("coil", "ground.Q", "bar.A", stiffness="k", free_length="free", preload="p")
    return Made(
        m,
        ["bar.angle.final", "coil.force.max", "coil.energy.final"],
        swing(of),
        end=2.5,
        analyses=RESTS,
    )


def turned(of: Units) -> Made:
    """A torque between two bars that depends on the time and on the motion."""
    m = pendulum(of, T=(0.6, of.torque), w=(3, of.rate), c=(0.2, of.torque / of.rate))
    of.bar(m, "two", 0.6 * of.size, ("A", "B"))
    m.revolute("A", "bar.A", "two.A")
    m.torque("motor", "two", torque="T * sin(w * t) - c * omega", i="bar")
    measures = ["two.angle.final", "motor.torque.max", "motor.power.final", "energy.work.final"]
    return Made(m, [*measures, "A.force.final"], swing(of) | {"two.angle": -0.3})


def pushed(of: Units) -> Made:
    """A force on a point, in one of three frames."""
    m = pendulum(of, fx=(0.5, of.force), fy=(0.4, of.force), w=(2, of.rate))
    of.bar(m, "two", 0.6 * of.size, ("A", "B"))
    m.revolute("A", "bar.A", "two.A")
    frame = ("global", "i", "j")[int(of.draw.integers(3))]
    m.force("push", "two.B", force=["fx * cos(w * t)", "fy"], i="bar", frame=frame)
    measures = ["two.angle.final", "push.fx.final", "push.power.integral", "O.force.max"]
    return Made(m, measures, swing(of) | {"two.angle": -0.3})


def pulled(of: Units) -> Made:
    """An actuator whose force follows its length, its rate and a table."""
    m = pendulum(of, F=(0.8, of.force), k=(2, of.stiffness), c=(0.2, of.damping))
    m.table(
        "pulse",
        x=[0, 1, 2, 3, 4],
        y=[0, 0.6, -0.2, 0.9, 0.1],
        interpolation="cubic",
        outside="hold",
    )
    law = f"F * pulse({of.rate} * t) - k * (length - {of.size}) - c * rate"
    m.actuator("jack", "ground.Q", "bar.A", force=law)
    measures = ["bar.angle.final", "jack.force.max", "jack.power.integral", "energy.work.final"]
    return Made(m, [*measures, "jack.length.final"], swing(of), end=2.5)


def padded(of: Units) -> Made:
    """A body on a bushing, which hangs from a bar."""
    k, c, s = of.stiffness, of.damping, of.size
    m = pendulum(
        of, kx=(30, k), ky=(20, k), kt=(2, of.torque), cx=(1, c), cy=(0.5, c), ct=(0.2, c * s**2)
    )
    of.disc(m, "pad", {"P": (0.1 * s, 0.05 * s)})
    m.bushing("bush", "bar.A", "pad.P", stiffness=("kx", "ky", "kt"), damping=("cx", "cy", "ct"))
    start = swing(of) | {"pad.angle": -0.4, "bush.x": 0.02 * s, "bush.y": -0.03 * s}
    start |= {"pad.omega": 0.0, "bush.vx": 0.0, "bush.vy": 0.0}
    measures = ["bar.angle.final", "bush.x.max", "bush.fx.final", "bush.torque.final"]
    measures += ["bush.dissipated.final", "bush.energy.final", "pad.omega.final"]
    return Made(m, measures, start, analyses=RESTS)


def generalized(of: Units) -> Made:
    """A force along a coordinate, as a formula of the motion."""
    m = pendulum(of, k=(1.5, of.torque), c=(0.2, of.torque / of.rate), phase=(0.3, 1))
    m.generalized_force("odd", "bar.angle", value="-k * sin(bar.angle - phase) - c * bar.omega")
    measures = ["bar.angle.final", "odd.torque.max", "odd.power.final", "energy.work.final"]
    return Made(m, measures, swing(of), end=2.0, analyses=RESTS)


def electric(of: Units) -> Made:
    """A motor with inductance and one without it turn two bars."""
    r, rate = of.torque, of.rate
    m = pendulum(of, V=(2, r * rate), R=(1, r * rate), kt=(0.8, r), H=(0.5, r), w=(2, rate))
    m.motor(
        "motor",
        "bar",
        voltage="V * cos(w * t)",
        resistance="R",
        torque_constant="kt / 2",
        inductance="H",
    )
    of.bar(m, "two", 0.6 * of.size, ("A", "B"))
    m.revolute("A", "bar.A", "two.A")
    m.motor("plain", "two", voltage="V", resistance="R", torque_constant="kt", i="bar")
    measures = ["bar.angle.final", "motor.current.final", "motor.torque.max", "two.omega.final"]
    measures += ["motor.dissipated.final", "plain.power.final", "motor.current.integral"]
    return Made(m, measures, swing(of) | {"two.angle": -0.3, "motor.current": 0.2})


def stalled(of: Units) -> Made:
    """A motor by its stall torque and free speed."""
    m = pendulum(of, Ts=(1.5, of.torque), w0=(4, of.rate), on=(0.8, 1))
    m.motor("motor", "bar", stall_torque="Ts", free_speed="w0", command="on * cos(bar.angle)")
    measures = ["bar.angle.final", "motor.torque.max", "motor.power.integral"]
    return Made(m, measures, swing(of), end=2.0)


def rubbing(of: Units) -> Made:
    """Friction in a pin, in a slide and in a slot, with a law over the speed that has no corner."""
    s, v = of.size, of.size * of.rate
    m = pendulum(
        of,
        mu=(0.2, 1),
        mus=(0.3, 1),
        r=(0.1, s),
        vs=(0.3, v),
        visc=(0.1, of.damping),
        v0=(0.1, v),
        guide=(0.05, s),
        tilt=(-0.2, 1),
    )
    m.ground.points(S=(0, "-1.2 * L"))
    of.disc(m, "block", {"P": (0, 0), "E": (0.1 * s, 0.3 * s)})
    m.translational("slide", "ground.S", "block.P", axes=("tilt", "tilt"))
    m.spring_damper("tie", "bar.A", "block.E", stiffness=5 * of.stiffness, free_length=0.5 * s)
    law: dict[str, Any] = {"kinetic": "mu", "static": "mus", "stribeck": "vs", "velocity": "v0"}
    m.friction("pin", "O", radius="r", viscous="visc", **law)
    m.friction("rub", "slide", guide="guide", viscous="visc", **law)
    start = swing(of) | {"block.x": 0.4 * s, "block.vx": of.near(1.5) * v}
    measures = ["bar.angle.final", "block.x.final", "pin.torque.max", "pin.load.final"]
    measures += [
        "rub.force.final",
        "energy.dissipated.final",
        "slide.force.final",
        "rub.load.final",
    ]
    return Made(m, measures, start, end=0.4)


def sticking(of: Units) -> Made:
    """A block on an incline that slides, sticks and slips as a spring pulls it."""
    v = of.size * of.rate
    m = of.model(
        mu=(0.25, 1),
        mus=(0.4, 1),
        visc=(0.05, of.damping),
        vs=(0.5, v),
        P=(1, of.force),
        u=(0.8, v),
        m=(1, of.mass),
        k=(4, of.stiffness),
    )
    m.ground.points(O=(0, 0))
    m.body("block", mass="m", inertia=of.inertia, points={"P": (0, 0)})
    m.translational("slide", "ground.O", "block.P")
    m.generalized_force("pull", "block.x", value="k * (u * t - block.x)")
    m.friction(
        "rub",
        "slide",
        kinetic="mu",
        static="mus",
        viscous="visc",
        stribeck="vs",
        load="P + k * u * t / 20",
    )
    measures = ["block.x.final", "block.vx.max", "rub.force.final", "energy.dissipated.final"]
    return Made(m, measures, {"block.x": 0.0, "block.vx": of.near(0.6) * v}, end=4.0, changes=True)


def clutched(of: Units) -> Made:
    """Two discs, the second of which runs ahead where the first one is slowed down."""
    m = of.model(
        T=(2, of.torque), c=(0.5, of.torque / of.rate), J=(1, of.inertia), P=(0.5, of.torque)
    )
    m.ground.points(O=(0, 0))
    for name in ("one", "two"):
        m.body(name, mass=of.mass, inertia="J", points={"O": (0, 0)})
        m.revolute(f"{name}_pin", "ground.O", f"{name}.O")
    m.clutch("wheel", "one", "two", capacity="T + P * sin(one.angle)", one_way=True)
    m.torsion_spring("slows", "ground", "one", damping="c")
    start = {"one.omega": of.near(3) * of.rate, "two.omega": 0.0}
    measures = ["two.angle.final", "one.omega.final", "wheel.torque.max", "wheel.slip.final"]
    return Made(m, [*measures, "energy.dissipated.final"], start, end=3.0, changes=True)


def stopped(of: Units) -> Made:
    """A bar between a hard stop and a soft one."""
    m = pendulum(
        of,
        low=(-1.2, 1),
        high=(0.25, 1),
        k=(300, of.torque),
        n=(1.4, 1),
        c=(0.3, 1 / of.rate),
        e=(0.6, 1),
    )
    m.torque("motor", "bar", torque=1.2 * of.torque)
    m.stop("soft", "bar.angle", upper="high", stiffness="k", exponent="n", damping="c")
    m.stop("hard", "bar.angle", lower="low", restitution="e", rest_speed=1e-9 * of.rate)
    start = {"bar.angle": of.near(-0.9), "bar.omega": of.near(-1.5) * of.rate}
    measures = ["bar.angle.final", "bar.omega.max", "soft.torque.min", "soft.gap.final"]
    return Made(
        m, [*measures, "energy.dissipated.final", "O.force.final"], start, end=2.5, changes=True
    )


def stopped_below(of: Units) -> Made:
    """A bar falls on a soft stop from above and is thrown at a hard one."""
    m = pendulum(of, low=(-0.9, 1), high=(0.4, 1), k=(300, of.torque), e=(0.6, 1))
    m.stop("soft", "bar.angle", lower="low", stiffness="k")
    m.stop("hard", "bar.angle", upper="high", restitution="e")
    start = {"bar.angle": of.near(-0.3), "bar.omega": of.near(2) * of.rate}
    measures = ["bar.angle.final", "bar.omega.max", "soft.torque.max", "energy.dissipated.final"]
    return Made(m, measures, start, end=2.5, changes=True)


def bending(of: Units) -> Made:
    """A clamped beam with a load at its tip and a point on it."""
    s, pressure = of.size, of.force / of.size**2
    m = of.model(
        L=(1, s),
        h=(0.12, s),
        w=(0.1, s),
        E=(2e5, pressure),
        rho=(80, of.mass / s**3),
        d=(0.01, 1 / of.rate),
        p=(2, of.force),
    )
    m.ground.points(O=(0, 0))
    section = kp.Section.rectangle(height="h", width="w")
    given = {"young": "E", "density": "rho", "damping": "d", "points": {"P": "40 %"}}
    m.beam("rod", length="L", section=section, elements=2, **given)
    m.weld("clamp", "ground.O", "rod.A")
    m.force("load", "rod.B", force=(0, "-p"))
    measures = ["rod.B.y.final", "rod.P.angle.final", "rod.stress.final"]
    measures += ["rod.bending_moment.final", "rod.strain_energy.final", "clamp.torque.final"]
    return Made(m, measures, {}, end=0.1, analyses=RESTS)


def tapered(of: Units) -> Made:
    """A tapered beam without shear and stretch, with a load at its tip."""
    s, pressure = of.size, of.force / of.size**2
    m = of.model(
        L=(1, s),
        h=(0.12, s),
        w=(0.1, s),
        E=(2e5, pressure),
        rho=(80, of.mass / s**3),
        p=(2, of.force),
    )
    m.ground.points(O=(0, 0))
    section = kp.Section.rectangle(height="h*(1 - 0.4*s/L)", width="w")
    given = {"young": "E", "density": "rho", "shear": False, "inextensible": True}
    m.beam("rod", length="L", section=section, elements=2, damping=0.01 / of.rate, **given)
    m.weld("clamp", "ground.O", "rod.A")
    m.force("load", "rod.B", force=("p/2", "-p"))
    measures = ["rod.B.y.final", "rod.stress.final", "clamp.torque.final"]
    return Made(m, measures, {}, end=0.1, analyses=RESTS)


FORCES: list[Maker] = [
    bending,
    tapered,
    spiral,
    coil,
    resting_coil,
    turned,
    pushed,
    pulled,
    padded,
    generalized,
    electric,
    stalled,
    rubbing,
    sticking,
    clutched,
    stopped,
    stopped_below,
]
