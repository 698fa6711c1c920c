#!/usr/bin/env python3
"""The measurable part of docs/style.md: long lines of Markdown and words that are no terms of the field may only become fewer.

usage: style.py PROJECT_FOLDER [--write]
Counts are in style_counts.txt beside this file, one line per rule; --write lowers them to what is there.
"""
import collections
import pathlib
import re
import sys

LONGEST = 120
WORDS = ["who", "whoever", "somebody", "nobody", "stand", "stands", "tell", "tells", "told", "place", "places", "way", "ways", "heed", "heeds",
         "heeded", "mend", "mends", "mended", "anew", "brink", "belt", "belts", "outlook", "outlooks", "pull", "pulls", "room", "rooms", "wish",
         "wishes", "to and fro", "for ever", "slip of the pen", "give back", "looks at"]
FOLDERS = ["src", "docs", "tests", "examples", "keyword_decks", "cmake"]
KINDS = {".md", ".hpp", ".cpp", ".py", ".yaml", ".k", ".sh", ".cmake", ".txt"}
GENERATED = {"tests/unit/app/kept_names.txt", "docs/keywords.md", "docs/cannot_do.md", "docs/study_structures.md", "docs/study_bodies.md",
             "docs/study_contact.md", "docs/study_stability.md", "docs/study_stability_interactions.md", "docs/study_structures_large.md", "docs/study_structures_dynamic.md",
             "docs/study_contact_ties.md", "docs/study_fluid_structure.md"}
OWN = {"docs/style.md", "tests/architecture/style.py", "tests/architecture/style_counts.txt"}  # they name the words


def long_lines(text):
    """Lines outside of code blocks and tables that are longer than LONGEST; a link counts by its text."""
    count, code = 0, False
    for line in text.splitlines():
        code ^= line.lstrip().startswith("```")
        if not code and not line.lstrip().startswith("|"):
            count += len(re.sub(r"\]\([^)]*\)", "]", line)) > LONGEST
    return count


PART = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")


def words_of(text):
    """How often each word is there, as a word of text or as a part of a name: wall_ways, WallWays."""
    return collections.Counter(part.lower() for part in PART.findall(text))


def count(project):
    counts = dict.fromkeys(["long lines", *WORDS], 0)
    files = [project / "README.md", *(p for f in FOLDERS for p in sorted((project / f).rglob("*")))]
    for path in files:
        name = path.relative_to(project).as_posix()
        if path.suffix not in KINDS or not path.is_file() or name in OWN | GENERATED:
            continue
        text = path.read_text(encoding="utf-8", errors="replace")
        if path.suffix == ".md":
            counts["long lines"] += long_lines(text)
        words = words_of(text)
        for word in WORDS:
            counts[word] += len(re.findall(rf"\b{word}\b", text)) if " " in word else words[word]
    return counts


def self_test():
    return (long_lines("x" * 121) == 1 and long_lines("x" * 120) == 0 and long_lines("| " + "x" * 200) == 0 and long_lines("```\n" + "x" * 200 + "\n```") == 0
            and words_of("a way, wall_way, WallWay, always, Way")["way"] == 4)


def main():
    if not self_test():
        return "self test failed"
    project, record = pathlib.Path(sys.argv[1]), pathlib.Path(__file__).with_name("style_counts.txt")
    now = count(project)
    if "--write" in sys.argv:
        record.write_text("".join(f"{n} {rule}\n" for rule, n in now.items()), encoding="utf-8")
        return 0
    allowed = {rule: int(n) for n, rule in (line.split(" ", 1) for line in record.read_text(encoding="utf-8").splitlines())}
    more = [f"{rule}: {n}, {allowed.get(rule, 0)} before" for rule, n in now.items() if n > allowed.get(rule, 0)]
    print("\n".join(["docs/style.md: these became more", *more] if more else [f"{sum(now.values())} left of {sum(allowed.values())}"]))
    return 1 if more else 0


if __name__ == "__main__":
    sys.exit(main())
