"""Values out of YAML maps, with every fault told at its location. Recipes and suites are read with it."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import MISSING, field, fields
from pathlib import Path
from typing import Any, List, TypeAlias, TypeVar  # list is a method here

import yaml

from .diagnostics import Diagnostics, Location
from .files import note_input
from .key_tables import keys as keys_of_map
from .words import did_you_mean, shortest

Node: TypeAlias = yaml.Node
_Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_NUMBER = re.compile(r"\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*")
_DEEPEST = 200  # maps and lists in each other: keeps hostile input from exhausting the stack
_STEPS = keys_of_map("steps", "from number!, to number!, step number!")
_TRUE, _FALSE = {"y", "yes", "true", "on"}, {"n", "no", "false", "off"}


def is_map(node: Node) -> bool:
    return isinstance(node, yaml.MappingNode)


def is_list(node: Node) -> bool:
    return isinstance(node, yaml.SequenceNode)


def is_null(node: Node) -> bool:
    return isinstance(node, yaml.ScalarNode) and node.tag == "tag:yaml.org,2002:null"


def is_scalar(node: Node) -> bool:
    """Whether it is a text, a number, or true or false."""
    return isinstance(node, yaml.ScalarNode) and not is_null(node)


def scalar_text(node: Node) -> str:
    """The text of a scalar as it is in the file, "" for anything else."""
    return str(node.value) if is_scalar(node) else ""


def as_number(text: str) -> float | None:
    """The finite number that a text is, else None."""
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    return value if math.isfinite(value) else None


def as_flag(node: Node) -> bool | None:
    """true, yes, on and their opposites, in small or capital letters."""
    text = scalar_text(node)
    word = text.lower() if text in (text.lower(), text.upper(), text.capitalize()) else ""
    return True if word in _TRUE else False if word in _FALSE else None


def load_yaml(file: str | Path, what: str, hint: str, diagnostics: Diagnostics) -> Node | None:
    """The content of a YAML file as nodes with locations. Faults go to `diagnostics`; then there is None.

    `what`: "recipe", for the message; `hint`: what such a file is.
    """
    try:
        data = Path(file).read_bytes()
    except OSError:
        diagnostics.error(file, f"cannot read the {what}", f"check the path; {hint}")
        return None
    note_input(Path(file))
    return parse_yaml(data, str(file), diagnostics)


def parse_yaml(data: bytes | str, file: str, diagnostics: Diagnostics) -> Node | None:
    """The nodes of a YAML text; an empty one is null."""
    try:
        depth = 0
        for event in yaml.parse(data, _Loader):
            depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
            if depth > _DEEPEST:
                raise yaml.MarkedYAMLError(problem="maps and lists are nested too deeply", problem_mark=event.start_mark)  # type: ignore[arg-type]
        loader = _Loader(data)
        try:
            node = loader.get_node() if loader.check_node() else None
        finally:
            loader.dispose()
    except yaml.MarkedYAMLError as fault:
        mark = fault.problem_mark or fault.context_mark
        where = Location(file, mark.line + 1, mark.column + 1) if mark else Location(file)
        diagnostics.error(where, f"not valid YAML: {fault.problem or fault.context}")
        return None
    except (yaml.YAMLError, UnicodeError, ValueError) as fault:  # ValueError: characters that YAML does not allow
        diagnostics.error(file, f"not valid YAML: {' '.join(str(fault).split())}")
        return None
    return node if node is not None else yaml.ScalarNode("tag:yaml.org,2002:null", "")


Made = TypeVar("Made")


def key(how: str, default: Any = MISSING, **options: Any) -> Any:
    """A field of a dataclass that YamlMap.read reads by its own name: `how` is the method, "text" or "positive", `options` are its arguments. `default`:
    of the dataclass, and where the file has none."""
    return field(default=default, metadata={"how": how, "options": options}) if default is not MISSING else field(metadata={"how": how, "options": options})


def keys_of(made: type) -> List[str]:
    """The keys of a map that is read as a dataclass."""
    return [one.name for one in fields(made) if "how" in one.metadata]  # type: ignore[arg-type]


class YamlMap:
    """One map of a file. A fault of the map as a whole is reported when it is made.

    Values that are missing or wrong come as the default that the caller gives; a wrong one is reported.
    """

    def __init__(self, node: Node, name: str, file: str, diagnostics: Diagnostics) -> None:
        self.node, self.name, self.file, self.diagnostics = node, name, str(file), diagnostics
        if not is_map(node):
            self.error(node, f"'{name}' must be a map of keys and values", "write 'key: value' lines")

    def entries(self) -> Iterator[tuple[str, Node, Node]]:
        """Text of the key, the key and the value of each entry, in their order."""
        for key, value in self.node.value if is_map(self.node) else ():
            yield scalar_text(key), key, value

    def allow(self, *keys: str) -> None:
        """Tells all other keys, and keys that stand twice. Call it once with all keys that the map may have."""
        seen: set[str] = set()
        for text, key, _ in self.entries():
            if text in seen:
                self.error(key, f"'{self.name}.{text}' stands twice")
            seen.add(text)
            if text not in keys:
                self.error(key, f"'{self.name}' does not know the key '{text}'", f"{did_you_mean(text, keys)}known keys: {', '.join(keys)}")

    def read(self, made: type[Made], *others: str, **known: Any) -> Made:
        """A dataclass whose fields are keys; `known`: its other fields; `others`: keys that the map may have, too."""
        self.allow(*keys_of(made), *others)
        values = {}
        for one in fields(made):  # type: ignore[arg-type]
            if "how" in one.metadata and one.name not in known:
                how, options = one.metadata["how"], one.metadata["options"]
                if one.default is not MISSING and how in ("number", "positive", "text", "flag"):
                    options = options | {"default": one.default}
                value = getattr(self, how)(one.name, **options)
                values[one.name] = one.default if value is None and one.default is not MISSING else value
        return made(**values, **known)

    def get(self, key: str, required: bool = False) -> Node | None:
        """The value of a key, None if it is missing or null."""
        if not is_map(self.node):
            return None
        for text, _, value in self.entries():
            if text == key:
                if not is_null(value):
                    return value
                break
        if required:
            self.error(self.node, f"'{self.name}' lacks the key '{key}'")
        return None

    def has(self, key: str) -> bool:
        return self.get(key) is not None

    def scalar(self, node: Node, key: str) -> float | None:
        """The number that a node is; a fault is reported, and gives None."""
        value = as_number(node.value) if is_scalar(node) else None
        if value is None:
            self.error(node, f"'{self.name}.{key}' must be a number, got '{node.value if is_scalar(node) else 'a list'}'")
        return value

    def number(self, key: str, default: float = 0.0, required: bool = False) -> float:
        node = self.get(key, required)
        value = self.scalar(node, key) if node is not None else None
        return default if value is None else value

    def positive(self, key: str, default: float = 0.0, required: bool = False) -> float:
        node = self.get(key, required)
        value = self.scalar(node, key) if node is not None else None
        if value is not None and not value > 0:
            self.error(node or self.node, f"'{self.name}.{key}' must be greater than 0, got {shortest(value)}")
        return default if value is None else value

    def text(self, key: str, default: str = "", required: bool = False) -> str:
        node = self.get(key, required)
        if node is None:
            return default
        if is_scalar(node):
            return str(node.value)
        self.error(node, f"'{self.name}.{key}' must be a text")
        return default

    def flag(self, key: str, default: bool = False, message: str = "must be true or false") -> bool:
        node = self.get(key)
        if node is None:
            return default
        value = as_flag(node)
        if value is None:
            self.error(node, f"'{self.name}.{key}' {message}")
        return default if value is None else value

    def choice(self, key: str, words: Sequence[str], default: str = "") -> str:
        """One of several words; `default`, or the first one, if the key is not there."""
        otherwise = default or words[0]
        word = self.text(key, otherwise)
        if word in words:
            return word
        self.error(self.get(key) or self.node, f"'{self.name}.{key}' cannot be '{word}'", f"{did_you_mean(word, words)}it is one of {', '.join(words)}")
        return otherwise

    def list(self, key: str, required: bool = False) -> List[Node]:
        """The elements of a list, none if it is not there."""
        node = self.get(key, required)
        if node is None:
            return []
        if is_list(node):
            return [*node.value]
        self.error(node, f"'{self.name}.{key}' must be a list", "write [a, b, ...]")
        return []

    def numbers(self, key: str, required: bool = False) -> List[float]:
        """The numbers of a list."""
        return [self.scalar(node, key) or 0.0 for node in self.list(key, required)]

    def texts(self, key: str) -> List[str]:
        """The words of a list."""
        return [scalar_text(node) for node in self.list(key)]

    def range(self, key: str, required: bool = False, example: str = "for example [0, 1.1]") -> tuple[float, float] | None:
        """`key: [a, b]` with a < b."""
        node = self.get(key, required)
        return None if node is None else self.range_of(node, key, example)

    def range_of(self, node: Node, key: str, example: str = "for example [0, 1.1]") -> tuple[float, float] | None:
        if not is_list(node) or len(node.value) != 2:
            self.error(node, f"'{self.name}.{key}' must be two numbers", example)
            return None
        low = self.scalar(node.value[0], key)
        high = self.scalar(node.value[1], key) if low is not None else None
        if low is None or high is None:
            return None
        if not low < high:
            self.error(node, f"'{self.name}.{key}': the first number must be less than the second")
            return None
        return low, high

    def places(self, key: str, required: bool = False) -> List[float]:
        """A number, a list of numbers, or {from, to, step}."""
        node = self.get(key, required)
        if node is None:
            return []
        if is_map(node):
            return self.element(node, f"{self.name}.{key}").steps()
        nodes = node.value if is_list(node) else [node]
        if not nodes:
            self.error(node, f"'{self.name}.{key}' is empty")
        return [self.scalar(one, key) or 0.0 for one in nodes]

    def steps(self, most: float = 1e5) -> List[float]:
        """The locations of this map: {from, to, step}."""
        self.allow(*_STEPS)
        start, end = self.number("from", required=True), self.number("to", required=True)
        step = self.positive("step", required=True)
        if not step > 0:
            return []
        if not start <= end or (end - start) / step > most:
            self.error(self.node, f"'{self.name}' must go upwards in at most {most:g} steps")
            return []
        out: List[float] = []
        while start + len(out) * step <= end + 1e-6 * step:
            out.append(start + len(out) * step)
        return out

    def map(self, key: str) -> YamlMap | None:
        node = self.get(key)
        if node is None:
            return None
        return YamlMap(node, key if self.name == "recipe" else f"{self.name}.{key}", self.file, self.diagnostics)

    def element(self, node: Node, name: str) -> YamlMap:
        return YamlMap(node, name, self.file, self.diagnostics)

    def error(self, node: Node, message: str, hint: str = "") -> None:
        self.diagnostics.error(self.where(node), message, hint)

    def where(self, node: Node | None = None) -> Location:
        """The location of a node, of the map itself if none is given."""
        mark = (self.node if node is None else node).start_mark
        return Location(self.file, mark.line + 1, mark.column + 1) if mark else Location(self.file)
