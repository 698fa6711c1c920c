#!/usr/bin/env python3
"""docs/write_your_own.md is true: its code stands in the files of this folder, the pieces of the strength law make up the whole of it, the packages are
those that the scripts install, and the commands that compile and run do what the page says.

usage: page.py BUILD_FOLDER SOURCE_DIR
"""
import os
import re
import subprocess
import sys
import tempfile

build, source = (os.path.abspath(word) for word in sys.argv[1:3])
here = os.path.join(source, "tests", "extension")
failures = []


def check(holds, text):
    print(("ok      " if holds else "FAILED  ") + text, flush=True)
    if not holds:
        failures.append(text)


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


page = read(source, "docs", "write_your_own.md")
files = {name: read(here, name) for name in os.listdir(here) if name.endswith(".cpp")}
blocks = [(kind, text) for kind, text in re.findall(r"^```(\w*)\n(.*?)^```$", page, re.M | re.S)]
for kind, text in blocks:
    if kind == "cpp":
        check(any(text in whole for whole in files.values()), f"code from a file: {text.strip().splitlines()[0]}")

section = page.split("## A law of strength, line by line")[1].split("\n## ")[0]
law = "\n".join(text for text in re.findall(r"^```cpp\n(.*?)^```$", section, re.M | re.S))


def without_blank_lines(text):
    return [line for line in text.splitlines() if line.strip()]


check(without_blank_lines(law) == without_blank_lines(files["strength_law.cpp"]), "the pieces are all of strength_law.cpp")
for name in files:
    check(f"tests/extension/{name}" in page, f"the page names {name}")

packages = re.search(r"^build_packages=\((.*?)\)", read(source, "examples", "lib", "setup.sh"), re.M).group(1)
check(f"sudo apt-get install --no-install-recommends {packages}\n" in page, "the packages of the scripts")

with tempfile.TemporaryDirectory() as folder:
    for path in ("src", "tests"):
        os.symlink(os.path.join(source, path), os.path.join(folder, path))
    os.mkdir(os.path.join(folder, "build"))
    os.symlink(build, os.path.join(folder, "build", "release"))
    with open(os.path.join(folder, "maxwell.cpp"), "w", encoding="utf-8") as file:
        file.write(law)
    commands = [line for kind, text in blocks if kind == "" for line in text.splitlines()]
    flags = set()
    for command in commands:
        if command.startswith(("sudo ", "cmake ")):
            continue
        if command.startswith("g++ "):
            flags.add(command.split(" -isystem")[0])
            command = command.replace("g++ ", "g++ -Wall -Wextra -Werror ", 1)
        done = subprocess.run(command, shell=True, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300,
                              stdin=subprocess.DEVNULL)
        check(done.returncode == 0, command)
        if done.returncode != 0:
            print(done.stdout[-3000:])
    check(len(flags) == 1 and len(commands) > 12, f"{len(commands)} commands, one set of flags")
    check(os.path.exists(os.path.join(folder, "results", "wind", "momentum")), "a run left its history")

print(f"{len(failures)} failures")
sys.exit(1 if failures else 0)
