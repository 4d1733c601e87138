#!/bin/sh
# Builds the documentation site from docs/ into site/, or into the folder given; a warning is an error.
#
#     tools/build_site.sh [FOLDER]
#
# The interpreter is $PYTHON, or .venv/bin/python. The extra "docs" of pyproject.toml names the packages.
# The site needs no network: open site/index.html, or serve the folder.
set -eu

cd -- "$(dirname -- "$0")/.."
export NO_MKDOCS_2_WARNING=1
PYTHON=${PYTHON:-.venv/bin/python}

# needs WHAT REMEDY COMMAND…: ends with code 5 if the command fails.
needs() {
    what=$1
    remedy=$2
    shift 2
    "$@" >/dev/null 2>&1 || {
        printf 'build_site: %s: %s\n' "$what" "$remedy" >&2
        exit 5
    }
}

needs "no Python at $PYTHON" "run ./kempe --version, or set PYTHON" "$PYTHON" -c ''
needs "the packages of the site are missing" \
    "run $PYTHON -m pip install --require-hashes -r tools/lock/test.txt" \
    "$PYTHON" -c 'import material, mathjax, mkdocs, mkdocstrings'
needs "the core of kempe is not built, and pages show its results" "run ./kempe --version" \
    "$PYTHON" -c 'import kempe._core'
exec "$PYTHON" -m mkdocs --quiet build --strict --site-dir "${1:-site}"
