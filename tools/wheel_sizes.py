"""Print the parts of a wheel with their compressed sizes: `tools/wheel_sizes.py dist/*.whl`.

Exit code: 1 if a wheel exceeds the agreed size.
"""

import sys
import zipfile
from collections import Counter
from pathlib import Path

#: Agreed size of a wheel, bytes.
LARGEST = 12_000_000


def part_of(name: str) -> str:
    """The part of the wheel to which a file belongs."""
    if name.endswith((".so", ".pyd", ".dylib")):
        return f"core, {'every processor' if name.count('/') == 1 else 'AVX2 and FMA'}"
    pieces = name.split("/")
    if pieces[0] != "kempe":
        return "licences, metadata"
    return f"kempe/{pieces[1]}" if len(pieces) > 2 else "kempe/*.py"


def sizes(path: Path) -> Counter[str]:
    """Compressed bytes of each part."""
    found: Counter[str] = Counter()
    with zipfile.ZipFile(path) as wheel:
        for one in wheel.infolist():
            found[part_of(one.filename)] += one.compress_size
    return found


def main(paths: list[str]) -> int:
    """Print a table for each wheel."""
    code = 0
    for path in map(Path, paths):
        whole = path.stat().st_size
        print(f"{path.name}: {whole / 1e6:.2f} MB")
        for part, size in sizes(path).most_common():
            print(f"  {part:28} {size / 1e3:9.1f} kB")
        if whole > LARGEST:
            print(f"  larger than {LARGEST / 1e6:.0f} MB")
            code = 1
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
