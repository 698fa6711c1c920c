"""Modules that are imported where they are used, with a message that names the package where one is missing."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable, Mapping
from types import ModuleType
from typing import Any

_PACKAGES = {
    "scipy": "python3-scipy",
    "matplotlib": "python3-matplotlib",
    "jinja2": "python3-jinja2",
    "pandas": "python3-pandas",
    "xarray": "python3-xarray",
    "pyvista": "pip install pyvista",
    "vtkmodules": "python3-vtk9",
    "meshio": "pip install meshio",
    "gmsh": "pip install gmsh",
    "pygls": "pip install pygls",
    "lsprotocol": "pip install pygls",
}


class MissingModule(ImportError):
    """A module that is not there; the message states what to install."""


def module(name: str) -> ModuleType:
    """Imports a module. Raises MissingModule."""
    try:
        return importlib.import_module(name)
    except ImportError as fault:
        package = _PACKAGES.get(name.partition(".")[0], name)
        how = package if package.startswith("pip") else f"apt-get install {package}"
        within = "" if getattr(fault, "name", name) in (name, name.partition(".")[0]) else f" or lacks {fault.name}"
        raise MissingModule(f"the Python module '{name}' is missing{within}: {how}") from fault


def lazily(package: str, homes: Mapping[str, Iterable[str]]) -> Callable[[str], Any]:
    """A package's __getattr__ that imports names from their modules when they are asked for. `homes`: names by relative module."""
    home = {name: module for module, names in homes.items() for name in names}

    def get(name: str) -> Any:
        if name not in home:
            raise AttributeError(f"module '{package}' has no attribute '{name}'")
        return getattr(importlib.import_module(home[name], package), name)

    return get
