"""Nodes, elements, sets and curves of a deck as arrays."""
from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from ..scene.numbers import numbers
from .blocks import Block, column_width, split_at_commas, value_of


class Elements(NamedTuple):
    ids: np.ndarray  # (m,)
    parts: np.ndarray  # (m,)
    nodes: np.ndarray  # (m, corners); 0 where a line has none


def fixed(values: np.ndarray) -> np.ndarray:
    """Made read-only: what is written into it would not be in the deck."""
    values.setflags(write=False)
    return values


def _table(block: Block, widths: list[int]) -> np.ndarray:
    """Numbers of all cards, one after the other in fields of these widths, (rows, fields); 0 where blank. Raises CourantError."""
    rows = block.rows
    widths = [column_width(width, block._wide) for width in widths]
    ends = np.cumsum(widths)
    out = np.zeros((len(rows), len(widths)))
    for k, row in enumerate(rows):
        line = block.lines[row].rstrip("\r\n")
        words = split_at_commas(line, ends[-1]) or [line[end - width : end] for end, width in zip(ends, widths)]
        for j, word in enumerate(words[: len(widths)]):
            if not word.strip():
                continue
            try:
                out[k, j] = float(word)
            except ValueError:
                value = value_of(word)
                if not isinstance(value, (int, float)):
                    raise block.fault(f"'{word.strip()}' in card {k + 1} is not a number: a mesh with parameters is not read as arrays") from None
                out[k, j] = value
    return out


def nodes_of(blocks: Iterable[Block]) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (n,) and positions (n, 3) [L]."""
    found = [_table(block, [8, 16, 16, 16]) for block in blocks if block.name == "NODE"]
    rows = np.concatenate(found) if found else np.zeros((0, 4))
    return rows[:, 0].astype(np.int64), rows[:, 1:].copy()


def write_points(blocks: Iterable[Block], points: np.ndarray, before: np.ndarray) -> None:
    """Writes the positions that have changed; all of a line, 15 columns each."""
    at = 0
    for block in blocks:
        if block.name != "NODE":
            continue
        rows = block.rows
        some = np.flatnonzero((points[at : at + len(rows)] != before[at : at + len(rows)]).any(axis=1))
        width, begin = column_width(16, block._wide), column_width(8, block._wide)
        texts = [numbers(points[at + some, k], 15, width) for k in range(3)]
        for j, k in enumerate(some):
            line = block.lines[rows[k]].rstrip("\r\n")
            tail = block.lines[rows[k]][len(line):]
            new = [texts[axis][j].tobytes().decode() for axis in range(3)]
            if words := split_at_commas(line, begin + 3 * width):
                line = ",".join([words[0], *(text.strip() for text in new), *words[4:]])
            else:
                line = line.ljust(begin)[:begin] + "".join(new) + line[begin + 3 * width :]
            block.lines[rows[k]] = line + tail
        at += len(rows)


_CORNERS = {"SHELL": 4, "SOLID": 8, "BEAM": 3, "SPH": 0, "DISCRETE": 2}


def elements_of(blocks: Iterable[Block]) -> dict[str, Elements]:
    """By kind; of names with options, whose further cards are not corners, only those whose lines are corners alone. Raises CourantError."""
    found: dict[str, list[Elements]] = {}
    for block in blocks:
        kind = block.name.removeprefix("ELEMENT_")
        if kind == block.name or kind.split("_")[0] not in _CORNERS:
            continue
        if kind not in _CORNERS:
            raise block.fault("elements of this keyword have cards of their own: they are not read as arrays")
        if kind == "SPH":
            rows = _table(block, [8, 8])
            found.setdefault(kind, []).append(Elements(rows[:, 0].astype(np.int64), rows[:, 1].astype(np.int64), rows[:, :1].astype(np.int64)))
            continue
        rows = _table(block, [8] * (2 + (10 if kind == "SOLID" else _CORNERS[kind]))).astype(np.int64)
        if kind == "SOLID" and len(rows) and not rows[0, 2:].any():  # number and part on one line, all nodes on the next
            rows = np.column_stack([rows[::2, :2], rows[1::2, :10]])
        found.setdefault(kind, []).append(Elements(rows[:, 0], rows[:, 1], rows[:, 2 : 2 + _CORNERS[kind]] if not rows[:, 10:].any() else rows[:, 2:]))
    return {kind: Elements(*(fixed(np.concatenate(some)) for some in zip(*several))) for kind, several in found.items()}


def sets_of(blocks: Iterable[Block]) -> dict[tuple[str, int], np.ndarray]:
    """Of *SET_..._LIST and *SET_... with its options, by kind and number."""
    out: dict[tuple[str, int], np.ndarray] = {}
    for block in blocks:
        words = block.name.split("_")
        if words[0] != "SET" or len(words) < 2 or words[1] == "SEGMENT" or not set(words[2:]) <= {"LIST", "TITLE", "COLLECT"}:
            continue
        rows = block.rows["TITLE" in words :]
        if not rows:
            continue
        width = 20 if block._wide > 10 else 10
        values = [value_of(word) for row in rows for word in _words(block.lines[row], width, 8)]
        first = [value_of(word) for word in _words(block.lines[rows[0]], width, 8)]
        found = np.array([value for value in values[len(first):] if isinstance(value, int) and value], dtype=np.int64)
        if not isinstance(first[0], int):
            raise block.fault(f"its number '{first[0]}' is a parameter: sets with parameters are not read as arrays")
        key = (words[1], first[0])
        out[key] = fixed(np.concatenate([out[key], found]) if key in out else found)
    return out


def _words(line: str, width: int, most: int) -> list[str]:
    line = line.rstrip("\r\n")
    return split_at_commas(line, width * most) or [line[k : k + width] for k in range(0, min(len(line), width * most), width)]


def curves_of(blocks: Iterable[Block]) -> dict[int, np.ndarray]:
    out = {}
    for block in blocks:
        if block.name not in ("DEFINE_CURVE", "DEFINE_CURVE_TITLE"):
            continue
        rows = block.rows[block.name.endswith("_TITLE") :]
        number = value_of(_words(block.lines[rows[0]], 20 if block._wide > 10 else 10, 8)[0])
        points = []
        for row in rows[1:]:
            pair = [value_of(word) for word in (_words(block.lines[row], 20, 2) + ["", ""])[:2]]
            if any(isinstance(one, str) for one in pair):
                raise block.fault(f"a point of curve {number} is not two numbers: curves with parameters are not read as arrays")
            points.append([float(one or 0) for one in pair])
        if isinstance(number, int):
            out[number] = fixed(np.array(points, dtype=float).reshape(-1, 2))
    return out
