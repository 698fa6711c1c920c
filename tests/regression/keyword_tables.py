#!/usr/bin/env python3
"""The program that makes tables of src/keyword/keywords_only_read.yaml says what is wrong in such a file, and where.

usage: keyword_tables.py KEYWORD_TABLES WORK_DIR
"""
import pathlib
import subprocess
import sys

program, work = sys.argv[1], pathlib.Path(sys.argv[2])
GOOD = """refused:
  springs:
  - ELEMENT_SPRING, ELEMENT_SPRING_LONG: springs
    defines: discrete
    cards:
    - - {with: LONG, width: 8}
      - [EID, id, number, required]
      - [N1 N2, node, "first|second node"]
      - skip
      - [X Y Z, L, place, point]
    - - {when: N1 != 0, optional: true}
      - [ID, {by: N2, 1: part, else: part_set}, what it holds]
idle:
- CONTROL_SPRING: nothing
  once: true
  cards:
  - - [RATE, 1/T, rate, 2, output]
"""
# a change of the good file, the line that is then wrong, what is said
FAULTS = [
    ("defines: discrete", "define: discrete", 4, "unknown key 'define'"),
    ("springs:\n  - ELEMENT", "springs:\n  - WORD: 1\n  - ELEMENT", 3, "no cards"),
    ("with: LONG", "with: SHORT", 6, "no name has the word 'SHORT'"),
    ("required]", "needed]", 7, "unknown rule 'needed'"),
    ("first|second node", "first|second|third node", 8, "'first|second|third' is not one word for each field"),
    ("[X Y Z, L, place, point]", "[X Y Z, L]", 10, "not [NAMES, KIND, MEANING, RULES ...]"),
    ("N1 != 0", "N3 != 0", 11, "no field has the name 'N3'"),
    ("N1 != 0", "N1 > 0", 11, "not FIELD == NUMBER or FIELD != NUMBER"),
    ("by: N2, ", "", 12, "not {by: FIELD, NUMBER: SPACE, else: SPACE}"),
    ("idle:", "idles:", 13, "unknown key 'idles'"),
]


def run(text):
    (work / "keywords.yaml").write_text(text)
    done = subprocess.run([program, "keywords.yaml", "tables.cpp"], cwd=work, stderr=subprocess.PIPE, text=True)
    return done.returncode, done.stderr.strip()


work.mkdir(parents=True, exist_ok=True)
assert run(GOOD) == (0, ""), run(GOOD)
tables = (work / "tables.cpp").read_text()
for part in ('((2ull >> e.name) & 1) != 0', '"second node"', 'e.d1 != 0', 'e.d2 == 1 ? IdSpace::part : IdSpace::part_set', '{"RATE", &T::r0, "1/T", "rate", {.standard = 2, .honour = Honour::output_only, }}'):
    assert part in tables, f"{part} is not in\n{tables}"
for old, new, line, message in FAULTS:
    assert GOOD.count(old) == 1, old
    said = run(GOOD.replace(old, new))
    assert said == (1, f"keywords.yaml:{line}: {message}"), f"{new}: {said}"
print(f"{len(FAULTS)} faults are named")
