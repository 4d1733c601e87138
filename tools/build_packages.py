"""Build the packages of kempe for other machines: a source distribution and, from it, a wheel.

    .venv/bin/pip install --require-hashes -r tools/lock/packages.txt
    .venv/bin/python tools/build_packages.py

The packages are written to dist/. A wheel for x86-64 contains the core twice
(kempe/_processor.py), and each wheel the library inside FMUs. Wheel and source distribution
contain the page of the studio that the repository carries.
On Linux, Zig links against an old glibc, so that the wheel runs on old systems too.
"""

import argparse
import os
import platform
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
WORK = ROOT / "target" / "packages"
#: glibc 2.17 is that of the oldest systems which NumPy supports.
GLIBC = "manylinux_2_17"
#: Sources and files in packages have this time, so that the same sources give the same packages.
EPOCH = "1767225600"  # 2026-01-01
#: Without optimisation across crates. The results are the same; runs take several times as long.
QUICK = {"LTO": "off", "CODEGEN_UNITS": "16", "OPT_LEVEL": "0"}
V3 = "x86_64_v3"
#: Endings of shared libraries.
ENDINGS = (".so", ".dylib", ".dll")


def main(words: list[str] | None = None) -> None:
    """Build the packages that the command line requests."""
    parser = argparse.ArgumentParser(description="Build a source distribution and a wheel.")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="default: dist/")
    parser.add_argument("--target", help="target of Rust, such as aarch64-unknown-linux-gnu")
    parser.add_argument("--quick", action="store_true", help="compile without optimisation")
    chosen = parser.parse_args(words)
    chosen.out.mkdir(parents=True, exist_ok=True)
    os.environ["SOURCE_DATE_EPOCH"] = EPOCH
    archive = source_distribution(chosen.out)
    print(wheel(archive, chosen.out, chosen.target, chosen.quick))


def source_distribution(out: Path) -> Path:
    """Build the source distribution from the working tree."""
    made = WORK / "sdist"
    shutil.rmtree(made, ignore_errors=True)
    run("maturin", "sdist", "--out", str(made), cwd=ROOT)
    return Path(shutil.move(only(made, "*.tar.gz"), out / only(made, "*.tar.gz").name))


def wheel(archive: Path, out: Path, target: str | None, quick: bool) -> Path:
    """Build a wheel from a source distribution; for x86-64 with a second core."""
    sources = unpacked(archive)
    processor = target.partition("-")[0] if target else platform.machine().lower()
    if processor not in ("x86_64", "amd64"):
        plain = compiled(sources, "plain", [], target, quick)
        return finished(plain, [], library(sources, "plain", [], target, quick), out)
    flags = ["-C", "target-cpu=x86-64"]
    baseline = compiled(sources, "x86_64", flags, target, quick)
    faster = compiled(sources, V3, ["-C", "target-cpu=x86-64-v3"], target, quick)
    # FMUs go to other machines, so that they contain the one for every processor
    return finished(baseline, [faster], library(sources, "x86_64", flags, target, quick), out)


def unpacked(archive: Path) -> Path:
    """The sources of an archive, with the present time: cargo compares times."""
    folder = WORK / "sources"
    shutil.rmtree(folder, ignore_errors=True)
    with tarfile.open(archive) as tar:
        tar.extractall(folder, filter=lambda member, path: tarfile.data_filter(
            member.replace(mtime=None, deep=False), path))  # fmt: skip
    return only(folder, "*")


def compiled(sources: Path, name: str, flags: list[str], target: str | None, quick: bool) -> Path:
    """Compile a wheel with flags of rustc; no path of this machine enters it."""
    made = WORK / name
    shutil.rmtree(made, ignore_errors=True)
    environment = variables(name, flags, quick)
    words = ["build", "--release", "--locked", "--strip", "--out", str(made)]
    if sys.platform == "linux":
        words += ["--zig", "--compatibility", GLIBC]
    if target:
        words += ["--target", target]
    run("maturin", *words, cwd=sources, environment=environment)
    return only(made, "*.whl")


def library(sources: Path, name: str, flags: list[str], target: str | None, quick: bool) -> Path:
    """Compile the library inside FMUs with the same flags; on Linux also against an old glibc."""
    environment = variables(name, flags, quick)
    chosen = target or run("rustc", "--print", "host-tuple", module=False).strip()
    if sys.platform == "linux":
        linker = f"CARGO_TARGET_{chosen.upper().replace('-', '_')}_LINKER"
        environment[linker] = str(zig_linker(chosen))
    words = ["rustc", "--release", "--locked", "--package", "kempe-fmu", "--target", chosen]
    run(
        "cargo",
        *words,
        "--",
        "-C",
        "strip=symbols",
        cwd=sources,
        environment=environment,
        module=False,
    )
    folder = Path(environment["CARGO_TARGET_DIR"], chosen, "release")
    return next(path for path in folder.glob("*kempe_fmu.*") if path.suffix in ENDINGS)


def zig_linker(target: str) -> Path:
    """A linker for cargo: Zig with an old glibc, which has the unwinder in a library of its own."""
    processor = target.partition("-")[0]
    system = f"{processor}-linux-gnu.{GLIBC.removeprefix('manylinux_').replace('_', '.')}"
    path = WORK / f"zig-{processor}"
    path.write_text(
        f"#!{sys.executable}\n"
        "import os, sys\n"
        "words = ['-lunwind' if word == '-lgcc_s' else word for word in sys.argv[1:]]\n"
        f"command = [sys.executable, '-m', 'ziglang', 'cc', '-target', {system!r}, *words]\n"
        "os.execv(sys.executable, command)\n"
    )
    path.chmod(0o755)
    return path


def variables(name: str, flags: list[str], quick: bool) -> dict[str, str]:
    """The variables of cargo for a set of flags of rustc."""
    cargo_home = os.environ.get("CARGO_HOME", str(Path.home() / ".cargo"))
    flags = [
        *flags,
        f"--remap-path-prefix={cargo_home}=/cargo",
        f"--remap-path-prefix={ROOT}=/kempe",
    ]
    environment = {"CARGO_ENCODED_RUSTFLAGS": "\x1f".join(flags)}
    environment["CARGO_TARGET_DIR"] = str(WORK / f"cargo-{name}")
    environment["PYO3_PYTHON"] = environment["CARGO_ZIGBUILD_PYTHON_PATH"] = sys.executable
    if quick:
        environment |= {f"CARGO_PROFILE_RELEASE_{key}": value for key, value in QUICK.items()}
    return environment


def finished(path: Path, faster: list[Path], library: Path, out: Path) -> Path:
    """Add the second core, the library inside FMUs and the licences of Rust's; pack it again."""
    folder = WORK / "unpacked"
    shutil.rmtree(folder, ignore_errors=True)
    run("wheel", "unpack", str(path), "--dest", str(folder / "wheel"))
    inside = only(folder / "wheel", "*")
    for other in faster:
        run("wheel", "unpack", str(other), "--dest", str(folder / "other"))
        core = only(only(folder / "other", "*") / "kempe", "_core.*[od]")  # .so or .pyd
        (inside / "kempe" / f"_{V3}").mkdir()
        shutil.copy2(core, inside / "kempe" / f"_{V3}" / core.name)
    (inside / "kempe" / "_fmu").mkdir()
    shutil.copy2(library, inside / "kempe" / "_fmu" / library.name)
    for name in ("LICENSE-MIT", "THIRD_PARTY_NOTICES.txt"):
        shutil.copy2(ROOT / name, inside / "kempe" / "_fmu" / name)
    information = only(inside, "*.dist-info")
    add_licences_of_rust(information / "licenses")
    for parts in information.glob("sboms/*.json"):  # maturin's list of crates, with their folders
        parts.write_text(parts.read_text("utf-8").replace(WORK.as_posix(), "/kempe"), "utf-8")
    run("wheel", "pack", str(inside), "--dest-dir", str(out))
    return out / path.name


def add_licences_of_rust(folder: Path) -> None:
    """Copy the page of the toolchain with the licences of the standard library of Rust."""
    root = run("rustc", "--print", "sysroot", module=False).strip()
    page = Path(root, "share", "doc", "rust", "COPYRIGHT-library.html")
    if not page.is_file():
        raise SystemExit(f"{page} is missing: install Rust from rustup with its documentation")
    shutil.copy(page, folder / "COPYRIGHT-rust-library.html")


def only(folder: Path, pattern: str) -> Path:
    """The file in a folder that matches a pattern."""
    (found,) = folder.glob(pattern)
    return found


def run(
    *words: str,
    cwd: Path | None = None,
    environment: dict[str, str] | None = None,
    module: bool = True,
) -> str:
    """Run a program, by default a module of this Python; its errors are printed."""
    command = [sys.executable, "-m", *words] if module else list(words)
    variables = os.environ | (environment or {})
    done = subprocess.run(
        command, cwd=cwd, env=variables, check=True, stdout=subprocess.PIPE, text=True
    )
    return done.stdout


if __name__ == "__main__":
    main()
