"""Keyword decks in Python: read, changed and written back, with comments and order as they are; and made of meshes and cards."""
from .builder import DeckBuilder, Grid, grid, join
from .deck import Deck

__all__ = ["Deck", "DeckBuilder", "Grid", "grid", "join"]
