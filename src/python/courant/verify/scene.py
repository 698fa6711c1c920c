"""Values of the parameters of a scene, as `courant generate` finds them, which tells faults of a scene itself: here a scene with a fault has no values."""
from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, evaluate
from ..scene.parameters import ParameterReader
from ..yaml_map import is_map
from .builders import BuildFault
from .model import Case, Parameters, Variables


def _read(file: Path, overrides: Mapping[str, str]) -> ParameterReader:
    reader = ParameterReader(str(file), overrides, Diagnostics())
    try:
        root = reader.load(str(file))
    except OSError:
        root = None
    if root is not None and is_map(root):
        reader.read_parameters(root)
    else:
        reader.diagnostics.error(file, "no map")
    return reader


def scene_files(file: Path) -> list[Path]:
    """The scene, its bases, and theirs."""
    return [file, *(Path(base.path) for base in _read(file, {}).bases)]


def scene_values(file: Path, overrides: Mapping[str, str]) -> Variables | None:
    """Values of all parameters and of pi; None if the scene has a fault that keeps them from being known."""
    reader = _read(file, overrides)
    return reader.variables if reader.diagnostics.ok else None


def parameter_values(case: Case, overrides: Parameters) -> Variables | None:
    """Values of the parameters of a case: of a scene or builder all it has; of a deck, the overrides that are numbers; and pi."""
    if case.scene is not None:
        return scene_values(case.scene, overrides)
    if case.build is not None:
        try:
            return case.build.values(overrides)
        except BuildFault:
            return None
    out: Variables = {"pi": math.pi}
    for name, text in overrides.items():
        try:
            out[name] = evaluate(text, {})
        except ExpressionFault:
            continue
    return out
