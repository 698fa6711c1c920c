"""Functions by name, added with a decorator: analyses, observations, charts; `--load my.py` adds more."""
from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Generic, TypeVar

from .files import note_input

Function = TypeVar("Function")


class Registry(Generic[Function]):
    """Functions by name, in the order in which they were added. A name that stands twice is refused. `homes`: modules that add names of their
    own, by name; they are imported when one of their names is asked for.

        take = Registry("take")

        @take("spread")
        def spread(series, at): ...
    """

    def __init__(self, what: str, homes: Mapping[str, str] | None = None) -> None:
        self.what, self._homes = what, dict(homes or {})
        self.functions: dict[str, Function] = {}

    def add(self, name: str, function: Function) -> Function:
        if name in self.functions or self._homes.get(name, __name__) not in sys.modules:
            raise ValueError(f"there is a {self.what} '{name}' already")
        self.functions[name] = function
        return function

    def __call__(self, name: str) -> Callable[[Function], Function]:
        return lambda function: self.add(name, function)

    def __getitem__(self, name: str) -> Function:
        if name not in self.functions and name in self._homes:
            importlib.import_module(self._homes[name])
        return self.functions[name]

    def __contains__(self, name: str) -> bool:
        return name in self._homes or name in self.functions

    def names(self) -> list[str]:
        return list(dict.fromkeys([*self._homes, *self.functions]))


class LoadFault(Exception):
    """A file of a user that cannot be loaded; the text states why."""


def load_file(file: str | Path) -> None:
    """Runs a user's file, whose decorators add functions. Raises LoadFault."""
    path = Path(file)
    name = f"courant_load_{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None or not path.is_file():
        raise LoadFault(f"'{file}' is no Python file")
    note_input(path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # as dataclasses of the file need it
    try:
        spec.loader.exec_module(module)
    except Exception as fault:  # whatever the file does wrong is reported to its user
        del sys.modules[name]
        raise LoadFault(f"'{file}': {type(fault).__name__}: {fault}") from fault
