"""Adds the fields that doc/extending.md adds, and looks for them in what a run writes and in a picture.

    add_output_fields.py ROOT BUILD SCRATCH
"""

import csv
import json
import sys

from extended_program import ExtendedProgram, expect

dda = ExtendedProgram(*sys.argv[1:], "I want to add an output field")
dda("make", "arch", "-o", "arch.toml")
dda("run", "arch.toml", "-o", "out", "--steps", "3", "--quiet")
summary = json.loads((dda.scratch / "out/summary.json").read_text())
expect(summary["bolts"] == 0, "the summary has the number of bolts")
with open(dda.scratch / "out/blocks.csv") as file:
    masses = [float(row["mass"]) for row in csv.DictReader(file)]
expect(len(masses) == summary["blocks"] and min(masses) > 0, "each block has its mass")
dda("plot", "out", "--field", "size", "-o", "size.svg")
picture = (dda.scratch / "size.svg").read_text()
expect("size (" in picture, "the picture has the field in its legend")
frame = next((dda.scratch / "out/frames").glob("blocks*.vtu")).read_bytes()
expect(b'Name="size"' in frame, "the files of frames have it")
