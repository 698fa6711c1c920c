"""Parts of a scene that an entry names, by title or number."""
from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePath
from typing import TYPE_CHECKING

from ..yaml_map import Node, is_list, is_scalar

if TYPE_CHECKING:
    from .node_reader import NodeReader


def named_part(reader: NodeReader, node: Node, key: str, titles: Mapping[int, str]) -> int | None:
    """The number of the part with that title or number, of those in `titles`; 0 where there is none; None, with a message, where several have the title."""
    text = reader.text(node)
    found = [number for number, title in titles.items() if title == text]
    if len(found) > 1:
        reader.error(node, f"{key}: '{text}' is the title of {len(found)} parts, {', '.join(str(number) for number in found)}",
                     "give each a title of its own, or write the number of the part")
        return None
    return found[0] if found else int(text) if text.isdigit() and int(text) in titles else 0


def described(reader: NodeReader, root: Node) -> list[str] | None:
    """Titles of the parts that the description of a scene names, of entries with mistakes, too; None where they cannot be known."""
    out = ["water"] + (["walls"] if reader.get(root, "box") is not None else [])
    for key in ("walls", "bodies", "structures", "parts"):
        node = reader.get(root, key)
        if node is not None and not is_list(node):
            return None
        for entry in node.value if node is not None else ():
            if (title := reader.get(entry, "title")) is not None and is_scalar(title) and "$" not in title.value:
                out.append(title.value)
                continue
            kind = next((kind for kind in ("box", "cylinder", "sphere", "circle", "line", "plate") if reader.get(entry, kind) is not None), "")
            file = reader.get(entry, "file")
            if title is not None or key in ("structures", "parts") or not (kind or (file is not None and is_scalar(file))):
                return None
            out.append(kind or PurePath(file.value).stem)  # type: ignore[union-attr]
    return out
