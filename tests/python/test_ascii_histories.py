"""ASCII histories: pieces in the layouts of Courant and LS-DYNA, written by hand; the numbers are made up."""

from __future__ import annotations

import math

import numpy as np
import pytest
from courant.ascii_histories import AsciiFile, AsciiKey
from courant.ascii_kinds import Text
from courant.diagnostics import Diagnostics

HEAD = " a title\n                    ls-dyna smp d R16 R16.1_180 date 07/09/2025\n"


class Read:
    """A file that is read; messages without the folder's name."""

    def __init__(self, folder, text: str | bytes):
        path = folder / "file"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        diagnostics = Diagnostics()
        self.file = AsciiFile.open(path, diagnostics)
        self.faults = diagnostics.text().replace(str(folder) + "/", "")

    def column(self, name, id=None, side=""):
        key, why, hint = self.file.find(AsciiKey(name, id, side))
        assert key is not None, (why, hint, self.faults)
        return self.file.columns[key].tolist()

    def last(self, name, id=None, side=""):
        return self.column(name, id, side)[-1]

    def why(self, name, id=None, side=""):
        return "; ".join(self.file.find(AsciiKey(name, id, side))[1:])

    def unit(self, name, id=None, side=""):
        return self.file.dimension(self.file.find(AsciiKey(name, id, side))[0])


@pytest.fixture
def read(tmp_path):
    return lambda text: Read(tmp_path, text)


def glstat_state(cycle="       1", t="   0.00000E+00", kinetic="   1.00000E+00", more=""):
    return (
        f"\n\n dt of cycle{cycle} is controlled by solid         12 of part         3\n\n"
        f" time...........................{t}\n time step......................   1.00000E-06\n kinetic energy.................{kinetic}\n"
        " stonewall energy...............   1.00000E+00 wall#  1\n stonewall energy...............   2.00000E+00 wall#  2\n"
        " hourglass energy ..............   4.00000E+00\n total energy / initial energy..   1.00000E+00\n" + more
    )


def matsum_state(t, energy, k=0.0):
    return (
        f"\n\n time ={t}\n mat.#=   21             inten={energy}     kinen=   1.0000E+00\n x-mom=   2.0000E+00     y-mom={-3 - k:13.4E}"
        "     z-mom=   4.0000E+00\n                         hgeng=   5.0000E+00     +mass=   6.0000E+00\n\n"
        " mat.#=   22             inten=   1.0000E+01     kinen=   1.1000E+01\n\n\n"
        "       Maximum mass increase in solid elements      =   0.2122E-07 ID=   36456\n"
    )


def rcforc_line(side, t, x, more=""):
    return f"  {side:6}          1 time {t}  x {x}  y  2.00000E+00  z -3.00000-101{more}\n"


NODOUT = (
    "\n\n\n n o d a l   p r i n t   o u t   f o r   t i m e  s t e p       1                              ( at time 0.0000000E+00 )\n\n"
    " nodal point  x-disp     y-disp ...\n     4141  1.0000E+00-2.0000E-100-3.0000E+00************************  6.0000E+00  7.0000E+00  8.0000E+00"
    "  9.0000E+00  1.0000E+01  1.1000E+01  1.2000E+01\n\n nodal point  x-rot      y-rot ...\n     4141  1.0000E-01  2.0000E-01  3.0000E-01"
    "  4.0000E-01  5.0000E-01  6.0000E-01  7.0000E-01  8.0000E-01  9.0000E-01\n"
)
RBDOUT = (
    "\n  r i g i d   b o d y   m o t i o n  at cycle=      12     time=   1.50000E-01\n\n rigid body         5\n\n global             x\n"
    "   coordinates:    1.000E+00   2.000E+00   3.000E+00\n displacements:    4.000E+00   5.000E+00   6.000E+00   1.000E-01   2.000E-01   3.000E-01\n"
    "    velocities:    7.000E+00   8.000E+00   9.000E+00   4.000E-01   5.000E-01   6.000E-01\n"
    " row 2   -1.000E+00      2.000E+00      3.000E+00\n output in principal coordinate directions\n"
    "    velocities:   -8.000E+00   7.000E+00   9.000E+00   4.000E-01   5.000E-01   6.000E-01\n"
)
BNDOUT = (
    "\n n o d a l   f o r c e/e n e r g y    o u t p u t  t=   1.00000E-01\n\n discrete nodal point forces \n\n"
    " nd#    4513  xforce=   1.0000E+00   yforce=   0.0000E+00  zforce=  -1.0000E-02   energy=   2.1673E-08 xmoment=   3.0000E+00"
    " ymoment=   0.0000E+00 zmoment=   0.0000E+00 setid=   7\n              xtotal=   8.0000E+00   ytotal=   0.0000E+00  ztotal=   0.0000E+00\n\n"
    " velocity boundary condition forces/rigid body moments \n\n nd#    4513  xforce=   2.0000E+00   yforce=   0.0000E+00  zforce=   0.0000E+00"
    "   energy=   0.0000E+00\n              xtotal=   9.0000E+00   ytotal=   0.0000E+00  ztotal=   0.0000E+00\n"
)
SPCFORC = (
    " output at time =   1.00000E-03\n node=       1 local x,y,z forces =    1.0000E+00    2.0000E+00   -3.0000E-11 setid=  4\n"
    " node=       1 local x,y,z forces =    1.5000E+00    2.0000E+00   -3.0000E-11 setid=  5\n"
    " node=       1 local x,y,z moments=    4.0000E+00    5.0000E+00    6.0000E+00 setid=  4\n"
    "             force resultants   =    7.0000E+00    8.0000E+00    9.0000E+00\n"
)
RWFORC = (
    "\n    time       wall#   normal-force    x-force        y-force        z-force\n"
    "  1.00000E-01        7    1.250000E+01   0.000000E+00  -1.250000E+01   0.000000E+00\n"
    "  1.00000E-01        8    5.000000E-01   0.000000E+00   0.000000E+00   0.000000E+00\n"
    "  2.00000E-01        7    2.500000E+01   0.000000E+00  -2.500000E+01   0.000000E+00\n"
    "  2.00000E-01        8    5.000000E-01   0.000000E+00   0.000000E+00   0.000000E+00\n"
)
SLEOUT = (
    "\n\n\n contact interface energy file, time= 0.4997700E-03\n    #             surfa       surfb        cycle=          1852    frictional\n\n"
    "         1   0.0000E+00   0.0000E+00                               0.0000E+00\n"
    "         3  -0.1286E-23   0.2500E+00                               0.9637E-21\n\n"
    " summary   total surfa side=-0.1286314E-23\n           total surfb side= 0.2500000E+00\n"
    "           total energy    = 0.2500000E+00\n           friction energy = 0.9637213E-21\n"
)
SPHOUT = (
    "\n S P H   o u t p u t       at time 1.00000E-01     for  time  step        12\n\n particle  mat    sig-xx      sig-yy\n"
    "      17     1  1.0000E+00 -2.0000E+00\n\n particle  mat    yield       effsg       state\n      17     1  5.0000E+00  6.0000E+00   elastic\n"
)


def test_glstat(read):
    more = "\n added mass.....................   0.28468E-03\n percentage increase............   0.22936E+05\n"
    glstat = read(
        HEAD + glstat_state(kinetic="   0.17604-106", more=more) + glstat_state("********", "   1.00000E-03", "**************", more)
        + HEAD + glstat_state("       9", "   2.00000E-03", "  -0.10000D+02", more)
    )  # fmt: skip
    assert glstat.file.kind == "glstat" and glstat.file.times.tolist() == [0, 1e-3, 2e-3]
    kinetic, cycle = glstat.column("kinetic energy"), glstat.column("cycle")
    assert kinetic[0] == 0.17604e-106 and math.isnan(kinetic[1]) and math.isnan(cycle[1]) and kinetic[2] == -10 and cycle[2] == 9
    assert glstat.last("stonewall energy", 2) == 2 and glstat.last("hourglass energy") == 4 and glstat.last("added mass") == 0.28468e-3
    units = [glstat.unit(name) for name in ("percentage increase", "kinetic energy", "total energy / initial energy", "time step")]
    assert units == ["%", "ML2/T2", "-", "T"]


def test_matsum(read):
    matsum = read(HEAD + matsum_state("   0.0000E+00", "   7.0000E+00") + matsum_state("   1.0000E-03", "*************", 1))
    assert matsum.column("inten", 21)[0] == 7 and math.isnan(matsum.last("inten", 21)) and matsum.last("y-mom", 21) == -4
    assert matsum.last("+mass", 21) == 6 and matsum.last("hgeng") == 5 and matsum.last("kinen", 22) == 11
    assert matsum.why("inten") == "matsum has several 'inten'; tell id, or side: 21, 22"
    assert matsum.why("inten", 7) == "matsum has no 'inten' of 7; it has that of 21, 22"
    assert matsum.why("x_mom", 21) == "matsum has no 'x_mom'; did you mean 'x-mom'?"


def test_rcforc_and_sleout(read):
    moments = " mass  4.00000E+00  mx  5.00000E+00  my -6.00000E+00"
    rcforc = read(
        HEAD + "\n{BEGIN LEGEND}\n Entity #        Title\n        1     SURFA 3 time to slip\n{END LEGEND}\n\n"
        + rcforc_line("SURFA", "0.00000E+00", " 1.00000E+00", moments) + rcforc_line("SURFB", "0.00000E+00", "-1.00000E+00", moments)
        + " interface number,         3,is single surface-resultants are undefined\n"
    )  # fmt: skip
    assert rcforc.last("my", 1, "SURFB") == -6 and rcforc.unit("mx", 1, "SURFA") == "ML2/T2" and rcforc.unit("x", 1, "SURFB") == "ML/T2"
    assert rcforc.why("x", 1) == "rcforc has several 'x' of 1; tell id, or side: 1 SURFA, 1 SURFB"
    older = read(HEAD + rcforc_line("slave", "1.99800E-04", " 1.50000E+00") + rcforc_line("master", "1.99800E-04", "************"))
    assert older.file.times.tolist() == [1.998e-4] and older.last("x", 1, "SURFA") == 1.5 and older.last("z", 1, "slave") == -3e-101
    assert math.isnan(older.last("x", 1, "SURFB"))
    sleout = read(HEAD + SLEOUT)
    assert sleout.last("frictional", 3) == 0.9637e-21 and sleout.last("surfb", 3) == 0.25 and sleout.last("cycle") == 1852
    assert sleout.last("total friction") == 0.9637213e-21 and sleout.last("total energy") == 0.25


def test_nodes_bodies_boundaries_walls_and_particles(read):
    nodout = read(HEAD + NODOUT)
    assert nodout.last("y-disp", 4141) == -2e-100 and nodout.last("z-disp") == -3 and nodout.last("z-coor") == 12
    assert math.isnan(nodout.last("x-vel")) and math.isnan(nodout.last("y-vel")) and nodout.last("z-vel") == 6
    assert nodout.last("x-rot vel") == 0.4 and nodout.last("z-rot acc") == 0.9 and nodout.unit("y-rot acc") == "1/T2"
    rbdout = read(HEAD + RBDOUT)
    assert rbdout.last("coordinates y", 5) == 2 and rbdout.last("displacements z-rot", 5) == 0.3 and rbdout.last("row 2 a") == -1
    assert rbdout.last("local velocities a", 5) == -8 and rbdout.last("velocities x", 5) == 7
    assert [rbdout.unit(f"velocities x{end}") for end in ("", "-rot")] == ["L/T", "1/T"] and rbdout.unit("displacements x-rot") == "-"
    bndout = read(HEAD + BNDOUT)
    assert bndout.last("xforce", 4513, "discrete") == 1 and bndout.last("xforce", 4513, "velocity") == 2
    assert bndout.last("xmoment", 4513) == 3 and bndout.last("xtotal", side="velocity") == 9 and bndout.why("setid")
    spcforc = read(HEAD + SPCFORC)
    assert spcforc.last("forces x", 1, "setid 5") == 1.5 and spcforc.last("moments z", 1) == 6 and spcforc.last("force resultants z") == 9
    assert spcforc.unit("moments z") == "ML2/T2" and spcforc.unit("forces x", 1, "setid 4") == "ML/T2"
    rwforc = read(HEAD + RWFORC)
    assert rwforc.column("normal", 7) == [12.5, 25] and rwforc.last("y", 7) == -25 and rwforc.last("normal", 8) == 0.5
    sphout = read(HEAD + SPHOUT)
    assert sphout.last("sig-yy", 17) == -2 and sphout.last("effsg", 17) == 6 and sphout.unit("sig-xx") == "M/LT2"


def test_restarts_replace_what_was_before(read):
    states = [("1.00000E+00", 1), ("2.00000E+00", 2), ("3.00000E+00", 3), None, ("1.50000E+00", 4), ("1.50000E+00", 5)]
    file = read(HEAD + "".join(HEAD if one is None else rcforc_line("SURFA", one[0], f"{one[1]:12.5E}") for one in states))
    assert file.file.times.tolist() == [1, 1.5, 1.5]  # two that look alike in six digits
    assert file.column("x", 1) == [1, 4, 5]
    assert "2 states before that were replaced by later ones" in file.faults


STATES = {
    "glstat": lambda k: glstat_state(t=f"{k:14.5E}"),
    "matsum": lambda k: matsum_state(f"{k:13.4E}", "   7.0000E+00"),
    "rcforc": lambda k: "".join(rcforc_line(side, f"{k:11.5E}", " 1.00000E+00") for side in ("SURFA", "SURFB")),
    "sleout": lambda k: SLEOUT.replace("0.4997700E-03", f"{k:13.7E}"),
    "nodout": lambda k: NODOUT.replace("0.0000000E+00", f"{k:13.7E}"),
    "rbdout": lambda k: RBDOUT.replace("1.50000E-01", f"{k:11.5E}"),
    "bndout": lambda k: BNDOUT.replace("1.00000E-01", f"{k:11.5E}"),
    "spcforc": lambda k: SPCFORC.replace("1.00000E-03", f"{k:11.5E}"),
    "sphout": lambda k: SPHOUT.replace("1.00000E-01", f"{k:11.5E}"),
}


@pytest.mark.parametrize("kind", STATES)
def test_a_file_that_is_cut_off_anywhere_is_told(read, kind):
    whole, last = HEAD + "".join(STATES[kind](k) for k in range(3)), STATES[kind](2)
    assert read(whole).file.kind == kind and len(read(whole).file.times) == 3
    begin, told = len(whole) - len(last), 0
    for cut in range(1, len(last), 5):
        rest = last[cut:]
        if not rest.strip() or not last[:cut].strip(" \n1") or "Maximum" in last[:cut].split("\n")[-1] or rest.lstrip().startswith("Maximum"):
            continue  # all numbers are there, or nothing has begun
        found = read(whole[: begin + cut])
        line = whole[: begin + cut].count("\n") + (whole[begin + cut - 1] != "\n")
        assert found.file is None and found.faults.startswith(f"file:{line}: error: not a line of a whole {kind}"), last[:cut]
        told += 1
    assert told > 20


def test_foreign_and_broken_files(read):
    assert read("").faults.startswith("file:") and "up to its end the file has no state of a history\n  hint: glstat, " in read("").faults
    assert read("*KEYWORD\n*END\n").faults.startswith("file:2: error: up to its end")
    assert read(HEAD.encode() + b"\x89HDF\0\n").faults.startswith("file:3: error: this is no text file")
    whole = HEAD + matsum_state("   0.0000E+00", "   7.0000E+00")
    assert "no number behind 'y-mom='" in read(whole.replace("y-mom=  -3.0", "y-mom=  abcd")).faults
    assert "an id did not fit into its column" in read(whole.replace("mat.#=   21", "mat.#=*****")).faults
    untimed = HEAD + glstat_state().replace(" time...........................   0.00000E+00\n", "")
    assert "'time step' stands before the time of its state" in read(untimed).faults
    for text in ("\n n o d a l   f o r c e/e n e r g y    o u t p u t\n\n nd#  30 xforce=  0.1\n", "\n n o d a l   f o r c e/e n e r g y  t\n"):
        assert read(text).faults.startswith("file:2: error: ")


def test_random_damage_is_read_or_told(read):
    random = np.random.default_rng(5)
    for kind, state in STATES.items():
        base = bytearray((HEAD + state(0) + state(1)).encode())
        for _ in range(120):
            content = bytearray(base)
            for at in random.integers(0, len(content), random.integers(1, 8)):
                content[at] = random.choice(bytearray(b"\n *=.-+0123456789eEdDxyzn#\xff\0")) if random.random() < 0.8 else random.integers(0, 256)
            found = read(bytes(content))
            assert (found.file is None) == ("error" in found.faults), (kind, found.faults)


def test_numbers():
    def numbers(text):
        return Text(text).numbers(12)

    found = numbers(" 1 -2.5 +.5 1.e3 1D2 1.5d-2 -1.0-100+2.0+100 3.0E-101-4.0")
    assert found == [1, -2.5, 0.5, 1000, 100, 0.015, -1e-100, 2e100, 3e-101, -4]
    assert math.isnan(numbers("NaN")[0]) and numbers(" -Infinity") == [-math.inf]
    assert len(numbers("************************")) == 2 and numbers("1E400") == [math.inf]
    assert numbers("- 1") == numbers(". 1") == numbers("x") == []
