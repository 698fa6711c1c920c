#!/usr/bin/env python3
"""Neither libcourant nor the program needs VTK, and the library holds nothing of the program's command line.

usage: library_alone.py BUILD_FOLDER
"""
import pathlib
import re
import subprocess
import sys

build = pathlib.Path(sys.argv[1])
NOBODY_NEEDS = re.compile(r"libvtk")
OF_PROGRAM = re.compile(r"command_line|become_python_program|write_manual")


def output(*words):
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout


def names(path, *options):
    return {line.split()[-1] for line in output("nm", *options, path).splitlines() if line.strip()}


def needed(path):
    return set(re.findall(r"\(NEEDED\).*\[(.*)\]", output("readelf", "--dynamic", path)))


library, program = build / "libcourant.so", build / "courant"
faults = [f"{path.name} needs {name}" for path in (library, program) for name in sorted(needed(path)) if NOBODY_NEEDS.search(name)]
faults += [f"libcourant.so has or asks for {name}" for name in sorted(names(library, "--dynamic")) if OF_PROGRAM.search(name)]
if not any(OF_PROGRAM.search(name) for name in names(program, "--defined-only")):
    faults.append("the program has no command line of its own: is this look at the files still right?")
print("\n".join(faults) or "libcourant.so has none of the functions of the program around it")
sys.exit(1 if faults else 0)
