"""The call `courant report DIR`: one self-contained HTML page on a run, or on two that are compared."""

from .command import main
from .page import page_of

__all__ = ["main", "page_of"]
