"""Numbers on the axes are short."""

import numpy as np
import pytest
from kempe.draw.labels import Taken, clipped_lengths, place_labels
from kempe.draw.units import scale


@pytest.mark.parametrize(
    ("unit", "peak", "label"),
    [
        ("N", 25e3, "F / kN"),
        ("N", 1500.0, "F / N"),
        ("N·m", 5e5, "F / kN·m"),
        ("N·m", 3e-6, "F / µN·m"),
        ("J", 4e6, "F / MJ"),
        ("m", 0.01, "F / mm"),
        ("m", 0.5, "F / m"),
        ("m", 1e-12, "F / m"),
        ("m/s", 0.03, "F / (mm/s)"),
        ("m/s²", 5e3, "F / (10³ m/s²)"),
        ("rad/s²", 0.01, "F / (10⁻³ rad/s²)"),
        ("rad", 0.0, "F / rad"),
    ],
)
def test_a_unit_keeps_the_numbers_short(unit: str, peak: float, label: str) -> None:
    found = scale(unit, peak)
    assert found.axis("F") == label
    assert peak < 1e-9 or 0.2 <= peak / found.divisor <= 2000.0


def test_a_name_lies_on_no_line_and_no_other_name() -> None:
    anchors = np.array([[0.0, 0.0], [50.0, 0.0], [50.0, 50.0], [50.0, 52.0]])
    segments = np.array([anchors[:2], anchors[1:3]])
    sizes = np.tile([20.0, 8.0], (4, 1))
    inside = np.array([[-100.0, -100.0], [100.0, 100.0]])
    taken = Taken(segments[None], np.zeros(2), np.empty((1, 0, 4)), inside)
    centres = anchors + place_labels(anchors[None], sizes, taken)
    for centre, size in zip(centres, sizes, strict=True):
        assert clipped_lengths(centre - size / 2, centre + size / 2, segments).sum() == 0.0
    for k, one in enumerate(centres):
        for other in centres[:k]:
            assert np.any(np.abs(one - other) >= sizes[0])


def test_lengths_inside_a_box() -> None:
    low, high = np.array([0.0, 0.0]), np.array([2.0, 1.0])
    segments = np.array(
        [
            [[-1.0, 0.5], [3.0, 0.5]],
            [[0.5, 0.25], [0.5, 0.75]],
            [[-1.0, 2.0], [3.0, 2.0]],
            [[1.0, -1.0], [1.0, 0.5]],
        ]
    )
    np.testing.assert_allclose(clipped_lengths(low, high, segments), [2.0, 0.5, 0.0, 0.5])
