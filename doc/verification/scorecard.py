"""Counts the checks of all verification pages, and keeps README's figures equal to those of their pages.

    scorecard.py ROOT           fails when scorecard.md or a figure of README.md is not what the pages say
    scorecard.py ROOT --write   renews both

A check is a table row "| statement | yes or **no** | value |". A figure of README.md stands between two comments, the first
of which names its page, the first cell of its row, and its column:

    <!-- from doc/benchmarks/dda.md: explicit steps, 1000 blocks #2 -->12.9 ms<!-- end -->
"""

import pathlib
import re
import sys

PAGES = ("dda", "mechanics", "blocks", "jointed_rock", "paper", "stability")
CHECK = re.compile(r"^\| (?P<statement>.*?) \| (?P<passes>yes|\*\*no\*\*) \| (?P<value>.*?) \|$", re.M)
SECTION = re.compile(r"^#+ (?:\d+\. )?(.*)$", re.M)
FIGURE = re.compile(r"(<!-- from (?P<page>\S+): (?P<row>.*?) #(?P<column>\d+) -->)(?P<text>.*?)(<!-- end -->)", re.S)


def checks(root):
    """(page, title, section, statement, passes, value) of every check."""
    for page in PAGES:
        text = (root / f"doc/verification/{page}.md").read_text()
        title = text.split("\n", 1)[0].removeprefix("# ")
        for check in CHECK.finditer(text):
            section = SECTION.findall(text[: check.start()])[-1]
            yield page, title, section, check["statement"], check["passes"] == "yes", check["value"]


def scorecard(root):
    """The page."""
    found = list(checks(root))
    passed = sum(check[4] for check in found)
    rows, failures = "", ""
    for page in PAGES:
        mine = [check for check in found if check[0] == page]
        good = sum(check[4] for check in mine)
        rows += f"| [{mine[0][1]}]({page}.md) | {len(mine)} | {good} | {len(mine) - good} |\n"
        failures += "".join(
            f"| [{page}]({page}.md): {section} | {statement} | {value} |\n"
            for _, _, section, statement, passes, value in mine
            if not passes
        )
    return f"""# Scorecard

Made by `python3 doc/verification/scorecard.py . --write` from the verification pages; a test fails when it differs from them.
**{passed} of {len(found)} checks pass; the {len(found) - passed} that fail are listed below.**

| page | checks | pass | fail |
|---|---:|---:|---:|
{rows}| **all pages** | **{len(found)}** | **{passed}** | **{len(found) - passed}** |

## Checks that fail

| page and section | requirement | value |
|---|---|---|
{failures}"""


def cell(root, page, row, column):
    """A cell, counted from 1, of the only row of a page that begins with `row`."""
    cells = [line.split(" | ") for line in (root / page).read_text().split("\n") if line.startswith("| ")]
    found = [line for line in cells if line[0].strip("| *") == row]
    if len(found) != 1:
        raise SystemExit(f"README.md: {page} has {len(found)} rows \"{row}\": name one of its rows")
    return found[0][column - 1].strip("|* ")


def readme(root):
    """README.md with the figures of the pages."""
    return FIGURE.sub(
        lambda figure: figure[1] + cell(root, figure["page"], figure["row"], int(figure["column"])) + figure[6],
        (root / "README.md").read_text(),
    )


def renew(path, text, write):
    """Whether the file is, or now is, as it should be."""
    if write:
        path.write_text(text)
    elif path.read_text() != text:
        print(f"{path}: differs from the verification pages; run doc/verification/scorecard.py . --write")
        return False
    return True


def main(root, write):
    good = renew(root / "doc/verification/scorecard.md", scorecard(root), write)
    return int(not (renew(root / "README.md", readme(root), write) and good))


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), "--write" in sys.argv))
