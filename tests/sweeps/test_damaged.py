"""A damaged file of a sweep, and a lost cluster, are errors with a remedy, never other numbers."""

import sqlite3
import warnings
from collections.abc import Callable
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from command_line import kempe
from sizes import count
from sweeps.conftest import flagship

GIVEN = {"k": [1e6, 2e6, 3e6]}
TEXTS = ["pin.max", "lean.final"]


@pytest.fixture(scope="module")
def kept(tmp_path_factory: pytest.TempPathFactory) -> tuple[kp.Case, kp.SweepResult, bytes]:
    path = tmp_path_factory.mktemp("sweep") / "s.db"
    case = flagship(0.05)
    found = kp.sweep(case, GIVEN, TEXTS, out=path)
    return case, found, path.read_bytes()


def again(case: kp.Case, path: Path) -> kp.SweepResult:
    return kp.sweep(case, GIVEN, TEXTS, out=path)


def test_no_damaged_byte_changes_a_number(kept: Any, tmp_path: Path) -> None:
    case, found, data = kept
    random = np.random.default_rng(11)
    refused = 0
    used = [at for at in range(len(data)) if data[at]]  # most of the file is empty
    for number in range(count(120, 2000)):
        changed = bytearray(data)
        for at in random.choice(used, size=random.integers(1, 4)):
            changed[at] ^= int(random.integers(1, 256))
        if number % 7 == 0:
            changed = changed[: int(random.integers(1, len(data)))]
        path = tmp_path / f"{number}.db"
        path.write_bytes(changed)
        try:
            read = again(case, path)
        except kp.FileError as error:
            refused += 1
            assert path.name in str(error) and error.hint
            continue
        for name in found.columns:
            np.testing.assert_array_equal(read[name], found[name])
        assert read.reasons == found.reasons
    assert refused > 20


EDITS = {
    "a number": "UPDATE row SET numbers = (SELECT numbers FROM row WHERE k = 2) WHERE k = 1",
    "a reason": "UPDATE row SET reason = 'because' WHERE k = 1",
    "a mark": "UPDATE row SET marks = x'0100' WHERE k = 1",
    "another row": "UPDATE row SET k = k + 1 WHERE k = 2",
    "rows exchanged": "UPDATE row SET k = CASE k WHEN 0 THEN -1 ELSE k END",
    "a kind": "UPDATE row SET numbers = 'text' WHERE k = 1",
    "a number as reason": "UPDATE row SET reason = x'ff' WHERE k = 1",
    "a short row": "UPDATE row SET numbers = x'00' WHERE k = 1",
    "no fingerprint": "DELETE FROM sweep",
    "no rows": "DROP TABLE row; CREATE TABLE row (other TEXT)",
    "other columns": "ALTER TABLE row RENAME COLUMN marks TO flags",
}


@pytest.mark.parametrize("edit", EDITS.values(), ids=EDITS.keys())
def test_an_edited_file_is_refused(edit: str, kept: Any, tmp_path: Path) -> None:
    case, _, data = kept
    path = tmp_path / "s.db"
    path.write_bytes(data)
    with closing(sqlite3.connect(path)) as opened, opened:
        opened.executescript(edit)
    with pytest.raises(kp.FileError, match=r"s\.db") as caught:
        again(case, path)
    assert "delete this file" in str(caught.value)


def test_a_file_in_use_is_named(kept: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case, _, data = kept
    path = tmp_path / "s.db"
    path.write_bytes(data[:0])
    connect = sqlite3.connect
    monkeypatch.setattr(sqlite3, "connect", partial(connect, timeout=0.05))
    with closing(connect(path, isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        with pytest.raises(kp.FileError, match="another sweep writes to it"):
            again(case, path)


@pytest.mark.parametrize("damage", ["bytes", "folder"])
def test_the_command_names_its_option(damage: str, tmp_path: Path) -> None:
    flagship(0.05).save(tmp_path / "case.toml")
    words = ("sweep", "case.toml", "--over", "k=1e6:2e6:2", "--measure", "pin.max", "-o", "out")
    place = tmp_path / "out" / "sweep.db"
    if damage == "folder":
        place.mkdir(parents=True)
    else:
        place.parent.mkdir()
        place.write_bytes(b"SQLite format 3\0" + bytes(5000))
    ran = kempe(*words, cwd=tmp_path)
    assert ran.returncode == 4 and "sweep.db" in ran.stderr and "Traceback" not in ran.stderr
    if damage == "bytes":
        assert "--anew discards its results" in ran.stderr
    ran = kempe(*words, "--anew", cwd=tmp_path)
    assert ran.returncode == (4 if damage == "folder" else 0), ran.stderr


def interrupting(act: Callable[[], object]) -> Callable[..., None]:
    def tell(done: int, *_: object) -> None:
        if done >= 1:
            act()

    return tell


@pytest.mark.alone
@pytest.mark.filterwarnings("ignore")  # of the libraries, not of kempe
@pytest.mark.parametrize("lost", ["before", "client", "cluster"])
def test_a_lost_cluster_is_named(lost: str, kept: Any) -> None:
    distributed = pytest.importorskip("distributed", reason="the package distributed is missing")
    case = kept[0]
    given = {"k": np.linspace(1e6, 2e6, 40)}
    with (
        warnings.catch_warnings(),
        distributed.LocalCluster(
            n_workers=1, threads_per_worker=1, processes=False, dashboard_address="127.0.0.1:0"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        act = {"before": lambda: None, "client": client.close, "cluster": cluster.close}[lost]
        if lost == "before":
            client.close()
        with pytest.raises(kp.ModelError, match=r"the Dask cluster was lost.*with a new client"):
            kp.sweep(case, given, TEXTS, scheduler=client, progress=interrupting(act))
