"""A client of the language server: JSON-RPC over a pipe, in plain Python."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

SOURCES = Path(__file__).resolve().parents[2] / "src" / "python"


class Client:
    """Starts `courant lsp` of the sources. `notes`: what the server sent without being asked."""

    def __init__(self, folder: Path) -> None:
        env = os.environ | {"PYTHONPATH": os.pathsep.join([str(SOURCES), os.environ.get("PYTHONPATH", "")])}
        self.process = subprocess.Popen([sys.executable, "-m", "courant", "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=env)
        self.notes: queue.Queue[dict[str, Any]] = queue.Queue()
        self._answers: queue.Queue[dict[str, Any]] = queue.Queue()
        self.errors: list[str] = []
        self._number = 0
        threading.Thread(target=self._read, daemon=True).start()
        threading.Thread(target=self._listen, daemon=True).start()
        self.capabilities = self.ask("initialize", {"processId": os.getpid(), "rootUri": folder.as_uri(), "capabilities": {}})["capabilities"]
        self.notify("initialized", {})

    def _listen(self) -> None:
        assert self.process.stderr
        for line in self.process.stderr:
            self.errors.append(line.decode(errors="replace"))

    def _read(self) -> None:
        stream = self.process.stdout
        assert stream
        while True:
            length = 0
            while (line := stream.readline().strip()) != b"":
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            if not length:
                return
            message = json.loads(stream.read(length))
            (self._answers if "id" in message and "method" not in message else self.notes).put(message)

    def _send(self, message: dict[str, Any]) -> None:
        data = json.dumps({"jsonrpc": "2.0"} | message).encode()
        assert self.process.stdin
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)
        self.process.stdin.flush()

    def notify(self, method: str, params: Any) -> None:
        self._send({"method": method, "params": params})

    def ask(self, method: str, params: Any) -> Any:
        self._number += 1
        self._send({"id": self._number, "method": method, "params": params})
        answer = self._answers.get(timeout=60)
        assert answer["id"] == self._number and "error" not in answer, answer
        return answer["result"]

    def open(self, path: Path, text: str) -> None:
        self.notify("textDocument/didOpen", {"textDocument": {"uri": path.as_uri(), "languageId": "lsdyna", "version": 1, "text": text}})

    def change(self, path: Path, text: str, version: int) -> None:
        self.notify("textDocument/didChange", {"textDocument": {"uri": path.as_uri(), "version": version}, "contentChanges": [{"text": text}]})

    def at(self, what: str, path: Path, line: int, column: int) -> Any:
        return self.ask(f"textDocument/{what}", {"textDocument": {"uri": path.as_uri()}, "position": {"line": line, "character": column}})

    def symbols(self, path: Path) -> Any:
        return self.ask("textDocument/documentSymbol", {"textDocument": {"uri": path.as_uri()}})

    def diagnostics(self, path: Path) -> list[dict[str, Any]]:
        """The next messages of a file."""
        while True:
            note = self.notes.get(timeout=90)
            if note.get("method") == "textDocument/publishDiagnostics" and note["params"]["uri"] == path.as_uri():
                return note["params"]["diagnostics"]  # type: ignore[no-any-return]

    def close(self) -> int:
        self.ask("shutdown", None)
        self.notify("exit", None)
        return self.process.wait(timeout=30)
