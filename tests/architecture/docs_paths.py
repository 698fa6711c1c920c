#!/usr/bin/env python3
"""Every path that README.md and docs/*.md name in `code` or in a link exists, and every figure in docs/ is shown by a page.

usage: docs_paths.py PROJECT_FOLDER
"""
import pathlib
import re
import sys

TOPS = ("src", "docs", "tests", "examples", "keyword_decks", ".ci", "cmake")
# Made by a run or a build, so not part of the project.
MADE = ("build/", "results/")


def expand(text):
    """`a/{b,c}` is two paths."""
    match = re.search(r"\{([^{}]*,[^{}]*)\}", text)
    if not match:
        return [text]
    return [p for part in match.group(1).split(",") for p in expand(text[: match.start()] + part + text[match.end():])]


def paths_in(text):
    """Paths relative to the project that a Markdown text names, and link targets relative to its own folder."""
    own, links = [], []
    plain = re.sub(r"https?://\S+", "", text)
    for word in re.findall(r"(?<![\w./-])((?:%s)/[\w./{},*-]*)" % "|".join(re.escape(t) for t in TOPS), plain):
        own += expand(word.rstrip(".,"))
    for target in re.findall(r"\]\(<?([^)#\s>]+)[^)]*\)", text):
        if "://" not in target and not target.startswith("mailto:"):
            links.append(target)
    return own, links


def exists(folder, path):
    if path.startswith(MADE):
        return True
    path = path.replace("NAME", "*")  # represents any name
    if any(c in path for c in "*<>"):
        return any(folder.glob(path)) if "<" not in path else True
    return (folder / path).exists()


def unshown(project, pages):
    """Figures that no page shows."""
    shown = {(page.parent / target).resolve() for page in pages for target in re.findall(r"!\[[^\]]*\]\(<?([^)\s>]+)", page.read_text(encoding="utf-8"))}
    return [p for ending in ("png", "svg") for p in sorted((project / "docs").rglob("*." + ending)) if p.resolve() not in shown]


def check(project):
    faults = []
    pages = [p for p in [project / "README.md", *sorted((project / "docs").rglob("*.md"))] if p.exists()]
    pages += sorted((project / "keyword_decks").glob("*/README.md"))
    for page in pages:
        fenced = False  # in a block of code, where [](...) is no link
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            fenced ^= line.startswith("```")
            own, links = paths_in(line)
            links = [] if fenced else links
            where = f"{page.relative_to(project)}:{number}: "
            faults += [where + f"'{p}' does not exist" for p in own if not exists(project, p)]
            faults += [where + f"link to '{p}' leads nowhere" for p in links if not exists(page.parent, p)]
    faults += [f"{p.relative_to(project)}: no page shows this figure" for p in unshown(project, pages)]
    if len(pages) < 2:
        faults.append("no pages found")
    return faults


def self_test():
    own, links = paths_in("see `src/none.cpp`, `src/{a,b}.cpp` and [x](y.md#part), ![z](<z.svg>), not https://a.b/src/c")
    if own != ["src/none.cpp", "src/a.cpp", "src/b.cpp"] or links != ["y.md", "z.svg"]:
        return [f"self test: {own} {links}"]
    return []


if __name__ == "__main__":
    messages = self_test() + check(pathlib.Path(sys.argv[1]))
    print("\n".join(messages) or "all paths exist")
    sys.exit(1 if messages else 0)
