"""The page of a large run in headless Chromium: its size, the time to its first picture, and frames a second; by hand.

    measure_page.py DDA DIRECTORY [COLUMNS ROWS STEPS]

A wall of COLUMNS x ROWS bricks in running bond under sudden gravity, a frame a step; by default 10 000 bricks and 101 frames. The page stays in
DIRECTORY. Aims: below 30 MB, 2 s, 30 frames a second. Frames a second are those that the browser showed, which other programs slow down; the
time that the page itself takes for a frame while it plays is the median of 60.
"""

import json
import os
import subprocess
import sys
import time

import chromium

SCENE = """title = "Bricks"
[analysis]
scheme = "explicit"
steps = {steps}
time_step = 1e-4
[[material]]
name = "brick"
density = 1800.0
young = "10 GPa"
poisson = 0.2
[[joint]]
friction_angle = 35.0
[[block]]
name = "base"
material = "brick"
fixed = true
vertices = [[-1, -1], [{width}, -1], [{width}, 0], [-1, 0]]
[[block]]
name = "brick"
material = "brick"
vertices = [[0, 0], [0.5, 0], [0.5, 0.2], [0, 0.2]]
grid = {{ count = [{columns}, {rows}], step = [0.5, 0.2], bond = 0.5 }}
"""


OWN_TIME = """(async () => {
  viewer.hurry(true);
  const gl = viewer.renderer.canvas.getContext('webgl2'), times = [];
  for (let k = 0; k < 60; ++k) {
    const start = performance.now();
    await viewer.show(k % viewer.run.nFrames);
    viewer.drawNow();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // until it is drawn
    times.push(performance.now() - start);
  }
  return times.sort((a, b) => a - b)[30];
})()"""


def main(dda, directory, columns=100, rows=100, steps=100):
    os.makedirs(directory, exist_ok=True)
    scene, result, path = (os.path.join(directory, name) for name in ("bricks.toml", "bricks-out", "bricks.html"))
    with open(scene, "w") as out:
        out.write(SCENE.format(columns=columns, rows=rows, steps=steps, width=0.5 * int(columns) + 2))
    subprocess.run([dda, "run", scene, "-o", result, "--force", "--quiet"], check=True)
    subprocess.run([dda, "view", result, "-o", path], check=True)
    with open(os.path.join(result, "summary.json")) as file:
        summary = json.load(file)
    with chromium.Page() as page:
        start = time.monotonic()
        page.open(path)
        page.wait_for("window.viewer && viewer.framesDrawn > 0")
        first = time.monotonic() - start
        page.value("(async () => { document.getElementById('speed').value = '60'; document.getElementById('loop').checked = true;"
                   " await viewer.show(0); viewer.play(); })()")
        time.sleep(3)  # until it knows its pace
        drawn, start = page.value("viewer.framesDrawn"), time.monotonic()
        time.sleep(5)
        rate = (page.value("viewer.framesDrawn") - drawn) / (time.monotonic() - start)
        page.value("viewer.pause()")
        own = page.value(OWN_TIME)
        n_frames = page.value("viewer.run.nFrames")
        errors = page.errors
    print(f"{summary['blocks']} blocks, {summary['contacts_end']} contacts, {n_frames} frames: {os.path.getsize(path) / 1e6:.1f} MB, "
          f"first picture after {first:.2f} s, {rate:.0f} frames a second, {own:.0f} ms of its own a frame")
    if errors:
        sys.exit("\n".join(errors))


if __name__ == "__main__":
    main(*sys.argv[1:])
