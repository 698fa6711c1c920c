#!/usr/bin/env python3
"""What is there under the name of a result: devices, pipes, links and inputs stay as they are, whichever call writes, and no call waits for the other end
of a pipe. Titles reach the terminal and files without what acts on a terminal.

usage: written_files.py COURANT WORK_DIR
"""
import os
import re
import stat
import subprocess
import sys

from checks import check, enter_empty_folder, failures

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "written_files")
enter_empty_folder(work)


def call(*words, timeout=60):
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout.decode("utf-8", "replace")


def write(name, text):
    with open(name, "w") as file:
        file.write(text)


def content(name):
    with open(name, "rb") as file:
        return file.read()


DECK = """*KEYWORD
*TITLE
{title}
*NODE
1,0.,0.,0.
2,1.,0.,0.
3,1.,1.,0.
4,0.,1.,0.
5,0.,0.,1.
6,1.,0.,1.
7,1.,1.,1.
8,0.,1.,1.
*ELEMENT_SOLID
1,1,1,2,3,4,5,6,7,8
*PART
{part}
1,1,1
*SECTION_SOLID
1,1
*MAT_ELASTIC
1,1000.,1.e7,.3
*INITIAL_VELOCITY_NODE
1,1.,0.,0.
*CONTROL_TERMINATION
{end}
*DATABASE_GLSTAT
{dt}
*DATABASE_MATSUM
1.e-4
{more}*END
"""


def deck(name, title="cube", part="p", end="1.e-3", dt="1.e-4", more=""):
    write(name, DECK.format(title=title, part=part, end=end, dt=dt, more=more))


# --- a file that the user names

scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "keyword_decks", "first_scene", "scene.yaml")
assert call("generate", scene, "-o", "whole.k")[0] == 0
code, said = call("generate", scene, "-o", "/dev/null")
check(code == 0 and stat.S_ISCHR(os.stat("/dev/null").st_mode), f"/dev/null stays a device {said if code else ''}")
done = subprocess.run([courant, "generate", scene, "-o", "/dev/stdout"], stdout=subprocess.PIPE, timeout=60)
check(done.stdout.startswith(content("whole.k")), "a deck goes to /dev/stdout")
os.mkfifo("pipe")
code, said = call("generate", scene, "-o", "pipe")
check(code == 1 and "a pipe without a reader" in said, f"a pipe is not waited for: {said.strip()[-200:]}")
os.symlink("whole.k", "link.k")
before = content("whole.k")
code, said = call("generate", scene, "-o", "link.k")
check(code == 1 and "it is a link" in said and os.path.islink("link.k") and content("whole.k") == before, "a link stays, and so does what it leads to")
for name in ("deck.k.tmp", "deck.k.part"):
    write(name, "mine")
check(call("generate", scene, "-o", "deck.k")[0] == 0 and content("deck.k.tmp") == content("deck.k.part") == b"mine", "what is beside a deck stays")

# --- the file of a relaxation
HELD = "*SET_NODE_LIST\n7\n1,2,3,4\n*BOUNDARY_SPC_SET\n7,0,1,1,1\n*LOAD_BODY_Z\n9\n*DEFINE_CURVE\n9,2\n0.,1.\n9.,1.\n"
RELAX = HELD + "*CONTROL_DYNAMIC_RELAXATION\n20,0.5,0.9,0.01,0,0,1\n"
deck("relaxed.k", more=RELAX)
code, said = call("run", "relaxed.k", "-o", "relaxed", "--quiet")
check(code == 0 and b"kinetic" in content("relaxed/relax"), f"a relaxation is written down {said if code else ''}")
os.mkdir("taken")
os.rename("relaxed.k", "taken/relax")
before = content("taken/relax")
code, said = call("run", "taken/relax", "-o", "taken", "--quiet")
check(code == 1 and "it is the input" in said and content("taken/relax") == before, f"an input of the name `relax` stays: {said.strip()[-200:]}")
os.rename("taken/relax", "relaxed.k")
write("mine", "mine")
os.symlink("../mine", "taken/relax")
code, said = call("run", "relaxed.k", "-o", "taken", "--quiet")
check(code == 1 and "it is a link" in said and content("mine") == b"mine", "no link of that name is followed")
os.remove("taken/relax")
os.mkfifo("taken/relax")
code, said = call("run", "relaxed.k", "-o", "taken", "--quiet")
check(code == 1 and "it is no file" in said, "no pipe of that name is waited for")
os.remove("taken/relax")
deck("plain.k")
write("taken/relax", "notes of mine\n")
code, said = call("run", "plain.k", "-o", "taken", "--quiet")
check(code == 0 and content("taken/relax") == b"notes of mine\n", "another's file of that name stays where nothing is relaxed")
code, said = call("run", "plain.k", "-o", "relaxed", "--quiet")
check(code == 0 and not os.path.exists("relaxed/relax"), "that of an earlier run goes")

# --- a library to load
code, said = call("run", "plain.k", "-o", "never", "--load", "pipe")
check(code == 1 and "no file" in said, f"no pipe is loaded: {said.strip()[-200:]}")
linked = subprocess.run(["ldd", courant], stdout=subprocess.PIPE, text=True).stdout
library = re.search(r"=> (/\S*libm\.so\S*)", linked)
if library:
    code, said = call("run", "plain.k", "-o", "never", "--load", library.group(1))
    check(code == 1 and "does not say which headers" in said, f"no library of others is taken for an extension: {said.strip()[-200:]}")
check(not os.path.exists("never"), "nothing was written for these")

# --- titles
deck("title.k", title="\x1b[31mred\x9b32m\x1b]0;owned\x07 gr\u00fcn", part="\x1b[2Jpart")
for words in (("check", "title.k"), ("run", "title.k", "-o", "title")):
    code, said = call(*words)
    check(code == 0 and not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f]", said) and "gr\u00fcn" in said, f"{words[0]}: nothing that acts on a terminal")
for name in ("messag", "glstat", "matsum", "summary.yaml", "fields.pvd"):
    if os.path.exists(f"title/{name}"):
        text = content(f"title/{name}").decode("utf-8", "replace")
        check(not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f]", text), f"{name}: no control characters")

# --- output that is asked for too often, and texts too long
for what, words in (("glstat", {"dt": "1e-300"}), ("d3plot", {"more": "*DATABASE_BINARY_D3PLOT\n1e-300\n"}),
                    ("a curve of intervals", {"more": "*DATABASE_NODOUT\n0,0,7,1\n*DEFINE_CURVE\n7\n0.,1e-30\n9.,1e-30\n"})):
    deck("often.k", **words)
    code, said = call("run", "often.k", "-o", "never")
    check(code == 1 and re.search(r"often.k:\d+:.*is due .* times until ENDTIM", said) is not None, f"{what}: refused by name: {said.strip()[-300:]}")
deck("long.k", title="x" * 50_000_000)
code, said = call("run", "long.k", "-o", "long", timeout=120)
check(code == 0 and "the first 500 of 50000000 characters" in said and os.path.getsize("long/messag") < 100_000, f"a title of 50 MB is cut {said[-300:] if code else ''}")

# --- runs that come to nothing
for value in ("1e300", "1e200"):
    deck("stiff.k", more=f"*DAMPING_GLOBAL\n0,{value}\n")
    code, said = call("run", "stiff.k", "-o", "stiff", "--quiet", timeout=120)
    check(code == 2 and re.search(r"became|gets nowhere|ran away|no finite", said) is not None, f"damping {value}: the run ends by itself: {said.strip()[-300:]}")

sys.exit(1 if failures else 0)
