"""Texts of scenes with their placeholders filled."""
from __future__ import annotations

import re
from collections.abc import Mapping

from ..expressions import ExpressionFault, evaluate
from ..words import shortest
from .numbers import number_text

_WIDTH = re.compile(r"[0-9]+", re.ASCII)
_WIDEST = 160


class PlaceholderFault(Exception):
    """What is wrong with a placeholder; `line`: of it within the text, from 0."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(message)
        self.message, self.line = message, line


def _filled(inside: str, variables: Mapping[str, float]) -> str:
    text, colon, digits = inside.partition(":")
    width = int(digits) if colon and _WIDTH.fullmatch(digits) and len(digits) < 9 else 0
    if colon and not 1 <= width <= _WIDEST:
        raise ExpressionFault(f"expected a width from 1 to {_WIDEST} after ':', got '{digits}'")
    try:
        value = evaluate(text, variables)
    except ExpressionFault as fault:
        raise ExpressionFault(f"in '${{{inside}}}': {fault.message}") from None
    number = number_text(value, width)
    if not number:
        raise ExpressionFault(f"in '${{{inside}}}': {shortest(value)} does not fit {width} columns")
    return number.rjust(width)


def substitute(text: str, variables: Mapping[str, float]) -> str:
    """Replaces `${expression}` by its value and `${expression:width}` by its value right-aligned in `width` columns, so that fixed-format cards keep
    their columns. Raises PlaceholderFault."""
    out, at = [], 0
    while (begin := text.find("${", at)) >= 0:
        line = text.count("\n", 0, begin)
        end = next((k for k in range(begin, len(text)) if text[k] in "}\n"), len(text))
        if end == len(text) or text[end] != "}":
            raise PlaceholderFault("'${' without '}'", line)
        try:
            out += [text[at:begin], _filled(text[begin + 2 : end], variables)]
        except ExpressionFault as fault:
            raise PlaceholderFault(fault.message, line) from None
        at = end + 1
    return "".join([*out, text[at:]])
