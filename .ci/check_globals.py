#!/usr/bin/env python3
"""No mutable globals: nm finds no variable of ours in the data sections of our archives. Usage: check_globals.py ARCHIVE...

State hangs on slc::Compiler, slvm::Machine, render::Renderer. What the compiler places in data sections although it
never changes after its initialisation is listed here with the reason.
"""
import re
import subprocess
import sys

import tree

UNCHANGING = [
    (r"HighwayDispatchTable|HighwayChosenTarget|DispatchTable", "Highway's table of targets"),
    (r"^guard variable for ", "belongs to a constant that is made on first use"),
    (r"::\(anonymous namespace\)::k[A-Z]\w*$|::k[A-Z]\w*$", "a constant with pointers in it, or made on first use"),
    (r"^(?:std|boost|fmt|hwy|tbb|flatbuffers|__gnu)|^_ZTI|^typeinfo|^vtable|^VTT|^DW\.ref|\bboost::", "not ours"),
    (r"::crash_point$", "where a signal handler, which gets no argument, finds its thread's way back"),
    (r"^RI_[A-Z]+$|^Ri\w+Basis$|^RiLastError$", "variables that ri.h declares, as the RISpec has them"),
    (r"render::ri::.*process\(\)::state$", "what the functions of ri.h, being C, share"),
    (r"^anemone_all_kept$", "strings that a plug-in keeps; empty in the host, which includes the same header"),
    (r"::wave_mutex$", "guards what Boost.Wave asks of the C library"),
    (r"^__(?:sancov|asan|ubsan|tsan|odr)|^\.L|^\$", "made by the compiler"),
]


def main():
    problems = []
    for archive in sys.argv[1:]:
        listing = subprocess.run(["nm", "-C", archive], capture_output=True, text=True, check=True).stdout
        for kind, name in re.findall(r"^[0-9a-f]+ ([BbDdGgSsCu]) (.+)$", listing, re.M):
            if not any(re.search(pattern, name) for pattern, _ in UNCHANGING):
                problems.append(f"{archive.split('/')[-1]}: {name} ({kind})")
    tree.finish(problems)


main()
