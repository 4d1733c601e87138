"""Arrows of reactions and forces: components, feet and signs on every body, in N and m."""

import re
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from browser.test_values import example, read
from draw.forces import on_body
from draw.mechanisms import four_bar, resting

KINDS = ("reactions", "force")
#: The view is made wider, so that all arrows are whole; they keep their length on the screen.
ZOOMS = 4


class Scale:
    """Converts arrows of a page to components in N and places in m.

    The scale of an arrow is that of the scene, and the scale of the plane is that of two pins.
    """

    def __init__(self, watched: Any, solution: kp.Solution, t: float) -> None:
        self.watched, self.scene = watched, kp.scene(solution)
        pins = {pin["name"]: np.array([pin["x"], -pin["y"]]) for pin in watched.state()["pins"]}
        box = watched.page.locator("#drawing").bounding_box()
        self.corner = np.array([box["x"], -box["y"]])
        at = solution(t)
        known = {name: at.place(name, info.j) for name, info in at.compiled.joints.items()}
        first = min(known)
        other = max(known, key=lambda name: float(np.hypot(*(known[name] - known[first]))))
        self.metre = float(
            np.hypot(*(pins[other] - pins[first])) / np.hypot(*(known[other] - known[first]))
        )
        low, high = np.array(self.scene["bounds"]).reshape(2, 2)
        self.extent = float(max(high - low))
        self.origin = pins[first] - self.corner - self.metre * known[first]

    def newton(self, kind: str) -> float:
        """The length of 1 N, px."""
        fitted = self.metre / 0.8**ZOOMS
        if kind == "reactions":
            unit = self.scene["reaction_scale"]
            return fitted * unit["length"] / unit["force"]
        return fitted * 0.22 * self.extent / self.scene["largest"]["force"]

    def arrows(self) -> dict[str, dict[str, Any]]:
        """Force in N, place in m and text of each arrow, by element."""
        found = {}
        for one in self.watched.state()["arrows"]:
            assert one["whole"], one
            foot, tip = (np.array(one[end]) * [1, -1] for end in ("from", "to"))
            found[one["element"]] = {
                "force": (tip - foot) / self.newton(one["kind"]),
                "place": (foot - self.origin) / self.metre,
                "text": one["text"],
            }
        return found


def settled(watched: Any, solution: kp.Solution, share: float) -> float:
    """Show all forces at a frame, and return its time."""
    times = kp.scene(solution)["frames"]["t"]
    t = float(times[round(share * (len(times) - 1))])
    for kind in KINDS:
        if watched.page.locator(f"#show-{kind}").is_visible():
            watched.page.check(f"#show-{kind}")
    for _ in range(ZOOMS):
        watched.page.click("#zoom-out")
    watched.seek(t)
    return t


@pytest.mark.parametrize(
    ("name", "share"),
    [
        ("balanced_lamp", 0.3),
        ("crane_trolley", 0.25),
        ("jumping_follower", 0.4),
        ("motor_press", 0.45),
        ("pantograph", 0.6),
        ("squeezer", 0.35),
    ],
)
def test_arrows_on_each_body_are_the_forces_of_the_solution(
    opened: Any, name: str, share: float
) -> None:
    solution = example(name)
    watched = opened(solution, 1280, 800)
    t = settled(watched, solution, share)
    scale, at = Scale(watched, solution, t), solution(t)
    frame = scale.scene["frames"]["t"].index(t)
    elements = at.compiled.constraints | at.compiled.forces
    signs: dict[str, list[np.ndarray]] = {}
    for body in at.compiled.all_bodies:
        watched.page.select_option("#on-body", label=body)
        watched.settle()
        shown, ends = scale.arrows(), on_body(scale.scene, body)
        for element, info in elements.items():
            kind = "reactions" if element in at.compiled.joints else "force"
            right = at[element].force(on=body) if body in info.bodies else np.zeros(2)
            least = 1.01 / scale.newton(kind)  # an arrow of less than a pixel is not drawn
            if element not in shown:
                assert np.hypot(*right) < least or element not in ends, (element, body)
                continue
            arrow = shown[element]
            size = np.hypot(*right)
            np.testing.assert_allclose(arrow["force"], right, atol=1e-5 * size)
            value, half, unit = read(arrow["text"].partition(" on ")[0])
            assert arrow["text"].endswith(f" on {body}")
            assert (value, unit) == (pytest.approx(size, abs=1.5 * half), "N")
            places = [ends[element][1][frame]]
            places += [at.place(element, body)] if element in at.compiled.constraints else []
            for place in places:
                np.testing.assert_allclose(arrow["place"], place, atol=1e-4 * scale.extent)
            signs.setdefault(element, []).append(arrow["force"])
    pairs = [forces for forces in signs.values() if len(forces) == 2]
    assert len(pairs) >= 2
    for one, other in pairs:
        np.testing.assert_allclose(one, -other, atol=1e-6 * np.hypot(*one))


def test_without_a_body_each_force_is_that_on_body_j(opened: Any) -> None:
    solution = example("balanced_lamp")
    watched = opened(solution, 1280, 800)
    t = settled(watched, solution, 0.3)
    at, shown = solution(t), Scale(watched, solution, t).arrows()
    assert set(shown) == {"A", "B", "C", "D", "spring"}
    for element, arrow in shown.items():
        on = at[element].info.j
        np.testing.assert_allclose(arrow["force"], at[element].force(on=on), rtol=1e-5, atol=1e-6)
        assert arrow["text"].endswith(f" on {on}")


def test_velocities_of_a_chosen_body_are_those_of_its_points(opened: Any) -> None:
    solution = example("balanced_lamp")
    watched = opened(solution, 1280, 800)
    watched.page.check("#show-velocities")
    watched.page.select_option("#on-body", label="arm")
    watched.seek(0.3)
    shown = {one["element"] for one in watched.state()["arrows"]}
    assert shown
    assert {name.partition(".")[0] for name in shown} == {"arm"}


def test_the_switch_of_forces_is_there_where_there_are_forces(opened: Any) -> None:
    assert opened(example("double_pendulum"), 1280, 800).page.locator("#forces").is_hidden()
    assert opened(example("balanced_lamp"), 1280, 800).page.locator("#forces").is_visible()


def test_reactions_that_are_not_unique_are_marked(opened: Any) -> None:
    model = four_bar()
    model.revolute("again", "ground.D", "rocker.D")
    guess = {"coupler.angle": "14*deg", "rocker.angle": "240*deg"}
    state = kp.assemble(model, set={"crank.angle": "70*deg"}, guess=guess, redundancy="allow")
    watched = opened(state, 1280, 800)
    watched.page.check("#show-reactions")
    watched.settle()
    texts = {one["element"]: one["text"] for one in watched.state()["arrows"]}
    for name in ("D", "again"):
        assert texts[f"{name} (minimum norm)"].endswith(" on rocker *")
    assert texts["B"].endswith(" on coupler")
    assert "* minimum norm" in {one["text"] for one in watched.texts("#drawing")}


def test_a_state_on_a_rigid_stop_says_why_it_has_no_reactions(opened: Any) -> None:
    watched = opened(resting(0.3), 1280, 800)
    reason = kp.scene(resting(0.3))["undetermined"]
    watched.page.check("#show-velocities")
    watched.settle()
    assert reason not in {one["text"] for one in watched.texts("#drawing")}
    watched.page.check("#show-force")
    watched.settle()
    assert {one["element"] for one in watched.state()["arrows"]} == {"spring"}
    assert reason in {one["text"] for one in watched.texts("#drawing")}


def test_reactions_without_bound_are_marked(opened: Any) -> None:
    watched = opened(example("garage_door"), 1280, 800)
    watched.settle()
    notes = [one["text"] for one in watched.texts("#drawing") if "bound" in one["text"]]
    assert notes == []
    watched.page.check("#show-reactions")
    watched.seek(2.0)
    assert all(one["text"].endswith(" *") for one in watched.state()["arrows"])
    notes = [one["text"] for one in watched.texts("#drawing") if "bound" in one["text"]]
    assert notes == ["* without bound at 1.398 s"]


def test_forces_take_little_of_the_file(tmp_path: Path) -> None:
    """Components are in frames and channels already; ends are a few lines."""
    path = kp.player(example("four_bar"), tmp_path / "animation.html")
    text = path.read_text(encoding="utf-8")
    ends = re.search(r'"ends":\[.*?\],"channels"', text)
    assert ends
    assert len(ends[0]) < 0.005 * len(text)
