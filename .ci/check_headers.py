#!/usr/bin/env python3
"""Every header compiles alone, with the flags of its folder. Headers that a source of the build includes before anything
else have shown it already. Usage: check_headers.py BUILD_FOLDER [JOBS]"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys

import tree


def flags_by_folder(build):
    """The compile command of one source for each folder, without output, input and optimisation."""
    flags = {}
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as f:
        for entry in json.load(f):
            path = os.path.relpath(entry["file"], tree.ROOT)
            if path.endswith(".c"):
                continue
            words = shlex.split(entry["command"])
            words = words[next(i for i, w in enumerate(words) if re.search(r"(\+\+|clang)[-\d.]*$", w)):]
            kept = [w for w in words if re.match(r"-[IDWf]|-std|-isystem", w) and not w.startswith("-fsanitize")]
            systems = [words[i + 1] for i, w in enumerate(words) if w == "-isystem"]
            kept = [w for w in kept if w != "-isystem"] + [x for s in systems for x in ("-isystem", s)]
            flags.setdefault(os.path.dirname(path), (words[0], kept))
    return flags


def shown_by_sources(build):
    """The headers that are the first include of a source that this build compiles."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as f:
        sources = [os.path.relpath(entry["file"], tree.ROOT) for entry in json.load(f)]
    own = (re.search(r'^#include ([<"])([^>"]+)', tree.read(s), re.MULTILINE) for s in sources if s.endswith(".cpp") and not s.startswith(".."))
    return {m.group(2) for m in own if m and m.group(1) == '"'}


def compile_alone(header, flags):
    folder = os.path.dirname(header)
    while folder and folder not in flags:
        folder = os.path.dirname(folder)
    below = [f for f in flags if f.startswith(os.path.dirname(header) + "/")]
    if not folder and not below:
        return None  # a part that this configuration leaves out
    compiler, options = flags[folder or below[0]]
    command = [compiler, *options, "-Wno-unused", "-fsyntax-only", "-x", "c++", "-"]
    result = subprocess.run(command, input=f'#include "{header}"\n', capture_output=True, text=True, cwd=tree.ROOT)
    return None if result.returncode == 0 else f"{header} does not compile alone:\n{result.stderr[:1500]}"


def main():
    flags = flags_by_folder(sys.argv[1])
    jobs = int(sys.argv[2]) if len(sys.argv) > 2 else os.cpu_count()
    shown = shown_by_sources(sys.argv[1])
    headers = [h for h in tree.cpp_files(".h") if h not in shown and "HWY_TARGET_TOGGLE" not in tree.read(h)]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        results = list(pool.map(lambda h: compile_alone(h, flags), headers))
    tree.finish([r for r in results if r])


main()
