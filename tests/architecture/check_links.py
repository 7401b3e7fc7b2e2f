"""Fails when a link between pages of the repository leads to no file or no heading:  check_links.py ROOT"""

import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\((?!https?:)([^)#\s]*)(?:#([^)]*))?\)")
HEADING = re.compile(r"^#+ (.*)$", re.M)


def without_code(text):
    return re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.S)


def anchors(page):
    """What links call its headings."""
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
    headings = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading) for heading in HEADING.findall(text))
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


def broken(root):
    for page in [root / "README.md", *(root / "doc").rglob("*.md")]:
        for path, anchor in LINK.findall(without_code(page.read_text())):
            to = page.parent / path if path else page
            if not to.exists():
                yield f"{page.relative_to(root)}: {path} is not there"
            elif anchor and to.suffix == ".md" and anchor not in anchors(to):
                yield f"{page.relative_to(root)}: {path} has no heading #{anchor}"


if __name__ == "__main__":
    found = list(broken(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(len(found))
