#!/usr/bin/env python3
"""The program that makes tables of keywords_only_read.yaml and of files of cards says what is wrong in such a file, and where.

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
    ("N1 != 0", "N1 ~ 0", 11, "not FIELD == NUMBER, FIELD != NUMBER or the like"),
    ("by: N2, ", "", 12, "not {by: FIELD, NUMBER: SPACE, else: SPACE}"),
    ("idle:", "idles:", 13, "unknown key 'idles'"),
]


CARDS = """- COURANT_SPONGE, COURANT_SPONGE_SET: slows particles
  struct: Sponge
  defines: [definition, TITLE]
  move: move_sponge
  cards:
  - - [BOXID, box, box of the layer, required]
    - [TAU, T, time constant, positive, {member: time}]
    - [SHAPE, int, "0 constant, 1 growing", 1, {allowed: [0, 1]}]
    - [LCID, curve, factor, {curve: [T, 1/L]}]
    - [PID, {by: name, 0: part, else: part_set}, part or set of parts]
  - - {when: SHAPE > 0, optional: true}
    - [LCDR, curve, factor, {curve_of: curve_of_sponge}]
    - [VX VY VZ, L/T, velocity along x|y|z, direction]
  - - {repeat: true, more: goes_on}
    - [NIDS, node, nodes, list]
- COURANT_SPONGE_BACK: the same behind
  struct: Sponge
  cards:
  - - [TAU, T, time constant, {member: time}]
    - [DEPTH, L, depth]
"""
CARD_FAULTS = [
    ("  struct: Sponge\n  defines", "  defines", 1, "no struct"),
    ("time constant, positive", "time constant, above_0", 7, "unknown rule 'above_0'"),
    ("{allowed: [0, 1]}", "{allows: [0, 1]}", 8, "unknown key 'allows'"),
    ("curve: [T, 1/L]", "curve: [T, kg]", 9, "'kg' is no dimension"),
    ("curve: [T, 1/L]", "curve: T", 9, "not [dimension of the abscissa, of the ordinate]"),
    ("box, box of", "bx, box of", 6, "'bx' is no kind of field"),
    ("when: SHAPE > 0", "when: FORM > 0", 11, "no field has the name 'FORM'"),
    ("[TAU, T, time constant, {member: time}]", "[TAU, T, time constant]", 19, "TAU was the member 'time' before"),
    ("[TAU, T, time constant, {member: time}]", "[TAU, int, time constant, {member: time}]", 19, "'time' was Real before"),
]


def run(text, out="tables.cpp"):
    (work / "keywords.yaml").write_text(text)
    done = subprocess.run([program, "keywords.yaml", out], cwd=work, stderr=subprocess.PIPE, text=True)
    return done.returncode, done.stderr.strip()


work.mkdir(parents=True, exist_ok=True)
for good, faults, out, parts in (
        (GOOD, FAULTS, "tables.cpp",
         ('((2ull >> e.name) & 1) != 0', '"second node"', 'e.d1 != 0', 'e.d2 == 1 ? IdSpace::part : IdSpace::part_set',
          '{member(&T::r0), "RATE", "1/T", "rate", {.standard = 2, .honour = Honour::output_only, }')),
        (CARDS, CARD_FAULTS, "cards.hpp",
         ("struct Sponge : Entry {", "Real time = 0;", "int shape = 1;", "std::vector<Id> nids;", "Real depth = 0;",
          "std::string move_sponge(Sponge&, const Affine&);", "bool goes_on(const Sponge&);", "CurveOf curve_of_sponge(const Sponge&);",
          'KeywordTable courant_sponge_table()', 'KeywordTable courant_sponge_back_table()', '.curve = {"T", "1/L"}', "e.shape > 0",
          "e.name == 0 ? IdSpace::part : IdSpace::part_set", '"velocity along y"'))):
    assert run(good, out) == (0, ""), run(good, out)
    text = (work / out).read_text()
    for part in parts:
        assert part in text, f"{part} is not in\n{text}"
    for old, new, line, message in faults:
        assert good.count(old) == 1, old
        said = run(good.replace(old, new), out)
        assert said == (1, f"keywords.yaml:{line}: {message}"), f"{new}: {said}"
print(f"{len(FAULTS) + len(CARD_FAULTS)} faults are named")
