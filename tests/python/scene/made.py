"""Decks of scenes given as text."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from courant.diagnostics import Diagnostics
from courant.scene.command import read_model, write_deck
from courant.scene.model import Model

DECKS = Path(__file__).resolve().parents[3] / "keyword_decks"

SMALL = """title: two by one, c0 = ${c0}
parameters:
  c0: 10
  dx: 1 / 2
parts:
  - id: 3
    title: water
    section: 1
    material: 2
    eos: 4
    velocity: [c0 / 5, 0]
    lattices:
      - {low: [-1, 0], high: [0, dx], spacing: dx}
  - id: 7
    section: 5
    material: 6
    merge: true
    plates:
      - {origin: [0, 0, 0], edge1: [1, 0, 0], edge2: [0, 0, dx], mesh: dx}
      - {origin: [1, 0, 0], edge1: [0, 0.6, 0], edge2: [0, 0, dx], mesh: dx}
keywords: |
  *CONTROL_TERMINATION
  $#  endtim
  ${c0 * dx:10}
"""
PATCH = """title: patch
parameters:
  dx: 0.25
  U: 2
parts:
  - id: 1
    title: water
    section: 1
    material: 1
    lattices:
      - {low: [0, 0], high: [1, 1], spacing: dx}
"""


@dataclass
class Written:
    deck: str  # "" where the scene is wrong
    messages: str  # with the folder taken off
    model: Model

    def cards(self, keyword: str) -> list[list[float]]:
        """Numbers of the lines of a keyword."""
        out, inside = [], False
        for line in self.deck.splitlines():
            inside = line == keyword if line.startswith("*") else inside
            if inside and line[0] not in "*$":
                out.append([float(word) for word in line.split()])
        return out

    def has_fields(self, *fields: str) -> bool:
        """Whether it has a line that begins with these fields of ten columns."""
        return "\n" + "".join(field.rjust(10) for field in fields) in self.deck


def written(folder: Path, scene: str, **parameters: str) -> Written:
    (folder / "scene.yaml").write_text(scene)
    deck = folder / "deck.k"
    deck.unlink(missing_ok=True)
    diagnostics = Diagnostics()
    model = read_model(str(folder / "scene.yaml"), parameters, diagnostics)
    made = diagnostics.ok and write_deck(model, "scene.yaml", str(deck), diagnostics)
    assert made == deck.exists()
    return Written(deck.read_text() if made else "", diagnostics.text().replace(f"{folder}/", ""), model)


def replaced(scene: str, old: str, new: str) -> str:
    assert old in scene
    return scene.replace(old, new, 1)
