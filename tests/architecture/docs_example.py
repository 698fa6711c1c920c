#!/usr/bin/env python3
"""The worked example in docs/contributing.md is the code that a unit test compiles.

usage: docs_example.py PROJECT_FOLDER
"""
import pathlib
import sys

MARKER = "// [example: keyword]\n"
PAGE, SOURCE = "docs/contributing.md", "tests/unit/keyword/example_keyword_test.cpp"


def faults(page, source):
    parts = source.split(MARKER)
    if len(parts) != 3:
        return [f"{SOURCE}: expected two lines {MARKER.strip()!r}"]
    example = "```cpp\n" + parts[1] + "```\n"
    return [] if example in page else [f"{PAGE} does not show the lines of {SOURCE} between the markers; copy them into it"]


def self_test():
    source = f"a\n{MARKER}b\n{MARKER}c\n"
    return faults("x\n```cpp\nb\n```\n", source) == [] and faults("x\n```cpp\nB\n```\n", source) != [] and faults("", "a\n") != []


if __name__ == "__main__":
    project = pathlib.Path(sys.argv[1])
    messages = faults((project / PAGE).read_text(encoding="utf-8"), (project / SOURCE).read_text(encoding="utf-8"))
    if not self_test():
        messages.append("self test failed")
    print("\n".join(messages) or "the example is the one that is compiled")
    sys.exit(1 if messages else 0)
