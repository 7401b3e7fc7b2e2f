"""Counts the checks of all verification pages, and keeps figures of README and FAQ equal to those of their pages.

    scorecard.py ROOT           fails when scorecard.md or a figure of these pages is not what the pages say
    scorecard.py ROOT --write   renews them

A check is a table row "| statement | yes or **no** | value |". A figure stands between two comments, the first of which
names its page, the first cell of its row, and its column; "ten hours by" a time a step is the number of steps:

    <!-- from doc/benchmarks/dda.md: explicit steps, 1000 blocks #2 -->12.9 ms<!-- end -->
    <!-- ten hours by doc/benchmarks/dda.md: explicit steps, 1000 blocks #2 -->2 800 000<!-- end -->
"""

import pathlib
import re
import sys

PAGES = ("dda", "mechanics", "blocks", "jointed_rock", "paper", "stability")
CHECK = re.compile(r"^\| (?P<statement>.*?) \| (?P<passes>yes|\*\*no\*\*) \| (?P<value>.*?) \|$", re.M)
HEADING = re.compile(r"^#+ (.*)$", re.M)
FIGURE = re.compile(
    r"(?P<open><!-- (?P<what>from|ten hours by) (?P<page>\S+): (?P<row>.*?) #(?P<column>\d+) -->).*?<!-- end -->", re.S
)
WITH_FIGURES = ("README.md", "doc/faq.md")


def checks(root):
    """(page, title, heading, statement, passes, value) of every check; "The same" has the statement before in front of it."""
    for page in PAGES:
        text = (root / f"doc/verification/{page}.md").read_text()
        title = text.split("\n", 1)[0].removeprefix("# ")
        before = ""
        for check in CHECK.finditer(text):
            heading = HEADING.findall(text[: check.start()])[-1]
            statement = check["statement"]
            if statement.startswith("The same"):
                statement = f"{before} {statement}"
            else:
                before = statement
            yield page, title, heading, statement, check["passes"] == "yes", check["value"]


def link(page, heading):
    """To a heading of a page, without its number."""
    anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
    return f"[{page}: {re.sub(r'^[0-9]+[.] ', '', heading)}]({page}.md#{anchor})"


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
            f"| {link(page, heading)} | {statement} | {value} |\n"
            for _, _, heading, statement, passes, value in mine
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
        raise SystemExit(f"{page} has {len(found)} rows \"{row}\": name one of its rows")
    return found[0][column - 1].strip("|* ")


def steps_in_ten_hours(time):
    """The number of steps that take so long each, "12.9 ms" or "3.18 s", to two digits."""
    number, unit = time.split()
    steps = 36000 / (float(number) * {"us": 1e-6, "ms": 1e-3, "s": 1}[unit])
    return f"{float(f'{steps:.2g}'):,.0f}".replace(",", " ")


def with_figures(root, name):
    """A page with the figures of the pages that it quotes."""

    def renewed(figure):
        text = cell(root, figure["page"], figure["row"], int(figure["column"]))
        return figure["open"] + (text if figure["what"] == "from" else steps_in_ten_hours(text)) + "<!-- end -->"

    return FIGURE.sub(renewed, (root / name).read_text())


def renew(path, text, write):
    """Whether the file is, or now is, as it should be."""
    if write:
        path.write_text(text)
    elif path.read_text() != text:
        print(f"{path}: differs from the verification pages; run doc/verification/scorecard.py . --write")
        return False
    return True


def main(root, write):
    good = [renew(root / "doc/verification/scorecard.md", scorecard(root), write)]
    good += [renew(root / name, with_figures(root, name), write) for name in WITH_FIGURES]
    return int(not all(good))


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), "--write" in sys.argv))
