"""The deck in short: parts, contacts, loads, end time, and what sets the time step. From the results, and the deck where it is found."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..deck import Deck
from ..diagnostics import CourantError
from ..results import Results
from .html import paragraph, table, text
from .sources import Sources, summary_of, time_unit, unit_names

_KINDS = {3: "beams", 5: "shells", 9: "shells", 10: "solids", 12: "solids", 13: "solids", 14: "solids", 24: "solids", 25: "solids"}  # by VTK's types
_KIND = re.compile(r"^    [a-z]+ +([a-z ]+?) of part (\d+)", re.MULTILINE)
_CONTROL = re.compile(r"^ dt of cycle +\d+ is controlled by (.+?)(?:, in a step before)?\s*$", re.MULTILINE)
_ACTING = re.compile(r"^  (?:  rates|  forces|  constraints|  motion|impact) +(\S.*)$", re.MULTILINE)
_FAMILIES = {
    "contacts": ("CONTACT_",), "rigid walls": ("RIGIDWALL_",), "loads": ("LOAD_",), "initial conditions": ("INITIAL_",),
    "boundary conditions": ("BOUNDARY_",), "constraints": ("CONSTRAINED_",), "damping": ("DAMPING_",),
}  # fmt: skip
_LARGEST_DECK = 60_000_000  # bytes
_LOADS = ("load", "gravity", "pressure on", "blast", "damping", "motion given", "prescribed", "fixed nodes", "inlet", "joint", "tie", "welds")


def messag(run: Results) -> str:
    """The log; of a long one its begin and its end."""
    try:
        data = (run.folder / "messag").read_bytes()
    except OSError:
        return ""
    data = data if len(data) < 4_000_000 else data[:3_000_000] + b"\n" + data[-1_000_000:]
    return data.decode("utf-8", "replace")


def _glstat(run: Results) -> str:
    try:
        return (run.folder / "glstat").read_bytes()[:16_000_000].decode("latin-1")
    except OSError:
        return ""


def deck_of(run: Results, log: str) -> Path | None:
    """The file that was run, where it is still found beside the results or in the present folder, or under the name that was given."""
    name = str(summary_of(run).get("deck") or (found[1] if (found := re.search(r"^deck (\S+?):", log, re.MULTILINE)) else ""))
    folders = (Path(), run.folder, run.folder.parent, run.folder.parent.parent)
    return next((file for folder in folders if name and (file := folder / name).is_file()), None)


def _field(of: Any, name: str) -> object:
    """Of a block or a set of its cards; None where it is not known."""
    try:
        return of[name]
    except CourantError:
        return None


class _Model:
    """Blocks of a deck and its includes. Raises CourantError."""

    def __init__(self, file: Path) -> None:
        self.file, self.decks = file, [Deck(file)]
        for deck in self.decks:
            if len(self.decks) < 100:
                self.decks += deck.includes
        self.blocks = [block for deck in self.decks for block in deck]

    def families(self) -> list[tuple[str, str]]:
        """Keywords with how many of each, by what they are."""
        out = []
        for title, begins in _FAMILIES.items():
            names = Counter(block.name.removesuffix("_TITLE").removesuffix("_ID") for block in self.blocks if block.name.startswith(begins))
            if names:
                out.append((title, ", ".join(f"*{name}" + (f" ({count})" if count > 1 else "") for name, count in names.items())))
        return out

    def value(self, keyword: str, field: str) -> object:
        for deck in self.decks:
            if keyword in deck:
                return _field(deck[keyword][-1], field)
        return None

    def parts(self) -> dict[int, tuple[str, str]]:
        """Title and material of each part."""
        materials: dict[object, str] = {}
        for block in self.blocks:
            if block.name.startswith("MAT_") and not block.name.startswith("MAT_ADD"):
                for one in block.sets:
                    materials[_field(one, "MID")] = block.name.removesuffix("_TITLE")
        out: dict[int, tuple[str, str]] = {}
        for deck in self.decks:
            for number, one in deck.parts.items():
                title, mid = _field(one, "TITLE") or _field(one, "HEADING"), _field(one, "MID")
                out[number] = str(title or ""), f"*{materials[mid]} ({mid})" if mid in materials else ("" if mid is None else f"MID {mid}")
        return out


def _from_states(run: Results) -> dict[int, tuple[str, int]]:
    """Kind and number of elements of each part in the first state; faces for contact count only where a part has nothing else."""
    volumes: dict[int, Counter[str]] = {}
    faces: dict[int, Counter[str]] = {}
    try:
        state = run.states[0]
        for mesh in state.elements:
            found = faces if len(state.elements) > 1 and mesh is state.elements[0] else volumes
            types, part = mesh._values("Cells", "types"), np.asarray(mesh["part"])
            for kind, number in zip(types.tolist(), part.tolist(), strict=True):
                found.setdefault(int(number), Counter())[_KINDS.get(kind, "elements")] += 1
        if state.particles is not None and "part" in state.particles:
            for number, count in zip(*np.unique(np.asarray(state.particles["part"]), return_counts=True), strict=True):
                volumes.setdefault(int(number), Counter())["particles"] += int(count)
    except (CourantError, KeyError, ValueError, IndexError):
        pass
    return {number: (", ".join(kinds), sum(kinds.values())) for number, kinds in (faces | volumes).items()}


def _masses(run: Results, sources: Sources) -> dict[int, float]:
    """At the first row [M]."""
    if sources.h5 is not None:
        paths = [path for path in sources.h5 if re.fullmatch(r"parts/\d+/mass", path)]
        return {int(path.split("/")[1]): float(sources.h5[path][0]) for path in paths if len(sources.h5[path])}
    if sources.binout is not None and "matsum/mass" in sources.binout and "matsum/ids" in sources.binout:
        first = np.atleast_2d(sources.binout["matsum/mass"])[0]
        return dict(zip((int(one) for one in np.atleast_1d(sources.binout["matsum/ids"])), first.tolist(), strict=False))
    try:
        particles = run.states[0].particles
        if particles is None or "mass" not in particles:
            return {}
        part = np.asarray(particles["part"])
        return {int(one): float(particles["mass"][part == one].sum()) for one in np.unique(part)}
    except (CourantError, KeyError):
        return {}


def _titles(sources: Sources) -> dict[int, str]:
    """Of parts, from history.h5 or matsum's legend."""
    if sources.h5 is not None:
        return {int(g.split("/")[1]): sources._title(g) for g in sources.h5.groups if re.fullmatch(r"parts/\d+", g)}
    titles = {int(number): title for number, title in sources.legend("matsum").items()}
    if not titles and (sources.run.folder / "d3plot").is_file():
        try:
            return {number: title for number, title in sources.run.d3plot.parts.items() if title}
        except CourantError:
            pass  # the page says it among the warnings
    return titles


def _parts(run: Results, sources: Sources, model: _Model | None, log: str) -> str:
    of_states, masses, titles = _from_states(run), _masses(run, sources), _titles(sources)
    of_deck = model.parts() if model else {}
    named: dict[int, str] = {}
    for kind, number in _KIND.findall(log):
        named[int(number)] = kind if named.get(int(number), kind) == kind else f"{named[int(number)]}, {kind}"
    bodies = {int(g.split("/")[1]) for g in (sources.h5.groups if sources.h5 is not None else []) if re.fullmatch(r"rigid_bodies/\d+", g)}
    unit, rows = unit_names(run)("M"), []
    for number in sorted({*of_states, *masses, *titles, *of_deck}):
        kind, count = of_states.get(number, ("", 0))
        kind = named.get(number, kind)
        kind = "rigid" + (f" ({kind} drawn)" if kind else "") if number in bodies and number not in named else kind
        title, material = of_deck.get(number, ("", ""))
        mass: object = masses.get(number, "")
        rows.append([number, titles.get(number) or title, kind, count or "", material or "", mass])
    more = paragraph(f"{len(rows) - 40} more parts") if len(rows) > 40 else ""
    head = ["part", "title", "elements", "count", "material", f"mass [{unit}]"]
    if not any(row[4] for row in rows):
        rows, head = [row[:4] + row[5:] for row in rows], head[:4] + head[5:]
    return table(rows[:40], head) + more


def _acting(run: Results, log: str) -> list[tuple[str, str]]:
    """What messag names of contacts, walls, supports and loads, for want of the deck."""
    passes = [str(one.get("name")) for one in summary_of(run).get("passes") or [] if isinstance(one, Mapping)]
    lines = passes or [line[:28].strip() for line in _ACTING.findall(log)]
    some = [name for name in dict.fromkeys(lines) if any(word in name for word in ("contact 0", *(f"contact {k}" for k in range(1, 10)), "rigid wall", *_LOADS))]
    some = [name for name in some if not name.endswith(("(forces)", "reduction"))]
    return [("contacts, supports and loads", ", ".join(some))] if some else []


def limits_of_step(run: Results, log: str) -> list[tuple[str, str]]:
    """What set the first step, and what set it most often in the rows of glstat."""
    rows = []
    if found := re.search(r"^first step (\S+) \[T\], set by (.+)$", log, re.MULTILINE):
        rows.append(("first time step", f"{float(found[1]):.4g} {time_unit(run)}, set by {found[2].strip()}"))
    counted = Counter(_CONTROL.findall(_glstat(run)))
    total = sum(counted.values())
    if total:
        most = ", ".join(f"{name} ({100 * count / total:.0f} %)" for name, count in counted.most_common(3))
        rows.append(("the step is set by", f"{most}, by share of the rows of glstat" + (f"; {len(counted) - 3} others" if len(counted) > 3 else "")))
    return rows


def model(run: Results, sources: Sources) -> str:
    """Facts and a table of the parts."""
    log, deck, said = messag(run), None, ""
    file = deck_of(run, log)
    if file is not None and file.stat().st_size > _LARGEST_DECK:
        said = f"{file} is too large to be read for this page: materials and keywords are not listed"
    elif file is not None:
        try:
            deck = _Model(file)
        except (CourantError, ValueError, KeyError, RecursionError) as fault:
            said = f"the deck cannot be read for this page: {str(fault).splitlines()[0]}"
        ran = run.folder / "messag"
        if ran.is_file() and file.stat().st_mtime > ran.stat().st_mtime:
            said = f"{file} has been changed since the run: what follows from it may differ"
    summary, rows = summary_of(run), []
    rows.append(("deck", str(file or summary.get("deck") or (found[1] if (found := re.search(r"^deck (\S+?):", log, re.MULTILINE)) else ""))))
    if found := re.search(r"^(\d+ particles in .*)$", log, re.MULTILINE):
        rows.append(("size", found[1]))
    end = re.search(r"termination time +=\s*(\S+)", log)
    ends = end[1] if end else (deck.value("CONTROL_TERMINATION", "ENDTIM") if deck else None)
    if ends not in (None, ""):
        rows.append(("termination time", f"{_number(ends)} {time_unit(run)}"))
    rows += limits_of_step(run, log)
    rows += deck.families() if deck else _acting(run, log)
    if deck is None and not said:
        said = "the deck is not beside the results, so that materials and keywords are not listed"
    units = run.units
    known = "" if units.mass == "model units" else f"{units.mass}, {units.length}, {units.time}, as the numbers suggest"
    rows.append(("units", known or "not known: M, L and T are the units of mass, length and time of the deck"))
    facts = "".join(f"<tr><th>{text(a)}</th><td>{text(b)}</td></tr>" for a, b in rows if b)
    return f'<div class="scroll"><table>{facts}</table></div>{_parts(run, sources, deck, log)}' + (paragraph(said) if said else "")


def _number(value: Any) -> str:
    try:
        return f"{float(value):g}"
    except (TypeError, ValueError):
        return str(value)
