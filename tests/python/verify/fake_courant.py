#!/usr/bin/python3 -IS
"""A solver that solves nothing: it answers to `--version`, `generate` and `run` as `courant` does.

The decks it writes are the parameters; `run` ends as `how` says: well, refused, stopped, hangs or crashes. Each run is noted in COUNT.
Histories are copied from HISTORIES.
"""

import os
import signal
import sys
import time

words = sys.argv[1:]
if words == ["--version"]:
    print("courant 9.9")
    sys.exit()
out = words[words.index("-o") + 1]
given = dict(words[k + 1].split("=", 1) for k, word in enumerate(words) if word == "--param")
if words[0] == "generate":
    if given.get("how") == "odd":
        sys.exit(f"{words[1]}:2:3: error: how: it is odd\n  hint: be even\n1 error")
    with open(out, "w") as file:
        file.write("".join(f"{name}={value}\n" for name, value in given.items()) + "*END\n")
    sys.exit()

with open(os.environ["COUNT"], "a") as count:  # before what takes long on a busy machine: some calls end it soon
    count.write(f"{out}\n")

with open(words[1]) as file:
    deck = dict(line.rstrip("\n").split("=", 1) for line in file if "=" in line) | given
how = deck.get("how", "well")
if how == "refused":
    sys.exit("deck.k:1:1: error: no such keyword")
if how == "crashes":
    os.kill(os.getpid(), signal.SIGSEGV)
if how == "hangs":
    time.sleep(60)
if how == "slow":
    time.sleep(float(deck.get("seconds", "0.5")))
with open(f"{os.environ['HISTORIES']}/{deck.get('n', '10')}.h5", "rb") as made, open(f"{out}/history.h5", "wb") as file:
    file.write(made.read())
with open(f"{out}/summary.yaml", "w") as file:
    file.write("termination: normal\nreason: done\nsteps: 10\nparticles: 4\nparticle_steps: 40\nenergy: {total: 1, ratio: 1}\n")
