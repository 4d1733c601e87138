"""Small mechanisms in which each form of a belt matters; all numbers are variables."""

from typing import Any

from gradients.catalogue_joints import Made, Maker, Units


def crossed_belt(of: Units) -> Made:
    """Two wheels with a belt."""
    s = of.size
    m = of.model(r1=(0.5, s), r2=(0.2, s), slip=(0.05, s))
    m.ground.points(O=(0, 0), P=(s, 0.1 * s))
    of.disc(m, "one", {"O": (0, 0)}, center=(0.2 * s, 0))
    of.disc(m, "two", {"P": (0, 0)}, center=(0.03 * s, 0.02 * s))
    m.revolute("O", "ground.O", "one.O")
    m.revolute("P", "ground.P", "two.P")
    m.belt(
        "belt",
        "one.O",
        "two.P",
        radii=("r1", "r2"),
        offset="slip",
        crossed=bool(of.draw.integers(2)),
    )
    measures = ["two.angle.final", "belt.tangential.max", "O.force.final", "belt.tangential.final"]
    return Made(m, measures, {"one.angle": of.near(0.5), "one.omega": of.rate}, end=2.0)


def slipping_belt(of: Units) -> Made:
    """A fast wheel drags another one along by the friction of a belt."""
    s = of.size
    weight = of.mass * s * of.rate**2
    m = of.model(weight=False, r1=(0.2, s), r2=(0.5, s), F=(0.3, weight), mu=(0.3, 1))
    m.ground.points(O=(0, 0), Q=(1.3 * s, 0))
    for name, at in (("drive", "O"), ("wheel", "Q")):
        of.disc(m, name, {"C": (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.C")
    m.belt("belt", "drive.C", "wheel.C", radii=("r1", "r2"), preload="F", friction="mu")
    start = {"drive.angle": 0.0, "drive.omega": of.near(2) * of.rate, "wheel.angle": 0.0}
    start |= {"wheel.omega": 0.0}
    measures = ["wheel.angle.final", "drive.omega.final", "belt.tight.final", "O.fx.final"]
    measures += ["energy.dissipated.final", "belt.sliding.final", "drive.angle.final"]
    return Made(m, measures, start, end=0.4, changes=True)


def elastic_belt(of: Units) -> Made:
    """Two wheels swing on the strands of a belt, which is loose in one of two makes."""
    s = of.size
    loose = bool(of.draw.integers(2))
    own: dict[str, Any] = {"slack": "h"} if loose else {"preload": "F"}
    m = of.model(
        weight=False,
        r1=(0.2, s),
        r2=(0.5, s),
        k=(20, of.stiffness),
        **({"h": (0.03, s)} if loose else {"F": (0.8, s * of.stiffness)}),
    )
    m.ground.points(O=(0, 0), Q=(1.3 * s, 0))
    for name, at in (("drive", "O"), ("wheel", "Q")):
        of.disc(m, name, {"C": (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.C")
    m.belt("belt", "drive.C", "wheel.C", radii=("r1", "r2"), stiffness="k", **own)
    start = {"drive.angle": 0.0, "drive.omega": of.near(2) * of.rate, "wheel.angle": 0.0}
    start |= {"wheel.omega": 0.0}
    measures = ["wheel.angle.final", "drive.omega.final", "belt.tangential.final", "O.fx.final"]
    return Made(m, measures, start, end=0.6, changes=True)


def hanging_belt(of: Units) -> Made:
    """A wheel takes up the slack of a belt and pulls another one along."""
    s = of.size
    m = of.model(weight=False, r1=(0.2, s), r2=(0.5, s), h=(0.04, s))
    m.ground.points(O=(0, 0), Q=(1.3 * s, 0))
    for name, at in (("drive", "O"), ("wheel", "Q")):
        of.disc(m, name, {"C": (0, 0)})
        m.revolute(at, f"ground.{at}", f"{name}.C")
    m.belt("belt", "drive.C", "wheel.C", radii=("r1", "r2"), slack="h")
    start = {"drive.angle": 0.0, "drive.omega": of.near(2) * of.rate, "wheel.angle": 0.0}
    start |= {"wheel.omega": 0.0}
    measures = ["wheel.angle.final", "drive.omega.final", "drive.angle.final"]
    return Made(m, measures, start, end=0.4, changes=True)


BELTS: list[Maker] = [crossed_belt, slipping_belt, elastic_belt, hanging_belt]
