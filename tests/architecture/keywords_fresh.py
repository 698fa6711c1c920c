#!/usr/bin/env python3
"""docs/keywords.md is what `courant keywords --markdown` writes.

usage: keywords_fresh.py COURANT PROJECT_FOLDER
"""
import difflib
import pathlib
import subprocess
import sys

courant, project = sys.argv[1:3]
written = subprocess.run([courant, "keywords", "--markdown"], check=True, stdout=subprocess.PIPE, text=True).stdout
kept = (pathlib.Path(project) / "docs" / "keywords.md").read_text()
difference = list(difflib.unified_diff(kept.splitlines(), written.splitlines(), "docs/keywords.md", "courant keywords --markdown", lineterm="", n=0))
if difference:
    print("\n".join(difference[:40]))
    sys.exit("docs/keywords.md is out of date: write it anew with `courant keywords --markdown > docs/keywords.md`")
assert written.count("\n## *") > 30, "the page lists hardly any keyword"
