#!/usr/bin/env python3
"""What every mutant of tests/verification/mutants.yaml replaces stands exactly once in its file.

usage: mutants_fit.py PROJECT_FOLDER
"""
import pathlib
import sys

import yaml

verification = pathlib.Path(sys.argv[1]) / "tests" / "verification"
sys.path.insert(0, str(verification))
sys.dont_write_bytecode = True
import mutants

every = yaml.safe_load((verification / "mutants.yaml").read_text())
faults = [f"{mutant['name']}: {fault}" for mutant in every for place in mutants.places(mutant) if (fault := mutants.misfit(place))]
print("\n".join(faults) or "all fit")
sys.exit(1 if faults else 0)
