"""The call `courant post RECIPE DIR`; without a recipe it writes the page of `courant report`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from ..diagnostics import CourantError, Diagnostics, Location
from ..files import OutputError, make_folder
from ..optional import MissingModule
from ..registry import LoadFault, load_file
from ..terminal import EXIT_INPUT, EXIT_MISSED, EXIT_OK, EXIT_OTHER, Parser, clear_status_line, count, processors, say, status_line
from .parallel import ProcessLost
from .run import run_post

def view_of(field: str, folder: Path, diagnostics: Diagnostics) -> bool:
    """FIELD.png of the last state, in the folder `post` of the run. Raises CourantError, MissingModule, OutputError."""
    from ..results import Results
    from .views import View, draw_views

    run, out = Results(folder), folder / "post"
    make_folder(out)
    made = draw_views(run, [(View(field.replace(".", "_"), field), Location())], out, diagnostics)
    say("".join(f"view: {path}\n" for path in made))
    return diagnostics.ok


def main(words: Sequence[str]) -> int:
    """The exit code: 0, 1 where recipe or folder have faults, 2 where results could not be written."""
    parser = Parser("courant post", allow_abbrev=False, description="tables, CSV and pictures from the results of a run")
    parser.add_argument("recipe", metavar="RECIPE", nargs="?", help="recipe.yaml; without one, and without --view, DIR/report.html is written")
    parser.add_argument("folder", metavar="DIR", help="folder of the run")
    parser.add_argument("--view", metavar="FIELD", help="a picture of the last state by a field, with or without a recipe")
    parser.add_argument("--threads", type=count, default=0, metavar="N", help="processes at once; 0: all cores")
    parser.add_argument("--load", action="append", default=[], metavar="FILE.py", help="analyses and charts of your own")
    call = parser.parse_args(list(words))
    if not call.recipe and not call.view:
        from ..report import main as report

        return report([call.folder])
    diagnostics = Diagnostics()
    try:
        for file in call.load:
            load_file(file)
        done = not call.recipe or run_post(call.recipe, call.folder, say, diagnostics, status_line(), processors(call.threads))
        if call.view:
            done = view_of(call.view, Path(call.folder), diagnostics) and done
        code, fault = EXIT_OK if done else EXIT_INPUT, ""
    except LoadFault as error:
        code, fault = EXIT_INPUT, f"error: --load: {error}\n"
    except OutputError as error:
        code, fault = EXIT_MISSED, f"error: {error}\n"
    except CourantError as error:
        code, fault = EXIT_INPUT, f"{error}\n"
    except MissingModule as error:
        code, fault = EXIT_OTHER, f"error: {error}\n"
    except (MemoryError, ProcessLost):
        code, fault = EXIT_OTHER, "error: no memory is left, or a process was ended from outside\n  hint: fewer --threads take less memory\n"
    clear_status_line()
    sys.stdout.flush()
    sys.stderr.write(diagnostics.text() + fault)
    return code
