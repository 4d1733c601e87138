"""A sweep on a cluster has the table of a sweep on threads; a killed worker loses nothing."""

import os
import signal
import sys
from collections.abc import Iterator
from typing import Any

import kempe as kp
import numpy as np
import pytest
from sweeps.conftest import flagship

distributed = pytest.importorskip("distributed", reason="the package distributed is missing")
pytestmark = [
    pytest.mark.alone,
    # of the libraries, not of kempe
    pytest.mark.filterwarnings("ignore"),
]

GIVEN = {"L2": {"from": 25.0, "to": 46.0, "n": 10}, "k": [5e5, 1e6, 2e6]}
MEASURES = ["pin.max", "lean.final"]


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def same(one: kp.SweepResult, two: kp.SweepResult) -> None:
    for name in one.columns:
        np.testing.assert_array_equal(one[name], two[name])
    assert one.reasons == two.reasons


def test_a_cluster_gives_the_same_table(client: Any, capsys: pytest.CaptureFixture[str]) -> None:
    case = flagship()
    seen: list[tuple[Any, ...]] = []
    found = kp.sweep(
        case, GIVEN, MEASURES, scheduler=client, progress=lambda *told: seen.append(told)
    )
    assert f"Dask dashboard: {client.dashboard_link}" in capsys.readouterr().out
    assert seen[-1][:3] == (30, len(found.reasons), 30)
    same(found, kp.sweep(case, GIVEN, MEASURES))


def test_a_killed_worker_loses_nothing(client: Any) -> None:
    case = flagship(8.0)
    killed: list[int] = []

    def kill(done: int, *_: object) -> None:
        if done >= 5 and not killed:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)

    found = kp.sweep(case, GIVEN, MEASURES, scheduler=client, progress=kill)
    assert killed
    same(found, kp.sweep(case, GIVEN, MEASURES))


def test_a_cluster_of_its_own(capsys: pytest.CaptureFixture[str]) -> None:
    found = kp.sweep(flagship(), {"k": [1e6, 2e6]}, MEASURES, scheduler="dask", workers=1)
    assert "Dask dashboard: http" in capsys.readouterr().out
    same(found, kp.sweep(flagship(), {"k": [1e6, 2e6]}, MEASURES))


def test_blocks_grow_until_they_take_some_time(client: Any) -> None:
    from kempe.sweeps import cluster

    sizes: list[int] = []
    original = cluster._Blocks._size

    def size(self: Any, count: int, seconds: float) -> None:
        original(self, count, seconds)
        sizes.append(self._count)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cluster._Blocks, "_size", size)
        kp.sweep(
            flagship(0.02), {"k": np.linspace(5e5, 2e6, 400)}, ["lean.final"], scheduler=client
        )
    assert sizes[0] == 4 and max(sizes) >= 16


def test_another_scheduler_is_refused(case: kp.Case) -> None:
    with pytest.raises(kp.ModelError, match="client of Dask"):
        kp.sweep(case, {"k": [1e6]}, ["pin.max"], scheduler="slurm")


def test_without_dask_the_remedy_is_named(case: kp.Case, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(kp.ModelError, match=r"pip install 'kempe\[dask\]'"):
        kp.sweep(case, {"k": [1e6]}, ["pin.max"], scheduler="dask")
