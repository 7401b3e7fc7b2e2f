"""Fails when a relative link of a page of the repository leads nowhere:  check_links.py ROOT"""

import pathlib
import re
import sys

LINK = re.compile(r"\[[^\]]*\]\((?!https?:|#)([^)#\s]+)(#[^)]*)?\)")


def broken(root):
    for page in [root / "README.md", *(root / "doc").rglob("*.md")]:
        text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(), flags=re.S)
        for link in LINK.finditer(text):
            if not (page.parent / link[1]).exists():
                yield f"{page.relative_to(root)}: {link[1]} is not there"


if __name__ == "__main__":
    found = list(broken(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(len(found))
