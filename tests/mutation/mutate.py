#!/usr/bin/env python3
"""Changes one thing at a time in the mechanics and looks whether a test fails.

    mutate.py BUILD [--files PATTERN ...] [--count N] [--seed S] [--programs NAME ...] [--seconds T]

A mutant is one operator, sign, constant or statement of a source file, changed at random. Its file is compiled apart and
linked before the libraries into each of the test programs, which are then run until the first failure; nothing in the
source tree or in BUILD is changed. Prints a line a mutant, those that no test noticed again at the end, and the part that
was caught. Mutants that do not compile, or that mean the same (there are some), are for the reader to judge.
"""

import argparse
import json
import pathlib
import random
import re
import shlex
import subprocess
import sys
import tempfile

default_files = [
    "ddacontact/contact/edge_motion.cpp",
    "ddacontact/contact/kinematics.cpp",
    "ddacontact/contact/rounded_motion.cpp",
    "ddacontact/contact/joint_law.cpp",
    "ddacontact/solver/spring_state.cpp",
    "ddacontact/solver/contact_solver.cpp",
    "ddacontact/solver/contact_sweeps.cpp",
    "ddacontact/solver/interior_point.cpp",
    "ddacontact/solver/bolt_law.cpp",
    "ddacontact/block/block_motion.cpp",
    "ddacontact/block/motion_shape.cpp",
    "ddacontact/time/energy_ledger.cpp",
    "ddacontact/time/energy_accounts.cpp",
    "ddacontact/time/motion_accounts.cpp",
    "ddacontact/time/impulse_problem.cpp",
]
# What is found in code, and what takes its place.
swaps = [
    (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "), (r" < ", " >= "), (r" > ", " <= "),
    (r" <= ", " < "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "), (r" && ", " || "), (r" \|\| ", " && "),
    (r" \+= ", " -= "), (r" -= ", " += "), (r"(?<=[(,=] )-(?=[\w(])", ""), (r"(?<=return )-(?=[\w(])", ""),
    (r"\bstd::max\(", "std::min("), (r"\bstd::min\(", "std::max("), (r"(?<=[(\[=*+/<> ,-])0\.5\b", "0.75"),
    (r"(?<![\w.])2(?![\w.])", "3"), (r"(?<![\w.])1(?![\w.])", "2"), (r"(?<![\w.])0(?![\w.])", "1"), (r"\btrue\b", "false"),
    (r"\bfalse\b", "true"),
]
statement = re.compile(r"^\s+[a-z_][\w.\[\]>()-]*( [-+*/]?= .*|\(.*\));$")


def mutants_of(text):
    """Of a file: (line number, its new text)."""
    for number, line in enumerate(text.split("\n")):
        code = line.split("//")[0]
        if code.lstrip().startswith(("#", "///", "constexpr", "template", "using", "assert(", "thread_local")) or '"' in code or "reshaped(" in code:
            continue
        for pattern, new in swaps:
            for match in re.finditer(pattern, code):
                yield number, line[: match.start()] + new + line[match.end():]
        if statement.match(code) and "return" not in code:
            yield number, re.match(r"\s*", line).group(0) + ";"


class Build:
    def __init__(self, build, programs):
        self.root = build
        commands = json.loads((build / "compile_commands.json").read_text())
        self.compile = {entry["file"]: entry for entry in commands}
        self.combined = {}  # of a file: the one that includes it with others, where files are combined
        for file in self.compile:
            if "/Unity/unity_" in file:
                for included in re.findall(r'#include "([^"]+)"', pathlib.Path(file).read_text()):
                    self.combined[included] = file
        self.links = {}
        for program in programs:
            lines = subprocess.run(["ninja", "-t", "commands", program], cwd=build, capture_output=True, text=True,
                                   check=True).stdout.splitlines()
            link = next(line for line in reversed(lines) if re.search(rf" -o \S*{program}\b", line))
            link = re.split(r" && ", link.removeprefix(": && "))[0]
            self.links[program] = link

    def compiled(self, source, text, scratch):
        """The object file of a changed source and those combined with it, None where it does not compile."""
        changed, made = scratch / "mutant.cpp", scratch / "mutant.o"
        changed.write_text(text)
        entry = str(source)
        if combined := self.combined.get(entry):
            entry, whole = combined, pathlib.Path(combined).read_text().replace(f'"{source}"', f'"{changed}"')
            changed = scratch / "combined.cpp"
            changed.write_text(whole)
        words = shlex.split(self.compile[entry]["command"])
        if pathlib.Path(words[0]).name == "ccache":
            words = words[1:]
        words[words.index("-o") + 1] = str(made)
        words[words.index("-c") + 1] = str(changed)
        done = subprocess.run(words, cwd=self.root, capture_output=True, check=False)
        return made if done.returncode == 0 else None

    def linked(self, program, made, scratch):
        words = shlex.split(self.links[program])
        at = words.index("-o")
        words[at + 1] = str(scratch / program)
        first_library = next(k for k, word in enumerate(words) if word.endswith((".a", ".so")))
        subprocess.run(words[:first_library] + [str(made)] + words[first_library:], cwd=self.root, check=True)
        return scratch / program


def fails(program, seconds):
    try:
        done = subprocess.run([program, "--gtest_fail_fast", "--gtest_brief=1"], capture_output=True, timeout=seconds,
                              check=False, env={"OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"})
        return done.returncode != 0
    except subprocess.TimeoutExpired:
        return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--files", nargs="+", default=default_files)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--programs", nargs="+", default=["ddacontact_tests", "hard_steps_tests"])
    parser.add_argument("--seconds", type=float, default=300, help="a program that runs longer counts as failed")
    options = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    build = Build(options.build.resolve(), options.programs)
    every = []
    for name in options.files:
        source = root / name
        text = source.read_text()
        every += [(source, text, number, line) for number, line in mutants_of(text)]
    random.Random(options.seed).shuffle(every)
    tried = caught = 0
    survivors = []
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        for source, text, number, line in every:
            if tried == options.count:
                break
            lines = text.split("\n")
            before, lines[number] = lines[number], line
            made = build.compiled(source, "\n".join(lines), scratch)
            if made is None:
                continue
            tried += 1
            found = next((p for p in options.programs if fails(build.linked(p, made, scratch), options.seconds)), None)
            caught += found is not None
            text_of = f"{source.relative_to(root)}:{number + 1}: {before.strip()}  ->  {line.strip()}"
            print(f"{tried}: {found or 'NOT NOTICED'}: {text_of}", flush=True)
            if found is None:
                survivors.append(text_of)
    print(f"{caught} of {tried} mutants are caught ({len(every)} are possible)")
    for text_of in survivors:
        print("not noticed:", text_of)
    sys.exit(0)


main()
