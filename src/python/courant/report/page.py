"""The page as HTML, with all pictures in it."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Sequence
from typing import Any

from ..diagnostics import CourantError
from ..results import Results
from .compare import differences
from .curves import Gallery, energies, time_steps
from .html import STYLE, attempt, paragraph, table, text
from .model import messag, model
from .pictures import pictures
from .sources import Sources, summary_of, time_unit

_FACTS = {
    "termination": "ended", "reason": "why", "time": "end time", "steps": "steps", "dt_min": "smallest step", "dt_max": "largest step", "particles": "particles",
    "elements": "elements that deform", "leaked_particles": "leaked particles", "max_penetration": "largest penetration", "wall_seconds": "elapsed [s]",
    "cpu_seconds": "processor time [s]", "threads": "threads", "version": "version of Courant",
}  # fmt: skip
_TIMES = ("time", "dt_min", "dt_max")
_LAST = re.compile(r"^ *(\d+) t (\S+) dt (\S+)", re.MULTILINE)
_WARNING = re.compile(r"^(.*?warning: .*(?:\n  hint: .*)*)", re.MULTILINE)


def _killed(run: Results) -> str:
    """What is known of a run without summary.yaml."""
    if not (run.folder / "messag").is_file():
        return paragraph("The folder has neither summary.yaml nor messag of `courant run`: a copy of some files, or results of another program.")
    rows = _LAST.findall(messag(run))
    unit = time_unit(run)
    last = f" messag ends at step {rows[-1][0]}, t = {float(rows[-1][1]):.5g} {unit}." if rows else ""
    said = paragraph(f"The run has no summary.yaml: it goes on, or was killed.{last} What it has written so far is shown.")
    dumps = sorted((run.folder / "restart").glob("d3dump*")) if (run.folder / "restart").is_dir() else []
    if dumps:
        return said + paragraph(f"`courant run DECK -o {run.folder} --restart {run.folder}` goes on from restart/{dumps[-1].name}.")
    return said + paragraph("It has left no restart file (*DATABASE_BINARY_D3DUMP asks for them): it has to be run again from the start.")


def _verdict(run: Results, sources: Sources) -> str:
    try:
        summary = run.summary
    except CourantError as fault:
        return "".join(paragraph(line.strip(), "error") for line in str(fault).splitlines())
    if not summary:
        return _killed(run)
    verdict = str(summary.get("verdict", "?"))
    reasons = "".join(f"<li>{text(one)}</li>" for one in summary.get("verdict_reasons") or [])
    unit = time_unit(run)
    facts = [(f"{label} [{unit}]" if key in _TIMES else label, summary[key]) for key, label in _FACTS.items() if key in summary]
    counters = summary.get("counters") or {}
    facts += [(key.replace("_", " "), value) for key, value in counters.items() if isinstance(value, (int, float)) and value]
    advice = f"<p>{text(summary['advice'])}</p>" if summary.get("advice") else ""
    rows = table([(a, f"{b:.5g}" if isinstance(b, float) else str(b)) for a, b in facts])
    return f'<p>Verdict: <b class="{html.escape(verdict)}">{text(verdict)}</b></p><ul>{reasons}</ul>{advice}{rows}'


def _warnings(run: Results, sources: Sources) -> str:
    summary = summary_of(run)
    found = (summary.get("warnings") or []) if summary else list(dict.fromkeys(one.strip() for one in _WARNING.findall(messag(run))))
    try:
        found = [*found, *(f"d3plot: {one}" for one in run.d3plot.warnings)] if any(run.folder.glob("d3plot*")) else found
    except CourantError as fault:
        found = [*found, str(fault)]
    return "".join(f"<pre>{text(one)}</pre>" for one in found) or "<p>None.</p>"


def _timings(run: Results, sources: Sources) -> str:
    passes = []
    for one in summary_of(run).get("passes") or []:
        try:
            passes.append((str(one["name"]), float(one["seconds"])))
        except (TypeError, KeyError, ValueError):
            continue
    passes.sort(key=lambda one: -one[1])
    return table(passes[:12], ("", "seconds")) or paragraph("They are written at the end of a run.")


_Section = Callable[[Results, Sources], str]
_OF_EACH: dict[str, _Section] = {"Verdict": _verdict, "Model": model, "States": lambda run, _: pictures(run), "Warnings": _warnings, "Timings": _timings}
_OF_ALL: dict[str, Callable[[Sequence[Sources], Sequence[str]], str]] = {
    "Differences": differences, "Energies": energies, "Time step": time_steps, "Histories": lambda sources, names: Gallery(sources, names).page(),
}  # fmt: skip
_ORDER = ("Verdict", "Differences", "Model", "States", "Energies", "Time step", "Histories", "Warnings", "Timings")


def _names(runs: Sequence[Results]) -> list[str]:
    """Of the runs in legends: their folders, or numbers where these are alike or long."""
    names = [run.folder.resolve().name for run in runs]
    return names if len(set(names)) == len(names) and max(map(len, names)) <= 24 else ["A", "B"][: len(runs)]


def _title(run: Results) -> str:
    found = re.search(r"^deck \S+?: (.+)$", messag(run), re.MULTILINE)
    title = str(summary_of(run).get("title") or (found[1] if found else ""))
    if not title and (run.folder / "d3plot").is_file():
        try:
            title = run.d3plot.title.strip()
        except CourantError:
            pass  # Warnings says it
    return title or run.folder.resolve().name


def page_of(runs: Sequence[Results]) -> str:
    """All sections of a run; of two, curves are in the same axes, other sections side by side."""
    sources, names = [Sources(run) for run in runs], _names(runs)
    titles = [_title(run) for run in runs]
    body = "".join(f"<h1>{html.escape(title)}</h1>" for title in dict.fromkeys(titles))
    body += paragraph("; ".join(f"{name}: {run.folder}" if len(runs) > 1 else str(run.folder) for name, run in zip(names, runs, strict=True)))
    for title in _ORDER:
        if title in _OF_EACH:
            make: Any = _OF_EACH[title]
            of_runs = [attempt(lambda: make(run, source), title) for run, source in zip(runs, sources, strict=True)]  # noqa: B023
            heads = [f"<h3>{html.escape(name)}</h3>" if len(runs) > 1 else "" for name in names]
            made = f'<div class="runs">{"".join(f"<div>{one}{part}</div>" for one, part in zip(heads, of_runs, strict=True))}</div>'
        elif title == "Differences" and len(runs) < 2:
            continue
        else:
            made = attempt(lambda: _OF_ALL[title](sources, names), title)  # noqa: B023
        body += f"<h2>{title}</h2>{made}"
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1"><title>{html.escape(titles[0])}</title><style>{STYLE}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>{body}</body></html>\n'
