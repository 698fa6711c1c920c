#!/usr/bin/env python3
"""What contact of nodes at rest costs beside the elements: two blocks of N x N x 28 solids, one on the other or a tenth of a solid over it,
on one thread.

usage: contact_at_rest.py COURANT [N, 30 unless given]
"""
import os
import re
import subprocess
import sys
import tempfile


def deck(n, contact, gap=0.0):
    cards = ["*KEYWORD", "*CONTROL_TERMINATION", f"{0.02:10.3f}"]
    nodes, solids = [], []
    for part in (1, 2):
        cards += ["*PART", "block", f"{part:10}{part:10}{part:10}", "*SECTION_SOLID", f"{part:10}         1", "*MAT_ELASTIC",
                  f"{part:10}    1000.0     1.0E7       0.3"]
        first = len(nodes) + 1
        for k in range(29):
            for j in range(n + 1):
                for i in range(n + 1):
                    nodes.append((0.3 * i / n, 0.3 * j / n, (0.28 + gap) * (part - 1) + 0.01 * k))
        at = lambda i, j, k: first + i + (n + 1) * (j + (n + 1) * k)
        for k in range(28):
            for j in range(n):
                for i in range(n):
                    solids.append((len(solids) + 1, part, at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                                   at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)))
    cards += ["*SET_NODE_LIST_GENERATE", "         1", f"{1:10}{(n + 1) ** 2:10}", "*BOUNDARY_SPC_SET",
              "         1         0         1         1         1", "*LOAD_BODY_Z", f"         1{0.0 if gap else 9.81:10.2f}", "*DEFINE_CURVE", "         1",
              f"{0.0:20.1f}{1.0:20.1f}", f"{100.0:20.1f}{1.0:20.1f}"]
    if contact:
        cards += [f"*CONTACT_{contact}", "         0" if "SINGLE" in contact else "         1         2         3         3",
                  "       0.3       0.3", "       1.0"]
    cards += ["*NODE"] + [f"{k:8}{x:16.9f}{y:16.9f}{z:16.9f}" for k, (x, y, z) in enumerate(nodes, 1)]
    cards += ["*ELEMENT_SOLID"] + ["".join(f"{v:8}" for v in solid) for solid in solids] + ["*END", ""]
    return "\n".join(cards)


def main():
    courant, n = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 30
    for contact, gap in (("AUTOMATIC_SURFACE_TO_SURFACE", 0), ("AUTOMATIC_SINGLE_SURFACE", 0), ("AUTOMATIC_SINGLE_SURFACE", 0.001)):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "deck.k")
            with open(name, "w", encoding="ascii") as file:
                file.write(deck(n, contact, gap))
            run = subprocess.run([courant, "run", name, "-o", os.path.join(folder, "out"), "--threads", "1"], capture_output=True, text=True,
                                 check=True)
            with open(os.path.join(folder, "out", "summary.yaml"), encoding="utf-8") as file:
                summary = file.read()
        seconds = {what.strip(): float(time) for what, time in re.findall(r"^  (\S.*?\S) {2,}(\d+\.\d+) +\d+\.\d$", run.stdout, re.M)}
        of_contact = sum(time for what, time in seconds.items() if what.startswith("contact 1"))
        elements = sum(time for what, time in seconds.items() if what.startswith(("solids", "assembly")))
        steps = int(re.search(r"Problem cycle +=\s*(\d+)", run.stdout).group(1))
        cycle = 1e9 * elements / steps / (2 * n * n * 28)
        tracked = int(re.search(r"contact_nodes: (\d+)", summary).group(1))
        print(f"{contact}, {'parted' if gap else 'in touch'}: {2 * n * n * 28} solids, {tracked} nodes, {2 * (n + 1) ** 2} of them at the joint, {steps} "
              f"steps: contact {of_contact:.2f} s, elements {elements:.2f} s, ratio {of_contact / elements:.2f}; {1e9 * of_contact / steps / tracked:.0f} ns "
              f"per node, {1e9 * of_contact / steps / (2 * (n + 1) ** 2):.0f} per node of the joint and step; an element {cycle:.0f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
