"""Views: where points come to lie, which colours pixels have, units, the axis that is up, and what is said of faults."""

from __future__ import annotations

import math
import os
import shutil
import subprocess
from pathlib import Path

import courant
import numpy as np
import pytest
from courant.diagnostics import Diagnostics, Location
from courant.fields import StateFiles
from courant.post import read_recipe
from courant.post.camera import AXES, Camera, axis_of, up_of, up_of_gravity
from courant.post.view_fields import Faces, UnknownField, faces_of, field_names, field_of, joined_faces, mirrored, mises, outlines
from courant.results import RunState
from made_runs import DX, block, frame, lattice, write_fields, write_history, write_run, write_shells

pytest.importorskip("matplotlib")
from courant.post.raster import Raster  # noqa: E402
from courant.post.view_plane import _add, fill, plane_window, surface_line, wall_traces  # noqa: E402
from courant.post.view_scene import View, colour_range, colours_of, scene_of, spoken  # noqa: E402
from courant.post.view_space import nice_length, render  # noqa: E402
from courant.post.views import draw_view, draw_views, save_view  # noqa: E402

CUBE = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)


def write_solids(folder: Path, x: np.ndarray, cells: list[list[int]], arrays: dict[str, np.ndarray], t: float = 0.0) -> Path:
    """A run of one state with hexahedra (8 corners) and shells (4)."""
    connectivity = np.array([k for one in cells for k in one], dtype="<i8")
    kinds = np.array([12 if len(one) == 8 else 9 for one in cells], dtype="<u1")
    table = {"connectivity": connectivity, "offsets": np.cumsum([len(one) for one in cells]).astype("<i8"), "types": kinds}
    at = {"velocity": x.astype("<f4")}
    sections = [("PointData", at), ("CellData", arrays), ("Points", {"Points": x.astype("<f4")}), ("Cells", table)]
    write_fields(folder / "fields/solids.vtu", sections, len(x), len(cells))
    entry = f'<DataSet timestep="{t}" group="" part="0" name="solids" file="fields/solids.vtu"/>'
    (folder / "fields.pvd").write_text(f'<?xml version="1.0"?>\n<VTKFile type="Collection">\n<Collection>{entry}</Collection>\n</VTKFile>\n')
    return folder


@pytest.fixture
def cubes(tmp_path):
    """Two cubes side by side along x, with a tension of 3 and of 0, and a shear of 2 in the second."""
    x = np.concatenate((CUBE, CUBE[[1, 2, 5, 6]] + [1, 0, 0]))
    second = [1, 8, 9, 2, 5, 10, 11, 6]
    stress = np.array([[3, 0, 0, 0, 0, 0], [0, 0, 0, 0, 2, 0]], dtype="<f4")
    arrays = {"stress": stress, "plastic_strain": np.array([0.5, 0.0], "<f4"), "part": np.array([1, 1], "<i8")}
    return courant.open(write_solids(tmp_path, x, [list(range(8)), second], arrays), courant.Units())


@pytest.fixture
def pool(tmp_path):
    """Water 0.5 m wide and 0.1 m deep whose speed is x, in three states, falling by 10 m/s2 along y in words of the potential energy."""
    states = [frame(lattice(x1=0.5) + [0, 0.01 * k, 0], t=0.5 * k, v=lambda x, y: x) for k in range(3)]
    write_run(tmp_path, states, title="a pool", shells=True)
    energy = np.array([10 * states[0].arrays["mass"].sum() * (0.05 + 0.01 * k) for k in range(3)])
    write_history(tmp_path, {"/global/time": (np.array([0, 0.5, 1.0]), "T"), "/global/potential": (energy, "ML2/T2")})
    return courant.open(tmp_path)


class TestCamera:
    def test_perspective(self):
        camera = Camera.looking("z", 0, 0).before(np.array([[-1.0, -1, -1], [1, 1, 1]]))  # the eye at y = -D
        D = camera.distance
        assert D == pytest.approx(2.2 * np.sqrt(12))
        near, middle, far = camera.project(np.array([[0.5, -1, 0.5], [0.5, 0, 0.5], [0.5, 1, 0.5]]))
        assert middle == pytest.approx([0.5, 0.5, 0]) and near[:2] == pytest.approx(0.5 * D / (D - 1)) and far[:2] == pytest.approx(0.5 * D / (D + 1))
        line = np.array([[0.2, -1.0, 0.3]]) + np.linspace(0, 1, 5)[:, None] * np.array([[0.7, 2.0, -0.9]])
        assert np.linalg.matrix_rank(np.diff(camera.project(line), axis=0), tol=1e-12) == 1, "straight lines stay straight, also in depth"
        side = np.array([[1.0, -0.01, 0]])  # a face that a parallel camera sees, but not one that stands left of it
        assert Camera.looking("z", 0, 0).sees(side, np.array([[0.9, 0, 0]])) == [True] and camera.sees(side, np.array([[0.9, 0, 0]])) == [False]

    @pytest.mark.parametrize("up", AXES)
    def test_up_is_upright_and_the_axes_are_right_handed(self, up):
        for azimuth, elevation in ((0, 0), (30, 20), (200, -40)):
            camera = Camera.looking(up, azimuth, elevation)
            u, v, w = camera.project(axis_of(up)[None])[0]
            assert abs(u) < 1e-12 and v == pytest.approx(math.cos(math.radians(elevation)))
            assert w == pytest.approx(math.sin(math.radians(elevation)))  # from above one sees the top
            assert np.cross(camera.right, camera.up) == pytest.approx(camera.toward)

    def test_known_places(self):
        front = Camera.looking("z", 0, 0)
        assert front.project(np.array([[1.0, 2.0, 3.0]]))[0] == pytest.approx([1, 3, -2])  # the eye is at -y
        assert Camera.looking("y", 0, 0).project(np.array([[1.0, 2.0, 3.0]]))[0] == pytest.approx([1, 2, 3])  # as plane pictures
        side = Camera.looking("z", 90, 0)  # against the clock from -y: at +x
        assert side.project(np.array([[1.0, 2.0, 3.0]]))[0] == pytest.approx([2, 3, 1])

    def test_up_by_the_potential_energy(self, pool, tmp_path):
        assert up_of_gravity(pool) == "y" and up_of(pool, flat=False) == "y"
        energy = pool.histories["global/potential"]
        write_history(tmp_path, {"/global/time": (pool.histories.t, "T"), "/global/potential": (-energy, "ML2/T2")})
        assert up_of_gravity(courant.open(tmp_path)) == "-y"
        write_history(tmp_path, {"/global/time": (pool.histories.t, "T"), "/global/potential": (energy * [1, 3, 1], "ML2/T2")})
        assert up_of_gravity(courant.open(tmp_path)) is None  # no axis explains it
        write_history(tmp_path, {"/global/time": (pool.histories.t, "T"), "/global/potential": (0 * energy, "ML2/T2")})
        none = courant.open(tmp_path)
        assert up_of(none, flat=True) == "y" and up_of(none, flat=False) == "z"

    def test_up_without_histories(self, cubes):
        assert up_of(cubes, flat=False) == "z"


class TestFields:
    def test_mises_by_hand(self):
        tension, shear, pressure = [5, 0, 0, 0, 0, 0], [0, 0, 0, 0, 2, 0], [-7, -7, -7, 0, 0, 0]
        assert mises(np.array([tension, shear, pressure], dtype=float)) == pytest.approx([5, 2 * math.sqrt(3), 0])

    def test_names_and_components(self, cubes):
        mesh = cubes.states[0].shells
        assert field_of(mesh, "stress.mises").values == pytest.approx([3, 2 * math.sqrt(3)])
        assert field_of(mesh, "stress.yz").values.tolist() == [0, 2] and field_of(mesh, "stress.mean").values.tolist() == [1, 0]
        assert field_of(mesh, "speed").at == "nodes" and field_of(mesh, "velocity.x").unit == "m/s"
        assert field_of(mesh, "velocity").values == pytest.approx(np.sqrt((mesh.points**2).sum(axis=1)), abs=1e-6)
        assert "part" not in field_names(mesh) and "stress" not in field_names(mesh)
        assert spoken("stress_upper.mises") == "stress upper, von Mises" and spoken("stress.xx") == "stress xx"

    @pytest.mark.parametrize(
        "name, said",
        [("stress", "choose a component: stress.xx, stress.yy"), ("stress.mised", "did you mean stress.mises?"), ("p", "it has speed, velocity,")],
    )
    def test_unknown_names(self, cubes, name, said):
        with pytest.raises(UnknownField, match=said.replace("?", r"\?")):
            cubes.plot(field=name)

    def test_a_field_of_particles_or_of_elements(self, pool):
        assert scene_of(pool.states[0], View("v", "pressure")).values is not None
        shells = scene_of(pool.states[0], View("v", "speed", of="particles"))
        assert shells.walls is not None and len(shells.walls) == 2 and shells.label == "speed [m/s]"
        with pytest.raises(UnknownField, match="no elements"):
            scene_of(RunState(StateFiles(0.0, pool.folder / "fields/particles_0000.vtp"), pool), View("v", of="elements"))


class TestFaces:
    def test_inner_faces_of_solids_are_left_out(self, cubes):
        faces = faces_of(cubes.states[0].shells)
        assert len(faces) == 10 and np.bincount(faces.cell).tolist() == [5, 5]
        middle = faces.x[faces.corners].mean(axis=1)
        assert not ((np.abs(middle - [1, 0.5, 0.5])).sum(axis=1) < 1e-6).any()
        outward = ((middle - [1, 0.5, 0.5]) * faces.normals()).sum(axis=1)
        assert (outward > 0).all()

    def test_outlines_are_edges_alone(self):
        x = np.array([[i, j, 0] for i in range(3) for j in range(2)], dtype=float)  # two squares in a plane
        flat = Faces(x, np.array([[0, 2, 3, 1], [2, 4, 5, 3]]), np.arange(2), np.zeros(2), np.zeros(2, dtype=bool), np.zeros(2, dtype=bool))
        assert sorted(map(tuple, outlines(flat).tolist())) == [(0, 1), (0, 2), (1, 3), (2, 4), (3, 5), (4, 5)]
        flat.x[4:, 2] = 1  # a fold of 45 degrees is seen
        assert (2, 3) in set(map(tuple, outlines(flat).tolist()))

    def test_solids_and_shells_of_one_state(self, cubes):
        """Two files: the field of the solids gets colours, the shells are walls."""
        folder = cubes.folder
        entry = '<DataSet timestep="0.0" part="1" name="shells" file="fields/s.vtu"/>'
        file = folder / "fields.pvd"
        file.write_text(file.read_text().replace("</Collection>", f"{entry}</Collection>"))
        write_shells(folder / "fields/s.vtu", np.array([[0.0, 0, 0], [5, 0, 0], [5, 5, 0], [0, 5, 0]]), [[0, 1, 2, 3]])
        state = courant.open(folder).states[0]
        assert [one.path.name for one in state.elements] == ["s.vtu", "solids.vtu"]
        scene = scene_of(state, View("v", "stress.xx"))
        assert len(scene.faces) == 10 and len(scene.walls) == 1 and sorted(set(scene.colours.ravel())) == [0, 3]
        both = joined_faces([faces_of(mesh) for mesh in state.elements])
        assert len(both) == 11 and both.x[both.corners].max() == 5

    def test_mirror(self, cubes):
        both = mirrored(faces_of(cubes.states[0].shells), 0)
        assert len(both) == 20 and both.x[:, 0].min() == -2
        middle = both.x[both.corners].mean(axis=1)[10:]
        assert (((middle - [-1, 0.5, 0.5]) * both.normals()[10:]).sum(axis=1) > 0).all()  # still outward


    @pytest.mark.parametrize(
        "name, sign", [("velocity.x", -1), ("velocity.y", 1), ("stress.xy", -1), ("stress.yz", 1), ("stress.xx", 1), ("stress.mises", 1)]
    )
    def test_components_in_a_mirror(self, cubes, name, sign):
        colours = scene_of(cubes.states[0], View("v", name, mirror="x")).colours
        assert len(colours) == 20 and (colours[10:] == sign * colours[:10]).all()


class TestRaster:
    def test_the_nearer_sphere_is_seen_where_it_belongs(self):
        raster = Raster(0, 1, 100, 100, 100)
        red, blue = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
        raster.spheres(np.array([[0.25, 0.75, 1.0], [0.25, 0.75, 0.0], [0.7, 0.2, 0.0]]), np.array([0.05, 0.1, 0.1]), np.array([red, blue, blue]))
        centre, rim, other = raster.colour[25, 25], raster.colour[25, 33], raster.colour[80, 70]
        assert centre[0] > 0.7 and centre[2] == 0 and rim[2] > 0.5 and rim[0] == 0 and other[2] > 0.7
        assert raster.depth[25, 25] == pytest.approx(1.05, abs=1e-3) and (raster.colour[60, 20] == 1).all()

    def test_faces_hide_what_is_behind_and_take_values_of_corners(self):
        raster = Raster(0, 1, 50, 50, 50)
        x = np.array([[0.1, 0.1, 0], [0.9, 0.1, 0], [0.9, 0.9, 0], [0.1, 0.9, 0]], dtype=float)
        normal = np.array([[0, 0, 1.0]])
        left_to_right = np.array([[[0, 0, 0], [1, 1, 1], [1, 1, 1], [0, 0, 0]]], dtype=float)
        raster.faces(x, np.array([[0, 1, 2, 3]]), left_to_right, normal, lines=False)
        raster.faces(x - [0, 0, 1], np.array([[0, 1, 2, 3]]), np.array([[1.0, 0, 0]]), normal, lines=False)
        row = raster.colour[25, 6:44, 0]
        assert (np.diff(row) > 0).all() and np.ptp(raster.colour[25, 25]) < 1e-6  # grey, not red, darker on the left
        places = np.array([[0.5, 0.5, -0.5], [0.5, 0.5, 0.1], [0.02, 0.5, -9]])
        assert (raster.colour[25, 1] == 1).all() and raster.seen(places, 0.01).tolist() == [False, True, True]

    def test_what_lies_behind_an_edge_is_darker(self):
        raster = Raster(0, 1, 40, 40, 40)
        x = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
        raster.faces(x, np.array([[0, 1, 2, 3]]), np.full((1, 3), 0.8), np.array([[0, 0, 1.0]]), lines=False)
        raster.spheres(np.array([[0.5, 0.5, 1.0]]), np.array([0.2]), np.full((1, 3), 0.8))
        before = raster.colour.copy()
        raster.shadows(0.1)
        assert raster.colour[20, 29, 0] < 0.9 * before[20, 29, 0]  # beside the sphere, on the face
        assert raster.colour[3, 3, 0] == before[3, 3, 0] and raster.colour[20, 20, 0] == before[20, 20, 0]

    def test_a_veil_counts_once_and_only_in_front(self):
        raster = Raster(0, 1, 20, 20, 20)
        x = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
        raster.veil(x, np.array([[0, 1, 2, 3], [0, 1, 2, 3]]), np.zeros(3), 0.25)
        assert raster.colour == pytest.approx(0.75)
        raster.veil(x - [0, 0, 5], np.array([[0, 1, 2, 3]]), np.zeros(3), 0.2)
        assert raster.colour == pytest.approx(0.6)  # a veil hides nothing
        raster.spheres(np.array([[0.5, 0.5, -1.0]]), np.array([0.2]), np.ones((1, 3)))
        before = raster.colour[10, 10].copy()
        raster.veil(x - [0, 0, 5], np.array([[0, 1, 2, 3]]), np.zeros(3), 0.5)
        assert (raster.colour[10, 10] == before).all() and raster.colour[1, 1] == pytest.approx(0.3)  # not over what is before it


class TestPlane:
    def test_no_gaps_inside_and_nothing_outside(self, pool):
        view = View("v", window=((-0.1, 0.6), (-0.05, 0.2), None))
        scene = scene_of(pool.states[0], view)
        field = fill(scene.x, scene.V, scene.h, scene.values, (-0.1, 0.6, -0.05, 0.2), 700)
        ny, nx = field.shape
        x, y = -0.1 + 0.7 * (np.arange(nx) + 0.5) / nx, -0.05 + 0.25 * (np.arange(ny) + 0.5) / ny
        away_x, away_y = np.abs(x - 0.25)[None], np.abs(y - 0.05)[:, None]
        inside = (away_x < 0.249) & (away_y < 0.049) & ((away_x < 0.246) | (away_y < 0.046))  # corners are round
        outside = (np.abs(x - 0.25) > 0.252)[None] | (np.abs(y - 0.05) > 0.052)[:, None]
        assert np.isfinite(field[inside]).all() and np.isnan(field[outside]).all()
        at = int(np.argmin(np.abs(y - 0.05)))
        assert field[at][(x > 0.02) & (x < 0.48)] == pytest.approx(x[(x > 0.02) & (x < 0.48)], abs=0.002)

    @pytest.mark.parametrize("gap, filled", [(1.0, True), (2.0, False)])  # spacings; h is 1.2
    def test_cracks_are_filled_and_cavities_are_not(self, tmp_path, gap, filled):
        upper = lattice(x1=0.2, y1=0.05) + [0, 0.05 + gap * DX, 0]
        write_run(tmp_path, [frame(lattice(x1=0.2, y1=0.05), upper)])
        scene = scene_of(courant.open(tmp_path).states[0], View("v"))
        field = fill(scene.x, scene.V, scene.h, scene.values, (0, 0.2, 0, 0.12), 400)
        row = field[int((0.05 + 0.5 * gap * DX) / 0.12 * field.shape[0])]
        assert np.isfinite(row[len(row) // 4 : -len(row) // 4]).all() == filled

    def test_a_drop_alone_is_seen(self, tmp_path):
        write_run(tmp_path, [frame(lattice(x1=0.1, y1=0.02), np.array([[0.05, 0.08, 0]]))])
        scene = scene_of(courant.open(tmp_path).states[0], View("v"))
        field = fill(scene.x, scene.V, scene.h, scene.values, (0, 0.1, 0, 0.1), 400)
        assert np.isnan(fill(scene.x + 9, scene.V, scene.h, scene.values, (0, 0.1, 0, 0.1), 40)).all()
        n = field.shape[0]
        assert np.isfinite(field[int(0.8 * n), n // 2]) and np.isnan(field[int(0.9 * n), n // 2])

    def test_surface_walls_and_window(self, pool):
        scene = scene_of(pool.states[2], View("v"))
        x, level = surface_line(scene, (-1, 1, -1, 1), 0.0)
        assert level[(x > 0.02) & (x < 0.48)] == pytest.approx(0.12, abs=0.1 * DX)
        assert sorted(map(tuple, wall_traces(scene).reshape(-1, 4).tolist()))[0][0] in (0.0, 0.5)
        left, right, bottom, top = plane_window([scene], View("v"))
        assert left < 0 and right > 1 and bottom < 0 and top > 0.12


class TestColours:
    def test_range(self, pool):
        scene = scene_of(pool.states[0], View("v"))
        low, high, beyond = colour_range([scene], View("v"))
        assert (low, high) == pytest.approx((0, 0.5)) and beyond == "neither"
        assert colour_range([scene], View("v", range=(0.1, 0.2))) == (0.1, 0.2, "both")
        assert colour_range([scene], View("v", range=(0.0, 2.0)))[2] == "neither"

    def test_units_and_factors(self, pool):
        scene = scene_of(pool.states[0], View("v", "speed", unit="mm/s", factor=1000))
        assert scene.label == "speed [mm/s]" and scene.values.max() == pytest.approx(497.5, abs=0.01)
        mm = courant.open(pool.folder, courant.Units("t", "mm", "s"))
        assert scene_of(mm.states[0], View("v", "pressure")).label == "pressure [t/(mm s2)]"

    def test_ends_of_the_map(self):
        assert colours_of(np.array([-1.0, 0.0]), 0, 1, "viridis")[0] == pytest.approx([0.267, 0.005, 0.329], abs=0.01)
        assert colours_of(np.array([1.0]), 0, 1, "viridis")[0] == pytest.approx([0.993, 0.906, 0.144], abs=0.01)

    def test_scale_of_lengths(self):
        assert [nice_length(one) for one in (1, 0.26, 7, 0.099)] == pytest.approx([1, 0.2, 5, 0.05])


class TestPictures:
    def test_pixels_of_solids(self, cubes):
        view = View("v", "plastic_strain", range=(0, 0.5), lines=False)
        picture = render(scene_of(cubes.states[0], view), view, Camera.looking("z", 0, 0), (-0.5, 2.5, -0.5, 1.5), 0, 0.5, 300).image
        high, low = picture[100, 100], picture[100, 200]  # x = 0.5 and x = 1.5
        assert high[0] > 0.7 and high[2] < 0.3 and low[0] < 0.35 and low[1] < 0.1 and (picture[10, 10] == 1).all()

    def test_fronts_of_solids_are_seen_not_their_backs(self, cubes):
        view = View("v", "velocity.y", lines=False)  # the velocity is the location: 0 in front, 1 at the back
        picture = render(scene_of(cubes.states[0], view), view, Camera.looking("z", 0, 0), (-0.5, 2.5, -0.5, 1.5), 0, 1, 300).image
        assert picture[100, 100] == pytest.approx(colours_of(np.array([0.0]), 0, 1, "viridis")[0], abs=0.1)
        picture = render(scene_of(cubes.states[0], view), view, Camera.looking("z", 180, 0), (-2.5, 0.5, -0.5, 1.5), 0, 1, 300).image
        assert picture[100, 200, 1] > 0.65 > 0.35 > picture[100, 200, 2]  # yellow

    def test_the_colour_bar_tells_of_values_beyond(self, pool):
        bar = draw_view(pool, View("v", range=(0.1, 0.6))).axes[-1]._colorbar
        assert (bar.extend, bar.vmin, bar.vmax) == ("min", 0.1, 0.6)

    def test_water_in_space_with_walls(self, tmp_path):
        write_run(tmp_path, [frame(block(6, 5, 4), dim=3)], shells=True)
        run = courant.open(tmp_path)
        made = draw_view(run, View("v"))
        axes = made.axes[0]
        assert axes.get_title(loc="right") == "t = 0 s" and made.axes[-1].get_ylabel() == "speed [m/s]"
        texts = [one.get_text() for one in axes.texts]
        assert {"x", "y", "z"} <= set(texts) and texts[-1] == "0.2 m"
        assert len(axes.collections) == 2 and axes.collections[0].get_segments()

    def test_times_labels_and_marks(self, pool, tmp_path):
        made = draw_view(pool, View("v", times=[0, 0.6], depth=True, gauges=[0.25]))
        first, second, bar = made.axes
        assert (first.get_title(loc="right"), second.get_title(loc="right")) == ("t = 0 s", "t = 0.5 s")
        assert second.get_xlabel() == "x [m]" and first.get_ylabel() == "y [m]" and bar.get_ylabel() == "speed [m/s]"
        assert first.get_aspect() == 1 and [one.get_text() for one in second.texts] == ["0.11 m"]
        save_view(made, tmp_path / "a.png")
        assert (tmp_path / "a.png").stat().st_size > 5000

    def test_a_plane_flow_by_a_camera_or_with_another_axis_up(self, pool):
        upside_down = draw_view(pool, View("v", up="-y")).axes[0]
        assert not upside_down.axison and {"x", "y"} <= {one.get_text() for one in upside_down.texts}
        assert not draw_view(pool, View("v", azimuth=30)).axes[0].axison and draw_view(pool, View("v")).axes[0].axison
        with pytest.raises(UnknownField, match="lies in x and y: up cannot be z"):
            draw_view(pool, View("v", up="z"))
        with pytest.raises(UnknownField, match="need a plane flow whose y is up"):
            draw_view(pool, View("v", up="-y", depth=True))

    def test_plot_of_results(self, pool, tmp_path):
        pool.plot(field="pressure", t=0.5, file=tmp_path / "p.png", range=(0, 1))
        assert (tmp_path / "p.png").stat().st_size > 3000
        with pytest.raises(KeyError, match="did you mean pressure"):
            pool.plot(field="presure")
        with pytest.raises(ValueError, match="'up' cannot be 'w'; it is one of x, y"):
            pool.plot(field="pressure", up="w")
        with pytest.raises(KeyError, match="nothing is within the window"):
            pool.plot(field="pressure", window=((7, 8), None, None))

    def test_gif(self, pool, tmp_path):
        from PIL import Image

        diagnostics = Diagnostics()
        made = draw_views(pool, [(View("m", animate="gif"), diagnostics)], tmp_path, diagnostics)
        assert [one.name for one in made] == ["m.png", "m.gif"] and Image.open(tmp_path / "m.gif").n_frames == 3

    def test_mp4_without_ffmpeg(self, pool, tmp_path, monkeypatch):
        monkeypatch.setattr("matplotlib.animation.FFMpegWriter.isAvailable", classmethod(lambda _: False))
        diagnostics = Diagnostics()
        made = draw_views(pool, [(View("m", animate="mp4"), Location("r.yaml", 2, 3)), (View("n"), Location())], tmp_path, diagnostics)
        assert [one.name for one in made] == ["m.png", "n.png"], "other views are drawn"
        told = "r.yaml:2:3: warning: view 'm': there is no MP4, which needs the program 'ffmpeg'\n  hint: apt-get install ffmpeg\n"
        assert diagnostics.ok and diagnostics.text() == told

    @pytest.mark.skipif(shutil.which("ffmpeg") is None, reason="ffmpeg is not here (Debian: apt-get install ffmpeg)")
    def test_mp4(self, pool, tmp_path):
        made = draw_views(pool, [(View("m", animate="mp4", rate=2), Location())], tmp_path, Diagnostics())
        words = ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=codec_name,nb_read_frames,r_frame_rate", "-of", "csv=p=0", made[1]]
        assert subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip().split(",") == ["h264", "2/1", "3"]


class TestRecipe:
    def read(self, tmp_path, text):
        file, diagnostics = tmp_path / "R", Diagnostics()
        file.write_text(text)
        return read_recipe(file, diagnostics), diagnostics.text().replace(f"{tmp_path}/", "")

    def test_keys(self, tmp_path):
        recipe, _ = self.read(
            tmp_path,
            "up: z\nviews:\n- {name: a, field: stress.mises, times: [1], range: [0, 2], mirror: [x, z], up: -y}\n"
            "- {name: b, camera: {azimuth: 10, elevation: 5}, theory: {of: 2 * x, x: [0, 1], label: two}, animate: gif}\n",
        )
        (a, _), (b, _) = recipe.views
        assert (a.field, a.times, a.range, a.mirror, a.up) == ("stress.mises", [1], (0, 2), "xz", "-y")
        assert (b.up, b.azimuth, b.elevation, b.theory_label, b.animate, b.times) == ("z", 10, 5, "two", "gif", None)
        assert b.theory.over({"x": np.array([1.0, 2])}, 2).tolist() == [2, 4]

    @pytest.mark.parametrize(
        "entry, said",
        [
            ("{name: a, colors: x}", "R:2:13: error: 'view 1' does not know the key 'colors'\n  hint: did you mean colours?"),
            ("{field: speed}", "'view 1' lacks the key 'name'"),
            ("{name: a/b}", "'a/b' is no name of a file"),
            ("{name: a, factor: 2}", "needs the unit that comes of it"),
            ("{name: a, mirror: [q]}", "is a list of x, y and z"),
            ("{name: a, colours: jet}", "cannot be 'jet'"),
            ("{name: a, camera: {elevation: 100}}", "must be -90 to 90 degrees"),
            ("{name: a, times: []}", "'view 1.times' is empty"),
            ("{name: a}\n- {name: a}", "two views are named 'a'"),
        ],
    )
    def test_faults(self, tmp_path, entry, said):
        recipe, text = self.read(tmp_path, f"views:\n- {entry}\n")
        assert recipe is None and said in text

    def test_a_field_that_is_not_there_is_told_at_the_view(self, pool, tmp_path):
        from courant.post import run_post

        (tmp_path / "R").write_text("views:\n- {name: good}\n- {name: bad, field: temperature}\n- {name: late, times: [9]}\n- {name: half, times: [0, 9]}\n")
        diagnostics = Diagnostics()
        assert not run_post(tmp_path / "R", pool.folder, lambda _: None, diagnostics)
        text = diagnostics.text()
        assert "R:3:3: error: view 'bad': " in text and "no field 'temperature'; it has speed" in text
        assert "R:4:3: warning: view 'late': no state near t = 9: the results go from 0 to 1" in text
        assert (pool.folder / "post/half.png").is_file() and not (pool.folder / "post/late.png").exists()
        assert (pool.folder / "post/good.png").is_file() and not (pool.folder / "post/bad.png").exists()

    def test_a_view_without_a_recipe(self, cubes, tmp_path, capsys):
        from courant.post.command import main

        assert main(["--view", "stress.mises", str(cubes.folder)]) == 0
        assert (cubes.folder / "post/stress_mises.png").stat().st_size > 3000 and "stress_mises.png" in capsys.readouterr().out
        assert main(["--view", "stress.mised", str(cubes.folder)]) == 1 and "did you mean stress.mises?" in capsys.readouterr().err
        assert main(["--view", "speed", str(tmp_path / "none")]) == 1 and "no such folder" in capsys.readouterr().err

    def test_views_of_a_run_without_particles(self, cubes, tmp_path):
        from courant.post import run_post

        (tmp_path / "R").write_text("views: [{name: bar, field: stress.mises, unit: kPa, factor: 0.001}]\n")
        said, diagnostics = [], Diagnostics()
        assert run_post(tmp_path / "R", cubes.folder, said.append, diagnostics), diagnostics.text()
        assert "bar.png" in "".join(said)


def test_a_window_draws_off_the_screen(tmp_path: Path) -> None:
    pytest.importorskip("pyvista", reason="pyvista is missing")
    if not os.environ.get("COURANT_EXECUTABLE"):
        pytest.skip("needs the program")

    scene = courant.Scene("drop", spacing=0.1, end=0.02).water(low=(0, 0), high=(0.4, 0.4)).box(low=(0, 0), high=(1, 1), open=["top"])
    scene.run(tmp_path / "out", threads=1, quiet=True).states[-1].show("pressure", tmp_path / "window.png")
    assert (tmp_path / "window.png").stat().st_size > 5000


def test_bodies_are_opaque_and_the_walls_around_the_water_are_not() -> None:
    from courant.post.view_fields import Faces, joined_faces
    from courant.post.view_space import bodies_among
    from courant.scene import shapes

    def part(number: int, low: float, high: float, faces: slice, deforms: bool = False) -> Faces:
        made = shapes.box(np.full(3, low), np.full(3, high), 3)
        corners = np.column_stack([made.faces, made.faces[:, 2]])[faces]
        flags = np.full(len(corners), deforms)
        return Faces(made.points, corners, np.arange(len(corners)), np.full(len(corners), number), np.zeros(len(corners), dtype=bool), flags)

    x = np.random.default_rng(1).uniform(0, 1, (100, 3)) * [1, 1, 0.5]
    tank, house, fence, plate = part(1, 0, 1, slice(None)), part(2, 0.7, 0.8, slice(None)), part(3, 0.1, 0.2, slice(2)), part(4, 0.3, 0.4, slice(2), deforms=True)
    walls = joined_faces([tank, house, fence, plate])
    assert walls is not None
    seen = {int(number): bool(bodies_among(walls, x)[walls.part == number].all()) for number in np.unique(walls.part)}
    assert seen == {1: False, 2: True, 3: False, 4: True}


@pytest.mark.parametrize("share", [0.001, 0.5])
def test_pixels_are_summed_alike_with_and_without_a_pass_over_the_picture(share: float) -> None:
    """Few particles with wide kernels, as of a coarse scene, took minutes to draw."""
    random = np.random.default_rng(1)
    at = random.integers(0, 1000, int(share * 100_000))
    more = random.random(len(at))
    total, other = np.full(100_000, 0.1), np.full(100_000, 0.1)
    _add(total, at, more)
    other += np.bincount(at, more, len(other))
    assert np.array_equal(total, other)
