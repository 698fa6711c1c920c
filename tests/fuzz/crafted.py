#!/usr/bin/env python3
"""The whole program on crafted inputs, each in a process of its own: decks, scenes, restart files, histories and libraries, changed at random from sound
ones. Made for a build with sanitizers (docs/reliability.md), but it looks at exit codes of any.

usage: crafted.py COURANT PROJECT_FOLDER WORK_DIR [COUNT] [SEED]      COUNT: inputs of all kinds together, 500 if not given
"""
import collections
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import zlib
from pathlib import Path

courant, project, work = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve() / "crafted"
count = int(sys.argv[4]) if len(sys.argv) > 4 else 500
draw = random.Random(int(sys.argv[5]) if len(sys.argv) > 5 else 1)
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)
os.chdir(work)
WORDS = [b"1e300", b"-1e300", b"nan", b"inf", b"1e-300", b"0", b"-1", b"2147483648", b"9223372036854775807", b"99999999999999999999", b"&a", b"*", b"$", b",", b"\x1b[31m",
         b"\xff", b"\x00", b"1.e", b"*END", b"*INCLUDE", b" ", b"\t", b"<1/0>", b"--", b"a" * 5000]
FINDING = re.compile(rb"AddressSanitizer|UndefinedBehavior|LeakSanitizer|runtime error:|terminate called")


def changed(data, most=6):
    """A few changes of words, lines and bytes."""
    for _ in range(draw.randint(1, most)):
        kind, lines = draw.randrange(7), data.split(b"\n")
        at, to = draw.randrange(len(lines)), draw.randrange(len(lines))
        if kind < 3:  # a field
            fields = re.split(rb"([, ]+)", lines[at])
            fields[draw.randrange(len(fields))] = draw.choice(WORDS)
            lines[at] = b"".join(fields)
        elif kind == 3:
            lines.insert(to, lines[at])
        elif kind == 4:
            del lines[at]
        elif kind == 5:
            lines[at], lines[to] = lines[to], lines[at]
        else:
            raw = bytearray(data or b"x")
            raw[draw.randrange(len(raw))] = draw.randrange(256)
            lines = bytes(raw).split(b"\n")
        data = b"\n".join(lines)
    return data


def with_other_numbers(data):
    """A deck with one to three numbers changed by up to a million times, or in sign, whichever keyword they are of."""
    blocks = re.split(rb"^(?=\*)", data, flags=re.M)
    for _ in range(draw.randint(1, 3)):
        at = draw.randrange(1, len(blocks))
        numbers = list(re.finditer(rb"(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?(?![\w.])", blocks[at]))
        if not numbers:
            continue
        one = draw.choice(numbers)
        value = float(one[0]) * draw.choice([-1, 0, 1, 2, 0.5, 10 ** draw.uniform(-6, 6)])
        text = f"{value:.3g}" if b"." in one[0] or abs(value) < 1e-3 else f"{int(value)}"
        blocks[at] = blocks[at][:one.start()] + text.encode()[:10].rjust(len(one[0])) + blocks[at][one.end():]
    return b"".join(blocks)


def signed(image, trailer):
    """Bytes of a restart file with a trailer that fits."""
    begin = trailer[:-9]
    return image + begin + b"%08x\n" % zlib.crc32(image + begin)


def changed_state(data):
    """A restart file with a changed word, of a checksum that fits or not."""
    image, trailer = bytearray(data[:-74]), data[-74:]
    for _ in range(draw.randint(1, 4)):
        at = draw.randrange(0, len(image) - 8)
        image[at:at + 8] = struct.pack("<q", draw.choice([0, -1, 1, 1 << 31, 1 << 62, draw.getrandbits(63)])) if draw.random() < 0.5 else draw.randbytes(8)
    whole = bytes(image) + trailer if draw.random() < 0.5 else signed(bytes(image), trailer)
    return whole[:draw.randrange(1, len(whole))] if draw.random() < 0.2 else whole


def call(*words):
    try:
        done = subprocess.run([courant, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, timeout=120)
    except subprocess.TimeoutExpired:
        return -1, b"it does not end"
    return done.returncode, done.stdout


found, codes = [], collections.Counter()


def look(kind, name, words):
    code, said = call(*words)
    codes[kind, code] += 1
    if code not in (0, 1, 2, 3) or FINDING.search(said):
        found.append(name)
        print(f"FAILED  {' '.join(words)}: {code}, {said[-1500:].decode('utf-8', 'replace')}", flush=True)
    elif os.path.exists(name):
        os.remove(name)
    shutil.rmtree("out", ignore_errors=True)


decks = sorted([*(project / "tests/decks/accept").glob("*.k"), *(project / "tests/decks/warn").glob("*.k"), *(project / "tests/fuzz/seeds").glob("*.k")])
scenes = sorted((project / "keyword_decks").glob("*/scene.yaml"))
small = project / "tests/fuzz/results.k"
assert decks and scenes and small.exists()
for scene in scenes:
    call("generate", str(scene), "-o", f"{scene.parent.name}.k")
runnable = [deck for deck in [small, *decks, *sorted(Path().glob("*.k"))] if call("check", str(deck))[0] == 0]
code, said = call("run", str(small), "-o", "whole", "--quiet", "--threads", "1")
states = sorted(Path("whole/restart").glob("*.h5"))
assert states, said
for k in range(count):
    share = k % 10
    if share < 3:
        name = f"{k}.k"
        Path(name).write_bytes(changed(draw.choice(decks).read_bytes()))
        look("check of a deck", name, ["check", name])
    elif share < 6:
        name = f"{k}.k"
        deck = draw.choice(runnable)
        data = deck.read_bytes().replace(b"../decks/", os.fsencode(project / "tests/decks") + b"/")
        data = changed(data, 1) if draw.random() < 0.3 else with_other_numbers(data)
        Path(name).write_bytes(data.replace(b"*END", b"*CONTROL_CPU\n0.5\n*END"))  # not among what is changed
        look("run of a deck", name, ["run", name, "-o", "out", "--quiet", "--threads", "2"])
    elif share < 8:
        name = f"{k}.h5"
        Path(name).write_bytes(changed_state(draw.choice(states).read_bytes()))
        look("restart file", name, ["run", str(small), "-o", "out", "--quiet", "--threads", "1", "--restart", name])
    elif share < 9:
        name = f"{k}.yaml"
        scene = draw.choice(scenes)
        Path(name).write_bytes(changed(scene.read_bytes().replace(b"base: ", b"base: " + os.fsencode(scene.parent) + b"/")))
        look("scene", name, ["generate", name, "-o", "out.k"])
    else:
        name = f"{k}.so"
        Path(name).write_bytes(changed(Path(courant).read_bytes()[:draw.randrange(1, 20000)]))
        look("library", name, ["keywords", "NODE", "--load", "./" + name])
for (kind, code), number in sorted(codes.items()):
    print(f"{kind}: {number} with exit code {code}")
print(f"{count} inputs, {len(found)} findings")
sys.exit(1 if found else 0)
