"""Values of the parameters of a scene, as `courant generate` would find them.

Faults of a scene are told by `courant generate` itself: here a scene with a fault has no values.
"""
from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, evaluate
from ..yaml_map import Node, is_list, is_map, is_scalar, load_yaml, scalar_text
from .model import Case, Parameters, Variables


class _FaultyScene(Exception):
    pass


def _load(file: Path) -> Node:
    node = load_yaml(file, "scene", "", Diagnostics())
    if node is None or not is_map(node):
        raise _FaultyScene
    return node


def _value(node: Node | None, key: str) -> Node | None:
    return next((v for k, v in node.value if scalar_text(k) == key), None) if node is not None and is_map(node) else None


def _entries(node: Node | None) -> Iterator[tuple[str, str, int]]:
    """Name, text and place of each parameter in the map `parameters` of a file."""
    parameters = _value(node, "parameters")
    if parameters is None:
        return
    if not is_map(parameters):
        raise _FaultyScene
    for key, value in parameters.value:
        if not is_scalar(key) or not is_scalar(value):
            raise _FaultyScene
        yield scalar_text(key), scalar_text(value), key.start_mark.index


class _Parameters:
    """Takes parameters one after the other; each may use those before it."""

    def __init__(self, overrides: Mapping[str, str]) -> None:
        self.overrides = overrides
        self.values: Variables = {"pi": math.pi}

    def take(self, name: str, text: str) -> None:
        if name in self.values:
            raise _FaultyScene
        try:
            self.values[name] = evaluate(self.overrides.get(name, text), self.values)
        except ExpressionFault:
            raise _FaultyScene from None

    def take_base(self, bases: list[Node], own: set[str], done: set[tuple[int, int]], every: bool) -> None:
        """Parameters of bases that can be evaluated, with `every` also those that cannot; the scene's own stand above them."""
        for number, base in enumerate(bases):
            for name, text, place in _entries(base):
                if name in own or (number, place) in done or not (every or self._ready(text)):
                    continue
                done.add((number, place))
                self.take(name, text)

    def _ready(self, text: str) -> bool:
        try:
            evaluate(text, self.values)
        except ExpressionFault:
            return False
        return True


def scene_files(file: Path) -> list[Path]:
    """The scene and its bases, as far as they can be read."""
    try:
        base = _value(_load(file), "base")
    except _FaultyScene:
        return [file]
    return [file, *_bases(file, base)]


def _bases(file: Path, base: Node | None) -> list[Path]:
    nodes = [] if base is None else base.value if is_list(base) else [base]
    return [file.parent / scalar_text(one) for one in nodes]


def scene_values(file: Path, overrides: Mapping[str, str]) -> Variables | None:
    """Values of all parameters and of pi; None if the scene has a fault that keeps them from being known."""
    try:
        root = _load(file)
        bases = [_load(one) for one in _bases(file, _value(root, "base"))]
        own = list(_entries(root))
        found, done = _Parameters(overrides), set[tuple[int, int]]()
        own_names = {name for name, _, _ in own}
        found.take_base(bases, own_names, done, every=False)
        for name, text, _ in own:
            found.take(name, text)
        found.take_base(bases, own_names, done, every=True)
    except _FaultyScene:
        return None
    return found.values if all(name in found.values for name in overrides) else None


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
