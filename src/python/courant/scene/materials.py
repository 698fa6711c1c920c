"""Materials of the deformable parts of a scene: by a name, by numbers, or a name with some numbers of its own."""
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from ..key_tables import keys as keys_of_map
from ..words import did_you_mean
from ..yaml_map import Node, is_map
from .placeholders import substitute

if TYPE_CHECKING:
    from .basin import Basin
    from .basin_reader import BasinReader


@dataclass
class Material:
    density: float  # [M/L3]
    young: float  # [M/LT2]
    poisson: float = 0.3
    yield_stress: float = 0.0  # 0: elastic [M/LT2]
    tangent: float = 0.0  # slope of stress over strain beyond the yield stress [M/LT2]

    @property
    def sound_speed(self) -> float:
        """Of pressure waves [L/T]."""
        return math.sqrt(self.young * (1 - self.poisson) / (self.density * (1 + self.poisson) * (1 - 2 * self.poisson)))

    @property
    def bar_speed(self) -> float:
        """Of waves along a bar [L/T]."""
        return math.sqrt(self.young / self.density)


# SI units; usual values for engineering, e.g. Ashby, Materials Selection in Mechanical Design, 4th edition, appendix A
NAMED = {
    "steel": Material(7850, 210e9, 0.3), "aluminium": Material(2700, 70e9, 0.33), "copper": Material(8930, 120e9, 0.34),
    "concrete": Material(2400, 30e9, 0.2), "glass": Material(2500, 70e9, 0.22), "wood": Material(600, 11e9, 0.3),
    "ice": Material(917, 9e9, 0.33), "acrylic": Material(1190, 3.2e9, 0.37), "polyethylene": Material(950, 0.9e9, 0.42),
    "rubber": Material(1100, 5e6, 0.47)}
_KEYS = keys_of_map("a material", "like text, density number, young number, poisson number, yield number, tangent number")
_EXAMPLE = "material: steel, or material: {density: 2500, young: 1.0e6, poisson: 0.3}"

_ELASTIC = """\
*MAT_ELASTIC
$#     mid        ro         e        pr
${mid:10}${ro:10}${e:10}${pr:10}
"""

_PLASTIC = """\
*MAT_PLASTIC_KINEMATIC
$#     mid        ro         e        pr      sigy      etan      beta
${mid:10}${ro:10}${e:10}${pr:10}${sigy:10}${etan:10}       1.0
"""


def read_material(reader: BasinReader, node: Node | None, owner: Node, basin: Basin) -> Material | None:
    """Of an entry `owner`; None, with a message, where there is none."""
    if node is None:
        reader.error(owner, "'material' is missing", _EXAMPLE)
        return None
    if not is_map(node):
        return _named(reader, node, basin)
    reader.check_keys(node, "a material", _KEYS)
    before = reader.diagnostics.errors
    like = reader.get(node, "like")
    known = _named(reader, like, basin) if like is not None else Material(0, 0)
    if known is None:
        return None
    given = {}
    for key, name in (("density", "density"), ("young", "young"), ("yield", "yield_stress"), ("tangent", "tangent")):
        if reader.get(node, key) is not None:
            given[name] = reader.length(node, key, "number")
        elif like is None and key in ("density", "young"):
            reader.error(node, f"a material: '{key}' is missing", _EXAMPLE)
    if (poisson := reader.get(node, "poisson")) is not None:
        given["poisson"] = reader.number(poisson, "poisson") or 0.0
        if not 0 <= given["poisson"] < 0.5:
            reader.error(poisson, f"poisson: expected a number from 0 to below 0.5, got {given['poisson']:g}", "rubber: 0.47 to 0.499")
    if (tangent := reader.get(node, "tangent")) is not None and "yield_stress" not in given:
        reader.error(tangent, "tangent: goes with 'yield'")
    return replace(known, **given) if reader.diagnostics.errors == before else None


def _named(reader: BasinReader, node: Node, basin: Basin) -> Material | None:
    name = reader.text(node)
    if name not in NAMED:
        reader.error(node, f"material: '{name}' is not known", f"{did_you_mean(name, NAMED)}known: {', '.join(NAMED)}; {_EXAMPLE}")
        return None
    if basin.foreign_units:
        reader.error(node, f"material: numbers of '{name}' are those of SI units, and {basin.foreign_units}",
                     "give density and young in the units of the scene")
        return None
    return NAMED[name]


def material_cards(number: int, material: Material) -> str:
    values = {"mid": float(number), "ro": material.density, "e": material.young, "pr": material.poisson, "sigy": material.yield_stress,
              "etan": material.tangent}
    return substitute(_PLASTIC if material.yield_stress > 0 else _ELASTIC, values)


def material_text(material: Material) -> str:
    plastic = f", yields at {material.yield_stress:g}" if material.yield_stress else ""
    return f"density {material.density:g}, Young's modulus {material.young:g}, Poisson's ratio {material.poisson:g}{plastic}"
