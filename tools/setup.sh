# shellcheck shell=sh
# The set-up that ./kempe and ./test share; sourced by both, with ROOT set to the repository root.
#
# After `set_up run` or `set_up test`, $VENV/bin/python runs kempe from the sources in place. The
# work is done only when what it depends on has changed: a stamp holds a checksum of the inputs, and
# is written last, so that an interrupted set-up is taken up again at the next start.
# Exit code 5: the set-up could not be done; one line on stderr tells what is missing.

SETUP_FAILED=5
RUST_MINOR=85 # rust-version = "1.85" in Cargo.toml

VENV=$ROOT/.venv
LOCK=$ROOT/.venv.lock
LOG=$ROOT/.venv.log

say() { printf 'kempe: %s\n' "$*" >&2; }

give_up() {
    say "$*"
    exit "$SETUP_FAILED"
}

# set_up run|test
set_up() {
    choose_instructions
    is_set_up "$1" && return
    take_lock
    # Another start may have done the work while this one waited for the lock.
    is_set_up "$1" || do_set_up "$1"
    release_lock
}

# The core is built for processors with AVX2 (.cargo/config.toml); for one without, for any x86-64.
choose_instructions() {
    [ "$(uname -m)" = x86_64 ] && [ -r /proc/cpuinfo ] || return 0
    grep -qw avx2 /proc/cpuinfo || export RUSTFLAGS="${RUSTFLAGS:--C target-cpu=x86-64}"
}

is_set_up() { has_venv && has_packages "$1" && has_extension; }

do_set_up() {
    : >"$LOG" || give_up "cannot write to $ROOT: make it writable, or clone kempe elsewhere"
    check_tools
    make_venv
    install_packages "$1"
    build_extension
}

# --- stamps ---------------------------------------------------------------------------------------

stamp() { cat "$VENV/stamp-$1" 2>/dev/null; }

# Written under another name first, so that no half-written stamp is ever read.
write_stamp() { printf '%s\n' "$2" >"$VENV/stamp-$1.new" && mv -f "$VENV/stamp-$1.new" "$VENV/stamp-$1"; }

# A venv does not survive being moved, hence ROOT; another $PYTHON asks for another one.
has_venv() {
    case $(stamp venv) in
    "$ROOT|${PYTHON:+$PYTHON|}"*) [ -x "$VENV/bin/python" ] ;;
    *) return 1 ;;
    esac
}

# The packages for the tests contain those for a run.
has_packages() {
    case "$1 $(stamp packages)" in
    "run run $(packages_sum)" | "run test $(packages_sum)" | "test test $(packages_sum)") ;;
    *) return 1 ;;
    esac
}

packages_sum() { (cd "$ROOT" && cat pyproject.toml constraints.txt | cksum); }

has_extension() {
    for extension in "$ROOT"/python/kempe/_core.*; do
        case $extension in
        *.so | *.dylib | *.pyd) [ "$(stamp build)" = "$(sources_sum)" ] && return ;;
        esac
    done
    return 1
}

# Contents, not times: a file that was only touched, or went and came back, needs no build.
sources_sum() {
    (
        cd "$ROOT" && {
            printf '%s\n' "${RUSTFLAGS:-}"
            find .cargo Cargo.toml Cargo.lock pyproject.toml core bindings \
                \( -path core/tests -o -path core/benches -o -name target \) -prune -o \
                -type f -exec cksum {} + | LC_ALL=C sort
        } | cksum
    )
}

# --- one set-up at a time -------------------------------------------------------------------------

# The lock is a folder, because making one either succeeds or fails as a whole. It holds the
# process id of its owner; a lock whose owner has died is moved aside.
take_lock() {
    told=
    nameless=0
    until mkdir "$LOCK" 2>/dev/null; do
        [ -w "$ROOT" ] || give_up "cannot write to $ROOT: make it writable, or clone kempe elsewhere"
        owner=$(cat "$LOCK/pid" 2>/dev/null) || owner=
        # Between making the folder and naming the owner there is a moment without a name.
        if [ -z "$owner" ]; then nameless=$((nameless + 1)); else nameless=0; fi
        if [ "$nameless" -gt 10 ] || { [ -n "$owner" ] && ! is_alive "$owner"; }; then
            break_lock "$owner"
            continue
        fi
        [ -n "$told" ] || say "waiting for another set-up (process ${owner:-unknown}; if there is none, delete .venv.lock)"
        told=yes
        sleep 1
    done
    trap 'release_lock' EXIT
    trap 'exit 129' HUP
    trap 'exit 130' INT
    trap 'exit 143' TERM
    printf '%s\n' "$$" >"$LOCK/pid"
}

# Two may see the same dead owner: after the move, the one that took a living lock puts it back.
break_lock() {
    mv "$LOCK" "$LOCK.$$" 2>/dev/null || return 0
    if [ "$(cat "$LOCK.$$/pid" 2>/dev/null)" = "$1" ]; then
        rm -rf "$LOCK.$$"
    else
        mv "$LOCK.$$" "$LOCK"
    fi
}

release_lock() {
    rm -rf "$LOCK"
    trap - EXIT HUP INT TERM
}

# `kill -0` also fails for a living process of somebody else; /proc knows better where it exists.
is_alive() { kill -0 "$1" 2>/dev/null || [ -d "/proc/$1" ]; }

# --- what the machine must have -------------------------------------------------------------------

check_tools() {
    command -v cc >/dev/null 2>&1 || give_up "no C linker (cc) found: install one (Debian, Ubuntu: apt install build-essential; macOS: xcode-select --install)"
    command -v cargo >/dev/null 2>&1 || PATH=$PATH:${CARGO_HOME:-$HOME/.cargo}/bin
    rust=$(cargo --version 2>/dev/null) || give_up "Rust (cargo) not found: install it from https://rustup.rs"
    minor=${rust#cargo 1.}
    minor=${minor%%.*}
    case $minor in
    '' | *[!0-9]*) ;; # a version this script cannot read is left for cargo to judge
    *) [ "$minor" -ge "$RUST_MINOR" ] || give_up "Rust 1.$RUST_MINOR or later is needed, found $rust: run 'rustup update'" ;;
    esac
    find_python
}

is_recent() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 10))' >/dev/null 2>&1; }

# Sets BASE to the Python that the virtual environment is made from; $PYTHON is taken at its word.
find_python() {
    BASE=
    if [ -n "${PYTHON:-}" ]; then
        is_recent "$PYTHON" || give_up "PYTHON=$PYTHON is not Python 3.10 or later: set it to one that is, or unset it"
        BASE=$PYTHON
    else
        for candidate in python3 python3.14 python3.13 python3.12 python3.11 python3.10 python; do
            if is_recent "$candidate"; then
                BASE=$candidate
                break
            fi
        done
    fi
    [ -n "$BASE" ] || give_up "Python 3.10 or later not found: install it (Debian, Ubuntu: apt install python3 python3-venv), or set PYTHON to one"
    "$BASE" -c 'import ensurepip, venv' 2>/dev/null || give_up "$BASE has no venv module: install it (Debian, Ubuntu: apt install python3-venv)"
}

# --- the work -------------------------------------------------------------------------------------

# logged WHAT COMMAND…: runs it silently, and shows the end of its output when it fails.
logged() {
    what=$1
    shift
    printf '\n== %s: %s\n' "$what" "$*" >>"$LOG"
    "$@" >>"$LOG" 2>&1 </dev/null && return
    tail -n 30 "$LOG" >&2
    give_up "$what failed; all of its output is in $LOG"
}

# `--clear` takes the stamps away too: a venv without them is half-made, and is made anew.
make_venv() {
    has_venv && "$VENV/bin/python" -c '' 2>/dev/null && return
    say "making .venv with $("$BASE" --version 2>&1)"
    logged "making .venv" "$BASE" -m venv --clear "$VENV"
    packages=$("$VENV/bin/python" -c 'import sysconfig; print(sysconfig.get_path("purelib"))')
    printf '%s\n' "$ROOT/python" >"$packages/kempe.pth" || give_up "cannot write to $VENV"
    write_stamp venv "$ROOT|${PYTHON:-$BASE}|"
}

install_packages() {
    has_packages "$1" && return
    say "installing Python packages"
    sum=$(packages_sum)
    "$VENV/bin/python" "$ROOT/tools/requirements.py" "$1" >"$VENV/requirements.txt" ||
        give_up "cannot read pyproject.toml"
    logged "installing Python packages" "$VENV/bin/python" -m pip install --no-input \
        --disable-pip-version-check -c "$ROOT/constraints.txt" -r "$VENV/requirements.txt"
    write_stamp packages "$1 $sum"
}

# The checksum is taken before the build: a source that changes during it is seen at the next start.
build_extension() {
    has_extension && return
    say "building the core"
    sum=$(sources_sum)
    (
        cd "$ROOT" || exit "$SETUP_FAILED"
        # maturin takes the venv from here, and refuses to choose between it and conda's.
        unset CONDA_PREFIX
        export VIRTUAL_ENV="$VENV"
        logged "building the core" "$VENV/bin/python" -m maturin develop --release --locked --skip-install
    ) || exit "$SETUP_FAILED"
    write_stamp build "$sum"
}
