"""Files of a scene, the scene and what it has in common with others, and the values of its parameters."""
from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..diagnostics import Diagnostics
from ..expressions import ExpressionFault, evaluate
from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list, is_map, is_scalar, parse_yaml, scalar_text
from .node_reader import OF_PYTHON, NodeReader

_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*", re.ASCII)

_BASE = keys_of_map("a base", "base text|list, parameters map, parts [@a part], keywords text|list")


@dataclass
class Base:
    """A file that scenes have in common. `above`: names of parameters of the files that this one is a base of."""

    path: str
    node: Node
    above: set[str]


class ParameterReader(NodeReader):
    """Reads the bases of a scene, each once and after its own, and the parameters of all of them."""

    def __init__(self, path: str, overrides: Mapping[str, str], diagnostics: Diagnostics) -> None:
        super().__init__(path, diagnostics)
        self.overrides = overrides
        self.folder = os.path.dirname(path)  # where paths of the scene begin
        self.bases: list[Base] = []
        self.loading: list[str] = []  # the scene and the bases on the path to the file that is read
        self.parameters: list[tuple[str, float]] = []  # in the order of the file, after overrides

    def load(self, path: str) -> Node | None:
        """The root of a file; None where it is not valid YAML. Raises OSError."""
        return parse_yaml(Path(path).read_bytes(), path, self.diagnostics)

    def read_parameters(self, root: Node) -> None:
        """Of the scene and its bases."""
        self.loading.append(os.path.normpath(self.path))
        self._load_bases(root, set())
        self._read_all(self.get(root, "parameters"))

    def of_bases(self) -> Iterator[Node]:
        """The roots of the bases; messages name their files meanwhile."""
        for base in self.bases:
            scene, self.path = self.path, base.path
            yield base.node
            self.path = scene

    def _names(self, root: Node, names: set[str]) -> set[str]:
        return names | {scalar_text(key) for key, _ in self._entries(self.get(root, "parameters"))}

    @staticmethod
    def _entries(node: Node | None) -> list[tuple[Node, Node]]:
        return list(node.value) if node is not None and is_map(node) else []

    def _load_bases(self, root: Node, above: set[str]) -> None:
        node = self.get(root, "base")
        if node is not None:
            names = self._names(root, above)
            for one in node.value if is_list(node) else [node]:
                self._load_base(one, names)

    def _load_base(self, node: Node, above: set[str]) -> None:
        path = os.path.normpath(os.path.join(os.path.dirname(self.path), self.text(node)))
        if path in self.loading:
            return self.error(node, f"base: '{path}' is a base of itself")
        known = next((base for base in self.bases if base.path == path), None)
        if known:
            known.above |= above
            return None
        try:
            root = self.load(path)
        except OSError:
            return self.error(node, f"base: the file '{path}' cannot be read")
        if root is None:
            return None
        self.loading.append(path)
        scene, self.path = self.path, path
        self.check_keys(root, "a base", _BASE)
        if is_map(root):
            self._load_bases(root, above)
        self.path = scene
        self.loading.pop()
        self.bases.append(Base(path, root, set(above)))
        return None

    def _read_all(self, node: Node | None) -> None:
        """Parameters of bases as soon as all that they need is there, the scene's own one after the other; of several of the same name that of the
        file which has the others as bases."""
        unused = set(self.overrides)
        done: set[int] = set()  # entries of bases

        def ready(value: Node) -> bool:
            try:
                evaluate(scalar_text(value), self.variables)
            except ExpressionFault:
                return False
            return is_scalar(value)

        def read_bases(when: Callable[[Node], bool]) -> bool:
            more = False
            for root, base in zip(self.of_bases(), self.bases):
                for key, value in self._checked_entries(self.get(root, "parameters"), report=not done and when is not ready):
                    if id(key) not in done and scalar_text(key) not in base.above and when(value):
                        done.add(id(key))
                        self._read(key, value, unused)
                        more = True
            return more

        def read_ready() -> None:
            while read_bases(ready):
                pass

        read_ready()
        for key, value in self._checked_entries(node, report=True):
            self._read(key, value, unused)
            read_ready()
        read_bases(lambda value: True)
        for name in sorted(unused):
            self.diagnostics.error(self.path, f"--param {name}: the scene has no such parameter",
                                   f"its parameters: {', '.join(name for name, _ in self.parameters) or 'none'}")

    def _checked_entries(self, node: Node | None, report: bool) -> list[tuple[Node, Node]]:
        if node is not None and not is_map(node) and report:
            self.error(node, "parameters: expected a map of NAME: VALUE")
        return self._entries(node)

    def _read(self, key: Node, node: Node, unused: set[str]) -> None:
        if not is_scalar(key) or not is_scalar(node):
            return self.error(key, "parameters: expected NAME: VALUE with a number or an expression")
        name = key.value
        if not _NAME.fullmatch(name):
            self.error(key, f"parameters: '{name}' is not a name", "use letters, digits and _")
        if name == "pi":
            self.error(key, "parameters: 'pi' is there already, 3.14159...")
        elif name in self.variables:
            self.error(key, f"parameters: '{name}' stands twice")
        unused.discard(name)
        text = self.overrides.get(name, node.value)
        if node.tag == OF_PYTHON and name not in self.overrides:
            self.error(node, f"parameter {name}: expected a number, got {text}", "a number, or a text with an expression of the parameters above it")
            text = "1"
        try:
            value = evaluate(text, self.variables)
        except ExpressionFault as fault:
            of = "--param" if name in self.overrides else "parameter"
            self.error(node, f"{of} {name}: {fault.message}, got '{text}'", "an expression may use the parameters above it")
            value = 1.0  # goes on, so that all faults are reported at once
        self.variables[name] = value
        self.parameters.append((name, value))
        return None
