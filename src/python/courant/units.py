"""Names of units: from exponents of mass, length and time to "kg/(m s2)"."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple


class Dimension(NamedTuple):
    """Exponents of mass, length and time."""

    M: int = 0
    L: int = 0
    T: int = 0


NO_DIMENSION = Dimension()
_SI_NAMES = {
    Dimension(1, -1, -2): "Pa",
    Dimension(1, 1, -2): "N",
    Dimension(1, 0, -2): "N/m",
    Dimension(1, 2, -3): "W",
    Dimension(1, 1, -3): "W/m",
    Dimension(0, 0, -1): "Hz",
}


def parse_dimension(text: str) -> Dimension:
    """From "ML/T2"; what is not understood has no dimension."""
    out = dict.fromkeys("MLT", 0)
    above, _, below = text.partition("/")
    for sign, part in ((1, above), (-1, below)):
        for letter, power in re.findall(r"([MLT])([1-9]?)", part):
            out[letter] += sign * int(power or 1)
    return Dimension(**out)


_NONE = "model units"


@dataclass(frozen=True)
class Units:
    """How the units of a deck are called; a deck itself names none. `MODEL_UNITS` where they are not known."""

    mass: str = "kg"
    length: str = "m"
    time: str = "s"

    def of(self, dimension: Dimension) -> str:
        """ "m/s", "kg/(m s2)"; "-" without a dimension. With kg, m and s: "Pa", "N", "N/m", "W" and "Hz" where they fit."""
        if dimension == NO_DIMENSION:
            return "-"
        if self.mass == _NONE:
            return _NONE
        if (self.mass, self.length, self.time) == ("kg", "m", "s") and dimension in _SI_NAMES:
            return _SI_NAMES[dimension]
        powers = list(zip((self.mass, self.length, self.time), dimension, strict=True))
        above = [unit + (str(n) if n > 1 else "") for unit, n in powers if n > 0]
        below = [unit + (str(-n) if n < -1 else "") for unit, n in powers if n < 0]
        if not below:
            return " ".join(above)
        return (" ".join(above) or "1") + "/" + (f"({' '.join(below)})" if len(below) > 1 else below[0])

    @property
    def per_time(self) -> str:
        """Of rates, which are no frequencies: "1/s"."""
        return _NONE if self.mass == _NONE else f"1/{self.time}"

    def product(self, *units: str) -> str:
        """Units side by side: "kg m2/s2 s"."""
        return _NONE if self.mass == _NONE else " ".join(units)

    def of_text(self, text: str) -> str:
        """The unit of a dimension as files name it, "ML/T2". "?" (not known), "ns" and "%" are units themselves."""
        return text if text in ("?", "ns", "%") else self.of(parse_dimension(text))


MODEL_UNITS = Units(_NONE, _NONE, _NONE)


def units_of_summary(summary: Mapping[str, Any]) -> Units:
    """The units that the numbers of the deck look like, as the run found; MODEL_UNITS where no common system fits."""
    found = summary.get("units")
    if not isinstance(found, Mapping) or not all(isinstance(found.get(key), str) for key in ("mass", "length", "time")):
        return MODEL_UNITS
    return Units(found["mass"], found["length"], found["time"])
