#!/usr/bin/env python3
"""docs/keywords.md and docs/cannot_do.md are what `courant keywords --markdown` and `--cannot-do` write.

usage: keywords_fresh.py COURANT PROJECT_FOLDER
"""
import difflib
import pathlib
import re
import subprocess
import sys

courant, project = sys.argv[1:3]
STATES = ("honoured", "partly", "no effect", "refused")


def call(*words):
    return subprocess.run([courant, "keywords", *words], check=True, stdout=subprocess.PIPE, text=True).stdout


written = {}
for name, option in (("keywords.md", "--markdown"), ("cannot_do.md", "--cannot-do")):
    written[name] = call(option)
    kept = (pathlib.Path(project) / "docs" / name).read_text()
    difference = list(difflib.unified_diff(kept.splitlines(), written[name].splitlines(), f"docs/{name}", f"courant keywords {option}", lineterm="", n=0))
    if difference:
        print("\n".join(difference[:40]))
        sys.exit(f"docs/{name} is out of date: write it anew with `courant keywords {option} > docs/{name}`")
assert written["keywords.md"].count("\n## *") > 30, "the page lists hardly any keyword"

# Every keyword has one state, the same in the list, on its card page and in the pages.
listed = dict(re.match(r"\*(\S+) +(%s) " % "|".join(STATES), line).groups() for line in call().splitlines() if line.startswith("*"))
assert set(listed.values()) == set(STATES), f"states in the list: {set(listed.values())}"
for section in written["keywords.md"].split('\n<a id="')[1:]:
    names = re.findall(r'(?:<a id="|^)([^"<]+)"></a>', section)
    state = re.search(r"^(Honoured|Partly|No effect|Refused)\b", section, re.M).group(1).lower()
    for name in names:
        assert listed[name.upper()] == state, f"{name}: {listed[name.upper()]} in the list, {state} in the page"
        assert f"(#{name})" in written["keywords.md"], f"nothing leads to #{name}"
for name in ("MAT_NULL", "MAT_JOHNSON_COOK", "CONTROL_ENERGY", "SECTION_SPH"):
    card_page = call(name).splitlines()[1]
    assert card_page.startswith(listed[name]), f"{name}: {card_page}"
refused = {name for name, state in listed.items() if state == "refused"}
told = set(re.findall(r"\*([A-Z0-9_]+)`", written["cannot_do.md"]))
of_sections = {re.search(r"^## \*(\S+)", s, re.M).group(1) for s in written["keywords.md"].split('\n<a id="')[1:]}
assert refused & of_sections <= told, f"refused, and not in cannot_do.md: {refused & of_sections - told}"
