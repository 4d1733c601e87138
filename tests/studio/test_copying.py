"""Copies and mirror images of bodies."""

import math
from typing import Any

import pytest
from studio.window import Studio

#: A plate whose frame is not that of ground, with its mass centre off its points.
PLATE = """kempe = 1
[bodies.ground]
points = {}
[bodies.plate]
mass = 2
inertia = 0.3
center = [0.2, 0.1]
points = { P = [-0.25, 0], Q = [0.25, 0], R = [0.1, 0.3] }
through = { P = [1, 1], Q = [1.3, 1.4] }
"""


def chosen(one: Studio, name: str) -> None:
    """Select a body from the list of contents."""
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Escape")
    one.page.get_by_role("button", name=name).first.click()


def place(one: Studio, body: str, point: str) -> tuple[float, float]:
    return one.quantity(f"{body}.{point}.x"), one.quantity(f"{body}.{point}.y")


def shape(one: Studio, body: str) -> list[float]:
    """Distances of the points and the mass centre, and on which side of PQ the others are."""
    p, q, r = (place(one, body, point) for point in "PQR")
    tree: dict[str, Any] = one.tree()["bodies"][body]
    px, py = tree["points"]["P"]
    cx, cy = tree["center"]
    side = math.copysign(1, (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))
    return [math.dist(p, q), math.dist(q, r), math.dist(p, r), math.dist((px, py), (cx, cy)), side]


def test_a_copied_body_is_pasted_beside_it(one: Studio) -> None:
    one.load(PLATE)
    chosen(one, "plate")
    one.page.locator("#sheet").focus()
    one.page.keyboard.press("Control+c")
    one.page.keyboard.press("Control+v")
    one.settle()
    assert list(one.tree()["bodies"]) == ["ground", "plate", "plate1"]
    assert shape(one, "plate1") == pytest.approx(shape(one, "plate"), rel=1e-9)
    (px, py), (x, y) = place(one, "plate", "P"), place(one, "plate1", "P")
    assert x - px == pytest.approx(py - y, rel=1e-9)
    assert x > px
    assert one.page.locator("#entry-name").input_value() == "plate1"
    one.page.keyboard.press("Control+z")
    one.settle()
    assert one.toml() == PLATE


def test_a_mirrored_body_has_its_points_on_the_other_side(one: Studio) -> None:
    one.load(PLATE)
    chosen(one, "plate")
    before = shape(one, "plate")
    old = [place(one, "plate", point) for point in "PQR"]
    one.page.get_by_role("button", name="Mirror").click()
    one.settle()
    after = shape(one, "plate")
    assert after[:-1] == pytest.approx(before[:-1], rel=1e-9)
    assert after[-1] == -before[-1]
    across = [x for x, _ in old]
    middle = min(across) + max(across)
    for (x, y), point in zip(old, "PQR", strict=True):
        assert place(one, "plate", point) == pytest.approx((middle - x, y), abs=1e-9)


def test_a_body_that_has_no_mirror_image_gives_a_message(one: Studio) -> None:
    one.load(
        PLATE.replace("inertia = 0.3", "inertia = 0.3\noutline = [[0, 0], [0.5, 0], [0, 0.4]]")
    )
    text = one.toml()
    chosen(one, "plate")
    one.page.get_by_role("button", name="Mirror").click()
    one.settle()
    assert "plate cannot be mirrored" in one.message()
    assert one.toml() == text
