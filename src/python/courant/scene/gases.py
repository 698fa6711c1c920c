"""Gases in a box: entries of `gases:` in YAML, and `Scene.gas` in Python. They fill a scene without water; sides of the box are planes of symmetry."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, is_list
from .model import Model, Part
from .numbers import number_text
from .placeholders import substitute
from .lattice_reader import BLOCK
from .requests import REQUESTS

if TYPE_CHECKING:
    from .reader import SceneReader

_KEYS = keys_of_map("a gas, besides its lattice", "density number!, pressure number!, velocity list, gamma number, title text")
_BOX = keys_of_map("box beside gases", "low vector!, high vector!, open list")
_EXAMPLE = "- {low: [0, 0], high: [0.5, 0.1], density: 1.2, pressure: 1.0e5}"
_NOT_BESIDE = ("walls", "bodies", "structures", "joints", "inlets", "outlets", "wall_method", "damping")
AIR = 1.4  # ratio of heat capacities
_SOUND_STEPS = 0.5
_LEAST_WIDTH = 6.0  # of the box between two planes of symmetry [spacings]

# Monaghan's viscosity with both terms, for shocks; h varies with the density
_CARDS = """\
*CONTROL_TERMINATION
$#  endtim    endcyc     dtmin    endeng    endmas     nosol
${end:10}         0         0         0     1.0e8         0
*CONTROL_TIMESTEP
$#  dtinit    tssfac
         0${tssfac:10}
*CONTROL_SPH
$#    ncbs     boxid        dt      idim
         1         0    1.0e20${dim:10}
*SECTION_SPH
$#   secid      cslh      hmin      hmax
         1       1.5       0.2       5.0
*HOURGLASS
$#    hgid       ihq        qm       ibq        q1        q2
         1         0         0         0       1.0       0.5
""" + REQUESTS

_GAS = """\
*MAT_NULL
$#     mid        ro        pc        mu
${id:10}${rho:10}         0         0
*EOS_LINEAR_POLYNOMIAL
$#   eosid        c0        c1        c2        c3        c4        c5        c6
${id:10}         0         0         0         0${gamma - 1:10}${gamma - 1:10}         0
$#      e0        v0
${p / (gamma - 1):10}       1.0
"""


@dataclass
class Gas:
    part: Part
    density: float  # [M/L3]
    pressure: float  # [M/LT2]
    gamma: float  # ratio of heat capacities

    @property
    def sound_speed(self) -> float:
        return math.sqrt(self.gamma * self.pressure / self.density)


def read_gases(reader: SceneReader, root: Node, model: Model) -> bool:
    """Adds parts and cards of a scene of gases; whether it is one."""
    node = reader.get(root, "gases")
    if node is None:
        return False
    water = reader.get(root, "water")
    if water is not None and (reader.get(water, "blocks") is not None or reader.get(water, "bodies") is not None):
        reader.error(node, "gases and water in one scene are not there: their densities are a factor of 800 apart",
                     "leave the gas out; water then has a free surface")
        return True
    for key in _NOT_BESIDE:
        if (entry := reader.get(root, key)) is not None:
            reader.error(entry, f"'{key}' beside gases is not there", "gases fill a box, whose sides are planes of symmetry")
    if not is_list(node) or not node.value:
        reader.error(node, "gases: expected a list that is not empty", _EXAMPLE)
        return True
    before = reader.diagnostics.errors
    spacing = reader.length(root, "spacing") if reader.get(root, "spacing") is not None or water is None else reader.length(water, "spacing")
    entries = [entry for entry in node.value if reader.is_map(entry, _EXAMPLE, "a gas")]
    gases = [made for number, entry in enumerate(entries, 1) if (made := _read_gas(reader, entry, number, spacing))]
    end = reader.length(root, "end", "time")
    output = reader.length(root, "output", "time") if reader.get(root, "output") is not None else end / 100
    gravity = reader.number(entry, "gravity") or 0.0 if (entry := reader.get(root, "gravity")) is not None else 0.0
    planes = _planes(reader, root, gases)
    if reader.diagnostics.errors > before:
        return True
    variables = {"end": end, "output": output, "dim": float(reader.dim), "tssfac": _SOUND_STEPS}
    model.parts += [gas.part for gas in gases]
    model.keywords.append(substitute(_CARDS, variables))
    for gas in gases:
        model.keywords.append(substitute(_GAS, {"id": float(gas.part.id), "rho": gas.density, "p": gas.pressure, "gamma": gas.gamma}))
    if gravity:
        model.keywords.append(_gravity_cards(reader.dim, gravity, end))
    model.keywords.append(planes)
    _explain(gases, bool(planes), gravity, model)
    return True


def _gravity_cards(dim: int, gravity: float, end: float) -> str:
    axis = "Y" if dim == 2 else "Z"
    rows = "".join(f"{number_text(t, 20):>20}{number_text(gravity, 20):>20}\n" for t in (0.0, 10 * end + 1))
    return f"*LOAD_BODY_{axis}\n$#    lcid        sf\n         1       1.0\n" \
           f"*DEFINE_CURVE\n$#    lcid\n         1\n$#                a1                  o1\n{rows}"


def _read_gas(reader: SceneReader, node: Node, number: int, spacing: float) -> Gas | None:
    reader.check_keys(node, "a gas", (*BLOCK, *_KEYS))
    before = reader.diagnostics.errors
    part = Part(id=number, title=f"gas {number}", section=1, material=number, eos=number, hourglass=1, where=reader.at(node))
    if (title := reader.get(node, "title")) is not None:
        part.title = reader.text(title)[:70]
    density, pressure = reader.length(node, "density", "number"), reader.length(node, "pressure", "number")
    gamma = reader.number(entry, "gamma") or 0.0 if (entry := reader.get(node, "gamma")) is not None else AIR
    if not 1 < gamma < 10:
        reader.error(node, f"gamma: expected a ratio of heat capacities above 1, got {gamma:g}", "air: 1.4")
    if spacing > 0:
        part.lattices = [reader.read_lattice(node, spacing, _KEYS)]
    if reader.get(node, "velocity") is not None:
        reader.read_velocity(node, True, part)
    return Gas(part, density, pressure, gamma) if reader.diagnostics.errors == before and spacing > 0 else None


def _planes(reader: SceneReader, root: Node, gases: list[Gas]) -> str:
    """Of the sides of the box that are not open: a point, and a vector into the box."""
    box = reader.get(root, "box")
    if box is None or not reader.is_map(box, "box: {low: [0, 0], high: [2, 1], open: [top]}", "box"):
        return ""
    reader.check_keys(box, "box beside gases", _BOX)
    (low, dim), (high, high_dim) = reader.vector(box, "low"), reader.vector(box, "high")
    if dim != high_dim or dim != reader.dim:
        reader.error(box, f"box: low and high have {reader.dim} components, as the gases")
        return ""
    sides = ("left", "right", "bottom", "top") if dim == 2 else ("left", "right", "front", "back", "bottom", "top")
    opened = reader.get(box, "open")
    names = [reader.text(one) for one in (opened.value if is_list(opened) else [opened])] if opened is not None else []
    for name in names:
        if name not in sides:
            reader.error(opened or box, f"open: '{name}' is no side of the box", f"its sides: {', '.join(sides)}")
    for gas in gases:
        for block in gas.part.lattices:
            for k in range(dim):
                top = block.low[k] + block.spacing * block.n[k]
                if block.low[k] < low[k] - 1e-6 * block.spacing or top > high[k] + 1e-6 * block.spacing:
                    reader.error(box, f"'{gas.part.title}' reaches from {block.low[k]:g} to {top:g} along {'xyz'[k]}, "
                                 f"beyond the box from {low[k]:g} to {high[k]:g}")
    spacing = gases[0].part.lattices[0].spacing if gases else 0.0
    for k in range(dim):
        if high[k] - low[k] < _LEAST_WIDTH * spacing * (1 - 1e-6) and not {sides[2 * k], sides[2 * k + 1]} & set(names):
            reader.error(box, f"box: {high[k] - low[k]:g} along {'xyz'[k]} are {(high[k] - low[k]) / spacing:.3g} spacings: between planes of symmetry a gas "
                         f"needs {_LEAST_WIDTH:g}, as its kernel reaches three and grows where it expands", f"{low[k] + _LEAST_WIDTH * spacing:g} as the upper end")
    rows = ""
    for number, side in enumerate(sides):
        axis, end = divmod(number, 2)
        if side not in names:
            row = [0.0] * 6
            row[axis], row[3 + axis] = (low, high)[end][axis], (1.0, -1.0)[end]
            rows += "".join(number_text(v, 10).rjust(10) for v in row) + "\n"
    return f"$ Sides of the box\n*BOUNDARY_SPH_SYMMETRY_PLANE\n$#     vtx       vty       vtz       vhx       vhy       vhz\n{rows}" if rows else ""


def _explain(gases: list[Gas], planes: bool, gravity: float, model: Model) -> None:
    for gas in gases:
        model.choices.append((f"'{gas.part.title}': perfect gas, gamma {gas.gamma:g}, sound speed {gas.sound_speed:.4g}", "gamma of air, if not given",
                              f"*MAT_NULL {gas.part.id}, *EOS_LINEAR_POLYNOMIAL {gas.part.id}"))
    model.choices.append(("artificial viscosity 0.5 and 1.0", "shocks need the linear and the quadratic term", "*HOURGLASS Q2, Q1"))
    model.choices.append(("cubic spline, h 1.5 spacings, which varies with the density", "gas is compressed and expands by factors", "*SECTION_SPH"))
    model.choices.append(("sides of the box are planes of symmetry" if planes else "no walls",
                          "gas slips along them without a boundary layer" if planes else "no box",
                          "*BOUNDARY_SPH_SYMMETRY_PLANE" if planes else "none"))
    model.choices.append((f"gravity {gravity:g}", "none, if not given: gas weighs little", "*LOAD_BODY" if gravity else "none"))
