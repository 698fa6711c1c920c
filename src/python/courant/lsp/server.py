"""The protocol: an editor's documents and requests, by pygls, which is imported here alone."""
from __future__ import annotations

import asyncio
import logging
import os
from collections.abc import Callable
from typing import Any, TypeVar

from ..optional import MissingModule, module
from ..program import executable
from .check import Message, check
from .deck_text import DeckText, Workspace
from .features import Offer, Symbol, completions, definitions, hover, included_file, outline

_DELAY = 0.4  # from the last change of a text to its check [s]
_LOG = logging.getLogger("courant.lsp")
_Answer = TypeVar("_Answer")


class DeckServer:
    """Registers its handlers with a server of pygls 1 or 2. A fault in a handler is logged, and its answer is empty:
    half-typed decks never end it."""

    def __init__(self) -> None:
        try:
            made = module("pygls.lsp.server").LanguageServer
        except MissingModule:  # pygls 1
            made = module("pygls.server").LanguageServer
        self.types, self.uris = module("lsprotocol.types"), module("pygls.uris")
        self.server = made("courant", "1")
        self.workspace = Workspace()
        self._checks: dict[str, asyncio.Task[None]] = {}
        self._published: dict[str, set[str]] = {}  # files with messages, by checked deck
        self._register()

    def _register(self) -> None:
        t = self.types
        on = self.server.feature
        on(t.TEXT_DOCUMENT_DID_OPEN)(self._kept(self._changed, None))
        on(t.TEXT_DOCUMENT_DID_CHANGE)(self._kept(self._changed, None))
        on(t.TEXT_DOCUMENT_DID_SAVE)(self._kept(self._changed, None))
        on(t.TEXT_DOCUMENT_DID_CLOSE)(self._kept(self._closed, None))
        on(t.TEXT_DOCUMENT_HOVER)(self._kept(self._hover, None))
        on(t.TEXT_DOCUMENT_DEFINITION)(self._kept(self._definition, list))
        on(t.TEXT_DOCUMENT_DOCUMENT_SYMBOL)(self._kept(self._symbols, list))
        on(t.TEXT_DOCUMENT_COMPLETION, t.CompletionOptions(trigger_characters=["*", "_"]))(self._kept(self._completion, list))

    @staticmethod
    def _kept(handler: Callable[[Any], _Answer], otherwise: Callable[[], _Answer] | None) -> Callable[[Any], _Answer | None]:
        def handle(params: Any) -> _Answer | None:
            try:
                return handler(params)
            except Exception:  # noqa: BLE001  the server goes on whatever the text is
                _LOG.exception("%s failed", handler.__name__)
                return otherwise() if otherwise else None

        return handle

    # documents

    def _path(self, uri: str) -> str:
        return os.path.normpath(self.uris.to_fs_path(uri) or uri)

    def _deck(self, uri: str) -> DeckText:
        path = self._path(uri)
        known = self.workspace.open.get(path)
        return known if known is not None else self._take(uri)

    def _take(self, uri: str) -> DeckText:
        text = DeckText(self.server.workspace.get_text_document(uri).source, self._path(uri))
        self.workspace.open[text.file] = text
        return text

    def _changed(self, params: Any) -> None:
        text = self._take(params.text_document.uri)
        deck = self.workspace.deck_of(text)
        if deck is None:
            return
        if (before := self._checks.get(deck.file)) is not None:
            before.cancel()
        self._checks[deck.file] = asyncio.get_running_loop().create_task(self._check(deck.file))

    def _closed(self, params: Any) -> None:
        path = self._path(params.text_document.uri)
        self.workspace.open.pop(path, None)
        if (task := self._checks.pop(path, None)) is not None:
            task.cancel()
        for file in self._published.pop(path, set()) | {path}:
            self._publish(file, [])

    # messages

    async def _check(self, deck: str) -> None:
        try:
            await asyncio.sleep(_DELAY)
            program = executable()
            if not program:
                return
            uri_of = {path: text for path, text in self.workspace.open.items()}
            texts = {path: self.server.workspace.get_text_document(self.uris.from_fs_path(path)).source for path in uri_of}
            found = await check(program, deck, texts)
            by_file: dict[str, list[Message]] = {deck: []}
            for one in found:
                by_file.setdefault(one.file, []).append(one)
            for file in self._published.get(deck, set()) - set(by_file):
                self._publish(file, [])
            self._published[deck] = set(by_file)
            for file, messages in by_file.items():
                self._publish(file, messages)
        except asyncio.CancelledError:
            raise
        except Exception as fault:  # noqa: BLE001  the next change checks again
            _LOG.warning("no check of %s: %s", deck, fault)

    def _publish(self, file: str, messages: list[Message]) -> None:
        t = self.types
        text = self.workspace.text(file)
        severities = {"error": t.DiagnosticSeverity.Error, "warning": t.DiagnosticSeverity.Warning}
        made = [
            t.Diagnostic(
                range=self._range_of(text, one), message=one.text, source="courant", severity=severities.get(one.severity, t.DiagnosticSeverity.Information)
            )
            for one in messages
        ]
        uri = self.uris.from_fs_path(file)
        if hasattr(self.server, "text_document_publish_diagnostics"):
            self.server.text_document_publish_diagnostics(t.PublishDiagnosticsParams(uri=uri, diagnostics=made))
        else:
            self.server.publish_diagnostics(uri, made)

    def _range_of(self, text: DeckText | None, one: Message) -> Any:
        """The field that a message is about, else the rest of its line."""
        line, column = max(one.line - 1, 0), max(one.column - 1, 0)
        written = text.lines[line] if text is not None and line < len(text.lines) else ""
        column = min(len(written.encode("utf-8", "surrogateescape")[:column].decode("utf-8", "ignore")), len(written))
        found = text.field_at(line, column) if text is not None and one.column else None
        begin, end = column, len(written)
        if found is not None and written[found.begin : found.end].strip():
            end = min(found.end, len(written))
        return self._range(text, line, begin, line, max(end, begin))

    # positions

    def _units(self, text: str) -> int:
        """Length of a text as the editor counts it."""
        encoding = str(getattr(self.server.workspace, "position_encoding", "") or "utf-16").rpartition(".")[2].lower()
        if "32" in encoding:
            return len(text)
        return len(text.encode("utf-8", "surrogatepass")) if "8" in encoding else len(text.encode("utf-16-le", "surrogatepass")) // 2

    def _column(self, deck: DeckText, position: Any) -> int:
        """Column in characters of a position in the editor's units."""
        text = deck.lines[position.line] if 0 <= position.line < len(deck.lines) else ""
        if text.isascii():
            return int(min(position.character, len(text)))
        return next((k for k in range(len(text)) if self._units(text[: k + 1]) > position.character), len(text))

    def _range(self, deck: DeckText | None, line: int, begin: int, last: int, end: int) -> Any:
        t = self.types

        def position(at: int, column: int) -> Any:
            text = deck.lines[at] if deck is not None and at < len(deck.lines) else ""
            return t.Position(line=at, character=column if text.isascii() else self._units(text[:column]))

        return t.Range(start=position(line, begin), end=position(last, end))

    # requests

    def _hover(self, params: Any) -> Any:
        deck, line = self._deck(params.text_document.uri), params.position.line
        said = hover(self.workspace, deck, line, self._column(deck, params.position))
        t = self.types
        return t.Hover(contents=t.MarkupContent(kind=t.MarkupKind.Markdown, value=said)) if said else None

    def _definition(self, params: Any) -> list[Any]:
        t = self.types
        deck, line = self._deck(params.text_document.uri), params.position.line
        found = definitions(self.workspace, deck, line, self._column(deck, params.position))
        out = []
        for one in found:
            where = self._range(self.workspace.text(one.file), one.line, 0, one.line, 10)
            out.append(t.Location(uri=self.uris.from_fs_path(one.file), range=where))
        if file := included_file(deck, line):
            out.append(t.Location(uri=self.uris.from_fs_path(file), range=self._range(None, 0, 0, 0, 0)))
        return out

    def _symbols(self, params: Any) -> list[Any]:
        deck = self._deck(params.text_document.uri)
        return [self._symbol(deck, one) for one in outline(deck)]

    def _symbol(self, deck: DeckText, one: Symbol) -> Any:
        t = self.types
        width = len(deck.lines[one.begin]) if one.begin < len(deck.lines) else 0
        whole = self._range(deck, one.begin, 0, one.end, len(deck.lines[one.end]) if one.end < len(deck.lines) else 0)
        kind = t.SymbolKind.Class if one.name.startswith("*") else t.SymbolKind.Object
        inner = [self._symbol(deck, child) for child in one.children]
        return t.DocumentSymbol(
            name=one.name, detail=one.detail, kind=kind, range=whole, selection_range=self._range(deck, one.begin, 0, one.begin, width), children=inner
        )

    def _completion(self, params: Any) -> list[Any]:
        deck, line = self._deck(params.text_document.uri), params.position.line
        offers = completions(self.workspace, deck, line, self._column(deck, params.position))
        return [self._item(deck, line, k, one) for k, one in enumerate(offers)]

    def _item(self, deck: DeckText, line: int, k: int, one: Offer) -> Any:
        t = self.types
        kinds = {"keyword": t.CompletionItemKind.Keyword, "field": t.CompletionItemKind.Field, "snippet": t.CompletionItemKind.Snippet}
        return t.CompletionItem(
            label=one.label,
            kind=kinds.get(one.kind, t.CompletionItemKind.Value),
            detail=one.detail,
            documentation=t.MarkupContent(kind=t.MarkupKind.Markdown, value=one.documentation),
            sort_text=f"{k:04d}",
            filter_text=deck.lines[line][one.begin : one.end] + one.text if line < len(deck.lines) else one.text,
            text_edit=t.TextEdit(range=self._range(deck, line, one.begin, line, one.end), new_text=one.text),
        )

    def serve(self) -> None:
        """On standard input and output, until the editor ends it."""
        self.server.start_io()
