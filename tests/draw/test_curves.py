"""Curves of bodies and the symbols of joints on them."""

from __future__ import annotations

import kempe as kp
import numpy as np
import pytest


def cam(joint: str, **fields: float) -> kp.Model:
    m = kp.Model("cam", gravity=(0, -9.81))
    m.ground.points(O=(0, 0))
    m.ground.curves(floor={"line": [(-0.1, -0.1), (0.1, -0.1)]})
    rim = {"circle": (0.02, 0, 0.05)}
    m.body("cam", mass=2, inertia=0.01, points={"O": (0, 0)}, curves={"rim": rim})
    m.body("follower", mass=1, inertia=0.001, points={"P": (0, 0)})
    m.revolute("shaft", "ground.O", "cam.O")
    m.translational("guide", "ground.O", "follower.P", axes=("90*deg", "90*deg"))
    getattr(m, f"{joint}_on_curve")("contact", "follower.P", "cam.rim", **fields)
    m.coordinate_driver("motor", "cam.angle", value="10*t")
    return m


def scene(m: kp.Model) -> dict[str, object]:
    start = kp.assemble(m, guess={"follower.y": 0.1})
    return kp.scene(kp.dynamics(m, start, t_end=2 * np.pi / 10, output_step=0.01))


def test_curves_are_outlines_and_belong_to_the_area() -> None:
    found = scene(cam("point"))
    ground, body, follower = found["bodies"]
    assert ground["curves"] == [{"points": [[-0.1, -0.1], [0.1, -0.1]], "closed": False}]
    (rim,) = body["curves"]
    assert rim["closed"]
    radii = np.hypot(*(np.array(rim["points"]) - [0.02, 0]).T)
    np.testing.assert_allclose(radii, 0.05, rtol=1e-8)
    assert follower["curves"] == []
    assert found["bounds"][2] == pytest.approx(0.1)  # of the floor
    assert found["bounds"][0] == pytest.approx(-0.1)


@pytest.mark.parametrize(
    ("joint", "fields", "mark"),
    [("point", {}, "touch"), ("roller", {"radius": 0.01}, "roller"), ("flat", {}, "face")],
)
def test_a_joint_on_a_curve_has_its_symbol_on_body_i(
    joint: str, fields: dict[str, float], mark: str
) -> None:
    found = scene(cam(joint, **fields))
    (symbol,) = (one for one in found["symbols"] if one["element"] == "contact")
    assert (symbol["mark"], symbol["bodies"]) == (mark, [2, 1])
    radius = fields.get("radius")
    assert symbol["radii"] == (None if radius is None else [radius, 0.0])
    contact = next(one for one in found["joints"] if one["name"] == "contact")
    assert contact["bodies"] == [2, 2]
    if mark == "face":  # the contact is at x = e cos φ, to a step of the drawn curve
        np.testing.assert_allclose(symbol["reach"], [-0.02, 0.02], atol=1.4e-3)
