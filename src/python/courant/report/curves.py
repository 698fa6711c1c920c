"""Pictures and tables of histories of one run, or of two in the same axes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..style import PALETTE, pyplot
from .html import paragraph, picture, table
from .kinds import KINDS
from .sources import Entity, Found, Lines, Sources, thinned, time_unit, unit_names

_COLOURS = (*PALETTE, "#000000", "#7a4a1f", "#c51b7d", "#5e3c99", "#8a8a00")
_DASHES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)))
_OF_RUN = ("-", (0, (4, 2)))  # of two runs
_FIRST = ("total", "kinetic", "internal", "external_work", "external work", "hourglass", "contact", "sliding interface", "stonewall")
_MOST_PICTURES = 60
_MOST_ROWS = 10
_DPI = 110


def axes_of(label: str, unit: str, unit_t: str) -> tuple[Any, Any]:
    """A figure whose margins are fixed, which is quick."""
    pyplot()
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.0, 3.1))
    axes = figure.add_axes((0.135, 0.16, 0.845, 0.78))
    axes.set_xlabel(f"t [{unit_t}]")
    axes.set_ylabel(f"{label} [{unit}]" if unit != "-" else label)
    axes.grid(True)
    axes.ticklabel_format(scilimits=(-3, 4))
    axes.locator_params(axis="x", nbins=7)
    return figure, axes


def draw(axes: Any, t: np.ndarray, values: np.ndarray, **look: Any) -> None:
    lone = {"marker": "o", "markersize": 3} if len(t) < 3 else {}
    axes.plot(*thinned(t, values), linewidth=1.3, **lone, **look)


def legend(axes: Any) -> None:
    """Below each other where there are few; without a box over the curves."""
    count = len(axes.get_legend_handles_labels()[1])
    if count > 1:
        axes.legend(fontsize=7.5 if count > 4 else 8, ncol=1 + (count > 5) + (count > 12), framealpha=0.7)


def styles(k: int) -> dict[str, Any]:
    """No two of sixty are the same, and neighbours differ in colour and in dashes."""
    return {"color": _COLOURS[k % len(_COLOURS)], "linestyle": _DASHES[(k + k // len(_COLOURS)) % len(_DASHES)]}


def _draw_lines(axes: Any, entity: Entity, lines: Lines, run: int, runs: int, name: str) -> None:
    """Components, and of vectors their length; of two runs each has its dashes."""
    some = list(lines.curves) + ([("size", lines.size)] if lines.vector else [])
    zero = [label for label, values in some if not np.nanmax(np.abs(values), initial=0.0) > 0]
    for k, (label, values) in enumerate(some):
        if label in zero and len(zero) < len(some):
            continue
        look: dict[str, Any] = {"color": "#000000" if label == "size" else _COLOURS[k % len(_COLOURS)]}
        look["linestyle"] = _OF_RUN[run] if runs > 1 else (":" if label == "size" else _DASHES[k % 4])
        word = "|" + lines.label + "|" if label == "size" else label
        draw(axes, entity.t, values, label=f"{word} ({name})" if runs > 1 else word, **look)


def name_of(kind_noun: str, entity: Entity) -> str:
    if not entity.id:
        return entity.title
    if entity.title and entity.title.split(":")[0].endswith(f" {entity.id}"):
        return entity.title
    return f"{kind_noun} {entity.id}".strip() + (f": {entity.title}" if entity.title else "")


def _sum(found: Found) -> Entity | None:
    """Of all entities that share their times, of vectors."""
    some = [one for one in found.entities if len(one.t) == len(found.entities[0].t)]
    if len(some) < 2 or len(some) < len(found.entities):
        return None
    label = next(iter(some[0].lines))
    rows = [one.lines[label] for one in some if label in one.lines]
    if not all(one.vector for one in rows):
        return None
    curves = [(axis, np.nansum([one.curves[k][1] for one in rows], axis=0)) for k, axis in enumerate("xyz")]
    total = Lines(f"sum of the {label}s", rows[0].dimension, curves, True)
    return Entity("", f"{found.kind.sum} ({len(some)})", some[0].t, {total.label: total})


class Gallery:
    """Pictures of all histories of the runs. `names`: of the runs; a page has a limit of pictures."""

    def __init__(self, sources: Sequence[Sources], names: Sequence[str]) -> None:
        self.sources, self.names, self.left = sources, names, _MOST_PICTURES
        self.unit, self.unit_t = unit_names(sources[0].run), time_unit(sources[0].run)
        self.left_out: list[str] = []

    def _picture(self, title: str, label: str, some: Sequence[tuple[int, Entity]]) -> str:
        lines = some[0][1].lines[label]
        figure, axes = axes_of(lines.label, self.unit(lines.dimension, lines.label), self.unit_t)
        for run, entity in some:
            _draw_lines(axes, entity, entity.lines[label], run, len(self.names), self.names[run])
        legend(axes)
        self.left -= 1
        return picture(figure, f"{title}: {lines.label}", dpi=_DPI)

    def _of_entity(self, noun: str, pairs: list[tuple[int, Entity]]) -> tuple[str, list[str]]:
        """The pictures of one entity, and which quantities are zero all the time."""
        out, zero, title = "", [], name_of(noun, pairs[0][1])
        for label in dict.fromkeys(label for _, one in pairs for label in one.lines):
            some = [(run, one) for run, one in pairs if label in one.lines]
            if max(len(one.t) for _, one in some) < 2:
                continue
            if not any(one.lines[label].peak > 0 for _, one in some):
                zero.append(f"{title}: {label}")
            elif self.left > 0:
                out += self._picture(title, label, some)
        return out, zero

    def _together(self, found: list[tuple[int, Found]]) -> str:
        """One picture for each quantity, with the entities of the largest peaks."""
        out = ""
        for label in dict.fromkeys(label for _, one in found for entity in one.entities for label in entity.lines):
            every = [(run, one.kind, e) for run, one in found for e in one.entities if label in e.lines and e.lines[label].peak > 0]
            every.sort(key=lambda one: -one[2].lines[label].peak)
            shown = list(dict.fromkeys(e.id for _, _, e in every))[: found[0][1].kind.each]
            if not every or self.left <= 0:
                continue
            lines = every[0][2].lines[label]
            figure, axes = axes_of(label, self.unit(lines.dimension, label), self.unit_t)
            for run, kind, entity in every:
                if entity.id in shown:
                    look = styles(shown.index(entity.id))
                    look |= {"linestyle": _OF_RUN[run]} if len(self.names) > 1 else {}
                    word = name_of(kind.noun, entity)[:34]
                    draw(axes, entity.t, entity.lines[label].curves[0][1], label=f"{word} ({self.names[run]})" if len(self.names) > 1 else word, **look)
            legend(axes)
            self.left -= 1
            out += picture(figure, label, dpi=_DPI)
        return out

    def _peaks(self, found: list[tuple[int, Found]]) -> str:
        """The largest sizes, at their times."""
        rows: list[list[object]] = []
        for run, one in found:
            for entity in sorted(one.entities, key=lambda e: -e.peak)[:_MOST_ROWS]:
                for label, lines in entity.lines.items():
                    if lines.peak > 0:
                        at = int(np.nanargmax(lines.size))
                        last = float(lines.size[np.flatnonzero(np.isfinite(lines.size))[-1]])
                        unit = self.unit(lines.dimension, label)
                        row = [name_of(one.kind.noun, entity), label, lines.peak, float(entity.t[at]), last, unit]
                        rows.append(row if len(self.names) == 1 else [*row[:2], self.names[run], *row[2:]])
        head = ["", "", *([] if len(self.names) == 1 else ["run"]), "largest size", f"at t [{self.unit_t}]", "at the end", "unit"]
        return table(rows, head)

    def _section(self, found: list[tuple[int, Found]]) -> str:
        kind = found[0][1].kind
        out, notes = "", []
        for run, one in found:
            if len(found) < len(self.names):
                notes.append(f"only in {self.names[run]}")
        if kind.together:
            made = self._together(found)
        else:
            made, zero = "", list[str]()
            totals = [(run, total) for run, one in found if kind.sum and (total := _sum(one)) is not None]
            if totals and len(totals) == len(found):
                made += self._of_entity("", totals)[0]
            order = sorted((e for _, one in found for e in one.entities), key=lambda e: -e.peak)
            ids = list(dict.fromkeys((e.id, e.title) for e in order))
            chosen = set(ids[: kind.each])
            for id in dict.fromkeys((e.id, e.title) for _, one in found for e in one.entities):
                if id not in chosen:
                    continue
                pairs = [(run, e) for run, one in found for e in one.entities if (e.id, e.title) == id]
                drawn, empty = self._of_entity(kind.noun, pairs)
                made, zero = made + drawn, zero + empty
            if len(ids) > kind.each:
                where = " and ".join(dict.fromkeys(one.where for _, one in found))
                notes.append(f"{kind.noun or 'entry'}: of {len(ids)} the {kind.each} with the largest values are drawn; all are in {where}")
            else:
                notes.append(f"from {' and '.join(dict.fromkeys(one.where for _, one in found))}")
            if max((len(e.t) for _, one in found for e in one.entities), default=0) < 2:
                notes.append("one row only, which is no curve")
            if kind.file == "rcforc" and zero:
                notes.append("forces on both sides of a single-surface contact cancel: its energies say what it did")
            if zero:
                notes.append(f"zero all the time, and not drawn: {', '.join(zero[:8])}{', ...' if len(zero) > 8 else ''}")
        if self.left <= 0:
            self.left_out.append(kind.title)
        out += f"<h3>{kind.title}</h3>" + self._peaks(found) + f'<div class="curves">{made}</div>'
        return out + (paragraph("; ".join(notes)) if notes else "")

    def page(self) -> str:
        """All kinds in their order; what is there but not shown is said."""
        out = ""
        for found in self.all_found():
            out += self._section(found)
        notes = [note for one in self.sources for note in one.notes.values()]
        notes += [f"binout also has {', '.join(names)}, which this page does not show" for one in self.sources if (names := one.not_shown())]
        notes += list(dict.fromkeys(fault for one in self.sources for fault in one.faults))
        if self.left_out:
            notes.append(f"a page has at most {_MOST_PICTURES} pictures of histories; there would be more of: {', '.join(self.left_out)}")
        return (out or paragraph("The run has written none: *DATABASE_ cards ask for them.")) + "".join(paragraph(one) for one in dict.fromkeys(notes))

    def all_found(self) -> list[list[tuple[int, Found]]]:
        """By kind, of which runs have any."""
        if not hasattr(self, "_found"):
            self._found = []
            for kind in KINDS:
                found = [(run, one) for run, source in enumerate(self.sources) if (one := source.find(kind)).entities]
                self._found += [found] if found else []
            others: dict[str, list[tuple[int, Found]]] = {}
            for run, source in enumerate(self.sources):
                for one in source.others():
                    others.setdefault(one.kind.title, []).append((run, one))
            self._found += list(others.values())
        return self._found


def energies(sources: Sequence[Sources], names: Sequence[str]) -> str:
    """The energies of the whole over time, and a table of them."""
    unit = unit_names(sources[0].run)("ML2/T2")
    figure, axes = axes_of("energy", unit, time_unit(sources[0].run))
    order: list[str] = []
    rows: list[list[object]] = []
    zero, where = [], []
    for run, source in enumerate(sources):
        t, every, file = source.energies
        where.append(file)
        for name in sorted(every, key=lambda one: _FIRST.index(one) if one in _FIRST else len(_FIRST)):
            values = every[name]
            finite = values[np.isfinite(values)]
            if name == "throughput" or not len(finite):
                continue  # a sum of what has passed, for the verdict
            if not np.abs(finite).max() > 0:
                zero.append(_spoken(name))
                continue
            order += [name] if name not in order else []
            look = styles(order.index(name))
            look |= {"linestyle": _OF_RUN[run]} if len(sources) > 1 else {}
            label = _spoken(name)
            draw(axes, t, values, label=f"{label} ({names[run]})" if len(sources) > 1 else label, **look)
            row = [label, float(finite[0]), float(finite.min()), float(finite.max()), float(finite[-1])]
            rows.append(row if len(sources) == 1 else [row[0], names[run], *row[1:]])
    if not rows:
        return paragraph("The run has written no energies: *DATABASE_GLSTAT asks for them.")
    rows.sort(key=lambda row: [_spoken(name) for name in order].index(str(row[0])))
    axes.set_position((0.1, 0.12, 0.64, 0.84))
    figure.set_size_inches(9.0, 4.2)
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0, frameon=False)
    head = ["", *([] if len(sources) == 1 else ["run"]), *(f"{one} [{unit}]" for one in ("at the start", "lowest", "largest", "at the end"))]
    notes = [f"from {' and '.join(dict.fromkeys(where))}", *_shares(sources, names)]
    notes += [f"zero all the time, and not drawn: {', '.join(dict.fromkeys(zero))}"] if zero else []
    return picture(figure, "energies over time", "states", _DPI) + table(rows, head) + paragraph("; ".join(notes))


def _shares(sources: Sequence[Sources], names: Sequence[str]) -> list[str]:
    """How well the energy is kept, and the share of the hourglass energy, at the end."""
    out = []
    for source, name in zip(sources, names, strict=True):
        every, word = source.energies[1], f"{name}: " if len(sources) > 1 else ""
        last = {key: float(values[np.isfinite(values)][-1]) for key, values in every.items() if np.isfinite(values).any()}
        if last.get("hourglass", 0.0) > 0 and (most := float(np.nanmax(every["internal"], initial=0.0) if "internal" in every else 0.0)) > 0:
            out.append(f"{word}hourglass energy is {100 * last['hourglass'] / most:.3g} % of the largest internal energy")
    return out


def time_steps(sources: Sequence[Sources], names: Sequence[str]) -> str:
    unit = time_unit(sources[0].run)
    figure, axes = axes_of("time step", unit, unit)
    some = [(run, *source.steps) for run, source in enumerate(sources) if len(source.steps[0])]
    if not some:
        return paragraph("The run has written no time steps: *DATABASE_GLSTAT asks for them.")
    for run, t, values in some:
        draw(axes, t, values, label=names[run], color=_COLOURS[run], linestyle=_OF_RUN[run])
    axes.set_ylim(bottom=0)
    if len(some) > 1:
        legend(axes)
    return f'<div class="curves">{picture(figure, "time step over time", dpi=_DPI)}</div>'


def _spoken(name: str) -> str:
    return name.replace("_", " ").strip()


__all__ = ["Gallery", "energies", "name_of", "time_steps"]
