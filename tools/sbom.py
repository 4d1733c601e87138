"""Write the parts of kempe as a CycloneDX list: Python packages, Rust crates, npm packages.

    .venv/bin/python tools/sbom.py dist/kempe.cdx.json
    .venv/bin/python tools/sbom.py --check dist/kempe.cdx.json    validates it against the schema

The lock files are the only sources: tools/lock/run.txt, Cargo.lock, bindings/web/Cargo.lock and
studio/package-lock.json. So the same commit gives the same file, without a network. Parts that only
build kempe have the scope "excluded". `--check` needs tools/lock/release.txt.
"""

import argparse
import base64
import json
import re
import sys
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.10
    from pip._vendor import tomli as tomllib

ROOT = Path(__file__).resolve().parents[1]
SCHEMA = "1.6"
#: Cores of Python and of pages; `bindings/python/Cargo.toml` is in the first one.
CARGO_LOCKS = ("Cargo.lock", "bindings/web/Cargo.lock")
NPM_LOCK = "studio/package-lock.json"
PYTHON_LOCK = "tools/lock/run.txt"
#: Packages of the lock file that build kempe and do not run with it.
PYTHON_BUILD = {"maturin"}

Part = dict[str, Any]


def version() -> str:
    """The version of kempe."""
    text = (ROOT / "Cargo.toml").read_text("utf-8")
    return str(tomllib.loads(text)["workspace"]["package"]["version"])


def part(kind: str, name: str, number: str, *, built_in: bool, **more: Any) -> Part:
    """A component with its package URL, as https://github.com/package-url describes."""
    url = f"pkg:{kind}/{quote(name, safe='/')}@{quote(number)}"
    scope = "required" if built_in else "excluded"
    given = {key: value for key, value in more.items() if value}
    return {
        "type": "library",
        "bom-ref": url,
        "name": name,
        "version": number,
        "scope": scope,
        "purl": url,
        **given,
    }


def python_parts(text: str) -> Iterator[Part]:
    """The packages that run with kempe, with the condition under which each is installed."""
    for name, number, marker in re.findall(
        r"^([\w.-]+)==([\w.]+)(?: ; ([^\\\n]+?))? \\$", text, re.M
    ):
        condition = [{"name": "kempe:marker", "value": marker}] if marker else []
        built_in = name not in PYTHON_BUILD
        yield part("pypi", name, number, built_in=built_in, properties=condition)


def cargo_parts(text: str, linked: dict[tuple[str, str], str]) -> Iterator[Part]:
    """The crates of others with their checksums and, if linked, the licence that kempe takes."""
    for crate in tomllib.loads(text)["package"]:
        if "source" in crate:
            name, number = crate["name"], crate["version"]
            hashes = [{"alg": "SHA-256", "content": crate["checksum"]}]
            licence = linked.get((name, number))
            licences = [{"expression": licence}] if licence else []
            built_in = licence is not None
            yield part("cargo", name, number, built_in=built_in, hashes=hashes, licenses=licences)


def linked_crates() -> dict[tuple[str, str], str]:
    """The licence of each crate in the compiled cores, by name and version, from the notices."""
    text = (ROOT / "THIRD_PARTY_NOTICES.txt").read_text("utf-8")
    found = re.findall(r"^(\S+) (\S+) \((\S+)\)\n-+\n", text, re.M)
    return {(name, number): licence for name, number, licence in found}


def npm_parts(text: str) -> Iterator[Part]:
    """The npm packages with their checksums and licences."""
    for place, one in json.loads(text)["packages"].items():
        if not place:
            continue
        name = place.rpartition("node_modules/")[2]
        digest = base64.b64decode(one["integrity"].removeprefix("sha512-")).hex()
        yield part(
            "npm",
            name,
            one["version"],
            built_in=not one.get("dev", False),
            hashes=[{"alg": "SHA-512", "content": digest}],
            licenses=[{"expression": one["license"]}] if "license" in one else [],
        )


def unique(parts: Iterator[Part]) -> list[Part]:
    """The parts by their package URL; one that is built in anywhere is built in."""
    found: dict[str, Part] = {}
    for one in parts:
        if found.get(one["purl"], {}).get("scope") != "required":
            found[one["purl"]] = one
    return [found[url] for url in sorted(found)]


def all_parts() -> list[Part]:
    """All parts of kempe."""

    def parts() -> Iterator[Part]:
        yield from python_parts((ROOT / PYTHON_LOCK).read_text("utf-8"))
        for lock in CARGO_LOCKS:
            yield from cargo_parts((ROOT / lock).read_text("utf-8"), linked_crates())
        yield from npm_parts((ROOT / NPM_LOCK).read_text("utf-8"))

    return unique(parts())


def document() -> dict[str, Any]:
    """The whole list; its serial number follows from its content."""
    parts, kempe = all_parts(), f"pkg:pypi/kempe@{version()}"
    required = [one["bom-ref"] for one in parts if one["scope"] == "required"]
    serial = uuid.uuid5(uuid.NAMESPACE_URL, f"{kempe}\n" + json.dumps(parts))
    return {
        "$schema": f"http://cyclonedx.org/schema/bom-{SCHEMA}.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": SCHEMA,
        "serialNumber": f"urn:uuid:{serial}",
        "version": 1,
        "metadata": {
            "component": {
                "type": "library",
                "bom-ref": kempe,
                "name": "kempe",
                "version": version(),
                "purl": kempe,
                "licenses": [{"expression": "MIT OR Apache-2.0"}],
            }
        },
        "components": parts,
        "dependencies": [{"ref": kempe, "dependsOn": required}],
    }


def check(text: str) -> str | None:
    """What the schema of CycloneDX finds wrong; None if nothing."""
    from cyclonedx.schema import SchemaVersion
    from cyclonedx.validation.json import JsonStrictValidator

    found = JsonStrictValidator(SchemaVersion.from_version(SCHEMA)).validate_str(text)
    return str(found) if found else None


def main() -> None:
    """Write the list, or check one."""
    parser = argparse.ArgumentParser(description="The parts of kempe as a CycloneDX list.")
    parser.add_argument("--check", action="store_true", help="validate the file")
    parser.add_argument("path", type=Path)
    chosen = parser.parse_args()
    if chosen.check:
        wrong = check(chosen.path.read_text("utf-8"))
        sys.exit(f"{chosen.path}: {wrong}" if wrong else None)
    chosen.path.parent.mkdir(parents=True, exist_ok=True)
    chosen.path.write_text(json.dumps(document(), indent=1) + "\n", "utf-8", newline="\n")
    found = all_parts()
    built_in = sum(one["scope"] == "required" for one in found)
    print(f"{chosen.path}: {len(found)} parts, {built_in} of them in kempe or running with it")


if __name__ == "__main__":
    main()
