"""A search that is stopped keeps what it has found."""

import csv
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from kempe.cli import synthesis as command
from synthesis.linkages import drawn
from synthesis.test_nine_points import EXAMPLE
from synthesis.test_path import points

from synthesis import six_bars

Told = list[tuple[int, int]]


def stopping(after: int, told: Told) -> Callable[[int, int], None]:
    """Progress that presses Ctrl-C after so many starts."""

    def tell(done: int, most: int) -> None:
        told.append((done, most))
        if done >= after:
            raise KeyboardInterrupt

    return tell


def stopped(places: list[tuple[float, float]], after: int, told: Told, **more: object) -> object:
    with pytest.raises(KeyboardInterrupt) as caught:
        kp.synthesis.path(places, progress=stopping(after, told), **more)  # type: ignore[arg-type]
    return caught.value.result  # type: ignore[attr-defined]


def test_a_part_of_the_four_bars_through_nine_points_is_kept() -> None:
    told: Told = []
    found = stopped(EXAMPLE, 500, told, defects="tell")
    assert isinstance(found, kp.synthesis.Found)
    assert found.followed is not None and not found.complete
    assert 0.9 * told[-1][0] < found.followed.found <= told[-1][0] < 1442
    # the whole search has 21 real ones, each with two cognates
    assert len(found) == 3 * found.followed.real and 0 < found.followed.real < 21
    assert max(one.error / one.size for one in found) < 1e-10
    done, most = np.transpose(told)
    assert (np.diff(done) > 0).all() and set(most) == {1442}


def test_a_stopped_search_has_only_four_bars_through_the_points() -> None:
    bar, crank = drawn(np.random.default_rng(5), 7)
    places = points(bar.poses(crank)[0])
    told: Told = []
    found = stopped(places, 20, told, defects="tell", starts=4000)
    assert isinstance(found, kp.synthesis.Found) and not found.complete
    assert len(found) and told[-1][0] < 4000
    fewer = kp.synthesis.path(places, defects="tell", starts=told[-1][0])
    assert [one.pins for one in found] == [one.pins for one in fewer]


def test_six_bars_of_the_first_round_are_kept() -> None:
    _, _, at = six_bars.drawn("watt_1", 3, 6, 5.0)
    places = points(at["P"])
    # limits that no six-bar of the first round meets, so that another one begins
    more = {"family": "watt_1", "starts": 4, "direction": "cw", "transmission_angle": 1.5}
    assert stopped(places, 0, [], **more) is None
    told: Told = []
    found = stopped(places, 1, told, **more)
    assert told == [(0, 3), (1, 3)]
    assert isinstance(found, kp.synthesis.Found) and sum(found.excluded.values()) + len(found)


def test_the_command_writes_what_was_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def counting(name: str) -> Iterator[Callable[[int, int], None]]:
        assert name == "points.csv"
        yield stopping(300, [])

    monkeypatch.setattr(command, "counting", counting)
    path = tmp_path / "points.csv"
    np.savetxt(path, EXAMPLE, delimiter=",", header="x [m], y [m]", comments="", fmt="%.17g")
    out = tmp_path / "out"
    answer = kempe("synthesis", "path", path, "--tell", "-o", out)
    assert answer.returncode == 130
    assert "of a part of the search" in answer.stderr
    with (out / "candidates.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert rows and f"{len(rows)} candidates" in answer.stderr
    assert kp.load(out / "best.toml").model.tree()["bodies"]
