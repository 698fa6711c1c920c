"""A house as an STL that is as bad as wanted."""
from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

CORNERS = np.array([(0, 0, 0), (400, 0, 0), (400, 300, 0), (0, 300, 0), (0, 0, 200), (400, 0, 200), (400, 300, 200), (0, 300, 200), (0, 150, 320),
                    (400, 150, 320)], dtype=float)  # a house of 400 x 300 x 200 with a roof of 120
POLYGONS = [(0, 3, 2, 1), (0, 1, 5, 4), (2, 3, 7, 6), (1, 2, 6, 9, 5), (3, 0, 4, 8, 7), (4, 5, 9, 8), (6, 7, 8, 9)]
FACES = np.array([(f[0], f[k], f[k + 1]) for f in POLYGONS for k in range(1, len(f) - 1)])
VOLUME = 400 * 300 * 200 + 400 * 300 * 120 / 2


def stl(file: Path, faces: Sequence[Any] = FACES, turned: Sequence[int] = (), left_out: Sequence[int] = ()) -> Path:
    """A binary STL: vertices for each face, normals of 0."""
    kept = [face[::-1] if k in turned else face for k, face in enumerate(faces) if k not in left_out]
    with file.open("wb") as out:
        out.write(b"house".ljust(80) + struct.pack("<I", len(kept)))
        for face in kept:
            out.write(struct.pack("<12fH", 0, 0, 0, *CORNERS[face].ravel(), 0))
    return file
