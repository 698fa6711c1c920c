#!/usr/bin/env python3
"""The command line as a user meets it: exit codes, messages, and what is left on the disk when things go wrong.

usage: cli.py COURANT SOURCE_DIR WORK_DIR
"""
import glob
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree

from checks import check, enter_empty_folder, failures

signal.signal(signal.SIGHUP, signal.SIG_DFL)  # under nohup it is ignored, also by what is started here

try:
    import h5py
except ImportError:
    h5py = None
    print("Python's h5py is not here: the content of history.h5 is not looked at")

courant, source, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), os.path.join(os.path.abspath(sys.argv[3]), "cli")
enter_empty_folder(work)


def call(*words, limit=None, cwd=None):
    """Exit code, stdout, stderr. `limit`: largest file the call may write [bytes], as `ulimit -f` sets it."""
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=cwd, timeout=120,
                          preexec_fn=limit and (lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))))
    return done.returncode, done.stdout, done.stderr


def ends(code, *words, err="", out="", what=None, **options):
    """One call that must end with `code` and say `err` and `out` (regular expressions)."""
    got, stdout, stderr = call(*words, **options)
    holds = got == code and re.search(err, stderr) is not None and re.search(out, stdout) is not None
    check(holds, what or f"courant {' '.join(words)} -> {code}")
    if not holds:
        print(f"        exit code {got}, expected {code}\n        stdout: {stdout[-800:]!r} expected {out!r}\n"
              f"        stderr: {stderr[-800:]!r} expected {err!r}")
    return stdout, stderr


def summary(folder):
    """The top-level scalars of summary.yaml; this test must do without Python's yaml."""
    with open(os.path.join(folder, "summary.yaml")) as file:
        return dict(m.groups() for m in re.finditer(r'^(\w+): "?([^"\n]+)', file.read(), re.M))


def states(folder):
    """The states that fields.pvd lists; every file must be there and be closed."""
    files = [d.get("file") for d in ElementTree.parse(os.path.join(folder, "fields.pvd")).iter("DataSet")]
    for name in files:
        with open(os.path.join(folder, name), "rb") as file:
            check(file.read().rstrip().endswith(b"</VTKFile>"), f"{folder}/{name} is whole") if name == files[-1] else None
    return files


def until(condition, process, seconds=60):
    end = time.time() + seconds
    while time.time() < end and process.poll() is None:
        if condition():
            return True
        time.sleep(0.02)
    return False


def running(folder, *words):
    """A long run that has written three states."""
    process = subprocess.Popen([courant, "run", "tiny.k", "-o", folder, "--threads", "1", "--until", "1000", *words],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    begun = until(lambda: os.path.exists(os.path.join(folder, "fields", "particles_0003.vtp")), process)
    check(begun, f"the run in {folder} is under way")
    return process


# --- a deck, and the calls that only read
scene = os.path.join(source, "keyword_decks", "still_water", "scene.yaml")
ends(0, "generate", scene, "-o", "tiny.k", "--param", "resolution=8", "--param", "endtim=0.05", "--param", "dt_plot=0.01", out="wrote tiny.k")
ends(1, "generate", scene, "-o", "no.k", "--param", "resolutoin=8", err="resolutoin")
ends(1, "generate", scene, "-o", "no.k", "--param", "resolution", err="NAME=VALUE")
ends(1, "generate", scene, "-o", "/proc/no.k", err="/proc/no.k")
ends(1, "generate", "missing.yaml", "-o", "no.k", err="missing.yaml")
ends(1, "generate", ".", "-o", "no.k", err="the scene cannot be read")
check(not os.path.exists("no.k"), "generate leaves nothing behind")
ends(0, "check", "tiny.k", out=r"64 particles of which 64 are active.*\n(.*\n)*First step .* set by")
ends(0, "--version", out=r"\d+\.\d+\.\d+")
ends(0, "help", out="check")
ends(0, "help", "run", out="--until")
ends(0, "run", "--help", out="--until")
ends(1, "help", "nonsense")
ends(1, "nonsense", err="'nonsense' is no call of courant\n  hint: the calls are run, check")
ends(1, "chekc", "tiny.k", err="did you mean `courant check`")
ends(1, "i=tiny.k", "ncpu=two", err="two")
ends(1, err=r"(?s)Usage: courant .*\n  run .*\n  check .*courant check DECK.k")
ends(1, "run", err="DECK")
ends(1, "run", "tiny.k", "--no-such-option", err="`courant run` has no option '--no-such-option'\n  hint: its options are .*--until")
for mistyped, meant in (("--ouput", "--output"), ("-output", "--output"), ("--thread=2", "--threads"), ("--unti", "--until")):
    ends(1, "run", "tiny.k", mistyped, "x", err=f"has no option '{mistyped.split('=')[0]}'\n  hint: did you mean {meant}\\?")
ends(1, "check", "--jsn", err="did you mean --json")
ends(1, "--versoin", err="did you mean --version")
ends(1, "run", "tiny.k", "--until", "soon", err="soon")
ends(1, "run", "tiny.k", "--until", "-1", err="-1")
for time_of_no_end in ("nan", "inf"):
    ends(1, "run", "tiny.k", "--until", time_of_no_end, err=time_of_no_end)
ends(0, "keywords", out=r"(?s)\*MAT_ALE_VISCOUS +refused .*\*MAT_NULL +honoured +fluid.*\nhonoured: all")
ends(0, "keywords", "section_sph", out=r"^\*SECTION_SPH.*\n(partly|honoured)(.*\n)*.*CSLH")
ends(0, "keywords", "*MAT_RIGID_TITLE", out="CMO")
ends(1, "keywords", "MAT_NUL", err="did you mean")
ends(0, "keywords", "MAT", out=r"(?s)\*MAT_NULL.*\*MAT_RIGID")
ends(0, "keywords", "sph", out=r"(?s)\*CONTROL_SPH.*\*SECTION_SPH")
ends(0, "keywords", "SET_NODE", out=r"(?s)SID .*Other keywords with this name in theirs:.*\*SET_NODE_LIST_GENERATE")
ends(1, "keywords", "AIRBAG_ALE", err="AIRBAG_ALE: airbags are not supported")
ends(1, "keywords", "DATABASE_FSI", err="decks with it run, with a warning")

# --- pages of the manual and completion tell of every call and option, and no others
ends(0, "manual", "manual")
calls = re.findall(r"^  (\w+) ", call()[2].split("Subcommands:")[1], re.M)
check({"run", "check", "keywords", "generate", "post", "verify", "help"} <= set(calls), f"calls: {calls}")
check(sorted(os.listdir("manual")) == sorted(["courant", "courant.1"] + [f"courant-{one}.1" for one in calls]), "a page for each call")


def completed(*words):
    """What bash offers for the last of the words."""
    script = ('source manual/courant; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _courant; printf "%s\\n" "${COMPREPLY[@]}"')
    done = subprocess.run(["bash", "-c", script, "bash", courant, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    check(done.stderr == "", f"completion is quiet: {done.stderr}")
    return done.stdout.split()


for one in calls:
    page = open(f"manual/courant-{one}.1").read().replace("\\-", "-")
    options = set(re.findall(r"(?<![\w-])(--[a-z][a-z0-9-]*)", call("help", one)[1].split("Options:")[1]))
    check(set(re.findall(r"^\.BI? \"?.*?(--[a-z0-9-]+)", page, re.M)) == options and "--help" in options, f"manual/courant-{one}.1: {options}")
    check(options <= set(completed(one, "-")), f"bash completes the options of {one}: {completed(one, '-')}")
check(set(calls) <= set(completed("")) and completed("ver") == ["verify"], "bash completes calls")
check(completed("keywords", "MAT_NU") == ["MAT_NULL"] and completed("keywords", "mat_nu") == ["MAT_NULL"], "bash completes names of keywords")
ends(1, "manual", "/proc/x", err="cannot write '/proc/x'")

# --- a run that ends well
stdout, _ = ends(0, "run", "tiny.k", "-o", "well", "--threads", "1", out="N o r m a l    t e r m i n a t i o n")
said = open("well/messag").read()
begin = stdout[:stdout.index("first step")]
check(begin.count("\n") < 12 and re.search(r"^\d+ passes make a step, 4 outputs are asked for, \d+ of both are left out; `messag` lists them$", begin, re.M),
      f"before the first step a run is short: {begin}")
check("a step, by stages" in said and "not needed by this deck" in said and "a step, by stages" not in stdout, "passes stand in messag")
check("d3plot file" not in said and len(re.findall(r"write field state \d", said)) == 7, "messag tells of field states, not of files that are not there")
good = summary("well")
check(good["termination"] == "normal" and abs(float(good["time"]) - 0.05) < 0.01, f"summary: {good['termination']} at {good['time']}")
check(len(states("well")) == 14, "states of particles and walls at 0, 0.01, ... 0.05 and the end")
check(not glob.glob("well/**/*.tmp", recursive=True), "no temporary file is left")
stdout, _ = ends(0, "run", "tiny.k", "-o", "quiet", "--quiet", "--until", "0.02")
check(stdout == "", "--quiet prints nothing")
check(abs(float(summary("quiet")["time"]) - 0.02) < 0.01, "--until ends the run")
check(summary("quiet")["threads"] == "1", "a small scene takes one thread by itself")
os.makedirs("habit")
ends(0, "i=../tiny.k", "ncpu=2", "memory=20m", cwd="habit")
check(summary("habit")["threads"] == "2" and os.path.exists("habit/glstat"), "i=DECK ncpu=2 runs here on two threads")

# --- parameters of a deck
text = open("tiny.k").read()
name = "*CONTROL_TERMINATION\n"
at = text.index("\n", text.index(name) + len(name)) + 1  # below the comment line
with open("parameter.k", "w") as file:
    file.write(text[:at].replace("*KEYWORD\n", "*KEYWORD\n*PARAMETER\nR     tend      0.05\n") + "     &tend" + text[at + 10:])
ends(0, "run", "parameter.k", "-o", "parameter", "--param", "tend=0.03", "--quiet")
check(abs(float(summary("parameter")["time"]) - 0.03) < 0.01, "--param tend=0.03 overrides *PARAMETER")
ends(1, "run", "parameter.k", "-o", "never", "--param", "tedn=1", err="tedn.*\n.*did you mean tend")
ends(1, "run", "parameter.k", "-o", "never", "--param", "tend=soon", err="soon")
ends(1, "run", "parameter.k", "-o", "never", "--param", "tend", err="NAME=VALUE")

# --- bad input: exit code 1, nothing written
with open("bad.k", "w") as file:
    file.write(text.replace("*MAT_NULL", "*MAT_NUL"))
ends(1, "run", "bad.k", "-o", "never", err=r"bad.k:\d+:1: error: \*MAT_NUL: unknown keyword\n  hint: did you mean \*MAT_NULL\?\n"
     "1 error; nothing was run, nothing written")
ends(1, "check", "bad.k", err="did you mean")
ends(1, "run", "missing.k", "-o", "never", err="missing.k: error: cannot read the deck")
ends(1, "run", ".", "-o", "never", err="cannot read the deck")
with open("binary.k", "wb") as file:
    file.write(bytes(range(256)) * 64)
ends(1, "run", "binary.k", "-o", "never", err="binary.k:1:1: error: the file holds 64 NUL bytes")
with open("warns.k", "w") as file:
    file.write(text.replace("*END", "*DATABASE_NODOUT\n       0.1\n*END"))
ends(0, "check", "warns.k", err="warning: .DATABASE_NODOUT")
ends(1, "check", "warns.k", "--strict", err="1 warning")
ends(1, "run", "tiny.k", "-o", "never", "--restart", "d3dump01", err="cannot restart from .d3dump01.: No such file")
check(not os.path.exists("never"), "no folder was made")

# --- a folder that was used before: nothing of the old run stays, nothing that is not its own goes
with open("well/notes.txt", "w") as file:
    file.write("mine")
ends(0, "run", "tiny.k", "-o", "well", "--threads", "1", "--quiet", "--until", "0.015")
check(len(glob.glob("well/fields/*.vt?")) == len(set(states("well"))), "field files are those of the new run alone")
check(open("well/notes.txt").read() == "mine", "the files of others stay")

# --- results go neither over the input nor through links, and wait for nobody
os.makedirs("taken")
for name in ("messag", "glstat", "summary.yaml"):
    with open(f"taken/{name}", "w") as file:
        file.write(text)
    ends(1, "run", name, "--until", "0.01", cwd="taken", err=f"cannot write './{name}': it is the input '{name}'.*\n  hint: rename")
    check(open(f"taken/{name}").read() == text and os.listdir("taken") == [name], "the deck is as it was, and nothing beside it")
    os.remove(f"taken/{name}")
os.symlink("../tiny.k", "taken/history.h5")
ends(1, "run", "tiny.k", "-o", "taken", err="taken/history.h5': it is a link")
check(open("tiny.k").read() == text, "what the link leads to is as it was")
os.remove("taken/history.h5")
os.mkfifo("taken/messag")
ends(1, "run", "tiny.k", "-o", "taken", err="taken/messag': it is no file")

# --- what no machine has
ends(3, "run", "tiny.k", "-o", "never", "--threads", "100000", err="--threads 100000: no more than 1024")
with open("far.k", "w") as file:
    file.write(text.replace("*END", "*NODE\n99999991,1e160,0,0\n*END"))
ends(1, "check", "far.k", err="coordinates .* are too large")
with open("here.yaml", "w") as file:
    file.write("title: x\nbase: .\nparts: []\n")
ends(1, "generate", "here.yaml", "-o", "here.k", err="base: the file '.*' cannot be read")
strange = os.fsdecode(b"bad\xff.k")
with open(strange, "w") as file:
    file.write(text)
ends(0, "run", strange, "-o", "strange", "--quiet", "--until", "0.002")
check("deck: \"bad" in (said := open("strange/summary.yaml", encoding="utf-8").read()) or "deck: bad\ufffd.k" in said, "summary.yaml is UTF-8 whatever the name of the deck")

def with_addresses(megabytes, *words):
    """Exit code and stderr of a call that may use so many MB of addresses."""
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=120,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20)))
    return done.returncode, done.stderr


code, said = with_addresses(1000, "run", "tiny.k", "-o", "never", "--threads", "500")
check(code == 3 and "500 threads take" in said and "ulimit -v" in said, f"threads that do not fit -> {code}, {said!r}")

# --- check: what it says of good, refused and broken decks
stdout, _ = ends(0, "check", "tiny.k", "--strict", out=r"The deck can be run: 0 errors, 0 warnings\n$")
for part in (r"Files\n  tiny.k +\d+ lines", r"\*ELEMENT_SPH +1 +64  honoured", r"  nodes +\d+  from \(", r"  SPH particles +64 ",
             r"Units: kg-m-s \(N, Pa\)\n  the acceleration 9.81 is gravity, RO = 1000 is water",
             r"\n +1 \S.* 64 sph ", r"First step \S+ \[T\], set by sph \d+ of part 1\n", r"steps to ENDTIM = 0.05 at this size; on one thread"):
    check(re.search(part, stdout), f"check says {part!r}")
check(max(map(len, stdout.splitlines())) <= 100, "no line of the report is wider than 100 columns")
# --- check --json: the same for programs
found = json.loads(call("check", "tiny.k", "--json")[1])
check(found["can_be_run"] is True and found["errors"] == 0 and found["messages"] == [] and found["files"] == ["tiny.k"], f"JSON of a sound deck: {found}")
water = found["run"]["parts"][0]
# 8 x 8 particles in 0.5 m x 0.5 m of water, 30 m/s
check(water["kind"] == "sph" and water["elements"] == 64 and abs(water["mass"] - 250) < 1e-6 and water["sound_speed"] == 30
      and abs(water["spacing"] - 0.0625) < 1e-9 and found["run"]["particles"] == 64 and found["run"]["end_time"] == 0.05, f"its numbers: {found['run']}")
check(f"First step {found['run']['first_step']:.5g} [T], set by {found['run']['first_step_set_by']}\n" in stdout, "the first step is that of the text")
code, text_of_json, said = call("check", "bad.k", "--json")
found = json.loads(text_of_json)
check(code == 1 and said == "" and found["can_be_run"] is False and "run" not in found and found["errors"] == 1, "JSON of a deck that is refused")
check(found["messages"][0]["severity"] == "error" and found["messages"][0]["file"] == "bad.k" and found["messages"][0]["line"] > 0
      and found["messages"][0]["hint"] == "did you mean *MAT_NULL?", f"its message: {found['messages']}")
check([k["treatment"] for k in found["keywords"] if k["name"] == "MAT_NUL"] == ["refused"], "what becomes of keywords")
code, text_of_json, _ = call("check", "missing.k", "--json")
check(code == 1 and json.loads(text_of_json)["messages"][0]["file"] == "missing.k", "JSON of a deck that is not there")
check(json.loads(call("check", strange, "--json")[1])["files"] == ["bad\ufffd.k"], "JSON is UTF-8 whatever the name of the deck")
with open("refused.k", "w") as file:
    file.write(text.replace("*END", "*INCLUDE\nsolids.k\n*AIRBAG_ALE\n1\n*AIRBAG_ALE\n2\n*END"))
with open("solids.k", "w") as file:
    file.write("*NODE\n" + "".join(f"{900001 + i:8d}{i % 2:16d}{i // 2 % 2:16d}{i // 4:16d}\n" for i in range(8))
               + "*ELEMENT_SOLID_ORTHO\n" + 2 * ("  900001     900" + "".join(f"{900001 + i:8d}" for i in range(8)) + "\n"
                                                  + f"{1:16d}{0:16d}{0:16d}\n" + f"{0:16d}{1:16d}{0:16d}\n"))
stdout, stderr = ends(1, "check", "refused.k", out="What a run would need",
                      err=r"AIRBAG_ALE: airbags are not supported \(here and at 1 more line\)\n(.*\n)*2 errors, 0 warnings.*; the deck cannot be run\n$")
for part in (r"Files\n  refused.k .*\n    solids.k .*included by refused.k:\d+", r"  SPH particles +64 ", r"  solids +2\n",
             r"\*ELEMENT_SOLID_ORTHO .*REFUSED: directions of the material in solids", r"  not supported: airbags: \*AIRBAG_ALE\n"):
    check(re.search(part, stdout), f"check says {part!r} of a refused deck")
check("First step" not in stdout, "no step is promised for a deck that cannot be run")
ends(1, "check", "bad.k", out=r"(?s)\*MAT_NUL .*REFUSED: unknown", err="1 error")
ends(1, "check", "missing.k", err="cannot read the deck")
ends(1, "check", "binary.k", err="the file holds 64 NUL bytes")
with open("fragment.k", "w") as file:
    file.write("*KEYWORD\n*NODE\n       1\n*END\n")
ends(1, "check", "fragment.k", out=r"(?s)nodes +1 .*not in the deck: \*ELEMENT_SPH .*not in the deck: \*CONTROL_TERMINATION \(end time\)")
both = subprocess.run([courant, "check", "warns.k"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
order = [both.find(word) for word in ("Files", "Keywords", "Mesh", "warning: *DATABASE_NODOUT", "Parts in the run", "First step", "The deck can be run")]
check(order == sorted(order) and order[0] >= 0, f"what was read, what is wrong, what a run computes, the sum: {order}")

# --- check: a deck of 100 000 particles; the time of the processor, others may use the machine
side = 316
with open("large.k", "w") as file:
    file.write("*KEYWORD\n*CONTROL_SPH\n         1         0    1.0E20         2\n*CONTROL_TERMINATION\n       1.0\n*PART\nwater\n"
               "         1         1         1         1\n*SECTION_SPH\n         1       1.2       1.0       1.0\n*MAT_NULL\n"
               "         1    1000.0   -1.0E20\n*EOS_LINEAR_POLYNOMIAL\n         1       0.0     9.0E5\n*NODE\n")
    file.write("".join(f"{1 + i:8d}{0.01 * (i % side):16.8f}{0.01 * (i // side):16.8f}             0.0\n" for i in range(side * side)))
    file.write("*ELEMENT_SPH\n" + "".join(f"{1 + i:8d}       1             0.1\n" for i in range(side * side)) + "*END\n")
before = resource.getrusage(resource.RUSAGE_CHILDREN)
start = time.time()
ends(0, "check", "large.k", out=f"SPH particles +{side * side} ")
after = resource.getrusage(resource.RUSAGE_CHILDREN)
seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
check(seconds < 2, f"100 000 particles are checked in {seconds:.2f} s of processor time, {time.time() - start:.2f} s in all")

# --- folders that cannot be written: exit code 1
with open("in_the_way", "w") as file:
    file.write("a file\n")
ends(1, "run", "tiny.k", "-o", "in_the_way", err="cannot write 'in_the_way")
ends(1, "run", "tiny.k", "-o", "in_the_way/below", err="cannot write 'in_the_way/below'")
check(open("in_the_way").read() == "a file\n", "the file in the way is as it was")
ends(1, "run", "tiny.k", "-o", "/proc/x", err="cannot write '/proc/x'.*\n  hint: ")

# --- post
ends(1, "post", "missing.yaml", "well", err="missing.yaml")
ends(1, "post", ".", "well", err="cannot read the recipe")
os.makedirs("empty")
recipe = os.path.join(source, "keyword_decks", "hydraulic_jump", "post.yaml")
ends(1, "post", recipe, "empty", err="empty")
ends(1, "post", recipe, "no_such_folder", err="no_such_folder")

# --- the disk is full in the middle of a run: exit code 2, whatever file is the first to fail
for limit in (9000, 40000, 120000):
    folder = f"full_{limit}"
    ends(2, "run", "tiny.k", "-o", folder, "--threads", "1", "--until", "50", limit=limit, err="File too large\n  hint: raise the limit",
         what=f"files of at most {limit} bytes -> 2")
    end = summary(folder)
    check(end["termination"] == "error" and "File too large" in end["reason"], f"summary: {end['reason']}")
    check(not glob.glob(folder + "/**/*.tmp", recursive=True), "no temporary file is left")
    if os.path.exists(folder + "/fields.pvd"):
        check(len(states(folder)) >= 2, "fields.pvd is readable")
    for ascii_file in ("messag", "glstat", "matsum", "rcforc"):
        if os.path.getsize(f"{folder}/{ascii_file}") > 0:
            check(open(f"{folder}/{ascii_file}").read().endswith("\n"), f"{folder}/{ascii_file} ends with a whole line")
    if h5py and os.path.exists(folder + "/history.h5"):
        check(len(h5py.File(folder + "/history.h5")["global/time"]) > 0, "history.h5 is readable")

# --- signals
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    folder = f"stopped_{number.name}"
    process = running(folder)
    process.send_signal(number)
    process.communicate(timeout=60)
    end = summary(folder)
    check(process.returncode == 0 and end["termination"] == "interrupted", f"{number.name} -> {process.returncode}, {end['termination']}")
    check(len(states(folder)) >= 8, "fields.pvd is readable")
    check("stopped by a signal" in open(folder + "/messag").read(), "messag says why the run stopped")
with open("log", "w") as log:  # a file, where lines stay
    process = subprocess.Popen([courant, "run", "tiny.k", "-o", "logged", "--threads", "1", "--until", "1000"], stdout=log)
    shown = until(lambda: re.search(r"^t \d+\.\d+ of 1000 .* left$", open("log").read(), re.M), process, 30)
    process.send_signal(signal.SIGINT)
    process.wait(timeout=60)
check(shown and "\r" not in open("log").read(), f"a run tells its progress in a file, too: {open('log').read()[-300:]}")
process = subprocess.Popen([courant, "run", "tiny.k", "-o", "unread", "--threads", "1", "--until", "1000"],
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
until(lambda: os.path.exists("unread/fields/particles_0003.vtp"), process)
process.stdout.close()  # as `| head`, or a `tee` that Ctrl-C has ended
process.send_signal(signal.SIGINT)
process.wait(timeout=60)
end = summary("unread")
check(process.returncode == 0 and end["termination"] == "interrupted" and "--restart" in end["reason"],
      f"a run whose output nobody reads ends well: {process.returncode}, {end}")
os.makedirs("killed")
with open("killed/summary.yaml", "w") as file:
    file.write("termination: normal\n")
process = running("killed")
process.kill()
process.communicate()
check(len(states("killed")) >= 6, "fields.pvd is readable after kill -9")
check(not os.path.exists("killed/summary.yaml"), "a killed run has no summary, not even an older run's")

process = running("killed_later")
check(until(lambda: os.path.exists("killed_later/history.h5"), process), "history.h5 is there while the run goes on")
process.kill()
process.communicate()
listed = states("killed_later")
written = len(glob.glob("killed_later/fields/*.vt?"))
check(all(open(f"killed_later/{name}", "rb").read().endswith(b"</VTKFile>\n") for name in listed), "every file that fields.pvd lists is whole")
check(len(listed) >= 0.9 * written - 2, f"fields.pvd lists {len(listed)} of {written} files after kill -9")
if h5py:
    times = h5py.File("killed_later/history.h5")["global/time"][:]
    check(len(times) > 0 and all(a < b for a, b in zip(times, times[1:])), "history.h5 is readable after kill -9, its times in order")

# --- results that can no longer be written while the run goes on: whatever thread finds out, the run ends
process = running("gone")
os.rename("gone/fields", "gone/fields_away")
_, said = process.communicate(timeout=60)
end = summary("gone")
check(process.returncode == 2 and end["termination"] == "error", f"a folder that vanished -> {process.returncode}, {end['termination']}")
check(re.search(r"error: cannot write 'gone/fields/\w+_\d+\.vt[pu]': No such file or directory\n  hint: ", said), "the message names the file")
kept = sorted(glob.glob("gone/fields_away/particles_*.vtp"))
check([f"particles_{i:04d}.vtp" for i in range(len(kept))] == [os.path.basename(name) for name in kept], "states up to the failure are kept, none is missing")
check(open("gone/glstat").read().endswith("\n") and "E r r o r    t e r m i n a t i o n" in open("gone/messag").read(), "the text files are whole")
if h5py:
    check(len(h5py.File("gone/history.h5")["global/time"]) >= len(kept) - 1, "history.h5 has the samples up to the failure")

sys.exit(f"{len(failures)} failed" if failures else 0)
