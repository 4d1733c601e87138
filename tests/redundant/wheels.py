"""Classic redundancies of gears, belts, racks and drivers."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin

import kempe as kp
from redundant.pinned import G, Redundant


def shafts(m: kp.Model, centres: dict[str, tuple[float, float]]) -> None:
    """Wheels on fixed pins, each with a mass beside its centre."""
    m.ground.points(**centres)
    for name in centres:
        points = {"O": (0, 0)}
        m.body(f"wheel{name}", mass=1, inertia=0.2, center=(0.1, 0.05), points=points)
        m.revolute(name, f"ground.{name}", f"wheel{name}.O")


def gears_in_parallel() -> Redundant:
    """Two pairs of gears with the same ratio on the same shafts."""
    m = kp.Model("gears in parallel", gravity=G)
    shafts(m, {"A": (0, 0), "B": (0.3, 0)})
    m.gear("first", "wheelA.O", "wheelB.O", radii=(0.1, 0.2))
    m.gear("second", "wheelA.O", "wheelB.O", radii=(0.1, 0.2))
    return Redundant(m, 1, {"first", "second"}, {"wheelA.angle": 0.3})


def belt_and_gear() -> Redundant:
    """A crossed belt beside a pair of gears."""
    m = kp.Model("belt and gear", gravity=G)
    shafts(m, {"A": (0, 0), "B": (0.3, 0)})
    m.gear("gear", "wheelA.O", "wheelB.O", radii=(0.1, 0.2))
    m.belt("belt", "wheelA.O", "wheelB.O", radii=(0.08, 0.16), crossed=True)
    return Redundant(m, 1, {"gear", "belt"}, {"wheelA.angle": 0.3})


def belts_around_three() -> Redundant:
    """Three wheels with a belt between each two."""
    m = kp.Model("three belts", gravity=G)
    shafts(m, {"A": (0, 0), "B": (0.5, 0), "C": (0.2, 0.4)})
    for name, i, j in (("AB", "A", "B"), ("BC", "B", "C"), ("CA", "C", "A")):
        m.belt(name, f"wheel{i}.O", f"wheel{j}.O", radii=(0.1, 0.1))
    return Redundant(m, 1, {"AB", "BC", "CA"}, {"wheelA.angle": 0.3})


def planets(count: int = 3) -> Redundant:
    """A planetary gear: every planet after the first one repeats its ratio."""
    m = kp.Model("planets", gravity=G)
    m.ground.points(O=(0, 0))
    angles = [2 * pi * k / count for k in range(count)]
    places = {f"P{k}": (0.15 * cos(a), 0.15 * sin(a)) for k, a in enumerate(angles)}
    m.body("sun", mass=1, inertia=0.02, center=(0.02, 0), points={"O": (0, 0)})
    m.body("carrier", mass=1, inertia=0.1, center=(0.1, 0), points={"O": (0, 0), **places})
    m.revolute("sun_pin", "ground.O", "sun.O")
    m.revolute("carrier_pin", "ground.O", "carrier.O")
    joints = {"sun_pin", "carrier_pin"}
    for k in range(count):
        m.body(f"planet{k}", mass=0.3, inertia=0.01, points={"O": (0, 0)})
        m.revolute(f"pin{k}", f"carrier.P{k}", f"planet{k}.O")
        # every planet has the angle 0 at the start
        inner, outer = (f"{wheel}.O" for wheel in ("sun", "ground"))
        offset = -0.15 * angles[k]
        m.gear(f"inner{k}", inner, f"planet{k}.O", radii=(0.1, 0.05), offset=offset)
        m.gear(f"outer{k}", outer, f"planet{k}.O", radii=(0.2, 0.05), internal=True, offset=offset)
        joints |= {f"pin{k}", f"inner{k}", f"outer{k}"}
    return Redundant(m, count - 1, joints, {"carrier.angle": 0.0})


def doubled_driver() -> Redundant:
    """Both shafts of a pair of gears are driven, at speeds that agree."""
    m = kp.Model("doubled driver", gravity=G)
    shafts(m, {"A": (0, 0), "B": (0.3, 0)})
    m.gear("gear", "wheelA.O", "wheelB.O", radii=(0.1, 0.2))
    m.coordinate_driver("fast", "wheelA.angle", value="2*t")
    m.coordinate_driver("slow", "wheelB.angle", value="-t")
    return Redundant(m, 1, {"A", "B", "gear", "fast", "slow"})


def rack_on_two_pinions() -> Redundant:
    """A rack on two pinions that a belt couples."""
    m = kp.Model("two pinions", gravity=G)
    shafts(m, {"A": (0, 0), "B": (1, 0)})
    m.body("table", mass=5, inertia=1, center=(0.2, 0.1), points={"T": (0, 0)})
    m.ground.points(S=(0, 0.1))
    m.translational("guide", "ground.S", "table.T")
    m.rack("left", "table.T", "wheelA.O", radius=-0.1)
    m.rack("right", "table.T", "wheelB.O", radius=-0.1, offset=1)
    m.belt("belt", "wheelA.O", "wheelB.O", radii=(0.1, 0.1))
    return Redundant(
        m, 1, {"A", "B", "left", "right", "belt"}, {"table.x": 0.2}, {"wheelA.angle": 0.0}
    )


def locomotive() -> Redundant:
    """Two wheels roll on a rail that also guides the frame; a rod couples them."""
    m = kp.Model("locomotive", gravity=(2.0, -9.81))
    m.ground.points(S=(0, 0.5), R=(0, 0))
    m.body("frame", mass=20, inertia=5, center=(1, 0), points={"A": (0, 0), "B": (2, 0)})
    m.translational("guide", "ground.S", "frame.A")
    for name in ("A", "B"):
        points = {"O": (0, 0), "P": (0.2, 0)}
        m.body(f"wheel{name}", mass=4, inertia=0.5, points=points)
        m.revolute(name, f"frame.{name}", f"wheel{name}.O")
        m.rolling(f"roll{name}", "ground.R", f"wheel{name}.O", radius=0.5, offset=2 * (name == "B"))
    m.bar("rod", mass=2, length=2, ends=("A", "B"))
    m.revolute("PA", "wheelA.P", "rod.A")
    m.revolute("PB", "wheelB.P", "rod.B")
    joints = {"guide", "A", "B", "rollA", "rollB", "PA", "PB"}
    return Redundant(m, 3, joints, {"frame.x": 0.0}, {"wheelA.angle": 0.9, "wheelB.angle": 0.9})


WHEELS: dict[str, Callable[[], Redundant]] = {
    "two gears in parallel": gears_in_parallel,
    "belt and gear": belt_and_gear,
    "three belts in a ring": belts_around_three,
    "three planets": planets,
    "driver doubled by a gear": doubled_driver,
    "rack on two coupled pinions": rack_on_two_pinions,
    "coupled wheels on a rail": locomotive,
}
