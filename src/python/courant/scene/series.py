"""Values over time: a list of [time, value], or a file of two numbers a line."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..files import note_input
from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list, is_map
from .outlines import two_columns

if TYPE_CHECKING:
    from .node_reader import NodeReader

_KEYS = keys_of_map("a curve", "file text!, scale number")
_EXAMPLE = "{file: motion.csv}, or [[0, 0], [1, 0.05]]: time and value"


def read_series(reader: NodeReader, folder: str, node: Node, what: str) -> np.ndarray | None:
    """Time and value (n, 2) of a list or of {file, scale}; None, with a message, where there are none."""
    scale: float | None = 1.0
    if is_map(node):
        reader.check_keys(node, what, _KEYS)
        if (factor := reader.get(node, "scale")) is not None:
            scale = reader.number(factor, "scale")
        file = reader.get(node, "file")
        if file is None:
            reader.missing(node, "file", _EXAMPLE)
            return None
        rows = read_record(reader, folder, file, what)
        return None if rows is None or scale is None else rows * [1.0, scale]
    if not is_list(node) or not all(is_list(one) and len(one.value) == 2 for one in node.value):
        reader.error(node, f"{what}: expected a list of [time, value], or a file", _EXAMPLE)
        return None
    values = [[reader.number(one, what) for one in row.value] for row in node.value]
    if any(value is None for row in values for value in row):
        return None
    return _checked(reader, node, np.array(values, dtype=float).reshape(-1, 2), what)


def read_record(reader: NodeReader, folder: str, node: Node, what: str) -> np.ndarray | None:
    """Two columns of the file that a node names, in the folder of the scene (n, 2); None, with a message, where there are none."""
    path = Path(folder, reader.text(node))
    try:
        note_input(path)
        rows = two_columns(path.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError) as fault:
        why = fault.strerror if isinstance(fault, OSError) else "it is no text" if isinstance(fault, UnicodeError) else fault
        reader.error(node, f"{what}: '{path}' cannot be read: {why}", "two numbers a line: time and value")
        return None
    return _checked(reader, node, rows, what)


def _checked(reader: NodeReader, node: Node, rows: np.ndarray, what: str) -> np.ndarray | None:
    expected = f"{what}: expected two rows of time and value or more, with times that go upwards"
    if len(rows) < 2:
        reader.error(node, f"{expected}; there are {len(rows)}")
    elif not np.isfinite(rows).all():
        reader.error(node, f"{expected}; row {np.argmin(np.isfinite(rows).all(axis=1)) + 1} has no finite numbers")
    elif not (rising := np.diff(rows[:, 0]) > 0).all():
        k = int(np.argmin(rising))
        reader.error(node, f"{expected}; row {k + 2} has time {rows[k + 1, 0]:g} after {rows[k, 0]:g}")
    else:
        return rows
    return None
