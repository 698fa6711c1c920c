"""`courant report DIR`, `courant report A B`."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..ascii_histories import ASCII_NAMES, AsciiFile
from ..binout import binout_files
from ..diagnostics import CourantError, Diagnostics
from ..files import write_file
from ..results import Results
from ..terminal import Parser, exit_code_of, say
from .page import page_of

_OWN_KEYS = ("version", "termination", "verdict", "energy", "passes", "deck")


def _fault(message: str, folder: Path, hint: str) -> CourantError:
    diagnostics = Diagnostics()
    diagnostics.error(folder, message, hint)
    return CourantError(diagnostics)


def _is_there(run: Results, what: str) -> bool:
    """Whether a file of a run can be read, and has content."""
    try:
        if what == "summary.yaml":
            return any(key in run.summary for key in _OWN_KEYS)
        return len(getattr(run, what)) > 0
    except CourantError:
        return False


def results_of(folder: str) -> Results:
    """Raises CourantError where there are no results of a run in the folder, of Courant or LS-DYNA."""
    run = Results(folder)
    here = run.folder
    log = here / "messag"
    if log.is_file() and log.read_bytes()[:200].lstrip().startswith(b"Courant"):
        return run
    if any((here / name).is_file() and AsciiFile.open(here / name, Diagnostics()) is not None for name in ASCII_NAMES):
        return run
    candidates = {"summary.yaml": here / "summary.yaml", "histories": here / "history.h5", "states": here / "fields.pvd", "d3plot": here / "d3plot"}
    if any(file.is_file() and _is_there(run, what) for what, file in candidates.items()) or (binout_files(here) and _is_there(run, "binout")):
        return run
    try:
        known = sorted(file.name for file in here.iterdir())
    except OSError:
        known = []
    damaged = [name for name in known if name in ("summary.yaml", "history.h5", "fields.pvd", "d3plot", *ASCII_NAMES) or name.startswith("binout")]
    said = "no results of a run here" + (f" that can be read ({', '.join(damaged)} cannot)" if damaged else "" if known else ": the folder is empty")
    raise _fault(said, here, "DIR must be the folder that `courant run -o DIR` wrote; nothing was written")


def main(words: Sequence[str]) -> int:
    """The exit code: 0, 1 where a folder has faults, 2 where the page could not be written, 3 where a module is missing."""
    parser = Parser("courant report", allow_abbrev=False, description="one HTML page on a run, or on two that are compared")
    parser.add_argument("folders", metavar="DIR", nargs="+", help="folder of a run, or two to compare")
    parser.add_argument("-o", "--output", metavar="FILE", help="the page; DIR/report.html if not given")
    call = parser.parse_args(list(words))
    if len(call.folders) > 2:
        parser.error("one folder, or two")

    def write() -> None:
        runs = [results_of(folder) for folder in call.folders]
        file = Path(call.output) if call.output else runs[0].folder / "report.html"
        write_file(file, page_of(runs), named=call.output is not None)
        say(f"report: {file}\n")

    return exit_code_of(write)
