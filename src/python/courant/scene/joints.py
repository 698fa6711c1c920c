"""Joints of a scene: entries of `joints:` in YAML, and `Scene.joint` in Python."""
from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..key_tables import keys as keys_of_map
from ..words import did_you_mean
from ..yaml_map import Node, is_list
from .numbers import number_text
from .part_names import described, named_part

if TYPE_CHECKING:
    from .basin import Basin
    from .basin_reader import BasinReader
    from .model import Model
    from .reader import SceneReader

# Each kind with its name in decks, and how many pairs of nodes fix it: at the point, along the axis, beside it.
_KINDS = {"ball": ("SPHERICAL", 1), "hinge": ("REVOLUTE", 2), "cylindrical": ("CYLINDRICAL", 2), "slider": ("TRANSLATIONAL", 3), "fixed": ("LOCKING", 3)}
_KEYS = keys_of_map("a joint", "kind text!, between list!, at vector!, axis vector, stiffness number, damping number, title text")
_EXAMPLE = "- {kind: hinge, between: [gate, walls], at: [1, 0]}"
FIRST_NODE, FIRST_CURVE, FIRST_STIFFNESS = 90000001, 951, 1

_STIFFNESS = """\
*CONSTRAINED_JOINT_STIFFNESS_GENERALIZED
$#    jsid      pida      pidb      cida      cidb       jid
{number:10}{a:10}{b:10}{system:10}{system:10}
$#  lcidph    lcidt    lcidps    dlcidph    dlcidt   dlcidps
         0         0{spring:10}         0         0{damper:10}


"""


def joined_pairs(reader: BasinReader, root: Node) -> list[set[str]]:
    """What each joint of a scene names, titles and numbers."""
    node = reader.get(root, "joints")
    pairs = [reader.get(entry, "between") for entry in node.value] if node is not None and is_list(node) else []
    return [{str(one.value) for one in pair.value} for pair in pairs if pair is not None and is_list(pair)]


def joined_names(reader: BasinReader, root: Node) -> set[str]:
    """What all of them name."""
    return set[str]().union(*joined_pairs(reader, root))


def read_joints(reader: SceneReader, root: Node, model: Model, basin: Basin | None) -> None:
    """Adds the cards of all joints of a scene to its keywords."""
    node = reader.get(root, "joints")
    if node is None:
        return
    if not is_list(node) or not node.value:
        reader.error(node, "joints: expected a list that is not empty", _EXAMPLE)
        return
    if basin is None:
        return  # without water, which is an error of its own
    for number, entry in enumerate(node.value):
        if reader.is_map(entry, _EXAMPLE, "a joint"):
            _read_one(reader, root, entry, model, basin, number)


def _read_one(reader: SceneReader, root: Node, node: Node, model: Model, basin: Basin, number: int) -> None:
    reader.check_keys(node, "a joint", _KEYS)
    before = reader.diagnostics.errors
    entry = reader.get(node, "kind")
    kind = reader.text(entry) if entry is not None else ""
    if kind not in _KINDS:
        reader.error(entry or node, f"a joint: its kind '{kind}' is not known" if kind else "'kind' is missing",
                     f"{did_you_mean(kind, _KINDS)}known: {', '.join(_KINDS)}; {_EXAMPLE}")
    at, dim = reader.vector(node, "at")
    if dim and dim != basin.dim:
        reader.error(reader.get(node, "at") or node, f"at: expected {basin.dim} components")
    axis = _axis(reader, node, kind, basin.dim) if kind in _KINDS else np.zeros(3)
    parts = _between(reader, node, basin) if reader.complete else _described(reader, root, node)
    springs = [_positive(reader, node, key, kind) for key in ("stiffness", "damping")]
    if reader.diagnostics.errors > before or not reader.complete:
        return
    model.keywords.append(_cards(kind, number, parts, np.array(at), axis, basin) + _spring_cards(number, parts, axis, springs))
    names = basin.rigid_parts()
    model.choices.append((f"'{names[parts[0]]}' is joined to '{names[parts[1]]}' by a {kind} joint", "given", f"*CONSTRAINED_JOINT_{_KINDS[kind][0]}"))


def _positive(reader: SceneReader, node: Node, key: str, kind: str) -> float:
    entry = reader.get(node, key)
    if entry is None:
        return 0.0
    if kind != "hinge":
        reader.error(entry, f"'{key}' goes with a hinge")
    return reader.length(node, key, "number")


def _axis(reader: SceneReader, node: Node, kind: str, dim: int) -> np.ndarray:
    """A unit vector; of hinges in the plane along z."""
    entry = reader.get(node, "axis")
    flat_hinge = dim == 2 and kind in ("hinge", "ball", "fixed")
    if entry is None and (flat_hinge or kind in ("ball", "fixed")):
        return np.array([0.0, 0.0, 1.0])
    if entry is None:
        reader.error(node, f"'axis' is missing: a {kind} joint has one", "axis: [0, 1, 0]")
        return np.array([0.0, 0.0, 1.0])
    if flat_hinge or kind in ("ball", "fixed"):
        reader.error(entry, f"axis: a {kind} joint has none" + (" in the plane" if dim == 2 else ""), "leave it out")
    if dim == 2 and kind == "cylindrical":
        reader.error(entry, "a cylindrical joint: in space alone", "in the plane a slider moves along an axis")
    axis = np.array(reader.vector(node, "axis")[0])
    length = float(np.linalg.norm(axis))
    if not length > 0:
        reader.error(entry, "axis: expected a direction that is not zero")
        return np.array([0.0, 0.0, 1.0])
    return axis / length


def _described(reader: SceneReader, root: Node, node: Node) -> tuple[int, int]:
    """Reports names that the scene has not, where some of its bodies could not be read."""
    titles, entry = described(reader, root), reader.get(node, "between")
    for one in entry.value if titles is not None and entry is not None and is_list(entry) else ():
        if (text := reader.text(one)) not in titles and not text.isdigit():  # type: ignore[operator]
            reader.error(one, f"between: there is no body or wall '{text}'", f"there are {', '.join(titles[1:])}; 'title' names a shape")  # type: ignore[index]
    return 0, 0


def _between(reader: SceneReader, node: Node, basin: Basin) -> tuple[int, int]:
    entry = reader.get(node, "between")
    titles = basin.rigid_parts()
    names = titles.values()
    free = {solid.part for solid in basin.solids if solid.free}
    if entry is None or not is_list(entry) or len(entry.value) != 2:
        reader.error(entry or node, "between: expected two of the bodies and walls", f"there are {', '.join(names) or 'none'}; {_EXAMPLE}")
        return 0, 0
    found = []
    for one in entry.value:
        number = named_part(reader, one, "between", titles)
        if number == 0:
            reader.error(one, f"between: there is no body or wall '{reader.text(one)}'", f"there are {', '.join(names) or 'none'}; 'title' names a shape")
        found.append(number or 0)
    if all(found) and not free & set(found):
        reader.error(entry, "between: one of the two must be a body, which moves", "both are walls")
    if found[0] == found[1] and found[0]:
        reader.error(entry, "between: expected two different parts")
    return found[0], found[1]


def _cards(kind: str, number: int, parts: tuple[int, int], at: np.ndarray, axis: np.ndarray, basin: Basin) -> str:
    """Pairs of nodes at the same point, one of each part: at the joint, along its axis, beside it."""
    name, pairs = _KINDS[kind]
    arm = 10 * basin.spacing
    beside = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    points = [at, at + arm * axis, at + arm * beside / np.linalg.norm(beside)][:pairs]
    first = FIRST_NODE + 6 * number
    at_points = ["".join(number_text(float(v), 15).rjust(16) for v in point) for point in points]
    nodes = "".join(f"{first + 2 * k + side:8}{text}\n" for k, text in enumerate(at_points) for side in (0, 1))
    extra = "".join(f"{part:10}{first + 2 * k + side:10}\n" for k in range(pairs) for side, part in enumerate(parts))
    row = "".join(f"{first + k:10}" for k in range(2 * pairs))
    return (f"$ Joint {number + 1}: {kind}\n*NODE\n$#   nid               x               y               z\n{nodes}"
            f"*CONSTRAINED_EXTRA_NODES_NODE\n$#     pid       nid\n{extra}"
            f"*CONSTRAINED_JOINT_{name}\n$#      n1        n2        n3        n4        n5        n6\n{row}\n")


def _spring_cards(number: int, parts: tuple[int, int], axis: np.ndarray, springs: list[float]) -> str:
    """Of a hinge: moment over angle and over its rate, about the third axis of a system whose z is the axis of the joint."""
    if not any(springs):
        return ""
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    second = np.cross(axis, first)
    curves = [FIRST_CURVE + 2 * number + k if springs[k] else 0 for k in (0, 1)]
    out = (f"*DEFINE_COORDINATE_VECTOR\n$#     cid        xx        yx        zx        xv        yv        zv\n{FIRST_CURVE + number:10}"
           + "".join(number_text(float(v) + 0.0, 10).rjust(10) for v in (*first, *second)) + "\n")
    out += _STIFFNESS.format(number=FIRST_STIFFNESS + number, a=parts[0], b=parts[1], system=FIRST_CURVE + number, spring=curves[0], damper=curves[1])
    for curve, slope, reach in zip(curves, springs, (10.0, 1e4)):
        if curve:
            out += f"*DEFINE_CURVE\n$#    lcid\n{curve:10}\n$#                a1                  o1\n"
            out += "".join(f"{sign * reach:20.9e}{sign * reach * slope:20.9e}\n" for sign in (-1, 1))
    return out
