#!/usr/bin/env python3
"""Runs that stop in error, as a user meets them: exit code 2, reason and hint, and what is left on the disk.

usage: stops.py COURANT WORK_DIR
"""
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from checks import check, enter_empty_folder, failures

try:
    import h5py
except ImportError:
    h5py = None
    print("Python's h5py is not here: the content of history.h5 is not looked at")

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "stops")
enter_empty_folder(work)


def deck(name, *, modulus=9e5, pc=-1e20, start=0.0, termination="2.", timestep="0.,0.9", floor=-0.025, thickness=0.05, sfsa=10.0, more=""):
    """A square of water, 8 x 8 particles 0.1 apart, above a floor that pushes from half its thickness on."""
    nodes = [(0.05 + 0.1 * i, 0.05 + 0.1 * j) for j in range(8) for i in range(8)]
    text = "*KEYWORD\n*TITLE\n" + name + "\n*NODE\n"
    text += "".join(f"{k},{x:.3f},{y:.3f},0.\n" for k, (x, y) in enumerate(nodes, 1))
    text += f"9001,-9.,{floor},-2.\n9002,9.,{floor},-2.\n9003,9.,{floor},2.\n9004,-9.,{floor},2.\n"
    text += "*ELEMENT_SPH\n" + "".join(f"{k},1,10.\n" for k in range(1, 65))
    text += ("*ELEMENT_SHELL\n1,2,9001,9002,9003,9004\n*PART\nwater\n1,1,1,1,1\n*PART\nfloor\n2,2,2\n*SECTION_SPH\n1,1.2,1.,1.\n"
             f"*SECTION_SHELL\n2,2\n{thickness}\n*MAT_NULL\n1,1000.,{pc}\n*EOS_LINEAR_POLYNOMIAL\n1,0.,{modulus}\n*MAT_RIGID\n2,7850.,2.1E11,0.3\n"
             "1,7,7\n*HOURGLASS\n1,0,0,0,1.E-20,0.1\n*CONTROL_SPH\n1,0,1.E20,2\n*LOAD_BODY_Y\n1\n*DEFINE_CURVE\n1\n0.,9.81\n9.,9.81\n"
             f"*CONTACT_AUTOMATIC_NODES_TO_SURFACE\n1,2,3,3\n0.\n{sfsa}\n*CONTROL_TERMINATION\n{termination}\n*CONTROL_TIMESTEP\n{timestep}\n"
             f"*INITIAL_VELOCITY\n0\n0.,{start},0.\n*DATABASE_BINARY_D3PLOT\n0.01\n*DATABASE_GLSTAT\n0.01\n{more}*END\n")
    with open(name + ".k", "w") as file:
        file.write(text)


def stops(name, reason, hint, **settings):
    """The deck must stop by itself: reason, hint, exit code, and everything on the disk."""
    deck(name, **settings)
    done = subprocess.run([courant, "run", name + ".k", "-o", name, "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True, timeout=120)
    check(done.returncode == 2, f"{name} -> {done.returncode}")
    check(re.search(f"error: {reason}.*\n  hint: {hint}", done.stderr) is not None, f"{name}: {done.stderr.strip()[-400:]!r}")
    with open(f"{name}/summary.yaml") as file:
        text = file.read()
    check("\ntermination: error\n" in text and re.search(r"^advice: ", text, re.M) is not None and "\nranges:\n  - part: 1\n" in text,
          f"{name}: the summary has reason, advice and ranges")
    with open(f"{name}/messag") as file:
        said = file.read()
    check("*** Error: " in said and "hint: " in said and re.search(r" E r r o r    t e r m i n a t i o n +\S+ \S+\n$", said), f"{name}: messag says so")
    listed = [d.get("file") for d in ElementTree.parse(f"{name}/fields.pvd").iter("DataSet")]
    check(len(listed) >= 2 and not any("failed" in file for file in listed), f"{name}: {len(listed)} files of sound states are listed")
    for file in listed + ["fields/failed.vtp", "fields/failed_shells.vtu"]:
        path = f"{name}/{file}"
        if not os.path.exists(path) or not open(path, "rb").read().endswith(b"</VTKFile>\n"):
            check(False, f"{path} is whole")
    check(open(f"{name}/glstat").read().endswith("\n"), f"{name}/glstat ends with a whole line")
    if h5py:
        with h5py.File(f"{name}/history.h5") as file:
            total = file["global/total"][:]
            check(len(total) > 0 and bool((abs(total) < 1e30).all()), f"{name}/history.h5 has {len(total)} sound samples")


# --- each of them stops, none runs on
stops("unstable", "(density|the energy|particle)", r"TSSFAC = 3 of \*CONTROL_TIMESTEP", start=-20.0, timestep="0.,3.", sfsa=1e-3)
stops("within_wall", "(density|the energy|particle)", r"\d+ particles started within the contact distance of a wall", floor=0.0, thickness=0.5, sfsa=100.0, modulus=1e3)
stops("soft", r"particle \d+ of part 1 moved .* smoothing lengths in the step to time ", "gravity gives speeds of ", modulus=10.0)
stops("slow_step", r"the step size .* fell below DTMIN x first step = .*, set by sph \d+ of part 1", "", termination="2.,0,0.998")
stops("ratio", r"the energy ratio changed by .* %, more than ENDENG = 0.0001 %", "", termination="2.,0,0.,0.0001", start=-1.0)

# --- a run that ends well says nothing of the kind, and takes an older run's failed state away
deck("unstable")
done = subprocess.run([courant, "run", "unstable.k", "-o", "unstable", "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                      text=True, timeout=120)
check(done.returncode == 0 and "hint" not in done.stdout, f"a sound deck -> {done.returncode}")
check(not os.path.exists("unstable/fields/failed.vtp"), "the failed state of an older run is gone")
text = open("unstable/summary.yaml").read()
check("advice" not in text and "warning" not in text.replace("warnings:", ""), "no advice and no warning")
check("\nverdict: sound\n" in text and "\n verdict: sound\n" in done.stdout and " N o r m a l    t e r m i n a t i o n" in done.stdout, "its verdict is sound")

# --- one that reaches its end with particles below the floor: nobody takes it for a result
deck("leaks", sfsa=1.0, more="*COURANT_LITERAL_PENALTY\n0\n")
done = subprocess.run([courant, "run", "leaks.k", "-o", "leaks", "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                      text=True, timeout=120)
text = open("leaks/summary.yaml").read()
check(done.returncode == 2 and "\ntermination: normal\n" in text and "\nverdict: broken\n" in text, f"leaks -> {done.returncode}, verdict broken")
check(re.search(r"^leaked_particles: 6$", text, re.M) and text.count("6 particles leaked") == 2 and "6 particles leaked" in done.stdout, "for the particles that leaked")
check("cannot be trusted (verdict: broken)\n  6 particles leaked" in done.stderr and " E r r o r    t e r m i n a t i o n" in done.stdout, "and says so")
deck("leaks", sfsa=1.0, more="*COURANT_LITERAL_PENALTY\n0\n*COURANT_VERDICT\n,,0.05,0.1\n")
done = subprocess.run([courant, "run", "leaks.k", "-o", "leaks", "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                      text=True, timeout=120)
text = open("leaks/summary.yaml").read()
check(done.returncode == 0 and "\nverdict: doubtful\n" in text and "  leaks_broken: 0.1\n" in text, f"with limits of its own -> {done.returncode}, doubtful")
check(" verdict: doubtful by *COURANT_VERDICT (energy 0.01 and 0.1, leaks 0.05 and 0.1, " in done.stdout, "which are told")

# --- CPU time that is spent: the run has not come to its end, and can go on
deck("spent", more="*CONTROL_CPU\n0.001\n")
done = subprocess.run([courant, "run", "spent.k", "-o", "spent", "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                      text=True, timeout=120)
text = open("spent/summary.yaml").read()
check("\ntermination: interrupted\n" in text and "CPUTIM = 0.001 s of *CONTROL_CPU are spent" in text, "CPUTIM ends a run")
check(os.path.exists("spent/restart/d3dump01.h5") and "--restart spent/restart/d3dump01.h5" in text, "with a restart file")

# --- a liquid that is compressed far: it ends, with warnings that are counted
deck("compressed", start=-20.0, termination="0.1")
done = subprocess.run([courant, "run", "compressed.k", "-o", "compressed", "--threads", "1"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                      text=True, timeout=120)
text = open("compressed/summary.yaml").read()
check(done.returncode == 0 and "\nverdict: doubtful\n" in text and text.count("no longer nearly incompressible") == 4, f"compressed -> {done.returncode}, two reasons and warnings in the summary")
check(done.stdout.count("no longer nearly incompressible") == 2, "and in messag")

sys.exit(f"{len(failures)} failed" if failures else 0)
