"""Text of numbers in the columns of a deck: one number, or whole arrays of them at once."""
from __future__ import annotations

import numpy as np

MOST, LEAST = 13, 4  # digits; with 13 the round-off of the expressions that made a number stays out of sight
_BLANK, _MINUS, _POINT, _ZERO = ord(" "), ord("-"), ord("."), ord("0")
_TRIPLES = np.array([[_ZERO + k // 100, _ZERO + k // 10 % 10, _ZERO + k % 10] for k in range(1000)], dtype=np.uint8)
_POWERS = np.array([10**k for k in range(17)], dtype=np.int64)
_LOWEST, _HIGHEST = -3, 12  # decimal exponents between which plain notation is never longer than the scientific one
_BLOCK = 1 << 17  # values at once: their arrays fit the cache


def _short_exponent(text: str) -> str:
    """1e+05 -> 1e5, 1e-05 -> 1e-5: two columns of ten are worth having."""
    mantissa, mark, exponent = text.partition("e")
    return text if not mark else mantissa + ("e-" if exponent[0] == "-" else "e") + exponent.lstrip("+-0")


def _plain(value: float, digits: int) -> str:
    return _short_exponent(f"{value:.{digits}g}")


def _scientific(value: float, digits: int) -> str:
    mantissa, _, exponent = f"{value:.{digits - 1}e}".partition("e")
    return _short_exponent((mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa) + "e" + exponent)


def number_text(value: float, width: int = 0) -> str:
    """The shortest text of a number that fits `width` columns, with a leading blank where that costs no digits; "" if fewer than four correct digits
    would remain. `width` 0: no limit."""
    value = value if value else 0.0  # no "-0"
    if width == 0:
        return _plain(value, MOST)
    for digits in range(MOST, LEAST - 1, -1):
        longest = width if digits == MOST else width - 1
        for form in (_plain, _scientific):
            text = form(value, digits)
            if len(text) <= longest:
                return text
    return ""


def whole_numbers(values: np.ndarray, width: int) -> np.ndarray:
    """Whole numbers >= 0 of shape (n,), right-aligned: bytes of shape (n, width)."""
    rest = np.asarray(values, dtype=np.int64)
    out = np.full((len(rest), width), _BLANK, dtype=np.uint8)
    most = len(str(int(rest.max()))) if len(rest) else 1
    smallest = len(str(int(rest.min()))) if len(rest) else 1
    digits = _digits(rest, most)
    out[:, width - most :] = digits
    for column in range(most - smallest):  # leading zeros
        out[rest < _POWERS[most - 1 - column], width - most + column] = _BLANK
    return out


def _digits(values: np.ndarray, count: int) -> np.ndarray:
    """The last `count` digits of whole numbers >= 0: bytes of shape (n, count)."""
    chunks = -(-count // 3)
    out = np.empty((len(values), 3 * chunks), dtype=np.uint8)
    rest = values
    for k in range(chunks - 1, -1, -1):
        above = rest // 1000 if k else np.zeros_like(rest)
        out[:, 3 * k : 3 * k + 3] = _TRIPLES[rest - above * 1000]
        rest = above
    return out[:, 3 * chunks - count :]


def numbers(values: np.ndarray, width: int, total: int = 0) -> np.ndarray:
    """`number_text` of each of the values (n,) for `width` >= 15 columns, right-aligned in `total` of them: bytes of shape (n, total)."""
    total = total or width
    out = np.full((len(values), total), _BLANK, dtype=np.uint8)
    for begin in range(0, len(values), _BLOCK):
        _fill(np.asarray(values[begin : begin + _BLOCK], dtype=float), width, out[begin : begin + _BLOCK])
    return out


def _fill(values: np.ndarray, width: int, out: np.ndarray) -> None:
    size = np.abs(values)
    out[values == 0, -1] = _ZERO
    exponent = np.searchsorted(10.0 ** np.arange(_LOWEST, _HIGHEST + 2), size, side="right") + _LOWEST - 1
    usual = (exponent >= _LOWEST) & (exponent <= _HIGHEST)
    slow = [np.flatnonzero(~usual & (values != 0))]
    left = np.flatnonzero(usual)
    for digits in range(MOST, LEAST - 1, -1):
        if not len(left):
            break
        e, negative = exponent[left], values[left] < 0
        power = digits - 1 - e
        scaled = np.where(power >= 0, size[left] * 10.0 ** np.maximum(power, 0), size[left] / 10.0 ** np.maximum(-power, 0))
        whole = np.rint(scaled).astype(np.int64)
        # the product is off by a thousandth at most: near a half, and where rounding gives one more digit, the text is made one by one
        doubtful = (np.abs(np.abs(scaled - whole) - 0.5) < 4e-3) | (whole >= _POWERS[digits])
        slow.append(left[doubtful])
        kept, length = _lengths(whole, digits, e)
        fits = ~doubtful & (length + negative <= (width if digits == MOST else width - 1))
        _write(whole[fits] // _POWERS[digits - kept[fits]], kept[fits], e[fits], negative[fits], left[fits], out)
        left = left[~doubtful & ~fits]
    for row in np.concatenate([*slow, left]):
        text = number_text(float(values[row]), width).encode()
        out[row, out.shape[1] - len(text) :] = np.frombuffer(text, dtype=np.uint8)


def _lengths(whole: np.ndarray, digits: int, exponent: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Digits without zeros at the end, and the length of the plain text without its sign."""
    kept = np.full(len(whole), digits)
    rows, rest = np.arange(len(whole)), whole
    while len(rows):
        above = rest // 10
        more = above * 10 == rest
        rows, rest = rows[more], above[more]
        kept[rows] -= 1
    return kept, np.where(exponent < 0, kept - exponent + 1, np.where(kept <= exponent + 1, exponent + 1, kept + 1))


def _write(whole: np.ndarray, kept: np.ndarray, exponent: np.ndarray, negative: np.ndarray, rows: np.ndarray, out: np.ndarray) -> None:
    """The texts of numbers of one form, signs, digits, exponents, at a time."""
    form = (negative * 32 + (exponent - _LOWEST)) * 16 + kept
    order = np.argsort(form, kind="stable")
    bounds = np.flatnonzero(np.diff(form[order], prepend=-1, append=-1))
    for begin, end in zip(bounds[:-1], bounds[1:]):
        some = order[begin:end]
        n, e = int(kept[some[0]]), int(exponent[some[0]])
        before = max(e + 1, 0)  # digits before the point
        shown = max(n, before) if e >= 0 else n
        text = _digits(whole[some] * _POWERS[shown - n], shown)
        if shown > before:
            zeros = max(-e - 1, 0)
            lead = text[:, :before] if before else np.full((len(some), 1), _ZERO, dtype=np.uint8)
            point = np.full((len(some), 1 + zeros), _ZERO, dtype=np.uint8)
            point[:, 0] = _POINT
            text = np.hstack([lead, point, text[:, before:]])
        if negative[some[0]]:
            text = np.hstack([np.full((len(some), 1), _MINUS, dtype=np.uint8), text])
        out[rows[some], out.shape[1] - text.shape[1] :] = text
