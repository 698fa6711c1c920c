"""Kinds of analyses over histories: series of history.h5 and of ASCII files, and forces on walls and bodies among them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..ascii_histories import AsciiFile, AsciiKey
from ..histories import HistoryFile
from ..results import column_name
from ..words import nearest_word
from ..yaml_map import Node, YamlMap, is_map, is_scalar, scalar_text
from .analysis import Analysis, Moments, Run, Settings, TimeWindow, analysis
from .tables import Series


@dataclass
class _Source:
    """One column: a component of a dataset, or a series of an ASCII file, times a factor. `unit` "": from the dimension in the file."""

    name: str
    path: str = ""
    component: int = 0
    factor: float = 1.0
    unit: str = ""
    key: AsciiKey = AsciiKey("")


def _split(text: str) -> tuple[str, int] | None:
    """ "contacts/1/force.x" -> path and component. None where the component is none."""
    path = text if text.startswith("/") else f"/{text}"
    path, dot, axis = path.rpartition(".")
    if not dot:
        return axis, 0
    return (path, "xyz".index(axis)) if axis in ("x", "y", "z") else None


class _SeriesAnalysis(Analysis):
    """Numbers of series over time in a window: mean, deviation, extremes, integral."""

    needs_states = False

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        self.window = TimeWindow.read(keys)
        self.sources: list[_Source] = []
        self.found: list[Series] = []
        self.inside = np.empty(0, dtype=bool)

    def series(self) -> list[Series]:
        return self.found

    def finish(self, run: Run) -> None:
        self.take_h5(run)

    def take_h5(self, run: Run) -> None:
        file = HistoryFile.open(run.folder / "history.h5", run.diagnostics)
        if file is None or not self.begin_table(file.times, run):
            return
        for source in self.sources:
            values = file.column(source.path, source.component)
            if values is None:
                near = nearest_word(source.path, file.names)
                message = f"history.h5 has no dataset '{source.path}' with component {source.component}"
                self.fault(run, message, f"did you mean {near}?" if near else "h5ls -r history.h5 lists them")
            else:
                self.add_column(source, values, self.units.of_text(file.dimension(source.path)))

    def begin_table(self, times: np.ndarray, run: Run) -> bool:
        """False: no state is in the window."""
        self.times = times
        self.inside = self.window.within(times)
        if not self.inside.any():
            self.fault_no_state(run)
            return False
        self.add_table().add("t", self.unit(T=1), times)
        return True

    def add_column(self, source: _Source, values: np.ndarray, unit_of_file: str) -> None:
        one = Series(source.name, source.unit or unit_of_file, math.nan, values * source.factor)
        self.found.append(one)
        self.result.tables[0].add(one.name, one.unit, one.values)
        self._add_numbers(one)

    def _add_numbers(self, one: Series) -> None:
        values, t = one.values[self.inside], self.times[self.inside]
        moments = Moments.of(values)
        there = moments.n > 0
        beside = np.flatnonzero(self.inside)[1:] == np.flatnonzero(self.inside)[:-1] + 1
        steps = 0.5 * np.diff(t) * (values[1:] + values[:-1])
        numbers = {
            "mean": moments.mean_or_nan(),
            "deviation": moments.deviation(),
            "least": float(moments.least) if there else math.nan,
            "most": float(moments.most) if there else math.nan,
        }
        for name, value in numbers.items():
            self.add_scalar(f"{one.name}_{name}", one.unit, value)
        gap = bool(np.isnan(values).any())
        self.add_scalar(f"{one.name}_integral", f"{one.unit} {self.units.time}", math.nan if gap else np.cumsum(np.append(0.0, steps[beside]))[-1])
        self.say(
            f"  {one.name}: mean {numbers['mean']:.5g} {one.unit}, deviation {numbers['deviation']:.3g}, "
            f"{float(moments.least):.5g} to {float(moments.most):.5g}\n"
        )


@analysis("history")
class HistoryAnalysis(_SeriesAnalysis):
    """Series of history.h5, or of one ASCII file."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow("kind", "name", "file", "of", "id", "side", "from", "to")
        self.file = keys.text("file")
        common = self._owner(keys, AsciiKey(""))
        self.sources = [self._source(keys, node, common) for node in keys.list("of", required=True)]

    def _owner(self, keys: YamlMap, common: AsciiKey) -> AsciiKey:
        """id, side: what a series of an ASCII file belongs to."""
        for word in ("id", "side"):
            if (node := keys.get(word)) is not None and not self.file:
                hint = "a dataset of history.h5 has its id in its name: contacts/1/force.x"
                keys.error(node, f"'{keys.name}.{word}' goes with 'file', an ASCII history", hint)
        node = keys.get("id")
        id = None if node is None else keys.scalar(node, "id")
        if id is not None:
            if id != math.floor(id) or id < 0:
                keys.error(keys.get("id") or keys.node, f"'{keys.name}.id' must be an id")
            common = common._replace(id=int(id))
        return common._replace(side=keys.text("side", common.side))

    def _source(self, keys: YamlMap, node: Node, common: AsciiKey) -> _Source:
        out = _Source("", key=common)
        text = scalar_text(node)
        if is_map(node):
            entry = keys.element(node, "of")
            entry.allow("name", "of", "id", "side", "factor", "unit")
            out.name, text = entry.text("name", required=True), entry.text("of", required=True)
            out.factor, out.unit = entry.number("factor", 1.0), entry.text("unit")
            out.key = self._owner(entry, common)
        elif is_scalar(node):
            out.name = text
        if self.file:
            out.key = out.key._replace(name=text)
            out.name = column_name(out.key) if is_scalar(node) else out.name
            if not text:
                hint = "for example kinetic energy, or {name: px, of: x-mom, id: 1}"
                keys.error(node, f"'{keys.name}.of' must name a series of {self.file}", hint)
            return out
        found = _split(text)
        if found is None or not text:
            hint = "for example contacts/1/force.x or global/kinetic"
            keys.error(node, f"'{keys.name}.of' must name a dataset of history.h5, got '{text}'", hint)
        else:
            out.path, out.component = found
        return out

    def finish(self, run: Run) -> None:
        if not self.file:
            return self.take_h5(run)
        # a plain name is a file of the run, any other path counts from the recipe
        return self._take_ascii((Path(self.where.file).parent if "/" in self.file else run.folder) / self.file, run)

    def _take_ascii(self, path: Path, run: Run) -> None:
        file = AsciiFile.open(path, run.diagnostics)
        if file is None or not self.begin_table(file.times, run):
            return
        repeated = file.times[:-1][np.diff(file.times) == 0]
        if len(repeated):
            why = "as it prints few digits: integrals and spectra of it are coarse"
            message = f"{path} has states with the same time, {repeated[0]:g}, {why}"
            run.diagnostics.warning(self.where, f"analysis '{self.name}': {message}", "history.h5 has all digits")
        for source in self.sources:
            key, why, hint = file.find(source.key)
            if key is None:
                self.fault(run, f"{path}: {why}", hint)
            else:
                self.add_column(source, file.columns[key], self.units.of_text(file.dimension(key)))


@analysis("force")
class ForceAnalysis(_SeriesAnalysis):
    """Forces on walls and bodies from history.h5."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow("kind", "name", "contacts", "bodies", "from", "to")
        # a contact's history is the force on the particles; on the walls it is the opposite
        for key, group, word, factor in (("contacts", "contacts", "contact", -1.0), ("bodies", "rigid_bodies", "body", 1.0)):
            for id in (scalar_text(node) for node in keys.list(key)):
                for component, axis in enumerate("xyz"):
                    self.sources.append(_Source(f"force_{axis}_{word}{id}", f"/{group}/{id}/force", component, factor))
        if not self.sources:
            keys.error(keys.node, f"'{keys.name}' names neither contacts nor bodies", "for example contacts: [1]")
