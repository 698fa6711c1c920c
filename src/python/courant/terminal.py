"""What is said on the terminal: results, and a status line that is written over."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from typing import NoReturn

EXIT_OK, EXIT_INPUT, EXIT_MISSED, EXIT_OTHER = 0, 1, 2, 3  # 2: results that could not be written, or bounds that are missed


class Parser(argparse.ArgumentParser):
    """Ends with the code of faults of the input where a call is wrong."""

    def error(self, message: str) -> NoReturn:
        self.print_usage(sys.stderr)
        self.exit(EXIT_INPUT, f"error: {message}\n")


def exit_code_of(call: Callable[[], None]) -> int:
    """Of a call that reports its faults: 0; 1 where its input has faults, 2 where a file could not be written, 3 where a module is missing."""
    from .diagnostics import CourantError
    from .files import OutputError
    from .optional import MissingModule

    try:
        call()
    except CourantError as fault:
        sys.stderr.write(f"{fault}\n")
        return EXIT_INPUT
    except OutputError as fault:
        sys.stderr.write(f"error: {fault}\n")
        return EXIT_MISSED
    except MissingModule as fault:
        sys.stderr.write(f"error: {fault}\n")
        return EXIT_OTHER
    return EXIT_OK


def count(text: str) -> int:
    """A number from 0 on, of an option."""
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} is less than 0")
    return value


def clear_status_line() -> None:
    if sys.stdout.isatty():
        sys.stdout.write("\r\033[K")


def say(text: str) -> None:
    """A text for the user, behind the status line if there is one."""
    clear_status_line()
    sys.stdout.write(text)
    sys.stdout.flush()


def status_line() -> Callable[[str], None] | None:
    """Writes over the last line of a terminal; None where the output is none."""
    if not sys.stdout.isatty():
        return None

    def show(line: str) -> None:
        sys.stdout.write("\r\033[K" + line)
        sys.stdout.flush()

    return show


def processors(wanted: int) -> int:
    """How many processes work at once: as many as wanted, or, for 0, one for each core that this process may use."""
    return wanted or len(os.sched_getaffinity(0))
