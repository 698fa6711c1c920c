#!/usr/bin/env python3
"""A deck written by another program's keyword library, PyDyna (`pip install ansys-dyna-core`), is read as it was meant.

usage: pydyna.py COURANT WORK_DIR
Skipped where the Python that runs this does not have the package.
"""
import os
import re
import subprocess
import sys

try:
    import pandas
    from ansys.dyna.core import Deck
    from ansys.dyna.core import keywords as kwd
except ImportError as missing:
    print(f"skipped: {missing}; `pip install ansys-dyna-core` provides it")
    sys.exit(77)

courant, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
spacing, count = 0.1, 4
points = [(i * spacing, j * spacing) for i in range(count) for j in range(count)]
ids = range(1, len(points) + 1)

deck = Deck()
deck.title = "written by PyDyna"
deck.append(kwd.Node(nodes=pandas.DataFrame({"nid": ids, "x": [x for x, _ in points], "y": [y for _, y in points], "z": 0.0})))
for i in ids:  # PyDyna writes one keyword per particle
    deck.append(kwd.ElementSph(nid=i, pid=1, mass=1000 * spacing**2))
part = kwd.Part()
part.parts = pandas.DataFrame({"heading": ["water"], "pid": [1], "secid": [1], "mid": [1], "eosid": [1]})
deck.append(part)
deck.append(kwd.SectionSph(secid=1, cslh=1.2, hmin=1.0, hmax=1.0))
deck.append(kwd.MatNull(mid=1, ro=1000.0, pc=-1.0e20))
deck.append(kwd.EosLinearPolynomial(eosid=1, c1=9.0e5))
deck.append(kwd.ControlTermination(endtim=0.01))
deck.append(kwd.DatabaseBinaryD3Plot(dt=0.005))
path = os.path.join(work, "pydyna.k")
with open(path, "w") as file:
    file.write(deck.write())

done = subprocess.run([courant, "check", path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
print(open(path).read(), done.stdout, done.stderr, sep="\n")
assert done.returncode == 0, f"courant check ended with exit code {done.returncode}"
assert "error" not in done.stderr, "the deck has errors"
row = re.search(r"^ +1 +16 +0 +(\S+) +(\S+) +(\S+) +(\S+)", done.stdout, re.M)
assert row, "part 1 has 16 particles and no shells"
mass, density, sound, h = map(float, row.groups())
assert abs(mass - 160) < 1e-9 and density == 1000 and abs(sound - 30) < 1e-9 and abs(h - 0.12) < 1e-9, row.groups()
