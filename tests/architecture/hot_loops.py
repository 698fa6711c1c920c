#!/usr/bin/env python3
"""The hot loops are what they should be: each variant uses the vectors of its instruction set and no others, and nothing
that one of them compiles can replace the same function of another file. Loops over single particles are
vectorised by the compiler: its own report tells.

usage: hot_loops.py BUILD_FOLDER
"""
import glob
import json
import os
import re
import shlex
import subprocess
import sys

build = sys.argv[1]
project = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
commands = json.load(open(os.path.join(build, "compile_commands.json")))


def compiling(source):
    """The commands that compile a source file, alone or together with others in a file that CMake wrote."""
    def takes(file):
        return file.endswith(source) or ("/Unity/" in file and f'{source}"' in open(file).read())
    found = [c for c in commands if takes(c["file"])]
    return found or sys.exit(f"nothing compiles {source}; correct this test")


entry = compiling("/src/sph/core/time_limit.cpp")[0]
if not any(re.fullmatch(r"-O[23]", w) for w in shlex.split(entry["command"])):
    print("skipped: this build is not optimised")
    sys.exit(77)
faults = []


def run(*words, **options):
    return subprocess.run(words, capture_output=True, text=True, check=True, **options).stdout


REGISTERS = {"baseline": "xmm", "avx2": "ymm", "avx512": "zmm"}
objects = glob.glob(os.path.join(build, "CMakeFiles/hot_*.dir/**/*.o"), recursive=True)
if not objects:
    faults.append("no object files of hot loops; correct this test")
for path in sorted(objects):
    variant = re.search(r"hot_(\w+)\.dir", path).group(1)
    name = f"{variant} {os.path.basename(path)}"
    for line in run("nm", "-C", "--defined-only", path).splitlines():
        kind, symbol = re.match(r"[0-9a-f]* (\w) (.*)", line).groups()
        if kind not in "tTrRdDbBnN" and f"courant::{variant}::" not in symbol:
            faults.append(f"{name}: others could get its {symbol}")
    if os.uname().machine != "x86_64":
        continue
    code = run("objdump", "-d", "--no-show-raw-insn", path)
    wide = {r: len(re.findall(rf"%{r}\d", code)) for r in REGISTERS.values()}
    own = REGISTERS[variant]
    for register, count in wide.items():
        if count and register > own:
            faults.append(f"{name}: uses %{register}, which its processors lack")
    fused = len(re.findall(rf"vfn?m(?:add|sub)\d+pd.*%{own}", code)) if own != "xmm" else wide[own]
    print(f"{name}: {fused} {'fused operations' if own != 'xmm' else 'uses'} of %{own}")
    least = 30 if re.search(r"sph/\w+/(riemann|renormal|frozen|reduction|strength|pair_viscosity)_loops", path) else 200  # files of a few short loops
    if re.search(r"sph/\w+/\w+_loops", path) and fused < least:
        faults.append(f"{name}: the loops over pairs do not use %{own}")

# Loops over single particles
compiler = shlex.split(entry["command"])[0]
if "Free Software Foundation" in run(compiler, "--version"):
    for source in ["src/state/particle_loops.cpp", "src/sph/core/energy.cpp", "src/time/guard.cpp", "src/laws/eos/eos_linear_polynomial.cpp"]:
        where = "src/laws/eos/eos.hpp" if "eos" in source else source
        lines = open(os.path.join(project, where)).read().splitlines()
        wanted = r"for \(" if "_loops" in source else r"#pragma omp simd"
        for entry in compiling("/" + source):
            words = shlex.split(entry["command"])
            words[words.index("-o") + 1] = os.devnull
            words[words.index("-c") + 1] = project + "/" + source  # alone, where others are compiled with it
            report = subprocess.run(words + ["-fopt-info-vec-optimized"], cwd=entry["directory"], capture_output=True, text=True)
            if report.returncode != 0:
                sys.exit(report.stderr)
            found = {int(n) for n in re.findall(rf"{re.escape(os.path.basename(where))}:(\d+):\d+: optimized: loop vectorized",
                                                report.stderr)}
            for loop in [n for n, line in enumerate(lines, 1) if re.search(wanted, line)]:
                if not any(loop - 1 <= n <= loop + 3 for n in found):  # may be reported the pragma
                    faults.append(f"{where}:{loop}: the loop is not vectorised ({entry['command'].split(' -o ')[1].split()[0]})")
print("\n".join(faults))
sys.exit(1 if faults else 0)
