"""Particles of a description: lattices, and their velocity."""
from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from ..diagnostics import Diagnostics
from ..key_tables import keys as keys_of_map
from ..words import shortest
from ..yaml_map import Node, is_list, is_scalar
from .model import MOST_ENTITIES, MOST_JITTER, Lattice, Part, PlaceExpression
from .node_reader import named_places
from .parameters import ParameterReader

BLOCK = keys_of_map("a block", "low vector!, high vector!, where text, jitter number")
LATTICE = keys_of_map("a lattice", "low vector!, high vector!, spacing number!, where text, jitter number")


class LatticeReader(ParameterReader):
    def __init__(self, path: str, overrides: Mapping[str, str], diagnostics: Diagnostics) -> None:
        super().__init__(path, overrides, diagnostics)
        self.dim = 0  # of all lattices
        self.entities = 0.0  # so far

    def read_velocity(self, node: Node, particles: bool, part: Part) -> None:
        entry = self.get(node, "velocity")
        components: Sequence[Node] = entry.value if entry is not None and is_list(entry) else ()
        of_places = any(is_scalar(one) and named_places(one.value) for one in components)
        if entry is not None and of_places and not particles:
            self.error(entry, "velocity: x, y, z are the place of a particle, and the part has none", "parts of shells move with one velocity")
        if entry is None or not of_places or not 2 <= len(components) <= 3:
            part.velocity = self.vector(node, "velocity")[0]
            return
        given = [self.of_place(one, "velocity") for one in components]
        none = PlaceExpression("0", self.at(entry))
        part.velocity_of_place = [(given[k] if k < len(given) else none) or none for k in range(3)]

    def read_lattice(self, node: Node, spacing: float | None = None, others: tuple[str, ...] = ()) -> Lattice:
        """`spacing`: of blocks, which have none of their own, 0 where it is wrong; `others`: keys that the entry may have besides."""
        block, before = spacing is not None, self.diagnostics.errors
        self.check_keys(node, "a block" if block else "a lattice", (*(BLOCK if block else LATTICE), *others))
        (low, dim), (high, high_dim) = self.vector(node, "low"), self.vector(node, "high")
        lattice = Lattice(dim, low, spacing if spacing is not None else self.length(node, "spacing"), (0, 0, 1), location=self.at(node))
        if (where := self.get(node, "where")) is not None:
            lattice.where = self.of_place(where, "where")
        if (jitter := self.get(node, "jitter")) is not None:
            lattice.jitter = self.number(jitter, "jitter") or 0.0
            if not 0 <= lattice.jitter < MOST_JITTER:
                self.error(jitter, f"jitter: expected a fraction of the spacing from 0 to below {MOST_JITTER}, got {shortest(lattice.jitter)}")
        if dim != high_dim and dim and high_dim:
            self.error(node, "low and high of a lattice need the same number of components")
        self.dim = self.dim or dim
        if dim != self.dim and dim:
            self.error(node, f"a lattice of {dim} dimensions beside one of {self.dim}", "give low and high as many components in all lattices of a scene")
        if self.diagnostics.errors > before or not lattice.spacing > 0:
            return lattice
        return self._with_cells(node, lattice, [high[k] - low[k] for k in range(dim)])

    def _with_cells(self, node: Node, lattice: Lattice, extents: Sequence[float]) -> Lattice:
        total, counts = 1.0, [0, 0, 1]
        for k, extent in enumerate(extents):
            cells = extent / lattice.spacing
            n = math.floor(abs(cells) + 0.5) * (1 if cells > 0 else -1) if math.isfinite(cells) else 0
            if n < 1:
                self.error(node, f"the lattice is empty: its extent along {'xyz'[k]} is {shortest(extent)}")
                return lattice
            if abs(cells - n) > 1e-6:
                self.error(node, f"the extent {shortest(extent)} along {'xyz'[k]} is {cells:.9g} spacings, not a whole number",
                           f"{' or '.join(shortest(round(lattice.low[k] + n * lattice.spacing, 9)) for n in sorted({max(1, math.floor(cells)), math.ceil(cells)}))} as the upper end")
            total *= n
            if total > MOST_ENTITIES:
                self.error(node, f"the lattice would have {total:.3g} particles or more; {MOST_ENTITIES:.0e} are the limit")
                return lattice
            counts[k] = n
        self.add_entities(node, total)
        return replace(lattice, n=(counts[0], counts[1], counts[2]))

    def add_entities(self, node: Node, more: float) -> None:
        told = self.entities > MOST_ENTITIES
        self.entities += more
        if self.entities > MOST_ENTITIES and not told:
            self.error(node, f"up to here the scene has room for {self.entities:.3g} particles and shells; {MOST_ENTITIES:.0e} are the limit")
