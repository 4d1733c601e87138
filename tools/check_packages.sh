#!/bin/sh
# Builds the packages and tests them: contents, fresh environments, an emulated processor without AVX2.
#
#     tools/check_packages.sh            as they are released, into dist/; with all Pythons in PATH
#     tools/check_packages.sh --quick    without optimisation, into target/packages/quick; with one Python
#     tools/check_packages.sh --source   only the source distribution and the licences; compiles nothing
#
# Further arguments are passed to pytest. The emulation needs qemu-x86_64 (Debian: qemu-user); without it
# its test is skipped. docs/internals/release.md describes the rest of a release.
# Exit code: that of pytest, or 5 if the set-up or a build fails.
set -u

ROOT=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P) || exit 5
# shellcheck source=tools/setup.sh
. "$ROOT/tools/setup.sh"
set_up test
cd "$ROOT" || exit 5
PATH=$PATH:${CARGO_HOME:-$HOME/.cargo}/bin
python() { "$VENV/bin/python" "$@"; }

if [ "${1:-}" = --source ]; then
    shift
    export KEMPE_PACKAGES="$ROOT/target/packages/source"
    rm -rf "$KEMPE_PACKAGES"
    python -m maturin sdist --out "$KEMPE_PACKAGES" || exit 5
    python -m pytest tests/packages/test_notices.py \
        tests/packages/test_contents.py::test_the_source_distribution_has_what_a_build_needs "$@"
    exit
fi
python -m pip install --quiet --require-hashes -r tools/lock/packages.txt || exit 5
if [ "${1:-}" = --quick ]; then
    shift
    export KEMPE_PACKAGES="$ROOT/target/packages/quick"
    rm -rf "$KEMPE_PACKAGES"
    python tools/build_packages.py --quick --out "$KEMPE_PACKAGES" || exit 5
else
    export KEMPE_PACKAGES="$ROOT/dist"
    rm -rf "$KEMPE_PACKAGES"
    python tools/build_packages.py || exit 5
    # the same core from the repository, to compare with the one that pip compiles from the sources
    export CARGO_PROFILE_RELEASE_LTO=off CARGO_PROFILE_RELEASE_CODEGEN_UNITS=16 PYO3_PYTHON="$VENV/bin/python"
    RUSTFLAGS="-C target-cpu=x86-64" cargo build --release --locked -p kempe-python \
        --target-dir target/packages/cargo-repository || exit 5
    export KEMPE_REPOSITORY_BASELINE="$ROOT/target/packages/cargo-repository/release/lib_core.so"
    KEMPE_PYTHONS=
    for minor in 10 11 12 13 14; do
        if is_recent "python3.$minor"; then KEMPE_PYTHONS="$KEMPE_PYTHONS $(command -v "python3.$minor")"; fi
    done
    export KEMPE_PYTHONS="${KEMPE_PYTHONS:-$VENV/bin/python}"
fi
python -m pytest tests/packages "$@"
