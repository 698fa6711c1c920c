"""The call `courant schema KIND`: a JSON schema of scenes, recipes or suites, of the tables by which the readers check keys.

A schema finds wrong and missing keys and values of another kind; what the readers check besides, the calls say.
"""

from __future__ import annotations

import importlib
import inspect
import json
import sys
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from .files import OutputError, write_file
from .key_tables import TABLES
from .terminal import EXIT_MISSED, EXIT_OK, EXIT_INPUT, Parser, say
from .words import did_you_mean

Schema = dict[str, Any]
_TEXT: Schema = {"type": ["string", "number", "boolean", "null"]}
_NUMBER: Schema = {"type": ["number", "string", "null"]}  # expressions are texts
_KINDS: dict[str, Schema] = {
    "text": _TEXT,
    "number": _NUMBER,
    "positive": _NUMBER,
    "flag": {"type": ["boolean", "string", "number", "null"]},
    "list": {"type": ["array", "null"]},
    "numbers": {"type": ["array", "null"]},
    "texts": {"type": ["array", "null"]},
    "range": {"type": ["array", "null"], "minItems": 2, "maxItems": 2},
    "vector": {"type": "array", "minItems": 2, "maxItems": 3, "items": _NUMBER},
    "map": {"type": ["object", "null"]},
    "positions": {"anyOf": [_NUMBER, {"type": "array"}, {"$ref": "#/$defs/steps"}]},
    "any": {},
}
_HOMES = {
    "scene": ("scene.reader", "scene.scene"),
    "recipe": ("post.recipe", "post.views", "post.analyses", "post.bed", "post.state"),
    "suite": ("verify.suite",),
}


def _kind(word: str) -> Schema:
    """Of one kind as the tables name it."""
    if word.startswith("[@"):
        return {"type": ["array", "null"], "items": {"$ref": _reference(word[2:-1])}}
    return {"$ref": _reference(word[1:])} if word.startswith("@") else _KINDS[word]


def _reference(name: str) -> str:
    return f"#/$defs/{name.replace(' ', '_')}"


def _map(*tables: dict[str, str], more: bool = False) -> Schema:
    """Of a map with the keys of these tables; `more`: and others."""
    properties: Schema = {}
    required = []
    for table in tables:
        for key, kinds in table.items():
            made = [_kind(word) for word in kinds.rstrip("!").split("|")]
            properties[key] = made[0] if len(made) == 1 else {"anyOf": made}
            required += [key] if kinds.endswith("!") else []
    out: Schema = {"type": "object", "properties": properties, "additionalProperties": more}
    return out | ({"required": required} if required else {})


def table_of_class(made: type) -> dict[str, str]:
    """The keys of a map that is read as a dataclass."""
    out = {}
    for one in fields(made):  # type: ignore[arg-type]
        if "how" in one.metadata:
            how, options = one.metadata["how"], one.metadata["options"]
            word = "text" if how == "choice" else how if how in _KINDS else "any"
            out[one.name] = word + ("!" if options.get("required") else "")
    return out


def _of_scene() -> tuple[Schema, Schema]:
    shape = {**TABLES["a kind of shape"], **TABLES["of every shape"]}
    defs = {name: _map(table) for name, table in TABLES.items() if ":" not in name}
    defs |= {f"a {name}": _map(shape, TABLES.get(f"a {name}, besides its shape", {})) for name in ("wall", "body", "body of water")}
    defs["a structure"] = _map(TABLES["a kind of structure"], TABLES["of every structure"])
    defs["a section"] = _map(TABLES["a kind of section"], TABLES["of every section"])
    defs["a rotation"] = _map(TABLES["how a wall is turned"], TABLES["of every rotation"])
    defs["a gas"] = _map(TABLES["a block"], TABLES["a gas, besides its lattice"])
    return {"anyOf": [_map(TABLES["the scene"]), _map(TABLES["a base"])]}, defs


def _of_recipe() -> tuple[Schema, Schema]:
    from .post import figures, jump, recipe, view_scene
    from .post.analyses import KINDS

    defs = {name: _map(table) for name, table in TABLES.items()}
    classes = {"probe of a recipe": recipe.ProbeRecipe, "snapshots": recipe.SnapshotRecipe, "published": jump.PublishedRow}
    classes |= {"curve": figures.Curve, "map of a figure": figures.Map}
    defs |= {name: _map(table_of_class(made)) for name, made in classes.items()}
    defs["jump"] = _map(table_of_class(jump.JumpRecipe), TABLES["more of a jump"])
    defs["view"] = _map(table_of_class(view_scene.View), TABLES["more of a view"])
    figure = (table_of_class(figures.Figure), TABLES["more of a figure"])
    defs["figure"] = {"if": {"required": ["chart"]}, "then": _map(*figure, {"chart": "text"}, more=True), "else": _map(*figure)}
    tables = {kind: table for kind in KINDS.names() if (table := _of_analysis(KINDS[kind])) is not None}
    known: Schema = {"type": "object", "required": ["kind"], "properties": {"kind": {"type": "string"}}}
    known["allOf"] = [{"if": {"properties": {"kind": {"const": kind}}}, "then": _map(table)} for kind, table in tables.items()]
    defs["analysis"] = known
    return _map(TABLES["recipe"]), defs


def _of_analysis(made: Any) -> dict[str, str] | None:
    """The table of a kind, or of the kind that it is derived from; None of a function of a user."""
    from .post.analyses import KINDS

    kinds = {KINDS[kind]: kind for kind in KINDS.names()}
    for one in inspect.getmro(made) if inspect.isclass(made) else ():
        table = TABLES.get(f"analysis {kinds[one]}") if one in kinds else None
        if table is not None:
            return table
    return None


def _of_suite() -> tuple[Schema, Schema]:
    defs = {name: _map(table) for name, table in TABLES.items()}
    defs["reference"] = _map(TABLES["reference"], TABLES["columns of a reference"])
    return _map(TABLES["suite"]), defs


def schema(kind: str) -> Schema:
    """The JSON schema (draft 2020-12) of "scene", "recipe" or "suite"."""
    for home in _HOMES[kind]:
        importlib.import_module(f".{home}", __package__)
    root, all_defs = {"scene": _of_scene, "recipe": _of_recipe, "suite": _of_suite}[kind]()
    defs: Schema = {}
    waiting = [root]
    while waiting:  # only what the root leads to
        for name in _names(waiting.pop()):
            if name not in defs:
                defs[name] = next(one for other, one in all_defs.items() if other.replace(" ", "_") == name)
                waiting.append(defs[name])
    head: Schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": f"Courant {kind}"}
    return head | root | {"$defs": dict(sorted(defs.items()))}


def _names(of: Any) -> list[str]:
    """Names of the definitions that a schema refers to."""
    if isinstance(of, dict):
        own = [of["$ref"].rpartition("/")[2]] if isinstance(of.get("$ref"), str) else []
        return own + [name for value in of.values() for name in _names(value)]
    return [name for value in of for name in _names(value)] if isinstance(of, list) else []


def main(words: Sequence[str]) -> int:
    """The exit code: 0, 1 for another kind, 2 where the file cannot be written."""
    parser = Parser("courant schema", allow_abbrev=False, description="JSON schema of scenes, recipes or suites, for editors")
    parser.add_argument("kind", metavar="KIND", help=", ".join(_HOMES))
    parser.add_argument("-o", "--output", metavar="FILE", help="the schema; on standard output if not given")
    call = parser.parse_args(list(words))
    if call.kind not in _HOMES:
        sys.stderr.write(f"error: there is no schema of '{call.kind}'\n  hint: {did_you_mean(call.kind, _HOMES)}{', '.join(_HOMES)}\n")
        return EXIT_INPUT
    text = json.dumps(schema(call.kind), indent=1) + "\n"
    if not call.output:
        sys.stdout.write(text)
        return EXIT_OK
    try:
        write_file(Path(call.output), text, named=True)
    except OutputError as fault:
        sys.stderr.write(f"error: {fault}\n")
        return EXIT_MISSED
    say(f"schema: {call.output}\n")
    return EXIT_OK
