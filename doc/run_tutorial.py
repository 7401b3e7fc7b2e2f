"""Does what a page says: writes its files, runs its commands and compares what they print.

    run_tutorial.py PAGE DDA SCRATCH

A block ```toml whose first line is "# FILE" is written to FILE; one with "# FILE, more" is added to it. In a block ```console
lines "$ ..." are run, and the lines below them must be printed in this order; "..." stands for any lines. A command goes on below
a line that ends with a backslash. The examples of the repository are in the folder "examples".
"""

import pathlib
import re
import shutil
import subprocess
import sys

BLOCK = re.compile(r"^```(toml|console)\n(.*?)^```$", re.M | re.S)


def write_file(scratch, text):
    head = text.split("\n", 1)[0]
    name = head.removeprefix("# ").removesuffix(", more")
    with (scratch / name).open("a" if head.endswith(", more") else "w") as file:
        file.write(text)


def pattern(lines):
    parts = [r"(.*\n)*?" if line == "..." else re.escape(line) + r"\n" for line in lines]
    return "".join(parts) + "$"


def run_commands(scratch, program, text):
    """The commands whose output is not what the page shows."""
    wrong = []
    for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
        command, *expected = re.sub(r"\\\n *", "", part).rstrip("\n").split("\n")
        call = command.replace("dda ", f"{program} ", 1)
        done = subprocess.run(call, shell=True, cwd=scratch, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if not re.match(pattern(expected), done.stdout):
            wrong.append(f"$ {command}\n{done.stdout}")
    return wrong


def main(page, program, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    (scratch / "examples").symlink_to(page.resolve().parent.parent / "examples")
    wrong = []
    for language, text in BLOCK.findall(page.read_text()):
        if language == "toml":
            write_file(scratch, text)
        else:
            wrong += run_commands(scratch, program, text)
    print("\n".join(wrong))
    return len(wrong)


if __name__ == "__main__":
    sys.exit(main(*map(pathlib.Path, sys.argv[1:])))
