"""Results of a run that never was, in the files of `courant run`."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Mapping
from pathlib import Path

import h5py
import numpy as np

_TYPES = {"f": "Float32", "d": "Float64", "i": "Int32", "q": "Int64", "B": "UInt8"}


def write_history(file: Path, datasets: Mapping[str, np.ndarray]) -> None:
    """history.h5 of datasets by path, with the checksum behind it."""
    with h5py.File(file, "w") as h5:
        for path, values in datasets.items():
            h5[path] = np.asarray(values, dtype=float)
    data = file.read_bytes()
    file.write_bytes(data + b"\ncourant history file, crc32 %08x\n" % zlib.crc32(data))


def write_particles(file: Path, arrays: Mapping[str, np.ndarray]) -> None:
    """A .vtp of arrays by name, packed by zlib; "Points" are the locations."""
    blocks, heads, offset = [], {}, 0
    for name, values in arrays.items():
        data = np.ascontiguousarray(values)
        packed = zlib.compress(data.tobytes())
        block = struct.pack("<4I", 1, data.nbytes, 0, len(packed)) + packed
        components = data.shape[1] if data.ndim > 1 else 1
        heads[name] = (
            f'<DataArray type="{_TYPES[data.dtype.char.replace("l", "q")]}" Name="{name}" NumberOfComponents="{components}" '
            f'format="appended" offset="{offset}"/>\n'
        )
        blocks.append(block)
        offset += len(block)
    points = heads.pop("Points")
    head = (
        '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32" '
        f'compressor="vtkZLibDataCompressor">\n<PolyData>\n<Piece NumberOfPoints="{len(arrays["Points"])}" NumberOfVerts="0">\n'
        f"<PointData>\n{''.join(heads.values())}</PointData>\n<Points>\n{points}</Points>\n</Piece>\n</PolyData>\n"
        '<AppendedData encoding="raw">\n_'
    )
    file.write_bytes(head.encode() + b"".join(blocks) + b"\n</AppendedData>\n</VTKFile>\n")


def write_states(folder: Path, states: Mapping[float, Mapping[str, np.ndarray]]) -> None:
    """fields.pvd and its states by time."""
    (folder / "fields").mkdir(exist_ok=True)
    entries = ""
    for k, (t, arrays) in enumerate(states.items()):
        write_particles(folder / "fields" / f"p{k}.vtp", arrays)
        entries += f'<DataSet timestep="{t!r}" part="0" file="fields/p{k}.vtp"/>\n'
    (folder / "fields.pvd").write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="Collection"><Collection>\n{entries}</Collection></VTKFile>\n'
    )
