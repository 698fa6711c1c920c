"""The call `courant report DIR`: one self-contained HTML page on a run, or on two side by side."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .diagnostics import CourantError
from .files import write_file
from .optional import MissingModule, module
from .results import Results
from .style import pyplot
from .terminal import Parser, exit_code_of, say

_STYLE = """body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:76em;padding:0 1em;color:#222}
h1{font-size:1.5em}h2{font-size:1.15em;border-bottom:1px solid #ccc;margin-top:2em}table{border-collapse:collapse;margin:.5em 0}
td,th{padding:.15em .8em .15em 0;text-align:left;vertical-align:top}td.n{text-align:right;font-variant-numeric:tabular-nums}
figure{display:inline-block;margin:.5em 1em .5em 0;vertical-align:top}img{max-width:100%}figcaption{color:#555;font-size:.9em}
.healthy{color:#176117}.doubtful{color:#9a5b00}.broken,.error{color:#a11}pre{white-space:pre-wrap;background:#f6f6f6;padding:.6em}.runs{display:flex;gap:2em}.runs>div{flex:1}"""
_FACTS = {
    "deck": "deck", "termination": "ended", "reason": "why", "time": "end time", "steps": "steps", "dt_min": "smallest step", "dt_max": "largest step",
    "particles": "particles", "elements": "elements", "leaked_particles": "leaked particles", "max_penetration": "largest penetration",
    "wall_seconds": "elapsed [s]", "cpu_seconds": "CPU [s]", "threads": "threads",
}  # fmt: skip
_GROUPS = {"contacts": "force", "rigid_walls": "force", "driven_bodies": "force", "nodes": "displacement", "rigid_bodies": "displacement"}
_MOST_CURVES = 12


def _text(value: object) -> str:
    return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def _rows(rows: Sequence[tuple[object, object]]) -> str:
    return f"<table>{''.join(f'<tr><th>{_text(a)}</th><td>{_text(b)}</td></tr>' for a, b in rows)}</table>"


def _figure(figure: Any, caption: str) -> str:
    """A picture inside the page; the figure is closed."""
    stream = io.BytesIO()
    figure.set_dpi(90)
    figure.canvas.print_png(stream)
    pyplot().close(figure)
    data = base64.b64encode(stream.getvalue()).decode()
    return f'<figure><img alt="{html.escape(caption)}" src="data:image/png;base64,{data}"><figcaption>{html.escape(caption)}</figcaption></figure>'


def _attempt(make: Callable[[], str], what: str) -> str:
    """What a run did not write, or cannot be drawn here, is said instead."""
    try:
        return make()
    except CourantError as fault:
        return f"<p>{html.escape(what)}: {html.escape(str(fault).splitlines()[0])}</p>"
    except MissingModule as fault:
        return f"<p>{html.escape(what)}: {html.escape(str(fault))}</p>"
    except (KeyError, ValueError, ImportError) as fault:
        return f"<p>{html.escape(what)}: {html.escape(str(fault))}</p>"


def _verdict(run: Results) -> str:
    summary = run.summary
    if not summary:
        return "<p>The run has no summary.yaml: it goes on, or was killed.</p>"
    verdict = str(summary.get("verdict", "?"))
    reasons = "".join(f"<li>{_text(one)}</li>" for one in summary.get("verdict_reasons") or [])
    facts = [(label, summary[key]) for key, label in _FACTS.items() if key in summary]
    advice = f"<p>{_text(summary['advice'])}</p>" if summary.get("advice") else ""
    return f'<p>Verdict: <b class="{html.escape(verdict)}">{_text(verdict)}</b></p><ul>{reasons}</ul>{advice}{_rows(facts)}'


def _energies(run: Results) -> str:
    ledger = (run.summary or {}).get("energy") or {}
    made = _figure(run.energies.plot(), "energies over time")
    return made + _rows([(name, value) for name, value in ledger.items() if isinstance(value, (int, float))])


def _curves(title: str, t: np.ndarray, unit: str, curves: Sequence[tuple[str, np.ndarray]], unit_t: str) -> str:
    plt = pyplot()
    figure, axes = plt.subplots(figsize=(7.2, 3.6), constrained_layout=True)
    for name, values in curves:
        axes.plot(t, values, label=name, linewidth=1.2)
    axes.set_xlabel(f"t [{unit_t}]")
    axes.set_ylabel(f"{title} [{unit}]")
    axes.grid(True)
    if len(curves) > 1:
        axes.legend(fontsize=8)
    return _figure(figure, title)


def _step(run: Results) -> str:
    h = run.histories
    return _curves("time step", h.t, h.unit("global/dt"), [("dt", h["global/dt"])], h.unit("global/time"))


def _histories(run: Results) -> Iterator[str]:
    """Forces of contacts and walls, displacements of nodes and bodies: a figure each, of the first ones where there are many."""
    h = run.histories
    for group in h.groups:
        kind, _, id = group.partition("/")
        quantity = _GROUPS.get(kind)
        path = f"{group}/{quantity}"
        if quantity is None or path not in list(h) or int(id) > 10**9:
            continue
        values = h[path]
        curves = [(axis, values[:, k]) for k, axis in enumerate("xyz")]
        yield _curves(f"{kind.replace('_', ' ')} {id}: {quantity}", h.t, h.unit(path), curves, h.unit("global/time"))


def _some_histories(run: Results) -> str:
    made = []
    for one in _histories(run):
        if len(made) == _MOST_CURVES:
            return "".join(made) + f"<p>There are more; the first {_MOST_CURVES} are shown.</p>"
        made.append(one)
    return "".join(made) or "<p>The deck asks for none.</p>"


def _mesh_picture(run: Results, k: int) -> str:
    """All points of a state, and edges of cells, seen along an oblique direction; by von Mises stress or speed where there is one."""
    state = run.states[k]
    plt = pyplot()
    figure = plt.figure(figsize=(5.2, 4.2), constrained_layout=True)
    axes = figure.add_subplot(projection="3d")
    art = module("mpl_toolkits.mplot3d.art3d")
    for mesh in state.elements:
        cells = [cell for cell in mesh.cells if len(cell) > 1]
        lines = [mesh.points[np.append(cell, cell[0])] for cell in cells[:20000]]
        axes.add_collection3d(art.Line3DCollection(lines, linewidths=0.4, colors="#456"))
    if state.particles is not None:
        step = max(1, len(state) // 20000)
        axes.scatter(*state.points[::step].T, s=2, c=state["speed"][::step] if "velocity" in state else "#37c", cmap="viridis")
    points = np.concatenate([mesh.points for mesh in [*state.elements, *([state] if state.particles is not None else [])]])
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = 0.5 * (low + high), 0.55 * max(float((high - low).max()), 1e-30)
    for axis, at in zip("xyz", middle, strict=True):
        getattr(axes, f"set_{axis}lim")(at - half, at + half)
    return _figure(figure, f"t = {state.t:.5g}")


def _pictures(run: Results) -> str:
    count = len(run.states)
    return "".join(_mesh_picture(run, k) for k in dict.fromkeys((0, count // 2, count - 1)))


def _warnings(run: Results) -> str:
    warnings = (run.summary or {}).get("warnings") or []
    return "".join(f"<pre>{_text(one)}</pre>" for one in warnings) or "<p>None.</p>"


def _timings(run: Results) -> str:
    passes = [(one["name"], float(one["seconds"])) for one in (run.summary or {}).get("passes") or [] if isinstance(one, dict)]
    passes.sort(key=lambda one: -one[1])
    return _rows([(name, f"{seconds:.3g} s") for name, seconds in passes[:15]])


_SECTIONS: dict[str, Callable[[Results], str]] = {
    "Verdict": _verdict, "States": _pictures, "Energies": _energies, "Time step": _step, "Histories": _some_histories, "Warnings": _warnings, "Timings": _timings,
}  # fmt: skip


def page_of(runs: Sequence[Results]) -> str:
    """The page as HTML, with all pictures in it."""
    titles = [str((run.summary or {}).get("title") or run.folder.name) for run in runs]
    body = "".join(f"<h1>{html.escape(title)}</h1>" for title in dict.fromkeys(titles))
    for name, make in _SECTIONS.items():
        columns = "".join(f"<div>{f'<h3>{html.escape(str(run.folder))}</h3>' if len(runs) > 1 else ''}{_attempt(lambda: make(run), name)}</div>" for run in runs)  # noqa: B023
        body += f'<h2>{name}</h2><div class="runs">{columns}</div>'
    return f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(titles[0])}</title><style>{_STYLE}</style></head><body>{body}</body></html>\n'


def main(words: Sequence[str]) -> int:
    """The exit code: 0, 1 where a folder has faults, 2 where the page could not be written, 3 where a module is missing."""
    parser = Parser("courant report", allow_abbrev=False, description="one HTML page on a run, or on two")
    parser.add_argument("folders", metavar="DIR", nargs="+", help="folder of a run, or two to compare")
    parser.add_argument("-o", "--output", metavar="FILE", help="the page; DIR/report.html if not given")
    call = parser.parse_args(list(words))
    if len(call.folders) > 2:
        parser.error("one folder, or two")

    def write() -> None:
        runs = [Results(folder) for folder in call.folders]
        file = Path(call.output) if call.output else runs[0].folder / "report.html"
        write_file(file, page_of(runs), named=call.output is not None)
        say(f"report: {file}\n")

    return exit_code_of(write)
