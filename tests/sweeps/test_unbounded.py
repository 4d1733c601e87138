"""Variants that pass a position beside which a measure has no bound are counted.

Two windows of the N-four-bar start upright and move like one crank. Its energy gives the time at
which all bars lie on one line, where the forces of the pins have poles but the vertical ones do
not. The start rate of a variant decides whether it comes there before the run ends.
"""

import contextlib
import io
import json
from functools import cache
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe.cli import app
from scipy.integrate import quad
from singular.equal_cranks import cranks

from examples.n_four_bar import rate, windows

T_END = 0.8
RATES = [-0.2, -0.8, -1.4, -2.0, -2.6]
PIN = ["B0.force.max", "B0.force.t_max", "B0.force.mean"]
BOUNDED = ["B0.force.final", "B0.fy.max", "crank0.B.y.min"]


def case(n: int = 2) -> kp.Case:
    start = {"crank0.angle": "90*deg", "crank0.omega": -1}
    level = {f"coupler{k}.angle": 0 for k in range(n)}
    run = kp.Dynamics(t_end=T_END, output_step=0.01)
    return kp.Case(windows(n), {"set": start, "guess": level}, [run])


def swept(n: int = 2, **options: object) -> kp.SweepResult:
    return kp.sweep(case(n), {"crank0.omega": RATES}, [*PIN, *BOUNDED], **options)


@cache
def passing() -> tuple[int, ...]:
    """The rows whose cranks come to the line, by the energy of one crank."""

    def time(start: float) -> float:
        def per_angle(angle: float) -> float:
            return 1 / np.sqrt(rate(np.array(angle), 2) ** 2 - 1 + start**2)

        return float(quad(per_angle, 0, np.pi / 2)[0])

    return tuple(k for k, start in enumerate(RATES) if time(start) < T_END)


def remark() -> str:
    return f"without bound in {len(passing())} of {len(RATES)} variants"


def test_the_rows_are_those_that_come_to_the_line() -> None:
    found = swept()
    assert 0 < len(passing()) < len(RATES)
    assert found.unbounded == dict.fromkeys(PIN, passing())
    assert found.remarks == found.table.attrs["remarks"] == dict.fromkeys(PIN, remark())
    assert found.choices == {}
    for k in range(len(RATES)):
        has_times = bool(found.run(k).summary["singular"])
        assert has_times == (k in passing())


def test_one_window_has_no_pole() -> None:
    assert not swept(1).remarks


@pytest.mark.parametrize("options", [{"out": "sweep.db"}, {"scheduler": "dask", "workers": 1}])
def test_remarks_pass_through_files_and_processes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, options: dict[str, object]
) -> None:
    monkeypatch.chdir(tmp_path)
    for _ in range(1 + ("out" in options)):  # the second one resumes
        assert swept(**options).unbounded == dict.fromkeys(PIN, passing())


def test_figures_and_tolerances() -> None:
    found = swept()
    for name in (*PIN, *BOUNDED):
        axes = kp.plot.sweep_lines(found, name)
        assert (f"{name} †" in axes.get_ylabel()) == (name in PIN)
        assert [text.get_text() for text in axes.texts] == [f"† {remark()}"] * (name in PIN)
    title = kp.plot.sweep_histogram(found, PIN[0]).texts[-1].get_text()
    assert title == f"† {remark()}"
    figure = kp.plot.sweep_scatter(found, [PIN[0], BOUNDED[1]])
    assert [axes.get_xlabel() for axes in figure.axes[2:]] == [f"{PIN[0]} †", BOUNDED[1]]
    assert figure.get_suptitle() == "† without bound in some variants"
    assert not kp.plot.sweep_scatter(found, BOUNDED[1:]).get_suptitle()
    scatter = kp.tolerances(case(), {"crank0.omega": 1e-3}, PIN[0], n=5)
    assert scatter.remark == scatter.sample.remarks.get(PIN[0], "")
    fast = case().with_start({"crank0.omega": -3.0})
    scatter = kp.tolerances(fast, {"crank0.omega": 1e-3}, PIN[0], n=5)
    assert f"<Tolerances of {PIN[0]}, without bound in 5 of 5 variants: " in repr(scatter)


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case().save(tmp_path / "windows.json")
    asked = [part for name in (PIN[0], BOUNDED[1]) for part in ("--measure", name)]
    over = f"crank0.omega={RATES[0]}:{RATES[-1]}:{len(RATES)}"
    line = ["sweep", str(tmp_path / "windows.json"), "--over", over, *asked]
    with contextlib.redirect_stderr(io.StringIO()):
        assert app.run([*line, "-o", str(tmp_path / "out")]) == 0
        told = capsys.readouterr().out
        assert app.run([*line, "-o", str(tmp_path / "out"), "--json"]) == 0
    counted = f"({len(passing())} of {len(RATES)} variants)"
    expected = "without bound at singular positions, counted in integrals and means only: "
    assert f"  {expected}{PIN[0]} {counted}\n" in told
    assert json.loads(capsys.readouterr().out)["remarks"] == {PIN[0]: remark()}


def test_both_remarks() -> None:
    """Three driven cranks pass the line; one of them is redundant."""
    of = cranks(2, number=3)
    start = {"guess": {name: float(of.start[name]) for name in angles()}}
    run = kp.Dynamics(t_end=4, output_step=0.02)
    asked = ["B0.force.max", "B0.force.final", "rod.x.max"]
    found = kp.sweep(kp.Case(of.model, start, [run]), {"rod.angle": [0.0]}, asked)
    both = "minimum norm, without bound in 1 of 1 variants"
    assert found.remarks == {asked[0]: both, asked[1]: "minimum norm"}


def angles() -> list[str]:
    return ["rod.angle", *(f"crank{k}.angle" for k in range(3))]
