"""The surface of the water as a mesh: volumes and radii that are known."""
from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules.vtkFiltersCore")

from courant.surface_mesh import NoSurface, SurfaceMesh, surface_mesh


def lattice(dim: int, dx: float, low: float = -0.5, high: float = 0.5) -> np.ndarray:
    """Centres of cells of a cube, (n, 3); z = 0 in the plane."""
    one = np.arange(low + dx / 2, high, dx)
    out = np.zeros((len(one) ** dim, 3))
    out[:, :dim] = np.stack(np.meshgrid(*[one] * dim, indexing="ij"), -1).reshape(-1, dim)
    return out


def mesh_of(x: np.ndarray, dim: int, dx: float, **keys: object) -> SurfaceMesh:
    return surface_mesh(x, np.full(len(x), dx**dim), np.full(len(x), 2 * dx), dim, **keys)  # type: ignore[arg-type]


@pytest.mark.parametrize(("dim", "dx"), [(2, 0.05), (2, 0.025), (3, 0.05)])
def test_a_box_has_its_volume(dim: int, dx: float) -> None:
    mesh = mesh_of(lattice(dim, dx), dim, dx)
    assert mesh.volume() == pytest.approx(1, abs=0.02)
    assert mesh.size() == pytest.approx(2 * dim, rel=0.08)
    assert abs(mesh.points[:, :dim]).max() == pytest.approx(0.5, abs=0.1 * dx)


@pytest.mark.parametrize("dim", [2, 3])
def test_a_drop_has_its_radius(dim: int) -> None:
    """Of the particles' volume; a lattice has steps at its edge."""
    dx = 0.04
    x = lattice(dim, dx)
    x = x[(x**2).sum(axis=1) < 0.4**2]
    volume = len(x) * dx**dim
    radius = math.sqrt(volume / math.pi) if dim == 2 else (volume * 3 / (4 * math.pi)) ** (1 / 3)
    r = np.sqrt((mesh_of(x, dim, dx).points ** 2).sum(axis=1))
    assert abs(r - radius).max() < 0.6 * dx and r.mean() == pytest.approx(radius, rel=0.02)


def test_a_level_is_a_line() -> None:
    """Above the middle of water in a box."""
    dx = 0.02
    x = lattice(2, dx)
    x = x[x[:, 1] < 0.1]
    line = mesh_of(x, 2, dx).points
    top = line[(abs(line[:, 0]) < 0.4) & (line[:, 1] > 0)]
    assert len(top) > 50 and abs(top[:, 1] - 0.1).max() < 0.05 * dx


def test_values_are_those_of_the_water_beside_it() -> None:
    x = lattice(3, 0.1)
    mesh = mesh_of(x, 3, 0.1, values={"x": x, "one": np.ones(len(x))})
    np.testing.assert_allclose(mesh.values["one"], 1, rtol=1e-12)
    assert abs(mesh.values["x"] - mesh.points).max() < 0.08


def test_files_hold_the_mesh(tmp_path: Path) -> None:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    for dim in (2, 3):
        mesh = mesh_of(lattice(dim, 0.1), dim, 0.1, values={"v": np.ones((10**dim, 3))}, t=1.5)
        mesh.write(tmp_path / "m.vtp")
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(tmp_path / "m.vtp"))
        reader.Update()
        out = reader.GetOutput()
        assert out.GetNumberOfPoints() == len(mesh.points) and out.GetNumberOfCells() == len(mesh.cells)
        assert (out.GetNumberOfLines() if dim == 2 else out.GetNumberOfPolys()) == len(mesh.cells)
        assert out.GetPointData().GetArray("v").GetNumberOfComponents() == 3


def test_faults() -> None:
    x = lattice(2, 0.1)
    with pytest.raises(NoSurface, match="no particle"):
        mesh_of(x[:0], 2, 0.1)
    with pytest.raises(NoSurface, match="larger cell"):
        mesh_of(x, 2, 0.1, cell=1e-6)
    for cell in (10.0, 0.0, -1.0, float("nan")):
        with pytest.raises(NoSurface, match="do not fit"):
            mesh_of(x, 2, 0.1, cell=cell)
    with pytest.raises(NoSurface, match="between 0 and 1"):
        mesh_of(x, 2, 0.1, level=1.0)


def test_states_and_recipes_give_it(tmp_path: Path) -> None:
    import courant
    from courant.diagnostics import Diagnostics
    from courant.post import run_post
    from made_runs import frame
    from made_runs import lattice as water
    from made_runs import write_run

    write_run(tmp_path, [frame(water(x1=1.0, y1=0.1), t=0.1 * s, v=lambda x, y: x) for s in range(3)], "still water")
    state = courant.open(tmp_path).states[-1]
    mesh = state.surface_mesh(["velocity"])
    assert mesh.dim == 2 and mesh.volume() == pytest.approx(0.1, rel=0.02) and mesh.values["velocity"].shape == (len(mesh.points), 3)
    left = state.surface_mesh(where=state.points[:, 0] < 0.5)
    assert left.volume() == pytest.approx(0.05, rel=0.02) and left.points[:, 0].max() < 0.52
    recipe = tmp_path / "recipe.yaml"
    recipe.write_text("analyses:\n  - {kind: surface_mesh, name: level, of: [vx], from: 0.1}\n")
    diagnostics = Diagnostics()
    assert run_post(recipe, tmp_path, lambda _: None, diagnostics), diagnostics.text()
    head, *rows = (tmp_path / "post" / "level.csv").read_text().splitlines()
    assert head == "t [s],area [m2],length [m],lines [-]" and len(rows) == 2
    assert float(rows[0].split(",")[1]) == pytest.approx(0.1, rel=0.02)
    assert len(list((tmp_path / "post" / "level").glob("*.vtp"))) == 2 and 'timestep="0.1"' in (tmp_path / "post" / "level.pvd").read_text()
    for entry, message in (("level: 1.2", "'level.level' must be below 1"), ("where: 0", "no state has a surface: there is no particle"), ("celll: 1", "'level' does not know the key 'celll'")):
        recipe.write_text(f"analyses:\n  - {{kind: surface_mesh, name: level, {entry}}}\n")
        diagnostics = Diagnostics()
        assert not run_post(recipe, tmp_path, lambda _: None, diagnostics) and message in diagnostics.text(), diagnostics.text()
