"""Adds the key that doc/extending.md adds, and looks: read, checked, in effect, documented.

    add_a_scene_key.py ROOT BUILD SCRATCH
"""

import csv
import json
import sys

from extended_program import ExtendedProgram, expect

SCENE = """[analysis]
mode = "static"
steps = 5
time_step = 0.01
[[material]]
name = "rock"
density = 3000.0
young = "20 GPa"
poisson = 0.2
[[block]]
name = "stone"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[support]]
block = "stone"
vertices = [0, 1]
"""

dda = ExtendedProgram(*sys.argv[1:], "I want to add a scene key")
scene = dda.scratch / "stone.toml"
scene.write_text(SCENE)


def weight(*settings):
    dda("run", scene, "-o", "out", "--force", "--quiet", *settings)
    with open(dda.scratch / "out/supports.csv") as file:
        return sum(float(row["fy"]) for row in csv.DictReader(file))


ratio = weight("--set", "material.rock.void_ratio=0.5") / weight()
expect(abs(ratio - 1 / 1.5) < 1e-6, f"voids make the block lighter: {ratio}")
expect("void_ratio: a number, >= 0" in dda("help", "material"), "dda help has the key")
schema = json.loads(dda("schema"))["properties"]["material"]
expect("Volume of voids" in json.dumps(schema), "dda schema has the key")
expect("'void_ratio' = '-1'" in dda("check", scene, "--set", "material.rock.void_ratio=-1", status=2), "its bounds are checked")
both = dda("check", scene, "--set", "material.rock.void_ratio=0.5", "--set", "material.rock.unit_weight=2e4", status=2)
expect("'void_ratio' with 'unit_weight'" in both, "its own check is made")
