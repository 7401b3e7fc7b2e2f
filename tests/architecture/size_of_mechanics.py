"""Counts the mechanics: lines of statements, assertions and includes left out, and numbers other than 0, 1, 2 and 1/2 in them, each of which somebody
chose. Fails when either has grown; what made it smaller lowers the limit, and only a wrong answer that is mended raises it.

    size_of_mechanics.py ROOT          prints both
    size_of_mechanics.py ROOT --list   and every such number with its line
"""

import pathlib
import re
import sys

FOLDERS = ("block", "classic", "contact", "detection", "equations", "solver", "time")
MOST_LINES = 12475
MOST_NUMBERS = 117

NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?)(?![\w.])")
USUAL = (0, 1, 2, 0.5)


def without_text(source):
    """The source without strings and comments."""
    source = re.sub(r'"(\\.|[^"\\])*"', '""', source)
    source = re.sub(r"(?<=\d)'(?=\d)", "", source)
    source = re.sub(r"'(\\.|[^'\\])'", "' '", source)
    return re.sub(r"//.*", "", source)


def without_assertions_and_includes(source):
    return re.sub(r"\bassert\([^;]*\);|#include <.*>", lambda found: "\n" * found.group(0).count("\n"), source)


def statements(root):
    mechanics = root / "ddacontact"
    paths = [path for folder in FOLDERS for path in sorted((mechanics / folder).glob("*.?pp"))]
    for path in [*paths, mechanics / "core" / "tolerances.hpp"]:
        source = without_assertions_and_includes(without_text(path.read_text()))
        for number, line in enumerate(source.split("\n"), 1):
            if line.strip():
                yield path.relative_to(root), number, line.strip()


def main(root, listing):
    lines = list(statements(root))
    chosen = [
        (path, number, found, line)
        for path, number, line in lines
        if not line.startswith("#")
        for found in NUMBER.findall(line)
        if float(found) not in USUAL
    ]
    if listing:
        for path, number, found, line in chosen:
            print(f"{path}:{number}: {found}: {line}")
    print(f"{len(lines)} lines (at most {MOST_LINES}), {len(chosen)} numbers (at most {MOST_NUMBERS})")
    return int(len(lines) > MOST_LINES or len(chosen) > MOST_NUMBERS)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), "--list" in sys.argv))
