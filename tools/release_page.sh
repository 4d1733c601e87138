#!/bin/sh
# Replaces the page of the studio that kempe carries, python/kempe/studio/page.html.gz, by that of the present sources.
#
#     tools/release_page.sh
#
# Only a release does this: every version of the file stays in the history. docs/internals/release.md has the steps.
# It needs the tools of tools/build_studio.sh, and has its exit codes.
set -eu

ROOT=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P) || exit 5
FOLDER=$ROOT/python/kempe/studio
CARRIED=$FOLDER/page.html.gz

"$ROOT/tools/build_studio.sh"
# by Node, as the build measures it; without name and time, so that the same page gives the same file
node -e 'const fs = require("fs"), zlib = require("zlib")
fs.writeFileSync(process.argv[2], zlib.gzipSync(fs.readFileSync(process.argv[1]), { level: 9 }))' \
    "$FOLDER/built/page.html" "$CARRIED.new"
mv -f "$CARRIED.new" "$CARRIED"
printf 'studio: %s has %s bytes; commit it\n' "$CARRIED" "$(wc -c <"$CARRIED")" >&2
