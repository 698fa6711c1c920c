#!/usr/bin/env python3
"""Decks written by another program's keyword library, PyDyna (`pip install ansys-dyna-core`), are read as they were meant.

usage: pydyna.py COURANT WORK_DIR
1. A whole deck: its numbers arrive.
2. Every keyword that both know, once with PyDyna's defaults and once with all fields filled: the cards are those of Courant's
   tables, so that no card is missing or too many, and no number stands where Courant expects another kind of value.
3. Every name that PyDyna knows: none is called unknown.
The package is looked for in this Python, then in WORK_DIR, where pip puts it; skipped where there is none and pip cannot get it.
"""
import os
import re
import subprocess
import sys

courant, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
packages = os.path.join(work, "pydyna_packages")


def import_pydyna():
    global pandas, Deck, kwd, TypeMapping
    import pandas
    from ansys.dyna.core import Deck
    from ansys.dyna.core import keywords as kwd
    from ansys.dyna.core.keywords.keyword_classes.type_mapping import TypeMapping


sys.path.append(packages)
try:
    import_pydyna()
except ImportError as missing:
    call = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "0", "--timeout", "8",
            "--target", packages,
            "ansys-dyna-core"]
    try:
        got = subprocess.run(call, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
        if got.returncode != 0:
            raise OSError((got.stdout.strip().splitlines() or ["pip failed"])[-1])
        import_pydyna()
    except (OSError, ImportError, subprocess.TimeoutExpired) as reason:
        print(f"skipped: {missing}, and pip cannot get ansys-dyna-core: {reason}")
        sys.exit(77)

# --- 1: a whole deck
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



def check(name, text):
    """Exit code, stdout and stderr of `courant check` on a deck."""
    deck_path = os.path.join(work, name)
    with open(deck_path, "w") as deck_file:
        deck_file.write(text)
    got = subprocess.run([courant, "check", deck_path], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=60)
    assert got.returncode in (0, 1), f"courant check {deck_path} ended with exit code {got.returncode}"
    return got.returncode, got.stdout, got.stderr


code, stdout, stderr = check("pydyna.k", deck.write())
print(stdout, stderr, sep="\n")
assert code == 0, f"courant check ended with exit code {code}"
assert "error" not in stderr, "the deck has errors"
row = re.search(r"^ +1 +16 sph +(\S+) +(\S+) +(\S+) +(\S+) +(\S+) +(\S+)", stdout.replace(" water ", " "), re.M)
assert row, "part 1 has 16 particles"
mass, volume, density, sound, distance, h = map(float, row.groups())
assert (mass, volume, density, sound, distance, h) == (160, 0.16, 1000, 30, 0.1, 0.12), row.groups()

# --- 2: card layouts
failures = []
WRONG_LAYOUT = re.compile(r"is missing|one line too many|values behind|is not read|unknown keyword|text before|"
                          r"expected (an integer|a number), got (?!a blank field)")  # PyDyna leaves required fields blank
# What PyDyna writes otherwise than the manual has it, and not by the values of the fields.
ODD = {"*ELEMENT_SOLID_H8TOH20": "no second line of nodes", "*ELEMENT_SOLID_TET4TOTET10": "no second line of nodes",
       "*DEFINE_SPH_ACTIVE_REGION": "cards of all shapes at once", "*DEFINE_SPH_DE_COUPLING": "an _ID line without _ID",
       "*DEFINE_ADAPTIVE_SOLID_TO_SPH": "an _ID line without _ID",
       "*CONSTRAINED_GENERALIZED_WELD_SPOT": "an _ID line without _ID",
       "*MAT_SPOTWELD_DAMAGE-FAILURE": "the second card of each OPT, one after the other",
       "*ELEMENT_SHELL_THICKNESS_OFFSET": "thicknesses of mid-side nodes that are not there",
       "*CONTROL_DYNAMIC_RELAXATION": "cards of all IDRFLG at once",
       "*DEFINE_FUNCTION": "a text that is no function",
       "*INTEGRATION_SHELL": "points beside ESOP 1, which places them itself",
       "*INTEGRATION_BEAM": "cards of all shapes at once",
       "*INITIAL_STRESS_SHELL_SET": "points of LARGE 0 beside LARGE 1",
       "*INITIAL_STRESS_SOLID": "points of LARGE 0 and 1 at once",
       "*INITIAL_STRESS_SOLID_SET": "points of LARGE 0 and 1 at once",
       "*MAT_3-PARAMETER_BARLAT": "cards of negative M beside a positive one",
       "*MAT_3PARAMETER_BARLAT": "cards of negative M beside a positive one",
       "*MAT_036": "cards of negative M beside a positive one",
       "*MAT_122": "cards of *MAT_122_TABULATED",
       "*MAT_084": "cards of its reinforcement",
       "*MAT_133": "cards of all FIT at once",
       "*MAT_BARLAT_YLD2000": "cards of all FIT at once",
       "*MAT_159": "the card of *MAT_159_CONCRETE beside that of *MAT_159",
       "*PERTURBATION_NODE": "cards of all TYPE at once",
       "*ELEMENT_SHELL_BETA_OFFSET": "thicknesses of mid-side nodes that are not there",
       "*RIGIDWALL_GEOMETRIC_CYLINDER_MOTION": "a card of sections that are not there",
       "*RIGIDWALL_GEOMETRIC_CYLINDER_DISPLAY": "a card of sections that are not there",
       "*RIGIDWALL_GEOMETRIC_CYLINDER_MOTION_DISPLAY": "a card of sections that are not there"}
VALUE = {int: 1, float: 2.5, str: "A"}


def same_field(keyword, message):
    """Whether a message is about a field that PyDyna has at the same position: the cards agree, the kinds of value do not."""
    found = re.search(r"card (\d+) field (\d+) \((\w+)", message)
    if not found:
        return False
    card, field = int(found[1]) - 1, int(found[2]) - 1
    cards = [getattr(one, "_fields", []) for one in keyword._cards]
    return card < len(cards) and field < len(cards[card]) and cards[card][field].name.upper() == found[3]


def filled(keyword):
    """Sets all fields of plain cards; tables keep their defaults."""
    for card in keyword._cards:
        for field in getattr(card, "_fields", []):
            try:
                if field.type in VALUE and field.name and hasattr(keyword, field.name):
                    setattr(keyword, field.name, VALUE[field.type])
            except Exception:  # not every value is allowed in PyDyna
                pass
    return keyword


listing = subprocess.run([courant, "keywords"], stdout=subprocess.PIPE, text=True).stdout
names = [line.split()[0] for line in listing.splitlines() if line.startswith("*")]
tried = 0
for name in names:
    if name not in TypeMapping or name in ODD or name in ("*KEYWORD", "*INCLUDE", "*COMMENT") or name.startswith(("*PARAMETER", "*INCLUDE")):
        continue
    make = TypeMapping[name]
    make = getattr(kwd, make) if isinstance(make, str) else make
    tried += 1
    for fill in (False, True):
        keyword = filled(make()) if fill else make()
        try:
            text = keyword.write()
        except Exception as fault:  # a keyword that PyDyna itself cannot write so
            print(f"{name}: PyDyna: {type(fault).__name__}")
            continue
        if len(text.strip().splitlines()) < 2:  # a table without a row
            continue
        _, stdout, stderr = check("pydyna_keyword.k", f"*KEYWORD\n{text}\n*CONTROL_TERMINATION\n       1.0\n*END\n")
        for message in re.findall(r"(?:error|warning): (.*)", stderr):
            if (WRONG_LAYOUT.search(message) and "*CONTROL_TERMINATION may stand" not in message and
                    not same_field(keyword, message)):
                failures.append(f"{name} {'filled' if fill else 'default'}: {message}\n{text}")
print(f"{tried} keywords")
assert tried >= 40, "too few keywords were tried"

# --- 3: names
everything = [name.upper() for name in TypeMapping if "/0" not in name and not name.startswith(("*END", "*KEYWORD", "*INCLUDE", "*PARAMETER", "*COMMENT"))]  # *MAT_084/085 is no name
AT_ONCE = 30  # a keyword without cards can give several errors, and reading stops after a hundred
for begin in range(0, len(everything), AT_ONCE):
    _, _, stderr = check("pydyna_names.k", "*KEYWORD\n" + "\n".join(everything[begin:begin + AT_ONCE]) + "\n*END\n")
    failures += re.findall(r".*unknown keyword\n.*", stderr)
    if "reading stopped" in stderr:
        failures.append(f"too many errors from {everything[begin]} on")
print(f"{len(everything)} names")
print("\n".join(failures))
sys.exit(f"{len(failures)} failed" if failures else 0)
