#!/usr/bin/env python3
"""The ```console blocks of the documents are true: their commands are run, their output compared. Lines that begin with
"$ " are commands, the others what they print; "..." stands for any lines. Usage: check_console.py PROGRAMS_FOLDER [slrender]

ANEMONE_DSO_PATH names the folder of the documents' plug-ins. The blocks of one document run one after the other in a copy of docs/tour. Without slrender, blocks that call it are
left out.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile

import tree


def transcripts(text):
    """(command, expected output) of each block of a document."""
    for block in re.findall(r"^```console\n(.*?)^```", text, re.M | re.S):
        for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
            command, _, expected = part.partition("\n")
            yield command, expected


def matches(expected, printed):
    pattern = ".*".join(re.escape(p) for p in expected.split("...\n"))
    return re.fullmatch(pattern, printed, re.S) is not None


def check(path, environment, renders):
    problems = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = os.path.join(scratch, "tour")
        shutil.copytree(os.path.join(tree.ROOT, "docs/tour"), folder)
        for command, expected in transcripts(tree.read(path)):
            if ("slrender" in command or "slfields" in command) and not renders:
                continue
            if not renders and ".png" in command:
                continue
            result = subprocess.run(command, shell=True, cwd=folder, env=environment, text=True, stdin=subprocess.DEVNULL,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            if not matches(expected, result.stdout):
                problems.append(f"{path}: '{command}' prints\n{result.stdout}instead of\n{expected}")
    return problems


def main():
    environment = dict(os.environ, PATH=sys.argv[1] + os.pathsep + os.environ["PATH"],
                       ANEMONE_DSO_PATH=sys.argv[1] + "/plugins")
    problems = []
    for path in tree.files(".md"):
        problems += check(path, environment, len(sys.argv) > 2)
    tree.finish(problems)


main()
