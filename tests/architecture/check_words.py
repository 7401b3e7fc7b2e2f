#!/usr/bin/env python3
"""Finds words that the field has a better term for, in code, comments, messages and pages.

    check_words.py ROOT

Only phrases that mean nothing else are listed: "floor" or "place" may be the right word. Generated pages of measurements
(doc/verification, doc/benchmarks) are left out; their texts come from programs, which are checked.
"""

import pathlib
import re
import sys

# Letters that it always has (a file without them needs no closer look), a regular expression without regard to case, and what
# to write.
terms = [
    ("held", r"held[ _]unknowns?|HeldUnknowns?", "prescribed degree of freedom"),
    ("held", r"held[ _]vert(ex|ices)(?= of a mesh)|HeldVertex", "fixed vertex"),
    ("tried_", r"tried_\b", "trial step, trial contacts"),
    ("borne block", r"borne blocks?", "supported block"),
    ("orese", r"\bforesees?n?\b|\bunforeseen\b", "predict, predicted"),
    ("rubs", r"\brubs\b", "slides with friction"),
    ("straight on", r"\b(goes|go|came|went) straight on\b", "is collinear"),
    ("prob", r"\bprobed?\b", "monitor"),
    ("following states", r"\bfollowing states\b", "active-set iteration"),
    ("stage", r"\bstages? [01]\b(?= (alone|follows|leads|gives|finds|goes))", "active-set iteration, interior-point method"),
    ("from inside", r"\bfrom inside (the|their|its|contacts)\b", "interior-point method"),
    ("interior path", r"\binterior paths?\b", "interior-point method"),
    ("violent", r"\bviolent", "step with many active-set changes"),
    ("local step", r"\blocal steps?\b", "inertia-dominated step"),
    ("objection", r"\bobjections?\b|\w*objection\b", "reason for rejection"),
    ("own residual", r"\bown residual\b", "block-relative residual"),
    ("sound", r"\bunsound\b|\bsoundness\b", "rank-deficient, indefinite or invalid"),
    ("softer side", r"\bsofter side\b", "compliant side"),
    ("look_at", r"\blook_at\w*", "evaluate"),
    ("hang", r"\bhangs? (on (the|a|its|their|how|what|where)\b|together)", "depends on; is connected"),
    ("let be", r"\b(is|are|be) let be\b", "is frozen, stays uncorrected"),
    ("so and so often", r"\bso and so often\b", "the number"),
    ("asked for", r"\b(is|are|was|were|not) asked for\b", "requested"),
    ("the house", r"\bthe house\b", "source layout"),
    ("statements seen", r"\bstatements seen\b", "checks passed"),
    # Of identifiers.
    ("also_", r"\balso_\b", "forced contacts"),
    ("reach_", r"\breach_(scale|growth)_?|\bskin_of_reach\b", "search margin"),
    ("st_reach", r"\b(least|largest)_reach", "search margin"),
    ("straight_on", r"straight_on\b", "collinear"),
    ("objectionto", r"NoObjectionTo|\bObjectsTo\w*", "reject"),
]
patterns = [(key, re.compile(pattern, re.IGNORECASE), term) for key, pattern, term in terms]
kinds = {".cpp", ".hpp", ".ts", ".py", ".md", ".toml", ".txt", ".sh"}
generated = ("doc/verification/", "doc/benchmarks/")


def files(root):
    for folder in ("polyfem", "ddacontact", "apps", "examples", "tests", "doc"):
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            made = path.suffix == ".md" and name.startswith(generated)
            if path.suffix in kinds and not made and path.name != pathlib.Path(__file__).name:
                yield name, path
    yield "README.md", root / "README.md"


def main():
    root = pathlib.Path(sys.argv[1])
    found = 0
    for name, path in files(root):
        text = path.read_text(encoding="utf-8")
        small = text.lower()
        for key, pattern, term in patterns:
            for match in pattern.finditer(text) if key in small else ():
                line = text.count("\n", 0, match.start()) + 1
                column = match.start() - text.rfind("\n", 0, match.start())
                print(f"{name}:{line}:{column}: '{match.group(0)}': say '{term}'")
                found += 1
    sys.exit(f"{found} words that the field has better terms for" if found else 0)


main()
