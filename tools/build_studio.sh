#!/bin/sh
# Builds the page of the studio: python/kempe/studio/built/page.html, one file with the core as WebAssembly.
#
#     tools/build_studio.sh
#
# It needs Node 20 or later with npm, and Rust for wasm32-unknown-unknown, which tools/check_wasm.sh gets.
# Exit code: 0 when all is well, 1 when something fails, 5 when a tool is missing.
set -eu

ROOT=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P) || exit 5
PAGE=$ROOT/python/kempe/studio/built/page.html

say() { printf 'studio: %s\n' "$*" >&2; }

command -v npm >/dev/null 2>&1 || {
    say "no npm found: install Node 20 or later"
    exit 5
}
"$ROOT/tools/check_wasm.sh" install
KEMPE_WEB=$("$ROOT/tools/check_wasm.sh" build)
export KEMPE_WEB

cd "$ROOT/studio"
npm ci --silent --no-audit --no-fund
npm run --silent build >&2
mkdir -p "$(dirname "$PAGE")"
cp dist/index.html "$PAGE.new"
mv -f "$PAGE.new" "$PAGE"
say "built: $PAGE"
