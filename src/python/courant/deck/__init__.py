"""Keyword decks in Python: read, changed and written back, with comments and order as they are."""
from .deck import Deck

__all__ = ["Deck"]
