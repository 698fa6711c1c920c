"""Tables of the keys that maps of scenes, recipes and suites may have. The readers check by them, and the JSON schemas are made of them."""

from __future__ import annotations

TABLES: dict[str, dict[str, str]] = {}
"""By map: kinds of its values by key. A kind is a word of the schema (`schema.py`: number, text, flag, list, any, ...), @MAP, or [@MAP] for a list of
such maps; several are separated by |. A ! behind it: the key is required."""


def keys(of: str, entries: str) -> tuple[str, ...]:
    """Adds a table, "low vector!, high vector!, motion @motion", and gives the names of its keys."""
    table = dict(entry.split(None, 1) for entry in entries.split(", "))
    if TABLES.setdefault(of, table) != table:
        raise ValueError(f"there are two tables of '{of}'")
    return tuple(table)
