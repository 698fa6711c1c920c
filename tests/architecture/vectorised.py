#!/usr/bin/env python3
"""The pair loops are vectorised: asks the compiler's own report. g++ only; other compilers are skipped with a word.

usage: vectorised.py BUILD_FOLDER
"""
import json
import os
import re
import shlex
import subprocess
import sys

HOT = ["src/sph/continuity.cpp", "src/sph/momentum.cpp"]
build = sys.argv[1]
commands = json.load(open(os.path.join(build, "compile_commands.json")))
faults = []
for hot in HOT:
    entry = next(c for c in commands if c["file"].endswith(hot))
    words = shlex.split(entry["command"])
    version = subprocess.run([words[0], "--version"], capture_output=True, text=True).stdout
    if "clang" in version or "Free Software Foundation" not in version:
        print("skipped: only g++ gives this report")
        sys.exit(77)
    if not any(re.fullmatch(r"-O[23]", w) for w in words):
        print("skipped: this build is not optimised")
        sys.exit(77)
    words[words.index("-o") + 1] = os.devnull
    report = subprocess.run(words + ["-fopt-info-vec-optimized"], cwd=entry["directory"], capture_output=True, text=True)
    if report.returncode != 0:
        sys.exit(report.stderr)
    lines = open(entry["file"]).read().splitlines()
    loops = [n for n, text in enumerate(lines, 1) if "#pragma omp simd" in text]
    for loop in loops:
        # the report names the pragma's or the loop's own line, or one of the first lines of its body
        found = re.findall(rf"{re.escape(os.path.basename(hot))}:(\d+):\d+: optimized: loop vectorized using (\d+) byte", report.stderr)
        sizes = sorted({int(size) for line, size in found if loop <= int(line) <= loop + 3}, reverse=True)
        print(f"{hot}:{loop}: vectors of {sizes} bytes")
        if not sizes:
            faults.append(f"{hot}:{loop}: the loop is not vectorised")
    if not loops:
        faults.append(f"{hot}: has no simd loop any more; correct this test")
print("\n".join(faults))
sys.exit(1 if faults else 0)
