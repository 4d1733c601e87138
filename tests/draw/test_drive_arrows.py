"""The arrow of a driver points where its body goes."""

import itertools

import kempe as kp
import numpy as np
import pytest
from kempe.draw.scene import scene


def machine(spin: str, shift: str, size: float = 1.0) -> kp.Solution:
    """A turned frame with a driven slide on it, and a wheel that turns on the frame."""
    m = kp.Model("machine")
    m.ground.points(O=(0, 0))
    m.body("frame", mass=1, inertia=1, points={"O": (0, 0), "P": (size, 0)})
    m.body("block", mass=1, inertia=1, points={"S": (0.1 * size, 0)})
    m.body("wheel", mass=1, inertia=1, points={"W": (0, 0.2 * size)})
    m.weld("fixed", "ground.O", "frame.O", angle="150*deg")
    m.translational("slide", "frame.O", "block.S")
    m.revolute("hub", "frame.P", "wheel.W")
    m.coordinate_driver("push", "slide.displacement", value=f"{size}*(0.5 + {shift})")
    m.coordinate_driver("motor", "hub.angle", value=spin)
    return kp.kinematics(m, kp.assemble(m), t_end=0.5, output_step=0.05)


def marks(of: kp.Solution | kp.State) -> dict[str, dict]:
    found = {one["element"]: one for one in scene(of)["symbols"] if "drive" in one["mark"]}
    assert set(found) == {"push", "motor"}
    return found


@pytest.mark.parametrize(
    ("spin", "shift", "size"),
    [(*s, 1.0) for s in itertools.product((-1, 1), repeat=2)] + [(-1, -1, 1e-3), (-1, -1, 1e3)],
)
def test_arrows_have_the_sense_of_the_motion(spin: int, shift: int, size: float) -> None:
    solution = machine(f"{2 * spin}*t", f"{0.3 * shift}*t", size)
    for drawn in (solution, solution.final):
        found = marks(drawn)
        assert found["motor"]["sense"] == spin
        # the axis is in the frame of the frame, which is turned by 150°
        angle = found["push"]["axes"][0] + np.radians(150)
        direction = np.array([np.cos(angle), np.sin(angle)])
        first, last = (solution(t).body("block").r for t in (0.0, 0.5))
        assert direction @ (last - first) == pytest.approx(0.15 * size, rel=1e-9)


def test_a_driver_that_reverses_has_the_sense_of_its_largest_speed() -> None:
    found = marks(machine("0.2*t - 2*t^2", "0"))  # 0.2 rad/s at first, -1.8 rad/s at the end
    assert found["motor"]["sense"] == -1


def test_a_driver_at_rest_has_a_positive_arrow() -> None:
    found = marks(machine("1", "0"))
    assert found["motor"]["sense"] == 1
    assert found["push"]["axes"][0] == pytest.approx(0.0, abs=1e-12)
