"""Regions that a point reaches, against closed forms."""

from itertools import pairwise
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import app
from kempe.plot.result_pages import result_pages


def arm(first: float, second: float) -> kp.Model:
    """An arm of two links, with its hand at the end of the second link."""
    m = kp.Model(gravity=(0, 0))
    m.ground.points(O=(0, 0))
    m.bar("upper", mass=1, length=first, ends=("O", "E"))
    m.bar("fore", mass=1, length=second, ends=("E", "H"))
    m.revolute("shoulder", "ground.O", "upper.O")
    m.revolute("elbow", "upper.E", "fore.E")
    return m


def region(m: kp.Model, over: tuple[str, str], ranges: object, n: int = 61) -> kp.ReachableResult:
    start = kp.assemble(m, set={"upper.angle": 0.2, "fore.angle": 1.0})
    return kp.reachable(m, start, of="fore.H", over=over, ranges=ranges, n=n)


def reach(first: float, second: float, angle: float) -> float:
    """The square of the distance of the hand from the shoulder."""
    return first**2 + second**2 + 2 * first * second * np.cos(angle)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("lengths", [(1.0, 1.0), (0.7, 0.4), (0.3, 0.8)])
def test_the_sector_of_an_arm(scale: float, lengths: tuple[float, float]) -> None:
    first, second = (scale * length for length in lengths)
    found = region(arm(first, second), ("shoulder.angle", "elbow.angle"), ((0, 1.2), (0.3, 2.5)))
    expected = 0.6 * (reach(first, second, 0.3) - reach(first, second, 2.5))
    assert found.area == pytest.approx(expected, rel=1e-3)
    assert (found.complete, found.limit, len(found.boundary)) == (True, None, 1)
    assert found.points.shape == (61 * 61, 2)
    # on the boundary, the elbow or the shoulder is at an end of its range
    radius, angle = np.hypot(*found.points.T), np.linspace(0.3, 2.5, 61)
    assert radius.reshape(61, 61) == pytest.approx(
        np.sqrt(np.tile(reach(first, second, angle), (61, 1)))
    )


def test_the_error_falls_with_the_square_of_the_number_of_values() -> None:
    m, over, ranges = arm(0.7, 0.4), ("shoulder.angle", "elbow.angle"), ((0, 1.2), (0.3, 2.5))
    expected = 0.6 * (reach(0.7, 0.4, 0.3) - reach(0.7, 0.4, 2.5))
    errors = [abs(region(m, over, ranges, n).area - expected) for n in (16, 31, 61)]
    ratios = [before / after for before, after in pairwise(errors)]
    assert ratios == pytest.approx([4, 4], rel=0.1)


def test_a_full_turn_has_a_hole_and_what_overlaps_counts_once() -> None:
    over = ("shoulder.angle", "elbow.angle")
    ring = region(arm(0.7, 0.4), over, ((0, 2 * np.pi), (-2.0, 2.5)), 121)
    assert ring.area == pytest.approx(np.pi * (1.1**2 - reach(0.7, 0.4, 2.5)), rel=2e-3)
    assert len(ring.boundary) == 2
    radii = sorted(float(np.hypot(*one.T).mean()) for one in ring.boundary)
    assert radii == pytest.approx([np.sqrt(reach(0.7, 0.4, 2.5)), 1.1], rel=2e-3)


def test_limits_within_the_ranges_end_the_region() -> None:
    """The hand is moved along both axes: a part of the disc of radius 2 is within the ranges."""
    found = region(arm(1.0, 1.0), ("fore.H.x", "fore.H.y"), ((0.2, 3.0), (-3.0, 3.0)), 121)
    expected = 4 * np.arccos(0.1) - 0.2 * np.sqrt(4 - 0.04)
    assert found.area == pytest.approx(expected, rel=3e-3)
    assert np.hypot(*found.points.T).max() == pytest.approx(2.0, abs=1e-9)
    assert not found.complete
    assert found.limit is not None and "dead point" in found.limit
    assert any("limits within the ranges" in line for line in found.report())


def test_drivers_are_named_too_and_others_keep_their_value() -> None:
    m = arm(0.7, 0.4)
    m.coordinate_driver("lift", "shoulder.angle", value="0.2 + t")
    m.coordinate_driver("bend", "elbow.angle", value="0.8 + t")
    start = kp.assemble(m)
    ranges = ((0, 1.2), (0.3, 2.5))
    found = kp.reachable(m, start, of="fore.H", over=("lift", "bend"), ranges=ranges)
    same = region(arm(0.7, 0.4), ("shoulder.angle", "elbow.angle"), ranges)
    assert found.area == pytest.approx(same.area, rel=1e-12)


def test_a_driver_and_its_quantity_are_one() -> None:
    m = arm(0.7, 0.4)
    m.coordinate_driver("lift", "shoulder.angle", value="0.2 + t")
    start = kp.assemble(m, set={"elbow.angle": 0.8})
    over = ("lift", "shoulder.angle")
    with pytest.raises(kp.ModelError, match="angle twice, by its name and by its driver"):
        kp.reachable(m, start, of="fore.H", over=over, ranges=((0, 1), (0, 1)))


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"of": "fore.hand"}, "no such point"),
        ({"over": ("elbow.angle",)}, "must be two"),
        ({"over": ("elbow.angle", "elbow.angle")}, "twice"),
        ({"over": ("elbow.angel", "shoulder.angle")}, "did you mean 'angle'"),
        ({"ranges": ((0, 1),)}, "must be two"),
        ({"ranges": ((1, 0), (0, 1))}, "below the last"),
        ({"ranges": 3}, "pairs"),
        ({"n": 1}, "from 2"),
    ],
)
def test_wrong_arguments(changed: dict[str, object], message: str) -> None:
    m = arm(0.7, 0.4)
    given = {"of": "fore.H", "over": ("shoulder.angle", "elbow.angle"), "ranges": ((0, 1), (0, 1))}
    with pytest.raises(kp.ModelError, match=message):
        kp.reachable(m, kp.assemble(m), **{**given, **changed})  # type: ignore[arg-type]


def test_in_a_file_with_its_figure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    case = kp.Case(
        arm(0.7, 0.4),
        kp.Start({"upper.angle": 0.2, "fore.angle": 1.0}),
        [kp.Reachable("fore.H", ["upper.angle", "elbow.angle"], [[0, "1.2"], [0.3, 2.5]], n=21)],
    )
    case.save("arm.toml")
    again = kp.load("arm.toml")
    result = again.run()["reachable"]
    assert result.area == case.run()["reachable"].area
    assert app.run(["reachable", "arm.toml", "-o", "found"]) == 0
    shown = capsys.readouterr().out
    assert "fore.H reaches" in shown
    table = np.loadtxt(tmp_path / "found/boundary.csv", delimiter=",", skiprows=1)
    x, y = table[:, 1:].T
    area = abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) / 2
    assert area == pytest.approx(result.area, rel=1e-9)
    assert list((tmp_path / "found").glob("*reachable*"))


def test_a_point_that_moves_on_a_line_or_not_at_all_reaches_no_area(tmp_path: Path) -> None:
    m, over = arm(0.7, 0.4), ("shoulder.angle", "elbow.angle")
    start = kp.assemble(m, set={"upper.angle": 0.2, "fore.angle": 1.0})
    for point in ("upper.E", "upper.O"):
        found = kp.reachable(m, start, of=point, over=over, ranges=((0, 1), (0, 1)), n=11)
        assert found.area == pytest.approx(0, abs=1e-9)
        assert {path.name for path in found.save(tmp_path)} == {"reachable.csv", "boundary.csv"}
        assert result_pages(found)[0].figure().axes


def cranks_to(at: np.ndarray, pivot: complex, crank: float, link: float) -> list[np.ndarray]:
    """Both angles of a crank whose link ends at a place; NaN where it is too near or too far."""
    line = at - pivot
    cosine = (crank**2 - link**2 + abs(line) ** 2) / (2 * crank * abs(line))
    with np.errstate(invalid="ignore"):
        return [np.angle(line) + sign * np.arccos(cosine) for sign in (1, -1)]


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_a_limit_does_not_join_distant_parts_of_a_region(scale: float) -> None:
    """A place is in the region of a five-bar if both cranks can reach it within their ranges."""
    base, a, b, c, d = (scale * length for length in (0.437, 0.379, 0.44, 0.465, 0.621))
    ranges = ((-2.52, -1.43), (-3.08, -2.33))
    m = kp.Model("five-bar")
    m.ground.points(O=(0, 0), D=(base, 0))
    lengths = {"left": a, "right": d, "p": b, "q": c}
    for (name, length), ends in zip(lengths.items(), ("OB", "DE", "BC", "EC"), strict=True):
        m.bar(name, mass=1, length=length, ends=tuple(ends))
    pins = {"O": ("ground", "left"), "D": ("ground", "right"), "B": ("left", "p")}
    for name, (i, j) in (pins | {"E": ("right", "q"), "C": ("p", "q")}).items():
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")

    x, y = np.meshgrid(*[np.linspace(-a - b, a + b, 600)] * 2)
    at, inside = x + 1j * y, np.zeros(x.shape, bool)
    for left in cranks_to(at, 0, a, b):
        for right in cranks_to(at, base, d, c):
            pin = a * np.exp(1j * left)
            far = base + d * np.exp(1j * right)
            on_the_right = ((far - pin).conj() * (at - pin)).imag < 0
            angles = zip((left, right), ranges, strict=True)
            within = [(angle - low) % (2 * np.pi) <= high - low for angle, (low, high) in angles]
            inside |= on_the_right & within[0] & within[1]
    expected = inside.sum() * (x[0, 1] - x[0, 0]) ** 2

    pin, far = a * np.exp(-2.01j), base + d * np.exp(-2.64j)
    aside = cranks_to(far - pin, 0, b, c)[1]
    start = kp.assemble(
        m, set={"left.angle": -2.01, "right.angle": -2.64}, guess={"p.angle": float(aside)}
    )
    found = kp.reachable(
        m, start, of="p.C", over=("left.angle", "right.angle"), ranges=ranges, n=121
    )
    assert not found.complete
    assert found.area == pytest.approx(expected, rel=0.04)
