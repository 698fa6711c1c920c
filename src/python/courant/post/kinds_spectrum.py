"""Kind of analysis: spectrum."""

from __future__ import annotations

import math

import numpy as np

from ..yaml_map import YamlMap
from .analysis import Analysis, Run, Settings, TimeWindow, analysis, median
from .spectrum import Spectrum, SpectrumSettings, at_equal_steps, welch
from .tables import Series


@analysis("spectrum")
class SpectrumAnalysis(Analysis):
    """Power spectra of the series of another analysis."""

    needs_states = False
    longest_gap = 10  # steps

    def __init__(self, keys: YamlMap, settings: Settings) -> None:
        super().__init__(keys, settings)
        keys.allow("kind", "name", "of", "from", "to", "segment", "overlap", "window", "detrend", "band")
        self.of, self.window = keys.text("of", required=True), TimeWindow.read(keys)
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
            return self.fault(run, f"'{self.of}' has no series over time", "probe, surface, flux, history, force and toe have")
        inside = np.flatnonzero(self.window.within(times))
        if len(inside) == 0 or inside[-1] + 1 - inside[0] < 8:
            return self.fault(run, "fewer than eight states are in its window in time")
        part = slice(inside[0], inside[-1] + 1)
        found = self._spectra(series, times[part], part, run)
        if not found:
            return self.fault(run, f"no series of '{self.of}' is without gaps")
        alike = len({self._unit(one) for one, _ in found}) == 1
        if not alike:
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
        return f"({one.unit})2 {self.units.time}"

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
        dominant, df, segments = mean.dominant(*self.band), frequency[1], spectra[0].segments
        for name, unit_of, value in (
            ("resolution", hertz, df),
            ("segments", "-", segments),
            ("dominant_of_mean", hertz, dominant),
            ("dominant_median", hertz, median(peaks)),
        ):
            self.add_scalar(name, unit_of, value)
        window = "Hann" if self.how.window == "hann" else "rectangular"
        self.say(
            f"  {len(found)} of {all_series} series, t = {t[0]:.4g} to {t[-1]:.4g}, {segments} segments of {1 / df:.4g} {self.units.time}, "
            f"{window} window, overlap {self.how.overlap:g}: resolution {df:.3g} {hertz}\n  dominant frequency: {dominant:.3g} {hertz} of the "
            f"mean spectrum, {median(peaks):.3g} {hertz} in the median of the series\n"
        )
