"""The files of the source tree, for the checks beside this one."""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def files(*endings):
    """Paths from the root of all source files with these endings (all files without), sorted."""
    found = []
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [d for d in folders if d == ".ci" or not (d.startswith(".") or d in ("build", "__pycache__"))]
        path = os.path.relpath(folder, ROOT)
        # .git is a file where the tree is a second one of its repository.
        found += [os.path.normpath(os.path.join(path, n)) for n in names if n != ".git" and (not endings or n.endswith(endings))]
    return sorted(found)


RSL_FOLDERS = ("tests/diagnostics/", "tests/language/", "tests/shadeops/", "stdlib/include/", "shaders/")


def cpp_files(*endings):
    """Those of our own C++; .h files in RSL_FOLDERS are shader source."""
    return [f for f in files(*(endings or (".h", ".cpp", ".inc"))) if f.endswith(".cpp") or not f.startswith(RSL_FOLDERS)]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8", errors="replace") as f:
        return f.read()


def head_comment(text):
    """The // lines with which a file begins."""
    return re.match(r"(?://[^\n]*\n)*", text).group(0)


def finish(problems):
    """Prints what is wrong and ends the program accordingly."""
    for problem in problems:
        print(problem)
    print(f"{len(problems)} problem(s)" if problems else "fine")
    sys.exit(1 if problems else 0)
