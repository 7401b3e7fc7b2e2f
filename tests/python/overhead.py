"""What a run through Python costs over one of the program, on this machine; by hand, where nothing else runs.

    PYTHONPATH=BUILD/python python3 overhead.py BUILD/apps/dda [ROUNDS]

`dda run` and `polydda.run`, without and with a callback, in turn, each in a process of its own. Two figures of each:
- outside the run: wall time of the process less that of the run in summary.json. Python's start and the import are in it;
- the run: wall time in summary.json over that of the program in the same round. It is the same code in both but for the callback.
Medians of all rounds, with quartiles.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

RUN = """import sys
import polydda
callback = (lambda step: None) if sys.argv[3] == "callback" else None
polydda.run(sys.argv[1], sys.argv[2], on_step=callback, settings=sys.argv[4:], force=True)
"""
SETTINGS = ["analysis.block_model=mean_value", "stage.motion.steps=400"]


def times_of(command, out):
    """Wall time in the run and outside of it, s."""
    start = time.perf_counter()
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    all_of_it = time.perf_counter() - start
    with open(os.path.join(out, "summary.json")) as file:
        inside = json.load(file)["wall_seconds"]["total"]
    return inside, all_of_it - inside


def main(dda, rounds=10):
    with tempfile.TemporaryDirectory() as directory:
        scene, out = os.path.join(directory, "rock.toml"), os.path.join(directory, "out")
        subprocess.run([dda, "make", "joints", "-o", scene], check=True, stdout=subprocess.DEVNULL)
        options = [word for setting in SETTINGS for word in ("--set", setting)]
        python = [sys.executable, "-W", "ignore", "-c", RUN, scene, out]
        commands = {
            "dda run": [dda, "run", scene, *options, "-o", out, "--force", "--quiet"],
            "polydda.run": [*python, "", *SETTINGS],
            "polydda.run with on_step": [*python, "callback", *SETTINGS],
        }
        times = {name: [] for name in commands}
        for _ in range(int(rounds)):
            for name, command in commands.items():
                times[name].append(times_of(command, out))
    program = times["dda run"]
    run = statistics.median(inside for inside, _ in program)
    least = statistics.median(outside for _, outside in program)
    print(f"dda run: {run:.2f} s, outside of it {least:.3f} s")
    for name, rows in list(times.items())[1:]:
        outside = statistics.median(outside for _, outside in rows) - least
        ratios = [100 * (inside / base - 1) for (inside, _), (base, _) in zip(rows, program)]
        low, middle, high = statistics.quantiles(ratios, n=4)
        print(f"{name}: outside {outside:+.3f} s, {100 * outside / run:.1f} % of the run; the run {middle:+.1f} % ({low:+.1f} .. {high:+.1f})")


if __name__ == "__main__":
    main(*sys.argv[1:])
