"""Links and headings of the Markdown pages: what the site rewrites, and what the tests check."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

LINK = re.compile(r"(\]\()(<[^>]*>|[^)\s]+)(\s+\"[^\"]*\")?(\))")
CODE = re.compile(r"(`+)(?!`).+?(?<!`)\1(?!`)")
HEADING = re.compile(r"(#{1,6}) +(.*?)(?: +#+)? *$")
NAMED = re.compile(r'<a id="([^"]+)"></a>')
EXTERNAL = ("http://", "https://", "mailto:")


def pages(project: Path) -> list[Path]:
    """The pages of the project that a reader meets: the first page, those of docs, and those of the ready decks."""
    found = [project / "README.md", *sorted((project / "docs").rglob("*.md")), *sorted((project / "keyword_decks").glob("*/README.md"))]
    return [page for page in found if page.is_file()]


def outside_code(text: str) -> Iterator[tuple[int, str, bool]]:
    """(line number, line, is text) of all lines; lines of a fenced block and its fences are no text."""
    fence = ""
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r" *(```+|~~~+)", line)
        if mark and not fence:
            fence = mark.group(1)
            yield number, line, False
        elif mark and line.strip() == fence:
            fence = ""
            yield number, line, False
        else:
            yield number, line, not fence


def slug(heading: str) -> str:
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading.replace("`", ""))
    text = re.sub(r"\\(.)", r"\1", text)
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def headings(text: str) -> Iterator[tuple[int, str, str]]:
    """(line number, heading, anchor); an anchor that is there already gets -1, -2, ..."""
    seen: Counter[str] = Counter()
    for number, line, is_text in outside_code(text):
        match = HEADING.match(line) if is_text else None
        if match:
            anchor = slug(match.group(2))
            yield number, match.group(2), anchor + (f"-{seen[anchor]}" if seen[anchor] else "")
            seen[anchor] += 1


def anchors(text: str) -> set[str]:
    """All anchors of a page: of its headings, and those written as <a id="..."></a>."""
    named = {name for _, line, is_text in outside_code(text) if is_text for name in NAMED.findall(line)}
    return named | {anchor for _, _, anchor in headings(text)}


def links(text: str) -> Iterator[tuple[int, str]]:
    """(line number, target) of the links and pictures outside of code."""
    for number, line, is_text in outside_code(text):
        if is_text:
            for match in LINK.finditer(CODE.sub("``", line)):
                yield number, match.group(2).strip("<>")


def rewritten(text: str, change) -> str:
    """The text with `change(target)` in place of each target of a link outside of code blocks."""
    lines = []
    for _, line, is_text in outside_code(text):
        lines.append(LINK.sub(lambda m: f"{m[1]}{change(m[2].strip('<>'))}{m[3] or ''}{m[4]}", line) if is_text else line)
    return "\n".join(lines) + "\n"
