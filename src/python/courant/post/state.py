"""One state as analyses see it: quantities of its particles by expressions, and selections that are made once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..expressions import Formula
from ..fields import ParticleFrame, Wanted
from ..key_tables import keys as keys_of_map
from ..units import Units
from ..variables import VARIABLES, arrays_of, dimension_of, variable_of
from ..yaml_map import Node, YamlMap, is_map, is_scalar, scalar_text
from .gradients import vorticity_of_active
from .particles import ParticleSet, SprayRule, water_body


NAMES = (*VARIABLES, "vorticity")  # of expressions; vorticity: dvy/dx - dvx/dy, of the active particles

_QUANTITY = keys_of_map("quantity", "name text!, of text!, unit text")


@dataclass(frozen=True)
class Where:
    """Which particles count: those for which `of` > 0. `text` tells selections apart."""

    text: str
    of: Formula


@dataclass(frozen=True)
class Quantity:
    name: str
    unit: str
    of: Formula


def wanted_of(*formulas: Formula) -> list[Wanted]:
    """Arrays of a field file that expressions over NAMES need."""
    used = {name for formula in formulas for name in formula.used}
    return arrays_of({"vx" if name == "vorticity" else name for name in used})


EVERYWHERE = Where("1", Formula("1", NAMES))


def read_expression(keys: YamlMap, node: Node, key: str, names: tuple[str, ...] = NAMES) -> Formula:
    """An expression over `names`; faults are reported at the node."""
    if not is_scalar(node):
        keys.error(node, f"'{keys.name}.{key}' must be an expression")
        return Formula("0", names)
    out = Formula(scalar_text(node), names)
    if not out.ok:
        keys.error(node, f"'{keys.name}.{key}': {out.error}", out.hint or f"it may use {', '.join(names)}")
    return out


def read_where(keys: YamlMap) -> Where:
    """`where: 2.5 - part`; all particles if it is not there."""
    node = keys.get("where")
    return EVERYWHERE if node is None else Where(scalar_text(node), read_expression(keys, node, "where"))


def read_spray(keys: YamlMap) -> SprayRule:
    """`link` and `share`."""
    link, share = keys.positive("link", SprayRule().link), keys.number("share", SprayRule().share)
    if link > 2:
        hint = "particles further apart than 2 h do not know each other"
        keys.error(keys.get("link") or keys.node, f"'{keys.name}.link' must be at most 2, got {link:g}", hint)
    if not 0 <= share <= 1:
        keys.error(keys.get("share") or keys.node, f"'{keys.name}.share' must be 0 to 1, got {share:g}", "0 lets every drop count")
    return SprayRule(link, share)


def read_quantities(keys: YamlMap, units: Units) -> list[Quantity]:
    """`of: [vx, {name: q, of: 0.5 * rho * speed^2, unit: Pa}]`."""
    out = [_read_quantity(keys, node, units) for node in keys.list("of", required=True)]
    if not out and (node := keys.get("of")) is not None and not is_map(node) and not is_scalar(node):
        keys.error(node, f"'{keys.name}.of' is empty", "for example [vx, vy, p]")
    return out


def _read_quantity(keys: YamlMap, node: Node, units: Units) -> Quantity:
    """Single variables know their unit, other expressions have "?" unless the recipe tells."""

    def unit_of(text: str) -> str:
        return units.per_time if text == "vorticity" else units.of_text(dimension_of(text) or "?")

    if not is_map(node):
        name, unit, of = scalar_text(node), unit_of(scalar_text(node)), read_expression(keys, node, "of")
    else:
        entry = keys.element(node, "of")
        entry.allow(*_QUANTITY)
        unit = entry.text("unit", unit_of(entry.text("of", required=True)))
        name = entry.text("name", required=True)
        inner = entry.get("of")
        of = Formula("0", NAMES) if inner is None else read_expression(entry, inner, "of")
    return Quantity("".join(name.split()).replace(",", ";"), unit, of)


class State:
    """One state, with what analyses have in common made once. `t`: [T]; `slack`: a quarter of the spacing of states [T]."""

    def __init__(self, frame: ParticleFrame, slack: float) -> None:
        self.frame, self.slack = frame, slack
        self._selections: dict[str, ParticleSet] = {}
        self._waters: dict[tuple[SprayRule, str], ParticleSet] = {}
        self._vorticity: np.ndarray | None = None

    @property
    def t(self) -> float:
        return self.frame.t

    def __getitem__(self, name: str) -> np.ndarray:
        """Values of a variable ("vx", "p", ...) for all particles of the file, shape (n,). Raises KeyError where it was not asked for."""
        if self._variable(name) is None:
            raise KeyError(name)
        return np.broadcast_to(np.asarray(self._variable(name), dtype=float), (len(self.frame),))

    def evaluate(self, of: Formula) -> np.ndarray:
        """Values of an expression for all particles of the file, shape (n,); NaN where it has none."""
        return of.over({name: self._variable(name) for name in of.used}, len(self.frame))

    def _variable(self, name: str) -> np.ndarray | float | None:
        if name != "vorticity":
            return variable_of(self.frame, name)
        if self._vorticity is None and "velocity" in self.frame.arrays:
            frame = self.frame
            found = vorticity_of_active(frame.x, frame.V, frame.h, frame.arrays["velocity"].astype(float), self.active)
            self._vorticity = found if found.ndim == 1 else found[:, 2]
        return self._vorticity

    @property
    def active(self) -> np.ndarray:
        """Which particles are inside the box and not switched off, shape (n,) of bool."""
        active = self.frame.arrays.get("active")
        return np.ones(len(self.frame), dtype=bool) if active is None else active > 0

    def selection(self, where: Where = EVERYWHERE) -> ParticleSet:
        """The active particles that count."""
        if where.text not in self._selections:
            self._selections[where.text] = ParticleSet.of(self.frame, (self.evaluate(where.of) > 0) & self.active)
        return self._selections[where.text]

    def water(self, where: Where = EVERYWHERE, rule: SprayRule = SprayRule()) -> ParticleSet:  # noqa: B008  frozen
        """Those of a selection that are no spray."""
        key = (rule, where.text)
        if key not in self._waters:
            self._waters[key] = water_body(self.selection(where), rule)
        return self._waters[key]
