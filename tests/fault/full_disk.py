#!/usr/bin/env python3
"""Runs into a disk that becomes full, for real: a tmpfs of a few hundred kilobytes. Whatever file fails, the run ends with exit code 2 and says what to
do, everything that was written before stays whole, and once there is space the run goes on to the end it would have had.

usage: full_disk.py COURANT WORK_DIR
"""
import os
import re
import shutil
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree

if "COURANT_MOUNTS" not in os.environ:  # mounts of our own, which go with this process
    unshare = ["unshare", "--mount"] + ([] if os.geteuid() == 0 else ["--map-root-user"])
    inside = subprocess.run([*unshare, "true"], stderr=subprocess.PIPE, text=True)
    if inside.returncode:
        print(f"not tested: a mount is refused here: {inside.stderr.strip()}")
        sys.exit(77)
    os.environ["COURANT_MOUNTS"] = "1"
    os.execvp(unshare[0], [*unshare, sys.executable, *sys.argv])

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "regression"))
from checks import check, enter_empty_folder, failures  # noqa: E402
from restart_scene import cycle_of, deck, differences  # noqa: E402

import h5py  # noqa: E402  (restart_scene has looked for it)

courant, work = os.path.abspath(sys.argv[1]), os.path.join(os.path.abspath(sys.argv[2]), "full_disk")
enter_empty_folder(work)
os.makedirs("disk")
if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64m", "tmpfs", "disk"], stderr=subprocess.PIPE).returncode:
    print("not tested: the mount of a tmpfs is refused here")
    sys.exit(77)


def resize(bytes_):
    subprocess.run(["mount", "-o", f"remount,size={bytes_}", "disk"], check=True)


def used(folder):
    """What the files take, in whole pages."""
    return sum((os.path.getsize(os.path.join(where, name)) + 4095) // 4096 * 4096 for where, _, names in os.walk(folder) for name in names)


def call(*words):
    done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout


def fresh():
    for name in os.listdir("disk"):
        path = os.path.join("disk", name)
        shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def everything_is_whole(folder, what):
    faults = [f"{where}/{name}" for where, _, names in os.walk(folder) for name in names if name.endswith(".tmp")]
    if os.path.exists(f"{folder}/fields.pvd"):
        for entry in ElementTree.parse(f"{folder}/fields.pvd").iter("DataSet"):
            path = f"{folder}/{entry.get('file')}"
            if not os.path.exists(path) or not open(path, "rb").read().endswith(b"</VTKFile>\n"):
                faults.append(path)
    for name in ("glstat", "matsum", "rcforc", "sphout"):
        path = f"{folder}/{name}"
        if os.path.exists(path) and os.path.getsize(path) and not open(path).read().endswith("\n"):
            faults.append(path)
    if os.path.exists(f"{folder}/history.h5"):
        with h5py.File(f"{folder}/history.h5") as file:
            rows = len(file["global/time"])
            file.visititems(lambda name, item: faults.append(name) if isinstance(item, h5py.Dataset) and len(item[()]) != rows else None)
    for name in os.listdir(f"{folder}/restart"):
        if not name.endswith(".h5") or cycle_of(f"{folder}/restart/{name}") <= 0:
            faults.append(name)
    check(not faults, f"{what}: what is there is whole {faults}")


def told(code, text, what):
    found = re.search(r"cannot write '(disk/run/\S+)': No space left on device\n  hint: free some space, or choose a folder on another disk", text)
    check(code == 2 and found is not None, f"{what}: exit code {code}, {found.group(1) if found else text[-600:]}")
    return found.group(1) if found else ""


deck("flow", runrsf=70, d3dump=120)
check(call("run", "flow.k", "-o", "whole", "--quiet", "--threads", "1")[0] == 0, "the run, where there is room")
size, failed = used("whole"), set()
for share in (0.12, 0.3, 0.5, 0.62, 0.75, 0.88, 0.97):
    fresh()
    resize(int(share * size) // 4096 * 4096)
    what = f"room for {100 * share:.0f} %"
    code, text = call("run", "flow.k", "-o", "disk/run", "--threads", "2")
    failed.add(re.sub(r"\d+", "N", os.path.basename(told(code, text, what))))
    everything_is_whole("disk/run", what)
    resize(8 * size)
    files = os.listdir("disk/run/restart")
    go_on = re.search(r"to go on from the latest whole state: courant (.*)", text)
    check(bool(files) == (go_on is not None), f"{what}: the message names a restart file if there is one: {files}")
    code, text = call(*(go_on.group(1).split() if go_on else ["run", "flow.k", "-o", "disk/run"]), "--quiet")
    wrong = differences("whole", "disk/run")
    check(code == 0 and not wrong, f"{what}: with more room {'it goes on' if go_on else 'a new run goes'} to the same end {wrong[:5]} {text[-300:] if code else ''}")
print(f"files that failed first: {sorted(failed)}")

# --- each kind of file by itself: the disk becomes full while the run goes
def ballast():
    with open("disk/ballast", "wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError:
            pass


def run_into_full_disk(name, settings):
    """Exit code and text of a run whose disk becomes full after its first step."""
    fresh()
    resize(8 << 20)
    deck(name, end=1000, **settings)
    more = ["--no-final-dump"] if name == "summary" else []
    process = subprocess.Popen([courant, "run", name + ".k", "-o", "disk/run", "--threads", "1", *more], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True, stdin=subprocess.DEVNULL)
    end = time.time() + 60
    while time.time() < end and "first step" not in (open("disk/run/messag").read() if os.path.exists("disk/run/messag") else ""):
        time.sleep(0.02)
    time.sleep(0.3)
    ballast()
    if name == "summary":
        process.terminate()
    text = process.communicate(timeout=120)[0]
    return process.returncode, text


for name, settings, expected in (("fields", {"runrsf": 0, "histories": False, "plot": 0.02}, r"fields/|fields.pvd"),
                                 ("histories", {"runrsf": 0, "plot": 0}, r"glstat|matsum|rcforc|sphout|history.h5"),
                                 ("restart", {"runrsf": 20, "plot": 0, "histories": False}, r"restart/runrsf.h5"),
                                 ("summary", {"runrsf": 0, "plot": 0, "histories": False}, r"summary.yaml|messag")):
    for attempt in range(5):
        code, text = run_into_full_disk(name, settings)
        file = told(code, text, name)
        if re.search(expected, file) or not file.endswith("messag"):
            break
        print(f"{name}: a line of messag began a new page of the disk before that: once more")
    check(re.search(expected, file) is not None, f"{name}: {file} is the file that failed")
    everything_is_whole("disk/run", name)
    os.remove("disk/ballast")
    resize(16 << 20)  # a fast run had filled most of it by itself
    files = os.listdir("disk/run/restart")
    code, text = call("run", name + ".k", "-o", "disk/run", *(["--restart", "disk/run"] if files else []), "--until", "0.3", "--quiet")
    check(code == 0 and os.path.exists("disk/run/summary.yaml"), f"{name}: with room again it {'goes on' if files else 'runs'} {text[-300:] if code else ''}")

sys.exit(1 if failures else 0)
