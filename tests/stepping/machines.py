"""Mechanisms whose motion has a closed form."""

import kempe as kp


def cart(mass: float = 1.0, force: float | str | kp.Sampled = "F") -> kp.Model:
    """A cart on a rail, which a force pushes."""
    m = kp.Model("cart", gravity=(0, 0), parameters={"F": 0, "mass": mass})
    m.ground.points(O=(0, 0))
    m.body("cart", mass="mass", inertia=1, points={"S": (0, 0)})
    m.translational("rail", "ground.O", "cart.S")
    m.force("push", "cart.S", force=(force, 0))
    return m


def ball(height: float, restitution: float, g: float) -> kp.Case:
    """A ball that falls onto a floor."""
    m = kp.Model("ball", gravity=(0, -g))
    m.point_mass("ball", mass=1)
    m.stop("floor", "ball.y", lower=0.0, restitution=restitution)
    return kp.Case(m, {"set": {"ball.x": 0, "ball.y": height, "ball.vx": 0, "ball.vy": 0}})


def pendulum(**parameters: float) -> kp.Case:
    return kp.load("examples/pendulum.toml", parameters=parameters)
