#!/usr/bin/env python3
"""Every path that a *.md file names exists: link targets, and words in backquotes that look like paths of this tree."""
import os
import re

import tree

TOP = ("slc", "slvm", "stdlib", "shaders", "render", "tests", "python", "docs", "cmake", ".ci")


def named_paths(text):
    text = re.sub(r"^```.*?^```|^    [^\n]*$", "", text, flags=re.M | re.S)  # code
    for target in re.findall(r"\]\(([^)#\s]+)", text):
        if "://" not in target:
            yield target
    for word in re.findall(r"`([^`\n]+)`", text):
        for part in word.split():
            is_path = re.fullmatch(r"[\w.\-]+(?:/[\w.\-]+)*/?", part) and part.split("/")[0] in TOP and "/" in part
            if is_path and not re.search(r"\b[A-Z]{3,}\b", part):  # NAME stands for any name
                yield part


def main():
    problems = []
    for path in tree.files(".md"):
        for name in named_paths(tree.read(path)):
            beside = os.path.join(tree.ROOT, os.path.dirname(path), name)
            if not os.path.exists(beside) and not os.path.exists(os.path.join(tree.ROOT, name)):
                problems.append(f"{path} names '{name}', which does not exist")
    tree.finish(problems)


main()
