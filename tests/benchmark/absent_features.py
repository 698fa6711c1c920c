#!/usr/bin/env python3
"""What a scene lacks costs it nothing: counts the instructions of steps of a bare scene, taken by `courant run`'s way and by a stepper
that is put together by hand from the passes that the scene needs. Times blur this by more than the one per cent that is allowed;
valgrind counts. How many instructions set-up takes is left out: the difference between many steps and few is looked at.
usage: absent_features.py FEATURE_COSTS
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

MOST = 1.01
FEW, MANY = 2, 66  # the guard looks every 64 steps: once among those that are counted


def instructions(program: str, way: str, steps: int, folder: pathlib.Path) -> int:
    command = ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder / 'out'}", program, "--steps", way, str(steps)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or not found:
        sys.exit(f"{' '.join(command)}\n{done.stderr}")
    return int(found.group(1))


def main() -> None:
    if not shutil.which("valgrind"):
        print("SKIPPED: valgrind is not there (Debian: valgrind)")
        sys.exit(77)
    counts = {}
    with tempfile.TemporaryDirectory() as folder:
        for way in ("simulation", "passes"):
            few, many = (instructions(sys.argv[1], way, steps, pathlib.Path(folder)) for steps in (FEW, MANY))
            counts[way] = (many - few) / (MANY - FEW)
            print(f"{way}: {counts[way] / 64 ** 2:.1f} instructions per particle and step")
    ratio = counts["simulation"] / counts["passes"]
    print(f"ratio {ratio:.5f}, at most {MOST}")
    sys.exit(0 if ratio <= MOST else 1)


main()
