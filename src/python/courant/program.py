"""The program within or beside this package."""
from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path


def executable(given: str | os.PathLike[str] | None = None) -> str:
    """The program that runs decks: as given, of COURANT_EXECUTABLE, beside the package, of a build of the sources, on the PATH; "" if there is none."""
    if named := given or os.environ.get("COURANT_EXECUTABLE"):
        return str(Path(named).absolute())
    here = Path(__file__).resolve()
    beside = [folder / "bin" / "courant" for folder in here.parents[:6]]
    builds = sorted(here.parents[3].glob("build/*/courant"), key=lambda file: -file.stat().st_mtime) if len(here.parents) > 3 else []
    found = next((file for file in [*beside, *builds] if os.access(file, os.X_OK) and file.is_file()), None) or shutil.which("courant")
    return str(found or "")


def main() -> int:
    """The call `courant` of a wheel: the program, whose calls in Python are those of this interpreter."""
    program = executable()
    if not program:
        sys.stderr.write("error: the program courant is not found\n  hint: name it in COURANT_EXECUTABLE\n")
        return 3
    os.environ.setdefault("COURANT_PYTHON", sys.executable)
    os.execv(program, [program, *sys.argv[1:]])
