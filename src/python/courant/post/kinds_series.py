"""Kinds of analyses over series: history and force of files, spectrum and toe of other analyses."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..ascii_kinds import AsciiKey, column_name
from ..histories import HistoryFile
from ..key_tables import keys as keys_of_map
from ..words import nearest_word
from ..yaml_map import Node, YamlMap, is_map, is_scalar, scalar_text
from .analyses import Analysis, Moments, Run, Settings, TimeWindow, analysis, median
from .spectrum import Spectrum, SpectrumSettings, at_equal_steps, main_peak, welch
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
        if file is None:
            return
        times = file.times_of(self.sources[0].path)
        apart = next((one for one in self.sources if not np.array_equal(file.times_of(one.path), times)), None)
        if apart is not None and apart.path in file.names:
            return self.fault(run, f"'{apart.path}' and '{self.sources[0].path}' have different times", "a gauge has its own: one analysis for each interval")
        if not self.begin_table(times, run):
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
        self.add_scalar(f"{one.name}_integral", self.units.product(one.unit, self.units.time), math.nan if gap else np.cumsum(np.append(0.0, steps[beside]))[-1])
        self.say(
            f"  {one.name}: mean {numbers['mean']:.5g} {one.unit}, deviation {numbers['deviation']:.3g}, "
            f"{float(moments.least):.5g} to {float(moments.most):.5g}\n"
        )


_COLUMN = keys_of_map("column of a history", "name text, of text!, id number, side text, factor number, unit text")
_HISTORY = keys_of_map("analysis history", "kind text!, name text!, file text, of any, id number, side text, from number, to number")


@analysis("history")
class HistoryAnalysis(_SeriesAnalysis):
    """Series of history.h5, or of one ASCII file."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_HISTORY)
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
            entry.allow(*_COLUMN)
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
        from ..ascii_histories import AsciiFile

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


_FORCE = keys_of_map("analysis force", "kind text!, name text!, contacts list, bodies list, from number, to number")


@analysis("force")
class ForceAnalysis(_SeriesAnalysis):
    """Forces on walls and bodies from history.h5."""

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_FORCE)
        # a contact's history is the force on the particles; on the walls it is the opposite
        for key, group, word, factor in (("contacts", "contacts", "contact", -1.0), ("bodies", "rigid_bodies", "body", 1.0)):
            for id in (scalar_text(node) for node in keys.list(key)):
                for component, axis in enumerate("xyz"):
                    self.sources.append(_Source(f"force_{axis}_{word}{id}", f"/{group}/{id}/force", component, factor))
        if not self.sources:
            keys.error(keys.node, f"'{keys.name}' names neither contacts nor bodies", "for example contacts: [1]")


_SPECTRUM = keys_of_map(
    "analysis spectrum",
    "kind text!, name text!, of any, only any, from number, to number, segment any, overlap any, window any, detrend any, "
    "band any",
)


@analysis("spectrum")
class SpectrumAnalysis(Analysis):
    """Power spectra of the series of another analysis."""

    needs_states = False
    longest_gap = 10  # steps

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_SPECTRUM)
        self.of, self.window = keys.text("of", required=True), TimeWindow.read(keys)
        self.only = keys.texts("only")  # of the series, or of what is before their @
        segment, overlap = keys.positive("segment"), keys.number("overlap", 0.5)
        if not 0 <= overlap < 0.95:
            keys.error(keys.get("overlap") or keys.node, f"'{keys.name}.overlap' must be 0 to 0.95, got {overlap:g}")
        window, detrend = keys.choice("window", ("hann", "rectangle")), keys.choice("detrend", ("linear", "mean"))
        self.how = SpectrumSettings(segment, overlap, window, detrend)
        self.band = keys.range("band") or (0.0, math.inf)

    def refers(self) -> list[tuple[str, str]]:
        return [("of", self.of)]

    def finish(self, run: Run) -> None:
        source = self.above(run, self.of)
        if source is None:
            return None
        series, times = source.series(), np.asarray(source.times)
        if not series:
            return self.fault(run, f"'{self.of}' has no series over time", "probe, surface, flux, history, force, toe and gauges have")
        unknown = [word for word in self.only if not any(word in (one.name, one.name.partition("@")[0]) for one in series)]
        if unknown:
            names = ", ".join(dict.fromkeys(one.name.partition("@")[0] for one in series))
            return self.fault(run, f"'{self.of}' has no series '{unknown[0]}'", f"it has {names}")
        if self.only:
            series = [one for one in series if one.name in self.only or one.name.partition("@")[0] in self.only]
        inside = np.flatnonzero(self.window.within(times))
        if len(inside) == 0 or inside[-1] + 1 - inside[0] < 8:
            return self.fault(run, "fewer than eight states are in its window in time")
        part = slice(inside[0], inside[-1] + 1)
        found = self._spectra(series, times[part], part, run)
        if not found:
            return self.fault(run, f"no series of '{self.of}' is without gaps")
        alike = len({self._unit(one) for one, _ in found}) == 1
        if not alike and not self.only:  # who names the series knows
            message = f"analysis '{self.name}': the series of '{self.of}' have different units: they have no mean"
            run.diagnostics.warning(self.where, message)
        return self._write(found, alike, len(series), times[part])

    def _spectra(self, series: list[Series], t: np.ndarray, part: slice, run: Run) -> list[tuple[Series, Spectrum]]:
        out, dt = [], (t[-1] - t[0]) / (len(t) - 1)
        self.how = SpectrumSettings(self.how.segment or 0.25 * (t[-1] - t[0]), self.how.overlap, self.how.window, self.how.detrend)
        for one in series:
            values = at_equal_steps(t, one.values[part], self.longest_gap * dt)
            if values is not None:
                out.append((one, welch(values, dt, self.how)))
                continue
            message = f"the series {one.name} of '{self.of}' has a gap of more than {self.longest_gap:g} states and is left out"
            run.diagnostics.warning(self.where, f"analysis '{self.name}': {message}")
        return out

    def _unit(self, one: Series) -> str:
        return self.units.product(f"({one.unit})2", self.units.time)

    def _write(self, found: list[tuple[Series, Spectrum]], alike: bool, all_series: int, t: np.ndarray) -> None:
        """`alike`: the series have one unit."""
        hertz, spectra = self.unit(T=-1), [spectrum for _, spectrum in found]
        first, frequency = found[0][0], spectra[0].frequency
        unit = self._unit(first) if alike else "?"
        densities = np.array([one.density for one in spectra])
        mean = Spectrum(frequency, densities.sum(axis=0) / len(spectra) if alike else np.full(len(frequency), np.nan))
        table = self.add_table()
        table.add("f", hertz, frequency)
        table.add("mean", unit, mean.density)
        for one, spectrum in found:
            table.add(one.name, self._unit(one), spectrum.density)
        peaks = [one.dominant(*self.band) for one in spectra]
        variances = [one.variance(0, frequency[-1]) for one in spectra]
        in_band = [one.variance(*self.band) / whole if whole > 0 else math.nan for one, whole in zip(spectra, variances, strict=True)]
        table = self.add_table("peaks")
        table.add("number", "-", np.arange(1, len(found) + 1))
        table.add("x", self.unit(L=1), [one.x for one, _ in found])
        table.add("f", hertz, peaks)
        table.add("density", unit, [one.top(*self.band) for one in spectra])
        table.add("deviation", first.unit if alike else "?", np.sqrt(variances))
        table.add("share_in_band", "-", in_band)
        main = main_peak(spectra, *self.band)
        bins = np.abs(np.array(peaks) - main) / frequency[1]
        table.add("bins_off", "-", bins)
        dominant, df, segments = mean.dominant(*self.band), frequency[1], spectra[0].segments
        for name, unit_of, value in (
            ("resolution", hertz, df),
            ("segments", "-", segments),
            ("dominant_of_mean", hertz, dominant),
            ("dominant_median", hertz, median(peaks)),
            ("main_peak", hertz, main),
            ("same_peak_share", "-", float((bins <= 1 + 1e-9).mean())),
        ):
            self.add_scalar(name, unit_of, value)
        of_mean = f"{dominant:.3g} {hertz} of the mean spectrum, " if alike else ""
        window = "Hann" if self.how.window == "hann" else "rectangular"
        self.say(
            f"  {len(found)} of {all_series} series, t = {t[0]:.4g} to {t[-1]:.4g}, {segments} segments of {1 / df:.4g} {self.units.time}, "
            f"{window} window, overlap {self.how.overlap:g}: resolution {df:.3g} {hertz}\n  dominant frequency: {of_mean}"
            f"{median(peaks):.3g} {hertz} in the median of the series\n"
            f"  main peak of all of one weight: {main:.3g} {hertz}; {(bins <= 1 + 1e-9).sum()} of {len(found)} series have theirs within one bin of it\n"
        )


_TOE = keys_of_map("analysis toe", "kind text!, name text!, of any, depth any, x positions, from number, to number")


@analysis("toe")
class ToeAnalysis(Analysis):
    """Where the surface first rises over a threshold, over time."""

    needs_states = False

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow(*_TOE)
        self.of, self.depth = keys.text("of", required=True), keys.positive("depth", required=True)
        self.range = keys.range("x") or (-math.inf, math.inf)
        self.window = TimeWindow.read(keys)
        self.toe = np.empty(0)

    def refers(self) -> list[tuple[str, str]]:
        return [("of", self.of)]

    def series(self) -> list[Series]:
        return [Series("toe", self.unit(L=1), math.nan, self.toe)]

    def finish(self, run: Run) -> None:
        source = self.above(run, self.of)
        if source is None:
            return None
        if source.kind != "surface":
            return self.fault(run, f"'{self.of}' is no surface but a {source.kind}")
        self.times = np.array(source.times)
        if not self.window.within(self.times).any():
            return self.fault_no_state(run)
        used = [one for one in source.series() if self.range[0] <= one.x <= self.range[1]]
        self.toe = toe_of(np.array([one.x for one in used]), np.array([one.values for one in used]), self.depth, len(self.times))
        return self._write()

    def _write(self) -> None:
        length, speed = self.unit(L=1), self.unit(L=1, T=-1)
        table = self.add_table()
        table.add("t", self.unit(T=1), self.times)
        table.add("toe", length, self.toe)
        used = self.window.within(self.times) & ~np.isnan(self.toe)
        x, t = Moments.of(self.toe[used]), Moments.of(self.times[used])
        product = ((self.toe[used] - x.mean) * (self.times[used] - t.mean)).sum()
        slope = product / float(t.squares) if t.squares > 0 else math.nan
        for name, unit, value in (("toe_mean", length, x.mean_or_nan()), ("toe_deviation", length, x.deviation()), ("toe_speed", speed, slope)):
            self.add_scalar(name, unit, value)
        self.say(
            f"  toe (depth over {self.depth:g} {length}): mean x = {x.mean_or_nan():.4g} {length}, deviation {x.deviation():.3g}, "
            f"drift {slope:.3g} {speed}\n"
        )


def toe_of(x: np.ndarray, depth: np.ndarray, threshold: float, states: int) -> np.ndarray:
    """The first crossing of a threshold along x in each state, linear between the locations; NaN: nowhere. Shape (states,) [L].

    x: (places,), depth: (places, states) [L].
    """
    out = np.full(states, np.nan)
    if len(x) == 0:
        return out
    over = depth > threshold
    first, state = over.argmax(axis=0), np.arange(states)
    met = over.any(axis=0)
    out[met & (first == 0)] = x[0]
    between = np.flatnonzero(met & (first > 0))
    k = first[between]
    a, b = depth[k - 1, state[between]], depth[k, state[between]]
    out[between] = x[k - 1] + (threshold - a) / (b - a) * (x[k] - x[k - 1])
    return out
