#!/usr/bin/env python3
"""
Runs and evaluates the cases of Jonsson et al. (2016) and writes docs/hydraulic_jump_paper.md, docs/hydraulic_jump_standing.md and docs/hydraulic_jump_study.md.

usage: bash examples/hydraulic_jump/paper.sh [options]

  --jobs N          runs at a time (1): two runs on a thread each take less time than one after the other on two
  --threads N       threads of each run (all cores, shared among the jobs)
  --only NAME,...   these runs of paper_runs.yaml (d4,d5,d6,d10, d4_c1484, fr34, ...) and variants of study_runs.yaml (base, xsph, ...) alone
  --paper-setting   also the paper's speed of sound, 1484 m/s: one to two hours of processor time
  --standing        also standing jumps, Froude numbers 2.4 to 6.5
  --study           also the jump of d1/4 with each option and number of the deck changed in turn, several runs of each (study_runs.yaml):
                    docs/hydraulic_jump_study.md, error against run time
  --results FOLDER  where runs go (results/hydraulic_jump_paper)
  --page FILE       the page (docs/hydraulic_jump_paper.md); beside it go that of standing jumps, ..._standing.md, that of the study, ..._study.md, and figures/hydraulic_jump
  --quick           0.2 s instead of each run, to try the script: results/hydraulic_jump_quick, and the page in there

A complete run that is younger than its deck and the program is taken over. One that was stopped (Ctrl-C) or killed goes on from its
restart file. A run that fails is reported, the others go on. The pages show all runs that are complete in the folder; a call that runs
none of a page leaves it alone.
Exit code: 0 all is done, 1 a run or its evaluation failed, 2 the call was wrong, 130 interrupted.

"""
import pathlib
import sys

import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "lib"))
import paper_evaluate  # noqa: E402
import paper_page  # noqa: E402
import paper_study  # noqa: E402
from case_runs import Case, Program, carry_out, interruptible, named, read_options, say  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
SCENES = PROJECT / "keyword_decks" / "hydraulic_jump"
FIRST_GUESS = {"windows": 50, "eddy viscosity": 300, "others": 140}  # ns per particle and step on one thread, until a run has reported
QUICK = {"endtim": 0.2, "settled": [0.05, 0.2], "segment": 0.15}


class Run(Case):
    """One line of paper_runs.yaml, or a run of a line of study_runs.yaml."""

    def __init__(self, entry, results, quick):
        super().__init__({"segment": 1, "figures": False, "toe": 0, "variant": entry["name"]} | entry, results, SCENES)
        if quick:
            self.parameters["endtim"] = QUICK["endtim"]
            self.settled, self.segment = QUICK["settled"], QUICK["segment"]
        self.kind = "windows" if "*COURANT_PAIR_GEOMETRY" in self.cards else "eddy viscosity" if self.parameters.get("mixing", 0) > 0 else "others"


def choose(runs, options):
    if options.only:  # of a run, or of all runs of a variant
        return named(runs, options.only, lambda run: (run.name, run.variant), lambda run: run.variant)
    groups = {"paper", "supported", "better"} | {group for group in ("paper_setting", "standing", "study") if getattr(options, group)}
    return [run for run in runs if run.group in groups]


def main():
    options = read_options(__doc__, PROJECT, "hydraulic_jump", ("paper-setting", "standing", "study"))
    interruptible()
    table = yaml.safe_load((HERE / "paper_runs.yaml").read_text())
    options.results.mkdir(parents=True, exist_ok=True)
    entries = table["runs"] + paper_study.entries(yaml.safe_load((HERE / "study_runs.yaml").read_text()))
    runs = [Run(entry, options.results, options.quick) for entry in entries]
    chosen = choose(runs, options)
    program = Program(options.courant)
    return carry_out(chosen, program, options, FIRST_GUESS, lambda run: paper_evaluate.evaluate(run, program, SCENES, options.threads, say),
                     lambda: paper_page.write(options, runs, chosen, table["paper"], program, PROJECT))


if __name__ == "__main__":
    sys.exit(main())
