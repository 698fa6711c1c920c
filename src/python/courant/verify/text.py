"""How tables and reports write numbers and words."""
from __future__ import annotations

import html
import math
import re

_BLANK = "\u00a0"  # one that does not break
_LONGEST_STEM = 80


def _short_exponent(text: str) -> str:
    """ "1e-05" -> "1e-5", "1.20e+06" -> "1.2e6"."""
    mantissa, e, exponent = text.partition("e")
    if not e:
        return text
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa}e{int(exponent)}"


def number(value: float, digits: int = 4) -> str:
    """With so many significant digits; "not a number", "infinite"."""
    if math.isnan(value):
        return "not a number"
    if math.isinf(value):
        return "infinite" if value > 0 else "-infinite"
    size = abs(value)
    if size < 1e6 and (value == round(value) or size >= 10.0**digits):
        return f"{value + 0.0:.0f}"
    if size != 0 and size < 1e-3:
        return _short_exponent(f"{value:.{digits - 1}e}")
    return _short_exponent(f"{value:.{digits}g}")


def percent(fraction: float, digits: int = 2) -> str:
    """With a blank that does not break: 0.012 -> "1.2 %"; very small and large ones: "1.2e-7"."""
    size = abs(fraction)
    if not math.isfinite(fraction):
        return number(fraction)
    if fraction == 0:
        return f"0{_BLANK}%"
    if size < 1e-6 or size >= 100:
        return number(fraction, 2)
    value = 100 * fraction
    return f"{value:.0f}{_BLANK}%" if size >= 1 else f"{value:.{digits + 1 if size >= 0.1 else digits}g}{_BLANK}%"


def seconds(value: float) -> str:
    """ "3.1 s", "12 min 4 s"."""
    if not math.isfinite(value):
        return number(value)
    if value < 9.95:
        return _short_exponent(f"{value:.2g}") + f"{_BLANK}s"
    if value < 119.5:
        return f"{value:.0f}{_BLANK}s"
    whole = int(value + 0.5)
    parts = (whole // 60, "min", whole % 60, "s") if whole < 7200 else (whole // 3600, "h", whole % 3600 // 60, "min")
    return _BLANK.join(map(str, parts))


def integer(value: int) -> str:
    """Groups of three digits."""
    return f"{value:,}".replace(",", _BLANK)


def megabytes(count: int) -> str:
    """ "12.3", without unit."""
    value = count / 1e6
    return f"{value:.1f}" if value < 99.95 else f"{value:.0f}"


def file_stem(text: str) -> str:
    """A name for a file: letters, digits and '-'; never empty."""
    return re.sub("[^A-Za-z0-9]+", "-", text).strip("-")[:_LONGEST_STEM] or "unnamed"


def shorten(text: str, most: int) -> str:
    """The text, or its first characters and an ellipsis if it has more than `most`."""
    return text if len(text) <= most else text[:most - 1] + "…"


def paragraphs(text: str) -> list[str]:
    """Parts between blank lines."""
    return [part.strip("\n") for part in re.split(r"\n(?:[ \t\r]*\n)+", text) if part.strip()]


def links(text: str) -> list[tuple[str, str]]:
    """Pieces of a text with links to pages and locations of pages, `[words](page.md#place)`: words, and the target; blank where there is none."""
    pieces = re.split(r"\[([^\[\]\n]+)\]\(([\w./-]*(?:#[\w-]+)?)\)", text)
    found = [(words, "") for words in pieces[::3]]
    return [one for k, words in enumerate(found) for one in (words, (pieces[3 * k + 1], pieces[3 * k + 2]) if 3 * k + 1 < len(pieces) else ("", "")) if one[0]]


def plain(text: str) -> str:
    """Without control characters and what XML does not allow: one of them would make an SVG file unreadable."""
    return re.sub("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]", "?", text)


def escape_xml(text: str) -> str:
    """Text that may be between the tags and in the attributes of HTML and SVG."""
    return html.escape(plain(text))


def escape_markdown(text: str) -> str:
    """Text without meaning to Markdown (GitHub's dialect), on one line, also within tables."""
    text = re.sub(r"[\n\t\r]", " ", plain(text))
    text = re.sub(r"[\\`*_{}\[\]|#~$]", r"\\\g<0>", text)
    text = html.escape(text, quote=False)
    return "\\" + text if text[:1] in ("-", "+") else text
