"""Damping zones of a scene: entries of `damping:` in YAML, and `Scene.damping` in Python."""
from __future__ import annotations

from typing import TYPE_CHECKING

from ..key_tables import keys as keys_of_map
from ..words import shortest
from ..yaml_map import Node, is_list

if TYPE_CHECKING:
    from .model import Model, Vector
    from .reader import SceneReader

_KEYS = keys_of_map("a damping zone", "start vector!, end vector!, rate number!, exponent number")
_EXAMPLE = "- {start: [6, 0], end: [8, 0], rate: 5}"


def read_damping(reader: SceneReader, root: Node, model: Model) -> None:
    """Adds the cards of all damping zones of a scene to its keywords."""
    node = reader.get(root, "damping")
    if node is None:
        return
    if not is_list(node) or not node.value:
        reader.error(node, "damping: expected a list that is not empty", _EXAMPLE)
        return
    for entry in node.value:
        if reader.is_map(entry, _EXAMPLE, "a damping zone"):
            _read_zone(reader, entry, model)


def _read_zone(reader: SceneReader, node: Node, model: Model) -> None:
    reader.check_keys(node, "a damping zone", _KEYS)
    before = reader.diagnostics.errors
    (start, dim), (end, end_dim) = reader.vector(node, "start"), reader.vector(node, "end")
    rate = _above_zero(reader, node, "rate")
    exponent = _above_zero(reader, node, "exponent") if reader.get(node, "exponent") is not None else 2.0
    if reader.diagnostics.errors > before:
        return
    if dim != end_dim or (reader.dim and dim != reader.dim):
        reader.error(node, f"a damping zone: start and end have as many components as the scene has dimensions, {reader.dim or dim}", _EXAMPLE)
    elif start == end:
        reader.error(node, "a damping zone: start and end are the same point", "damping grows from start to end")
    else:
        model.keywords.append(f"*COURANT_DAMPING_ZONE\n{_numbers(start)},{_numbers(end)},{shortest(rate)}\n{shortest(exponent)}\n")
        model.choices.append((f"water is slowed down from {_shown(start, dim)} to {_shown(end, dim)} and beyond", "given", "*COURANT_DAMPING_ZONE"))


def _above_zero(reader: SceneReader, node: Node, key: str) -> float:
    entry = reader.get(node, key)
    if entry is None:
        reader.error(node, f"'{key}' is missing", _EXAMPLE)
        return 0.0
    value = reader.number(entry, key)
    if value is not None and not value > 0:
        reader.error(entry, f"{key}: expected a number > 0, got {shortest(value)}")
    return value or 0.0


def _numbers(point: Vector) -> str:
    return ",".join(shortest(value) for value in point)


def _shown(point: Vector, dim: int) -> str:
    return f"({', '.join(shortest(value) for value in point[:dim])})"
