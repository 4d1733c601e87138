#!/bin/sh
# Writes tools/lock/*.txt: the packages in constraints.txt with the hashes of all their files, for
# every supported Python. tools/setup.sh installs from these files only.
#
#     .venv/bin/pip install uv && tools/lock.sh
set -eu

cd -- "$(dirname -- "$0")/.."
PATH=$PWD/.venv/bin:$PATH
mkdir -p tools/lock
for purpose in run test packages release; do
    python tools/requirements.py "$purpose" |
        uv pip compile - --quiet --universal --python-version 3.10 --generate-hashes --no-annotate \
            --no-header --no-emit-index-url --constraints constraints.txt --output-file "tools/lock/$purpose.txt"
done
