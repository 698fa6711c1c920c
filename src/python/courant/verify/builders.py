"""Decks that a function of a Python file makes of numbers: `build: FILE.py:FUNCTION`."""
from __future__ import annotations

import importlib.util
import inspect
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any

from ..expressions import ExpressionFault, evaluate
from .model import Variables


class BuildFault(Exception):
    """A builder that cannot be called; the text says why."""


@lru_cache
def _module(file: Path, _changed: int) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"courant_decks_{file.stem}", file)
    if spec is None or spec.loader is None:
        raise BuildFault(f"'{file}' is no Python file")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as fault:  # whatever a file of a user raises
        raise BuildFault(f"'{file}' cannot be loaded: {type(fault).__name__}: {fault}") from fault
    return module


@dataclass(frozen=True)
class Builder:
    """A function that takes numbers or texts by name, each with a default, and gives the text of a deck, or what has a text()."""

    file: Path
    function: str

    def _function(self) -> Callable[..., Any]:
        found = getattr(_module(self.file, self.file.stat().st_mtime_ns), self.function, None)
        if not callable(found):
            raise BuildFault(f"'{self.file}' has no function '{self.function}'")
        return found  # type: ignore[no-any-return]

    def arguments(self, overrides: Mapping[str, str]) -> dict[str, Any]:
        """Of a call: defaults, and overrides as the default is, a number or a text. Raises BuildFault."""
        out: dict[str, Any] = {}
        for name, parameter in inspect.signature(self._function()).parameters.items():
            if parameter.default is inspect.Parameter.empty:
                raise BuildFault(f"'{name}' of {self.function} has no default")
            out[name] = parameter.default
        values: Variables = {"pi": math.pi} | {name: float(value) for name, value in out.items() if isinstance(value, (int, float))}
        for name, text in overrides.items():
            if name not in out:
                raise BuildFault(f"{self.function} has no parameter '{name}': it has {', '.join(out)}")
            if isinstance(out[name], str):
                out[name] = text
                continue
            try:
                value = evaluate(text, values)
            except ExpressionFault as fault:
                raise BuildFault(f"{name}: {fault}") from None
            out[name] = int(value) if isinstance(out[name], int) else value
        return out

    def values(self, overrides: Mapping[str, str]) -> Variables:
        """Numbers among the arguments, and pi; what expressions of the suite may name. Raises BuildFault."""
        return {"pi": math.pi} | {name: float(value) for name, value in self.arguments(overrides).items() if not isinstance(value, str)}

    def deck(self, overrides: Mapping[str, str]) -> str:
        """Raises BuildFault."""
        arguments = self.arguments(overrides)
        try:
            made = self._function()(**arguments)
        except Exception as fault:
            raise BuildFault(f"{self.function}: {type(fault).__name__}: {fault}") from fault
        if isinstance(made, str):
            return made
        if not callable(getattr(made, "text", None)):
            raise BuildFault(f"{self.function} gives {type(made).__name__}, expected the text of a deck or a courant.DeckBuilder")
        return str(made.text())
