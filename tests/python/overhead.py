"""What a run through Python costs over one of the program, on this machine; by hand, where nothing else runs.

    PYTHONPATH=BUILD/python python3 overhead.py BUILD/apps/dda [ROUNDS]

Processor time and wall time of `dda run` and of `polydda.run`, without and with a callback, in turn, each in a process of its own; the least
of all rounds counts. Loading of libraries is in both: importing the module counts.
"""

import json
import os
import subprocess
import sys
import tempfile

RUN = """import json, sys, time
start = time.perf_counter(), time.process_time()
import polydda
callback = (lambda step: None) if sys.argv[3] == "callback" else None
polydda.run(sys.argv[1], sys.argv[2], on_step=callback, settings=[sys.argv[4]], force=True)
end = time.perf_counter(), time.process_time()
print(json.dumps([end[0] - start[0], end[1] - start[1]]))
"""
SETTING = "analysis.block_model=mean_value"


def by_program(dda, scene, out):
    before, start = os.times(), os.times().elapsed
    subprocess.run([dda, "run", scene, "--set", SETTING, "-o", out, "--force", "--quiet"], check=True, stderr=subprocess.DEVNULL)
    after = os.times()
    processor = after.children_user + after.children_system - before.children_user - before.children_system
    return after.elapsed - start, processor


def by_module(scene, out, callback):
    result = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", RUN, scene, out, callback, SETTING], check=True, capture_output=True, text=True
    )
    return json.loads(result.stdout)


def main(dda, rounds=10):
    with tempfile.TemporaryDirectory() as directory:
        scene, out = os.path.join(directory, "rock.toml"), os.path.join(directory, "out")
        subprocess.run([dda, "make", "joints", "-o", scene], check=True, stdout=subprocess.DEVNULL)
        program, module, with_callback = [], [], []
        for _ in range(int(rounds)):
            program.append(by_program(dda, scene, out))
            module.append(by_module(scene, out, ""))
            with_callback.append(by_module(scene, out, "callback"))
    for what, column in (("wall time", 0), ("processor time", 1)):
        base = min(row[column] for row in program)
        print(f"{what}: dda run {base:.3f} s", end="")
        for name, rows in (("polydda.run", module), ("with on_step", with_callback)):
            least = min(row[column] for row in rows)
            print(f", {name} {least:.3f} s ({100 * (least / base - 1):+.1f} %)", end="")
        print()


if __name__ == "__main__":
    main(*sys.argv[1:])
