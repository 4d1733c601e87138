#!/bin/sh
# Builds the page of the studio: python/kempe/studio/built/page.html, one file with the core as WebAssembly.
#
#     tools/build_studio.sh
#
# It needs Node 20 or later with npm, Python (or the interpreter $PYTHON), and Rust for wasm32-unknown-unknown,
# which tools/check_wasm.sh gets.
# Exit code: 0 when all is well, 1 when something fails, 5 when a tool is missing.
set -eu

ROOT=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P) || exit 5
PAGE=$ROOT/python/kempe/studio/built/page.html
NODE_MAJOR=20

say() { printf 'studio: %s\n' "$*" >&2; }

missing() {
    say "$*"
    exit 5
}

command -v npm >/dev/null 2>&1 || missing "no npm found: install Node $NODE_MAJOR or later"
node=$(node --version 2>/dev/null) || missing "no node found: install Node $NODE_MAJOR or later"
major=${node#v}
[ "${major%%.*}" -ge "$NODE_MAJOR" ] || missing "Node $NODE_MAJOR or later is needed, found $node"

python=${PYTHON:-python3}
command -v "$python" >/dev/null 2>&1 || missing "no $python found: install Python 3.10 or later, or set PYTHON to one"

# The checksum is computed before the build, so that a change during the build is noticed later.
KEMPE_SOURCES=$("$python" "$ROOT/python/kempe/studio/sources.py")
export KEMPE_SOURCES

"$ROOT/tools/check_wasm.sh" install
say "building the core for pages, which takes some minutes the first time"
KEMPE_WEB=$("$ROOT/tools/check_wasm.sh" build)
export KEMPE_WEB

say "building the page"
cd "$ROOT/studio"
npm ci --silent --no-audit --no-fund
npm run --silent build >&2
mkdir -p "$(dirname "$PAGE")"
cp dist/index.html "$PAGE.new"
mv -f "$PAGE.new" "$PAGE"
say "built: $PAGE"
