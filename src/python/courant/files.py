"""Checked writing of files, and the one location that opens what is written (tests/architecture/one_writer.py looks for others). A file carries its
final name only once all of it is on the disk."""
from __future__ import annotations

import errno
import fcntl
import io
import os
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

CANNOT_WRITE = "cannot write '"  # how messages about results that could not be written begin, also those of runs
_ADVICE = {(errno.ENOSPC, errno.EDQUOT): "free some space, or choose a folder on another disk with -o, and run again",
    (errno.EFBIG,): "raise the limit on file sizes (ulimit -f) and run again",
    (errno.EACCES, errno.EROFS, errno.EPERM): "make the folder writable, or choose another with -o"}


class OutputError(Exception):
    """A result could not be written: disk full, no permission, ... The text names the file and says what to do."""

    def __init__(self, file: Path, fault: OSError) -> None:
        advice = next((text for numbers, text in _ADVICE.items() if fault.errno in numbers),
                      "check the folder and the disk, or choose another folder with -o")
        if fault.errno is None:
            advice = "rename or remove it, or choose another name or folder; nothing was changed"
        super().__init__(f"{CANNOT_WRITE}{file}': {fault.strerror or fault}\n  hint: {advice}")
        self.file = file


def make_folder(folder: Path) -> None:
    """Makes the folder and its parents. Raises OutputError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise OutputError(folder, fault) from fault


_inputs: dict[tuple[int, int], str] = {}  # device and number of what was read, and its name


def note_input(file: Path) -> None:
    """Nothing is written over this file from now on."""
    try:
        known = file.stat()
    except OSError:
        return
    _inputs[known.st_dev, known.st_ino] = os.path.abspath(file)


def _input_at(known: os.stat_result) -> str:
    """The input that this file is, "" where it is none: the number of one that was removed since may be that of a new file."""
    name = _inputs.get((known.st_dev, known.st_ino), "")
    try:
        return name if name and os.path.samestat(os.stat(name), known) else ""
    except OSError:
        return ""


def _fault(text: str) -> OSError:
    return OSError(None, text)


def _check(file: Path) -> None:
    """Raises OSError where a result cannot replace what is there: a link, what is no file, an input."""
    try:
        known = file.lstat()
    except FileNotFoundError:
        return
    if stat.S_ISLNK(known.st_mode):
        raise _fault("it is a link, and results are not written through links")
    if not stat.S_ISREG(known.st_mode):
        raise _fault("it is no file")
    if name := _input_at(known):
        raise _fault(f"it is the input '{name}'")


def open_for_writing(file: Path, *, new: bool = False, keep: bool = False) -> int:
    """A descriptor. `new`: none of that name may be there; `keep`: its content stays. Waits for no other end of a pipe. Raises OutputError."""
    try:
        if not new:
            _check(file)
        own = os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY
        descriptor = os.open(file, own | (os.O_RDWR if keep else os.O_WRONLY) | (os.O_EXCL if new else 0), 0o666)
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            os.close(descriptor)
            raise _fault("it is no file")
        if not keep:
            os.truncate(descriptor, 0)
    except OSError as fault:
        raise OutputError(file, fault) from fault
    return descriptor


def _is_device(file: Path) -> bool:
    try:
        mode = file.stat().st_mode
    except OSError:
        return False
    return stat.S_ISCHR(mode) or stat.S_ISFIFO(mode)


def _write_through(file: Path, data: Iterable[bytes]) -> None:
    """To a device or pipe that is there."""
    try:
        descriptor = os.open(file, os.O_WRONLY | os.O_CLOEXEC | os.O_NONBLOCK | os.O_NOCTTY)
    except OSError as fault:
        if fault.errno != errno.ENXIO:
            raise
        raise _fault("it is a pipe without a reader") from fault
    fcntl.fcntl(descriptor, fcntl.F_SETFL, fcntl.fcntl(descriptor, fcntl.F_GETFL) & ~os.O_NONBLOCK)
    with open(descriptor, "wb") as stream:
        stream.writelines(data)


def write_file(file: Path, content: str | bytes | list[bytes], *, named: bool = False) -> None:
    """Readers see the old file or the whole new one. A link, what is no file and what was read as an input are not replaced. `named`: the user has
    named the file, so that nothing beside it is ours, and a device or pipe may be meant. Raises OutputError; `file` is then as it was."""
    pieces = content if isinstance(content, list) else [content.encode("utf-8", "surrogateescape") if isinstance(content, str) else content]
    temporary = file.with_name(f"{file.name}.{os.getpid()}.tmp" if named else f"{file.name}.tmp")
    written = False
    try:
        if named and _is_device(file):
            return _write_through(file, pieces)
        _check(file)
        if not named:
            temporary.unlink(missing_ok=True)  # nothing goes through a link
        with open(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666), "wb") as stream:
            written = True
            stream.writelines(pieces)
        temporary.replace(file)
    except OSError as fault:
        try:
            if written:
                temporary.unlink(missing_ok=True)
        except OSError:
            pass  # the fault before is the one to tell
        raise OutputError(file, fault) from fault


def write_figure(figure: Any, file: Path, *, named: bool = False, **keys: Any) -> None:
    """A figure of matplotlib, in the format that the name ends with. Raises OutputError."""
    import matplotlib as mpl

    file = file if file.suffix else file.with_name(f"{file.name}.{mpl.rcParams['savefig.format']}")
    content = io.BytesIO()
    figure.savefig(content, format=file.suffix[1:].lower(), **keys)
    write_file(file, content.getvalue(), named=named)


def write_by(write: Callable[[Path], None], file: Path) -> None:
    """What a library writes to a name of its own, here in a folder for the time being, becomes the file. Raises OutputError."""
    with tempfile.TemporaryDirectory(prefix="courant_") as folder:
        made = Path(folder) / file.name
        write(made)
        write_file(file, made.read_bytes())


def move(source: Path, target: Path) -> None:
    """Raises OutputError."""
    try:
        shutil.move(source, target)
    except OSError as fault:
        raise OutputError(target, fault) from fault
