#!/usr/bin/env python3
"""`cmake --install`, then examples/embed built against the installed package with find_package, and run on a deck.

usage: embed.py BUILD_FOLDER SOURCE_DIR WORK_DIR
"""
import os
import shutil
import subprocess
import sys

build, source, work = sys.argv[1:4]
prefix, example = os.path.join(work, "installed"), os.path.join(work, "embed")


def call(*words):
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        print(done.stdout)
        sys.exit(f"{' '.join(words)} ended with exit code {done.returncode}")
    return done.stdout


call("cmake", "--install", build, "--prefix", prefix)
rooms = os.listdir(os.path.join(prefix, "include", "courant"))
assert "model" in rooms and not {"generate", "post", "verify"} & set(rooms), f"headers of programs around the library are installed: {rooms}"
share = os.path.join(prefix, "share")
pages = set(os.listdir(os.path.join(share, "man", "man1")))
assert {"courant.1", "courant-run.1", "courant-check.1"} <= pages, f"pages of the manual are installed: {pages}"
assert os.path.exists(os.path.join(share, "bash-completion", "completions", "courant")), "completion for bash is installed"
shutil.rmtree(example, ignore_errors=True)  # what another generator left there would stop this one
call("cmake", "-G", "Ninja", "-S", os.path.join(source, "examples", "embed"), "-B", example, f"-DCMAKE_PREFIX_PATH={prefix}")
call("cmake", "--build", example)
text = call(os.path.join(example, "parts_of_deck"), os.path.join(source, "keyword_decks", "hydraulic_jump", "d4_5s.k"))
print(text)
assert "880" in text and "6000" in text and "kinetic energy" in text
