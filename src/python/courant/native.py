"""The extension module beside this package or the program, for runs in the process of Python."""
from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import sysconfig
from functools import lru_cache
from pathlib import Path
from typing import Any

from .program import executable


@lru_cache(maxsize=None)
def native() -> Any:
    """The module; None where it was not built, or for another Python."""
    name = "_courant" + str(sysconfig.get_config_var("EXT_SUFFIX"))
    program = executable()
    folders = [Path(__file__).parent, *([Path(os.path.realpath(program)).parent / "native"] if program else [])]
    file = next((folder / name for folder in folders if (folder / name).is_file()), None)
    if file is None:
        return None
    if "OMP_WAIT_POLICY" not in os.environ:
        os.environ.setdefault("GOMP_SPINCOUNT", "1000")  # as the program does: threads soon sleep; OpenMP reads it when it is loaded
    loader = importlib.machinery.ExtensionFileLoader("_courant", str(file))
    spec = importlib.util.spec_from_loader("_courant", loader)
    assert spec
    try:
        module = importlib.util.module_from_spec(spec)
        loader.exec_module(module)
    except ImportError:  # a library that it needs is not there
        return None
    return module
