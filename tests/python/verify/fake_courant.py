#!/usr/bin/python3
"""A solver that solves nothing: it answers to `--version`, `generate` and `run` as `courant` does.

The decks it writes are the parameters; `run` ends as `how` says: well, refused, stopped, hangs or crashes. Each run is noted in COUNT.
"""

import os
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
words = sys.argv[1:]
if words == ["--version"]:
    print("courant 9.9")
    sys.exit()
out = Path(words[words.index("-o") + 1])
given = dict(words[k + 1].split("=", 1) for k, word in enumerate(words) if word == "--param")
if words[0] == "generate":
    if given.get("how") == "odd":
        sys.exit(f"{words[1]}:2:3: error: how: it is odd\n  hint: be even\n1 error")
    out.write_text("".join(f"{name}={value}\n" for name, value in given.items()) + "*END\n")
    sys.exit()

with open(os.environ["COUNT"], "a") as count:  # before what takes long on a busy machine: some calls end it soon
    count.write(f"{out.name}\n")

import numpy as np  # noqa: E402
from made_results import write_history  # noqa: E402

deck = dict(line.split("=", 1) for line in Path(words[1]).read_text().splitlines() if "=" in line) | given
how = deck.get("how", "well")
if how == "refused":
    sys.exit("deck.k:1:1: error: no such keyword")
if how == "crashes":
    os.kill(os.getpid(), signal.SIGSEGV)
if how == "hangs":
    time.sleep(60)
if how == "slow":
    time.sleep(float(deck.get("seconds", "0.5")))
t = np.linspace(0, 1, 11)
write_history(out / "history.h5", {"/global/time": t, "/global/kinetic": t**2 * (1 + 1 / float(deck.get("n", "10")) ** 2)})
(out / "summary.yaml").write_text(
    "termination: normal\nreason: done\nsteps: 10\nparticles: 4\nparticle_steps: 40\nenergy: {total: 1, ratio: 1}\n"
)
