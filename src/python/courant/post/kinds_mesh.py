"""Kind of analysis that writes the surface of the water as a mesh: surface_mesh."""

from __future__ import annotations

import numpy as np

from ..fields import Wanted
from ..files import make_folder, write_file
from ..key_tables import keys as keys_of_map
from ..surface_mesh import NoSurface, SurfaceMesh, surface_mesh
from ..yaml_map import YamlMap
from .analyses import Analysis, Run, Settings, TimeWindow, analysis
from .state import State, read_quantities, read_spray, read_where, wanted_of
from .tables import Series


_SURFACE_MESH = keys_of_map("analysis surface_mesh", "kind text!, name text!, of any, where text, link number, share number, cell any, level any, from number, to number")


@analysis("surface_mesh")
class SurfaceMeshAnalysis(Analysis):
    """The surface of the water of each state: triangles in space, lines in the plane, as .vtp for ParaView; what it encloses over time."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_SURFACE_MESH)
        self.of = read_quantities(keys, self.units) if keys.has("of") else []
        self.which, self.spray, self.window = read_where(keys), read_spray(keys), TimeWindow.read(keys)
        self.cell = keys.positive("cell", 0.0) if keys.has("cell") else None
        self.level = keys.positive("level", 0.5)
        if not self.level < 1:
            keys.error(keys.get("level") or keys.node, f"'{keys.name}.level' must be below 1, got {self.level:g}", "0.5 is where the water ends")
        self.numbers: list[tuple[float, float, float]] = []
        self.dim, self.empty, self.why = 2, 0, ""
        self.pvd = '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n'

    def needs(self) -> list[Wanted]:
        return wanted_of(self.which.of, *(one.of for one in self.of))

    def looks_at(self, t: float, slack: float) -> bool:
        return bool(self.window.holds(t, slack))

    def measure(self, state: State) -> SurfaceMesh | str:
        water = state.water(self.which, self.spray)
        values = {one.name: state.evaluate(one.of)[water.row] for one in self.of}
        try:
            return surface_mesh(water.x, water.V, water.h, water.dim, cell=self.cell, level=self.level, values=values, t=state.t)
        except NoSurface as fault:
            return str(fault)

    def take(self, t: float, slack: float, measured: SurfaceMesh | str) -> None:
        self.times.append(t)
        if isinstance(measured, str):
            self.empty, self.why = self.empty + 1, measured
            self.numbers.append((0.0, 0.0, 0.0))
            return
        self.dim = measured.dim
        self.numbers.append((measured.volume(), measured.size(), float(len(measured.cells))))
        name = f"{self.name}_{len(self.times) - 1:04d}.vtp"
        make_folder(self.out / self.name)
        measured.write(self.out / self.name / name)
        self.pvd += f'<DataSet timestep="{t:.9g}" part="0" file="{self.name}/{name}"/>\n'

    def series(self) -> list[Series]:
        values = np.array(self.numbers).reshape(-1, 3)
        heads = (("area", "length", "lines"), ("volume", "area", "triangles"))[self.dim - 2]
        units = (self.unit(L=self.dim), self.unit(L=self.dim - 1), "-")
        return [Series(name, unit, np.nan, values[:, c]) for c, (name, unit) in enumerate(zip(heads, units, strict=True))]

    def finish(self, run: Run) -> None:
        if not self.times:
            return self.fault_no_state(run)
        if self.empty == len(self.times):
            return self.fault(run, f"no state has a surface: {self.why}", "'where' says which particles are water")
        inside = self.window.within(np.array(self.times))
        self.table_over_time()
        self.add_moments(inside)
        write_file(self.out / f"{self.name}.pvd", self.pvd + "</Collection>\n</VTKFile>\n")
        self.say(f"  surfaces of {len(self.times) - self.empty} states, {self.numbers[-1][2]:.0f} {'lines' if self.dim == 2 else 'triangles'} in the last\n")
        if self.empty:
            self.add_scalar("states_without_a_surface", "-", self.empty)
        return None
