"""Gauges of a scene: entries of `gauges:` in YAML, and `Scene.gauge` in Python."""
from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..words import did_you_mean, shortest
from ..yaml_map import Node, is_list, is_scalar

if TYPE_CHECKING:
    from .model import Model
    from .reader import SceneReader

# Each kind with the corners of its points in the plane and in space: the least and the most.
_KINDS = {"point": (1, 1), "level": (2, 2), "runup": (2, 2), "flux": (2, 3), "force": (0, 0)}
_KEYS = (*_KINDS, "name", "interval", "with", "about")
_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,59}", re.ASCII)


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
            _read_gauge(reader, entry, number, usual, model, names)


def _read_gauge(reader: SceneReader, node: Node, number: int, usual: float, model: Model, names: set[str]) -> None:
    reader.check_keys(node, "a gauge", _KEYS)
    before = reader.diagnostics.errors
    given = [kind for kind in _KINDS if reader.get(node, kind) is not None]
    if len(given) != 1:
        reader.error(node, "a gauge has one of " + ", ".join(_KINDS), "- {name: p1, point: [0.1, 0.2]}")
        return
    kind = given[0]
    name_node = reader.get(node, "name")
    name = reader.text(name_node) if name_node is not None else f"{kind}{number}"
    if not _NAME.fullmatch(name):
        reader.error(name_node or node, f"name: '{name}' is no name of a file", "letters, digits, - and _, at most 60")
    if name in names:
        reader.error(name_node or node, f"two gauges are called '{name}'")
    names.add(name)
    interval = reader.length(node, "interval", "time") if reader.get(node, "interval") is not None else usual
    if not interval > 0 and reader.diagnostics.errors == before:
        reader.error(node, "'interval' is missing", "the scene has no 'end' from which one could follow")
    for key, only in (("with", "point"), ("about", "force")):
        if (entry := reader.get(node, key)) is not None and kind != only:
            reader.error(entry, f"'{key}' goes with '{only}'")
    cards = _cards(reader, node, kind, model)
    if reader.diagnostics.errors == before:
        front, *more = cards
        model.keywords.append(f"*COURANT_GAUGE_{kind.upper()}_TITLE\n{name}\n{number},{shortest(interval)}{front}\n" + "".join(f"{one}\n" for one in more))


def _cards(reader: SceneReader, node: Node, kind: str, model: Model) -> list[str]:
    """What follows the interval on the first card, and the cards behind it."""
    value = reader.get(node, kind)
    assert value is not None
    if kind == "force":
        about = reader.vector(node, "about")[0] if reader.get(node, "about") is not None else (0.0, 0.0, 0.0)
        return [f",{_part(reader, value, model)},3,{_numbers(about)}"]
    if kind == "point":
        body = reader.get(node, "with")
        return [f",{_numbers(reader.vector(node, kind)[0])},{_part(reader, body, model) if body is not None else 0}"]
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
        values = [reader.number(part, kind) or 0.0 for part in one.value]
        out.append((values[0], values[1], values[2] if len(values) > 2 else 0.0))
    if kind == "flux" and any(len(one.value) != len(out) for one in node.value):
        reader.error(node, "flux: expected two points [x, y] in the plane, three corners [x, y, z] in space", example)
    return out


def _part(reader: SceneReader, node: Node, model: Model) -> int:
    """A part by its number, or by the title that the scene gave it."""
    if not is_scalar(node):
        reader.error(node, "expected the number or the title of a part")
        return 0
    text = reader.text(node)
    titles = {part.title: part.id for part in model.parts}
    if text in titles:
        return titles[text]
    if text.isdigit():
        return int(text)
    reader.error(node, f"the scene has no part '{text}'", f"{did_you_mean(text, tuple(titles))}its parts: {', '.join(titles)}")
    return 0


def _numbers(point: Sequence[float]) -> str:
    return ",".join(shortest(value) for value in point)
