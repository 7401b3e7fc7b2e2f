"""Fails when results.md leaves out a key of summary.json, a column of a CSV file or an array of a frame that a run writes.

    check_results.py RESULTS.md DDA DIRECTORY
"""

import json
import pathlib
import re
import subprocess
import sys


def keys(value):
    """Of a JSON value, at any depth."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from keys(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from keys(inner)


def main(page, dda, directory):
    named = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`]*)`", pathlib.Path(page).read_text()))))
    directory = pathlib.Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    scene, out = directory / "tunnel.toml", directory / "out"
    subprocess.run([dda, "make", "tunnel", "-o", scene], check=True, stdout=subprocess.DEVNULL)
    scene.write_text(scene.read_text() + """
[[bolt]]
name = "roof"
points = [[18.9, 15.1], [18.4, 18.5]]
area = "4.9 cm2"
young = "200 GPa"
[[monitor]]
name = "bottom"
block = 0
at = "centroid"
""")
    settings = [f"--set={key}" for key in ("analysis.scheme=explicit", "analysis.block_model=mean_value", "analysis.time_step=1e-4",
                                           "stage.0.mode=dynamic", "stage.0.steps=2", "stage.1.mode=dynamic", "stage.1.steps=2",
                                           "stage.2.steps=2")]
    subprocess.run([dda, "run", scene, "-o", out, "--force", "--quiet", *settings], check=True, stderr=subprocess.DEVNULL)
    missing = [f"{key} of summary.json" for key in keys(json.loads((out / "summary.json").read_text())) if key not in named]
    for file in sorted(out.glob("*.csv")):
        with open(file) as lines:
            missing += [f"{column} of {file.name}" for column in lines.readline().strip().split(",") if column not in named]
    for file in sorted(out.glob("frames/*000000.vtu")):
        for section in re.findall(rb"<(?:Point|Cell)Data.*?</", file.read_bytes(), re.S):
            names = re.findall(rb'Name="(\w+)"', section)
            missing += [f"{name.decode()} of {file.name}" for name in names if name.decode() not in named]
    print("\n".join(dict.fromkeys(missing)))
    return len(missing)


sys.exit(main(*sys.argv[1:]))
