"""Particles with known fields, and files of runs that hold them."""

from __future__ import annotations

import lzma
import struct
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path

import h5py
import numpy as np
from courant.fields import ParticleFrame

DX = 0.005


def scatter(n: int) -> np.ndarray:
    """Numbers in [-0.5, 0.5) that look random, always the same; (n,)."""
    s = np.sin(12.9898 * np.arange(1, n + 1)) * 43758.5453
    return s - np.floor(s) - 0.5


def lattice(x0: float = 0.0, x1: float = 1.0, y0: float = 0.0, y1: float = 0.1, jitter: float = 0.0, dx: float = DX) -> np.ndarray:
    """Places in [x0, x1] x [y0, y1], each moved by up to jitter spacings along each axis; (n, 3)."""
    nx, ny = round((x1 - x0) / dx), round((y1 - y0) / dx)
    i, k = (one.ravel() for one in np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"))
    moved = jitter * scatter(2 * nx * ny)
    return np.column_stack([x0 + (i + 0.5 + moved[::2]) * dx, y0 + (k + 0.5 + moved[1::2]) * dx, np.zeros(nx * ny)])


def block(nx: int, ny: int, nz: int, dx: float = DX) -> np.ndarray:
    """Places of a lattice in space; (n, 3)."""
    return np.stack(np.meshgrid(*((np.arange(n) + 0.5) * dx for n in (nx, ny, nz)), indexing="ij"), -1).reshape(-1, 3)


def frame(*places: np.ndarray, t: float = 0.0, dim: int = 2, dx: float | np.ndarray = DX, v: Callable | None = None) -> ParticleFrame:
    """A state of water at these locations; v: (x, y) -> velocity (n,) or (n, 3)."""
    x = np.concatenate(places) if places else np.empty((0, 3))
    n = len(x)
    size = np.broadcast_to(np.asarray(dx, dtype=float), (n,))
    velocity = np.zeros((n, 3))
    if v is not None:
        given = np.asarray(v(x[:, 0], x[:, 1]))
        velocity[:, : 3 if given.ndim == 2 else 1] = given if given.ndim == 2 else given[:, None]
    V = size**dim
    arrays = {"velocity": velocity, "pressure": np.zeros(n), "density": np.full(n, 1000.0), "mass": 1000 * V, "active": np.ones(n)}
    arrays |= {"part": np.ones(n), "id": np.arange(1.0, n + 1), "internal_energy": np.zeros(n)}
    return ParticleFrame(t, dim, x, V, 1.2 * size, arrays)


_TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
_UNITS = {"velocity": "L/T", "pressure": "M/LT2", "density": "M/L3", "mass": "M", "smoothing_length": "L"}


def packed(values: np.ndarray, packing: str, size: int = 32768) -> bytes:
    """The data of an array as VTK lays them: raw, or blocks packed by zlib or xz."""
    data = values.tobytes()
    if packing == "none":
        return struct.pack("<I", len(data)) + data
    pack = zlib.compress if packing == "zlib" else lambda part: lzma.compress(part, lzma.FORMAT_XZ)
    parts = [pack(data[at : at + size]) for at in range(0, len(data), size)]
    return struct.pack(f"<{3 + len(parts)}I", len(parts), size, len(data) % size, *map(len, parts)) + b"".join(parts)


def write_fields(path: Path, sections: Sequence[tuple[str, dict[str, np.ndarray]]], points: int, cells: int = 0, packing: str = "zlib") -> None:
    """A .vtp or .vtu file as `courant run` lays it out. `sections`: ("PointData", arrays by name), ..."""
    data, body = b"", ""
    for section, arrays in sections:
        body += f"<{section}>\n"
        for name, values in arrays.items():
            kind, components = _TYPES[values.dtype.str[1:]], values.shape[1] if values.ndim > 1 else 1
            unit = f'<InformationKey name="UNITS_LABEL" location="vtkDataArray">{_UNITS[name]}</InformationKey>\n' if name in _UNITS else ""
            body += f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{len(data)}"'
            body += f">\n{unit}</DataArray>\n" if unit else "/>\n"
            data += packed(values, packing)
        body += f"</{section}>\n"
    kind = "PolyData" if path.suffix == ".vtp" else "UnstructuredGrid"
    count = f'NumberOfVerts="{points}" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="0"' if cells == 0 else f'NumberOfCells="{cells}"'
    compressor = {"none": "", "zlib": ' compressor="vtkZLibDataCompressor"', "xz": ' compressor="vtkLZMADataCompressor"'}[packing]
    head = (
        '<?xml version="1.0"?>\n<!DOCTYPE VTKFile [<!ATTLIST AppendedData encoding CDATA "raw">]>\n'
        f'<VTKFile type="{kind}" version="0.1" byte_order="LittleEndian" header_type="UInt32"{compressor}>\n<{kind}>\n'
        f'<Piece NumberOfPoints="{points}" {count}>\n{body}</Piece>\n</{kind}>\n<AppendedData>\n_'
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(head.encode() + data + b"\n</AppendedData>\n</VTKFile>\n")


def write_particles(path: Path, state: ParticleFrame, packing: str = "zlib", real: str = "<f4") -> None:
    arrays = {name: state.arrays[name].astype(real) for name in ("velocity", "mass", "density", "pressure", "internal_energy")}
    arrays["smoothing_length"] = state.h.astype(real)
    arrays |= {"id": state.arrays["id"].astype("<i8"), "part": state.arrays["part"].astype("<i8"), "active": state.arrays["active"].astype("<u1")}
    n = np.arange(len(state), dtype="<i4")
    sections = [("PointData", arrays), ("Points", {"Points": state.x.astype(real)}), ("Verts", {"connectivity": n, "offsets": n + 1})]
    write_fields(path, sections, len(state), packing=packing)


def write_shells(path: Path, x: np.ndarray, corners: Sequence[Sequence[int]]) -> None:
    connectivity = np.array([k for one in corners for k in one], dtype="<i8")
    cells = {"connectivity": connectivity, "offsets": np.cumsum([len(one) for one in corners]).astype("<i8")}
    cells["types"] = np.full(len(corners), 9, dtype="<u1")
    write_fields(path, [("PointData", {}), ("Points", {"Points": x.astype("<f4")}), ("Cells", cells)], len(x), len(corners))


def write_run(folder: Path, states: Sequence[ParticleFrame], title: str = "", shells: bool = False, packing: str = "zlib") -> None:
    """fields.pvd with its files, and summary.yaml."""
    entries = ""
    for k, state in enumerate(states):
        name = f"fields/particles_{k:04d}.vtp"
        write_particles(folder / name, state, packing)
        entries += f'<DataSet timestep="{state.t:.9g}" group="" part="0" name="particles" file="{name}"/>\n'
        if shells:
            x = np.array([[0, 0, -1], [0.5, 0, -1], [0.5, 0, 1], [0, 0, 1], [1.0, 0, -1], [1.0, 0, 1]])
            write_shells(folder / f"fields/shells_{k:04d}.vtu", x, [[0, 1, 2, 3], [1, 4, 5, 2]])
            entries += f'<DataSet timestep="{state.t:.9g}" group="" part="1" name="shells" file="fields/shells_{k:04d}.vtu"/>\n'
    (folder / "fields.pvd").write_text(
        f'<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n{entries}</Collection>\n</VTKFile>\n'
    )
    (folder / "summary.yaml").write_text(f"title: {title or chr(39) * 2}\nunits: {{mass: kg, length: m, time: s}}\n")


def write_history(folder: Path, datasets: dict[str, tuple[np.ndarray, str]]) -> None:
    """history.h5 with its checksum; datasets: values and dimension by path."""
    path = folder / "history.h5"
    with h5py.File(path, "w") as h5:
        for name, (values, dimension) in datasets.items():
            h5.create_dataset(name, data=values).attrs["dimension"] = np.bytes_(dimension.encode())
    data = path.read_bytes()
    path.write_bytes(data + b"\ncourant history file, crc32 %08x\n" % zlib.crc32(data))
