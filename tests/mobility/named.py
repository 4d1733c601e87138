"""Named mechanisms, each drawn in a general position, with its known degrees of freedom.

`python -m mobility.named` prints the table of docs/mobility.md.
"""

from __future__ import annotations

from math import acos, atan2, cos, hypot, pi, radians, sin

import kempe as kp
from mobility.drawn import Drawn, Point


def apex(a: Point, b: Point, r: float, s: float) -> Point:
    """The point at the distances r from a and s from b, to the left of a → b."""
    d = hypot(b[0] - a[0], b[1] - a[1])
    turn = atan2(b[1] - a[1], b[0] - a[0]) + acos((d * d + r * r - s * s) / (2 * d * r))
    return a[0] + r * cos(turn), a[1] + r * sin(turn)


def ray(a: Point, r: float, angle: float) -> Point:
    """The point at the distance r from a, angle in degrees."""
    return a[0] + r * cos(radians(angle)), a[1] + r * sin(radians(angle))


def four_bar(ground: float, crank: float, coupler: float, rocker: float, angle: float) -> Drawn:
    """Four links and four pins."""
    a, d = (0.0, 0.0), (ground, 0.0)
    b = ray(a, crank, angle)
    return Drawn(
        {"A": a, "B": b, "C": apex(b, d, coupler, rocker), "D": d},
        {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"},
        1,
    )


def antiparallelogram() -> Drawn:
    """The legs and the diagonals of a trapezoid."""
    points = {"A": (-2.0, 0.0), "B": (-1.0, 1.5), "C": (2.0, 0.0), "D": (1.0, 1.5)}
    return Drawn(points, {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"}, 1)


def six_bars() -> dict[str, Drawn]:
    """The chains of Watt and Stephenson, with each kind of link as ground."""
    at = {"A": (0.0, 0.0), "B": (0.4, 1.0), "C": (2.6, 1.7), "D": (3.0, 0.1)}
    at |= {"E": (3.9, 1.4), "F": (5.2, 2.3), "G": (5.8, 0.2), "H": (4.1, 3.2)}

    def chain(freedom: int = 1, **bodies: str) -> Drawn:
        used = set("".join(bodies.values()))
        return Drawn({k: p for k, p in at.items() if k in used}, bodies, freedom)

    return {
        "Watt I": chain(ground="AD", left="ACE", right="DB", plate="CBF", link="EH", last="HF"),
        "Watt II": chain(ground="ADG", crank="AB", rod="BC", plate="DCE", link="EF", last="FG"),
        "Stephenson I": chain(ground="AD", left="ACE", right="DBF", rod="CB", link="EH", last="HF"),
        "Stephenson II": chain(ground="AD", left="ABE", one="BC", two="EG", plate="CGF", last="DF"),
        "Stephenson III": chain(
            ground="ADG", crank="AB", rod="BCE", arm="DC", link="EF", last="FG"
        ),
        "Klann's leg": chain(ground="ADG", crank="AB", rod="BCE", arm="DC", upper="GF", leg="EFH"),
    }


def slider_cranks() -> dict[str, Drawn]:
    """A chain of three pins and one slide, by the link that is ground, and its relatives."""
    a, b, c, d = (0.0, 0.0), (0.3, 0.5), (1.8, 0.1), (1.4, -0.3)
    along = float(atan2(b[1] - d[1], b[0] - d[0]) * 180 / pi)
    points = {"A": a, "B": b, "C": c, "s": c}
    turned = {"A": a, "B": b, "D": d, "s": b}
    crank = {"ground": "As", "crank": "AB", "rod": "BC", "piston": "Cs"}
    lever = {"ground": "AD", "crank": "AB", "block": "Bs", "lever": "Ds"}
    tube = {"ground": "AD", "crank": "AB", "rod": "Bs", "cylinder": "Ds"}
    slide = (("ground", "piston", "s", 0.0),)
    knees = {"A": a, "B": b, "C": (1.8, 0.3), "D": (1.9, -1.0), "E": (2.0, 1.5), "s": (2.0, 1.5)}
    toggle = {"ground": "ADs", "crank": "AB", "rod": "BC", "lower": "CD", "upper": "CE"}
    ram = (("ground", "ram", "s", 90.0),)
    return {
        "Slider-crank": Drawn(points, crank, 1, slide),
        "Oscillating cylinder": Drawn(turned, tube, 1, (("cylinder", "rod", "s", along),)),
        "Quick return (Whitworth)": Drawn(turned, lever, 1, (("lever", "block", "s", along),)),
        "Toggle press": Drawn(knees, toggle | {"ram": "Es"}, 1, ram),
        "Scotch yoke": Drawn(
            {"A": a, "B": b, "s": b},
            {"ground": "As", "crank": "AB", "block": "Bs", "yoke": "s"},
            1,
            (("yoke", "block", "s", 90.0), ("ground", "yoke", "s", 0.0)),
        ),
        "Elliptic trammel": Drawn(
            {"B": (0.0, 0.8), "C": (1.1, 0.0), "s": (0.0, 0.8), "r": (1.1, 0.0)},
            {"ground": "sr", "upright": "Bs", "flat": "Cr", "bar": "BC"},
            1,
            (("ground", "upright", "s", 90.0), ("ground", "flat", "r", 0.0)),
        ),
        "Oldham's coupling": Drawn(
            {"A": a, "B": (0.2, 0.1), "s": (0.1, 0.3)},
            {"ground": "AB", "one": "As", "other": "Bs", "disc": "s"},
            1,
            (("one", "disc", "s", 35.0), ("other", "disc", "s", 125.0)),
        ),
    }


def straight_lines() -> dict[str, Drawn]:
    """Mechanisms that draw exact straight lines."""
    o, axis = (0.0, 0.0), 25.0
    p, t = ray(o, 1.2, axis), ray(o, 2.2, axis)
    q, r = apex(p, t, 0.7, 0.7), apex(t, p, 0.7, 0.7)
    rhombus = {"O": o, "A": (0.7, 0.0), "P": p, "Q": q, "R": r, "T": t}
    cell = {"ground": "OA", "crank": "AP", "long": "OQ", "other": "OR"}
    trapezoid = {"J": (-2.0, 0.0), "K": (2.0, 0.0), "L": (1.0, 1.5), "M": (-1.0, 1.5)}
    # three points of the bars on a line parallel to the axis, at 0.4 of the height
    on = {"O": (-1.6, 0.6), "P": (-0.8, 0.6), "T": (0.8, 0.6), "A": (-1.2, 0.3)}
    hart = {"ground": "OA", "crank": "AP", "one": "JMO", "two": "JLP", "three": "KMT", "four": "KL"}
    return {
        "Peaucellier's inversor": Drawn(
            rhombus, cell | {"a": "PQ", "b": "PR", "c": "QT", "d": "RT"}, 1
        ),
        "Hart's inversor": Drawn(trapezoid | on, hart, 1),
    }


def walkers_and_lifts() -> dict[str, Drawn]:
    """Linkages of many bars."""
    jansen = {"A": (0.0, 0.0), "M": ray((0.0, 0.0), 15, 40), "Z": (-38.0, -7.8)}
    jansen["N"] = apex(jansen["M"], jansen["Z"], 50.0, 41.5)
    jansen["K"] = apex(jansen["Z"], jansen["M"], 39.3, 61.9)
    jansen["E"] = apex(jansen["N"], jansen["Z"], 55.8, 40.1)
    jansen["F"] = apex(jansen["E"], jansen["K"], 39.4, 36.7)
    low, high = (0.0, 0.0), (0.0, 0.7)
    scissor = {"A": low, "h": (1.0, 0.0), "C": (0.5, 0.35), "B": high, "k": (1.0, 0.7)}
    bars = {"ground": "Ah", "rising": "ACk", "falling": "BCh", "table": "Bk"}
    slots = (("ground", "falling", "h", 0.0), ("table", "rising", "k", 0.0))
    grid = {"O": (0.0, 0.0), "A": (0.8, 0.6), "B": (1.2, 0.9), "E": (1.2, 0.1), "D": (1.6, 0.4)}
    return {
        "Jansen's leg": Drawn(
            jansen,
            {
                "ground": "AZ",
                "crank": "AM",
                "upper": "MN",
                "lower": "MK",
                "plate": "ZNE",
                "arm": "ZK",
                "rod": "EF",
                "foot": "KF",
            },
            1,
        ),
        "Pantograph": Drawn(
            grid, {"ground": "O", "arm": "OAB", "tip": "BD", "side": "AE", "foot": "ED"}, 2
        ),
        "Scissor lift": Drawn(scissor, bars, 1, slots=slots),
        "Five-bar": Drawn(
            {"A": (0.0, 0.0), "B": (-0.4, 1.0), "C": (1.1, 1.9), "D": (2.6, 0.9), "E": (2.0, 0.0)},
            {"ground": "AE", "left": "AB", "low": "BC", "high": "CD", "right": "DE"},
            2,
        ),
    }


def parallel_robots() -> dict[str, Drawn]:
    """Platforms on three legs."""
    feet = {"A": (0.0, 0.0), "B": (4.0, 0.2), "C": (1.8, 3.4)}
    corners = {"P": (1.3, 1.0), "Q": (2.5, 1.1), "R": (1.9, 2.0)}
    knees = {"K": (0.4, 1.2), "L": (3.6, 1.3), "M": (2.8, 2.9)}
    legs = {"a": "AK", "b": "BL", "c": "CM", "d": "KP", "e": "LQ", "f": "MR"}
    pairs = (("A", "P", "r"), ("B", "Q", "s"), ("C", "R", "t"))
    middle = {
        s: tuple(0.5 * (u + v) for u, v in zip(feet[a], corners[p], strict=True))
        for a, p, s in pairs
    }
    way = {
        s: float(atan2(corners[p][1] - feet[a][1], corners[p][0] - feet[a][0]) * 180 / pi)
        for a, p, s in pairs
    }
    tubes = {f"tube{s}": a + s for a, _, s in pairs} | {f"rod{s}": p + s for _, p, s in pairs}
    return {
        "3-RRR platform": Drawn(
            feet | corners | knees, {"ground": "ABC", "platform": "PQR", **legs}, 3
        ),
        "3-RPR platform": Drawn(
            feet | corners | middle,  # type: ignore[operator]
            {"ground": "ABC", "platform": "PQR", **tubes},
            3,
            tuple((f"tube{s}", f"rod{s}", s, way[s]) for *_, s in pairs),
        ),
        "Platform on three bars": Drawn(
            feet | corners, {"ground": "ABC", "platform": "PQR", "a": "AP", "b": "BQ", "c": "CR"}, 0
        ),
    }


def redundant() -> dict[str, Drawn]:
    """Mechanisms that move against Grübler's count, and structures."""
    feet, tops = {"A": (0.0, 0.0), "B": (1.0, 0.0), "C": (2.5, 0.0)}, {}
    tops = {"P": (0.3, 0.7), "Q": (1.3, 0.7), "R": (2.8, 0.7)}
    second = {"S": (0.45, 1.05), "T": (1.45, 1.05)}
    rails = {"l": (0.0, 0.0), "r": (0.0, 0.6)}
    return {
        "Truss of two bars": Drawn(
            {"A": (0.0, 0.0), "B": (2.0, 0.0), "C": (0.8, 1.0)},
            {"ground": "AB", "left": "AC", "right": "BC"},
            0,
        ),
        "Beam on two pins": Drawn(
            {"A": (0.0, 0.0), "B": (2.0, 0.0)}, {"ground": "AB", "beam": "AB"}, 0
        ),
        "Three cranks on a rod": Drawn(
            feet | tops, {"ground": "ABC", "rod": "PQR", "a": "AP", "b": "BQ", "c": "CR"}, 1
        ),
        "Double parallelogram": Drawn(
            {k: v for k, v in (feet | tops | second).items() if k not in "CR"},
            {"ground": "AB", "left": "APS", "right": "BQT", "low": "PQ", "high": "ST"},
            1,
        ),
        "Drawer in two rails": Drawn(
            rails,
            {"ground": "lr", "drawer": "lr"},
            1,
            (("ground", "drawer", "l", 0.0), ("ground", "drawer", "r", 0.0)),
        ),
    }


def geared() -> dict[str, Drawn]:
    """Linkages with gears."""
    five = walkers_and_lifts()["Five-bar"]
    train = {"A": (0.0, 0.0), "B": (0.3, 0.0), "C": (0.6, 0.1)}
    wheels = {"ground": "ABC", "one": "A", "two": "B", "three": "C"}
    pairs = (("one", "two", "A", "B"), ("two", "three", "B", "C"))
    return {
        "Geared five-bar": Drawn(five.points, five.bodies, 1, gears=(("left", "right", "A", "E"),)),
        "Gear train": Drawn(train, wheels, 1, gears=pairs),
        "Planetary gear": Drawn(
            {"A": (0.0, 0.0), "B": (0.3, 0.0)},
            {"ground": "A", "arm": "AB", "sun": "A", "planet": "B"},
            2,
            gears=(("sun", "planet", "A", "B"),),
        ),
    }


NAMED: dict[str, Drawn] = {
    "Pendulum": Drawn({"A": (0.0, 0.0), "b": (0.6, -0.8)}, {"ground": "A", "rod": "Ab"}, 1),
    "Double pendulum": Drawn(
        {"A": (0.0, 0.0), "B": (0.6, -0.8), "c": (1.6, -1.1)},
        {"ground": "A", "upper": "AB", "lower": "Bc"},
        2,
    ),
    "Crank-rocker": four_bar(4, 1, 3.5, 2.5, 70),
    "Drag link": four_bar(1, 2.2, 3.5, 2.9, 100),
    "Four-bar with short coupler": four_bar(4, 3.3, 1.1, 3.3, 66),
    "Chebyshev's lambda linkage": four_bar(2, 1, 2.5, 2.5, 80),
    "Chebyshev's straight line": four_bar(4, 5, 2, 5, 60),
    "Roberts's straight line": four_bar(2, 1.2, 1, 1.2, 70),
    "Watt's straight line": Drawn(
        {"A": (-4.0, -1.0), "B": (-0.1, -0.9), "C": (0.1, 0.9), "D": (4.0, 1.0)},
        {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"},
        1,
    ),
    "Parallelogram": four_bar(2, 1.1, 2, 1.1, 65),
    "Antiparallelogram": antiparallelogram(),
    "Kite": four_bar(1, 1, 2.5, 2.5, 55),
    **slider_cranks(),
    **six_bars(),
    **straight_lines(),
    **walkers_and_lifts(),
    **parallel_robots(),
    **redundant(),
    **geared(),
}


def row(name: str, drawn: Drawn) -> str:
    """The row of the table."""
    model = drawn.model(name)
    found = kp.mobility(model, drawn.state(model))
    kinds = sorted({loop.kind for loop in found.four_bars})
    n, m = 3 * (len(drawn.bodies) - 1), len(drawn.jacobian())
    cells = name, n, m, found.gruebler, found.rank, found.degrees_of_freedom, ", ".join(kinds)
    return f"| {' | '.join(map(str, cells))} |"


def table() -> str:
    """The table of docs/mobility.md."""
    head = (
        "| mechanism | coordinates | equations | Grübler | rank | degrees of freedom "
        "| four-bar loops |\n|---|---|---|---|---|---|---|\n"
    )
    return head + "\n".join(row(name, drawn) for name, drawn in NAMED.items())


if __name__ == "__main__":
    print(table())
