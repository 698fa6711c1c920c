#!/usr/bin/env python3
"""What every mutant of tests/verification/mutants.yaml and tests/mutation/structures*.yaml replaces stands exactly once in its file.

usage: mutants_fit.py PROJECT_FOLDER
"""
import pathlib
import sys

import yaml

root = pathlib.Path(sys.argv[1])
verification = root / "tests" / "verification"
sys.path[:0] = [str(verification), str(root / "tests" / "mutation")]
sys.dont_write_bytecode = True
import mutants
import structures

every = yaml.safe_load((verification / "mutants.yaml").read_text())
faults = [f"{mutant['name']}: {fault}" for mutant in every for place in mutants.places(mutant) if (fault := mutants.misfit(place))]
faults += [f"{change['name']}: {fault}" for change in structures.declared() if (fault := structures.misfit(change, root))]
print("\n".join(faults) or "all fit")
sys.exit(1 if faults else 0)
