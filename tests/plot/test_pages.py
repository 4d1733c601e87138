"""The figures of the report: which there are, that they can be read, and that they stay so."""

import math
import time
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from kempe import plot
from kempe.plot.page import file_names
from kempe.results.summary import summary
from matplotlib.text import Text
from plot.clipping import clipped_lengths
from plot.conftest import NAMES, chain, driven, pendulum
from plot.overlaps import boxes, faults, overlaps
from plot.paintings import links
from singular.equal_cranks import cranks, run

FLAGSHIP = [
    "01_mechanism",
    "02_initial",
    "03_final",
    "04_x",
    "05_y",
    "06_angle",
    "07_crank",
    "08_coupler",
    "09_rocker",
    "10_torque_spring",
    "11_reactions_A",
    "11_reactions_B",
    "11_reactions_C",
    "11_reactions_D",
    "12_residual",
    "13_energy",
    "14_reactions",
    "15_motion",
]


def test_the_flagship_has_all_figures(flagship_pages: list[plot.Page]) -> None:
    assert [page.stem for page in flagship_pages] == FLAGSHIP


@pytest.mark.parametrize("stem", FLAGSHIP)
def test_a_figure_of_the_flagship_can_be_read(flagship_pages: list[plot.Page], stem: str) -> None:
    figure = plot.select(flagship_pages, [stem])[0].figure()
    assert faults(figure) == ([], [])
    assert figure.get_figwidth() == pytest.approx(160 / 25.4)
    assert min(text.get_fontsize() for text in figure.findobj(Text)) >= 8.0
    for axes in figure.axes:
        assert "/" in axes.get_ylabel()
        # the flagship is at rest after 2.5 of 15 s, where the key figure of reactions is compressed
        assert axes.get_xscale() == ("function" if stem == "14_reactions" else "linear")


@pytest.mark.parametrize("name", ["mechanism", "initial", "final"])
def test_names_lie_on_no_link(flagship_pages: list[plot.Page], name: str) -> None:
    figure = plot.select(flagship_pages, [name])[0].figure()
    axes = figure.axes[0]
    ends = [corners for _, corners in links(axes)]
    assert len(ends) == 6
    numbers = {"1", "2", "3"}
    for text, box in boxes(figure):
        if text not in numbers:
            assert clipped_lengths(box.min, box.max, np.array(ends)).sum() == 0.0, text


def test_the_key_figures_are_few_and_take_little_time(
    flagship_pages: list[plot.Page], tmp_path: Path
) -> None:
    key = [page for page in flagship_pages if page.key]
    assert [page.name for page in key] == ["mechanism", "residual", "energy", "reactions", "motion"]
    begin = time.process_time()
    plot.save(key, tmp_path)
    assert time.process_time() - begin < 3.0


def test_overlaps_are_seen() -> None:
    from kempe.plot import style

    figure = style.figure()
    figure.text(0.5, 0.5, "one")
    figure.text(0.51, 0.5, "other")
    figure.text(0.99, 0.1, "leaves")
    assert faults(figure) == ([("one", "other")], ["leaves"])


def test_the_page_of_motion_shows_every_coordinate_of_every_body(
    flagship: kp.Solution, flagship_pages: list[plot.Page]
) -> None:
    figure = plot.select(flagship_pages, ["motion"])[0].figure()
    for axes, name in zip(figure.axes, ("x", "y", "angle"), strict=True):
        for line, body in zip(axes.lines, ("crank", "coupler", "rocker"), strict=True):
            t, drawn = line.get_data()
            exact = getattr(flagship(t).body(body), name)
            np.testing.assert_allclose(drawn, np.degrees(exact) if name == "angle" else exact)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["1 crank", "2 coupler", "3 rocker"]


def test_the_page_of_motion_limits_the_number_of_bodies() -> None:
    many = chain([f"link{k}" for k in range(26)])
    figure = plot.select(plot.pages(many), ["motion"])[0].figure()
    assert [len(axes.lines) for axes in figure.axes] == [24, 24, 24]
    assert figure.axes[0].get_title("left") == "Motion of the first 24 of 26 bodies"
    assert faults(figure) == ([], [])
    looks = {(line.get_color(), str(line._dash_pattern)) for line in figure.axes[0].lines}
    assert len(looks) == 24


def test_the_key_pages_are_few(flagship_pages: list[plot.Page]) -> None:
    key = [page.name for page in flagship_pages if page.key]
    assert key == ["mechanism", "residual", "energy", "reactions", "motion"]
    many = plot.pages(chain([f"link{k}" for k in range(21)]))
    assert [page.name for page in many if page.key] == key


def test_the_coordinates_of_all_bodies_are_there(
    flagship: kp.Solution, flagship_pages: list[plot.Page]
) -> None:
    for name in ("x", "y", "angle"):
        figure = plot.select(flagship_pages, [name])[0].figure()
        for axes, body in zip(figure.axes, ("crank", "coupler", "rocker"), strict=True):
            t, drawn = axes.lines[0].get_data()
            exact = getattr(flagship(t).body(body), name)
            np.testing.assert_allclose(drawn, np.degrees(exact) if name == "angle" else exact)


def test_the_quiet_rest_is_compressed_on_request_and_nothing_is_left_out(
    flagship: kp.Solution, flagship_pages: list[plot.Page]
) -> None:
    plain = plot.select(flagship_pages, ["x"])[0].figure().axes[-1]
    assert plain.get_xlim() == (0.0, 15.0)
    assert plain.get_xlabel() == "time t / s"
    assert plot.transient(flagship) == 2.5
    axes = plot.select(plot.pages(flagship, compressed=True), ["x"])[0].figure().axes[-1]
    assert axes.get_xlim() == (0.0, 15.0)
    assert "compressed after 2.5 s" in axes.get_xlabel()
    places = axes.get_xaxis_transform().transform([(t, 0.5) for t in (0.0, 2.5, 15.0)])[:, 0]
    assert (places[1] - places[0]) / (places[2] - places[0]) == pytest.approx(0.72)
    assert {0.0, 2.5, 15.0} <= set(axes.get_xticks())


def test_a_motion_that_does_not_settle_keeps_a_plain_axis() -> None:
    assert plot.transient(pendulum()) is None
    assert plot.transient(pendulum(t_end=0.0)) is None


@pytest.mark.parametrize(
    "solution",
    [
        pytest.param(pendulum, id="one body"),
        pytest.param(lambda: pendulum(length=0.01, t_end=0.1, output_step=0.001), id="10 mm"),
        pytest.param(lambda: pendulum(t_end=0.0), id="one output"),
        pytest.param(lambda: pendulum(t_end=0.1, output_step=0.1), id="two outputs"),
        pytest.param(driven, id="driven"),
    ],
)
def test_other_mechanisms_can_be_read_too(solution) -> None:  # type: ignore[no-untyped-def]
    for page in plot.pages(solution()):
        figure = page.figure()
        assert faults(figure) == ([], []), page.stem
        for axes in figure.axes:
            assert all(math.isfinite(limit) for limit in (*axes.get_xlim(), *axes.get_ylim()))


def test_names_are_shown_as_they_are(tmp_path: Path) -> None:
    found = plot.pages(chain(NAMES))
    assert len({page.stem.casefold() for page in found}) == len(found)
    written = plot.save(found[:2], tmp_path)
    assert len(written) == 4
    assert all(path.stat().st_size > 0 for path in written)
    texts = {text.get_text() for text in found[1].figure().axes[0].texts}
    assert {r"\$x_1\$", "<script>ale…1)</script>", "n" * 11 + "…" + "n" * 11} <= texts
    assert "<script>" not in (tmp_path / f"{found[1].stem}.svg").read_text(encoding="utf-8")


def test_ten_bodies_have_pages_of_their_own() -> None:
    found = plot.pages(chain([f"link{k}" for k in range(10)]))
    names = [page.name for page in found]
    assert {"x", "link0", "link9", "reactions_Jlink9"} <= set(names)
    figure = plot.select(found, ["y"])[0].figure()
    assert len(figure.axes) == 10
    assert overlaps(figure) == []
    assert figure.get_figheight() * 25.4 < 250.0
    few = plot.pages(chain([f"link{k}" for k in range(10)]), most=4)
    assert "link3" in {page.name for page in few}
    assert "link4" not in {page.name for page in few}


def test_names_of_files_are_plain_and_differ() -> None:
    assert file_names(["a", "A", "a/b", "a b", "…", "é"]) == [
        "a",
        "A_2",
        "a_b",
        "a_b_2",
        "unnamed",
        "e",
    ]
    assert max(map(len, file_names(["n" * 200, "n" * 199 + "m"]))) < 50


def test_the_same_solution_gives_the_same_bytes(
    flagship_pages: list[plot.Page], tmp_path: Path
) -> None:
    page = plot.select(flagship_pages, ["energy"])
    for folder in ("a", "b"):
        plot.save(page, tmp_path / folder, ["png", "svg", "pdf"])
    for form in ("png", "svg", "pdf"):
        one, other = (tmp_path / folder / f"13_energy.{form}" for folder in "ab")
        assert one.read_bytes() == other.read_bytes()


def test_pages_are_found_by_name_number_and_the_name_in_the_model() -> None:
    found = plot.pages(chain(["a b", "c"]))
    for name in ("a_b", "07_a_b", "a b"):
        assert [page.stem for page in plot.select(found, [name])] == ["07_a_b"]
    assert plot.select(found, []) == found
    with pytest.raises(kp.ModelError, match="did you mean 'residual'"):
        plot.select(found, ["residuals"])


def test_pages_are_saved_in_a_folder_given_as_text(
    flagship: kp.Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = kp.plot.select(kp.plot.pages(flagship), ["energy"])[0]
    monkeypatch.chdir(tmp_path)
    assert kp.plot.save([page], "figures", "png") == [Path("figures") / f"{page.stem}.png"]
    assert kp.plot.save(page, str(tmp_path / "one"), ["svg"])[0].exists()
    with pytest.raises(kp.ModelError, match="unknown format 'jpg'"):
        kp.plot.save([page], "figures", ["jpg"])
    with pytest.raises(kp.ModelError, match="is not a page"):
        kp.plot.save(["energy"], "figures")


def test_passed_singular_positions_are_marked() -> None:
    """Two equal cranks are in line with their rod at each half turn."""
    of = cranks(2, number=2)
    sol = run(of)
    times = [one["t"] for one in summary(sol)["singular"]]
    assert times
    page = next(page for page in plot.pages(sol) if page.name == "reactions")
    figure = page.draw()
    for axes in figure.axes:
        marks = [line for line in axes.lines if line.get_color() == "#777777"]
        if axes.lines:
            found = [float(line.get_xdata()[0]) for line in marks]
            assert found == pytest.approx(times)
            assert {line.get_linestyle() for line in marks} == {"--"}
    words = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert words.count("singular position") == 1
