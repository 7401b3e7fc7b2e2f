"""Measures whole studies with the program and makes doc/benchmarks/studies.md anew:

    python3 doc/benchmarks/make_studies.py DDA

A quarter of an hour on two quiet cores. Each line is one command, run in an empty directory; its times are those of the clock and of the
processor, of the command and all that it starts.
"""

import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
CORES = len(os.sched_getaffinity(0))
MANY_BLOCKS = """format = 1
title = "Two joint sets"
[analysis]
time_step = 0.01
steps = 1
block_model = "affine"
[[material]]
name = "rock"
density = 2600
young = "10 GPa"
poisson = 0.25
[[joint]]
name = "joint"
friction_angle = 35
[domain]
boundary = [[0, 0], [320, 0], [320, 320], [0, 320]]
material = "rock"
[[domain.joint_set]]
joint = "joint"
angle = 20
spacing = 1
[[domain.joint_set]]
joint = "joint"
angle = -70
spacing = 1
"""


class Command:
    """A command that has ended: seconds, processor seconds, what it wrote; fails where the command does."""

    def __init__(self, dda, words):
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run([dda, *words.split()], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"dda {words}: status {done.returncode}\n{done.stderr}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.text = "dda " + words
        self.seconds = time.monotonic() - start
        self.processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.output = done.stdout + done.stderr

    def busy(self):
        """Of all cores, per cent."""
        return 100 * self.processor / self.seconds / CORES


def n_blocks(output):
    """The first number of blocks that an output names."""
    return int(re.search(r"(\d+) blocks", output).group(1))


def cutting(dda):
    with open("many.toml", "w") as out:
        out.write(MANY_BLOCKS)
    runs = [Command(dda, "cut many.toml -o many.wkt") for _ in range(5)]
    cut = sorted(runs, key=lambda run: run.seconds)[2]
    with open("many.wkt") as lines:
        number = sum(line.startswith("POLYGON") for line in lines)
    return [f"`{cut.text}`: {number} blocks cut from two joint sets, checked and written; median of five", "100 000 in 5 s", f"{cut.seconds:.1f} s",
            number >= 100000 and cut.seconds < 5]


def cutting_alone(dda):
    build = os.path.dirname(os.path.dirname(dda))
    said = subprocess.run([os.path.join(build, "tests", "performance", "cutting_performance")], capture_output=True, text=True, check=True).stdout
    seconds = float(re.search(r"in ([0-9.]+) s", said).group(1))
    return [f"`tests/performance/cutting_performance`: {n_blocks(said)} blocks cut from two joint sets, in the library alone; median of five",
            "100 000 in 5 s", f"{seconds:.1f} s", n_blocks(said) >= 100000 and seconds < 5]


def one_slope(dda):
    commands = [Command(dda, words) for words in ("make joints --spacing 2 -o rock.toml", "plot rock.toml -o rock.svg",
                                                  "safety rock.toml --tolerance 0.005 -o rock-safety")]
    with open("rock-safety/safety.json") as file:
        found = json.load(file)
    seconds = sum(command.seconds for command in commands)
    number = n_blocks(Command(dda, "check rock.toml").output)
    return [" ".join(f"`{command.text}`," for command in commands)[:-1] + f": a slope of {number} blocks, factor of safety "
            f"{found['factor_low']:.3f} .. {found['factor_high']:.3f} (tan 30°/tan 25° = 1.238)", "200 blocks in 120 s", f"{seconds:.0f} s",
            number >= 200 and seconds < 120]


def many_slopes(dda):
    Command(dda, "make joints --spacing 3.2 -o slope.toml")
    number = n_blocks(Command(dda, "check slope.toml").output)
    sweep = Command(dda, "sweep slope.toml --vary domain.seed=1..20 --safety --tolerance 0.02 -o slopes")
    return [f"`{sweep.text}`: 20 slopes of about {number} blocks, {sweep.seconds:.0f} s", f"{CORES} cores 90 % busy",
            f"{sweep.busy():.0f} %", sweep.busy() > 90]


def monte_carlo(dda):
    example = os.path.join(ROOT, "examples", "slope_two_sets.toml")
    with open("slope_two_sets.toml", "w") as out, open(example) as source:
        out.write(source.read())
    sweep = Command(dda, "sweep slope_two_sets.toml --vary domain.seed=1..200 --safety --tolerance 0.02 --set contact.corner_rounding=0 -o patterns")
    found = [line.strip() for line in sweep.output.splitlines() if "probability of failure" in line]
    return [f"`{sweep.text}`: 200 joint patterns, {sweep.seconds:.0f} s; {found[0] if found else 'no probability'}",
            f"{CORES} cores 90 % busy", f"{sweep.busy():.0f} %", sweep.busy() > 90]


def main(dda):
    dda = os.path.abspath(dda)
    with tempfile.TemporaryDirectory() as directory:
        os.chdir(directory)
        rows = [study(dda) for study in (cutting_alone, cutting, one_slope, many_slopes, monte_carlo)]
    with open(os.path.join(ROOT, "doc", "benchmarks", "studies.md"), "w") as page:
        page.write("# Studies\n\nWhole studies, each line one run of its commands in an empty directory; made by\n"
                   f"`python3 doc/benchmarks/make_studies.py DDA` on {CORES} cores. Times are of the clock; *busy* is the processor time of the "
                   "command and its processes over the time of\nall cores.\n\n| study | aim | measured | met |\n|---|---|---|---|\n")
        for study, aim, measured, met in rows:
            page.write(f"| {study} | {aim} | {measured} | {'yes' if met else '**no**'} |\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
