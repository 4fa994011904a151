#!/usr/bin/env python3
"""The rules of CONTRIBUTING.md that a program can check: sizes, head comments, what libraries may not do, leftovers."""
import os
import re

import tree

MAX_FILE, MAX_FUNCTION, MAX_CMAKE = 800, 80, 60
# Longer on purpose; each with its reason.
LONG_FUNCTIONS = {
    ("slvm/exec/interpreter.cpp", None): "the dispatch loop",
}
LIBRARIES = ("slc/", "slvm/", "render/", "stdlib/subsurface/", "stdlib/scattering/")
NOT_IN_LIBRARIES = r"std::(?:cout|cerr|clog)\b|(?<![\w:.>])(?:std::)?(?:printf|puts|putchar|exit|abort|terminate|_exit)\s*\("
LEFTOVERS = r"\b(?:TODO|FIXME|XXX|HACK|TBD)\b"
MACHINE_PATHS = r"(?<![\w./{}])/(?:work|home|root|mnt|Users)/\w+"
# RiErrorAbort ends the program: that is what it is for.
ENDING = "render/ri/errors.cpp"
CONTROL = r"(?:if|for|while|switch|else|do|try|catch|return|namespace|struct|class|enum|union|extern|case|default)\b"


def blank(text):
    """The text with comments, strings and character constants blanked, lines kept."""
    token = r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\''
    return re.sub(token, lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.S)


def functions(text):
    """(first line, lines, head) of every function body. Preprocessor lines are left out."""
    code = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: "\n" * m.group(0).count("\n"), blank(text), flags=re.M)
    scopes, head_begin = [], 0
    for m in re.finditer(r"[{};]", code):
        if m.group(0) == "{":
            head = code[head_begin:m.start()].strip()
            head = re.sub(r"^(?:public|private|protected):\s*", "", head)
            in_function = any(s[0] for s in scopes)
            is_function = not in_function and "(" in head and not re.match(CONTROL, head) and not re.search(r"=\s*$", head)
            scopes.append((is_function, code.count("\n", 0, m.start() - len(head)) + 1, head))
        elif m.group(0) == "}" and scopes:
            is_function, line, head = scopes.pop()
            if is_function:
                yield line, code.count("\n", 0, m.end()) + 2 - line, " ".join(head.split())
        head_begin = m.end()


def check_code(path, text, problems):
    lines = text.count("\n")
    if lines > MAX_FILE:
        problems.append(f"{path} has {lines} lines, more than {MAX_FILE}")
    for line, length, head in functions(text):
        exempt = any(path == p and (f is None or f in head) for p, f in LONG_FUNCTIONS)
        if length > MAX_FUNCTION and not exempt:
            problems.append(f"{path}:{line} has a function of {length} lines, more than {MAX_FUNCTION}: {head[:60]}")
    beside_header = path.endswith(".cpp") and os.path.exists(os.path.join(tree.ROOT, path[:-4] + ".h"))
    if not tree.head_comment(text) and not beside_header:
        problems.append(f"{path} does not begin with a comment that says what lives there")
    if path.endswith(".h"):
        # What Highway compiles once for each target is guarded by its own toggle.
        if text.count("#pragma once") != 1 and "HWY_TARGET_TOGGLE" not in text:
            problems.append(f"{path} needs one #pragma once")
        if re.search(r"^using namespace", text, re.M):
            problems.append(f"{path} has a using namespace at file scope")
    if path.startswith(LIBRARIES) and "/tools/" not in path and path != ENDING:
        for m in re.finditer(NOT_IN_LIBRARIES, blank(text)):
            problems.append(f"{path}:{text.count(chr(10), 0, m.start()) + 1} uses {m.group(0).strip()}: libraries report, mains decide")
    for m in re.finditer(r"^[ \t]*using namespace std;", text, re.M):
        problems.append(f"{path}:{text.count(chr(10), 0, m.start()) + 1} imports namespace std")


def main():
    problems = []
    code = set(tree.cpp_files())
    for path in tree.files():
        if path.endswith((".png", ".jpg", ".exr", ".tif", ".slo", ".pyc")) or "/corpus/" in path:
            continue
        text = tree.read(path)
        if path in code:
            check_code(path, text, problems)
        if path.endswith("CMakeLists.txt") and text.count("\n") > MAX_CMAKE:
            problems.append(f"{path} has {text.count(chr(10))} lines, more than {MAX_CMAKE}: helpers live in cmake/")
        if path == ".ci/check_style.py":
            continue
        for pattern, what in ((LEFTOVERS, "a leftover"), (MACHINE_PATHS, "a path of one machine")):
            for m in re.finditer(pattern, text):
                problems.append(f"{path}:{text.count(chr(10), 0, m.start()) + 1} has {what}: {m.group(0)}")
    tree.finish(problems)


main()
