"""The reference of the Python package as one page, from its docstrings and signatures, without importing it."""

from __future__ import annotations

import ast
import inspect
import re
from pathlib import Path

# What users import, module by module; `courant.Scene` and the like are those of courant/__init__.py.
MODULES = ["scene/scene.py", "deck/deck.py", "deck/blocks.py", "running.py", "stepping.py", "live.py", "sweeping.py", "results.py", "tables.py", "units.py", "previewing.py",
           "diagnostics.py", "waves.py", "wave_analysis.py", "surface_mesh.py", "post/__init__.py", "verify/__init__.py"]


def signature(node: ast.FunctionDef, method: bool) -> str:
    arguments = ast.unparse(node.args)
    if method:
        arguments = re.sub(r"^(self|cls)(, )?", "", arguments)
    return f"{node.name}({arguments})" + (f" -> {ast.unparse(node.returns)}" if node.returns else "")


def is_code(paragraph: str) -> bool:
    try:
        return len(ast.parse(inspect.cleandoc(paragraph)).body) > 1
    except SyntaxError:
        return False


def text_of(node) -> str:
    """A docstring as Markdown: paragraphs of several lines of Python are code."""
    out = ""
    for paragraph in (ast.get_docstring(node) or "").strip().split("\n\n"):
        if is_code(paragraph):
            out += f"```python\n{inspect.cleandoc(paragraph)}\n```\n\n"
        elif paragraph:
            out += paragraph.replace("*", "\\*").replace("<", "&lt;") + "\n\n"
    return out


def decorators(node) -> set[str]:
    return {ast.unparse(d).split("(")[0] for d in node.decorator_list}


def class_text(node: ast.ClassDef) -> str:
    out = f"### class `{node.name}`\n\n{text_of(node)}"
    for item in node.body:
        if isinstance(item, ast.FunctionDef) and (not item.name.startswith("_") or item.name == "__init__") and (ast.get_docstring(item) or item.name == "__init__"):
            head = item.name if "property" in decorators(item) else signature(item, True)
            out += f"`.{head}`\n\n" if item.name != "__init__" else f"`{node.name}{signature(item, True).removeprefix('__init__').split(' -> ')[0]}`\n\n"
            out += text_of(item)
    return out


def module_text(path: Path, name: str) -> str:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    out = f"## {name}\n\n{text_of(tree)}"
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_") and ast.get_docstring(node):
            out += class_text(node)
        elif isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and ast.get_docstring(node):
            out += f"### `{node.name}`\n\n`{signature(node, False)}`\n\n{text_of(node)}"
    return out


def page(project: Path) -> str:
    package = project / "src/python/courant"
    out = "# Python reference\n\nFrom the docstrings of the package `courant`. [Scenes in Python](scenes_in_python.md) shows how the parts work together.\n\n"
    for module in MODULES:
        if (package / module).is_file():
            out += module_text(package / module, "courant." + module.removesuffix(".py").removesuffix("/__init__").replace("/", "."))
    return out
