#!/usr/bin/env python3
"""Finds words that the field has a better term for, in code, comments, messages and pages.

    check_words.py ROOT

Only phrases that mean nothing else are listed: "floor" or "place" may be the right word. Generated pages of measurements
(doc/verification, doc/benchmarks) are left out; their texts come from programs, which are checked.
"""

import pathlib
import re
import sys

# What is found, as a regular expression without regard to case, and what to write.
terms = [
    (r"held[ _]unknowns?|HeldUnknowns?", "prescribed degree of freedom"),
    (r"held[ _]vert(ex|ices)(?= of a mesh)|HeldVertex", "fixed vertex"),
    (r"tried_\b", "trial step, trial contacts"),
    (r"borne blocks?", "supported block"),
    (r"\bforesees?n?\b|\bunforeseen\b", "predict, predicted"),
    (r"\brubs\b", "slides with friction"),
    (r"\b(goes|go|came|went) straight on\b", "is collinear"),
    (r"\bprobed?\b", "monitor"),
    (r"\bfollowing states\b", "active-set iteration"),
    (r"\bstages? [01]\b(?= (alone|follows|leads|gives|finds|goes))", "active-set iteration, interior-point method"),
    (r"\b(from inside (the|their|its|contacts)|interior paths?)\b", "interior-point method"),
    (r"\bviolent", "step with many active-set changes"),
    (r"\blocal steps?\b", "inertia-dominated step"),
    (r"\bobjections?\b|\w*objection\b", "reason for rejection"),
    (r"\bown residual\b", "block-relative residual"),
    (r"\bunsound\b|\bsoundness\b", "rank-deficient, indefinite or invalid"),
    (r"\bsofter side\b", "compliant side"),
    (r"\blook_at\w*", "evaluate"),
    (r"\bhangs? (on (the|a|its|their|how|what|where)\b|together)", "depends on; is connected"),
    (r"\b(is|are|be) let be\b", "is frozen, stays uncorrected"),
    (r"\bso and so often\b", "the number"),
    (r"\b(is|are|was|were|not) asked for\b", "requested"),
    (r"\bthe house\b", "source layout"),
    (r"\bstatements seen\b", "checks passed"),
]
patterns = [(re.compile(pattern, re.IGNORECASE), term) for pattern, term in terms]
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
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for pattern, term in patterns:
                for match in pattern.finditer(line):
                    print(f"{name}:{number}:{match.start() + 1}: '{match.group(0)}': say '{term}'")
                    found += 1
    sys.exit(f"{found} words that the field has better terms for" if found else 0)


main()
