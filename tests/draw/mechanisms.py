"""Mechanisms to draw: the flagship, with plain and with hostile names, and one of every shape."""

import kempe as kp

#: Names that would do harm, or would at least look wrong, if they were read as anything but text.
HOSTILE = {
    "title": "</script><script>document.title='broken'</script>{{scene}}\u2028\u2029<!--",
    "crank": "<img src=x onerror=\"alert('crank')\">",
    "coupler": "__proto__",
    "rocker": "'\"&amp;<b>$x^2$</b>\\u003c",
    "A": "👩‍🔧 ground 🔩",
    "B": "</script><svg onload=alert(1)>",
    "C": "W" * 200,
    "D": "\u05e8\u05d0\u05e9\u05d5\u05df first \u0661",
    "spring": "constructor",
}
PLAIN = {name: name for name in HOSTILE} | {"title": "Four-bar linkage"}


def four_bar(names: dict[str, str] = PLAIN) -> kp.Model:
    n = names
    m = kp.Model(n["title"], gravity=(0, -9.81))
    m.ground.points(A=(0, 0), D=(20, 0))
    m.bar(n["crank"], mass=3, length=10, ends=("A", "B"))
    m.bar(n["coupler"], mass=5, length=26, ends=("B", "C"))
    m.bar(n["rocker"], mass=4, length=18, ends=("C", "D"))
    m.revolute(n["A"], "ground.A", f"{n['crank']}.A")
    m.revolute(n["B"], f"{n['crank']}.B", f"{n['coupler']}.B")
    m.revolute(n["C"], f"{n['coupler']}.C", f"{n['rocker']}.C")
    m.revolute(n["D"], "ground.D", f"{n['rocker']}.D")
    m.torsion_spring(
        n["spring"], "ground", n["rocker"], stiffness=1e6, damping=1e4, free_angle="270*deg"
    )
    return m


def moving(
    names: dict[str, str] = PLAIN, *, t_end: float = 1.0, dense_output: bool = True
) -> kp.Solution:
    m = four_bar(names)
    guess = {f"{names['coupler']}.angle": "14*deg", f"{names['rocker']}.angle": "240*deg"}
    start = kp.assemble(m, set={f"{names['crank']}.angle": "70*deg"}, guess=guess)
    return kp.dynamics(m, start, t_end=t_end, output_step=0.01, dense_output=dense_output)


def pendulum(t_end: float = 1.0) -> kp.Solution:
    """A plate that hangs from a corner, off its mass centre, with a point of interest."""
    m = kp.Model("plate", gravity=(0, -9.81))
    m.ground.points(O=(1, 2))
    points = {"P": (0, 0), "Q": (1, 0), "R": (1, 0.5), "S": (0.2, 0.1)}
    m.body("plate", mass=2, inertia=0.1, center=(0.5, 0.2), points=points)
    m.revolute("hinge", "ground.O", "plate.P")
    start = kp.assemble(m, set={"plate.angle": 0.0})
    return kp.dynamics(m, start, t_end=t_end, output_step=0.05)


def slider_crank() -> kp.Solution:
    m = kp.Model("slider-crank", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.bar("crank", mass=1, length=0.1, ends=("O", "A"))
    m.bar("rod", mass=2, length=0.3, ends=("A", "B"))
    m.body("slider", mass=3, inertia=0.01, points={"B": (0, 0)})
    m.revolute("O", "ground.O", "crank.O")
    m.revolute("A", "crank.A", "rod.A")
    m.revolute("B", "rod.B", "slider.B")
    m.translational("guide", "ground.O", "slider.B", axes=(0.3, 0.1))
    start = kp.assemble(m, set={"crank.angle": 1.0, "crank.omega": 20.0})
    return kp.dynamics(m, start, t_end=0.5, output_step=0.01)


def sprung() -> kp.Solution:
    """A rod held by a spring-damper from a point of ground."""
    m = kp.Model("sprung", gravity=(0, -9.81))
    m.ground.points(O=(0, 0), A=(-1.2, 0.3))
    m.bar("rod", mass=1, length=1, ends=("O", "P"))
    m.revolute("O", "ground.O", "rod.O")
    m.spring_damper("s", "ground.A", "rod.P", stiffness=100, damping=2, free_length=0.9)
    start = kp.assemble(m, set={"rod.angle": "-30*deg"})
    return kp.dynamics(m, start, t_end=0.5, output_step=0.02)


def point_pendulum() -> kp.Solution:
    """A point mass on a massless rod."""
    m = kp.Model("point pendulum", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.body("bob", mass=1, inertia=0, points={"P": (0, 0)})
    m.distance("rod", "ground.O", "bob.P", length=1)
    start = kp.assemble(m, set={"bob.y": 0, "bob.angle": 0}, guess={"bob.x": -1})
    return kp.dynamics(m, start, t_end=1.0, output_step=0.05)


def resting(restitution: float) -> kp.State:
    """A ball on a rigid floor, beside a spring that is stretched by 0.1 m."""
    m = kp.Model("ball", gravity=(0.0, -9.81))
    m.ground.points(O=(0, 0.5))
    m.point_mass("ball", mass=2.0)
    m.point_mass("other", mass=1.0)
    m.spring_damper("spring", "ground.O", "other.P", stiffness=50.0, free_length=0.9)
    m.stop("floor", "ball.y", lower=0.0, restitution=restitution)
    return kp.assemble(m, set={"ball.x": 0, "ball.y": 0, "other.x": 1.0, "other.y": 0.5})
