"""A scene in Python: the same description as one in YAML, built by calls.

scene = courant.Scene("house in a dam break", spacing=0.02, end=1.5)
scene.water(low=(0, 0, 0), high=(0.6, 0.6, 0.4))
scene.box(low=(0, 0, 0), high=(2, 0.6, 1), open=["top"])
scene.wall("house.stl", scale=0.001, move=(1.2, 0.2, 0))
run = scene.run("results")
print(run.verdict, run.states[-1]["pressure"].max())
"""
from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from os import PathLike, fspath, path
from pathlib import Path
from typing import Any, Union

import numpy as np
import yaml

from ..diagnostics import CourantError, Diagnostics, Location
from ..files import OutputError, write_file
from ..words import shortest
from ..yaml_map import Node, is_list, is_map
from .command import write_deck
from .explain import explained
from .groups import tidied
from .mesh_files import cells_of_gmsh
from .model import Model
from .node_reader import Mark
from .reader import SceneReader
from .shape_reader import DataNode
from .shapes import ShapeFault
from .surfaces import polygon_of

Number = Union[float, str]  # also an expression of the scene's parameters: "height / n"
Point = Sequence[Number]  # two components in the plane, three in space
_RESOLVER = yaml.resolver.Resolver()


def _caller() -> Mark:
    """Where the call into this package stands."""
    frame = sys._getframe(1)
    while frame.f_back and str(frame.f_globals.get("__name__", "")).partition(".")[0] == "courant":
        frame = frame.f_back
    return Mark(path.relpath(frame.f_code.co_filename) if path.isabs(frame.f_code.co_filename) else frame.f_code.co_filename, frame.f_lineno)


def _node(value: Any, mark: Mark) -> Node:
    """A value as it would be in YAML."""
    if isinstance(value, yaml.Node):
        return value
    if isinstance(value, (bool, np.bool_)):
        return yaml.ScalarNode("tag:yaml.org,2002:bool", "true" if value else "false", mark, mark)
    if isinstance(value, (int, float, np.integer, np.floating)):
        value = shortest(float(value))
    if isinstance(value, (str, PathLike)):
        text = fspath(value)
        tag = _RESOLVER.resolve(yaml.ScalarNode, text, (True, False))
        tag = "tag:yaml.org,2002:str" if tag.endswith((":null", ":bool", ":timestamp")) else tag
        return yaml.ScalarNode(tag, text, mark, mark, style="|" if "\n" in text else None)
    if isinstance(value, Mapping):
        return yaml.MappingNode("tag:yaml.org,2002:map", [(_node(str(key), mark), _node(one, mark)) for key, one in value.items()], mark, mark, flow_style=True)
    if isinstance(value, (list, tuple, set, frozenset)) or (isinstance(value, np.ndarray) and value.ndim in (1, 2)):
        return yaml.SequenceNode("tag:yaml.org,2002:seq", [_node(one, mark) for one in value], mark, mark, flow_style=True)
    return DataNode(value, mark)


def _texts(parameters: Mapping[str, Number]) -> dict[str, str]:
    """Values of parameters as texts of YAML. Raises CourantError for what is neither number nor text."""
    out, diagnostics = dict[str, str](), Diagnostics()
    for name, value in parameters.items():
        try:
            out[name] = value if isinstance(value, str) else shortest(float(value))
        except (TypeError, ValueError):
            diagnostics.error("", f"parameter {name}: expected a number or an expression, got {value!r}", f"{name}=0.5, or {name}=\"0.5 / 2\"")
    if not diagnostics.ok:
        raise CourantError(diagnostics)
    return out


class Scene:
    """What happens in a run. Numbers may be expressions of the scene's parameters, as texts. Two components make a scene of the plane with y upwards,
    three one of space with z upwards. Numbers are those of SI units; in others give `density` and `gravity`, too."""

    def __init__(self, title: str = "untitled scene", *, spacing: Number | None = None, end: Number, output: Number | None = None,
                 gravity: Number | None = None, density: Number | None = None, sound_speed: Number | None = None, viscosity: Number | None = None, tension: bool | None = None,
                 velocity: Point | None = None, pressure: Number | None = None, wall_method: str | None = None, friction: Number | None = None,
                 parameters: Mapping[str, Number] | None = None) -> None:
        """`spacing` of particles, and without water of meshes, where it may be left out [L]; `friction`: coefficient of parts without water; `end` of the run, `output`: interval of states [T]; of the water: `density` [M/L3], `sound_speed` [L/T], linear
        coefficient `viscosity` [-], `tension`: whether it may pull, `velocity` [L/T] and `pressure` [M/LT2] at the start, also by x, y, z;
        `wall_method`: "mirrors", "contact", "ghosts" or "mixed", box and bodies as mirrors and other walls by contact; `explain` states what is taken for what is left out."""
        mark = _caller()
        self._path, self._folder = mark.name, ""
        self._name, self._overrides, self._of_python = path.basename(mark.name), dict[str, str](), True
        water = {"spacing": spacing, "density": density, "sound_speed": sound_speed, "viscosity": viscosity, "tension": tension, "velocity": velocity,
                 "pressure": pressure}
        self._root = _node({}, mark)
        self._root.flow_style = False  # type: ignore[attr-defined]
        for key, value in {"title": title, "parameters": parameters, "end": end, "output": output, "gravity": gravity, "friction": friction,
                           "wall_method": wall_method}.items():
            if value is not None:
                self._set(self._root, key, value, mark)
        self._set(self._root, "water", {key: value for key, value in water.items() if value is not None}, mark)
        self._get("water").flow_style = False  # type: ignore[attr-defined]

    @classmethod
    def from_yaml(cls, file: str | PathLike[str], **parameters: Number) -> Scene:
        """The scene of a YAML file, with other values for some of its parameters. Raises CourantError."""
        scene = cls._loaded(file, parameters)
        scene._model()
        return scene

    @classmethod
    def _loaded(cls, file: str | PathLike[str], parameters: Mapping[str, Number]) -> Scene:
        """A scene in YAML whose description is not read yet."""
        scene = cls.__new__(cls)
        scene._path = fspath(file)
        scene._folder, scene._name, scene._of_python = path.dirname(scene._path), path.basename(scene._path), False
        scene._overrides = _texts(parameters)
        diagnostics = Diagnostics()
        try:
            root = SceneReader(scene._path, {}, diagnostics).load(scene._path)
            if root is not None:
                scene._root = root
        except OSError:
            diagnostics.error(scene._path, "the scene cannot be read", "check the name and the permissions")
        if diagnostics.ok and root is None:
            diagnostics.error(scene._path, "the scene is empty", "start with 'title: ...'")
        cls._raise(diagnostics)
        return scene

    def with_parameters(self, **parameters: Number) -> Scene:
        """The same scene with other values for some of its parameters."""
        other = self.__class__.__new__(self.__class__)
        other.__dict__ |= self.__dict__
        other._overrides = self._overrides | _texts(parameters)
        return other

    # what is in it

    def water(self, low: Any = None, high: Point | None = None, **keys: Any) -> Scene:
        """A box of water from `low` to `high` [L], in whole spacings, with `where` (a condition or expression of x, y, z) and `jitter`; or a body of it
        within a closed shape: a file, a mesh, or keys of `wall`."""
        mark = _caller()
        if high is not None or "low" in keys or "high" in keys:
            self._append(("water", "blocks"), {"low": low, "high": high, **keys}, mark)
        else:
            self._append(("water", "bodies"), self._shape(low, keys), mark)
        return self

    def gas(self, low: Point, high: Point, *, density: Number, pressure: Number, velocity: Point | None = None, gamma: Number | None = None,
            **keys: Any) -> Scene:
        """A perfect gas from `low` to `high` [L], in whole spacings, with its `density` [M/L3], `pressure` [M/LT2], `velocity` [L/T], and ratio of heat
        capacities `gamma` (1.4, if not given); `where`, `jitter`, `title`. Gases fill a scene without water, whose box has planes of symmetry as sides."""
        given = {"velocity": velocity, "gamma": gamma, **keys}
        self._append(("gases",), {"low": low, "high": high, "density": density, "pressure": pressure, **given}, _caller())
        return self

    def box(self, low: Point, high: Point, open: str | Sequence[str] = (), motion: Mapping[str, Any] | None = None) -> Scene:  # noqa: A002
        """Fixed walls around a box [L] but for its `open` sides: left, right, bottom, top, in space front and back; `motion`: its displacements by axis
        [L], formulas of TIME, or times and values (n, 2), or {"file": "motion.csv"}."""
        entry = {"low": low, "high": high} | ({"open": [open] if isinstance(open, str) else list(open)} if open else {}) | ({"motion": motion} if motion else {})
        self._set(self._root, "box", entry, _caller())
        return self

    def wall(self, shape: Any = None, **keys: Any) -> Scene:
        """A rigid wall: the surface of a file (STL, OBJ, PLY, meshes of Gmsh and others; CSV, DXF, SVG in the plane), a mesh of PyVista, VTK, meshio or
        trimesh, (points, triangles), or one of `box={"low", "high"}`, `cylinder={"base", "top", "radius"}`, `sphere={"centre", "radius"}`,
        `circle`, `line=[[x, y], ...]`, `plate={"origin", "edge1", "edge2"}`. `scale`, `turn` (degrees) and `move` bring it to its position, `close` fills
        holes, `open` takes a surface with holes as thin, `ground` makes all below it solid, `group` takes one group of a mesh, `motion` as of `box`
        drives it, and `motion={"rotation": {"about", "axis", "speed", "angle" or "rpm", "ramp"}}` turns it."""
        self._append(("walls",), self._shape(shape, keys), _caller())
        return self

    def body(self, shape: Any = None, **keys: Any) -> Scene:
        """A rigid body that moves freely: a closed shape as of `wall`, with its `density` [M/L3] or `mass` [M], `velocity` [L/T], and `hold`: directions
        x, y, z and turns rx, ry, rz that it does not take."""
        self._append(("bodies",), self._shape(shape, keys), _caller())
        return self

    def structure(self, shape: Any = None, **keys: Any) -> Scene:
        """A part that deforms: solids of `box={"low", "high"}`, `cylinder={"base", "top", "radius"}`, `sphere={"centre", "radius"}`, or of a file or mesh of
        meshio (Gmsh, VTK, Abaqus and others); shells with a `thickness` [L] of `plate={"origin", "edge1", "edge2"}`, in the plane `line=[[x, y], ...]`, of a
        cylinder as a tube, or of a mesh of triangles and quadrangles; beams with a `section={"rod": d}`, {"tube": [d, t]}, {"rectangle": [w, h]} or
        {"cable": d} [L] of `beam=[point, point, ...]`, a list of such lines, or lines of a mesh. `join={"end": title}`: nodes that go with other parts. `material`: a name, such as "steel", or {"density", "young", "poisson", "yield",
        "tangent"} [M/L3, M/LT2]; `size` of its elements [L]; `fix`: nodes that are held, by a side ("bottom"), a group of the mesh or a condition ("y < 0.01"), or that
        go with the wall or body `to`; `group` takes one group of a mesh alone; `track=[point, ...]`: nodes whose motion is written; `velocity` [L/T], `scale`, `turn`, `move`, `title`."""
        self._append(("structures",), self._shape(shape, keys), _caller())
        return self

    def joint(self, kind: str, between: Sequence[int | str], at: Point, *, axis: Point | None = None, stiffness: Number | None = None,
              damping: Number | None = None) -> Scene:
        """Joins two bodies, or a body and a wall, by their titles or numbers ("walls": the box): a "hinge" about an `axis` through the point `at` (in the plane
        about z), with a spring of `stiffness` [ML2/T2] and `damping` [ML2/T] a radian, a "ball" joint, a "slider" along the axis, a "cylindrical" joint about
        and along it, or "fixed"."""
        given = {"axis": axis, "stiffness": stiffness, "damping": damping}
        self._append(("joints",), {"kind": kind, "between": list(between), "at": at, **{key: value for key, value in given.items() if value is not None}}, _caller())
        return self

    def inlet(self, at: Point | None = None, direction: Point | None = None, *, speed: Number, width: Number | None = None, radius: Number | None = None,
              sides: Sequence[Number] | None = None, start: Number | None = None, end: Number | None = None, side: str | None = None,
              depth: Number | None = None) -> Scene:
        """With `side` and `depth` [L] the inflow of a channel through an open side of the box, which joins the water there. Otherwise a jet: water that enters around the point `at` along `direction`, with a `speed` [L/T], a number or a formula of TIME: in the plane through a `width`, in
        space through a circle of a `radius` or a rectangle of two `sides`, the second the more upright one [L]; from `start` to `end` [T]."""
        given = {"at": at, "direction": direction, "side": side, "depth": depth, "width": width, "radius": radius, "sides": sides, "start": start, "end": end}
        self._append(("inlets",), {"speed": speed, **{key: value for key, value in given.items() if value is not None}}, _caller())
        return self

    def outlet(self, side: str, level: Number | None = None) -> Scene:
        """Lets water leave at an open side of the box, which is no longer in the results; with a `level` [L] the outlet of a channel keeps this depth."""
        self._append(("outlets",), {"side": side} | ({"level": level} if level is not None else {}), _caller())
        return self

    def gauge(self, name: str, *, point: Point | None = None, level: Sequence[Point] | None = None, runup: Sequence[Point] | None = None,
              flux: Sequence[Point] | None = None, force: int | str | Sequence[int | str] | None = None, interval: Number | None = None, body: int | str | None = None,
              about: Point | None = None) -> Scene:
        """Measures, under a name, one of: pressure, velocity and density at a `point` (which moves with a `body`); the `level` of the surface, or the
        `runup` of the water, on a line of two points; the `flux` through two points in the plane, three corners in space; the `force` on a part, and its
        moment `about` a point. `body` and `force`: number or title of a part, of `force` also a list. `interval` [T]: a tenth of that of states, if not given. Other characters of
        the name than letters, digits, -, _ and . become _."""
        given = {"point": point, "level": level, "runup": runup, "flux": flux, "force": force, "interval": interval, "with": body, "about": about}
        self._append(("gauges",), {"name": name, **{key: value for key, value in given.items() if value is not None}}, _caller())
        return self

    def damping(self, start: Point, end: Point, rate: Number, exponent: Number | None = None) -> Scene:
        """Slows the water so that waves leave without a reflection: v' = - `rate` s^`exponent` v [1/T], where s grows from 0 at `start` to 1 at `end`, and
        is 1 beyond; the exponent is 2, if not given."""
        entry = {"start": start, "end": end, "rate": rate} | ({"exponent": exponent} if exponent is not None else {})
        self._append(("damping",), entry, _caller())
        return self

    def keywords(self, text: str) -> Scene:
        """Cards beside those of the scene; of control cards that stand twice the last counts. ${EXPRESSION:10} is filled in."""
        self._append(("keywords",), text if text.endswith("\n") else text + "\n", _caller())
        return self

    # what becomes of it

    def deck(self) -> str:
        """The text of the deck. Raises CourantError with all that is wrong."""
        from .deck import deck_pieces

        diagnostics = Diagnostics()
        pieces = deck_pieces(self._model(diagnostics), self._name, diagnostics, self._of_python)
        self._raise(diagnostics)
        return b"".join(pieces).decode("utf-8", "surrogateescape")

    def write(self, file: str | PathLike[str]) -> Path:
        """Writes the deck, and tells on standard error what was repaired. Raises CourantError."""
        diagnostics = Diagnostics()
        model = self._model(diagnostics)
        write_deck(model, self._name, fspath(file), diagnostics, self._of_python)
        self._raise(diagnostics)
        sys.stderr.write(diagnostics.text())
        return Path(file)

    def to_yaml(self, file: str | PathLike[str] | None = None) -> str:
        """The scene in YAML, also written to a file where one is named. Raises CourantError where it holds meshes that are in no file."""
        diagnostics = Diagnostics()
        root = _with_lines(self._described())
        for node in _all(root):
            if isinstance(node, DataNode):
                diagnostics.error(SceneReader(self._path, {}, diagnostics).at(node), f"a mesh in memory, {node.value}, has no form in YAML",
                                  "write it to a file, and name that")
        self._raise(diagnostics)
        text: str = yaml.serialize(root, Dumper=yaml.SafeDumper, width=150, allow_unicode=True)
        if file is not None:
            try:
                write_file(Path(file), text, named=True)
            except OutputError as fault:
                diagnostics.error(fspath(file), str(fault))
                raise CourantError(diagnostics) from None
        return text

    def explain(self) -> str:
        """Each choice that was made for the scene, with its reason and its cards."""
        return explained(self._model())

    def preview(self, file: str | PathLike[str] | None = None, field: str = "", **keys: Any) -> Any:
        """A picture of the first state, before the run: courant.preview has the arguments."""
        import tempfile

        from ..previewing import preview_of

        with tempfile.TemporaryDirectory(prefix="courant_") as folder:
            return preview_of(self.write(Path(folder, "scene.k")), self._path, file, field, **keys)

    def run(self, folder: str | PathLike[str] = "results", **options: Any) -> Any:
        """Writes the deck to the folder and runs it: courant.run has the options and what is raised."""
        from ..running import run

        return run(self._written_to(folder), folder, **options)

    def steps(self, folder: str | PathLike[str] = "results", *, every: float = 0.0, every_steps: int = 0, **options: Any) -> Any:
        """The same as a loop over the states while the run goes on: `for state in scene.steps(every=0.01)`, see courant.steps."""
        from ..stepping import steps

        return steps(self._written_to(folder), folder, every=every, every_steps=every_steps, **options)

    def _written_to(self, folder: str | PathLike[str]) -> Path:
        from ..files import make_folder

        diagnostics = Diagnostics()
        try:
            make_folder(Path(folder))
        except OutputError as fault:
            diagnostics.error(fspath(folder), str(fault))
        self._raise(diagnostics)
        return self.write(Path(folder, Path(self._name).stem + ".k"))

    # the description

    @staticmethod
    def _raise(diagnostics: Diagnostics) -> None:
        if not diagnostics.ok:
            raise CourantError(diagnostics)

    def _model(self, diagnostics: Diagnostics | None = None) -> Model:
        found = diagnostics if diagnostics is not None else Diagnostics()
        reader = SceneReader(self._path, self._overrides, found)
        reader.folder = self._folder
        model = reader.read(self._described())
        self._raise(found)
        return model

    def _described(self) -> Node:
        """The description; of parts without water, which `__init__` cannot know, without 'water'."""
        root, keys = self._root, {str(key.value): value for key, value in self._root.value} if is_map(self._root) else {}
        if not self._of_python or not {"walls", "bodies", "structures"} & set(keys) or {"inlets", "gases"} & set(keys) \
                or any(key.value != "spacing" for key, _ in keys["water"].value):
            return root
        return yaml.MappingNode(root.tag, [one for entry in root.value for one in (entry[1].value if entry[0].value == "water" else [entry])], root.start_mark,
                                root.end_mark, flow_style=False)

    @property
    def parameters(self) -> list[str]:
        """Names of the parameters, of bases, too."""
        reader = SceneReader(self._path, {}, Diagnostics())  # what is wrong is reported where the scene is read
        reader.folder = self._folder
        if is_map(self._root):
            reader.read_parameters(self._root)
        return list(dict.fromkeys(name for name, _ in reader.parameters))

    @staticmethod
    def _shape(shape: Any, keys: dict[str, Any]) -> dict[str, Any]:
        if shape is None:
            return keys
        return {"file" if isinstance(shape, (str, PathLike)) else "mesh": shape if isinstance(shape, (str, PathLike)) else _Held(_of_gmsh(shape)), **keys}

    @staticmethod
    def _set(node: Node, key: str, value: Any, mark: Mark) -> None:
        made = DataNode(value.thing, mark) if isinstance(value, _Held) else _node(value, mark)
        node.value = [entry for entry in node.value if entry[0].value != key] + [(_node(key, mark), made)]

    def _get(self, key: str) -> Node:
        return next(value for name, value in self._root.value if name.value == key)

    def _append(self, keys: tuple[str, ...], value: Any, mark: Mark) -> None:
        """Adds an element to a list of the description, which is made where it is not there."""
        node = self._root if len(keys) == 1 else self._get(keys[0])
        known = next((one for name, one in node.value if name.value == keys[-1]), None)
        if known is None:
            self._set(node, keys[-1], [], mark)
            known = node.value[-1][1]
            known.flow_style = False
        elif not is_list(known):
            old = known
            self._set(node, keys[-1], [], mark)
            known = node.value[-1][1]
            known.value.append(old)
        entry = _node({}, mark) if isinstance(value, dict) else _node(value, mark)
        if isinstance(value, dict):
            for key, one in value.items():
                if one is not None:  # None is what Python has for "not given"
                    self._set(entry, key, one, mark)
        known.value.append(entry)


def _of_gmsh(thing: Any) -> Any:
    """Of the model of Gmsh its present mesh, which the script may change later; anything else as it is. Raises CourantError."""
    if not (hasattr(thing, "getPhysicalGroups") and hasattr(thing, "mesh")):
        return thing
    try:
        return tidied(cells_of_gmsh(thing))
    except Exception as fault:  # gmsh raises plain ones
        diagnostics = Diagnostics()
        message = fault.message if isinstance(fault, ShapeFault) else str(fault)
        diagnostics.error(Location(_caller().name, _caller().line + 1), f"the model of Gmsh cannot be read: {message}", "gmsh.initialize() and gmsh.model.mesh.generate() come before")
        raise CourantError(diagnostics) from None


class _Held:
    """A mesh, which is not to be taken for numbers of YAML."""

    def __init__(self, thing: Any) -> None:
        self.thing = thing


def _with_lines(node: Node) -> Node:
    """The same description with polygons of points as closed lines, which YAML has a form for."""
    if is_list(node):
        return yaml.SequenceNode(node.tag, [_with_lines(one) for one in node.value], node.start_mark, node.end_mark, flow_style=node.flow_style)  # type: ignore[attr-defined]
    if not is_map(node):
        return node
    entries = []
    for key, value in node.value:
        xy = polygon_of(value.data) if isinstance(value, DataNode) and key.value == "mesh" else None
        if xy is None:
            entries.append((key, _with_lines(value)))
        else:
            closed = xy if len(xy) < 3 or np.array_equal(xy[0], xy[-1]) else np.vstack([xy, xy[:1]])
            entries.append((_node("line", key.start_mark), _node(closed, value.start_mark)))
    return yaml.MappingNode(node.tag, entries, node.start_mark, node.end_mark, flow_style=node.flow_style)  # type: ignore[attr-defined]


def _all(node: Node) -> list[Node]:
    inner = [one for entry in node.value for one in (entry if isinstance(entry, tuple) else (entry,))] if not isinstance(node, yaml.ScalarNode) else []
    return [node, *(found for one in inner for found in _all(one))]
