#!/usr/bin/env python3
"""Every built-in function of slvm/format/shadeops.def that works has a test: tests/shadeops/NAME.toml."""
import re

import tree


def main():
    rows = re.findall(r'^(SHADEOP|GRIDOP|RSLOP)\("([^"]+)", "[^"]*",(.*)$', tree.read("slvm/format/shadeops.def"), re.M)
    names = {name for _, name, rest in rows if "kInternal" not in rest}
    tests = {path.split("/")[-1][:-5] for path in tree.files(".toml") if path.startswith("tests/shadeops/")}
    problems = [f"tests/shadeops/{name}.toml is missing" for name in sorted(names - tests)]
    tree.finish(problems)


main()
