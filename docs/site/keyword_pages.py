"""docs/keywords.md, which `courant keywords --markdown` writes, as one page per family of keywords, with badges and decks that use each keyword."""

from __future__ import annotations

import html
import re
from collections import defaultdict
from pathlib import Path

STATES = {"honoured": "all fields count", "partly": "some fields or values are refused", "no effect": "read, changes no result", "refused": "the deck is refused"}
SECTION = re.compile(r'^(?:<a id="[^"]+"></a>)+\n', re.M)
ENTRY = re.compile(r"\[([A-Z0-9_/\-+]+)\]\(#([^)]+)\) (honoured|partly|no effect|refused)")
SHOWN_DECKS = 6


def badge(state: str) -> str:
    return f'<span class="state {state.replace(" ", "-")}" title="{STATES[state]}">{state}</span>'


def family(name: str) -> str:
    return name.split("_")[0].lower()


class KeywordPages:
    """`decks`: keyword name to the files that use it, by path from the project folder."""

    def __init__(self, text: str, decks: dict[str, set[str]]):
        starts = [match.start() for match in SECTION.finditer(text)] + [len(text)]
        self.head = text[: starts[0]]
        self.states = {anchor: (name, state) for name, anchor, state in ENTRY.findall(self.head)}
        self.decks = decks
        self.sections: dict[str, list[str]] = defaultdict(list)
        self.family_of: dict[str, str] = {}
        for begin, end in zip(starts, starts[1:]):
            section = text[begin:end]
            names = re.findall(r'<a id="([^"]+)"></a>', section.split("\n", 1)[0])
            of = family(names[0])
            self.sections[of].append(section)
            self.family_of |= dict.fromkeys(names, of)

    def page_of(self, anchor: str) -> str:
        """The page, within the folder of keywords, that has this anchor of the one long page."""
        return f"{self.family_of[anchor]}.md" if anchor in self.family_of else "index.md"

    def used_in(self, names: list[str]) -> str:
        files = sorted(set().union(*(self.decks.get(name, set()) for name in names)), key=lambda f: (not f.startswith("keyword_decks"), len(f), f))
        if not files:
            return ""
        more = f" and {len(files) - SHOWN_DECKS} more" if len(files) > SHOWN_DECKS else ""
        return "Decks that use it: " + ", ".join(f"[{Path(f).parent.name}/{Path(f).name}](/{f})" for f in files[:SHOWN_DECKS]) + more + ".\n\n"

    def section(self, text: str) -> str:
        anchors = re.findall(r'<a id="([^"]+)"></a>', text.split("\n", 1)[0])
        names = [self.states[a][0] for a in anchors if a in self.states]
        states = list(dict.fromkeys(self.states[a][1] for a in anchors if a in self.states))
        heading, rest = re.search(r"^## ([^\n]*)\n\n(.*)\Z", text, re.M | re.S).groups()
        first = text.split("\n", 1)[0] + f"\n\n## {heading}\n\n"
        return first + " ".join(map(badge, states)) + "\n\n" + self.used_in(names) + rest

    def family_page(self, of: str) -> str:
        names = [(name, anchor, state) for anchor, (name, state) in self.states.items() if self.family_of.get(anchor) == of]
        table = "".join(f"| [*{name}](#{anchor}) | {badge(state)} |\n" for name, anchor, state in sorted(names))
        return f"# *{of.upper()}\n\n| keyword | state |\n|---|---|\n{table}\n" + "".join(self.section(s) for s in self.sections[of])

    def index(self) -> str:
        intro = self.head[: self.head.index("\n- [")].replace("; do not edit", "").replace("not on this page", "not on these pages")
        rows = []
        for of, sections in sorted(self.sections.items()):
            counts = [(state, sum(s == state for a, (_, s) in self.states.items() if self.family_of.get(a) == of)) for state in STATES]
            rows.append(f"| [*{of.upper()}]({of}.md) | " + " | ".join(str(n or "") for _, n in counts) + " |\n")
        table = "| family | " + " | ".join(badge(s) for s in STATES) + " |\n|---|---:|---:|---:|---:|\n" + "".join(rows)
        names = ", ".join(f"[{html.escape(name)}]({self.page_of(a)}#{a})" for a, (name, _) in sorted(self.states.items()))
        return f"{intro}\n## Families\n\n{table}\n## All names\n\n{names}\n"


def decks_by_keyword(project: Path, generated: dict[str, str]) -> dict[str, set[str]]:
    """Files that use each keyword. `generated`: texts of decks that a scene or script makes, by the path of that scene or script."""
    found: dict[str, set[str]] = defaultdict(set)
    texts = dict(generated)
    for pattern in ("keyword_decks/*/*.k", "keyword_decks/*/*.yaml", "keyword_decks/*/*.py", "tests/decks/accept/*.k", "tests/extension/*.k"):
        for path in sorted(project.glob(pattern)):
            name = path.relative_to(project).as_posix()
            texts[name] = texts.get(name, "") + "\n" + path.read_text(encoding="utf-8", errors="replace")
    for name, text in texts.items():
        for keyword in set(re.findall(r"(?:^|[\s\"'(])\*([A-Z][A-Z0-9_\-/]+)", text, re.M)):
            for known in (keyword, re.sub(r"_(TITLE|ID)$", "", keyword)):
                found[known].add(name)
    return found
