# shellcheck shell=sh
# Set-up for ./kempe and ./test, which source this file with ROOT set to the repository root.
#
# After `set_up run` or `set_up test`, $VENV/bin/python runs kempe from the sources in place. The
# set-up runs only if its inputs have changed. A stamp contains a checksum of the inputs. It is
# written last, so that an interrupted set-up is repeated on the next start.
# Exit code 5: the set-up failed; one line on stderr gives the reason.

SETUP_FAILED=5
RUST_MINOR=85 # rust-version = "1.85" in Cargo.toml
# The profile of Cargo.toml with which the core is built: the one that compiles fast, or that of wheels, `release`.
PROFILE=${KEMPE_PROFILE:-checkout}
FIRST_BUILD="about two minutes" # measured on two processors; README.md and docs say the same

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
    is_set_up "$1" && return
    take_lock
    # Another process may have finished the set-up while this one waited for the lock.
    is_set_up "$1" || do_set_up "$1"
    release_lock
}

is_set_up() { has_venv && has_packages "$1" && has_extension; }

do_set_up() {
    : >"$LOG" || give_up "cannot write to $ROOT: make it writable, or clone kempe elsewhere"
    check_tools
    [ -d "$VENV" ] || say "first run: makes .venv and builds the core, which takes $FIRST_BUILD; later runs start at once"
    make_venv
    install_packages "$1"
    build_extension
}

# --- stamps ---------------------------------------------------------------------------------------

stamp() { cat "$VENV/stamp-$1" 2>/dev/null; }

# Written under another name first, so that an incomplete stamp is never read.
write_stamp() { printf '%s\n' "$2" >"$VENV/stamp-$1.new" && mv -f "$VENV/stamp-$1.new" "$VENV/stamp-$1"; }

# A venv cannot be moved, hence ROOT. Another $PYTHON needs another venv.
has_venv() {
    case $(stamp venv) in
    "$ROOT|${PYTHON:+$PYTHON|}"*) [ -x "$VENV/bin/python" ] ;;
    *) return 1 ;;
    esac
}

# The packages for the tests include those for a run.
has_packages() {
    case "$1 $(stamp packages)" in
    "run run $(packages_sum)" | "run test $(packages_sum)" | "test test $(packages_sum)") ;;
    *) return 1 ;;
    esac
}

packages_sum() { (cd "$ROOT" && cat pyproject.toml tools/lock/*.txt | cksum); }

has_extension() {
    for extension in "$ROOT"/python/kempe/_core.*; do
        case $extension in
        *.so | *.dylib | *.pyd) [ "$(stamp build)" = "$(sources_sum)" ] && return ;;
        esac
    done
    return 1
}

# The core is built for AVX2 (.cargo/config.toml), or for any x86-64 on processors without AVX2.
choose_instructions() {
    if grep -qs '^flags' /proc/cpuinfo && ! grep -qw avx2 /proc/cpuinfo; then
        export RUSTFLAGS="${RUSTFLAGS:--C target-cpu=x86-64}"
    fi
}

# Contents instead of times: a file with a new time but the same content needs no build.
sources_sum() {
    (
        cd "$ROOT" && choose_instructions && {
            printf '%s\n' "$PROFILE ${RUSTFLAGS:-}"
            find .cargo Cargo.toml Cargo.lock pyproject.toml core drawing exchange synthesis bindings/python \
                \( -path core/tests -o -path drawing/tests -o -path exchange/tests -o -path core/benches -o -name target \) -prune -o \
                -type f -exec cksum {} + | LC_ALL=C sort
        } | cksum
    )
}

# --- one set-up at a time -------------------------------------------------------------------------

# The lock is a folder, because the creation of a folder is atomic. It contains the process id of
# its owner. If the owner has died, the lock is moved away.
take_lock() {
    told=
    nameless=0
    until mkdir "$LOCK" 2>/dev/null; do
        [ -w "$ROOT" ] || give_up "cannot write to $ROOT: make it writable, or clone kempe elsewhere"
        owner=$(cat "$LOCK/pid" 2>/dev/null) || owner=
        # For a moment, the folder exists without the process id of its owner.
        if [ -z "$owner" ]; then nameless=$((nameless + 1)); else nameless=0; fi
        if [ "$nameless" -gt 10 ] || { [ -n "$owner" ] && ! is_alive "$owner"; }; then
            break_lock "$owner"
            continue
        fi
        [ -n "$told" ] || say "waiting for another set-up (process ${owner:-unknown}; if there is none, delete .venv.lock)"
        told=yes
        sleep 1
    done
    trap 'stop_progress; release_lock' EXIT
    trap 'exit 129' HUP
    trap 'exit 130' INT
    trap 'exit 143' TERM
    printf '%s\n' "$$" >"$LOCK/pid"
}

# Two processes may find the same dead owner. The one that moved a valid lock puts it back.
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

# `kill -0` also fails for processes of other users; /proc is more reliable where it exists.
is_alive() { kill -0 "$1" 2>/dev/null || [ -d "/proc/$1" ]; }

# --- requirements ---------------------------------------------------------------------------------

check_tools() {
    command -v cc >/dev/null 2>&1 || give_up "no C linker (cc) found: install one (Debian, Ubuntu: apt install build-essential; macOS: xcode-select --install)"
    command -v cargo >/dev/null 2>&1 || PATH=$PATH:${CARGO_HOME:-$HOME/.cargo}/bin
    rust=$(cargo --version 2>/dev/null) || give_up "Rust (cargo) not found: install it from https://rustup.rs"
    minor=${rust#cargo 1.}
    minor=${minor%%.*}
    case $minor in
    '' | *[!0-9]*) ;; # cargo checks a version that this script cannot parse
    *) [ "$minor" -ge "$RUST_MINOR" ] || give_up "Rust 1.$RUST_MINOR or later is needed, found $rust: run 'rustup update'" ;;
    esac
    find_python
}

is_recent() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 10))' >/dev/null 2>&1; }

# Sets BASE to the Python for the virtual environment; $PYTHON is used without a search.
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

# --- set-up ---------------------------------------------------------------------------------------

# logged WHAT COMMAND…: runs a command, shows its progress, and prints the end of its output if it fails.
logged() {
    what=$1
    shift
    printf '\n== %s: %s\n' "$what" "$*" >>"$LOG"
    trap - TERM # a process that has just begun could lose the signal of stop_progress to the trap
    show_progress "$what" &
    progress=$!
    trap 'exit 143' TERM
    code=0
    "$@" >>"$LOG" 2>&1 </dev/null || code=$?
    stop_progress
    [ "$code" = 0 ] && return
    tail -n 30 "$LOG" >&2
    cause=$(network_cause "$what")
    [ -z "$cause" ] || give_up "$what failed, because a download failed: $cause. $(network_remedy)"
    give_up "$what failed; all of its output is in $LOG"
}

# Runs beside a command: one line that changes each second on a terminal, a line each half minute elsewhere.
show_progress() {
    seconds=0
    # A reader of the output would wait for `sleep` if that had the same output. $$ may be killed.
    while sleep 1 >/dev/null 2>&1 && kill -0 "$$" 2>/dev/null; do
        seconds=$((seconds + 1))
        if [ -t 2 ]; then
            printf '\r\033[Kkempe: %s: %s%s s' "$1" "$(compiled)" "$seconds" >&2
        elif [ $((seconds % 30)) = 0 ]; then
            say "$1: $(compiled)$seconds s"
        fi
    done
}

# The crate that cargo began last, with its number; Cargo.lock has some that this system does not need.
compiled() {
    number=0
    crate=
    while IFS= read -r line; do
        case $line in
        *Compiling*)
            number=$((number + 1))
            line=${line#*Compiling}
            line=${line#* }
            ;;
        *) continue ;;
        esac
        crate=${line%% *}
    done <"$LOG"
    [ "$number" = 0 ] || printf 'crate %s of about %s (%s), ' "$number" "$(locked)" "$crate"
}

# The number of crates in Cargo.lock.
locked() {
    number=0
    while IFS= read -r line; do
        case $line in "name = "*) number=$((number + 1)) ;; esac
    done <"$ROOT/Cargo.lock"
    printf '%s' "$number"
}

stop_progress() {
    [ -n "${progress:-}" ] || return 0
    { kill "$progress" && wait "$progress"; } 2>/dev/null
    progress=
    [ ! -t 2 ] || printf '\r\033[K' >&2
}

# The first line after "== WHAT" in the log that reports a fault of the network; pip and cargo end
# with other lines, such as "No matching distribution found".
network_cause() {
    inside=
    while IFS= read -r line; do
        case $line in
        "== $1: "*) inside=yes ;;
        *ProxyError* | *"Cannot connect to proxy"* | *"ailed to establish a new connection"* | \
            *"Temporary failure in name resolution"* | *"Name or service not known"* | \
            *CERTIFICATE_VERIFY_FAILED* | *"SSL certificate"* | *"Read timed out"* | \
            *"ConnectTimeoutError"* | *"spurious network error"* | *"ould not resolve"* | \
            *"ouldn't connect to server"* | *"Network is unreachable"*)
            [ -n "$inside" ] || continue
            line=${line##*connection broken by }
            printf '%.200s' "$line"
            return
            ;;
        esac
    done <"$LOG"
}

# The value of a proxy variable may contain a password and is not printed.
network_remedy() {
    for name in HTTPS_PROXY https_proxy HTTP_PROXY http_proxy ALL_PROXY all_proxy PIP_PROXY; do
        eval "value=\${$name:-}"
        [ -z "$value" ] || {
            printf 'The variable %s names a proxy: correct or unset it' "$name"
            return
        }
    done
    printf 'Check the connection; behind a proxy, set HTTPS_PROXY'
}

# `--clear` also removes the stamps; a venv without stamps is incomplete and is created again.
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
    # Files with other hashes than those of the lock file are refused.
    logged "installing Python packages" "$VENV/bin/python" -m pip install --no-input \
        --disable-pip-version-check --require-hashes -r "$ROOT/tools/lock/$1.txt"
    write_stamp packages "$1 $sum"
}

# The checksum is computed before the build, so that a change during the build is noticed later.
build_extension() {
    has_extension && return
    if [ -n "$(stamp build)" ]; then
        say "building the core, because its sources have changed"
    else
        say "building the core: $FIRST_BUILD (later builds take seconds)"
    fi
    sum=$(sources_sum)
    logged "building the core" compile
    write_stamp build "$sum"
}

compile() (
    cd "$ROOT" || exit
    # for maturin, which fails if conda's variable is set as well
    unset CONDA_PREFIX
    export VIRTUAL_ENV="$VENV"
    choose_instructions
    "$VENV/bin/python" -m maturin develop --profile "$PROFILE" --locked --skip-install
)
