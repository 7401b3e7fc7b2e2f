"""A JSON validator with the schema of `dda schema` takes every scene of the examples, and no misspelt key of any table.

    schema.py DDA DIRECTORY_OF_EXAMPLES
"""

import copy
import json
import pathlib
import subprocess
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    sys.exit("skipped: python3-jsonschema is not installed")

BLOCK = {"material": "rock", "vertices": [[0, 0], [1, 0], [0, 1]]}
SCENE = {
    "initial_stress": {"level": "2 m", "stress": [0, -1e3, 0], "gradient": [0, "26 kPa/m", 0]},
    "parameters": {"phi": 30},
    "analysis": {"time_step": 0.01, "damping": {"mass": 1, "stiffness": "1 ms"}, "mesh": {"kind": "voronoi", "cells": 4}},
    "material": [{"name": "rock", "young": "10 GPa", "poisson": 0.2}],
    "joint": [{"friction_angle": "$phi"}],
    "block": [BLOCK | {"grid": {"count": [3, 2], "step": [1, 1], "bond": 0.5}, "mesh": {"cell_size": 0.1}}],
    "support": [{"block": {"at": [0.1, 0.1]}, "vertices": {"on": [[0, 0], [1, 0]]}}],
    "stage": [{"mode": "static", "steps": 3, "until": {"kinetic": 1e-8}, "joints": {"0": {"friction_angle": 20}}, "remove": [{"group": "core"}, 2]}],
}


def tables_of(value, path=()):
    """The inner tables of a scene, as paths from its root."""
    if isinstance(value, dict):
        yield path
        for key, inner in value.items():
            yield from tables_of(inner, (*path, key))
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from tables_of(inner, (*path, k))


def at(scene, path):
    for key in path:
        scene = scene[key]
    return scene


def main(dda, examples):
    schema = json.loads(subprocess.run([dda, "schema"], check=True, capture_output=True, text=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    wrong = []
    files = sorted(pathlib.Path(examples).rglob("*.toml"))
    for file in files:
        wrong += [f"{file}: {error.json_path}: {error.message}" for error in validator.iter_errors(tomllib.loads(file.read_text()))]
    wrong += [f"{error.json_path}: {error.message}" for error in validator.iter_errors(SCENE)]
    free = {("parameters",), ("stage", 0, "joints")}  # names of the user's own
    paths = [path for path in tables_of(SCENE) if path not in free]
    for path in paths:
        scene = copy.deepcopy(SCENE)
        at(scene, path)["misspelt"] = 1
        if validator.is_valid(scene):
            wrong.append(f"a misspelt key passes in {path}")
    print("\n".join(wrong) or f"{len(files)} scenes pass, and a misspelt key in none of {len(paths)} tables")
    return bool(wrong) or not files


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
