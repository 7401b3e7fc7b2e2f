"""The program `dda` with the lines that a section of doc/extending.md adds, built from copies of the files that they change.

A line `// FILE, after: TEXT` or `// FILE, instead of: TEXT` begins each piece of code of the page; TEXT stands in one line of FILE. Only
what includes a changed file is compiled, without optimisation; the rest comes from the build directory.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

PROGRAM = "apps/dda"
PIECE = re.compile(r"^ *```cpp\n *// (?P<file>\S+), (?P<how>after|instead of): (?P<text>[^\n]*)\n(?P<code>.*?)^ *```$", re.M | re.S)


def expect(is_so, what):
    if not is_so:
        sys.exit("not so: " + what)


class ExtendedProgram:
    def __init__(self, root, build, scratch, section):
        self.root, self.build, self.scratch = (pathlib.Path(p).resolve() for p in (root, build, scratch))
        shutil.rmtree(self.scratch, ignore_errors=True)
        self.scratch.mkdir(parents=True)
        self.changed = self.change_copies(section)
        self.program = self.link(self.compile())

    def change_copies(self, section):
        """Puts the section's lines into copies of the files; their paths."""
        page = (self.root / "doc/extending.md").read_text()
        expect(f"## {section}\n" in page, f"doc/extending.md has the section \"{section}\"")
        page = page.split(f"## {section}\n")[1].split("\n## ")[0]
        pieces, changed = list(PIECE.finditer(page)), set()
        expect(0 < len(pieces) == page.count("```cpp"), "each piece of code says where it goes")
        for piece in pieces:
            copy = self.scratch / piece["file"]
            if piece["file"] not in changed:
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(self.root / piece["file"], copy)
                changed.add(piece["file"])
            source, text = copy.read_text(), piece["text"]
            expect(source.count(text) == 1, f'"{text}" stands once in {piece["file"]}')
            if piece["how"] == "after":
                end = source.index("\n", source.index(text)) + 1
                source = source[:end] + piece["code"] + source[end:]
            else:
                source = source.replace(text, piece["code"].strip())
            copy.write_text(source)
        return changed

    def ninja(self, *arguments):
        return subprocess.run(["ninja", "-C", self.build, *arguments], check=True, capture_output=True, text=True).stdout

    def objects(self):
        """Those of the program and its libraries that a changed file is part of."""
        of_program = set(self.ninja("-t", "inputs", PROGRAM).split())
        paths, name, found = {str(self.root / file) for file in self.changed}, None, set()
        for line in self.ninja("-t", "deps").splitlines():
            if line and not line.startswith(" "):
                name = line.split(":")[0]
            elif name in of_program and os.path.normpath(os.path.join(self.build, line.strip())) in paths:
                found.add(name)
        return found

    def compile(self):
        """Compiles them; the new objects by the old ones."""
        old = self.objects()
        jobs = {}
        for entry in json.loads((self.build / "compile_commands.json").read_text()):
            command = shlex.split(entry["command"])
            name = command[command.index("-o") + 1]
            if name in old:
                jobs[name] = self.job(command, name, pathlib.Path(entry["file"]))
        expect(len(jobs) == len(old), "each object has its command")
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for result in pool.map(self.run, [command for command, _ in jobs.values()]):
                expect(result.returncode == 0, "the changed files compile\n" + result.stderr)
        print(len(jobs), "objects compiled for", ", ".join(sorted(self.changed)))
        return {name: output for name, (_, output) in jobs.items()}

    def run(self, command):
        return subprocess.run(command, cwd=self.build, capture_output=True, text=True)

    def job(self, command, name, source):
        """The command that compiles the copy, or the file that combines it with others."""
        copy = self.scratch / os.path.relpath(source, self.root)
        if not copy.exists():
            text = source.read_text()
            for file in self.changed:
                text = text.replace(f'"{self.root / file}"', f'"{self.scratch / file}"')
            copy = self.scratch / (name.replace("/", "_") + ".cpp")
            copy.write_text(text)
        output = str(self.scratch / (name.replace("/", "_")))
        command[command.index("-o") + 1] = output
        command[command.index("-c") + 1] = str(copy)
        return [command[0], f"-I{self.scratch}", *command[1:], "-O0", "-w"], output

    def link(self, new):
        """The program from the new objects and the libraries of the build directory."""
        line = self.ninja("-t", "commands", "-s", PROGRAM)
        command = next(part for part in line.split(" && ") if f"-o {PROGRAM} " in part)
        words = [new.get(word, word) for word in shlex.split(command)]
        at = words.index("-o")
        program = str(self.scratch / "dda")
        words[at + 1] = program
        words[at:at] = [output for output in new.values() if output not in words]
        result = self.run(words)
        expect(result.returncode == 0, "the program links\n" + result.stderr)
        return program

    def __call__(self, *arguments, status=0):
        """What a call of the program prints."""
        result = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, cwd=self.scratch)
        text = result.stdout + result.stderr
        expect(result.returncode == status, f"dda {' '.join(map(str, arguments))} ends with {status}, not {result.returncode}: {text}")
        return text
