"""Names that expressions of suites may use besides parameters."""
from __future__ import annotations

import re
from dataclasses import dataclass, field

# What limits of stability cases may name besides observations.
OUTCOMES = ["residual", "error", "ratio", "leaked", "penetration", "steps"]

# So fixed a form leaves a division a division: `global/total/2`.
_HISTORY = re.compile(r"(?<!\w)(global|(?:parts|contacts|rigid_bodies|rigid_walls|particles|nodes|solids|shells|beams|springs|sections|joints|welds|tracers)/\d+)/\w+(?:\.([xyz])(?!\w))?", re.ASCII)


@dataclass(frozen=True)
class HistoryName:
    """A dataset of history.h5 as an expression names it: "contacts/1/force.y"."""

    text: str
    path: str  # "/contacts/1/force"
    component: int | None  # 0, 1, 2 of a vector; None: a scalar


@dataclass
class HistoryText:
    """An expression with the names of datasets, which hold slashes, replaced by words."""

    text: str = ""
    names: list[HistoryName] = field(default_factory=list)  # each once

    @property
    def words(self) -> list[str]:
        """In `text`, in the order of `names`."""
        return [f"history_dataset_{k}" for k in range(len(self.names))]


def find_history_names(text: str) -> HistoryText:
    out = HistoryText()

    def word(found: re.Match[str]) -> str:
        path = found[0][:-2] if found[2] else found[0]
        name = HistoryName(found[0], "/" + path, "xyz".index(found[2]) if found[2] else None)
        if name not in out.names:
            out.names.append(name)
        return f"history_dataset_{out.names.index(name)}"

    out.text = _HISTORY.sub(word, text)
    return out
