"""Arrows have the direction and the magnitude of the solution, name their body and stay in view."""

from collections.abc import Callable
from typing import Any

import kempe as kp
import numpy as np
import pytest
from browser.test_values import example, read
from draw.mechanisms import moving, slider_crank

from examples import n_four_bar

MADE: dict[str, Callable[[], kp.Solution]] = {
    "four_bar": moving,
    "slider_crank": slider_crank,
    "six_bar": lambda: example("six_bar"),
}


def arrows(watched: Any, kind: str) -> dict[str, dict[str, Any]]:
    return {one["element"]: one for one in watched.state()["arrows"] if one["kind"] == kind}


def vector(arrow: dict[str, Any]) -> np.ndarray:
    """From foot to tip, px, y upwards."""
    return np.subtract(arrow["to"], arrow["from"]) * [1, -1]


@pytest.mark.parametrize("name", MADE)
def test_reactions(opened: Any, name: str) -> None:
    solution = MADE[name]()
    watched = opened(solution, 1280, 800)
    watched.page.check("#show-reactions")
    t = 0.4 * float(solution.t[-1])
    watched.seek(t)
    at, found = solution(t), arrows(watched, "reactions")
    written = {one["text"] for one in watched.texts("#drawing")}
    ratios = []
    pins = {pin["name"]: pin for pin in watched.state()["pins"]}
    corner = watched.page.locator("#drawing").bounding_box()
    for joint, info in at.model.joints.items():
        force = at.constraint(joint).force(on=info.j)
        text, _, body = found[joint]["text"].partition(" on ")
        value, half, unit = read(text)
        assert (body, unit) == (info.j, "N")
        assert value == pytest.approx(np.hypot(*force), abs=half)
        assert found[joint]["text"] in written
        foot = [pins[joint]["x"] - corner["x"], pins[joint]["y"] - corner["y"]]
        assert found[joint]["from"] == pytest.approx(foot, abs=0.01)
        along = vector(found[joint])
        across = along[0] * force[1] - along[1] * force[0]
        assert abs(across) < 1e-6 * np.hypot(*along) * np.hypot(*force)
        assert along @ force > 0
        if found[joint]["whole"]:
            ratios.append(np.hypot(*along) / np.hypot(*force))
    assert np.ptp(ratios) < 1e-6 * max(ratios)  # one scale


@pytest.mark.parametrize("name", MADE)
@pytest.mark.parametrize(("kind", "unit"), [("velocities", "m/s"), ("accelerations", "m/s²")])
def test_velocities_and_accelerations(opened: Any, name: str, kind: str, unit: str) -> None:
    solution = MADE[name]()
    watched = opened(solution, 1280, 800)
    watched.page.check(f"#show-{kind}")
    t = 0.3 * float(solution.t[-1])
    watched.seek(t)
    found = arrows(watched, kind)
    assert len(found) >= 2
    quantity = {"velocities": "velocity", "accelerations": "acceleration"}[kind]
    for traced, arrow in found.items():
        body, _, point = traced.partition(".")
        right = getattr(solution(t).body(body).point(point), quantity)
        text, _, named = arrow["text"].rpartition(" ")
        value, half, si = read(text)
        assert (named, si) == (traced, unit)
        assert value == pytest.approx(np.hypot(*right), abs=1.5 * half)
        along = vector(arrow) / np.hypot(*vector(arrow))
        np.testing.assert_allclose(along, right / np.hypot(*right), atol=2e-3)


def test_a_body_without_points_has_arrows_at_its_mass_centre(opened: Any) -> None:
    m = kp.Model("free", gravity=(0, -9.81))
    m.body("stone", mass=1, inertia=0.1, points={})
    start = kp.assemble(m, set={"stone.vx": 3.0, "stone.vy": 4.0})
    watched = opened(kp.dynamics(m, start, t_end=1.0, output_step=0.1), 1280, 800)
    watched.page.check("#show-velocities")
    watched.page.check("#show-accelerations")
    watched.settle()
    assert arrows(watched, "velocities")["stone"]["text"] == "5.00 m/s stone"
    assert arrows(watched, "accelerations")["stone"]["text"] == "9.81 m/s² stone"


@pytest.mark.parametrize("size", [(1280, 800), (390, 844), (844, 390)], ids=str)
def test_arrows_and_their_texts_stay_in_view(opened: Any, size: tuple[int, int]) -> None:
    solution = example("six_bar")
    watched = opened(solution, *size)
    for kind in ("reactions", "velocities", "accelerations"):
        watched.page.check(f"#show-{kind}")
    for _ in range(8):
        watched.page.click("#longer")
    box = watched.page.locator("#drawing").bounding_box()
    shortened = 0
    for t in (0.1, 0.5, 0.74, 1.3):
        watched.seek(t)
        found = watched.state()["arrows"]
        assert len(found) > 10
        for arrow in found:
            shortened += not arrow["whole"]
            spots = [arrow["to"]]
            if arrow.get("box"):
                spots += [arrow["box"][:2], arrow["box"][2:]]
            for x, y in spots:
                assert 0 <= x <= box["width"], arrow
                assert 0 <= y <= box["height"], arrow
    assert shortened > 10
    watched.page.click("#shorter")


def test_an_arrow_outside_of_the_view_is_left_out(opened: Any) -> None:
    watched = opened(example("six_bar"), 1280, 800)
    watched.page.check("#show-reactions")
    watched.settle()
    assert len(arrows(watched, "reactions")) == 7
    for _ in range(12):
        watched.page.click("#zoom-in")
    watched.settle()
    assert len(arrows(watched, "reactions")) < 7


@pytest.mark.parametrize("kind", ["velocity", "acceleration"])
def test_arrows_have_the_scale_of_the_scene(opened: Any, kind: str) -> None:
    """The scene leaves out values beside singular positions, so the page must take its scale."""
    model = n_four_bar.windows(2)
    start = n_four_bar.upright(model, 2)
    solution = kp.dynamics(model, start, t_end=3, output_step=0.01, dense_output=True)
    told = kp.scene(solution)
    (left, low), (right, high) = np.array(told["bounds"]).reshape(2, 2)
    unit = 0.22 * max(right - left, high - low) / told["largest"][kind]
    watched = opened(solution, 1280, 800)
    shown = "velocities" if kind == "velocity" else "accelerations"
    watched.page.check(f"#show-{shown}")
    watched.seek(0.3)
    pins = {pin["name"]: (pin["x"], pin["y"]) for pin in watched.state()["pins"]}
    metre = np.hypot(*np.subtract(pins["A1"], pins["A0"]))  # the cranks stand 1 m apart
    found = {name: one for name, one in arrows(watched, shown).items() if one["whole"]}
    assert found
    for name, arrow in found.items():
        body, _, point = name.partition(".")
        size = np.hypot(*getattr(solution(0.3).body(body).point(point), kind))
        assert np.hypot(*vector(arrow)) == pytest.approx(size * unit * metre, rel=1e-3)
