"""Polylines in the plane from files: CSV, DXF, SVG."""
from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

from .shapes import Shape, polyline

OUTLINES = (".csv", ".txt", ".dxf", ".svg")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_NAME = re.compile(r"\D*[^\W\d_]")  # a letter and no digit in front of it
_ARC = 32  # lines along a curve of an SVG or DXF


def read_outline(path: Path) -> Shape:
    """The lines of a file; of several those that are not closed are joined at their ends. Raises ValueError, OSError."""
    text = path.read_text(encoding="utf-8-sig", errors="replace")
    lines = {".dxf": _dxf, ".svg": _svg}.get(path.suffix.lower(), _csv)(text)
    lines = [(xy, closed) for xy, closed in lines if len(xy) > 1]
    if not lines:
        raise ValueError("no line of two points or more is in it")
    joined = _joined(lines)
    shapes = [polyline(xy, closed) for xy, closed in joined]
    points, faces, count = [], [], 0
    for shape in shapes:
        points.append(shape.points)
        faces.append(shape.faces + count)
        count += len(shape.points)
    return Shape(np.concatenate(points), np.concatenate(faces), 2)


def _joined(lines: list[tuple[np.ndarray, bool]]) -> list[tuple[np.ndarray, bool]]:
    """Open lines that meet at their ends become one."""
    size = max(float(np.max(np.ptp(xy, axis=0))) for xy, _ in lines)
    near = 1e-6 * size
    out = [line for line in lines if line[1]]
    rest = [xy for xy, closed in lines if not closed]
    while rest:
        chain = rest.pop(0)
        more = True
        while more:
            more = False
            for k, other in enumerate(rest):
                for piece in (other, other[::-1]):
                    if np.linalg.norm(piece[0] - chain[-1]) <= near:
                        chain = np.concatenate([chain, piece[1:]])
                    elif np.linalg.norm(piece[-1] - chain[0]) <= near:
                        chain = np.concatenate([piece[:-1], chain])
                    else:
                        continue
                    more = True
                    break
                if more:
                    rest.pop(k)
                    break
        out.append((chain, len(chain) > 3 and bool(np.linalg.norm(chain[0] - chain[-1]) <= near)))
    return out


def _is_heading(words: list[str]) -> bool:
    """Names of columns; but a first number with a wrong letter, as in 'O.0 0.5', is a mistake."""
    return bool(_NAME.match(words[0])) and not (len(words) > 1 and all(_NUMBER.fullmatch(word.replace("O", "0").replace(",", ".")) for word in words[1:]))


def two_columns(text: str) -> np.ndarray:
    """Two numbers a line, with a comma, a semicolon or blanks between, and with a semicolon also decimal commas; a third is 0, as the z of an outline. A
    heading before the first row and what follows '#' are left out. Shape (n, 2). Raises ValueError."""
    rows: list[list[float]] = []
    for number, whole in enumerate(text.splitlines(), 1):
        line = whole.split("#")[0].strip().strip(",;")
        words = re.split(r"[;\s]+" if ";" in line else r"[,\s]+", line)
        if not line or line.startswith("$"):
            continue
        try:
            values = [float(word.replace(",", ".") if ";" in line else word) for word in words]
        except ValueError:
            if not rows and _is_heading(words):
                continue
            values = []
        if not (len(values) == 2 or (len(values) == 3 and values[2] == 0)):
            raise ValueError(f"line {number}: two numbers are expected, got '{whole.strip()[:40]}'")
        rows.append(values[:2])
    return np.array(rows).reshape(-1, 2)


def _csv(text: str) -> list[tuple[np.ndarray, bool]]:
    """A line of three points or more is closed."""
    rows = two_columns(text)
    return [(rows, len(rows) > 2)]


def _bulged(vertices: list[list[float]], closed: bool) -> np.ndarray:
    """A polyline of x, y and bulge, the tangent of a quarter of the angle of the arc to the next vertex."""
    out = []
    for k, (x, y, bulge) in enumerate(vertices):
        out.append(np.array([x, y]))
        if bulge and (closed or k + 1 < len(vertices)):
            begin, end = out[-1], np.array(vertices[(k + 1) % len(vertices)][:2])
            centre = (begin + end) / 2 + np.array([begin[1] - end[1], end[0] - begin[0]]) * (1 - bulge**2) / (4 * bulge)
            n = int(np.ceil(abs(np.arctan(bulge)) * 8 * _ARC / np.pi)) + 1
            for angle in 4 * np.arctan(bulge) * np.arange(1, n) / n:
                turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
                out.append(centre + turn @ (begin - centre))
    return np.array(out)


def _dxf(text: str) -> list[tuple[np.ndarray, bool]]:
    """LINE, LWPOLYLINE, POLYLINE, CIRCLE and ARC of a DXF in text; other curves are refused."""
    raw = text.splitlines()
    pairs = [(raw[k].strip(), raw[k + 1].strip()) for k in range(0, len(raw) - 1, 2)]
    out: list[tuple[np.ndarray, bool]] = []
    vertices: list[list[float]] | None = None
    closed, section = False, ""
    at = 0
    while at < len(pairs):
        end = next((k for k in range(at + 1, len(pairs)) if pairs[k][0] == "0"), len(pairs))
        code, name = pairs[at]
        fields: dict[str, list[float]] = {}
        for key, value in pairs[at + 1 : end]:
            if _NUMBER.fullmatch(value):
                fields.setdefault(key, []).append(float(value))
        x, y, flags = fields.get("10", []), fields.get("20", []), int(fields.get("70", [0])[0])
        if code == "0" and name == "SECTION":
            section = next((value for key, value in pairs[at + 1 : end] if key == "2"), "")
        elif section == "BLOCKS":  # drawn where a block is inserted
            pass
        elif code == "0" and name in ("SPLINE", "ELLIPSE", "INSERT", "HELIX"):
            raise ValueError(f"a {name} is not read here: turn it into polylines in the program that made the file")
        elif code == "0" and name == "LINE":
            out.append((np.array([[x[0], y[0]], [fields["11"][0], fields["21"][0]]]), False))
        elif code == "0" and name == "LWPOLYLINE":
            corners: list[list[float]] = []
            for key, value in pairs[at + 1 : end]:
                if key == "10":
                    corners.append([float(value), 0.0, 0.0])
                elif key in ("20", "42") and corners:
                    corners[-1][1 if key == "20" else 2] = float(value)
            out.append((_bulged(corners, bool(flags & 1)), bool(flags & 1)))
        elif code == "0" and name == "POLYLINE":
            vertices, closed = [], bool(flags & 1)
        elif code == "0" and name == "VERTEX" and vertices is not None:
            vertices.append([x[0], y[0], fields.get("42", [0.0])[0]])
        elif code == "0" and name == "SEQEND" and vertices is not None:
            out.append((_bulged(vertices, closed), closed))
            vertices = None
        elif code == "0" and name in ("CIRCLE", "ARC"):
            begin, stop = (np.radians(fields.get(key, [0.0])[0]) for key in ("50", "51")) if name == "ARC" else (0.0, 2 * np.pi)
            stop = stop if stop > begin else stop + 2 * np.pi
            angle = np.linspace(begin, stop, max(3, int(_ARC * 2 * (stop - begin) / np.pi)))
            out.append((np.column_stack([x[0] + fields["40"][0] * np.cos(angle), y[0] + fields["40"][0] * np.sin(angle)]), name == "CIRCLE"))
        at = end
    return out


def _svg(text: str) -> list[tuple[np.ndarray, bool]]:
    """polygon, polyline, rect, line, circle, ellipse and path without transformations, y upwards as in a scene."""
    out: list[tuple[np.ndarray, bool]] = []
    for element in ElementTree.fromstring(text).iter():
        kind = element.tag.rpartition("}")[2]
        if "transform" in element.attrib:
            raise ValueError(f"the {kind} has a transformation: apply it in the program that made the file")

        def number(name: str, of: ElementTree.Element = element) -> float:
            return float((_NUMBER.findall(of.get(name, "0")) or ["0"])[0])

        if kind in ("polygon", "polyline"):
            xy = np.array([float(v) for v in _NUMBER.findall(element.get("points", ""))]).reshape(-1, 2)
            out.append((xy, kind == "polygon"))
        elif kind == "rect":
            x, y, w, h = (number(name) for name in ("x", "y", "width", "height"))
            out.append((np.array([[x, y], [x + w, y], [x + w, y + h], [x, y + h]]), True))
        elif kind == "line":
            out.append((np.array([[number("x1"), number("y1")], [number("x2"), number("y2")]]), False))
        elif kind in ("circle", "ellipse"):
            angle = 2 * np.pi * np.arange(4 * _ARC) / (4 * _ARC)
            radii = ("r", "r") if kind == "circle" else ("rx", "ry")
            out.append((np.column_stack([number("cx") + number(radii[0]) * np.cos(angle), number("cy") + number(radii[1]) * np.sin(angle)]), True))
        elif kind == "path":
            out += _path(element.get("d", ""))
    return [(xy * np.array([1.0, -1.0]), closed) for xy, closed in out]


def _path(d: str) -> list[tuple[np.ndarray, bool]]:
    """M, L, H, V, C, Q and Z of a path, large and small."""
    tokens = re.findall(r"[A-Za-z]|" + _NUMBER.pattern, d)
    out: list[tuple[np.ndarray, bool]] = []
    here, start, command, k = np.zeros(2), np.zeros(2), "", 0
    points: list[np.ndarray] = []

    def take(count: int) -> np.ndarray:
        nonlocal k
        values = np.array([float(v) for v in tokens[k : k + count]])
        k += count
        return values

    while k < len(tokens):
        if tokens[k].isalpha():
            command = tokens[k]
            k += 1
        base = here if command.islower() else np.zeros(2)
        kind = command.upper()
        if kind == "M":
            if len(points) > 1:
                out.append((np.array(points), False))
            here = start = base + take(2)
            points, command = [here], "l" if command == "m" else "L"
        elif kind == "Z":
            out.append((np.array(points), True))
            here, points = start, [start]
        elif kind in "LHV" and kind:
            value = take(2 if kind == "L" else 1)
            here = base + value if kind == "L" else np.array([base[0] + value[0], here[1]] if kind == "H" else [here[0], base[1] + value[0]])
            points.append(here)
        elif kind in ("C", "Q"):
            corners = np.vstack([here, base + take(6 if kind == "C" else 4).reshape(-1, 2)])
            t = np.linspace(0, 1, _ARC + 1)[1:, None]
            curve = corners[None, :, :].repeat(len(t), axis=0)
            while curve.shape[1] > 1:  # de Casteljau
                curve = curve[:, :-1] * (1 - t[:, :, None]) + curve[:, 1:] * t[:, :, None]
            points += list(curve[:, 0])
            here = points[-1]
        else:
            raise ValueError(f"the path's command '{command}' is not read here: turn it into lines or Bezier curves")
    if len(points) > 1:
        out.append((np.array(points), False))
    return out
