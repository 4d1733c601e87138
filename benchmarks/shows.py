"""The targets, judged by the records of one run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from peers import kempe_itself
from record import Record

#: Curves of kempe with its default method at various tolerances.
DEFAULT = (kempe_itself.DEFAULT, kempe_itself.DEFAULT_METHOD)
#: Tools that compute positions and velocities only.
STATES_ALONE = ("mujoco", "exudyn", "casadi")
#: Not a target, but reported as well.
INFORMATION = "for information"


@dataclass(frozen=True)
class Target:
    """A target, the measured value (text), and whether it is met; None: not measured."""

    what: str
    asked: str
    measured: str
    met: bool | None

    @property
    def verdict(self) -> str:
        """The verdict as in the table."""
        if self.asked == INFORMATION:
            return ""
        return {True: "met", False: "not met", None: "not measured"}[self.met]


def cheapest(records: list[Record], enough: Callable[[Record], bool]) -> Record | None:
    """The record with the least time among those with a sufficiently small error."""
    return min((r for r in records if r.good and enough(r)), key=lambda r: r.seconds, default=None)


def of(records: list[Record], problem: str, tool: str) -> list[Record]:
    """Records of one tool on one problem."""
    return [r for r in records if r.problem == problem and r.tool == tool]


def label(record: Record) -> str:
    """Curve and tolerance."""
    return f"{record.curve}, {record.tolerance:g}" if record.tolerance else record.curve


def against(mine: Record | None, peers: list[Record], asked: float, name: str) -> Target:
    """Ratio of the time of another tool, at no larger error, to that of kempe."""
    wanted = f"≥ {asked:g} ×"
    good = [r for r in peers if r.good]
    if mine is None or not good:
        why = "no setting of kempe meets the error" if mine is None else "no run of it"
        return Target(name, wanted, why, False if mine is None else None)
    peer = cheapest(good, lambda r: r.error <= mine.error)
    if peer:
        ratio = peer.seconds / mine.seconds
        told = f"{ratio:.3g} × ({label(peer)}: {1e3 * peer.seconds:.3g} ms, error {peer.error:.1e})"
        return Target(name, wanted, told, ratio >= asked)
    # The tool never reaches the error of kempe. Its most accurate run gives a lower bound of the
    # ratio. A bound below the target does not meet it.
    best = min(good, key=lambda r: r.error)
    ratio = best.seconds / mine.seconds
    told = f"> {ratio:.3g} × (it reaches {best.error:.1e} at best, {label(best)})"
    return Target(name, wanted, told, ratio >= asked)


def evaluation(floor: dict[str, Any]) -> list[Target]:
    """Targets for evaluations."""
    at = floor["evaluation"]
    ratio, straight, other, centred = (
        at[name]
        for name in (
            "kempe_over_chain",
            "kempe_over_straight",
            "other_over_kempe",
            "centred_over_kempe",
        )
    )
    return [
        Target(
            "evaluation of the flagship over the floor",
            "≤ 1.6",
            f"{ratio:.2f} ({at['kempe_ns']:.0f} ns, floor {at['chain_ns']:.0f} ns)",
            ratio <= 1.6,
        ),
        Target(
            "the same over the floor without its closed forms",
            INFORMATION,
            f"{straight:.2f} ({at['straight_ns']:.0f} ns)",
            straight <= 1.6,
        ),
        Target("a linkage nothing was tuned on", "≤ 1.1", f"{centred:.2f}", centred <= 1.1),
        Target(
            "the same with frames off the mass centres: M couples rotation and translation",
            INFORMATION,
            f"{other:.2f}",
            other <= 1.1,
        ),
    ]


def flagship(records: list[Record], floor: dict[str, Any]) -> list[Target]:
    """Targets for runs of the flagship."""
    python = floor["python"]
    mine, by_hand = python["kempe_seconds"], python["chain_seconds"]
    ratio, straight = mine / by_hand, mine / python["straight_seconds"]
    found = [
        Target(
            "flagship, RK45, Baumgarte(10, 200), 1e-6, from Python over the floor's run",
            "≤ 1.6",
            f"{ratio:.2f} ({1e3 * mine:.2f} ms, floor {1e3 * by_hand:.2f} ms)",
            ratio <= 1.6,
        ),
        Target(
            "the same over the floor without its closed forms",
            INFORMATION,
            f"{straight:.2f} ({1e3 * python['straight_seconds']:.2f} ms)",
            straight <= 1.6,
        ),
    ]
    kempe = of(records, "flagship", "kempe")
    default = [r for r in kempe if r.curve in DEFAULT]
    hands = (by_hand, python["straight_seconds"])
    found += exact_run(records, default, "default method", hands)
    untouched = [r for r in kempe if r.curve == kempe_itself.DEFAULT]
    return found + exact_run(records, untouched, "the default, no option named", hands)


def exact_run(
    records: list[Record], pool: list[Record], name: str, hands: tuple[float, float]
) -> list[Target]:
    """The cheapest run that is exact at all listed states, against floor and other tools.

    ``hands`` are the times of the floor's run with and without closed forms, s.
    """
    by_hand, straight = hands

    def exact(r: Record) -> bool:
        return r.more["angle_error"] <= 1e-6 and r.gap <= 1e-10

    chosen = cheapest(pool, exact)
    what = f"flagship, {name}, angles within 1e-6 rad, gap within 1e-10 m, over the floor's run"
    if chosen is None:
        return [Target(what, "≤ 0.5", "no setting is accurate enough", False)]
    share = chosen.seconds / by_hand
    told = f"{share:.2f} ({label(chosen)}: {1e3 * chosen.seconds:.2f} ms, error {chosen.error:.1e})"
    found = [Target(what, "≤ 0.5", told, share <= 0.5)]
    share = chosen.seconds / straight
    what = "the same over the floor without its closed forms"
    found.append(Target(what, INFORMATION, f"{share:.2f}", share <= 0.5))
    for tool, asked in (("scipy", 2500), ("mujoco", 100), ("exudyn", 100), ("casadi", 40)):
        peers, what = of(records, "flagship", tool), f"that run ({name}) against {tool}"
        if tool not in STATES_ALONE:
            found.append(against(chosen, peers, asked, what))
            continue
        alike = states_alone(records, chosen)
        found.append(against(alike, peers, asked, f"{what}, states alone"))
        if tool == "casadi":
            more = against(chosen, peers, asked, f"{what}, accelerations and multipliers as well")
            found.append(replace(more, asked=INFORMATION))
    return found


def states_alone(records: list[Record], chosen: Record) -> Record | None:
    """The same run of kempe without accelerations and multipliers, if it was measured."""
    curve = kempe_itself.STATES.get(chosen.curve)
    mine = of(records, chosen.problem, chosen.tool)
    alike = (r for r in mine if r.curve == curve and r.tolerance == chosen.tolerance)
    return next(alike, None)


def n_four_bar(records: list[Record], floor: dict[str, Any]) -> list[Target]:
    """Targets for the N-four-bar."""
    found = []
    chosen = {}
    for n, asked in ((1, 1e-7), (2, 1e-7), (40, 1e-7), (1000, 1e-5)):
        mine = [r for r in of(records, f"n_four_bar_{n}", "kempe") if r.curve in DEFAULT]
        best = min((r for r in mine if r.good), key=lambda r: r.error, default=None)
        chosen[n] = cheapest(mine, lambda r, asked=asked: r.error <= asked)
        told = "no run reached the end" if best is None else f"{best.error:.1e} ({label(best)})"
        name = f"N-four-bar, N = {n}, 10 s: error on B0, m"
        met = chosen[n] is not None if mine else None
        found.append(Target(name, f"≤ {asked:g}", told if mine else "no run", met))
    one = chosen[1]
    told = f"{1e3 * one.seconds:.2f} ms ({label(one)})" if one else "no setting is accurate enough"
    found.append(Target("N = 1 at that error", "≤ 3 ms", told, bool(one and one.seconds <= 3e-3)))
    at = {int(n): ns for n, ns in floor["windows"].items()}
    for n in (100, 4000):
        ratio = max(at[1000] / at[n], at[n] / at[1000])
        name = f"evaluation and window, N = 1000 against N = {n}"
        found.append(Target(name, "within 1.5 ×", f"{ratio:.2f} ×", ratio <= 1.5))
    found.append(
        Target("evaluation and window, N = 1000", "≤ 500 ns", f"{at[1000]:.0f} ns", at[1000] <= 500)
    )
    for n in (1, 40):
        for tool, asked in (("exudyn", 20), ("mujoco", 5)):
            peers = of(records, f"n_four_bar_{n}", tool)
            found.append(against(chosen[n], peers, asked, f"N = {n} against {tool}"))
    return found


def andrews(records: list[Record]) -> list[Target]:
    """The target for the time of the squeezer."""
    kempe = of(records, "andrews", "kempe")
    chosen = cheapest(kempe, lambda r: r.error <= 1e-10)
    told = (
        f"{1e3 * chosen.seconds:.2f} ms ({label(chosen)}, {chosen.error:.1e})" if chosen else "none"
    )
    met = chosen is not None and chosen.seconds <= 5e-3
    return [Target("squeezer to 0.03 s, angles within 1e-10", "≤ 5 ms", told, met)]


def targets(found: dict[str, Any], records: list[Record]) -> list[Target]:
    """All targets that the measurements can judge."""
    floor, measured = found.get("floor"), {r.problem for r in records}
    judged = evaluation(floor) if floor else []
    if floor and "flagship" in measured:
        judged += flagship(records, floor)
    if floor and any(name.startswith("n_four_bar") for name in measured):
        judged += n_four_bar(records, floor)
    return judged + (andrews(records) if "andrews" in measured else [])
