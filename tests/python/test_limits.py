"""Limits of motion: closed forms, full turns, refusals, files and figures."""

import json
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import app
from kempe.plot import result_pages

G, A, B, C = 4.0, 3.0, 2.0, 2.5


def four_bar(
    g: float = G, a: float = A, b: float = B, c: float = C, *, driver: bool = False
) -> kp.Model:
    m = kp.Model("four-bar", redundancy="allow" if g + b == a + c else "refuse")
    m.ground.points(A=(0, 0), D=(g, 0))
    m.bar("crank", mass=1, length=a, ends=("A", "B"))
    m.bar("coupler", mass=1, length=b, ends=("B", "C"))
    m.bar("rocker", mass=1, length=c, ends=("D", "C"))
    m.revolute("A", "ground.A", "crank.A")
    m.revolute("B", "crank.B", "coupler.B")
    m.revolute("C", "coupler.C", "rocker.C")
    m.revolute("D", "ground.D", "rocker.D")
    if driver:
        m.coordinate_driver("motor", "crank.angle", value="0.5 + 3*t")
    return m


#: The angle of the crank at which coupler and rocker are stretched out.
OUT = np.arccos((G**2 + A**2 - (B + C) ** 2) / (2 * G * A))


@pytest.mark.parametrize("over", ["crank.angle", "A.angle", "motor", None])
def test_the_limits_of_a_crank(over: str | None) -> None:
    m = four_bar(driver=over in ("motor", None))
    start = kp.assemble(m, set={} if over in ("motor", None) else {"crank.angle": 0.5})
    found = kp.limits(m, start, over=over)
    assert found.lower == pytest.approx(-OUT, abs=1e-9)
    assert found.upper == pytest.approx(OUT, abs=1e-9)
    assert found.span == pytest.approx(2 * OUT, abs=1e-9)
    assert found.start == pytest.approx(0.5, abs=1e-12)
    assert not found.turns_fully
    assert found.turns is None
    assert len(found.reasons) == 2
    assert all("dead point, coupler and rocker in line" in text for text in found.reasons)
    lower, upper = found.at_lower(), found.at_upper()
    assert lower is not None
    assert upper is not None
    assert upper["crank.angle"] == pytest.approx(OUT, abs=1e-9)
    assert max(abs(np.sin(upper["coupler.angle"] - upper["rocker.angle"])), 0) < 1e-6
    assert np.all(np.diff(found.path.t) > 0)
    assert found.path["crank.angle"] == pytest.approx(found.path.t, abs=1e-9)
    assert found.final is start
    assert f"a range of {np.degrees(2 * OUT):.4f}"[:-1] in str(found)


def test_a_crank_rocker_turns_fully_and_its_rocker_does_not() -> None:
    m = four_bar(4, 1, 3.5, 2.5)
    start = kp.assemble(m, set={"crank.angle": 1})
    crank = kp.limits(m, start, over="crank.angle")
    assert crank.turns_fully
    assert crank.turns == 1
    assert (crank.lower, crank.upper, crank.span) == (None, None, None)
    assert crank.at_lower() is None
    assert crank.reasons == ("crank turns fully: the mechanism is the same after 360°",)
    rocker = kp.limits(m, start, over="rocker.angle")

    def angle(reach: float) -> float:
        return float(np.pi - np.arccos((16 + 2.5**2 - reach**2) / (2 * 4 * 2.5)))

    assert (rocker.lower, rocker.upper) == pytest.approx((angle(4.5), angle(2.5)), abs=1e-9)
    assert "crank and coupler in line" in rocker.reasons[0]


def test_the_length_of_a_joint_is_driven_in_its_place() -> None:
    m = kp.Model("boom")
    m.ground.points(A=(0, 0), B=(1, 0))
    m.bar("boom", mass=1, length=0.6, ends=("A", "P"))
    m.revolute("A", "ground.A", "boom.A")
    m.distance("cylinder", "ground.B", "boom.P", length=0.9)
    start = kp.assemble(m, guess={"boom.angle": 1})
    found = kp.limits(m, start, over="cylinder.length")
    assert (found.lower, found.upper) == pytest.approx((0.4, 1.6), abs=1e-9)
    assert found.reasons[0].startswith("cylinder cannot pass 0.4 m: dead point")


def test_a_parallelogram_turns_fully_through_its_change_points() -> None:
    m = four_bar(3, 1, 3, 1)
    start = kp.assemble(m, set={"crank.angle": 1}, guess={"coupler.angle": 0, "rocker.angle": 1})
    assert kp.limits(m, start, over="crank.angle").turns == 1


def test_refusals() -> None:
    m = four_bar()
    start = kp.assemble(m, set={"crank.angle": 0.5})
    with pytest.raises(kp.ModelError, match="the model has no driver that acts"):
        kp.limits(m, start)
    with pytest.raises(kp.ModelError, match="over"):
        kp.limits(m, start, over="crankle.angle")
    with pytest.raises(kp.ModelError, match="not a State"):
        kp.limits(m, 3, over="crank.angle")  # type: ignore[arg-type]
    five = kp.Model("double pendulum")
    five.ground.points(O=(0, 0))
    five.bar("upper", mass=1, length=1, ends=("O", "P"))
    five.bar("lower", mass=1, length=1, ends=("P", "Q"))
    five.revolute("O", "ground.O", "upper.O")
    five.revolute("P", "upper.P", "lower.P")
    with pytest.raises(kp.ModelError, match="leave 1 degree of freedom"):
        kp.limits(five, kp.assemble(five), over="upper.angle")
    at_limit = kp.assemble(m, set={"crank.angle": float(OUT)})
    with pytest.raises(kp.SingularityError, match="singular"):
        kp.limits(m, at_limit, over="crank.angle")


def test_progress_is_called_and_may_end_the_work() -> None:
    m = kp.Model("slider")
    m.ground.points(O=(0, 0))
    m.body("block", mass=1, inertia=1, points={"P": (0, 0)})
    m.translational("S", "ground.O", "block.P")
    found = kp.limits(m, kp.assemble(m), over="S.displacement")
    assert found.lower is None
    assert found.upper is None
    assert not found.turns_fully
    assert "no limit within 100 m" in found.reasons[0]

    def stop(_: float) -> None:
        raise RuntimeError("enough")

    n = 100  # long enough that progress is reported: wheels that are never where they were
    train = kp.Model("wheels in a row")
    train.ground.points(**{f"G{k}": (0.4002 * k, 0) for k in range(n)})
    for k in range(n):
        train.body(f"w{k}", mass=1, inertia=1, points={"O": (0, 0)})
        train.revolute(f"A{k}", f"ground.G{k}", f"w{k}.O")
    for k in range(1, n):
        train.gear(f"M{k}", f"w{k - 1}.O", f"w{k}.O", radii=[0.1999, 0.2003])
    start = kp.assemble(train, set={"w0.angle": 0})
    with pytest.raises(RuntimeError, match="enough"):
        kp.limits(train, start, over="w0.angle", progress=stop)


def test_in_a_file_on_the_command_line_and_in_figures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    case = kp.Case(
        four_bar(),
        {"set": {"crank.angle": 0.5}},
        [kp.Limits(over="crank.angle"), kp.Limits(over="rocker.angle", name="rocker")],
    )
    case.save("linkage.toml")
    found = kp.load("linkage.toml").run()
    assert found["limits"].upper == pytest.approx(OUT, abs=1e-9)
    assert [page.name for page in result_pages.result_pages(found["limits"])] == ["limits"]
    assert app.run(["limits", "linkage.toml"]) == 0
    told = capsys.readouterr().out
    assert "crank cannot pass 78.58484°: dead point, coupler and rocker in line" in told
    folder = tmp_path / "out/linkage/limits"
    summary = json.loads((folder / "summary.json").read_text("utf-8"))
    assert summary["upper"] == pytest.approx(OUT, abs=1e-9)
    assert set(summary["files"]) >= {"limits.csv", "summary.json"}
    assert list(folder.rglob("*limits.png"))
    rows = np.genfromtxt(folder / "limits.csv", delimiter=",", names=True)
    assert rows["crankangle_rad"][-1] == pytest.approx(OUT, abs=1e-9)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_a_crank_that_nearly_turns_fully_stops_short_of_the_full_turn(size: float) -> None:
    """The other branch is so near that a step across the dead point would land on it."""
    g, a, b = (size * length for length in (0.33, 0.36, 0.68))
    for share in (1e-4, 1e-6):
        c = b - (a - g) * (1 + share)
        least = np.arccos((g**2 + a**2 - (b - c) ** 2) / (2 * g * a))
        for angle in np.linspace(0.3, 6.0, 40):
            m = four_bar(g, a, b, c)
            found = kp.limits(m, kp.assemble(m, set={"crank.angle": angle}), over="crank.angle")
            ends = [found.lower, found.upper]
            assert ends == pytest.approx([least, 2 * np.pi - least], abs=1e-8), (share, angle)
