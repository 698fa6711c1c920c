"""Takes in a user's own Python file (`--load my.py`), whose decorators register more analyses, observations and charts."""

from __future__ import annotations

import importlib.util
import sys
import traceback
from pathlib import Path


class LoadFault(Exception):
    """A file that could not be taken in; the text says why, with its line."""


def load_user_file(file: str) -> None:
    """Runs the file as a module of its own. Raises LoadFault."""
    path = Path(file)
    spec = importlib.util.spec_from_file_location(f"courant_user_{path.stem}", path) if path.suffix == ".py" else None
    if spec is None or spec.loader is None or not path.is_file():
        raise LoadFault(f"{file}: cannot be read: expected a file of Python, NAME.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    try:
        spec.loader.exec_module(module)
    except Exception as fault:  # whatever a user's file raises is told with its place
        raise LoadFault(f"{place_of(fault, file)}{type(fault).__name__}: {fault}") from fault


def place_of(fault: BaseException, file: str = "") -> str:
    """ "FILE:LINE: " of where something was raised, the last place within `file` if that is given."""
    frames = [frame for frame in traceback.extract_tb(fault.__traceback__) if file in ("", frame.filename) or frame.filename.endswith(file)]
    return f"{frames[-1].filename}:{frames[-1].lineno}: " if frames else f"{file}: " if file else ""
