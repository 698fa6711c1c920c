#!/usr/bin/env python3
"""libcourant holds and needs nothing of the programs around it: no symbol of courant_tools (decks from scenes), and nobody VTK.
The same look at the executable finds that it calls the former, so that it could find them here.

usage: library_alone.py BUILD_FOLDER
"""
import pathlib
import re
import subprocess
import sys

build = pathlib.Path(sys.argv[1])
NOBODY_NEEDS = re.compile(r"libvtk")


def output(*words):
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout


def strong(path):
    """Functions and data that this file alone defines: no templates, no inline functions, which any file may hold."""
    words = (line.split() for line in output("nm", "--extern-only", "--defined-only", path).splitlines())
    return {w[2] for w in words if len(w) == 3 and w[1] in "TDBR" and "7courant" in w[2]}


def all_of(path):
    """Also what the program hides."""
    return {line.split()[-1] for line in output("nm", "--defined-only", path).splitlines() if line.strip()}


def mentioned(path):
    return {line.split()[-1] for line in output("nm", "--dynamic", path).splitlines() if line.strip()}


def needed(path):
    return set(re.findall(r"\(NEEDED\).*\[(.*)\]", output("readelf", "--dynamic", path)))


library, program, tools = build / "libcourant.so", build / "courant", build / "libcourant_tools.a"
of_tools = strong(tools)
faults = [f"libcourant.so has or asks for {name}" for name in sorted(of_tools & mentioned(library))]
faults += [f"{path.name} needs {name}" for path in (library, program) for name in sorted(needed(path)) if NOBODY_NEEDS.search(name)]
if len(of_tools) < 20 or not of_tools & all_of(program):
    faults.append("courant_tools is not what the program is made of: is this look at the files still right?")
print("\n".join(faults) or f"libcourant.so has none of {len(of_tools)} functions of the programs around it")
sys.exit(1 if faults else 0)
