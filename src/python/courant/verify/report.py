"""The reports of `courant verify`: a page for the browser and one for the documentation."""
from __future__ import annotations

import base64
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ..files import make_folder, write_file
from ..optional import module
from .changes import Comparison
from .charts import DARK, width_of
from .figures import figures
from .model import SuiteResult
from .pareto import cheapest_within_bounds
from .tables import check_text, checks_table, overview_table, runs_table
from .text import escape_markdown, escape_xml, file_stem, links, number, paragraphs, percent, seconds

_TEMPLATES = Path(__file__).with_name("templates")
_MOST_OPEN_ROWS = 30  # of a table; a longer one is opened by the reader
_LONG_CELL = 44  # longer texts are broken into lines


def verdict(result: SuiteResult) -> str:
    """ "All 12 bounds are met." and the like, one sentence."""
    every, bad = sum(len(case.checks) for case in result.cases), sum(case.missed for case in result.cases)
    if every == 0:
        return "The suite states no bounds."
    if bad > 0:
        return f"{bad} of {every} bounds {'is' if bad == 1 else 'are'} missed."
    return "The one bound is met." if every == 1 else f"All {every} bounds are met."


def _render(template: str, escape: Callable[[str], str], result: SuiteResult, **values: Any) -> str:
    jinja2 = module("jinja2")
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_TEMPLATES), trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined, autoescape=False, keep_trailing_newline=True,
                                     finalize=lambda value: value if isinstance(value, _Markup) else escape(str(value)))
    environment.filters |= {"percent": percent, "seconds": seconds, "number": number, "paragraphs": paragraphs, "links": links,
                            "stem": file_stem}
    environment.globals |= {
        "result": result, "verdict": verdict(result), "figures": figures, "cheapest": cheapest_within_bounds, "check_text": check_text,
        "checks_table": checks_table, "runs_table": runs_table, "overview": overview_table(result), "most_rows": _MOST_OPEN_ROWS,
        "long_cell": _LONG_CELL, "raw": _Markup, "at_once": "one run" if result.jobs == 1 else f"{result.jobs} runs"}
    return str(environment.get_template(template).render(**values))


class _Markup(str):
    """A text that is markup already."""


def _in_scroller(svg: str) -> str:
    """A map that is wider than charts keeps its letters readable: it scrolls in its box."""
    wide = width_of(svg)
    return _Markup(svg if wide <= 1.15 else f'<div class="scroll" tabindex="0"><div class="wide" style="width:{400 * wide:.0f}px">{svg}</div></div>')


def html(result: SuiteResult, changes: Comparison | None = None) -> str:
    """The text of report.html: plain elements, one style sheet, no script."""
    ids = [f"case-{i}-{file_stem(case.definition.name)}" for i, case in enumerate(result.cases, 1)]
    sheet = (_TEMPLATES / "page.css").read_text("utf-8") + DARK
    return _render("report.html.j2", escape_xml, result, ids=ids, changes=changes or Comparison(), css=_Markup(sheet),
                   drawing=_in_scroller, base64=lambda data: _Markup(base64.b64encode(data).decode()))


def write_reports(result: SuiteResult, folder: Path, changes: Comparison | None = None) -> None:
    """Writes folder/report.html: one file with its charts and pictures inside, which loads nothing else and needs no script. `folder` is made if
    need be. Raises OutputError; an earlier report is then as it was."""
    make_folder(folder)
    write_file(folder / "report.html", html(result, changes))


class _Pictures:
    """Writes charts and pictures beside a page, each with a name that no other one has."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.folder, self.taken = folder, set[str]()
        relative = os.path.relpath(folder.absolute(), page.absolute().parent)
        self.prefix = "" if relative == "." else f"{relative}/"

    def add(self, stem: str, ending: str, content: str | bytes, label: str) -> str:
        """What the page writes to show it."""
        name, n = file_stem(stem), 2
        while name in self.taken:
            name, n = f"{file_stem(stem)}-{n}", n + 1
        self.taken.add(name)
        write_file(self.folder / (name + ending), content)
        return _Markup(f"![{escape_markdown(label)}](<{self.prefix}{name}{ending}>)")


def standalone_svg(svg: str) -> str:
    """A file of its own: the `svg` element with the style sheet inside."""
    head, rest = svg.split(">", 1)  # text in attributes is escaped: the first one ends the tag
    return f"{head}><style>\n{DARK}</style>{rest}\n"


def write_page(result: SuiteResult, page: Path, picture_folder: Path) -> None:
    """Writes the same as a Markdown page (GitHub's dialect) with its charts as SVG files and its pictures as PNG files in `picture_folder`, named
    CASE-OBSERVATION-KIND, which the page refers to by relative paths. The page is written last. Raises OutputError; the page is then as it was."""
    make_folder(page.absolute().parent)
    make_folder(picture_folder)
    text = _render("page.md.j2", escape_markdown, result, add=_Pictures(page, picture_folder).add, standalone=standalone_svg)
    write_file(page, re.sub(r"\n{3,}", "\n\n", text).rstrip("\n") + "\n", named=True)
