"""The command line of `courant verify`."""
from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from ..diagnostics import Diagnostics
from ..files import OutputError
from ..optional import MissingModule, module
from ..program import executable
from ..registry import LoadFault, load_file
from ..terminal import EXIT_INPUT, EXIT_MISSED, EXIT_OK, EXIT_OTHER, Parser, clear_status_line, count, say, status_line
from .changes import Comparison, compare_with
from .driver import Interrupted, Options, Refused, verify_suite
from .model import SuiteResult
from .report import write_page, write_reports
from .result_files import write_result_files
from .suite import read_suite
from .terminal import case_table, checks_text

def _parser() -> argparse.ArgumentParser:
    parser = Parser("courant verify", description="run a suite of cases: errors against run time, and stability", allow_abbrev=False)
    parser.add_argument("suite", metavar="SUITE", type=Path, help="suite.yaml")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="folder for runs and results; SUITE_verify if not given")
    parser.add_argument("--jobs", metavar="N", type=count, default=0, help="runs at once; 0: one per core")
    parser.add_argument("--only", metavar="CASE[,CASE...]", action="append", default=[], help="these cases alone")
    parser.add_argument("--compare", metavar="OLD.csv", type=Path, help="results.csv of an earlier call: report what got worse")
    parser.add_argument("--page", metavar="FILE.md", type=Path, help="also write a Markdown page with its charts in a folder beside it")
    parser.add_argument("--fresh", action="store_true", help="take over no runs of an earlier call")
    parser.add_argument("--load", metavar="FILE.py", action="append", default=[], help="adds observations, charts, ... of your own")
    parser.add_argument("--executable", type=Path, help=argparse.SUPPRESS)
    return parser


def _complain(text: str) -> None:
    clear_status_line()
    sys.stdout.flush()
    sys.stderr.write(text)


def _changes_text(changes: Comparison) -> str:
    lines = [f"  {'WORSE' if change.worse else '     '}  {change.text}\n" for change in changes.lines]
    return f"Against {changes.earlier} ({changes.compared} rows in both):\n" + ("".join(lines) or "  nothing has changed\n")


def _show_and_write(words: argparse.Namespace, result: SuiteResult, folder: Path) -> int:
    say("".join(f"\n{case_table(case)}" for case in result.cases) + f"\n{checks_text(result)}")
    changes, missed = None, not result.ok
    diagnostics = Diagnostics()
    if words.compare:  # before the files are written: the earlier results may be in the folder
        changes = compare_with(result, words.compare, diagnostics)
    write_result_files(result, folder)
    if words.compare and changes is None:
        _complain(diagnostics.text())
        return EXIT_INPUT
    if changes is not None:
        say(_changes_text(changes))
        missed = changes.regressed
    write_reports(result, folder, changes)
    if words.page:
        write_page(result, words.page, words.page.with_suffix(""))
    say(f"results are in {folder}: report.html, results.csv, results.yaml\n")
    return EXIT_MISSED if missed else EXIT_OK


def _verify(words: argparse.Namespace, stop: list[int]) -> int:
    folder = words.output or Path(words.suite.stem + "_verify")
    diagnostics = Diagnostics()
    suite = read_suite(words.suite, diagnostics)
    if words.compare and not words.compare.is_file():
        diagnostics.error(words.compare, "cannot read the earlier results", "give the results.csv of an earlier call")
    only = [name for names in words.only for name in names.split(",")]
    options = Options(folder, Path(executable(words.executable) or "courant"), words.jobs, words.fresh, only, lambda: bool(stop),
                      lambda line: say(line + "\n"), status_line())
    try:
        if not diagnostics.ok:
            raise Refused
        for name in ["jinja2", "matplotlib"] + ["scipy"] * any(case.picture_of for case in suite.cases):
            module(name)  # told before anything is run
        result = verify_suite(suite, options, diagnostics)
    except Refused:
        count = diagnostics.errors
        _complain(f"{diagnostics.text()}{count} error{'' if count == 1 else 's'}; nothing was run\n")
        return EXIT_INPUT
    except Interrupted:
        _complain("\ninterrupted; the runs that ended are kept: call again to go on\n")
        return EXIT_MISSED
    return _show_and_write(words, result, folder)


def main(arguments: Sequence[str]) -> int:
    """The words behind `courant verify`; returns the exit code."""
    words = _parser().parse_args(arguments)
    stop: list[int] = []
    try:
        for file in words.load:
            load_file(file)
    except LoadFault as fault:
        _complain(f"error: --load: {fault}\n")
        return EXIT_INPUT
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda signal_number, frame: stop.append(signal_number))
    try:
        return _verify(words, stop)
    except (OutputError, MissingModule, OSError) as fault:
        _complain(f"error: {fault}\n")
        return EXIT_OTHER
