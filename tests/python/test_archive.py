"""Files of solutions are checked before they are read; only FileError is raised."""

import json
import tracemalloc
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import kempe as kp
import numpy as np
import pytest
from house.places import ROOT
from kempe.results import archive

Arrays = dict[str, Any]


@pytest.fixture(scope="module")
def stored(solution: kp.Solution, tmp_path_factory: pytest.TempPathFactory) -> Arrays:
    path = tmp_path_factory.mktemp("stored") / "s.npz"
    solution.save(path)
    with np.load(path) as arrays:
        return dict(arrays)


def about(change: Callable[[dict[str, Any]], object]) -> Callable[[Arrays], Arrays]:
    def changed(arrays: Arrays) -> Arrays:
        told = json.loads(str(arrays["about"]))
        change(told)
        return arrays | {"about": np.array(json.dumps(told))}

    return changed


def entry(name: str, k: Any, value: float) -> Callable[[Arrays], Arrays]:
    def changed(arrays: Arrays) -> Arrays:
        other = arrays[name].copy()
        other[k] = value
        return arrays | {name: other}

    return changed


def given(**values: Callable[[np.ndarray], Any]) -> Callable[[Arrays], Arrays]:
    return lambda arrays: arrays | {name: f(arrays[name]) for name, f in values.items()}


def nested(depth: int) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for _ in range(depth):
        found = {"a": found}
    return found


CHANGES: dict[str, tuple[Callable[[Arrays], Arrays], str]] = {
    "NaN in q": (entry("q", (3, 2), np.nan), "q contains a number that is not finite"),
    "inf in lam": (entry("lam", (3, 2), np.inf), "lam contains a number that is not finite"),
    "NaN in energy": (entry("energy", (3, 2), np.nan), "energy contains a number"),
    "NaN in t": (entry("t", 3, np.nan), "t contains a number that is not finite"),
    "NaN between": (entry("dense_c", (3, 2, 1), np.nan), "dense_c contains a number"),
    "disorder": (entry("t", 3, 0.5), "the times t are not in order"),
    "disorder between": (entry("dense_t", 3, 0.0), "the times dense_t are not in order"),
    "falling": (given(t=lambda t: t[::-1]), "the times t are not in order"),
    "falling between": (given(dense_t=lambda t: t[::-1]), "the times dense_t are not in order"),
    "first a": (entry("a", (0, 2), 1e9), "its accelerations at t = 0 s are not those of its"),
    "last a": (entry("a", (-1, 2), 1e9), "its accelerations at t = 1 s are not those of its"),
    "integers": (given(q=lambda q: q.astype(int)), "q has numbers of type int64; must be float64"),
    "complex": (given(q=lambda q: q * 1j), "q has numbers of type complex128"),
    "single": (given(v=np.float32), "v has numbers of type float32"),
    "texts": (given(v=lambda v: v.astype(str)), "v has numbers of type <U32"),
    "transposed": (given(a=np.transpose), "a is in the order of Fortran"),
    "flat": (given(a=np.ravel), r"a is \(909,\), must be \(101, 9\)"),
    "row short": (given(lam=lambda x: x[:-1]), r"lam is \(100, 8\), must be \(101, 8\)"),
    "column short": (given(energy=lambda x: x[:, :4]), r"energy is \(101, 4\), must be \(101, 5\)"),
    "states without elements": (
        given(z=lambda z: np.zeros((len(z), 2))),
        r"z is \(101, 2\), must be \(101, 0\)",
    ),
    "no outputs": (given(t=lambda t: t[:0]), r"t is \(0,\), must be \(n,\)"),
    "steps short": (given(dense_y=lambda x: x[:-1]), "dense_y is .* must be "),
    "half an interpolant": (lambda a: {k: v for k, v in a.items() if k != "dense_c"}, "0 arrays"),
    "no t": (lambda a: {k: v for k, v in a.items() if k != "t"}, "0 arrays 't'; must be one"),
    "no about": (lambda a: {k: v for k, v in a.items() if k != "about"}, "0 arrays 'about'"),
    "about a number": (given(about=lambda _: np.array(3.0)), "other content"),
    "about a list": (given(about=lambda _: np.array("[1]")), "other content"),
    "about in a row": (given(about=lambda text: text.reshape(1)), "other content"),
    "about in two rows": (given(about=lambda text: np.array([text, text])), "other content"),
    "about not JSON": (given(about=lambda _: np.array("{")), "damaged"),
    "about with NaN": (given(about=lambda _: np.array('{"kind": NaN}')), "it has NaN"),
    "about deep": (given(about=lambda _: np.array("[" * 200_000)), "damaged"),
    "other kind": (about(lambda a: a.update(kind="music")), "other content"),
    "newer": (about(lambda a: a.update(layout=2)), "update kempe"),
    "no case": (about(lambda a: a.pop("case")), "it has no case"),
    "case a text": (about(lambda a: a.update(case="x")), "it has no case"),
    "deep case": (about(lambda a: a.update(case=nested(500))), "its case is invalid"),
    "parameter a text": (about(lambda a: a["case"]["parameters"].update(k="x")), "case is invalid"),
    "no parameter": (about(lambda a: a["case"]["parameters"].pop("k")), "its case is invalid"),
    "stiffer": (about(lambda a: a["case"]["parameters"].update(k=2e6)), "not those of its model"),
    "less damping": (about(lambda a: a["case"]["parameters"].update(c=9e3)), "not those of its"),
    "longer": (about(lambda a: a["case"]["parameters"].update(L2=27)), "not those of its model"),
    "other status": (about(lambda a: a.update(status="done")), "its status is 'done'"),
    "no message": (about(lambda a: a.pop("message")), "it has no message"),
    "statistics a list": (about(lambda a: a.update(statistics=[])), "it has no statistics"),
    "no steps": (about(lambda a: a["statistics"].pop("steps")), "its statistics have None steps"),
    "half a step": (about(lambda a: a["statistics"].update(steps=0.5)), "have 0.5 steps"),
    "minus one step": (about(lambda a: a["statistics"].update(steps=-1)), "have -1 steps"),
}


@pytest.mark.parametrize(("change", "why"), CHANGES.values(), ids=list(CHANGES))
def test_an_altered_file_is_refused_with_the_reason(
    stored: Arrays, tmp_path: Path, change: Callable[[Arrays], Arrays], why: str
) -> None:
    path = tmp_path / "altered.npz"
    np.savez(path, **change(dict(stored)))
    with pytest.raises(kp.FileError, match=why) as caught:
        kp.load_solution(path)
    assert "altered.npz" in str(caught.value)


def test_an_unchanged_copy_is_read(stored: Arrays, solution: kp.Solution, tmp_path: Path) -> None:
    np.savez(tmp_path / "same.npz", **stored)
    again = kp.load_solution(tmp_path / "same.npz")
    assert np.array_equal(again(0.123).q, solution(0.123).q)


def test_arrays_with_the_other_header_of_numpy_are_read(
    stored: Arrays, solution: kp.Solution, tmp_path: Path
) -> None:
    """Version 2.0 has four bytes for the length of the header, not two."""
    with zipfile.ZipFile(tmp_path / "new.npz", "w") as file:
        for name, array in stored.items():
            with file.open(f"{name}.npy", "w") as member:
                np.lib.format.write_array(member, np.asarray(array), version=(2, 0))
    again = kp.load_solution(tmp_path / "new.npz")
    assert np.array_equal(again.q, solution.q) and np.array_equal(again.lam, solution.lam)


def bomb(path: Path, stored: Arrays, name: str, shape: tuple[int, ...], compressed: bool) -> None:
    """A file in which an array of so many zeros takes little room."""
    np.savez(path, **{key: value for key, value in stored.items() if key != name})
    kind = zipfile.ZIP_DEFLATED if compressed else zipfile.ZIP_STORED
    with (
        zipfile.ZipFile(path, "a", kind, compresslevel=1) as file,
        file.open(f"{name}.npy", "w", force_zip64=True) as member,
    ):
        header = {"descr": "<f8", "fortran_order": False, "shape": shape}
        np.lib.format.write_array_header_1_0(member, header)
        left = int(np.prod(shape)) * 8 if compressed else 8
        block = bytes(1 << 20)
        while left > 0:
            member.write(block[:left])
            left -= len(block)


@pytest.mark.parametrize(
    ("name", "shape", "compressed", "why"),
    [
        ("t", (1 << 25,), True, "t is compressed"),
        ("t", (1 << 40,), False, "t has 8 bytes; must have 8796093022208"),
        ("q", (1 << 40, 9), False, "q has 8 bytes"),
        ("q", (1 << 60, 1 << 60), False, "q has 8 bytes"),
    ],
)
def test_a_bomb_in_a_used_array_is_not_read(
    stored: Arrays, tmp_path: Path, name: str, shape: tuple[int, ...], compressed: bool, why: str
) -> None:
    path = tmp_path / "bomb.npz"
    bomb(path, stored, name, shape, compressed)
    tracemalloc.start()
    try:
        with pytest.raises(kp.FileError, match=why):
            kp.load_solution(path)
        assert tracemalloc.get_traced_memory()[1] < 20e6
    finally:
        tracemalloc.stop()


def test_a_bomb_in_an_unused_array_is_not_read(
    stored: Arrays, solution: kp.Solution, tmp_path: Path
) -> None:
    path = tmp_path / "bomb.npz"
    bomb(path, stored, "more", (1 << 24,), True)  # 128 MiB
    tracemalloc.start()
    try:
        again = kp.load_solution(path)
        assert tracemalloc.get_traced_memory()[1] < 20e6
    finally:
        tracemalloc.stop()
    assert np.array_equal(again.q, solution.q)


def test_an_array_twice_is_refused(stored: Arrays, tmp_path: Path) -> None:
    path = tmp_path / "twice.npz"
    np.savez(path, **stored)
    with zipfile.ZipFile(path, "a") as file, pytest.warns(UserWarning, match="Duplicate"):
        file.writestr("q.npy", b"")
    with pytest.raises(kp.FileError, match="it has 2 arrays 'q'"):
        kp.load_solution(path)


def test_random_bytes_are_refused(stored: Arrays, tmp_path: Path) -> None:
    path = tmp_path / "random.npz"
    np.savez(path, **stored)
    data = path.read_bytes()
    random = np.random.default_rng(5)
    for _ in range(150):
        changed = bytearray(data)
        for at in random.integers(0, len(data), 20):
            changed[at] = random.integers(256)
        path.write_bytes(bytes(changed[: random.integers(1, len(data) + 1)]))
        with pytest.raises(kp.FileError):
            kp.load_solution(path)


@pytest.mark.parametrize("error", [RecursionError, MemoryError, ValueError, OverflowError])
def test_no_other_error_gets_out(
    stored: Arrays, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: type[Exception]
) -> None:
    path = tmp_path / "s.npz"
    np.savez(path, **stored)

    def fails(*_: object) -> None:
        raise error

    monkeypatch.setattr(archive, "_read_arrays", fails)
    with pytest.raises(kp.FileError, match="damaged"):
        kp.load_solution(path)


@pytest.mark.parametrize("path", [3, None, "a\0b", "a\udc80b\ud800", b"x.npz", ["x"]])
def test_what_is_not_a_path_is_a_file_error(solution: kp.Solution, path: Any) -> None:
    for call in (kp.load_solution, kp.load, solution.save, solution.to_csv):
        with pytest.raises(kp.FileError):
            call(path)


@pytest.mark.parametrize("method", [kp.Auto(), kp.RK45(), kp.RK4(step=1e-3), kp.Radau()])
def test_the_statistics_name_the_method(
    model: kp.Model, start: kp.State, tmp_path: Path, method: Any
) -> None:
    sol = kp.dynamics(model, start, t_end=0.01, method=method)
    known = {"auto": {"dop853", "radau"}}.get(method.kind, {method.kind})
    assert sol.statistics["method"] in known
    sol.save(tmp_path / "s.npz")
    assert kp.load_solution(tmp_path / "s.npz").statistics == sol.statistics


@pytest.mark.parametrize("dense", [True, False])
@pytest.mark.parametrize("t_end", [0.0, 0.05])
def test_every_kind_of_run_is_read_again(
    model: kp.Model, start: kp.State, tmp_path: Path, t_end: float, dense: bool
) -> None:
    sol = kp.dynamics(model, start, t_end=t_end, dense_output=dense)
    sol.save(tmp_path / "s.npz")
    again = kp.load_solution(tmp_path / "s.npz")
    assert np.array_equal(again.lam, sol.lam)
    assert (again.dense is None) == (not dense)


@pytest.mark.parametrize("name", ["four_bar", "slider_crank", "six_bar"])
def test_every_number_is_read_as_it_was_saved(name: str, tmp_path: Path) -> None:
    case = kp.load(ROOT / "examples" / f"{name}.toml")
    sol = case.with_analysis(next(iter(case.analyses)), t_end=0.2, output_step=0.01).run()[0]
    sol.save(tmp_path / "s.npz")
    again = kp.load_solution(tmp_path / "s.npz")
    for key in ("t", "q", "v", "z", "a", "lam", "nfev", "status", "message", "statistics"):
        assert np.array_equal(getattr(again, key), getattr(sol, key)), key
    for key in ("kinetic", "potential", "dissipated", "work_of_drivers", "work_of_forces", "total"):
        assert np.array_equal(getattr(again.energy, key), getattr(sol.energy, key)), key
    assert bool(sol.energy.work_of_drivers.any()) == (name == "six_bar")
    assert not sol.energy.work_of_forces.any()
    between = np.linspace(0.003, 0.197, 7)
    for key in ("q", "v", "a", "lam"):
        assert np.array_equal(getattr(again(between), key), getattr(sol(between), key)), key
    for key in ("dissipated", "work_of_drivers", "work_of_forces"):
        one, other = (getattr(each.energy_at(between), key) for each in (again, sol))
        assert np.array_equal(one, other), key
    with np.load(tmp_path / "s.npz") as arrays:
        for k, key in enumerate(("kinetic", "potential", "dissipated", "work_of_drivers")):
            assert np.array_equal(arrays["energy"][:, k], getattr(sol.energy, key))


def test_the_next_save_clears_what_killed_saves_left(solution: kp.Solution, tmp_path: Path) -> None:
    import os
    import subprocess
    import sys

    done = subprocess.Popen([sys.executable, "-c", "pass"])
    done.wait()
    dead = [f".s.npz.{done.pid}.0123abcd.part", ".s.npz.89abcdef.part"]
    kept = [
        f".s.npz.{os.getpid()}.0123abcd.part",
        f".t.npz.{done.pid}.0123abcd.part",
        ".s.npz.part",
    ]
    for name in dead + kept:
        (tmp_path / name).write_bytes(b"left")
    solution.save(tmp_path / "s.npz")
    assert {path.name for path in tmp_path.iterdir()} == {"s.npz", *kept}


@pytest.mark.parametrize(("runs", "told"), [(["rk45"], "rk45"), (["rk45", "radau"], "unknown")])
def test_a_file_without_the_name_of_its_method(
    stored: Arrays, tmp_path: Path, runs: list[str], told: str
) -> None:
    """Version 0.1 wrote none; the only analysis of its case gives it."""

    def old(a: dict[str, Any]) -> None:
        del a["statistics"]["method"]
        common = {"type": "dynamics", "t_end": 1.0}
        entries = ({**common, "method": {"type": kind}} for kind in runs)
        a["case"]["analyses"] = {f"run{k}": one for k, one in enumerate(entries)}

    np.savez(tmp_path / "old.npz", **about(old)(dict(stored)))
    assert kp.load_solution(tmp_path / "old.npz").statistics["method"] == told
