"""Words of messages: what somebody may have meant, and numbers as C++'s fmt prints them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, TypeVar


Key = TypeVar("Key")
Value = TypeVar("Value")


class Named(dict[Key, Value]):
    """A dictionary whose KeyError has the keys that there are. `what` one is: "gauge"."""

    def __init__(self, what: str, entries: dict[Key, Value]) -> None:
        super().__init__(entries)
        self.what = what

    def __missing__(self, key: Any) -> Value:
        there = ", ".join(str(one) for one in self) or "none"
        near = did_you_mean(key, (one for one in self if isinstance(one, str))) if isinstance(key, str) else ""
        raise KeyError(f"the run has no {self.what} {key!r}; {near}it has {there}")


def edit_distance(a: str, b: str) -> int:
    """Letters to insert, delete or replace to turn one word into the other."""
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        diagonal, row[0] = row[0], i
        for j, other in enumerate(b, 1):
            change = diagonal + (letter != other)
            diagonal = row[j]
            row[j] = min(change, row[j] + 1, row[j - 1] + 1)
    return row[-1]


def nearest_word(word: str, candidates: Iterable[str]) -> str:
    """The candidate with the fewest edits from `word`, or "" if none is near."""
    best = ""
    if len(word) > 100:  # a whole line is no misspelt word, and takes long to compare
        return best
    least = min(max(2, len(word) // 3) + 1, len(word))  # of a word of two letters, one at least must be right
    for candidate in candidates:
        if abs(len(candidate) - len(word)) >= least:
            continue
        distance = edit_distance(word, candidate)
        if distance < least:
            least, best = distance, candidate
    return best


def did_you_mean(word: str, candidates: Iterable[str]) -> str:
    """ "did you mean X? ", or "" if nothing is near."""
    near = nearest_word(word, candidates)
    return f"did you mean {near}? " if near else ""


def shortest(value: float) -> str:
    """The shortest text that reads as the same number, without a needless ".0"."""
    if not math.isfinite(value):
        return f"{value:g}"
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def short_number(value: float) -> str:
    """Text of a number for names of columns: "0.025"."""
    return f"{0 if abs(value) < 1e-12 else value:.6g}"
