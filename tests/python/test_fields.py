"""Field files: what was written is read, whatever the packing; what is damaged is reported."""

from __future__ import annotations

import numpy as np
import pytest
from courant.diagnostics import CourantError, Diagnostics
from courant.fields import FieldFault, FieldFile, StateFiles, Wanted, read_particles, read_states, read_walls
from courant.results import Mesh
from courant.units import Units
from made_runs import frame, lattice, write_particles, write_run, write_shells


@pytest.mark.parametrize("packing", ["none", "zlib", "xz"])
@pytest.mark.parametrize("real", ["<f4", "<f8"])
def test_values_come_back_however_they_are_packed(tmp_path, packing, real):
    state = frame(lattice(jitter=0.5), v=lambda x, y: np.column_stack([x, y, x * y]))
    write_particles(tmp_path / "p.vtp", state, packing, real)
    file = FieldFile(tmp_path / "p.vtp")
    assert file.points == len(state) and file.components("PointData", "velocity") == 3
    assert np.array_equal(file.values("PointData", "velocity"), state.arrays["velocity"].astype(real))
    assert np.array_equal(file.values("PointData", "id"), np.arange(1, len(state) + 1))
    assert file.arrays["PointData", "velocity"].dimension == "L/T" and file.arrays["PointData", "part"].dimension == "?"


def test_several_blocks(tmp_path):
    state = frame(lattice(dx=0.002))  # more than one block of 32 KB
    write_particles(tmp_path / "p.vtp", state)
    assert np.array_equal(FieldFile(tmp_path / "p.vtp").values("Points", "Points"), state.x.astype("<f4"))


def test_states_in_the_order_of_time(tmp_path):
    write_run(tmp_path, [frame(lattice(), t=t) for t in (0.2, 0.1)], shells=True)
    diagnostics = Diagnostics()
    states = read_states(tmp_path, diagnostics)
    assert [one.t for one in states] == [0.1, 0.2] and diagnostics.ok
    assert states[0].particles.name == "particles_0001.vtp" and states[0].shells.name == "shells_0001.vtu"


@pytest.mark.parametrize("text", ["<VTKFile><Coll", "", '<VTKFile><Collection><DataSet timestep="x" file="a.vtp"/></Collection></VTKFile>'])
def test_an_index_that_is_none(tmp_path, text):
    (tmp_path / "fields.pvd").write_text(text)
    diagnostics = Diagnostics()
    assert read_states(tmp_path, diagnostics) == []
    assert "fields.pvd: error: the file lists no state with particles" in diagnostics.text()


def test_walls_are_the_longest_sides(tmp_path):
    x = np.array([[0, 0, 0], [3, 4, 0], [3, 4, 1], [0, 0, 1], [0, 1, 0]])
    write_shells(tmp_path / "s.vtu", x, [[0, 1, 2, 3], [0, 4, 3]])
    walls = read_walls(StateFiles(0, None, tmp_path / "s.vtu"), Diagnostics())
    assert np.array_equal(walls, [[0, 0, 3, 4], [0, 0, 0, 1]])


@pytest.mark.parametrize("corners", [[[0, 1, 9]], [[0, 1, -1]]])
def test_cells_of_points_that_are_not_there(tmp_path, corners):
    write_shells(tmp_path / "s.vtu", np.zeros((4, 3)), corners)
    diagnostics = Diagnostics()
    assert len(read_walls(StateFiles(0, None, tmp_path / "s.vtu"), diagnostics)) == 0
    assert "its cells are damaged" in diagnostics.text()
    with pytest.raises(CourantError, match="its cells are damaged"):
        Mesh(tmp_path / "s.vtu", Units()).cells  # noqa: B018


def test_particles_of_an_unstable_run(tmp_path):
    state = frame(lattice(x1=0.1))
    state.arrays["density"][3] = np.nan
    write_particles(tmp_path / "p.vtp", state)
    diagnostics = Diagnostics()
    assert read_particles(StateFiles(0, tmp_path / "p.vtp"), [], diagnostics) is None
    assert "p.vtp: error: a particle has no finite position or no positive mass" in diagnostics.text()


def test_an_array_that_is_not_there(tmp_path):
    write_particles(tmp_path / "p.vtp", frame(lattice(x1=0.1)))
    state, diagnostics = StateFiles(0, tmp_path / "p.vtp"), Diagnostics()
    assert read_particles(state, [Wanted("sound_speed")], diagnostics) is None
    assert "the array 'sound_speed' is missing or has the wrong shape" in diagnostics.text()
    found = read_particles(state, [Wanted("sound_speed", optional=True)], Diagnostics())
    assert found is not None and found.arrays == {} and found.dim == 2


def replaced(whole: bytes, before: bytes, skip: int, put: bytes) -> bytes:
    at = whole.index(before) + len(before) + skip
    return whole[:at] + put + whole[at + len(put) :]


def test_damage_of_each_kind_is_told(tmp_path):
    path = tmp_path / "p.vtp"
    write_particles(path, frame(lattice()))
    whole = path.read_bytes()
    offset, data = b'Name="mass" NumberOfComponents="1" format="appended" offset="', b"<AppendedData>\n_"
    mass = int(whole[whole.index(offset) + len(offset) :].split(b'"')[0])
    huge, nought = b"\xff\xff\xff\x7f", bytes(4)
    damaged = {
        "cut off in the data": whole[: len(whole) * 3 // 4],
        "cut off in the head": whole[:700],
        "empty": b"",
        "blocks": replaced(whole, data, mass, huge),
        "no block": replaced(whole, data, mass, nought),
        "blocks of nothing, by which VTK's reader divides": replaced(whole, data, mass + 4, nought),
        "a block of 2 GB": replaced(whole, data, mass + 4, huge),
        "the last block": replaced(whole, data, mass + 8, huge),
        "a packed block beyond the end": replaced(whole, data, mass + 12, huge),
        "packed data": replaced(whole, data, mass + 24, huge),
        "more points than values": replaced(whole, b'NumberOfPoints="', 0, b"9"),
        "memory": whole.replace(b'NumberOfPoints="', b'NumberOfPoints="9999999'),
        "data beyond the end": replaced(whole, offset, 0, b"9999999"),
        "what no run writes": whole.replace(b'header_type="UInt32"', b'header_type="UInt64"'),
    }
    for what, content in damaged.items():
        path.write_bytes(content)
        diagnostics = Diagnostics()
        assert read_particles(StateFiles(0, path), [], diagnostics) is None, what
        assert "p.vtp: error: not a field file" in diagnostics.text(), what
    path.write_bytes(whole)
    assert read_particles(StateFiles(0, path), [], Diagnostics()) is not None


@pytest.mark.parametrize("packing", ["none", "zlib", "xz"])
def test_random_damage_never_crashes(tmp_path, packing):
    path, random = tmp_path / "p.vtp", np.random.default_rng(7)
    write_particles(path, frame(lattice(x1=0.3)), packing)
    whole, refused = path.read_bytes(), 0
    head = whole.index(b"<AppendedData")
    for k in range(400):
        content = bytearray(whole)
        for at in random.integers(0, head if k % 2 else len(whole), random.integers(1, 6)):
            content[at] = random.integers(0, 256)
        if k % 10 == 0:
            del content[random.integers(0, len(content)) :]
        path.write_bytes(content)
        try:
            file = FieldFile(path)
            for section, name in file.arrays:
                if file.points <= len(whole):  # values of points
                    file.values(section, name)
        except (FieldFault, KeyError):
            refused += 1
    assert refused > 50


def test_no_file_and_no_right(tmp_path):
    diagnostics = Diagnostics()
    assert read_particles(StateFiles(0, tmp_path / "no.vtp"), [], diagnostics) is None
    assert "no.vtp: error: the file is missing" in diagnostics.text()
    with pytest.raises(FieldFault):
        FieldFile(tmp_path)


def test_an_encoding_beside_the_data(tmp_path):
    """As earlier versions of Courant wrote it."""
    path = tmp_path / "p.vtp"
    write_particles(path, frame(lattice()))
    before = FieldFile(path).values("PointData", "mass")
    first, _, *rest = path.read_bytes().replace(b"<AppendedData>", b'<AppendedData encoding="raw">').split(b"\n")
    path.write_bytes(b"\n".join([first, *rest]))
    assert np.array_equal(FieldFile(path).values("PointData", "mass"), before) and len(before) > 10
