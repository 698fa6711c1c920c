"""Reads summary.yaml of a run, and says which of its entries are not what `courant run` writes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from .diagnostics import CourantError, Diagnostics

_LISTS = ("verdict_reasons", "warnings", "passes", "ranges", "restart_notes")
_MAPS = ("units", "energy", "output", "counters", "maxima")
_NUMBERS = ("time", "steps", "dt_min", "dt_max", "particles", "elements", "wall_seconds", "cpu_seconds", "threads")
_WORDS = {dict: "a map", list: "a list", str: "a text", bool: "a flag", int: "a number", float: "a number", type(None): "nothing"}


def _is_number(value: Any) -> bool:
    if isinstance(value, str):  # YAML 1.1 takes 1e-06 for a text
        try:
            float(value)
        except ValueError:
            return False
        return True
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _faults(found: Mapping[str, Any]) -> list[str]:
    wrong = [(key, "a list") for key in _LISTS if key in found and not isinstance(found[key], (list, type(None)))]
    wrong += [(key, "a map") for key in _MAPS if key in found and not isinstance(found[key], (dict, type(None)))]
    wrong += [(key, "a number") for key in _NUMBERS if key in found and not _is_number(found[key])]
    return [f"'{key}' is {_WORDS.get(type(found[key]), 'something else')}, not {what}" for key, what in wrong]


def read_summary(file: Path) -> dict[str, Any]:
    """What the file holds; an empty file holds nothing. Raises CourantError where it cannot be read, or is none of a run."""
    diagnostics = Diagnostics()
    try:
        found = yaml.safe_load(file.read_bytes())
    except (yaml.YAMLError, ValueError, OSError, RecursionError) as fault:
        diagnostics.error(file, f"not valid YAML: {' '.join(str(fault).split())}")
        raise CourantError(diagnostics) from fault
    if found is None:
        return {}
    hint = "the file has been changed; run the deck again"
    if not isinstance(found, dict):
        diagnostics.error(file, f"not the summary of a run: it is {_WORDS.get(type(found), 'something else')}, not a map", hint)
        raise CourantError(diagnostics)
    for what in _faults(found):
        diagnostics.error(file, f"not the summary of a run: {what}", hint)
    if not diagnostics.ok:
        raise CourantError(diagnostics)
    return found
