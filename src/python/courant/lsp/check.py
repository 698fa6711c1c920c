"""`courant check --json` of texts that are not saved, as messages by file."""
from __future__ import annotations

import asyncio
import json
import os
import tempfile
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..files import write_file

_LONGEST = 120.0  # of a check [s]


@dataclass(frozen=True)
class Message:
    """`severity`: error, warning or note; line and column from 1, 0: not known."""

    severity: str
    file: str
    line: int
    column: int
    text: str


async def check(program: str, deck: str, texts: dict[str, str]) -> list[Message]:
    """Messages of a deck. `texts`: unsaved contents by path, which are read instead of the files. Raises OSError where the program does not start,
    TimeoutError and ValueError where it gives no report."""
    with tempfile.TemporaryDirectory(prefix="courant_lsp_") as folder:
        words = [program, "check", deck, "--json"]
        for k, (path, text) in enumerate(texts.items()):
            file = Path(folder) / f"{k}.k"
            write_file(file, text)
            words += ["--text", f"{path}={file}"]
        process = await asyncio.create_subprocess_exec(
            *words, stdin=asyncio.subprocess.DEVNULL, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.DEVNULL, cwd=str(Path(deck).parent)
        )
        try:
            said, _ = await asyncio.wait_for(process.communicate(), _LONGEST)
        except (asyncio.TimeoutError, asyncio.CancelledError):
            with suppress(ProcessLookupError):
                process.kill()
            await process.wait()
            raise
    return messages_of(said.decode("utf-8", "replace"), deck)


def messages_of(report: str, deck: str) -> list[Message]:
    """Raises ValueError where it is no report."""
    found = json.loads(report)
    listed = found.get("messages") if isinstance(found, dict) else None
    if not isinstance(listed, list):
        raise ValueError("the report has no messages")
    return [_message(one, deck) for one in listed if isinstance(one, dict)]


def _message(one: dict[str, Any], deck: str) -> Message:
    hint = f"\nhint: {one['hint']}" if one.get("hint") else ""
    file = os.path.normpath(os.path.join(os.path.dirname(deck), str(one.get("file") or deck)))
    numbers = [one.get(key) if isinstance(one.get(key), int) else 0 for key in ("line", "column")]
    return Message(str(one.get("severity")), file, numbers[0] or 0, numbers[1] or 0, f"{one.get('message')}{hint}")
