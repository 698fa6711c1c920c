"""What the language server says about a position in a deck: hover, completion, definitions, outline. Nothing here knows the protocol."""
from __future__ import annotations

import re
from dataclasses import dataclass, field

from ..deck.blocks import Block
from ..deck.tables import CardOf, FieldOf, TableOf, tables, without_options
from ..words import did_you_mean
from .deck_text import DeckText, Definition, FieldAt, Workspace, cards_of_row

_NUMBER = re.compile(r"[+-]?\d{1,16}")
_MOST_OFFERED = 200
_MOST_CHILDREN = 200
_STATE = {"honoured": "honoured", "partly": "partly honoured", "no effect": "no effect", "refused": "refused"}


@dataclass
class Offer:
    """A completion: `text` replaces columns `begin` to `end` of the line. `kind`: keyword, field, value or snippet."""

    label: str
    text: str
    begin: int
    end: int
    kind: str
    detail: str = ""
    documentation: str = ""


@dataclass
class Symbol:
    """An entry of the outline, with the entries in it. Lines from 0, `end` included."""

    name: str
    detail: str
    begin: int
    end: int
    children: list[Symbol] = field(default_factory=list)


def hover(workspace: Workspace, deck: DeckText, line: int, column: int) -> str:
    """Markdown, "" where there is nothing to say."""
    block = deck.block_at(line)
    if block is None:
        return ""
    if deck.is_keyword_line(line):
        return _keyword_text(block)
    found = deck.field_at(line, column)
    if found is None:
        return ""
    out = [_field_text(block, found.field, found.card)]
    for number, card in deck.cards_at(line)[1:]:
        names = ", ".join(one.name for one in card.fields)
        out.append(f"Or card {number + 1}, where other fields request it: {names}")
    if (id := _id_of(found.text)) and (space := _space_of(block, found)):
        for one in workspace.find(deck, space, id)[:3]:
            out.append(f"{one.space} {one.id}: `*{one.keyword}` {one.title}".rstrip())
    return "\n\n".join(out)


def _keyword_text(block: Block) -> str:
    if block.table is None:
        near = did_you_mean(block.name, tables())
        return f"`*{block.name}` has no table: `courant keywords {block.name}` says why it is refused. {near}".strip() if tables() else ""
    table = block.table
    lines = [f"**\\*{block.name}**: {table.purpose}", f"State: {table.support or _STATE.get(table.state, table.state)}"]
    for number, card in enumerate(table.cards, 1):
        words = (("optional", card.optional), ("where other fields request it", card.conditional), ("repeated", card.repeated))
        how = ", ".join(word for word, on in words if on)
        lines.append(f"Card {number}{f' ({how})' if how else ''}: {', '.join(one.name for one in card.fields)}")
    return "\n\n".join(lines)


def _field_text(block: Block, of: FieldOf, card: int) -> str:
    dimension = "no dimension" if of.dimension in ("", "-") else f"dimension {of.dimension}"
    accepted = f"accepted: {of.accepted}" if of.accepted not in ("", "any") else ""
    refers = f"refers to: {of.refers}" if of.refers not in ("", "varies") else ""
    default = f"default: {of.default}" if of.default not in ("", "-") else ""
    facts = "; ".join(one for one in (dimension, default, accepted, refers) if one)
    return f"**{of.name}** ({of.meaning})\n\n`*{block.name}` card {card + 1}, columns {of.begin + 1}-{of.end}; {facts}"


# definitions


def definitions(workspace: Workspace, deck: DeckText, line: int, column: int) -> list[Definition]:
    """Where the id at a position is defined."""
    found, block = deck.field_at(line, column), deck.block_at(line)
    if found is None or block is None:
        return []
    id, space = _id_of(found.text), _space_of(block, found)
    return workspace.find(deck, space, abs(id)) if id and space else []


def included_file(deck: DeckText, line: int) -> str:
    """Of a line that names a file to include: its path, "" where there is none."""
    block = deck.block_at(line)
    if block is None or not block.name.startswith("INCLUDE") or not 0 <= line < len(deck.lines):
        return ""
    name = deck.lines[line].strip()
    return next((path for path in deck.includes() if name and path.endswith(name.rpartition("/")[2])), "")


def _id_of(text: str) -> int | None:
    return int(text) if _NUMBER.fullmatch(text) else None


def _space_of(block: Block, found: FieldAt) -> str:
    """What the ids in a field number; "" for none."""
    if found.field.refers:
        return found.field.refers
    table = block.table
    own = table is not None and found.card == 0 and table.cards[0].fields and table.cards[0].fields[0] is found.field
    return table.defines if own and table is not None else ""


# completion


def completions(workspace: Workspace, deck: DeckText, line: int, column: int) -> list[Offer]:
    text = deck.lines[line] if 0 <= line < len(deck.lines) else ""
    if text.startswith("*"):
        return _keywords(text, column)
    block = deck.block_at(line)
    if block is None or text.startswith("$"):
        return [] if text.startswith("$") else _keywords(text, column) if not text.strip() else []
    out: list[Offer] = []
    cards = deck.cards_at(line) if line < len(deck.lines) else cards_of_row(block, len(block.rows) + 1)
    if not text.strip():
        out += [_header(number, card, text) for number, card in cards if card.fields]
    behind = 0 < column <= len(text) and not text[column - 1].isspace() and text[column - 1] != ","  # the word in front of the cursor is typed
    found = deck.field_at(line, column - behind) or (deck.field_at(line, column - 1) if column else None)
    if found is None and cards and not text[:column].strip():
        found = _first_field(cards[0], column)
    if found is not None:
        out += _values(workspace, deck, block, found, text, column)
    return out[:_MOST_OFFERED]


def _first_field(card: tuple[int, CardOf], column: int) -> FieldAt | None:
    of = next((one for one in card[1].fields if one.begin <= column < one.end), None)
    return FieldAt(card[0], card[1], of, of.begin, of.end, "") if of else None


def _keywords(text: str, column: int) -> list[Offer]:
    typed = text[1:column].upper().strip()
    end = len(text.split("$")[0].rstrip())
    names = [name for name in tables() if name.startswith(typed)]
    names += [name for name in tables() if typed and typed in name and not name.startswith(typed)]
    if not names and typed:
        base = without_options(typed)[0]
        names = [base] if base in tables() else []
    out = []
    for name in names[:_MOST_OFFERED]:
        table = tables()[name]
        out.append(Offer(f"*{name}", f"*{name}", 0, max(end, column), "keyword", _STATE.get(table.state, table.state), _purpose(name, table)))
    return out


def _purpose(name: str, table: TableOf) -> str:
    cards = "\n".join(f"- {', '.join(one.name for one in card.fields)}" for card in table.cards[:4])
    return f"{table.purpose}\n\n{table.support}\n\n{cards}"


def _header(number: int, card: CardOf, text: str) -> Offer:
    """A comment with the names of the fields above their columns."""
    line = "$#"
    for one in card.fields:
        line = line.ljust(one.begin) + one.name.lower().rjust(min(one.end - one.begin, 10) - (2 if one.begin == 0 else 0))
    fields = "\n".join(f"- {one.name}: {one.meaning} [{one.dimension}]" for one in card.fields)
    label = f"$# card {number + 1}: {', '.join(one.name for one in card.fields)}"
    return Offer(label, line + "\n", 0, len(text), "snippet", "names of the fields", fields)


def _values(workspace: Workspace, deck: DeckText, block: Block, found: FieldAt, text: str, column: int) -> list[Offer]:
    """What a field may hold: its few values, ids that are defined, its default."""
    of = found.field
    begin = min(found.begin, len(text))
    end = max(min(found.end, len(text)), begin)
    width = 0 if "," in text else found.end - found.begin
    typed = text[begin : max(begin, min(column, end))].strip()

    def offer(value: str, detail: str) -> Offer:
        new = value if not width else " " * max(0, found.begin - len(text)) + value.rjust(width)
        label = f"{of.name} = {value}" if not detail else f"{value}: {detail}"
        return Offer(label, new, begin, end, "value", of.name, _field_text(block, of, found.card))

    out = [offer(str(value), "") for value in of.allowed]
    if space := _space_of(block, found):
        seen: set[tuple[str, int]] = set()
        for one in (one for name in workspace.scope(deck) for one in name.definitions):
            fits = one.space == space or (space == "varies" and "set" in one.space)
            if fits and (one.space, one.id) not in seen and str(one.id).startswith(typed) and len(seen) < _MOST_OFFERED:
                seen.add((one.space, one.id))
                out.append(offer(str(one.id), f"{one.space} {one.title}".strip()))
    if not out and of.default not in ("", "-", "required", "blank"):
        out.append(offer(of.default, "default"))
    if not out:
        out.append(Offer(f"{of.name}: {of.meaning}", typed, begin, end, "field", of.dimension, _field_text(block, of, found.card)))
    return out


# outline


def outline(deck: DeckText) -> list[Symbol]:
    """Keywords, and in each what it defines."""
    out = []
    by_block: dict[int, list[Definition]] = {}
    for one in deck.definitions:
        block = deck.block_at(one.line)
        if block is not None:
            by_block.setdefault(block.line, []).append(one)
    for k, block in enumerate(deck.blocks):
        begin = block.line - 1
        end = deck.blocks[k + 1].line - 2 if k + 1 < len(deck.blocks) else max(begin, len(deck.lines) - 1)
        ids = by_block.get(block.line, [])
        detail = f"{len(ids)} of {ids[0].space}" if len(ids) > 1 else f"{ids[0].id} {ids[0].title}".strip() if ids else ""
        children = []
        if 1 < len(ids) <= _MOST_CHILDREN:
            ends = [*(one.line - 1 for one in ids[1:]), end]
            pairs = zip(ids, ends, strict=True)
            children = [Symbol(f"{one.space} {one.id}", one.title, min(one.line, end), max(one.line, last)) for one, last in pairs]
        out.append(Symbol(f"*{block.name}", detail, begin, max(end, begin), children))
    return out
