#!/usr/bin/env python3
"""Every shader of shaders/ says what it is and what each of its parameters means, and has a test: a .toml beside it or, where it writes files, a
mention in tests/. Every scene of docs/gallery has a page, a picture on it, a place in docs/gallery.md and a golden.

Parameters of the standard shaders are those of the RISpec, which names them."""
import os
import re

import tree


def parameter_lines(text):
    """The lines between the parentheses of the shader, with their numbers."""
    head = re.search(r"^(?:surface|light|displacement|volume|imager)\s+\w+\s*\(", text, re.M)
    at, depth = head.end(), 1
    while depth:
        comment = re.compile(r"/\*.*?\*/", re.S).match(text, at)
        if comment:
            at = comment.end()
            continue
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        at += 1
    first = text.count("\n", 0, head.end()) + 1
    return list(enumerate(text[head.end():at - 1].split("\n"), first))


def shader_problems(path, tests):
    text = tree.read(path)
    name = path.split("/")[-1][:-3]
    if not text.startswith("/*"):
        yield f"{path}: does not begin with a comment that says what it is"
    if not os.path.exists(os.path.join(tree.ROOT, path[:-3] + ".toml")) and not re.search(rf"\b{name}\b", tests):
        yield f"{path}: has no test: {name}.toml is missing"
    if "/standard/" not in path:
        for number, line in parameter_lines(text):
            if line.strip() and "/*" not in line:
                yield f"{path}:{number}: parameters want a comment: what it is, its range, unit or space"


def scene_problems(name, index, goldens):
    page = f"docs/gallery/{name}.md"
    if not os.path.exists(os.path.join(tree.ROOT, page)):
        yield f"{page} is missing"
    elif f"({name}.jpg)" not in tree.read(page):
        yield f"{page} does not show {name}.jpg"
    if f"(gallery/{name}.md)" not in index:
        yield f"docs/gallery.md does not lead to {page}"
    if f'"{name}"' not in goldens:
        yield f"tests/gallery/scenes_test.cpp does not render {name}"


def main():
    problems = []
    tests = "\n".join(tree.read(p) for p in tree.files(".cpp", ".rib", ".toml", ".txt", ".py") if p.startswith("tests/"))
    for path in tree.files(".sl"):
        if path.startswith("shaders/"):
            problems += shader_problems(path, tests)
    index, goldens = tree.read("docs/gallery.md"), tree.read("tests/gallery/scenes_test.cpp")
    for path in tree.files("passes.toml"):
        if path.startswith("docs/gallery/"):
            problems += scene_problems(path.split("/")[2], index, goldens)
    tree.finish(problems)


main()
