"""What views show of elements: beams, plane scenes from the front, one stress for all kinds, many small faces at once."""

from __future__ import annotations

import courant
import numpy as np
import pytest
from courant.post import raster
from courant.post.camera import Camera, front_of, plane_of
from courant.post.view_fields import bars_of, field_names, field_of
from courant.post.view_scene import View, scene_of
from courant.post.view_space import camera_of
from made_runs import write_fields

X = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0.5, 0], [3, 0.5, 0]])


def _run(folder, x=X, cells=((0, 1, 2, 3), (1, 4), (4, 5)), types=(9, 3, 3), **arrays):
    data = {"part": np.arange(1, len(cells) + 1, dtype="<i8"), **{name: np.asarray(values, "<f4") for name, values in arrays.items()}}
    corners = {"connectivity": np.array([k for cell in cells for k in cell], "<i8"), "offsets": np.cumsum([len(cell) for cell in cells]).astype("<i8")}
    corners["types"] = np.array(types, "<u1")
    sections = [("PointData", {"velocity": np.zeros((len(x), 3), "<f4")}), ("CellData", data), ("Points", {"Points": x.astype("<f4")}), ("Cells", corners)]
    write_fields(folder / "fields/shells_0000.vtu", sections, len(x), len(cells))
    (folder / "fields.pvd").write_text('<VTKFile><Collection><DataSet timestep="0" name="shells" file="fields/shells_0000.vtu"/></Collection></VTKFile>')
    return courant.open(folder)


def test_beams_are_part_of_a_scene(tmp_path):
    run = _run(tmp_path, stress=[[3.0, 0, 0, 0, 0, 0], [0, 0, 0, 1, 0, 0], [np.nan] * 6])
    assert len(bars_of(run.states[0].shells)) == 2
    scene = scene_of(run.states[0], View("a", "stress.mises"))
    assert scene.bars.shape == (2, 2, 3) and scene.bar_values[0] == pytest.approx(np.sqrt(3)) and np.isnan(scene.bar_values[1])
    assert scene.corners()[:, 0].max() == 3 and len(scene.shown) == 5  # four corners of the shell, one beam
    assert np.isnan(scene_of(run.states[0], View("a", "stress.mises", bare=(2,))).bar_values).all()
    both = scene_of(run.states[0], View("a", "stress.mises", mirror="x"))
    assert both.bars[:, :, 0].min() == -3 and len(both.bar_values) == 4
    alone = _run(tmp_path / "alone", X[4:], ((0, 1),), (3,))
    alone.plot(field="speed", file=tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 1000


def test_one_stress_of_all_layers(tmp_path):
    mesh = _run(tmp_path, von_mises_lower=[1, 5, np.nan], von_mises_upper=[3, 2, np.nan]).states[0].shells
    assert "von_mises" in field_names(mesh)
    np.testing.assert_array_equal(field_of(mesh, "von_mises").values, [3, 5, np.nan])
    tensors = _run(tmp_path / "t", stress_upper=[[2.0, 0, 0, 0, 0, 0]] * 3).states[0].shells
    np.testing.assert_allclose(field_of(tensors, "von_mises").values, 2)
    assert "von_mises" not in field_names(_run(tmp_path / "n").states[0].shells)


_FRONTS = [("z", "z", "x", "y"), ("z", "-y", "x", "-y"), ("y", "z", "x", "z"), ("x", "z", "y", "z"), ("x", "x", "y", "z"), ("y", "x", "y", "")]


@pytest.mark.parametrize(("normal", "up", "right", "above"), _FRONTS)
def test_plane_scenes_are_seen_from_the_front(normal, up, right, above):
    of_front = front_of(normal, up)
    camera = Camera.looking(*of_front)
    assert abs(camera.toward["xyz".index(normal)]) == pytest.approx(1)
    if above:
        sign = -1 if above.startswith("-") else 1
        assert camera.up["xyz".index(above[-1])] == pytest.approx(sign) and abs(camera.right["xyz".index(right)]) == pytest.approx(1)


def test_what_is_plane(tmp_path):
    assert plane_of(X) == "z" and plane_of(X[:, [2, 0, 1]]) == "x" and plane_of(X[:2]) == "" and plane_of(np.eye(3)) == ""
    run = _run(tmp_path, plastic_strain=[0, 0, 1])
    view = View("a", "plastic_strain")
    assert abs(camera_of(run, view, [scene_of(run.states[0], view)]).toward[2]) == pytest.approx(1)
    view = View("a", "plastic_strain", azimuth=30.0)
    assert abs(camera_of(run, view, [scene_of(run.states[0], view)]).toward[2]) < 0.9


def test_many_small_faces_look_as_each_alone(monkeypatch):
    n = 40
    i, k = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    x = np.column_stack([0.1 * i.ravel(), 0.1 * k.ravel(), np.sin(0.2 * i.ravel())])
    low = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    corners = np.column_stack([low, low + n + 1, low + n + 2, low + 1])
    colour, normals = np.repeat(np.linspace(0, 1, n * n)[:, None], 3, axis=1), np.tile([0.0, 0, 1], (n * n, 1))
    made = []
    for many in (10**9, 0):
        monkeypatch.setattr(raster, "_MANY", many)
        made.append(raster.Raster(-0.1, 4.1, 126, 126, 30.0))
        made[-1].faces(x, corners, colour, normals, lines=False)
    np.testing.assert_allclose(made[0].depth, made[1].depth, atol=1e-9)
    np.testing.assert_allclose(made[0].colour, made[1].colour, atol=1e-5)
    assert made[0].lit.mean() > 0.8
