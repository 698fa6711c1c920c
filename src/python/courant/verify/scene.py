"""Values of the parameters of a scene, as `courant generate` would find them. Faults of a scene are told by `courant generate` itself: here a
scene with a fault has no values."""
from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, evaluate
from ..yaml_map import Node, is_list, is_map, load_yaml, scalar_text
from .model import Case, Parameters, Variables


def _map(file: Path) -> dict[str, Node]:
    """The values of a YAML file. Raises ExpressionFault where it is no map."""
    return _entries(load_yaml(file, "scene", "", Diagnostics()))


def _entries(node: Node | None) -> dict[str, Node]:
    if node is None or not is_map(node) or len({scalar_text(key) for key, _ in node.value}) < len(node.value):
        raise ExpressionFault("no map, or one in which a key stands twice")
    return {scalar_text(key): value for key, value in node.value}


@dataclass
class _Base:
    """A file that scenes have in common. `above`: names of parameters of the files that this one is a base of."""

    file: Path
    entries: dict[str, Node]
    above: set[str]


def _names_of(entries: Mapping[str, Node]) -> set[str]:
    return set(_entries(entries["parameters"])) if "parameters" in entries else set()


def _bases(file: Path, entries: Mapping[str, Node], above: set[str], found: dict[Path, _Base]) -> None:
    """Adds the bases of a file, each once and after its own. Raises ExpressionFault where one cannot be read."""
    base = entries.get("base")
    for node in [] if base is None else base.value if is_list(base) else [base]:
        path = Path(os.path.normpath(file.parent / scalar_text(node)))
        if path in found:
            found[path].above |= above
            continue
        inner = _map(path)
        _bases(path, inner, above | _names_of(inner), found)
        found[path] = _Base(path, inner, set(above))


def scene_files(file: Path) -> list[Path]:
    """The scene, its bases, and theirs."""
    found: dict[Path, _Base] = {}
    try:
        entries = _map(file)
        _bases(file, entries, _names_of(entries), found)
    except (ExpressionFault, RecursionError):
        pass
    return [file, *found]


def scene_values(file: Path, overrides: Mapping[str, str]) -> Variables | None:
    """Values of all parameters and of pi; None if the scene has a fault that keeps them from being known. Parameters of bases count as soon as all
    that they need is there, the scene's own one after the other; of several of the same name that of the file which has the others as bases."""
    values: Variables = {"pi": math.pi}

    def take(name: str, node: Node) -> None:
        if name in values:
            raise ExpressionFault("it stands twice")
        values[name] = evaluate(overrides.get(name, scalar_text(node)), values)

    def take_ready(waiting: list[tuple[str, Node]]) -> list[tuple[str, Node]]:
        """Those of bases that wait on, after all that can be has been taken."""
        left = []
        for name, node in waiting:
            try:
                evaluate(scalar_text(node), values)
            except ExpressionFault:
                left.append((name, node))
            else:
                take(name, node)
        return left if len(left) == len(waiting) else take_ready(left)

    try:
        entries, found = _map(file), dict[Path, _Base]()
        _bases(file, entries, _names_of(entries), found)
        waiting = take_ready([(name, node) for base in found.values() if "parameters" in base.entries
                              for name, node in _entries(base.entries["parameters"]).items() if name not in base.above])
        for name, node in _entries(entries["parameters"]).items() if "parameters" in entries else ():
            take(name, node)
            waiting = take_ready(waiting)
        for name, node in waiting:
            take(name, node)
    except (ExpressionFault, RecursionError):
        return None
    return values if all(name in values for name in overrides) else None


def parameter_values(case: Case, overrides: Parameters) -> Variables | None:
    """Values of the parameters of a case: of a scene all it has; of a deck, the overrides that are numbers; and pi."""
    if case.scene is not None:
        return scene_values(case.scene, overrides)
    out: Variables = {"pi": math.pi}
    for name, text in overrides.items():
        try:
            out[name] = evaluate(text, {})
        except ExpressionFault:
            continue
    return out
