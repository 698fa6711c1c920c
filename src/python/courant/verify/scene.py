"""Values of the parameters of a scene, as `courant generate` would find them. Faults of a scene are told by `courant generate` itself: here a
scene with a fault has no values."""
from __future__ import annotations

import math
from collections.abc import Mapping
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


def scene_files(file: Path) -> list[Path]:
    """The scene and its bases."""
    try:
        base = _map(file).get("base")
    except ExpressionFault:
        return [file]
    names = [] if base is None else base.value if is_list(base) else [base]
    return [file, *(file.parent / scalar_text(name) for name in names)]


def scene_values(file: Path, overrides: Mapping[str, str]) -> Variables | None:
    """Values of all parameters and of pi; None if the scene has a fault that keeps them from being known. Parameters of bases stand before the
    scene's own, but for those that need these; the scene's own stand above the bases' of the same name."""
    values: Variables = {"pi": math.pi}

    def take(name: str, node: Node) -> None:
        if name in values:
            raise ExpressionFault("it stands twice")
        values[name] = evaluate(overrides.get(name, scalar_text(node)), values)

    try:
        own, *bases = ([(name, node) for name, node in _entries(found["parameters"]).items()] if "parameters" in found else []
                       for found in map(_map, scene_files(file)))
        names, later = {name for name, _ in own}, []
        for name, node in (entry for base in bases for entry in base if entry[0] not in names):
            try:
                evaluate(scalar_text(node), values)
            except ExpressionFault:
                later.append((name, node))
            else:
                take(name, node)
        for name, node in own + later:
            take(name, node)
    except ExpressionFault:
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
