"""Nodes of deformable parts that go with other parts of a scene: with walls and bodies, or with other deformable parts."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..yaml_map import Node
from .meshes import BEAMS, SHELLS, Mesh
from .part_names import named_part

if TYPE_CHECKING:
    from .basin import Basin
    from .basin_reader import BasinReader
    from .structures import Structure

_SAME = 1e-5  # of the longest side of an element, within which nodes are one
_NEAR = 1.0  # longest sides of elements, within which a node is joined to the nearest element


@dataclass
class Join:
    """What an entry `join` asks for: nodes, and the title or number of a part."""

    nodes: np.ndarray
    to: Node
    made: Structure


@dataclass
class Tie:
    """A node that moves rigidly with those of an element of another part."""

    node: int
    part: int
    others: np.ndarray


def resolve(reader: BasinReader, joins: list[Join], basin: Basin) -> None:
    """Binds the nodes, now that all parts are known."""
    for one in joins:
        rigid = basin.rigid_parts()
        soft = {part.part: part.title for part in basin.structures if part is not one.made}
        number = named_part(reader, one.to, "join", rigid | soft)
        if number is None:
            continue
        if number in rigid:
            one.made.carried.append((number, one.nodes))
        elif number in soft:
            _tie(reader, one, next(part for part in basin.structures if part.part == number))
        else:
            names = ", ".join((*rigid.values(), *soft.values()))
            reader.error(one.to, f"join: there is no wall, body or structure '{reader.text(one.to)}'", f"there are {names or 'none'}; 'title' names a part")


def _longest(mesh: Mesh) -> float:
    corners = mesh.points[mesh.cells]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max())


def _meets(join: Join, other: Structure) -> bool:
    """Whether all nodes of a join are at nodes of the other part, both of beams or shells."""
    if other.mesh.kind not in (BEAMS, SHELLS) or join.made.mesh.kind not in (BEAMS, SHELLS):
        return False
    tiny = _SAME * _longest(other.mesh)
    return all(float(np.linalg.norm(other.mesh.points - join.made.mesh.points[node], axis=1).min()) <= tiny for node in join.nodes.tolist())


def _tie(reader: BasinReader, join: Join, other: Structure) -> None:
    """Nodes at those of beams and shells are the same node; others go with the nearest element."""
    mesh, size = other.mesh, _longest(other.mesh)
    if reader.dim == 2 and not _meets(join, other):
        reader.error(join.to, f"join: in the plane the nodes must be at nodes of '{other.title}', both of beams or shells", "let both parts meet at nodes, or make the scene three-dimensional")
        return
    centres = mesh.points[mesh.cells].mean(axis=1)
    for node in join.nodes.tolist():
        x = join.made.mesh.points[node]
        away = np.linalg.norm(mesh.points - x, axis=1)
        nearest = int(np.argmin(away))
        if away[nearest] > _NEAR * size:
            at = ", ".join(f"{v:.4g}" for v in x[: reader.dim or 3])
            reader.error(join.to, f"join: the node of '{join.made.title}' at ({at}) is {away[nearest]:.3g} away from '{other.title}', whose elements are {size:.3g} long",
                         "let it begin on the other part")
            return
        if away[nearest] <= _SAME * size and mesh.kind in (BEAMS, SHELLS) and join.made.mesh.kind in (BEAMS, SHELLS):
            join.made.shared.append((node, other.part, nearest))
            continue
        around = np.flatnonzero((mesh.cells == nearest).any(axis=1))
        cell = mesh.cells[around[np.argmin(np.linalg.norm(centres[around] - x, axis=1))]]
        join.made.ties.append(Tie(node, other.part, np.unique(cell)))


def tie_cards(first_set: int, ties: list[tuple[int, list[int]]]) -> str:
    """*CONSTRAINED_NODAL_RIGID_BODY of each node and the nodes that it goes with, by their ids; ties with common nodes are one body."""
    out = ""
    bodies = list[list[int]]()
    for node, others in ties:
        joined = [node, *others]
        for body in [body for body in bodies if not set(body).isdisjoint(joined)]:
            bodies.remove(body)
            joined = [*body, *(one for one in joined if one not in body)]
        bodies.append(joined)
    for k, ids in enumerate(bodies):
        out += f"*SET_NODE_LIST\n$#     sid\n{first_set + k:10}\n" + "".join("".join(f"{one:10}" for one in ids[at : at + 8]) + "\n" for at in range(0, len(ids), 8))
        out += f"*CONSTRAINED_NODAL_RIGID_BODY\n$#     pid       cid      nsid\n{first_set + k:10}         0{first_set + k:10}\n"
    return out
