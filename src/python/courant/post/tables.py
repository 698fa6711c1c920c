"""What analyses give: numbers, series and gridded fields beside tables, and how they are written."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..files import OutputError, write_file
from ..tables import Column, Table


class Scalar(NamedTuple):
    """A single number, for results.yaml."""

    name: str
    unit: str
    value: float


class Series(NamedTuple):
    """Values over time that a spectrum or another analysis may take up. `x`: where, if it belongs to a location [L], else NaN."""

    name: str
    unit: str
    x: float
    values: np.ndarray


# In place of encoding="raw" at AppendedData: so short a tag is read by ParaView 5.11 with Debian 12's expat, too, which holds back what it parses
# (CVE-2023-52425, since 2.5.0-1+deb12u2) and lets that VTK run into the data.
_ENCODING = '<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA "raw">]>'


@dataclass
class Image:
    """Fields on points of a regular grid; x runs fastest. `n`: points along each axis; NaN in a field: no water there."""

    name: str
    t: float
    n: tuple[int, ...]
    origin: tuple[float, ...]
    spacing: tuple[float, ...]
    fields: list[Column] = field(default_factory=list)


@dataclass
class Result:
    """What an analysis gives. `tables`: the first is the main one; `words`: results that are no numbers, by name; `text`: lines for the user."""

    tables: list[Table] = field(default_factory=list)
    scalars: list[Scalar] = field(default_factory=list)
    images: list[Image] = field(default_factory=list)
    words: dict[str, str] = field(default_factory=dict)
    text: str = ""


def write_tables_h5(file: str | PathLike[str], tables: Iterable[Table]) -> None:
    """One file with a group per table and a dataset per column with the attribute `unit`. Raises OutputError."""
    import h5py

    try:  # in memory: a full disk is then a failed write, not a crash
        with h5py.File(f"{file}.in_memory", "w", driver="core", backing_store=False, libver=("earliest", "latest")) as h5:
            for table in tables:
                for column in table.columns:
                    leaf = column.name.replace("/", "|")  # a slash would make a group
                    dataset = h5.create_dataset(f"/{table.name}/{leaf}", data=column.values, dtype="<f8")
                    dataset.attrs["unit"] = np.bytes_((column.unit or "-").encode())
            h5.flush()
            data = h5.id.get_file_image()
    except (OSError, RuntimeError, ValueError) as fault:
        raise OutputError(Path(file), OSError("HDF5 failed")) from fault
    write_file(Path(file), data)


def write_vti(file: str | PathLike[str], image: Image) -> None:
    """VTK's ImageData (Float32, zlib) with the time as TimeValue. Raises OutputError."""
    blocks: list[bytes] = []

    def array(name: str, kind: str, values: np.ndarray, tuples: str = "") -> str:
        offset = sum(len(block) for block in blocks)
        blocks.append(_packed(values))
        return f'<DataArray type="{kind}" Name="{_escaped(name)}"{tuples} format="appended" offset="{offset}"/>\n'

    extent = " ".join(f"0 {n - 1}" for n in image.n)
    time = array("TimeValue", "Float64", np.array([image.t]), ' NumberOfTuples="1"')
    with np.errstate(over="ignore"):
        fields = "".join(array(one.name, "Float32", one.values.astype("<f4")) for one in image.fields)
    head = (
        f'<?xml version="1.0"?>\n{_ENCODING}\n<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian" header_type="UInt32" '
        f'compressor="vtkZLibDataCompressor">\n<ImageData WholeExtent="{extent}" Origin="{_numbers(image.origin)}" '
        f'Spacing="{_numbers(image.spacing)}">\n<FieldData>\n{time}</FieldData>\n<Piece Extent="{extent}">\n<PointData>\n{fields}'
        '</PointData>\n<CellData>\n</CellData>\n</Piece>\n</ImageData>\n<AppendedData>\n_'
    )
    write_file(Path(file), b"".join([head.encode(), *blocks, b"\n</AppendedData>\n</VTKFile>\n"]))


def _packed(values: np.ndarray, block: int = 1 << 15) -> bytes:
    """Number of blocks, bytes of a block, of the last one if it is shorter, packed bytes of each; the blocks."""
    data = values.tobytes()
    packed = [zlib.compress(data[at : at + block]) for at in range(0, len(data), block)]
    return struct.pack(f"<{3 + len(packed)}I", len(packed), block, len(data) % block, *map(len, packed)) + b"".join(packed)


def _numbers(values: tuple[float, ...]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
