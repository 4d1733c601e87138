#!/bin/sh
# Checks that the core compiles to WebAssembly and computes there what it computes here.
#
#     tools/check_wasm.sh            all of the following
#     tools/check_wasm.sh install    gets a toolchain, if there is none
#     tools/check_wasm.sh check      the core and the drawing compile for wasm32-unknown-unknown
#     tools/check_wasm.sh build      builds the module of pages, and prints its path
#     tools/check_wasm.sh run        the four-bar linkage runs in Node and agrees with the reference
#
# The toolchain is that of rustup if it has the source of the standard library (`rustup component add rust-src`).
# Otherwise `install` unpacks Debian's packages into target/wasm, about 1 GB; it changes nothing
# outside and needs no root. The standard library is built from its source.
# Exit code: 0 when all is well, 1 when something fails, 5 when there is no toolchain.
set -u

ROOT=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P) || exit 5
HOME_OF_WASM=$ROOT/target/wasm
DEBIAN=$HOME_OF_WASM/debian
CRATE=$ROOT/bindings/web/Cargo.toml
TARGET=wasm32-unknown-unknown
PACKAGES="rustc-web cargo-web rust-web-src lld-19"
MODULE=$HOME_OF_WASM/build/$TARGET/wasm/kempe_web.wasm

say() { printf 'wasm: %s\n' "$*" >&2; }

no_toolchain() {
    say "$*"
    exit 5
}

has_rustup_source() { [ -d "$(rustc --print sysroot 2>/dev/null)/lib/rustlib/src/rust/library" ]; }
has_debian() { [ -f "$DEBIAN/complete" ]; }

# --- install --------------------------------------------------------------------------------------

install() {
    has_rustup_source && return
    has_debian && return
    command -v apt-get >/dev/null 2>&1 && command -v dpkg-deb >/dev/null 2>&1 ||
        no_toolchain "no Rust for $TARGET, and no apt to get one: run 'rustup component add rust-src'"
    say "unpacking $PACKAGES into $DEBIAN"
    rm -rf "$DEBIAN"
    mkdir -p "$DEBIAN/packages" || no_toolchain "cannot write to $HOME_OF_WASM"
    names=$(missing_packages)
    # on a new machine the lists of packages may be absent or old
    if [ -z "$names" ] && [ "$(id -u)" = 0 ]; then
        apt-get update -qq && names=$(missing_packages)
    fi
    [ -n "$names" ] || no_toolchain "apt does not offer $PACKAGES: run 'apt-get update', or use rustup"
    # shellcheck disable=SC2086 # a list of words
    (cd "$DEBIAN/packages" && apt-get download -qq $names 2>"$DEBIAN/log") || {
        cat "$DEBIAN/log" >&2
        no_toolchain "the packages could not be downloaded"
    }
    for package in "$DEBIAN"/packages/*.deb; do
        dpkg-deb -x "$package" "$DEBIAN" || no_toolchain "$package could not be unpacked"
    done
    rm -rf "$DEBIAN/packages"
    : >"$DEBIAN/complete"
}

# The packages with all they depend on that this machine does not have; installed ones of the four
# themselves are unpacked again, so that all of them are in one place.
missing_packages() {
    # shellcheck disable=SC2086 # a list of words
    apt-get install -s --reinstall --no-install-recommends $PACKAGES 2>/dev/null |
        sed -n 's/^Inst \([^ ]*\).*/\1/p'
}

# --- build ----------------------------------------------------------------------------------------

# wasm_cargo COMMAND…: cargo for the target, with whichever toolchain there is. The standard library is compiled for size,
# and panics stop at once, since pages do not show their messages. So the places of panics are left out too: they are
# paths of this machine.
wasm_cargo() {
    command=$1
    shift
    set -- "$command" --manifest-path "$CRATE" --target "$TARGET" --target-dir "$HOME_OF_WASM/build" \
        -Zbuild-std=std,panic_abort -Zbuild-std-features=optimize_for_size -Zpanic-immediate-abort "$@"
    export RUSTC_BOOTSTRAP=1 CARGO_PROFILE_WASM_PANIC=immediate-abort RUSTFLAGS=-Zlocation-detail=none
    if has_rustup_source; then
        cargo "$@"
        return
    fi
    has_debian || no_toolchain "no Rust for $TARGET: run 'tools/check_wasm.sh install'"
    libraries=$(dirname "$(find "$DEBIAN/usr/lib" -name 'librustc_driver-*.so' | head -n 1)")
    LD_LIBRARY_PATH=$libraries RUSTC=$DEBIAN/usr/bin/rustc \
        CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$DEBIAN/usr/bin/wasm-ld-19 \
        "$DEBIAN/usr/bin/cargo" "$@"
}

check() {
    wasm_cargo check --quiet --locked || exit 1
    say "the core and the drawing compile for $TARGET"
}

build() {
    # the module alone: cargo does not optimise across crates (LTO) where it makes a library for Rust, too
    wasm_cargo rustc --quiet --locked --profile wasm --lib --crate-type cdylib || exit 1
}

run() {
    command -v node >/dev/null 2>&1 || no_toolchain "no node found: install Node 18 or later"
    build
    node "$ROOT/tools/wasm_four_bar.mjs" "$MODULE" || exit 1
}

cd "$ROOT" || exit 5
unset RUSTFLAGS CARGO_ENCODED_RUSTFLAGS # those of this machine are not for WebAssembly
case ${1:-all} in
install) install ;;
check) check ;;
build)
    build
    printf '%s\n' "$MODULE"
    ;;
run) run ;;
all)
    install
    check
    run
    ;;
*)
    say "unknown command '$1'; it may be install, check, build or run"
    exit 2
    ;;
esac
