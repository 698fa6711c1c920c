"""Pieces of the page: text, tables, pictures."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..diagnostics import CourantError
from ..optional import MissingModule

STYLE = """body{font:15px/1.45 system-ui,sans-serif;margin:1.5em auto;max-width:78em;padding:0 1em;color:#222;overflow-wrap:anywhere}
h1{font-size:1.5em;margin:.2em 0}h2{font-size:1.2em;border-bottom:1px solid #ccc;margin-top:1.6em}h3{font-size:1.03em;margin:1.2em 0 .2em}
.scroll{overflow-x:auto}table{border-collapse:collapse;margin:.5em 0;overflow-wrap:normal}td,th{padding:.15em .9em .15em 0;text-align:left;vertical-align:top}
thead th{border-bottom:1px solid #ccc;font-weight:600}tbody th{font-weight:500}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.data tbody th,.data tbody td{min-width:4.5em}
figure{display:inline-block;margin:.4em 1em .4em 0;vertical-align:top;max-width:100%}.curves figure{width:31em}img{max-width:100%;height:auto}
.states{display:block;overflow-x:auto}.states img{max-width:none;width:100%;min-width:34em}.states.narrow img{width:auto;min-width:0;max-width:100%}
figcaption,.note{color:#555;font-size:.92em}.sound,.healthy{color:#176117}.doubtful{color:#9a5b00}.broken,.error{color:#a11}
pre{white-space:pre-wrap;background:#f6f6f6;padding:.6em;margin:.4em 0}.runs{display:flex;flex-wrap:wrap;gap:0 2em}.runs>div{flex:1 1 24em;min-width:0}"""


def text(value: object) -> str:
    return html.escape(f"{value:.5g}" if isinstance(value, float) else str(value))


def paragraph(value: str, kind: str = "note") -> str:
    return f'<p class="{kind}">{text(value)}</p>'


def _cell(value: object, tag: str = "td") -> str:
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return f'<{tag}{" class=n" if number else ""}>{text(value)}</{tag}>'


def table(rows: Sequence[Sequence[object]], head: Sequence[str] = ()) -> str:
    """Rows of cells, whose first is a heading; numbers are at the right."""
    if not rows:
        return ""
    right = [all(isinstance(row[k], (int, float)) or row[k] == "" for row in rows if k < len(row)) for k in range(len(head))]
    top = "".join(f'<th{" class=n" if at_right else ""}>{text(one)}</th>' for one, at_right in zip(head, right, strict=True))
    body = "".join(f"<tr>{_cell(row[0], 'th')}{''.join(_cell(one) for one in row[1:])}</tr>" for row in rows)
    return f'<div class="scroll"><table{" class=data" if head else ""}>{f"<thead><tr>{top}</tr></thead>" if head else ""}<tbody>{body}</tbody></table></div>'


def picture(figure: Any, caption: str, kind: str = "", dpi: int = 100) -> str:
    """A picture of matplotlib inside the page."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    stream = io.BytesIO()
    figure.set_dpi(dpi)
    FigureCanvasAgg(figure).print_png(stream)
    data = base64.b64encode(stream.getvalue()).decode()
    of_kind = f' class="{kind}"' if kind else ""
    return f'<figure{of_kind}><img alt="{html.escape(caption)}" src="data:image/png;base64,{data}"><figcaption>{text(caption)}</figcaption></figure>'


def attempt(make: Callable[[], str], what: str) -> str:
    """What cannot be read or drawn is said instead."""
    try:
        with np.errstate(all="ignore"):  # of runs that have blown up
            return make()
    except CourantError as fault:
        first = fault.diagnostics.all[0]
        return paragraph(f"{what}: {first.message} ({Path(first.where.file).name})" + (f"; {first.hint}" if first.hint else ""))
    except (MissingModule, KeyError, ValueError, ImportError, OSError) as fault:
        return paragraph(f"{what}: {fault.args[0] if fault.args else fault}")
