#!/bin/sh
# Tries a release: builds, tests and checks all that a release needs. It signs nothing and publishes nothing.
#
#     tools/release.sh --dry-run            as it is released; takes more than an hour on two processors
#     tools/release.sh --dry-run --quick    packages without optimisation, ./test, one Python
#     tools/release.sh --dry-run --sources  compiles nothing: documents, lists, notices, the source distribution
#
# A failure does not stop the later stages. The last lines list the stages, and the steps that a person does.
# docs/internals/release.md describes them. A release itself is made by hand, with the steps on that page.
# Exit code: 0 if it can be published, 3 if only steps of a person are left, 1 if a stage failed, 2 for wrong
# arguments, 5 if the set-up fails.
set -u

ROOT=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P) || exit 5
usage() {
    sed -n '2,6s/^# \{0,1\}//p' "$ROOT/tools/release.sh" >&2
    exit 2
}
[ "${1:-}" = --dry-run ] || usage
size=${2:-whole}
case $size in
whole | --quick | --sources) ;;
*) usage ;;
esac
[ $# -le 2 ] || usage

# shellcheck source=tools/setup.sh
. "$ROOT/tools/setup.sh"
set_up test
cd "$ROOT" || exit 5
PATH=$PATH:${CARGO_HOME:-$HOME/.cargo}/bin
python() { "$VENV/bin/python" "$@"; }
python -m pip install --quiet --require-hashes -r tools/lock/release.txt || exit 5

case $size in
whole) packages=dist ;;
--quick) packages=target/packages/quick ;;
--sources) packages=target/packages/source ;;
esac
failed=
passed=
stage() {
    name=$1
    shift
    printf '\n=== %s\n' "$name"
    if "$@"; then
        passed="$passed
    $name"
    else
        failed="$failed
    $name"
    fi
}

tests() { python -m pytest -q -p no:cacheprovider "$@"; }

citation() { python -m check_jsonschema --builtin-schema vendor.citation-file-format CITATION.cff; }

forms() {
    python -m check_jsonschema --builtin-schema vendor.github-issue-config .github/ISSUE_TEMPLATE/config.yml &&
        find .github/ISSUE_TEMPLATE -name '*.yml' ! -name config.yml -print0 |
        xargs -0 "$VENV/bin/python" -m check_jsonschema --builtin-schema vendor.github-issue-forms
}

workflows() {
    find .github/workflows -name '*.yml' -print0 |
        xargs -0 "$VENV/bin/python" -m check_jsonschema --builtin-schema vendor.github-workflows &&
        "$VENV/bin/zizmor" --offline --quiet .github/workflows
}

parts() {
    python tools/sbom.py "$packages/kempe.cdx.json" && python tools/sbom.py --check "$packages/kempe.cdx.json"
}

check_packages() {
    case $size in
    whole) tools/check_packages.sh ;;
    *) tools/check_packages.sh "--${size#--}" ;;
    esac
}

metadata() { find "$packages" \( -name '*.whl' -o -name '*.tar.gz' \) -exec "$VENV/bin/python" -m twine check --strict {} +; }

paths() { find "$packages" \( -name '*.whl' -o -name '*.tar.gz' \) -exec "$VENV/bin/python" tools/binary_paths.py {} +; }

sizes() { python tools/wheel_sizes.py "$packages"/*.whl; }

stage "versions agree" tests tests/house/test_versions.py tests/house/test_lock.py
stage "notices of all crates" tests tests/packages/test_notices.py
stage "promise: no unannounced change" tests tests/promise
stage "generated pages" tests tests/docs/test_docs.py -k "reference or index"
stage "CITATION.cff" citation
stage "issue forms" forms
stage "workflows" workflows
[ "$size" = whole ] && stage "./test full" ./test full
[ "$size" = --quick ] && stage "./test" ./test
[ "$size" = --sources ] && size=--source
stage "packages" check_packages
stage "metadata of the packages" metadata
stage "no path of this machine" paths
[ "$size" = whole ] && stage "sizes of the wheel" sizes # without optimisation, a core is larger
stage "list of parts (CycloneDX)" parts

printf '\n=== steps of a person\n'
python tools/release_state.py
state=$?
printf '\npassed:%s\n' "$passed"
if [ -n "$failed" ]; then
    printf 'failed:%s\n' "$failed"
    exit 1
fi
[ "$state" = 0 ] && echo "nothing is left but to sign and to publish; docs/internals/release.md"
exit "$state"
