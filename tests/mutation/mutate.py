#!/usr/bin/env python3
"""Changes one thing at a time in the mechanics and looks whether a test fails.

    mutate.py BUILD [--files NAME ...] [--count N] [--seed S] [--programs NAME ...] [--seconds T] [--at-least P]

A mutant is one operator, sign, constant or statement of a source file or header, changed at random; statements over several
lines are not taken out. Its file is compiled apart and linked before everything else into each of the test programs, which
are then run until the first failure; nothing in the source tree or in BUILD is changed. Of a header the sources nearest to
it by includes are compiled, three at most: elsewhere it stays as it is. Prints a line a mutant, those that no test noticed
again at the end, and the part that was caught; a program that takes too long has caught one too. Mutants that do not compile
are passed over; those that mean the same (there are some) are for the reader to judge. The programs have to pass unchanged.
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
    "ddacontact/contact/joint_law.hpp",
    "ddacontact/solver/spring_state.cpp",
    "ddacontact/solver/contact_solver.cpp",
    "ddacontact/solver/contact_sweeps.cpp",
    "ddacontact/solver/interior_point.cpp",
    "ddacontact/equations/bolt_law.cpp",
    "ddacontact/solver/augmented_contacts.cpp",
    "ddacontact/solver/line_search.cpp",
    "ddacontact/solver/swept_step.cpp",
    "ddacontact/solver/contact_term.hpp",
    "ddacontact/solver/swept_contact.hpp",
    "ddacontact/classic/open_close.cpp",
    "ddacontact/classic/spring_law.cpp",
    "ddacontact/block/block_motion.cpp",
    "ddacontact/block/motion_shape.cpp",
    "ddacontact/block/step_start.hpp",
    "ddacontact/block/corotational_step.hpp",
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
most_sources = 3  # a header is compiled with
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
        cache = (build / "CMakeCache.txt").read_text()
        self.source = pathlib.Path(re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", cache, re.MULTILINE).group(1))
        self.libraries = {file: file.read_text() for file in sorted(self.source.glob("ddacontact/*/*.[ch]pp"))}
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

    def compiled(self, changed, text, scratch):
        """The object files of what a changed file is compiled in, empty where it does not compile."""
        copy = scratch / changed.relative_to(self.source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text)
        sources = {changed: copy} if changed.suffix == ".cpp" else {source: source for source in self.nearest(changed)}
        entries = {}  # of a unit of the build: its text, or that of those it combines
        for source, at in sources.items():
            unit = self.combined.get(str(source), str(source))
            now = entries.get(unit, pathlib.Path(unit).read_text() if unit != str(source) else f'#include "{source}"\n')
            entries[unit] = now.replace(f'"{source}"', f'"{at}"')
        made = []
        for number, (unit, whole) in enumerate(entries.items()):
            (scratch / f"unit_{number}.cpp").write_text(whole)
            made.append(scratch / f"unit_{number}.o")
            words = shlex.split(self.compile[unit]["command"])
            if pathlib.Path(words[0]).name == "ccache":
                words = words[1:]
            words[words.index("-o") + 1] = str(made[-1])
            words[words.index("-c") + 1] = str(scratch / f"unit_{number}.cpp")
            if "-include" in words:
                at = words.index("-include")
                if str(changed.relative_to(self.source)) in pathlib.Path(words[at + 1]).read_text():
                    del words[at : at + 2]  # precompiled with the header as it was
            words[1:1] = ["-I", str(scratch)]
            if subprocess.run(words, cwd=self.root, capture_output=True, check=False).returncode != 0:
                made = []
                break
        copy.unlink()
        return made

    def nearest(self, header):
        """The sources of the libraries that include a header by way of the fewest others."""
        found, seen, level = [], set(), [header]
        while level and len(found) < most_sources:
            names = [f"<{file.relative_to(self.source)}>" for file in level]
            level = [file for file, text in self.libraries.items() if file not in seen and any(n in text for n in names)]
            seen.update(level)
            found += [file for file in level if file.suffix == ".cpp"]
        return found[:most_sources]

    def linked(self, program, made, scratch):
        words = shlex.split(self.links[program])
        words[words.index("-o") + 1] = str(scratch / program)
        # First of all: of an inline function that was not inlined the first is taken.
        first = next(k for k, word in enumerate(words) if word.endswith((".o", ".a", ".so")) and words[k - 1] != "-o")
        subprocess.run(words[:first] + [str(file) for file in made] + words[first:], cwd=self.root, check=True)
        return scratch / program

    def unchanged(self, program):
        words = shlex.split(self.links[program])
        return self.root / words[words.index("-o") + 1]


def failure(program, seconds):
    """How a program fails, None: it passes."""
    try:
        done = subprocess.run([program, "--gtest_fail_fast", "--gtest_brief=1"], capture_output=True, timeout=seconds,
                              check=False, env={"OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"})
        return f"exit status {done.returncode}" if done.returncode != 0 else None
    except subprocess.TimeoutExpired:
        return f"more than {seconds:g} s"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--files", nargs="+", default=default_files)
    parser.add_argument("--count", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--programs", nargs="+", default=["ddacontact_tests", "hard_steps_tests"])
    parser.add_argument("--seconds", type=float, default=300, help="a program that runs longer counts as failed")
    parser.add_argument("--at-least", type=float, default=0, metavar="P", help="fails when fewer percent are caught")
    options = parser.parse_args()
    build = Build(options.build.resolve(), options.programs)
    for program in options.programs:
        if how := failure(build.unchanged(program), options.seconds):
            sys.exit(f"{program} does not pass unchanged: {how}")
    every = []
    for name in options.files:
        source = build.source / name
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
            if not made:
                continue
            tried += 1
            by = None
            for program in options.programs:
                if how := failure(build.linked(program, made, scratch), options.seconds):
                    by = f"{program}, {how}"
                    break
            caught += by is not None
            text_of = f"{source.relative_to(build.source)}:{number + 1}: {before.strip()}  ->  {line.strip()}"
            print(f"{tried}: {by or 'NOT NOTICED'}: {text_of}", flush=True)
            if by is None:
                survivors.append(text_of)
    print(f"{caught} of {tried} mutants are caught ({len(every)} are possible)")
    for text_of in survivors:
        print("not noticed:", text_of)
    sys.exit(100 * caught < options.at_least * tried)


main()
