"""Gauges of a scene: entries of `gauges:` in YAML, and `Scene.gauge` in Python."""
from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..key_tables import keys as keys_of_map
from ..words import did_you_mean, shortest
from ..yaml_map import Node, is_list, is_scalar
from .part_names import described, named_part
from .solids import part_set

if TYPE_CHECKING:
    from .model import Model
    from .reader import SceneReader

# Each kind with the corners of its points in the plane and in space: the least and the most.
_KINDS = {"point": (1, 1), "level": (2, 2), "runup": (2, 2), "flux": (2, 3), "force": (0, 0)}
_KEYS = keys_of_map("a gauge", "point vector, level list, runup list, flux list, force any, name text!, interval number, with any, about any")
_FOREIGN = re.compile(r"[^A-Za-z0-9_.-]", re.ASCII)  # characters that become _, as the program has it
_LONGEST = 60  # name
_FIRST_SET = 3000  # of the parts of a gauge


def read_gauges(reader: SceneReader, root: Node, model: Model) -> None:
    """Adds the cards of all gauges of a scene to its keywords."""
    node = reader.get(root, "gauges")
    if node is None:
        return
    if not is_list(node):
        reader.error(node, "gauges: expected a list", "- {name: p1, point: [0.1, 0.2]}")
        return
    output = reader.get(root, "output")
    end = reader.get(root, "end")
    states = reader.number(output, "output") if output is not None else None
    last = reader.number(end, "end") if end is not None else None
    usual = (states if states is not None else last / 100 if last is not None else 0.0) / 10
    names: set[str] = set()
    for number, entry in enumerate(node.value, 1):
        if reader.is_map(entry, "- {name: p1, point: [0.1, 0.2]}", "a gauge"):
            _read_gauge(reader, root, entry, number, usual, model, names)


def _read_gauge(reader: SceneReader, root: Node, node: Node, number: int, usual: float, model: Model, names: set[str]) -> None:
    reader.check_keys(node, "a gauge", _KEYS)
    before = reader.diagnostics.errors
    given = [kind for kind in _KINDS if reader.get(node, kind) is not None]
    if len(given) != 1:
        reader.error(node, "a gauge has one of " + ", ".join(_KINDS), "- {name: p1, point: [0.1, 0.2]}")
        return
    kind = given[0]
    name = _name(reader, node, names)
    interval = reader.length(node, "interval", "time") if reader.get(node, "interval") is not None else usual
    if not interval > 0 and reader.diagnostics.errors == before:
        reader.error(node, "'interval' is missing", "the scene has no 'end' from which one could follow")
    for key, only in (("with", "point"), ("about", "force")):
        if (entry := reader.get(node, key)) is not None and kind != only:
            reader.error(entry, f"'{key}' goes with '{only}'")
    cards = _cards(reader, root, node, kind, number, model)
    if reader.diagnostics.errors == before:
        front, *more = cards
        model.keywords.append(f"*COURANT_GAUGE_{kind.upper()}_TITLE\n{name}\n{number},{shortest(interval)}{front}\n" + "".join(f"{one}\n" for one in more))


def _name(reader: SceneReader, node: Node, names: set[str]) -> str:
    """That of the file and of the group of history.h5: by the rule of the program for titles, so that two gauges of one file are found here."""
    entry = reader.get(node, "name")
    if entry is None:
        reader.error(node, "a gauge: 'name' is missing", "- {name: p1, point: [0.1, 0.2]}")
        return ""
    given = reader.text(entry)
    name = _FOREIGN.sub("_", given)
    name = "_" + name[1:] if name.startswith(".") else name
    if not 0 < len(name) <= _LONGEST:
        reader.error(entry, f"name: '{given}' has {len(name)} characters; 1 to {_LONGEST} are possible")
    if name in names:
        reader.error(entry, f"two gauges are called '{name}'", "" if name == given else "other characters than letters, digits, -, _ and . become _")
    names.add(name)
    return name


def _cards(reader: SceneReader, root: Node, node: Node, kind: str, number: int, model: Model) -> list[str]:
    """What follows the interval on the first card, and the cards behind it."""
    value = reader.get(node, kind)
    assert value is not None
    if kind == "force":
        about = reader.vector(node, "about")[0] if reader.get(node, "about") is not None else (0.0, 0.0, 0.0)
        if not is_list(value):
            return [f",{_part(reader, root, value, model, kind)},3,{_numbers(about)}"]
        parts = [_part(reader, root, one, model, kind) for one in value.value]
        if not parts:
            reader.error(value, "force: expected the number or the title of a part, or a list of them")
            return []
        model.keywords.append(part_set(_FIRST_SET + number, parts))
        return [f",{_FIRST_SET + number},2,{_numbers(about)}"]
    if kind == "point":
        body = reader.get(node, "with")
        if reader.dim and is_list(value) and len(value.value) != reader.dim and 2 <= len(value.value) <= 3:
            reader.error(value, f"point: expected {reader.dim} components, got {len(value.value)}")
        return [f",{_numbers(reader.vector(node, kind)[0])},{_part(reader, root, body, model, 'with') if body is not None else 0}"]
    points = _points(reader, value, kind)
    return [""] if not points else ["", ",".join(_numbers(one) for one in points[:2]), *(_numbers(one) for one in points[2:])]


def _points(reader: SceneReader, node: Node, kind: str) -> list[tuple[float, float, float]]:
    least, most = _KINDS[kind]
    example = f"{kind}: [[0, 0], [0, 1]]" + (" in the plane, three corners in space" if kind == "flux" else "")
    if not is_list(node) or not least <= len(node.value) <= most:
        reader.error(node, f"{kind}: expected {'two points' if most == 2 else 'two or three points'}", example)
        return []
    out = []
    for one in node.value:
        if not is_list(one) or not 2 <= len(one.value) <= 3:
            reader.error(one, f"{kind}: expected [x, y] or [x, y, z]", example)
            return []
        if reader.dim and len(one.value) != reader.dim:
            reader.error(one, f"{kind}: expected {reader.dim} components, got {len(one.value)}", example)
            return []
        values = [reader.number(part, kind) or 0.0 for part in one.value]
        out.append((values[0], values[1], values[2] if len(values) > 2 else 0.0))
    if _size(out) == 0:
        reader.error(node, f"{kind}: {'the corners are on a line' if len(out) == 3 else 'start and end are the same point'}", example)
    if kind == "flux" and any(len(one.value) != len(out) for one in node.value):
        reader.error(node, "flux: expected two points [x, y] in the plane, three corners [x, y, z] in space", example)
    return out


def _size(points: list[tuple[float, float, float]]) -> float:
    """Length between two points, area between three; 0 within round-off."""
    edges = [np.array(one) - np.array(points[0]) for one in points[1:]]
    if len(edges) == 1:
        return float(np.linalg.norm(edges[0]))
    area, scale = float(np.linalg.norm(np.cross(*edges))), float(np.linalg.norm(edges[0]) * np.linalg.norm(edges[1]))
    return area if area > 1e-6 * scale else 0.0


def _part(reader: SceneReader, root: Node, node: Node, model: Model, key: str) -> int:
    """A part by its number, or by the title that the scene gave it; it has shells, as particles neither are faces nor move a point."""
    if not is_scalar(node):
        reader.error(node, "expected the number or the title of a part")
        return 0
    text = reader.text(node)
    number = named_part(reader, node, key, {part.id: part.title for part in model.parts})
    if number is None:
        return 0
    found = next((part for part in model.parts if part.id == number), None)
    if found is None and not reader.complete:  # it may be one that could not be read
        titles = described(reader, root)
        if titles is not None and text not in titles and not text.isdigit():
            reader.error(node, f"{key}: the scene has no part '{text}'", f"{did_you_mean(text, titles)}its parts: {', '.join(titles)}")
        return 0
    if found is None:
        # keywords may bring parts of their own, which only the program knows
        if text.isdigit() and any("*PART" in (upper := block.upper()) or "*INCLUDE" in upper for block in model.keywords):
            return int(text)
        reader.error(node, f"{key}: the scene has no part '{text}'",
                     f"{did_you_mean(text, [part.title for part in model.parts])}its parts: {', '.join(f'{part.title} ({part.id})' for part in model.parts)}")
    elif found.plates and found.plates[0].shells().shape[1] == 2:
        reader.error(node, f"{key}: part '{text}' has beams alone, which water flows through", "name a wall, a body or a structure with faces")
    elif not (found.plates or found.solids):
        reader.error(node, f"{key}: part '{text}' has particles alone", "name a wall or a body: a part with faces")
    return number


def _numbers(point: Sequence[float]) -> str:
    return ",".join(shortest(value) for value in point)
