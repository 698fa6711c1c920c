"""Checked writing of files: a file carries its final name only once all of it is on the disk."""
from __future__ import annotations

import errno
import os
from pathlib import Path

CANNOT_WRITE = "cannot write '"  # how messages about results that could not be written begin, also those of runs
_ADVICE = {(errno.ENOSPC, errno.EDQUOT): "free some space, or choose a folder on another disk with -o, and run again",
    (errno.EFBIG,): "raise the limit on file sizes (ulimit -f) and run again",
    (errno.EACCES, errno.EROFS, errno.EPERM): "make the folder writable, or choose another with -o"}


class OutputError(Exception):
    """A result could not be written: disk full, no permission, ... The text names the file and says what to do."""

    def __init__(self, file: Path, fault: OSError) -> None:
        advice = next((text for numbers, text in _ADVICE.items() if fault.errno in numbers),
                      "check the folder and the disk, or choose another folder with -o")
        super().__init__(f"{CANNOT_WRITE}{file}': {fault.strerror or fault}\n  hint: {advice}")
        self.file = file


def make_folder(folder: Path) -> None:
    """Makes the folder and its parents. Raises OutputError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise OutputError(folder, fault) from fault


def write_file(file: Path, content: str | bytes) -> None:
    """Readers see the old file or the whole new one. Raises OutputError; `file` is then as it was."""
    temporary = file.with_name(file.name + ".tmp")
    data = content.encode("utf-8", "surrogateescape") if isinstance(content, str) else content
    try:
        temporary.unlink(missing_ok=True)  # nothing goes through a link
        with open(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666), "wb") as stream:
            stream.write(data)
        temporary.replace(file)
    except OSError as fault:
        try:
            temporary.unlink(missing_ok=True)
        except OSError:
            pass  # the fault before is the one to tell
        raise OutputError(file, fault) from fault
