"""Deformable parts of a description: entries of `structures:` in YAML, and `Scene.structure` in Python."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..expressions import Formula
from ..key_tables import keys as keys_of_map
from ..optional import MissingModule
from ..yaml_map import Node, is_list, is_map, is_scalar
from . import meshes
from .beams import Section, beam_mesh, read_lines, read_section, upwards
from .joins import Join, resolve
from .materials import Material, read_material
from .mesh_files import read_cells
from .mesh_objects import cells_of_object
from .meshes import SHELLS, SOLIDS, Mesh
from .part_names import named_part
from .shape_reader import BOX, CYLINDER, SPHERE, DataNode
from .structures import FIRST_STRUCTURE, Structure
from .shapes import Shape, ShapeFault
from .surfaces import sound, surface_of
from .volume_mesh import tetrahedra

if TYPE_CHECKING:
    from .basin import Basin
    from .basin_reader import BasinReader

_KINDS = keys_of_map("a kind of structure", "box @a box, cylinder @a cylinder, sphere @a sphere, plate any, line any, beam list, file text, mesh any")
_KEYS = (
    *_KINDS,
    *keys_of_map(
        "of every structure",
        "material text|@a material!, thickness number, section @a section, size number|list, fix any, to any, join map, track any, velocity list, title text, group text, scale number|list, turn any, "
        "move list, close flag",
    ),
)
_EXAMPLE = "- {box: {low: [0.6, 0], high: [0.612, 0.08]}, material: rubber, fix: bottom}"
_ENDS = {"left": (0, 0), "right": (0, 1), "front": (1, 0), "back": (1, 1), "bottom": (2, 0), "top": (2, 1)}


def read_structures(reader: BasinReader, root: Node, basin: Basin) -> None:
    node = reader.get(root, "structures")
    if node is None:
        return
    if not is_list(node) or not node.value:
        reader.error(node, "structures: expected a list that is not empty", _EXAMPLE)
        return
    before, joins = reader.diagnostics.errors, list[Join]()
    for entry in node.value:
        if reader.is_map(entry, _EXAMPLE, "a structure") and (made := _read_one(reader, entry, basin)) is not None:
            made.part = FIRST_STRUCTURE + len(basin.structures)
            basin.structures.append(made)
            joins += _joins(reader, entry, made, basin.dim)
            reader.add_entities(entry, len(made.mesh.cells))
    if reader.diagnostics.errors == before:
        resolve(reader, joins, basin)


def _read_one(reader: BasinReader, node: Node, basin: Basin) -> Structure | None:
    reader.check_keys(node, "a structure", _KEYS)
    before = reader.diagnostics.errors
    given = [kind for kind in _KINDS if reader.get(node, kind) is not None]
    if len(given) != 1:
        reader.error(node, f"a structure: expected one of {', '.join(_KINDS)}, got {' and '.join(given) or 'none'}", _EXAMPLE)
        return None
    thickness = reader.length(node, "thickness") if reader.get(node, "thickness") is not None else 0.0
    section = _section(reader, node, given[0])
    if reader.diagnostics.errors > before:
        return None
    mesh = _mesh(reader, node, given[0], basin, thickness, section is not None)
    material = read_material(reader, reader.get(node, "material"), node, basin)
    if mesh is None or material is None or reader.diagnostics.errors > before:
        return None
    title = reader.get(node, "title")
    mesh.name_of_kind, mesh.name = given[0], reader.text(title) if title is not None else mesh.name
    for note in mesh.notes:
        reader.diagnostics.note(reader.at(node), f"{mesh.name}: {note}")
    if mesh.kind != SHELLS and thickness:
        reader.error(reader.get(node, "thickness") or node, f"thickness: of shells, and these are {mesh.kind}", "leave it out")
    if section is not None:
        _check_section(reader, node, mesh, section, material, basin.dim)
    if mesh.kind == SHELLS and not thickness:
        reader.error(node, f"'thickness' is missing: '{mesh.name}' is of shells", "thickness: 0.01")
    made = Structure(mesh, material, thickness, section=section, where=reader.at(node))
    if reader.get(node, "velocity") is not None:
        made.velocity = reader.vector(node, "velocity")[0]
    _fix(reader, node, made, basin)
    _track(reader, node, made)
    return made if reader.diagnostics.errors == before else None


def _section(reader: BasinReader, node: Node, kind: str) -> Section | None:
    entry = reader.get(node, "section")
    if entry is None:
        if kind == "beam":
            reader.error(node, "'section' is missing: a beam has one", "section: {rod: 0.02}, {tube: [0.06, 0.003]}, {rectangle: [0.05, 0.1]} or {cable: 0.01}")
        return None
    if kind not in ("beam", "file", "mesh"):
        reader.error(entry, f"section: of beams, and this is a {kind}", "beam: [[0, 0, 0], [0, 0, 3]]")
        return None
    return read_section(reader, entry)


def _check_section(reader: BasinReader, node: Node, mesh: Mesh, section: Section, material: Material, dim: int) -> None:
    entry = reader.get(node, "section") or node
    if section.is_cable and material.yield_stress:
        reader.error(reader.get(node, "material") or node, "a cable is elastic", "leave out 'yield', or take a rod")
    if not section.is_cable and not upwards(mesh, section, dim).any(axis=1).all():
        reader.error(reader.get(entry, "up") or entry, "up: some of the beams run along it", "a direction across all beams of the part")
    if mesh.side < section.radius:
        reader.diagnostics.warning(reader.at(entry), f"elements of '{mesh.name}' are {mesh.side:.3g} long, and its section {2 * section.radius:.3g} across",
                                   "beams are slender: are the units those of the scene? A larger 'size' makes longer elements")


def _sizes(reader: BasinReader, node: Node, usual: np.ndarray) -> np.ndarray:
    """Largest sides of elements along each axis [L]: one number, one for each axis, or what is usual."""
    entry = reader.get(node, "size")
    if entry is None:
        return usual
    if is_list(entry):
        if len(entry.value) not in (2, 3):
            reader.error(entry, "size: expected a length, or one along each axis", "size: 0.01")
            return usual
        values = [reader.length_of(one, "size") for one in entry.value]
        return np.array([*values, values[-1]][:3]) if min(values) > 0 else usual
    value = reader.length_of(entry, "size")
    return np.full(3, value) if value > 0 else usual


def _mesh(reader: BasinReader, node: Node, kind: str, basin: Basin, thickness: float, beams: bool) -> Mesh | None:
    entry = reader.get(node, kind)
    assert entry is not None
    named = reader.get(node, "group")
    if named is not None and kind not in ("file", "mesh"):
        return reader._refuse(named, "group: of a 'file' or a mesh")  # type: ignore[no-any-return]
    made = _of_file(reader, node, entry, kind, basin, thickness, beams) if kind in ("file", "mesh") else _made(reader, node, entry, kind, basin, thickness)
    if made is None:
        return None
    made = reader.moved(node, made, 2 if basin.dim == 2 else 3)
    if made.kind == SOLIDS and not (made.volumes() > 0).all():
        return reader._refuse(entry, "a structure: elements without a volume, or that cross themselves")  # type: ignore[no-any-return]
    return made


def _made(reader: BasinReader, node: Node, entry: Node, kind: str, basin: Basin, thickness: float) -> Mesh | None:
    """A mesh made here."""
    dx, flat = basin.spacing, basin.dim == 2
    if kind == "beam":
        lines = read_lines(reader, entry, basin.dim)
        return beam_mesh(lines, float(_sizes(reader, node, np.zeros(3))[0])) if lines is not None else None
    if kind == "line":
        shape = reader._line(entry) if flat else reader._refuse(entry, "line: of the plane", "in space: plate: {origin, edge1, edge2}")
        if shape is None:
            return None
        points = shape.points[np.append(shape.faces[:, 0], shape.faces[-1, 1])]
        length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
        usual = np.full(3, max(min(2 * dx, length / 16), thickness / 2))
        return meshes.line(points[:, :2], float(_sizes(reader, node, usual)[0]))
    if not is_map(entry):
        reader.error(entry, f"{kind}: expected a map", _EXAMPLE)
        return None
    if flat and kind != "box":
        return reader._refuse(entry, f"{kind}: deformable parts of the plane are boxes and lines", _EXAMPLE)  # type: ignore[no-any-return]
    before = reader.diagnostics.errors
    if kind == "plate":
        shape = reader._plate(entry, dx)
        if shape is None:
            return None
        origin, a, b = shape.points[0], shape.points[1] - shape.points[0], shape.points[3] - shape.points[0]
        usual = np.full(3, max(min(2 * dx, min(np.linalg.norm(a), np.linalg.norm(b)) / 8), thickness / 2))
        return meshes.plate(origin, a, b, _sizes(reader, node, usual))
    reader.check_keys(entry, kind, {"box": BOX, "cylinder": CYLINDER, "sphere": SPHERE}[kind])
    if kind == "box":
        (low, high), dim = reader._points(entry, "box", "low", "high")
        if dim and (dim != basin.dim or not np.all(high[:dim] > low[:dim])):
            reader.error(entry, f"box: low and high have {basin.dim} components, and high is above low along each axis")
        thin = float((high - low)[: basin.dim].min())
        usual = np.where((high - low) <= 1.001 * thin, thin / 3, max(2 * thin / 3, 0.0))
        return meshes.box(low, high, _sizes(reader, node, usual), basin.dim) if reader.diagnostics.errors == before else None
    radius = reader.length(entry, "radius")
    size = float(_sizes(reader, node, np.full(3, radius / 3 if not thickness else max(2 * dx, thickness / 2)))[0])
    points, dim = reader._points(entry, kind, *(("base", "top") if kind == "cylinder" else ("centre",)))
    if reader.diagnostics.errors > before or dim != 3:
        return reader._refuse(entry, f"{kind}: expected points of three components") if dim != 3 else None  # type: ignore[no-any-return]
    if kind == "sphere":
        return meshes.sphere(points[0], radius, size)
    return meshes.tube(points[0], points[1], radius, size) if thickness else meshes.cylinder(points[0], points[1], radius, size)


def _of_file(reader: BasinReader, node: Node, entry: Node, kind: str, basin: Basin, thickness: float, beams: bool) -> Mesh | None:
    """Elements of a mesh in a file or in memory: its lines as `beams`, otherwise its solids, or with a thickness its faces as shells, or without one
    tetrahedra within them by Gmsh."""
    named = reader.get(node, "group")
    group = reader.text(named) if named is not None else ""
    try:
        if kind == "file":
            path = Path(reader.folder, reader.text(entry))
            cells, name = read_cells(path, group), path.stem
        else:
            found = cells_of_object(entry.data) if isinstance(entry, DataNode) else None
            if found is None:
                return reader._refuse(entry, "mesh: expected a mesh of PyVista, VTK, meshio or trimesh, or (points, triangles)",  # type: ignore[no-any-return]
                                      "a file of one is given by its name")
            if group and not found.groups:
                raise ShapeFault(f"group: a {type(entry.data).__name__} has none", "meshes of meshio and models of Gmsh have groups")  # type: ignore[attr-defined]
            cells, name = found, "mesh"
        part = cells.of(group)
        made = meshes.of_cells(cells, group, beams)
        if made is None:
            kinds = ", ".join(sorted({block.type for block in part.cells})) or "none"
            return reader._refuse(entry, f"a structure: expected {'lines' if beams else 'solids, triangles or quadrangles'}, got cells of type {kinds}",  # type: ignore[no-any-return]
                                  "a 'section' makes beams of lines" if "line" in kinds and not beams else "")
        if reader.dim == 2 and not beams:
            return reader._refuse(entry, "a structure of a file: in space alone", _EXAMPLE)  # type: ignore[no-any-return]
        if made.kind == SHELLS:
            close = reader.flag(node, "close", False)
            if not thickness:
                return _filled(reader, node, surface_of(part), close, basin, name)
            if close:
                shape = sound(surface_of(part), closed=True, close=True)
                made = Mesh(shape.points, shape.faces[:, [0, 1, 2, 2]], notes=list(shape.notes))
            made = meshes.with_one_node_a_point(made)
        elif beams:
            made = meshes.with_one_node_a_point(made)
            if reader.dim == 2 and np.ptp(made.points[:, 2]) > 0:
                return reader._refuse(entry, "a structure: lines of a scene in the plane have one z", _EXAMPLE)  # type: ignore[no-any-return]
    except MissingModule as fault:
        return reader._refuse(entry, str(fault), "a surface with a 'thickness' is of shells" if "gmsh" in str(fault) else "")  # type: ignore[no-any-return]
    except ShapeFault as fault:
        if named is not None and fault.message.startswith("group: "):
            return reader._refuse(named, fault.message, fault.hint)  # type: ignore[no-any-return]
        return reader._refuse(entry, f"a structure: {fault.message}", fault.hint)  # type: ignore[no-any-return]
    made.name = name
    _note_tetrahedra(made)
    return made


def _note_tetrahedra(made: Mesh) -> None:
    if made.kind == SOLIDS and (made.cells[:, 3] == made.cells[:, 4]).any():
        made.notes.append("tetrahedra of four nodes are stiff in bending: at least four of them through the thickness, or hexahedra")


def _filled(reader: BasinReader, node: Node, raw: Shape, close: bool, basin: Basin, name: str) -> Mesh:
    """Tetrahedra within a closed surface, in the scene's size. Raises ShapeFault, MissingModule."""
    try:
        shape = sound(raw, closed=True, close=close)
    except ShapeFault as fault:
        raise ShapeFault(fault.message, "'thickness' makes shells of the faces; close: true, in Python close=True, fills holes") from None
    scale = reader.get(node, "scale")
    factor = (reader.length_of(scale, "scale", "number") or 1.0) if scale is not None else 1.0
    size = float(_sizes(reader, node, np.full(3, max(2 * basin.spacing, float((shape.high - shape.low).min()) * factor / 4)))[0])
    made = tetrahedra(shape, size / factor)
    made.name, made.notes = name, list(shape.notes)
    share = made.volumes().sum() / shape.volume()
    if abs(share - 1) > 0.01:
        made.notes.append(f"the elements hold {share:.4g} of the volume within the surface: a smaller 'size' follows it more closely")
    _note_tetrahedra(made)
    return made


def _nodes_where(reader: BasinReader, node: Node, mesh: Mesh, dim: int, key: str) -> np.ndarray:
    """Of a named group or a side of the mesh, or where an expression of x, y, z is > 0; which, (n,) of bool."""
    name = reader.text(node)
    if name in mesh.groups:
        return np.isin(np.arange(len(mesh.points)), mesh.groups[name])
    ends = {"left": (0, 0), "right": (0, 1), "bottom": (1, 0), "top": (1, 1)} if dim == 2 else _ENDS
    if name in ends:
        axis, end = ends[name]
        limit = (mesh.low, mesh.high)[end][axis]
        return np.abs(mesh.points[:, axis] - limit) <= 1e-6 * float(np.max(mesh.high - mesh.low))  # type: ignore[no-any-return]
    formula = Formula(node.value, ("x", "y", "z"), reader.variables)
    if not formula.ok:
        reader.error(node, f"{key}: {formula.error}", f"a side, {', '.join(ends)}{''.join(f', a group, {one}' for one in mesh.groups)}, or a condition: y < 0.01")
        return np.ones(len(mesh.points), dtype=bool)
    return np.asarray(formula.over(dict(zip("xyz", mesh.points.T)), len(mesh.points)) > 0)


def _chosen(reader: BasinReader, entries: list[Node], key: str, made: Structure, dim: int) -> np.ndarray:
    """Numbers of the nodes at sides, of groups or where conditions hold."""
    chosen = np.zeros(len(made.mesh.points), dtype=bool)
    for one in entries:
        if not is_scalar(one):
            reader.error(one, f"{key}: expected a side, a group or a condition", f"{key}: bottom" if key == "fix" else "join: {end: hull}")
            continue
        here = _nodes_where(reader, one, made.mesh, dim, key)
        if not here.any():
            low, high = (", ".join(f"{v:.4g}" for v in corner[:dim]) for corner in (made.mesh.low, made.mesh.high))
            reader.error(one, f"{key}: no node of '{made.title}' is there", f"its nodes reach from ({low}) to ({high})")
        chosen |= here
    return np.flatnonzero(chosen)


def _fix(reader: BasinReader, node: Node, made: Structure, basin: Basin) -> None:
    entry, to = reader.get(node, "fix"), reader.get(node, "to")
    if to is not None and entry is None:
        reader.error(to, "'to' goes with 'fix'", "fix: bottom, to: hull")
    if entry is None:
        return
    chosen = _chosen(reader, list(entry.value) if is_list(entry) else [entry], "fix", made, basin.dim)
    if to is None:
        made.fixed = chosen
        return
    titles = basin.rigid_parts()
    number = named_part(reader, to, "to", titles)
    if number == 0:
        reader.error(to, f"to: there is no wall or body '{reader.text(to)}'", f"there are {', '.join(titles.values()) or 'none'}")
    made.carried.append((number or 0, chosen))


def _joins(reader: BasinReader, node: Node, made: Structure, dim: int) -> list[Join]:
    """Of `join: {NODES: PART}`."""
    entry = reader.get(node, "join")
    if entry is None:
        return []
    if not is_map(entry) or not entry.value:
        reader.error(entry, "join: expected nodes, and the part that each of them goes with", "join: {end: hull}")
        return []
    return [Join(_chosen(reader, [where], "join", made, dim), to, made) for where, to in entry.value]


def _track(reader: BasinReader, node: Node, made: Structure) -> None:
    """Nodes nearest to points."""
    entry = reader.get(node, "track")
    if entry is None:
        return
    if not is_list(entry) or not entry.value or not all(is_list(one) for one in entry.value):
        reader.error(entry, "track: expected a list of points", "track: [[0.3, 0.08]]")
        return
    found = []
    for one in entry.value:
        values = [reader.number(v, "track") or 0.0 for v in one.value]
        if len(values) not in (2, 3):
            reader.error(one, "track: a point has two components in the plane, three in space")
            continue
        point = np.array([*values, 0.0][:3])
        dim = len(values)
        found.append(int(np.argmin(np.linalg.norm((made.mesh.points - point)[:, :dim], axis=1))))
    made.tracked = np.array(sorted(set(found)), dtype=int)


