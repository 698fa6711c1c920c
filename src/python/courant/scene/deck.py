"""The deck of a model, in fixed columns. It depends on the model alone: no dates, no paths."""
from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..diagnostics import Diagnostics
from .beams import element_cards
from .joins import tie_cards
from .merger import Merger
from .model import LARGEST_ID, Fault, Lattice, Model, Part, Variables
from .numbers import number_text, numbers, whole_numbers
from .places import Axis, lattice_points, values_at

_FIRST_TIE = 7001  # set and part of the first node that goes with an element
_BLANK, _END = ord(" "), ord("\n")


@dataclass
class Placed:
    """Nodes and elements of one part. Particles have the ids of their nodes, which are consecutive."""

    first: int
    nodes: list[list[Axis]] = field(default_factory=list)  # groups of x, y, z
    masses: list[tuple[int, float]] = field(default_factory=list)  # particles of each group, and their MASS field
    shells: np.ndarray = field(default_factory=lambda: np.zeros((0, 4), dtype=int))  # ids of their nodes, eight of solids
    first_shell: int = 1
    same: dict[int, int] = field(default_factory=dict)  # ids of nodes that are those of other parts, by their number

    def id_of(self, node: int) -> int:
        return self.same.get(int(node), self.first + int(node))

    def size(self) -> int:
        return sum(len(group[0].values if group[0].codes is None else group[0].codes) for group in self.nodes)

    def particles(self) -> int:
        return sum(count for count, _ in self.masses)


def _place_plates(part: Part, placed: Placed) -> None:
    merger = Merger(1e-6 * min(plate.side for plate in part.plates)) if part.merge else None
    groups: list[np.ndarray] = []
    shells: list[np.ndarray] = []
    count = 0
    for plate in part.plates or part.solids:
        points = plate.nodes()
        if merger:
            ids = merger.numbers(points)
        else:
            ids = count + np.arange(len(points))
            groups.append(points)
            count += len(points)
        shells.append(placed.first + ids[plate.shells()])
    points = np.array(merger.points) if merger else np.concatenate(groups)
    placed.nodes.append([Axis(points[:, k]) for k in range(3)])
    placed.shells = np.concatenate(shells)


class Placer:
    """Gives nodes and elements of parts the next free ids over the whole deck."""

    def __init__(self, variables: Variables, diagnostics: Diagnostics) -> None:
        self.variables, self.diagnostics = variables, diagnostics
        self.node = self.shell = 1

    def place(self, part: Part) -> Placed:
        if part.first_id > 0:
            self._start_at(part)
        placed = Placed(self.node, first_shell=self.shell)
        for stream, lattice in enumerate(part.lattices, 1000 * part.id):
            try:
                placed.nodes.append(lattice_points(lattice, stream, self.variables))
            except Fault as fault:
                fault.tell(self.diagnostics)
                break
            # MASS > 0 is a mass, < 0 a volume
            self._compare(part, lattice, placed.size() - placed.particles())
            placed.masses.append((placed.size() - placed.particles(), part.density * lattice.volume if part.density > 0 else -lattice.volume))
        meshed = bool(part.plates or part.solids)
        if not meshed and not placed.particles() and not part.empty and self.diagnostics.ok:
            if any(one.without for one in part.lattices) and not any(one.where for one in part.lattices):
                self.diagnostics.error(part.where, f"part {part.id} has no particles: walls and bodies cover all of it", "a tank is a shape with 'open: true'")
            else:
                self.diagnostics.error(part.where, f"part {part.id} has no particles: 'where' leaves none", "a particle is kept where the expression is > 0")
        if meshed:
            _place_plates(part, placed)
        self.node += placed.size()
        self.shell += len(placed.shells)
        last = max(self.node, self.shell) - 1
        if last > LARGEST_ID:
            self.diagnostics.error(part.where, f"part {part.id}: ids reach {last}, the format ends at {LARGEST_ID}")
        return placed

    def _compare(self, part: Part, lattice: Lattice, count: int) -> None:
        """Particles that fill a shape alone hold what it holds."""
        if len(lattice.solids) != 1 or lattice.where or lattice.without or not count:
            return
        whole = lattice.solids[0].shape.volume()
        share = count * lattice.volume / whole
        if abs(share - 1) > 0.01:
            self.diagnostics.warning(part.where, f"the particles of '{lattice.solids[0].shape.name or part.title}' hold {share:.4g} of its volume {whole:.4g}",
                                     "a finer spacing follows the shape more closely")

    def _start_at(self, part: Part) -> None:
        if part.first_id < self.node or ((part.plates or part.solids) and part.first_id < self.shell):
            self.diagnostics.error(part.where, f"part {part.id}: ids from {part.first_id} on are taken by the parts above",
                                   f"first_id: {max(self.node, self.shell)} or more is free")
        self.node = part.first_id
        if part.plates or part.solids:
            self.shell = part.first_id


def _share(parts: list[Part], placed: list[Placed]) -> None:
    """Nodes that are those of another part."""
    by_part = dict(zip((part.id for part in parts), placed))
    for part, one in zip(parts, placed):
        one.same = {node: by_part[other].first + there for node, other, there in part.shared}
    for part, one in zip(parts, placed):  # of a node that is that of a third part
        for node, other, there in part.shared:
            one.same[node] = by_part[other].id_of(there)
            one.shells = np.where(one.shells == one.first + node, one.same[node], one.shells)


def _lines(count: int, width: int) -> np.ndarray:
    lines = np.full((count, width + 1), _BLANK, dtype=np.uint8)
    lines[:, width] = _END
    return lines


def _node_lines(first: int, group: list[Axis]) -> bytes:
    count = len(group[0].values if group[0].codes is None else group[0].codes)
    lines = _lines(count, 56)
    lines[:, :8] = whole_numbers(np.arange(first, first + count), 8)
    for k, axis in enumerate(group):
        # 15 of 16 columns, so that neighbours stay apart; the error is below 1e-11 for |x| < 100
        text = numbers(np.where(np.abs(axis.values) < 1e-15, 0.0, axis.values), 15, 16)
        lines[:, 8 + 16 * k : 24 + 16 * k] = text if axis.codes is None else text[axis.codes]
    return lines.tobytes()


def _particle_lines(first: int, count: int, part: int, mass: float) -> bytes:
    lines = _lines(count, 32)
    lines[:, :8] = whole_numbers(np.arange(first, first + count), 8)
    lines[:, 8:32] = np.frombuffer(f"{part:8}{number_text(mass, 16):>16}".encode(), dtype=np.uint8)
    return lines.tobytes()


def _shell_lines(first: int, part: int, shells: np.ndarray) -> bytes:
    columns = [np.arange(first, first + len(shells)), np.full(len(shells), part), *shells.T]
    lines = _lines(len(shells), 8 * len(columns))
    for k, column in enumerate(columns):
        lines[:, 8 * k : 8 * k + 8] = whole_numbers(column, 8)
    return lines.tobytes()


def _heading(names: tuple[str, ...], width: int) -> str:
    """ "$#      id      styp ...", each name at the right end of its field."""
    return "$#" + names[0].rjust(width - 2) + "".join(name.rjust(width) for name in names[1:]) + "\n"


def _fits(value: float) -> bool:
    """Whether ten columns hold a number as exactly as matters."""
    text = number_text(value, 10)
    return bool(text) and abs(float(text) - value) <= 1e-6 * abs(value)


def _inertia_text(part: Part) -> str:
    """The further cards of *PART_INERTIA."""
    if not part.inertia:
        return ""
    mass, centre, tensor = part.inertia
    cards = [(("xc", "yc", "zc", "tm"), [*centre, mass]),
             (("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), [tensor[a, b] for a, b in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))]),
             (("vtx", "vty", "vtz"), part.velocity or (0.0, 0.0, 0.0))]
    return "".join(_heading(names, 10) + "".join(number_text(float(v), 10).rjust(10) for v in values) + "\n" for names, values in cards)


def _parts_text(parts: list[Part]) -> str:
    out = ""
    for part in parts:
        out += f"*PART{'_INERTIA' if part.inertia else ''}\n$# heading\n{part.title}\n$#     pid     secid       mid     eosid      hgid\n"
        out += f"{part.id:10}{part.section:10}{part.material:10}{part.eos:10}{part.hourglass:10}\n" + _inertia_text(part)
    for part in parts:
        if part.velocity is None or part.inertia:
            continue
        wide = not all(_fits(v) for v in part.velocity)  # + behind the keyword: fields of 20 columns
        width = 20 if wide else 10
        out += f"*INITIAL_VELOCITY_GENERATION{' +' if wide else ''}\n" + _heading(("id", "styp", "omega", "vx", "vy", "vz", "ivatn", "icid"), width)
        words = [str(part.id), "2", "0", *(number_text(v, width) for v in part.velocity), "0", "0"]
        out += "".join(word.rjust(width) for word in words) + "\n"
        out += _heading(("xc", "yc", "zc", "nx", "ny", "nz", "phase", "irigid"), width) + "0".rjust(width) * 8 + "\n"
    return out


def _held_nodes(part: Part, placed: Placed) -> str:
    """Nodes that are held, or that go with a rigid part, and those with a history."""
    out = ""
    for to, nodes in part.carried:
        out += "*CONSTRAINED_EXTRA_NODES_NODE\n" + _heading(("pid", "nid"), 10) + "".join(f"{to:10}{placed.id_of(k):10}\n" for k in nodes)
    if len(part.fixed):
        out += "*BOUNDARY_SPC_NODE\n" + _heading(("nid", "cid", "dofx", "dofy", "dofz", "dofrx", "dofry", "dofrz"), 10)
        out += "".join(f"{placed.id_of(k):10}         0" + 6 * "         1" + "\n" for k in part.fixed)
    if len(part.tracked):
        out += "*DATABASE_HISTORY_NODE\n" + "".join(f"{placed.id_of(k):10}\n" for k in part.tracked)
    return out


def _initial_state(part: Part, placed: Placed, variables: Variables, out: list[bytes]) -> None:
    """Velocities and pressures of single particles, where they are expressions of the position: cards in long format, so that 13 digits fit. Raises
    Fault."""
    if not placed.size() or (not part.velocity_of_place and not part.pressure):
        return
    points = [np.concatenate([group[k].all() for group in placed.nodes]) for k in range(3)]
    ids = whole_numbers(np.arange(placed.first, placed.first + len(points[0])), 20)
    if part.velocity_of_place:
        out.append(("*INITIAL_VELOCITY_NODE +\n" + "".join(name.rjust(20) for name in ("$#               nid", "vx", "vy", "vz")) + "\n").encode())
        velocity = [numbers(values_at(one, "velocity", points, variables), 20) for one in part.velocity_of_place]
        out.append(_long_lines([ids, *velocity]))
    if part.pressure:  # a fluid at rest with pressure p has sigma = -p I
        out.append(("*INITIAL_STRESS_SPH +\n" + "".join(name.rjust(20) for name in ("$#               eid", "sigxx", "sigyy", "sigzz")) + "\n").encode())
        sigma = numbers(-values_at(part.pressure, "pressure", points, variables), 20)
        out.append(_long_lines([ids, sigma, sigma, sigma]))


def _long_lines(columns: list[np.ndarray]) -> bytes:
    return np.hstack([*columns, np.full((len(columns[0]), 1), _END, dtype=np.uint8)]).tobytes()


def deck_pieces(model: Model, name: str, diagnostics: Diagnostics, of_python: bool = False) -> list[bytes]:
    """The whole deck in pieces; `name` of the file of the scene, in YAML or Python, goes into its first comment. Ids are consecutive within a part; ids
    that clash or do not fit their columns are errors, and there are then no pieces."""
    before = diagnostics.errors
    placer = Placer(model.variables, diagnostics)
    placed = [placer.place(part) for part in model.parts]
    _share(model.parts, placed)
    if diagnostics.errors > before:
        return []
    by = f"courant.Scene in {name}" if of_python else f"`courant generate {name}`"
    head = f"$ Written by {by}: change the scene, not this file.\n$ Parameters:\n"
    head += "".join(f"$   {parameter} = {number_text(value)}\n" for parameter, value in model.parameters) + "$ Parts:\n"
    for part, one in zip(model.parts, placed):
        holds = f"{one.particles()} particles" if one.particles() else f"{len(one.shells)} {'solids' if part.solids else 'beams' if one.shells.shape[1] == 2 else 'shells'}"
        head += f"$   {part.id} {part.title}: {holds}\n"
    head += f"*KEYWORD\n*TITLE\n{model.title}\n"
    head += "".join(block if not block or block.endswith("\n") else block + "\n" for block in model.keywords)
    out = [(head + _parts_text(model.parts)).encode("utf-8", "surrogateescape")]
    if any(one.nodes for one in placed):  # an inlet needs none at the start
        out.append(b"*NODE\n$#   nid               x               y               z      tc      rc\n")
    for one in placed:
        first = one.first
        for group in one.nodes:
            out.append(_node_lines(first, group))
            first += len(out[-1]) // 57
    if any(one.particles() for one in placed):
        out.append(b"*ELEMENT_SPH\n$#   nid     pid            mass    nend   (mass < 0: volume)\n")
    for part, one in zip(model.parts, placed):
        first = one.first
        for count, mass in one.masses:
            out.append(_particle_lines(first, count, part.id, mass))
            first += count
    for kind, corners in (("SHELL", 4), ("SOLID", 8)):
        meshed = [(part, one) for part, one in zip(model.parts, placed) if len(one.shells) and one.shells.shape[1] == corners]
        if meshed:
            out.append(f"*ELEMENT_{kind}\n$#   eid     pid{''.join(f'n{k}'.rjust(8) for k in range(1, corners + 1))}\n".encode())
        out += [_shell_lines(one.first_shell, part.id, one.shells) for part, one in meshed]
    for part, one in zip(model.parts, placed):
        if len(one.shells) and one.shells.shape[1] == 2:
            out.append(element_cards(one.first_shell, part.id, one.shells, part.upwards).encode())
    out += [_held_nodes(part, one).encode() for part, one in zip(model.parts, placed)]
    by_part = dict(zip((part.id for part in model.parts), placed))
    ties = [(one.id_of(tie.node), [by_part[tie.part].id_of(k) for k in tie.others]) for part, one in zip(model.parts, placed) for tie in part.ties]
    out.append(tie_cards(_FIRST_TIE, ties).encode())
    try:
        for part, one in zip(model.parts, placed):
            _initial_state(part, one, model.variables, out)
    except Fault as fault:
        fault.tell(diagnostics)
        return []
    return [*out, b"*END\n"]
