#!/usr/bin/env python3
"""Decks that others wrote: each is read, or refused with a reason, and what is read is counted right.

usage: corpus.py COURANT SOURCE_DIR [--write]
The decks are in the folder COURANT_CORPUS, else in ../shared/decks beside the project; without them the test is skipped.
`courant check` must end by itself with exit code 0 or 1 for every file. The numbers of nodes, elements and the sums of masses that
it prints must be those of the plain count below, which shares nothing with the reader. --write makes docs/conformance.md.
"""
import collections
import os
import re
import subprocess
import sys
import tempfile

TIME_LIMIT = 20  # seconds per deck; the largest has some thousand lines
courant, source = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
corpus = os.environ.get("COURANT_CORPUS", os.path.join(source, "..", "shared", "decks"))


# --- the plain count -----------------------------------------------------------------------------------------------------------------
class Count:
    """Nodes, elements by kind, and masses; `known` is false for a mass that is no plain number."""

    def __init__(self):
        self.nodes, self.elements, self.mass, self.known = 0, collections.Counter(), collections.Counter(), True


# first words of a keyword: kind as `courant check` calls it, columns of the mass
KINDS = [("ELEMENT_SPH", "SPH particles", (16, 32)), ("ELEMENT_SOLID", "solids", None), ("ELEMENT_SHELL", "shells", None),
         ("ELEMENT_TSHELL", "thick shells", None), ("ELEMENT_BEAM", "beams", None),
         ("ELEMENT_DISCRETE_SPHERE", "discrete spheres", None), ("ELEMENT_DISCRETE", "springs and dampers", None),
         ("ELEMENT_MASS_PART", "masses added to parts", (8, 24)), ("ELEMENT_MASS", "lumped masses", (16, 32)),
         ("ELEMENT_INERTIA", "lumped inertias", None)]

RUNS = "## Runs of decks of structures"  # a section that deck_runs.py makes


def kind_of(name):
    fitting = [k for k in KINDS if name == k[0] or name.startswith(k[0] + "_")]
    return max(fitting, key=lambda k: len(k[0])) if fitting else None


def lines_per_element(name, line):
    """Data lines of one element, told from its first line and the options in the name."""
    options = name.split("_")[2:]
    if name.startswith("ELEMENT_SOLID"):
        fields = line.split(",") if "," in line else [line[i:i + 8] for i in range(0, len(line), 8)]
        two = len([f for f in fields if f.strip()]) <= 2  # EID and PID; the nodes are below
        return (2 if two else 1) + (2 if "ORTHO" in options else 0) + (1 if "DOF" in options else 0)
    if name.startswith("ELEMENT_SHELL"):
        corners = line.split(",")[2:] if "," in line else [line[i:i + 8] for i in range(16, len(line), 8)]
        mid_side = len([c for c in corners if c.strip() not in ("", "0")]) > 4
        thickness = any(o in options for o in ("THICKNESS", "BETA", "MCID"))
        return 1 + (1 if thickness else 0) + (1 if thickness and mid_side else 0) + (1 if "OFFSET" in options else 0) + (1 if "DOF" in options else 0)
    if name.startswith("ELEMENT_BEAM"):
        return 1 + len([o for o in options if o in ("THICKNESS", "SECTION", "SCALAR", "SCALR", "PID", "OFFSET", "ORIENTATION", "WARPAGE", "ELBOW")])
    return 1


def names_corners(line):
    """Whether element, part and three nodes are on a line: those of layers have a blank fourth field."""
    fields = line.split(",") if "," in line else [line[i:i + 8] for i in range(0, 40, 8)]
    return len(fields) >= 5 and all(re.fullmatch(r" *0*[1-9][0-9]* *", f) for f in fields[:5])


def number(text):
    """A number as Fortran reads it, or None."""
    text = re.sub(r"(?<=[0-9.])([+-])", r"e\1", text.strip().lower().replace("d", "e")).replace("ee", "e")
    try:
        return float(text or 0)
    except ValueError:
        return None


def count_file(path, count, open_files):
    try:
        lines = open(path, encoding="latin-1").read().expandtabs(8).splitlines()
    except OSError:
        return
    long_deck = i10 = False
    name, waiting = "", 0
    for line in lines:
        if line.startswith("*"):
            word = line[1:].upper().split()[0] if line[1:].split() else ""
            if word == "KEYWORD":
                long_deck, i10 = "LONG=Y" in line.upper(), "I10=Y" in line.upper()
            if word == "END":
                return
            name, waiting = word.rstrip("+-%"), 0
            is_long = long_deck and not word.endswith("-") or word.endswith("+")
            continue
        if line.startswith("$"):
            continue
        if name == "INCLUDE" and line.strip() and not line.rstrip().endswith(" +"):
            other = os.path.join(os.path.dirname(path), line.strip())
            other = other if os.path.exists(other) else line.strip()
            if os.path.realpath(other) not in open_files:
                count_file(other, count, open_files + [os.path.realpath(other)])
        if waiting > 0:  # a further line of the same element
            waiting -= 1
        elif not line.strip() or ("COMPOSITE" in name and name.startswith("ELEMENT_SHELL") and not names_corners(line)):
            continue
        elif name == "NODE":
            count.nodes += 1
        elif kind := kind_of(name):
            count.elements[kind[1]] += 1
            waiting = lines_per_element(name, line) - 1
            if kind[2]:
                column = kind[2][0] // 8  # in fields: all before the mass are 8 wide
                if "," in line:
                    text = (line.split(",") + [""] * 4)[column]
                elif is_long:
                    text = line[20 * column:20 * column + 20]
                else:
                    shift = 2 * column if i10 else 0
                    text = line[kind[2][0] + shift:kind[2][1] + shift]
                mass = number(text)
                count.known &= mass is not None
                count.mass[kind[1]] += max(mass or 0, 0)


# --- what courant says ---------------------------------------------------------------------------------------------------------------
def said(stdout):
    """Nodes, elements and masses of the report, and the kinds it has lines of that it does not read."""
    got = Count()
    unread = set()
    nodes = re.search(r"^  nodes +(\d+)", stdout, re.M)
    got.nodes = int(nodes.group(1)) if nodes else None
    for kind in {k[1] for k in KINDS}:
        if m := re.search(rf"^  {kind} +(\d+)(?!.*not read)(?:  given mass (\S+) \[M\])?", stdout, re.M):
            got.elements[kind], got.mass[kind] = int(m.group(1)), float(m.group(2) or 0)
        if re.search(rf"^  {kind} +\d+  \(lines that are not read\)", stdout, re.M):
            unread.add(kind)
    return got, unread


# an incomplete deck: a fragment that is to be included by another one
INCOMPLETE = re.compile(r"\*CONTROL_TERMINATION is missing|there is nothing to compute|the deck holds no keyword"
                        r"|\*INCLUDE: cannot read|has no coordinates|does not exist")
REFUSED = re.compile(r"\*([^\s:]+).*?: (.*?) (?:is|are) not supported|^\*([^\s:]+): (.*?) (?:is|are) not supported")


def classify(code, errors):
    if code == 0:
        return "fully honoured"
    if any(not INCOMPLETE.search(e) and not REFUSED.search(e) for e in errors):
        return "rejected"
    return "read, with refusals" if any(REFUSED.search(e) for e in errors) else "read, incomplete as a deck"


def reason(message):
    """A message without what is particular to one deck."""
    message = re.sub(r" \(here and at \d+ more lines?\)", "", message)
    if m := re.search(r"^\*[^\s:]+: (.*)", message):
        return re.sub(r"'[^']*'", "'...'", m.group(1))
    return re.sub(r"'[^']*'", "'...'", re.sub(r"^.*?\]\): ", "", re.sub(r"\d+", "N", message)))


def self_test():
    """The plain count against counts made by hand, and the classes of messages."""
    text = ("*KEYWORD\n*NODE\n       1             0.0\n$ comment\n2,1.0,2.0\n*ELEMENT_SOLID\n       1       1       1       2       3\n"
            "       2       1\n       1       2       3       4\n*ELEMENT_SOLID_ORTHO\n       3       1       1       2       3\n 1.0\n 0.0\n"
            "*ELEMENT_MASS\n       4       1           2.5-1\n5,1,1.5d0\n*ELEMENT_MASS_PART+\n" + f"{7:20d}{3.0:20f}\n" + "*END\n*NODE\n       9\n")
    with tempfile.NamedTemporaryFile("w", suffix=".k") as file:
        file.write(text)
        file.flush()
        count = Count()
        count_file(file.name, count, [])
    assert count.nodes == 2 and count.elements == {"solids": 3, "lumped masses": 2, "masses added to parts": 1}, vars(count)
    assert count.known and abs(count.mass["lumped masses"] - 1.75) < 1e-12 and count.mass["masses added to parts"] == 3, vars(count)
    assert classify(1, ["*AIRBAG_ALE: airbags are not supported", "*INCLUDE: cannot read 'x'"]) == "read, with refusals"
    assert classify(1, ["*CONTROL_TERMINATION is missing: the run has no end time"]) == "read, incomplete as a deck"
    assert classify(1, ["*NODE field 2 (X, x coordinate [L]): expected a number, got 'a'"]) == "rejected"
    got, unread = said("Mesh\n  nodes                            8\n  solids                           2\n"
                       "  beams                            3  (lines that are not read)\n  lumped masses                    1  given mass 2.5 [M]\n")
    assert got.nodes == 8 and got.elements == {"solids": 2, "lumped masses": 1} and unread == {"beams"} and got.mass["lumped masses"] == 2.5


def main():
    self_test()
    if not os.path.isdir(corpus):
        print(f"skipped: there is no folder {corpus}")
        return 77
    paths = sorted(os.path.join(folder, f) for folder, _, files in os.walk(corpus) for f in files if f.endswith((".k", ".key", ".dyn", ".inc")))
    failures, rows, reasons, uncounted = [], [], collections.Counter(), collections.Counter()
    for path in paths:
        name = os.path.relpath(path, corpus)
        try:
            done = subprocess.run([courant, "check", name], cwd=corpus, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIME_LIMIT)
        except subprocess.TimeoutExpired:
            failures.append(f"{name}: still running after {TIME_LIMIT} s")
            continue
        stdout, stderr = done.stdout.decode("utf-8", "replace"), done.stderr.decode("utf-8", "replace")
        if done.returncode not in (0, 1):
            failures.append(f"{name}: exit code {done.returncode}")
        if "unknown keyword" in stderr:
            failures.append(f"{name}: {re.search(r'.*unknown keyword.*', stderr).group()}")
        expected = Count()
        count_file(path, expected, [os.path.realpath(path)])
        got, unread = said(stdout)
        if "reading stopped after" in stderr:
            uncounted["reading stopped"] += 1
        else:
            if got.nodes != expected.nodes:
                failures.append(f"{name}: {got.nodes} nodes, a plain count finds {expected.nodes}")
            for kind in sorted(set(got.elements) | set(expected.elements)):
                if kind in unread:
                    uncounted[kind] += 1
                    continue
                if got.elements[kind] != expected.elements[kind]:
                    failures.append(f"{name}: {got.elements[kind]} {kind}, a plain count finds {expected.elements[kind]}")
                if expected.known and abs(got.mass[kind] - expected.mass[kind]) > 1e-5 * abs(expected.mass[kind]):
                    failures.append(f"{name}: mass of {kind} {got.mass[kind]}, a plain count finds {expected.mass[kind]}")
        errors = re.findall(r"^(?:\S.*?: )?error: (.*)", stderr, re.M)
        kind = classify(done.returncode, errors)
        for one in {reason(e) for e in errors}:
            reasons[one] += 1
        elements = ", ".join(f"{n} {k}" for k, n in sorted(expected.elements.items()))
        first = next((e for e in errors if not INCOMPLETE.search(e)), errors[0] if errors else "")
        rows.append((name, kind, expected.nodes, elements, re.sub(r"^(\*\S+ .*?)\(.*?\]\)", r"\1", first)))
    kinds = collections.Counter(row[1] for row in rows)
    text = page(rows, kinds, reasons, uncounted)
    print(text)
    if "--write" in sys.argv:
        path = os.path.join(source, "docs", "conformance.md")
        runs = open(path, encoding="utf-8").read().partition(RUNS) if os.path.exists(path) else ("", "", "")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text + ("\n" + runs[1] + runs[2] if runs[1] else ""))
    print("\n".join(failures))
    return f"{len(failures)} failed" if failures else 0


def page(rows, kinds, reasons, uncounted):
    sources = set()  # (repository, commit); several repositories stand with a + between them, their commits with a ;
    for folder, _, files in sorted(os.walk(corpus)):
        if "MANIFEST.tsv" in files:
            for line in open(os.path.join(folder, "MANIFEST.tsv"), encoding="utf-8").read().splitlines()[1:]:
                cells = line.split("\t")
                repositories = cells[1].split(",")[0].split(" + ")
                sources |= {(r, c.strip()[:10]) for r, c in zip(repositories, cells[3].split(";")) if re.match("[0-9a-f]{10}", c.strip())}
    cell = lambda text: str(text).replace("|", "\\|").replace("*", "\\*").replace("<", "\\<")
    own = sum(row[0].startswith("structures/own/") for row in rows)
    out = ["# Conformance", "",
           "Decks written by other programs and people, as `courant check` sees them. Made by `tests/regression/corpus.py --write`, which also",
           "proves that every file ends with exit code 0 or 1, that nodes, elements and masses are those of a plain count, and that no",
           "keyword of LS-DYNA is called unknown. The decks are not kept with the project"
           + (": " + ", ".join(f"{r} at {c}" for r, c in sorted(sources)) if sources else "")
           + (f"; {own} decks of structures (`structures/own`) were written for this test." if own else "."), "",
           f"| of {len(rows)} files | |", "|---|---|"]
    meaning = {"fully honoured": "runs as it is", "read, incomplete as a deck": "every card is honoured, but the file alone is no whole model",
               "read, with refusals": "every card is read; some physics is refused by name", "rejected": "a fault of the deck, or a card that is not understood"}
    out += [f"| {kind}: {meaning[kind]} | {kinds[kind]} |" for kind in meaning]
    if uncounted:
        out += ["", "Not counted: " + ", ".join(f"{k} ({n} files)" for k, n in sorted(uncounted.items())) + "."]
    out += ["", "## Reasons", "", "Number of files in which a reason comes up; a file may have several.", "", "| reason | files |", "|---|---|"]
    out += [f"| {cell(r)} | {n} |" for r, n in sorted(reasons.items(), key=lambda item: (-item[1], item[0]))]
    out += ["", "## Files", "", "| file | | nodes | elements | first reason |", "|---|---|---|---|---|"]
    out += [f"| {cell(name)} | {kind} | {nodes} | {elements} | {cell(first)} |" for name, kind, nodes, elements, first in rows]
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    sys.exit(main())
