#!/usr/bin/env python3
"""The table "What a change touches" of docs/contributing.md is true: the words of each example are in the files that its row names, and in no
other file of src/; these files are of the kind that the row promises.

usage: changes_table.py PROJECT_FOLDER
"""
import fnmatch
import pathlib
import re
import sys

PAGE, TITLE = "docs/contributing.md", "## What a change touches"


def rows_of(page):
    """Cells of the table: change, files of the library, file outside of it, words of the example, its files."""
    if TITLE not in page:
        return []
    section = page.split(TITLE, 1)[1].split("\n## ", 1)[0]
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in section.splitlines() if line.startswith("|")]
    return [row for row in rows[2:] if len(row) == 5]


def spans(cell):
    return re.findall(r"`([^`]+)`", cell)


def mentions(text, word):
    return re.search(r"(?<![A-Za-z0-9_])" + re.escape(word) + r"(?![A-Za-z0-9_])", text) is not None


def faults(rows, texts):
    """`texts`: of all files of src/ and tests/extension by their path."""
    out = []
    for change, inside, outside, words, files in rows:
        words, files = spans(words), spans(files)
        patterns = [p.replace("NAME", "*") for p in spans(inside) + spans(outside)]
        if not words or not files or not patterns:
            out.append(f"{change}: no example")
        for path in files:
            if path not in texts:
                out.append(f"{change}: {path} does not exist")
            elif not any(mentions(texts[path], word) for word in words):
                out.append(f"{change}: {path} mentions none of {', '.join(words)}")
            if not any(fnmatch.fnmatch(path, p) for p in patterns):
                out.append(f"{change}: {path} is none of the files that the row promises")
        # of the patterns inside or of those outside
        if not any(all(any(fnmatch.fnmatch(path, p.replace("NAME", "*")) for path in files) for p in spans(cell)) for cell in (inside, outside) if spans(cell)):
            out.append(f"{change}: the example has no file for one of those that the row promises")
        for path, text in texts.items():
            if path.startswith("src/") and path not in files:
                out += [f"{change}: {path} mentions {word}, too" for word in words if mentions(text, word)]
    return out


def self_test():
    row = ["a law", "`src/a/law_NAME.cpp`", "`tests/extension/law.cpp`", "`LawOne`", "`src/a/law_one.cpp`"]
    good = {"src/a/law_one.cpp": "struct LawOne", "src/b.cpp": "LawOneMore"}
    return (faults([row], good) == [] and faults([row], good | {"src/c.cpp": "LawOne{}"}) != [] and faults([row], {"src/b.cpp": ""}) != []
            and faults([row], {"src/a/law_one.cpp": "struct LawTwo"}) != [] and faults([row[:4] + ["`src/b.cpp`"]], {"src/b.cpp": "LawOne"}) != []
            and faults([row[:1] + ["`src/a/law_NAME.cpp`, `src/d.cpp`", ""] + row[3:]], good) != [])


if __name__ == "__main__":
    project = pathlib.Path(sys.argv[1])
    paths = [p for folder in ("src", "tests/extension") for p in (project / folder).rglob("*") if p.suffix in (".cpp", ".hpp", ".py", ".yaml")]
    rows = rows_of((project / PAGE).read_text(encoding="utf-8"))
    messages = faults(rows, {str(p.relative_to(project)): p.read_text(encoding="utf-8") for p in paths})
    if len(rows) < 10:
        messages.append(f"{PAGE}: a table of {len(rows)} rows")
    if not self_test():
        messages.append("self test failed")
    print("\n".join(messages) or f"{len(rows)} changes touch what the table says")
    sys.exit(1 if messages else 0)
