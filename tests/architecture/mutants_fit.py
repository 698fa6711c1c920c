#!/usr/bin/env python3
"""What every mutant of tests/verification/mutants.yaml replaces stands exactly once in its file.

usage: mutants_fit.py PROJECT_FOLDER
"""
import pathlib
import sys

import yaml

root = pathlib.Path(sys.argv[1])
faults = []
for mutant in yaml.safe_load((root / "tests/verification/mutants.yaml").read_text()):
    for place in [mutant, *mutant.get("also", [])]:
        count = (root / place["file"]).read_text().count(place["find"])
        if count != 1:
            faults.append(f"{mutant['name']}: '{place['find']}' stands {count} times in {place['file']}, not once")
print("\n".join(faults) or "all fit")
sys.exit(1 if faults else 0)
