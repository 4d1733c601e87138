"""Small mechanisms in which bodies touch, with all numbers of the contacts as variables."""

from gradients.catalogue_joints import Made, Maker, Units


def touching(of: Units) -> Made:
    """A ball falls on a curved floor and rubs on it."""
    s, v = of.size, of.size * of.rate
    m = of.model(
        r=(0.2, s),
        k=(1000, of.stiffness / s**0.5),
        n=(1.5, 1),
        c=(0.2, 1 / v),
        mu=(0.3, 1),
        v0=(0.05, v),
        a=(0.2, 1 / s),
        w=(0.1, s**2 / of.force),
    )
    m.ground.curves(floor={"x": "u", "y": "a * u^2", "range": [-5 * s, 5 * s]})
    of.disc(m, "ball", {"C": (0, 0)}, center=(0.03 * s, 0.01 * s))
    m.contact(
        "touch",
        "ball.C",
        "ground.floor",
        radius="r",
        side="left",
        stiffness="k",
        exponent="n",
        damping="c",
        friction="mu",
        velocity="v0",
        wear="w",
    )
    start = {"ball.x": of.near(0.6) * s, "ball.y": s, "ball.vx": 0.5 * v, "ball.angle": 0.0}
    measures = ["ball.x.final", "ball.y.final", "ball.omega.final", "touch.force.max"]
    measures += ["touch.wear_volume.final"]
    return Made(
        m, [*measures, "energy.dissipated.final", "touch.gap.final"], start, end=2.5, changes=True
    )


def rolling_over(of: Units) -> Made:
    """A disc slips on a compliant floor, rolls, and slips again under a growing torque."""
    s, v = of.size, of.size * of.rate
    weight = of.mass * v * of.rate
    m = of.model(
        r=(0.2, s), k=(4000, weight / s), c=(0.2, 1 / v), mu=(0.3, 1), most=(0.5, 1), tilt=(0.1, s)
    )
    m.torque("turn", "ball", torque=f"-{0.12 * weight * s * of.rate}*t")
    m.ground.curves(floor={"line": [["-20*r", "-tilt"], ["20*r", "tilt"]]})
    of.disc(m, "ball", {"C": (0, 0)}, center=(0.01 * s, 0))
    m.contact(
        "touch",
        "ball.C",
        "ground.floor",
        radius="r",
        side="left",
        stiffness="k",
        exponent=1,
        damping="c",
        friction="mu",
        static="most",
    )
    start = {"ball.x": of.near(0.6) * s, "ball.y": 0.3 * s, "ball.vx": 0.5 * v, "ball.angle": 0.0}
    measures = ["ball.x.final", "ball.omega.final", "energy.dissipated.final"]
    return Made(m, measures, start, end=2.0, changes=True)


def bouncing(of: Units) -> Made:
    """A ball bounces on a tilted floor."""
    s, v = of.size, of.size * of.rate
    m = of.model(r=(0.2, s), e=(0.8, 1), rise=(0.3, s))
    m.ground.curves(floor={"line": [[-5 * s, 0], [5 * s, "rise"]]})
    of.disc(m, "ball", {"C": (0, 0)}, center=(0.03 * s, 0.01 * s))
    m.contact(
        "touch",
        "ball.C",
        "ground.floor",
        radius="r",
        side="left",
        restitution="e",
        rest_speed=1e-9 * v,
    )
    start = {"ball.x": of.near(0.6) * s, "ball.y": s, "ball.vx": 0.5 * v, "ball.angle": 0.0}
    measures = ["ball.x.final", "ball.vy.final", "ball.vy.max", "energy.dissipated.final"]
    return Made(m, [*measures, "touch.gap.final"], start, end=3.5, changes=True)


def loose_pin(of: Units) -> Made:
    """A pendulum whose pin slides and rolls in its bush."""
    s, v = of.size, of.size * of.rate
    weight = of.mass * v * of.rate
    m = of.model(
        R=(0.3, s),
        gap=(0.05, s),
        k=(9000, weight / s),
        c=(0.2, 1 / v),
        mu=(0.1, 1),
        most=(0.2, 1),
    )
    m.ground.points(O=(0, 0))
    of.disc(m, "disc", {"C": (0, 0.4 * s)}, center=(0.03 * s, 0.01 * s))
    m.clearance(
        "pin",
        "ground.O",
        "disc.C",
        radius="R",
        clearance="gap",
        stiffness="k",
        exponent=1,
        damping="c",
        friction="mu",
        static="most",
    )
    start = {
        "disc.x": of.near(0.02) * s,
        "disc.y": -0.44 * s,
        "disc.vx": 0.5 * v,
        "disc.angle": 0.0,
    }
    measures = ["disc.x.final", "disc.omega.final", "energy.dissipated.final", "pin.gap.final"]
    return Made(m, measures, start, end=2.0, changes=True)


def tumbling(of: Units) -> Made:
    """A block with rounded corners presses into a tilted floor with friction."""
    s, v = of.size, of.size * of.rate
    weight = of.mass * v * of.rate
    m = of.model(r=(0.1, s), k=(900, weight / s), c=(0.3, 1 / v), mu=(0.2, 1), rise=(0.3, s))
    m.ground.curves(floor={"line": [["5*rise", "rise"], ["-5*rise", "-rise"]]})
    corners = [(-0.4 * s, -0.2 * s), (0.4 * s, -0.2 * s), (0.3 * s, 0.2 * s), (-0.4 * s, 0.2 * s)]
    rim = {"rim": {"polygon": corners}}
    of.disc(m, "block", {"C": (0, 0)}, center=(0.03 * s, 0.01 * s), curves=rim)
    m.contact(
        "touch",
        curves=["block.rim", "ground.floor"],
        radius="r",
        stiffness="k",
        exponent=1,
        damping="c",
        friction="mu",
    )
    start = {"block.x": of.near(0.1) * s, "block.y": s, "block.vx": 0.5 * v, "block.angle": 0.3}
    measures = ["block.x.final", "block.y.final", "block.omega.final"]
    return Made(
        m, [*measures, "energy.dissipated.final", "touch.gap.final"], start, end=2.0, changes=True
    )


def cylinders(of: Units) -> Made:
    """A roller falls on a drum; the law of the force is that of two cylinders."""
    s, v = of.size, of.size * of.rate
    weight = of.mass * v * of.rate
    m = of.model(
        r=(0.2, s), E=(4000, weight / s**2), nu=(0.3, 1), b=(0.1, s), c=(0.3, 1 / v), drum=(2, s)
    )
    m.ground.curves(floor={"circle": (0, "-drum", "drum")})
    of.disc(m, "ball", {"C": (0, 0)}, center=(0.03 * s, 0.01 * s))
    m.contact(
        "touch",
        "ball.C",
        "ground.floor",
        radius="r",
        law="hertz",
        young="E",
        poisson="nu",
        width="b",
        damping="c",
    )
    start = {"ball.x": of.near(0.1) * s, "ball.y": 0.4 * s, "ball.vx": 0.5 * v, "ball.angle": 0.0}
    measures = ["ball.x.final", "ball.y.final", "ball.omega.final", "touch.gap.final"]
    return Made(m, measures, start, end=1.0, changes=True)


def worn_pin(of: Units) -> Made:
    """A pendulum whose pin wears its bush."""
    s, v = of.size, of.size * of.rate
    weight = of.mass * v * of.rate
    m = of.model(
        R=(0.3, s),
        gap=(0.05, s),
        E=(4000, weight / s**2),
        nu=(0.3, 1),
        b=(0.1, s),
        c=(0.3, 1 / v),
        mu=(0.1, 1),
        v0=(0.1, v),
        w=(0.1, s**2 / of.force),
    )
    m.ground.points(O=(0, 0))
    of.disc(m, "disc", {"C": (0, 0.4 * s)}, center=(0.03 * s, 0.01 * s))
    m.clearance(
        "pin",
        "ground.O",
        "disc.C",
        radius="R",
        clearance="gap",
        law="hertz",
        young="E",
        poisson="nu",
        width="b",
        damping="c",
        friction="mu",
        velocity="v0",
        wear="w",
    )
    start = {
        "disc.x": of.near(0.02) * s,
        "disc.y": -0.44 * s,
        "disc.vx": 0.5 * v,
        "disc.angle": 0.0,
    }
    measures = ["disc.x.final", "disc.omega.final", "pin.gap.final", "pin.wear_volume.final"]
    return Made(m, measures, start, end=1.0, changes=True)


def soft_pin(of: Units) -> Made:
    """A pendulum whose pin presses into its bush, with an exponent."""
    s, v = of.size, of.size * of.rate
    weight = of.mass * v * of.rate
    m = of.model(R=(0.3, s), gap=(0.05, s), k=(30000, weight / s**1.5), n=(1.5, 1), c=(0.2, 1 / v))
    m.ground.points(O=(0, 0))
    of.disc(m, "disc", {"C": (0, 0.4 * s)}, center=(0.03 * s, 0.01 * s))
    m.clearance(
        "pin",
        "ground.O",
        "disc.C",
        radius="R",
        clearance="gap",
        stiffness="k",
        exponent="n",
        damping="c",
    )
    start = {
        "disc.x": of.near(0.02) * s,
        "disc.y": -0.44 * s,
        "disc.vx": 0.5 * v,
        "disc.angle": 0.0,
    }
    return Made(
        m, ["disc.x.final", "disc.omega.final", "pin.gap.final"], start, end=1.0, changes=True
    )


def bouncing_pin(of: Units) -> Made:
    """A pendulum whose pin falls from the top of its bush and bounces."""
    s, v = of.size, of.size * of.rate
    m = of.model(R=(0.3, s), gap=(0.1, s), e=(0.7, 1))
    m.ground.points(O=(0, 0))
    of.disc(m, "disc", {"C": (0, 0.4 * s)}, center=(0.03 * s, 0.01 * s))
    m.clearance(
        "pin",
        "ground.O",
        "disc.C",
        radius="R",
        clearance="gap",
        restitution="e",
        rest_speed=1e-9 * v,
    )
    start = {
        "disc.x": of.near(0.02) * s,
        "disc.y": -0.36 * s,
        "disc.vx": 0.1 * v,
        "disc.angle": 0.0,
    }
    measures = ["disc.x.final", "disc.y.final", "disc.omega.final", "pin.gap.final"]
    return Made(m, measures, start, end=0.8, changes=True)


def egg(of: Units) -> Made:
    """An egg presses into a tilted floor, rolls and rubs on it."""
    s, v = of.size, of.size * of.rate
    m = of.model(
        a=(0.4, s),
        b=(0.05, s),
        k=(1000, of.stiffness / s**0.5),
        n=(1.5, 1),
        c=(0.2, 1 / v),
        mu=(0.3, 1),
        v0=(0.05, v),
        r=(0.05, s),
        rise=(0.3, s),
    )
    m.ground.curves(floor={"line": [["5*rise", "rise"], ["-5*rise", "-rise"]]})
    rim = {"rim": {"polar": "a + b*cos(u)"}}
    of.disc(m, "egg", {"C": (0, 0)}, center=(0.03 * s, 0.01 * s), curves=rim)
    m.contact(
        "touch",
        curves=["egg.rim", "ground.floor"],
        radius="r",
        stiffness="k",
        exponent="n",
        damping="c",
        friction="mu",
        velocity="v0",
    )
    start = {"egg.x": of.near(0.1) * s, "egg.y": 0.8 * s, "egg.vx": 0.5 * v, "egg.angle": 0.3}
    measures = ["egg.x.final", "egg.y.final", "egg.omega.final", "energy.dissipated.final"]
    return Made(m, [*measures, "touch.gap.final"], start, end=2.0, changes=True)


def two_cams(of: Units) -> Made:
    """An ellipse falls on a cam on a pivot, bounces and rests on it."""
    s, v = of.size, of.size * of.rate
    m = of.model(a=(0.3, s), b=(0.2, s), w=(0.8, s), h=(0.3, s), e=(0.4, 1))
    m.ground.points(O=(0, 0))
    x, y, whole = "w*cos(u)", "h*sin(u)", [0, "2*pi"]
    cam = {"rim": {"x": x, "y": y, "range": whole, "periodic": True}}
    of.disc(m, "cam", {"O": (0.02 * s, 0)}, curves=cam)
    m.revolute("pin", "ground.O", "cam.O")
    stiffness = of.torque * 20
    m.torsion_spring("hold", "ground", "cam", stiffness=stiffness, free_angle=0)
    x, y = "a*cos(u)", "b*sin(u)"
    rim = {"rim": {"x": x, "y": y, "range": whole, "periodic": True}}
    of.disc(m, "ball", {"C": (0, 0)}, curves=rim)
    m.contact("touch", curves=["ball.rim", "cam.rim"], restitution="e")
    start = {
        "ball.x": 0.05 * s,
        "ball.y": of.near(0.9) * s,
        "ball.vx": 0.1 * v,
        "ball.angle": 0.4,
        "cam.angle": 0.0,
    }
    measures = ["ball.x.final", "ball.y.final", "ball.omega.final", "cam.angle.final"]
    return Made(m, [*measures, "touch.gap.final"], start, end=1.3, changes=True)


CONTACTS: list[Maker] = [
    touching,
    rolling_over,
    bouncing,
    loose_pin,
    tumbling,
    cylinders,
    worn_pin,
    soft_pin,
    bouncing_pin,
    egg,
    two_cams,
]
