"""The same build and input give the same bits: in repeated runs, other processes and threads."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest
from house.places import ROOT
from stress.fingerprint import DRAWN, fingerprints

# warnings of random mechanisms; set here for all threads
pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def first() -> list[str]:
    return fingerprints()


def test_run_after_run(first: list[str]) -> None:
    assert fingerprints() == first
    # not all runs fail, and no two are equal
    assert len(set(first)) > DRAWN // 2


def test_in_another_process(first: list[str]) -> None:
    paths = os.pathsep.join(str(ROOT / name) for name in ("python", "tests"))
    told = subprocess.run(
        [sys.executable, "-m", "stress.fingerprint"],
        env={**os.environ, "PYTHONPATH": paths, "PYTHONHASHSEED": "4711"},
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    )
    assert told.stdout.splitlines() == first


def test_in_threads_side_by_side(first: list[str]) -> None:
    with ThreadPoolExecutor(2) as pool:
        for made in pool.map(lambda _: fingerprints(), range(2)):
            assert made == first
