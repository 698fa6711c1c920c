"""Field files of a run: VTK's XML with appended data, raw (.vtp) or base64 (.vtu), as `courant run` writes it.

Nothing in a file is trusted: sizes are held against the length of the file before memory is asked for, and each block of data
against its own size. No vtk module is needed.
"""

from __future__ import annotations

import binascii
import os
import re
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np

from .diagnostics import Diagnostics

_LONGEST_HEAD = _LARGEST_BLOCK = 1 << 20  # bytes
_MOST_POINTS = 2**31 - 1
_MOST_COMPONENTS = 64
_DATA_MARK = re.compile(rb'<AppendedData(?: encoding="(raw|base64)")?>\n_')  # the encoding may be in a document type
_ENCODING = re.compile(rb'<!ATTLIST AppendedData encoding CDATA "(raw|base64)">')
_LAST_LINE = b"</VTKFile>\n"  # a file that was cut off has none
_TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "<u1", "Int8": "<i1"}
_PACKINGS = {"": "none", "vtkZLibDataCompressor": "zlib", "vtkLZMADataCompressor": "xz"}


class FieldFault(Exception):
    """A file that is no field file of Courant, or a damaged one."""


class FieldArray(NamedTuple):
    """Where an array lies in a file. `dimension`: of its values as the file names it, "L/T"; "?" where it does not."""

    dtype: str
    components: int
    offset: int
    dimension: str


class FieldFile:
    """A .vtp or .vtu file. Raises FieldFault where it cannot be read or is no field file of Courant.

    `points`, `cells`: how many there are. `arrays`: FieldArray by (section, name), as ("PointData", "velocity").
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.points = self.cells = 0
        self.arrays: dict[tuple[str, str], FieldArray] = {}
        self._packing = "none"
        try:
            with open(self.path, "rb") as stream:
                self._size = os.fstat(stream.fileno()).st_size
                head = stream.read(_LONGEST_HEAD)
                stream.seek(max(0, self._size - len(_LAST_LINE)))
                whole = stream.read(len(_LAST_LINE)) == _LAST_LINE
        except OSError as fault:
            raise FieldFault(f"cannot be read: {fault.strerror}") from fault
        mark = _DATA_MARK.search(head)
        if not whole or mark is None:
            raise FieldFault("it is cut off, or no field file")
        self._data = mark.end()
        encoding = _ENCODING.search(head, 0, mark.start())
        self._is_text = (mark[1] or (encoding[1] if encoding else b"raw")) == b"base64"
        self._bytes = head if len(head) == self._size else None  # small ones are in memory now
        self._read_head(head[: mark.start()])

    def has(self, section: str, name: str) -> bool:
        return (section, name) in self.arrays

    def components(self, section: str, name: str) -> int:
        """Components of an array, 0 where there is none."""
        array = self.arrays.get((section, name))
        return array.components if array else 0

    def names(self, section: str = "PointData") -> list[str]:
        return [name for where, name in self.arrays if where == section]

    def values(self, section: str, name: str, tuples: int | None = None) -> np.ndarray:
        """An array as it lies in the file; shape (tuples, components), or (tuples,) of one component.

        `tuples`: points of the file if not given. Raises KeyError where there is none, FieldFault where its data are damaged.
        """
        array = self.arrays[section, name]
        count = (self.points if tuples is None else tuples) * array.components
        values = self._values(array, count)
        if len(values) != count:
            raise FieldFault(f"the data of '{name}' are damaged")
        return values.reshape(-1, array.components) if array.components > 1 else values

    def integers(self, section: str, name: str, most: int) -> np.ndarray:
        """All values of an array of whole numbers that tells its own length, as "connectivity"; at most so many."""
        array = self.arrays.get((section, name))
        if array is None or array.components != 1 or array.dtype not in ("<i4", "<i8"):
            raise FieldFault(f"'{name}' is no array of whole numbers")
        return self._values(array, most).astype(np.int64)

    def corners(self) -> tuple[np.ndarray, np.ndarray]:
        """Of all cells: indices of their points one after the other, and where those of each cell end, (cells,)."""
        corners = self.integers("Cells", "connectivity", 32 * self.cells)
        ends = self.integers("Cells", "offsets", self.cells)
        if len(ends) != self.cells or (np.diff(ends, prepend=0) < 0).any() or (self.cells and ends[-1] > len(corners)):
            raise FieldFault("its cells are damaged")
        corners = corners[: ends[-1] if self.cells else 0]
        if (corners < 0).any() or (corners >= self.points).any():
            raise FieldFault("its cells are damaged")
        return corners, ends

    def _read_head(self, head: bytes) -> None:
        """All before the data is XML once the file's tag is closed."""
        try:
            root = ElementTree.fromstring(head + b"</VTKFile>")
        except (ElementTree.ParseError, ValueError) as fault:  # ValueError: an encoding that is unknown
            raise FieldFault("its head is damaged") from fault
        self._take_file(root.attrib)
        for section in root.iter():
            if section.tag == "Piece":
                self.points = _whole(section.get("NumberOfPoints"), _MOST_POINTS)
                self.cells = _whole(section.get("NumberOfCells", "0"), _MOST_POINTS)
            for entry in section.iterfind("DataArray"):
                dimension = entry.findtext("InformationKey[@name='UNITS_LABEL']", "").strip()
                self.arrays[section.tag, entry.get("Name", "")] = self._array(entry.attrib, dimension or "?")
        if self.points == 0 and not self.arrays:
            raise FieldFault("it has neither points nor arrays")

    def _take_file(self, attributes: dict[str, str]) -> None:
        packing = _PACKINGS.get(attributes.get("compressor", ""))
        if attributes.get("byte_order") != "LittleEndian" or attributes.get("header_type") != "UInt32" or packing is None:
            raise FieldFault("it is packed in another way")
        self._packing = packing

    def _array(self, attributes: dict[str, str], dimension: str) -> FieldArray:
        components = _whole(attributes.get("NumberOfComponents"), _MOST_COMPONENTS)
        offset = _whole(attributes.get("offset"), self._size - self._data)
        dtype = _TYPES.get(attributes.get("type", ""))
        if components < 1 or dtype is None or attributes.get("format") != "appended":
            raise FieldFault("it has an array of another kind")
        return FieldArray(dtype, components, offset, dimension)

    def _values(self, array: FieldArray, most: int) -> np.ndarray:
        dtype = np.dtype(array.dtype)
        data = self._unpacked(array.offset, most * dtype.itemsize)
        if len(data) % dtype.itemsize:
            raise FieldFault("its data are damaged")
        return np.frombuffer(data, dtype)

    def _take(self, at: int, length: int) -> bytes:
        """Bytes of the file at an offset of the data, all of them."""
        begin = self._data + at
        if begin + length > self._size:
            raise FieldFault("its data end too early")
        if self._bytes is not None:
            return self._bytes[begin : begin + length]
        try:
            with open(self.path, "rb") as stream:
                stream.seek(begin)
                data = stream.read(length)
        except OSError as fault:
            raise FieldFault(f"cannot be read: {fault.strerror}") from fault
        if len(data) != length:
            raise FieldFault("its data end too early")
        return data

    def _decoded(self, at: int, length: int) -> tuple[bytes, int]:
        """So many bytes from where they, or their base64, begin, and the offset behind."""
        if not self._is_text:
            return self._take(at, length), at + length
        count = (length + 2) // 3 * 4
        try:
            data = binascii.a2b_base64(self._take(at, count), strict_mode=True) if count else b""
        except (binascii.Error, ValueError) as fault:
            raise FieldFault("its data are no base64") from fault
        if len(data) < length:
            raise FieldFault("its data end too early")
        return data[:length], at + count

    def _unpacked(self, at: int, most: int) -> bytes:
        """The data of an array, at most so many bytes. Packed: number of blocks, bytes of a block, of the last one if it is
        shorter, packed bytes of each; the blocks."""
        if self._packing == "none":
            length = self._length(at)
            if length > most:
                raise FieldFault("an array is too long")
            return self._decoded(at, 4 + length)[0][4:]
        blocks, block, last = struct.unpack("<3I", self._decoded(at, 12)[0])
        if blocks > self._size // 4 or block > _LARGEST_BLOCK or last > block or blocks * block > most + block:
            raise FieldFault("the blocks of an array are too large")
        sizes, at = self._decoded(at, 12 + 4 * blocks)
        lengths = struct.unpack(f"<{blocks}I", sizes[12:])
        if sum(lengths) > self._size:
            raise FieldFault("its data end too early")
        packed, _ = self._decoded(at, sum(lengths))
        out, begin = [], 0
        for number, length in enumerate(lengths, 1):
            out.append(self._block(packed[begin : begin + length], last if number == blocks and last > 0 else block))
            begin += length
        return out[0] if len(out) == 1 else b"".join(out)

    def _length(self, at: int) -> int:
        """The number of bytes in front of an array that is not packed; as base64 its last digits may belong to the array, too."""
        if not self._is_text:
            return int.from_bytes(self._take(at, 4), "little")
        try:
            return int.from_bytes(binascii.a2b_base64(self._take(at, 6) + b"==")[:4], "little")
        except binascii.Error as fault:
            raise FieldFault("its data are no base64") from fault

    def _block(self, packed: bytes, size: int) -> bytes:
        import lzma
        import zlib

        try:
            if self._packing == "zlib":
                unpacker = zlib.decompressobj()
                data, whole = unpacker.decompress(packed, size + 1), unpacker.eof
            else:
                of_xz = lzma.LZMADecompressor(lzma.FORMAT_XZ, memlimit=1 << 28)
                data, whole = of_xz.decompress(packed, size + 1), of_xz.eof
        except (zlib.error, lzma.LZMAError, EOFError) as fault:
            raise FieldFault("a block of its data is damaged") from fault
        if len(data) != size or not whole:
            raise FieldFault("a block of its data is damaged")
        return data


def _whole(text: str | None, most: int) -> int:
    """A number from 0 to `most`, nothing else."""
    if text is None or not re.fullmatch(r"[0-9]{1,18}", text) or int(text) > most:
        raise FieldFault("its head is damaged")
    return int(text)


@dataclass
class StateFiles:
    """One state of a run, as fields.pvd lists it. `t`: [T]; `shells` is None where there are none, the solids where they are alone."""

    t: float
    particles: Path | None = None
    shells: Path | None = None
    solids: Path | None = None


@dataclass
class ParticleFrame:
    """Particles of one state. `x`: (n, 3) [L]; `V`: m/rho (n,) [L3], in the plane per unit of depth [L2]; `h`: (n,) [L];
    `dim`: 2 where all particles have the same z; `arrays`: further ones by name, (n,) or (n, components), as asked for."""

    t: float
    dim: int
    x: np.ndarray
    V: np.ndarray
    h: np.ndarray
    arrays: dict[str, np.ndarray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.x)


class Wanted(NamedTuple):
    """An array of a field file by its name there. `optional`: no fault if the file lacks it."""

    name: str
    components: int = 1
    optional: bool = False


def slack_of(times: Sequence[float] | np.ndarray) -> float:
    """Of windows in time, as a state is written up to one step early: a quarter of the mean distance of states. `times`: increasing [T]."""
    return 0.25 * float(times[-1] - times[0]) / (len(times) - 1) if len(times) > 1 else 0.0


def find_ids(wanted: np.ndarray, known: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where these numbers are among the known ones, (n,), and whether they are there at all, (n,)."""
    if not len(known):
        return np.zeros(len(wanted), dtype=int), np.zeros(len(wanted), dtype=bool)
    order = np.argsort(known, kind="stable")
    at = order[np.minimum(np.searchsorted(known, wanted, sorter=order), len(known) - 1)]
    return at, known[at] == wanted


def read_states(folder: str | os.PathLike[str], diagnostics: Diagnostics, *, with_particles: bool = True) -> list[StateFiles]:
    """The states in DIR/fields.pvd in order of time. Faults are reported; then the list is empty."""
    folder = Path(folder)
    file = folder / "fields.pvd"
    hint = "DIR must be the folder that `courant run -o DIR` wrote"
    if not file.is_file():
        if (folder / "summary.yaml").is_file() or (folder / "messag").is_file():
            diagnostics.error(file, "the run has written no states", "*DATABASE_BINARY_D3PLOT asks for them")
        else:
            diagnostics.error(file, "no results here: the file is missing", hint)
        return []
    states: dict[float, StateFiles] = {}
    try:
        root = ElementTree.parse(file).getroot()
    except (ElementTree.ParseError, OSError, ValueError):  # ValueError: an encoding that is unknown
        root = ElementTree.Element("none")
    for entry in root.iterfind("Collection/*"):
        name, time = entry.get("file"), entry.get("timestep", "")
        try:
            t = float(time)
        except ValueError:
            continue
        if name is None or not np.isfinite(t):
            continue
        state = states.setdefault(t, StateFiles(t))
        if name.endswith(".vtp"):
            state.particles = folder / name
        elif entry.get("name") == "solids":
            state.solids = folder / name
        else:
            state.shells = folder / name
    for state in states.values():
        state.shells = state.shells or state.solids
    out = [states[t] for t in sorted(states) if states[t].particles is not None or not with_particles]
    if not out:
        diagnostics.error(file, "the file lists no state with particles" if with_particles else "the file lists no state", hint)
    return out


def open_field(path: Path, diagnostics: Diagnostics) -> FieldFile | None:
    """A field file; faults are reported, and give None."""
    if not path.is_file():
        diagnostics.error(path, "the file is missing", "fields.pvd names it; was the folder copied in full?")
        return None
    try:
        return FieldFile(path)
    except FieldFault:
        diagnostics.error(path, "not a field file of `courant run`", "it may be truncated; run the deck again")
        return None


def read_array(file: FieldFile, section: str, name: str, components: int, diagnostics: Diagnostics) -> np.ndarray | None:
    """An array of points as float64, shape (points,) or (points, components). Faults are reported, and give None."""
    if file.components(section, name) != components:
        diagnostics.error(
            file.path,
            f"the array '{name}' is missing or has the wrong shape",
            "the file must come from `courant run`, and FIELDS of *COURANT_OUTPUT, if the deck has it, must name the array; a recipe may give density and "
            "smoothing_length as `missing: {density: 1000}`",
        )
        return None
    try:
        return file.values(section, name).astype(np.float64)
    except FieldFault:
        diagnostics.error(file.path, f"not a field file of `courant run`: the data of '{name}' are damaged", "run the deck again")
        return None


def read_particles(
    state: StateFiles, arrays: Sequence[Wanted], diagnostics: Diagnostics, missing: Mapping[str, float] | None = None
) -> ParticleFrame | None:
    """Particles of one state with further arrays. Faults are reported; then there is None. `missing`: numbers for arrays that the file may lack, which
    do not come where they are optional."""
    file = open_field(Path(state.particles or ""), diagnostics)
    if file is None:
        return None
    errors, found = diagnostics.errors, dict[str, np.ndarray]()

    def read(section: str, one: Wanted) -> None:
        if missing and one.name in missing and not file.has(section, one.name):
            found[one.name] = np.full(file.points, missing[one.name])
        if one.name not in found and not (one.optional and not file.has(section, one.name)):
            values = read_array(file, section, one.name, one.components, diagnostics)
            found.update({} if values is None else {one.name: values})

    for name in ("mass", "density", "smoothing_length"):
        read("PointData", Wanted(name))
    for section, one in (("Points", Wanted("Points", 3)), *(("PointData", one) for one in arrays)):
        if diagnostics.errors == errors:
            read(section, one)
    if diagnostics.errors > errors:
        return None
    x, h = found["Points"], found["smoothing_length"]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        V = found["mass"] / found["density"]
        good = np.isfinite(V) & (V > 0) & np.isfinite(x.sum(axis=1)) & (h > 0)
    if not good.all():
        diagnostics.error(
            file.path,
            "a particle has no finite position or no positive mass, density or smoothing length",
            "the run was unstable there; look at an earlier time",
        )
        return None
    dim = 2 if (x[:, 2] == x[:1, 2]).all() else 3
    kept = [one.name for one in arrays if one.name in found and not (one.optional and not file.has("PointData", one.name))]
    return ParticleFrame(state.t, dim, x, V, h, {name: found[name] for name in kept})


def read_walls(state: StateFiles, diagnostics: Diagnostics) -> np.ndarray:
    """Traces of the shells of one state in the plane z = constant; shape (shells, 4): x0, y0, x1, y1 [L].

    The longest side of each shell as seen along z. Faults are reported; then there are none.
    """
    none = np.empty((0, 4))
    file = open_field(state.shells, diagnostics) if state.shells else None
    x = read_array(file, "Points", "Points", 3, diagnostics) if file else None
    if file is None or x is None:
        return none
    try:
        corners, ends = file.corners()
    except FieldFault:
        diagnostics.error(file.path, "not a field file of `courant run`: its cells are damaged", "run the deck again")
        return none
    if len(corners) == 0:
        return np.zeros((len(ends), 4))
    begins = np.append(0, ends[:-1])
    rows = np.repeat(np.arange(len(ends)), ends - begins)
    at = np.arange(len(rows))
    behind = np.where(at + 1 < ends[rows], at + 1, begins[rows])
    a, b = x[corners[at]], x[corners[behind]]
    length = np.hypot(b[:, 0] - a[:, 0], b[:, 1] - a[:, 1])
    order = np.lexsort((at, -length, rows))  # of sides of one length the first one counts
    longest = order[np.concatenate(([True], rows[order][1:] != rows[order][:-1]))]
    out = np.zeros((len(ends), 4))
    out[rows[longest]] = np.column_stack((a[longest, :2], b[longest, :2]))
    return out
