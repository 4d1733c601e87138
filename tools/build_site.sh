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
exec "${PYTHON:-.venv/bin/python}" -m mkdocs --quiet build --strict --site-dir "${1:-site}"
