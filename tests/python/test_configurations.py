"""All positions in which a mechanism closes: algebra, refusals, files and figures."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.cli import app
from kempe.plot.result_pages import result_pages


def stephenson(links: tuple[float, ...] = (1.0, 3.0, 2.5)) -> kp.Model:
    """Stephenson's chain III: the coupler of a four-bar carries a dyad to ground."""
    crank, coupler, rocker = links
    m = kp.Model("Stephenson III")
    m.ground.points(A=(0, 0), D=(3, 0), G=(4.2, 1.5))
    m.bar("crank", mass=1, length=crank, ends=("A", "B"))
    plate = {"B": (0, 0), "C": (coupler, 0), "E": (1.8, 1.3)}
    m.body("coupler", mass=1, inertia=1, points=plate)
    m.bar("rocker", mass=1, length=rocker, ends=("D", "C"))
    m.bar("link", mass=1, length=2.2, ends=("E", "F"))
    m.bar("output", mass=1, length=1.9, ends=("G", "F"))
    for name, i, j in (
        ("A", "ground", "crank"),
        ("B", "crank", "coupler"),
        ("C", "coupler", "rocker"),
        ("D", "ground", "rocker"),
        ("E", "coupler", "link"),
        ("F", "link", "output"),
        ("G", "ground", "output"),
    ):
        m.revolute(name, f"{i}.{name}", f"{j}.{name}")
    return m


def circles(a: complex, r: float, b: complex, s: float) -> list[complex]:
    """The intersections of two circles in the complex plane."""
    d = abs(b - a)
    x = (d * d + r * r - s * s) / (2 * d)
    if r * r < x * x:
        return []
    y = np.sqrt(r * r - x * x)
    u = (b - a) / d
    return [a + u * (x + 1j * y), a + u * (x - 1j * y)]


@pytest.mark.parametrize("angle", [0.3, 1.1, 2.5])
def test_stephensons_chain_driven_at_its_four_bar(angle: float) -> None:
    found = kp.configurations(stephenson(), set={"crank.angle": angle})
    exact = []
    b = np.exp(1j * angle)
    for c in circles(b, 3.0, 3 + 0j, 2.5):
        e = b + (1.8 + 1.3j) * (c - b) / 3.0
        exact += [(c, f) for f in circles(e, 2.2, 4.2 + 1.5j, 1.9)]
    assert found.complete
    assert len(found) == len(exact) > 0
    places = [
        (s["coupler.C.x"] + 1j * s["coupler.C.y"], s["output.F.x"] + 1j * s["output.F.y"])
        for s in found
    ]
    for c, f in exact:
        assert min(abs(p - c) + abs(q - f) for p, q in places) < 1e-9


def positions_by_output(angle: float) -> int:
    """The number of positions with a given output, along the motion of the four-bar."""
    f = 4.2 + 1.5j + 1.9 * np.exp(1j * angle)
    count = 0
    for way in range(2):
        gaps = []
        for theta in np.linspace(0, 2 * np.pi, 100_001):
            b = np.exp(1j * theta)
            c = circles(b, 3.0, 3 + 0j, 2.5)
            gaps.append(abs(b + (1.8 + 1.3j) * (c[way] - b) / 3 - f) - 2.2 if c else np.nan)
        signs = np.sign(gaps)
        count += int(np.sum(signs[:-1] * signs[1:] < 0))
    return count


@pytest.mark.parametrize("angle", [2.3, 3.15, 4.9])
def test_stephensons_chain_driven_at_its_output_is_a_triad(angle: float) -> None:
    # a coupler curve of degree 6 and a circle: at most 6 positions (Hunt 1978)
    exact = positions_by_output(angle)
    found = kp.configurations(stephenson(), set={"output.angle": angle})
    assert not found.complete
    assert len(found) == exact > 0
    assert all(np.abs(state.residuals[0]).max() < 1e-10 for state in found)


def test_six_positions_of_stephensons_chain_as_many_as_a_triad_may_have() -> None:
    # driven at its output, the plate is held by three bars: at most 6 positions (Hunt 1978, 1983)
    m = kp.Model("Stephenson III with six positions")
    output, angle, ends = 1.27, 2.0, 3.19 + 1.11j
    tip = ends + output * np.exp(1j * angle)
    m.ground.points(A=(0, 0), D=(3, 0), G=(ends.real, ends.imag))
    plate = {"B": (0, 0), "C": (2.93, 0), "E": (-0.55, -0.81)}
    m.body("coupler", mass=1, inertia=1, points=plate)
    bars = {"crank": (2.89, "AB"), "rocker": (3.04, "DC"), "link": (2.04, "FE")}
    for name, (length, pins) in (bars | {"output": (output, "GF")}).items():
        m.bar(name, mass=1, length=length, ends=tuple(pins))
    for pin, i, j in (
        ("A", "ground", "crank"),
        ("B", "crank", "coupler"),
        ("C", "coupler", "rocker"),
        ("D", "ground", "rocker"),
        ("E", "coupler", "link"),
        ("F", "link", "output"),
        ("G", "ground", "output"),
    ):
        m.revolute(pin, f"{i}.{pin}", f"{j}.{pin}")
    found = kp.configurations(m, set={"output.angle": angle})
    assert len(found) == 6
    assert not found.complete, "six are all, but that is not proven here"
    for state in found:
        # lengths of the three bars by complex numbers
        at = state["coupler.x"] + 1j * state["coupler.y"]
        turn = np.exp(1j * state["coupler.angle"])
        b, c, e = (at + complex(*plate[pin]) * turn for pin in "BCE")
        assert [abs(b), abs(c - 3), abs(e - tip)] == pytest.approx([2.89, 3.04, 2.04], abs=1e-10)
    places = [s["coupler.E.x"] + 1j * s["coupler.E.y"] for s in found]
    apart = [abs(p - q) for k, p in enumerate(places) for q in places[:k]]
    assert min(apart) > 1e-3


def test_refusals_and_limits() -> None:
    m = stephenson()
    with pytest.raises(kp.ModelError, match="1 degree of freedom is left"):
        kp.configurations(m)
    with pytest.raises(kp.AssemblyError):
        kp.configurations(stephenson((0.2, 9.0, 1.0)), set={"crank.angle": 1})
    with pytest.raises(kp.ModelError, match="limit"):
        kp.configurations(m, set={"crank.angle": 1}, limit=0)
    with pytest.raises(kp.ModelError, match="crankle"):
        kp.configurations(m, set={"crankle.angle": 1})
    one = kp.configurations(m, set={"crank.angle": 1.1}, limit=1)
    assert len(one) == 1
    assert not one.complete
    assert one.final is one[0]


def test_positions_with_a_freedom_are_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    case = kp.load(ROOT / "examples/peaucellier.toml")
    found = kp.configurations(case.model)
    assert (len(found), found.complete) == (4, False)
    assert found.left_out > 1
    line = f"{found.left_out} positions are left out, because a freedom remains in each of them"
    assert found.report()[:2] == ["4 configurations; there may be others", line]
    assert found.summary()["left_out"] == found.left_out
    assert all(kp.mobility(case.model, state).degrees_of_freedom == 0 for state in found)
    assert app.run(["configurations", str(ROOT / "examples/scissor_lift.toml")]) == 0
    assert "positions are left out" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("left_out", "line"),
    [(0, "1: C left"), (1, "1 position is left out, because a freedom remains in it")],
)
def test_the_line_about_positions_left_out(left_out: int, line: str) -> None:
    some = kp.configurations(kp.load(ROOT / "examples/four_bar.toml").model, {"crank.angle": 1})
    some.left_out = left_out
    assert some.report()[1] == line


def test_in_a_file_and_on_a_sheet(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert app.run(["configurations", str(ROOT / "examples/four_bar.toml")]) == 0
    assert "2 configurations; there are no others" in capsys.readouterr().out
    folder = tmp_path / "out/four_bar"
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    assert summary["count"] == 2
    assert summary["configurations"][0]["crank.angle"] == pytest.approx(np.radians(70))
    assert list(folder.rglob("*configurations.png"))
    entry = kp.Configurations(set={"crank.angle": "1"}, limit=3)
    case = kp.Case(stephenson(), {"set": {"crank.angle": 0.4}}, [entry])
    found = case.run()["configurations"]
    assert found[0]["crank.angle"] == pytest.approx(1)
    assert [page.name for page in result_pages(found)] == ["configurations"]
