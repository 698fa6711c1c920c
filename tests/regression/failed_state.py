#!/usr/bin/env python3
"""The state that a stop in error leaves shows the forces at the stop, with the same bits in a run that was restarted on its way there.

usage: failed_state.py COURANT WORK_DIR
"""
import os
import shutil
import subprocess
import sys

from checks import check, enter_empty_folder, failures

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "failed_state")
enter_empty_folder(work)
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src", "python"))
from pathlib import Path  # noqa: E402

from courant.diagnostics import Diagnostics  # noqa: E402
from courant.fields import open_field  # noqa: E402

# A frame of beams that a heavy node folds up until its ends have turned too far.
DECK = """*KEYWORD
*NODE
1,0.,0.,0.
2,0.,0.,.25
3,0.,0.,.5
4,.25,0.,.5
5,.5,0.,.5
50,.3,.4,.2
51,.1,.7,.9
*ELEMENT_BEAM
1,1,1,2,50
2,1,2,3,50
3,1,3,4,51
4,1,4,5,51
*PART
b
1,1,1
*SECTION_BEAM
1,1,.8333,3,0
.04,.04,.02,.02
*MAT_PIECEWISE_LINEAR_PLASTICITY
1,7850.,2.1e11,.3,2.e8,1.e9,1e21



*SET_NODE_LIST
7
1
*BOUNDARY_SPC_SET
7,0,1,1,1,1,1,1
*ELEMENT_MASS
1,5,20.
*INITIAL_VELOCITY_NODE
5,30.,-80.,20.
*CONTROL_TERMINATION
0.1
*DATABASE_GLSTAT
0.01
*DATABASE_BINARY_D3PLOT
{plot}
*DATABASE_BINARY_RUNRSF
60,9
*END
"""
name = "fields/failed_solids.vtu"
with open("frame.k", "w") as file:
    file.write(DECK.format(plot=0.05))


def run(*words):
    return subprocess.run([courant, "run", "frame.k", "--quiet", "--threads", "1", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          timeout=120)


done = run("-o", "whole")
check(done.returncode == 2 and "turned by more than" in done.stdout, f"the frame folds up: {done.stdout[-300:]}")
data = open_field(Path("whole", name), Diagnostics())
assert data is not None
moments = data.values("CellData", "moment_at_end_1", 5)  # four beams and a mass
check(abs(moments).max() > 10, f"the moments at the stop are shown: {abs(moments).max()}")  # 2e8 Pa x 0.04^3 m^3 / 4 = 3200 N m carries the section
shutil.copytree("whole", "again")  # where the run goes on with its files
done = run("-o", "again", "--restart", "again/restart/runrsf01.h5")
check(done.returncode == 2 and Path("whole", name).read_bytes() == Path("again", name).read_bytes(), f"a restarted run leaves the same bytes: {done.stdout[-200:]}")
sys.exit(1 if failures else 0)
