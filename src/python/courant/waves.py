"""Waves of a piston or a flap: the displacement that makes them, by linear theory and beyond, as numbers over time.

made = Waves("regular", depth=0.5, height=0.08, period=1.4)
made.displacement(end=20)    # (n, 2): time, displacement of the paddle at the still level, towards the water
made.elevation(x=3, t=...)   # what theory expects there, by linear theory
made.at_paddle(end=20)       # (n, 2): time, elevation at the paddle with the near field, which does not travel
"""
from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

MAKERS = ("piston", "flap")
KINDS = ("regular", "second_order", "focused", "jonswap", "pierson_moskowitz", "solitary", "elevation")
_STEPS = 80  # of the displacement, in a period
_RAMP = 2.0  # periods over which waves grow
_MOST_ROWS = 1_000_000  # of a displacement: a typing error in a period does not fill the memory
_SHALLOWEST = 1e-3  # least wave number times depth: a piston would go a thousand heights of the wave
_SIZES = (1e-12, 1e12)  # smallest and largest height, depth, period: powers of them stay finite
_DEEPEST = 200.0  # wave number times depth: functions of it have their limits long before, and stay finite
_MOST_LAG = 1.2  # of a filter, whose amplitude is 0.36 there: waves of five distances of the measured level [rad]
GAMMA = (1.0, 20.0)  # smallest and largest; measured spectra have 1 to 7
COMPONENTS = (2, 10000)  # fewest and most; one component has no spectrum


class WaveFault(ValueError):
    """Waves that cannot be made; the text says why. `key`: the value at fault, where it is one; `hint`: what to do."""

    def __init__(self, message: str, key: str = "", hint: str = "") -> None:
        super().__init__(message)
        self.key, self.hint = key, hint


class Components(NamedTuple):
    """Waves that add up: amplitudes [L], angular frequencies [1/T], phases [-], all (n,)."""

    amplitude: np.ndarray
    omega: np.ndarray
    phase: np.ndarray


class Absorption(NamedTuple):
    """`factor` of the velocity of long waves [-], and `delay`, the time constant of the filter of the measured level [T]."""

    factor: float
    delay: float


def wave_number(omega: np.ndarray | float, depth: float, g: float = 9.81) -> np.ndarray:
    """k of the dispersion relation omega^2 = g k tanh(k d), by Newton's method. [1/L]"""
    omega = np.asarray(omega, dtype=float)
    a = omega**2 * depth / g
    kd = np.where(a > 1, a, np.sqrt(a))  # the limits of deep and of shallow water
    for _ in range(50):
        t = np.tanh(kd)
        kd = kd - (kd * t - a) / np.maximum(t + kd * (1 - t * t), 1e-300)
    return kd / depth


def piston_transfer(kd: np.ndarray | float) -> np.ndarray:
    """Height of the wave over the stroke of a piston. Source: Biesel and Suquet, La Houille Blanche 6 (1951); Dean and Dalrymple (1991), eq. 6.25."""
    kd = np.asarray(kd, dtype=float)
    grows = np.minimum(2 * kd, 300.0)  # 2 beyond, without an overflow
    return 2 * (np.cosh(grows) - 1) / (np.sinh(grows) + 2 * kd)


def flap_transfer(kd: np.ndarray | float, hinge: float = 0.0) -> np.ndarray:
    """Height of the wave over the stroke at the still level of a flap. `hinge`: its height above the bed over the depth, below 1; < 0: below the bed.

    Source: Biesel and Suquet (1951); Dean and Dalrymple (1991), eq. 6.26 for a hinge at the bed.
    """
    kd = np.asarray(kd, dtype=float)
    k = np.minimum(kd, 300.0)
    lowest = np.cosh(k * max(hinge, 0.0))
    return 4 * np.sinh(k) * (np.sinh(k) - (np.cosh(k) - lowest) / (k * (1 - hinge))) / (np.sinh(2 * k) + 2 * k)


def _evanescent(omega: np.ndarray | float, depth: float, g: float, terms: int) -> np.ndarray:
    """k d of the modes that fade from the paddle: omega^2 d/g = - k d tan(k d), one in each (j - 1/2) pi to j pi. (frequencies, terms) [-]"""
    ratio = np.atleast_1d(np.asarray(omega, dtype=float)) ** 2 * depth / g
    j = np.arange(1, terms + 1)[None]
    low, high = (j - 0.5) * math.pi + 0 * ratio[:, None], j * math.pi + 0 * ratio[:, None]
    for _ in range(60):
        middle = 0.5 * (low + high)
        above = middle * np.sin(middle) + ratio[:, None] * np.cos(middle)
        upper = np.sign(above) == np.sign(high * np.sin(high) + ratio[:, None] * np.cos(high))
        low, high = np.where(upper, low, middle), np.where(upper, middle, high)
    return 0.5 * (low + high)


def near_field(omega: np.ndarray | float, depth: float, g: float = 9.81, hinge: float | None = None, terms: int = 200, away: float = 0.0) -> np.ndarray:
    """Elevation beside the paddle that does not travel, over the displacement at the still level: the sum of the evanescent modes.
    `hinge`: of a flap, above the bed [L]; None: a piston. `away`: distance from the paddle [L].

    Source: Biesel and Suquet (1951); Dean and Dalrymple (1991), section 6.3.
    """
    k = _evanescent(omega, depth, g, terms)
    shape = np.sin(k)
    if hinge is not None:
        shape = shape + (np.cos(k) - np.cos(k * max(hinge, 0.0) / depth)) / (k * (1 - hinge / depth))
    return (4 * np.sin(k) * shape / (2 * k + np.sin(2 * k)) * np.exp(-k * away / depth)).sum(axis=1)


def second_order_piston(omega: float, depth: float, half_stroke: float, g: float = 9.81, terms: int = 100) -> complex:
    """X2 of the displacement Re(X2 exp(-2 i omega t)) beside half_stroke sin(omega t), with which no free wave of 2 omega leaves a piston. [L]

    The modes Re(a_j cosh k_j(z + d)/cosh(k_j d) exp(i k_j x - i omega t)), one that travels and those that fade, force a bound potential
    of second order for each pair. The kinematic condition on the moved paddle adds free waves; X2 makes the one that travels 0.
    In the limit of long waves it is that of Madsen, J. Geophys. Res. 76 (1971), eq. 27; at k d = 0.9 it is twice as large.
    Source: Schaffer, Ocean Eng. 23 (1996), sections 2 to 4.
    """
    k = np.concatenate([wave_number(np.array([omega]), depth, g) + 0j, 1j * _evanescent(omega, depth, g, terms)[0] / depth])
    free = float(wave_number(2 * omega, depth, g))
    stroke, ratio = 1j * half_stroke, omega**2 / g
    tanh = np.tanh(np.minimum(k.real * depth, _DEEPEST) + 1j * k.imag * depth)
    sech2 = 1 - tanh**2
    a = -omega * stroke * tanh / (k**2 * (depth / 2 * sech2 + tanh / (2 * k)))
    both = k[:, None] + k[None]
    tanh_both = np.tanh(np.minimum(both.real * depth, _DEEPEST) + 1j * both.imag * depth)
    forced = 1j * omega * a[:, None] * a[None] * (1.5 * ratio**2 - k[:, None] * k[None] - (k[:, None] ** 2 + k[None] ** 2) / 4)
    bound = forced / (-4 * omega**2 + g * both * tanh_both)
    tanh_free = math.tanh(min(free * depth, _DEEPEST))

    def in_free(q: np.ndarray, tanh_q: np.ndarray) -> np.ndarray:
        """Integral over the depth of cosh q(z + d)/cosh(q d) times the free mode, over cosh(free d)."""
        return (q * tanh_q - free * tanh_free) / (q**2 - free**2)

    moved = 0.5 * stroke * (a * k**2 * in_free(k, tanh)).sum() - (1j * both * bound * in_free(both, tanh_both)).sum()
    return complex(moved * free / (2j * omega * tanh_free))


def breaking_height(wave: float, depth: float) -> float:
    """The highest wave of a wave number: 0.142 L tanh(k d). Source: Miche, Annales des Ponts et Chaussees 114 (1944). [L]"""
    return 0.142 * 2 * math.pi / wave * math.tanh(wave * depth)


def jonswap(f: np.ndarray, height: float, period: float, gamma: float) -> np.ndarray:
    """Density of the elevation over the frequency, scaled to H_m0 = height; gamma 1: Pierson and Moskowitz. [L2 T]

    Source: Goda, Random Seas and Design of Maritime Structures (2000), section 2.3.
    """
    peak = 1 / period
    width = np.where(f <= peak, 0.07, 0.09)
    shape = f**-5.0 * np.exp(-1.25 * (peak / f) ** 4) * gamma ** np.exp(-((f / peak - 1) ** 2) / (2 * width**2))
    return shape * height**2 / 16 / float(np.sum(0.5 * np.diff(f) * (shape[1:] + shape[:-1])))


@dataclass
class Waves:
    """`kind`: of KINDS. `depth` of the water at the piston, `height` (of irregular and focused waves H_m0, and the height of the crest at the focus) [L];
    `period` (of the peak) [T]; `seed` and `gamma` of irregular ones; `focus`: distance from the piston and time, which focused waves need; `record`: (n, 2) time and elevation at the
    piston. `ramp`: periods over which waves grow from nothing. `maker`: of MAKERS; `hinge`: height of that of a flap above the bed, < 0: below it [L]."""

    kind: str
    depth: float
    height: float = 0.0
    period: float = 0.0
    g: float = 9.81
    seed: int = 1
    gamma: float = 3.3
    focus: tuple[float, float] | None = None
    components: int = 200
    ramp: float = _RAMP
    maker: str = "piston"
    hinge: float = 0.0
    record: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise WaveFault(f"no kind of waves '{self.kind}': {', '.join(KINDS)}", "kind")
        if not (self.g > 0 and math.isfinite(self.g)):
            raise WaveFault(f"gravity is {self.g:g}: waves need one above 0")
        self._check_size("depth", "depth of the water")
        self._check_maker()
        if not (self.ramp >= 0 and math.isfinite(self.ramp)):
            raise WaveFault(f"the ramp is {self.ramp:g}: it must be 0 or more periods", "ramp", "ramp: 2, or 0 for waves that begin at once")
        if self.kind == "elevation":
            self._check_record()
            return
        self._check_size("height", "height of the waves")
        if self.kind == "solitary":
            if self.height > 0.78 * self.depth:
                raise WaveFault(f"a solitary wave of {self.height:g} in a depth of {self.depth:g} breaks: at most 0.78 of the depth", "height")
            return
        self._check_size("period", "period of the waves")
        if not self.wave * self.depth > _SHALLOWEST:
            raise WaveFault(f"the period of the waves is {self.period:g}: too long for a depth of {self.depth:g}", "period", "a shorter period")
        highest = breaking_height(self.wave, self.depth)
        if self.height > highest:
            raise WaveFault(f"waves of height {self.height:g} and period {self.period:g} break in a depth of {self.depth:g}: at most {highest:.3g}", "height")
        if self.kind not in ("regular", "second_order"):
            self._check_spectrum()

    def _check_size(self, key: str, name: str) -> None:
        value = getattr(self, key)
        if not _SIZES[0] <= value <= _SIZES[1]:
            raise WaveFault(f"the {name} is {value:g}: it must be above 0" + (f", from {_SIZES[0]:g} to {_SIZES[1]:g}" if value > 0 else ""), key)

    def _check_maker(self) -> None:
        if self.maker not in MAKERS:
            raise WaveFault(f"no wave maker '{self.maker}': {', '.join(MAKERS)}", "maker")
        if self.maker == "piston" and self.hinge:
            raise WaveFault("a piston has no hinge", "hinge", "maker: flap")
        if not (math.isfinite(self.hinge) and self.hinge < 0.9 * self.depth):
            raise WaveFault(f"the hinge is {self.hinge:g} above the bed in a depth of {self.depth:g}: it must be below 0.9 of the depth", "hinge")
        if self.maker == "flap" and self.kind in ("second_order", "solitary"):
            raise WaveFault(f"a flap makes no waves of kind {self.kind}: their theory is that of a piston", "maker", "maker: piston")

    def _check_record(self) -> None:
        r = self.record
        if r.ndim != 2 or r.shape[1] != 2 or len(r) < 8 or not np.isfinite(r).all() or not (np.diff(r[:, 0]) > 0).all():
            raise WaveFault("a record has eight rows or more of time and elevation, with times that go upwards", "record")
        if not np.ptp(r[:, 1]) > 0:
            raise WaveFault(f"the record is {r[0, 1]:g} at all times: it has no waves", "record")

    def _check_spectrum(self) -> None:
        """Numbers of a spectrum; what is out of range would give values that are not numbers, or a traceback of numpy."""
        for key, (least, most) in {"components": COMPONENTS, "seed": (0, 2**53)}.items():
            value = getattr(self, key)
            if not least <= value <= most or value != int(value):
                raise WaveFault(f"{key} is {value:g}: expected a whole number from {least} to {most}", key)
        if not GAMMA[0] <= self.gamma <= GAMMA[1]:
            raise WaveFault(f"gamma is {self.gamma:g}: expected {GAMMA[0]:g} to {GAMMA[1]:g}", "gamma", "3.3 is that of the North Sea, 1 gives pierson_moskowitz")
        if self.kind != "focused":
            return
        if self.focus is None:
            raise WaveFault("focused waves need 'focus'", "focus", "focus: [distance from the wall, time]")
        if not all(math.isfinite(value) for value in self.focus) or not (self.focus[0] >= 0 and self.focus[1] > 0):
            raise WaveFault(f"focus is {self.focus[0]:g}, {self.focus[1]:g}: expected a distance of 0 or more and a time above 0", "focus")

    @property
    def omega(self) -> float:
        return 2 * math.pi / self.period

    @property
    def wave(self) -> float:
        """Wave number of the period [1/L]."""
        return float(wave_number(self.omega, self.depth, self.g))

    def group_velocity(self) -> float:
        """Of waves of the period [L/T]."""
        kd = min(self.wave * self.depth, _DEEPEST)
        return 0.5 * self.omega / self.wave * (1 + 2 * kd / math.sinh(2 * kd))

    def transfer(self, kd: np.ndarray | float) -> np.ndarray:
        """Height of the wave over the stroke of the maker at the still level."""
        return piston_transfer(kd) if self.maker == "piston" else flap_transfer(kd, self.hinge / self.depth)

    def _near_field(self, omega: np.ndarray | float, away: float) -> np.ndarray:
        return near_field(omega, self.depth, self.g, self.hinge if self.maker == "flap" else None, away=away)

    def absorption(self, away: float = 0.0, drift: float = 0.0) -> Absorption:
        """At which the maker absorbs waves of the period exactly by linear theory, with a level that is measured at the distance `away` from the paddle,
        and the time constant `drift` of the return to the curve (0: none). Factor 1 and delay 0 of kinds without one period.

        At `away`, a wave eta that comes back is exp(i k away) eta, and the paddle, which moves at u, adds its near field e u/(i omega). With
        u = - F times their sum, u = - omega/c0 eta needs F (exp(i k away) + i e/c0) = omega/c0. The filter of the drift leads by the phase that the delay
        adds to that of F, and both change the amplitude.
        """
        if self.kind in ("solitary", "elevation"):
            return Absorption(1.0, 0.0)
        arm = self.depth - self.hinge
        moved = self.depth if self.maker == "piston" else 0.5 * arm if self.hinge >= 0 else 0.5 * self.depth * (self.depth - 2 * self.hinge) / arm
        long = math.sqrt(self.g * self.depth) / moved
        c0 = float(self.transfer(self.wave * self.depth))
        seen = cmath.exp(1j * self.wave * away) + 1j * float(self._near_field(self.omega, away)[0]) / c0
        turns = self.omega * drift
        leads = 1 / (1 - 1 / (2 * turns**2) - 1j / turns) if drift > 0 else 1.0 + 0j
        lag = min(max(cmath.phase(seen) + cmath.phase(leads), 0.0), _MOST_LAG)
        return Absorption(self.omega / c0 / long / (abs(seen) * abs(leads) * math.cos(lag)), math.tan(lag) / self.omega)

    def spectrum(self) -> Components:
        """The components that add up to the waves, at the piston."""
        if self.kind in ("regular", "second_order"):
            return Components(np.array([self.height / 2]), np.array([self.omega]), np.array([0.0]))
        if self.kind == "elevation":
            return self._of_record()
        count = int(self.components)
        f = np.linspace(0.5, 4, count + 1) / self.period
        random = np.random.default_rng(int(self.seed))
        # bands of equal width would repeat after 1/df: each has its frequency somewhere within
        at = f[:-1] + np.diff(f) * (random.random(count) if self.kind != "focused" else 0.5)
        density = jonswap(at, self.height, self.period, 1.0 if self.kind == "pierson_moskowitz" else self.gamma)
        amplitude = np.sqrt(2 * density * np.diff(f))
        amplitude *= self.height / 4 / math.sqrt(0.5 * float((amplitude**2).sum()))
        omega = 2 * math.pi * at
        if self.kind != "focused":
            return Components(amplitude, omega, 2 * math.pi * random.random(count))
        amplitude *= self.height / amplitude.sum()
        x, t = self.focus or (0.0, 0.0)
        return Components(amplitude, omega, omega * t - wave_number(omega, self.depth, self.g) * x)

    def _of_record(self) -> Components:
        """Harmonics of the record, which repeats after its end. The mean is left out: a piston cannot raise it."""
        t = np.linspace(self.record[0, 0], self.record[-1, 0], len(self.record), endpoint=False)
        parts = np.fft.rfft(np.interp(t, self.record[:, 0], self.record[:, 1]))[1:] * 2 / len(t)
        if len(t) % 2 == 0:
            parts = parts[:-1]
        omega = 2 * math.pi / (self.record[-1, 0] - self.record[0, 0]) * np.arange(1, len(parts) + 1)
        kept = np.abs(parts) > 1e-4 * np.abs(parts).max()
        return Components(np.abs(parts)[kept], omega[kept], (-np.angle(parts) + omega * self.record[0, 0])[kept])

    def elevation(self, x: float, t: np.ndarray) -> np.ndarray:
        """Elevation at a distance from the piston at its start, by linear theory without the growth at the start; of a solitary wave Boussinesq's.
        (n,) [L]"""
        t = np.asarray(t, dtype=float)
        if self.kind == "solitary":
            kappa, c = self._solitary()
            # the crest leaves the piston in the middle of the stroke, half of it ahead of the start
            ahead = x - self.height / (kappa * self.depth)
            return self.height / np.cosh(np.clip(kappa * (ahead - c * (t - self._start())), -300, 300)) ** 2
        of = self.spectrum()
        k = wave_number(of.omega, self.depth, self.g)
        phase = of.omega[None] * t[:, None] - k[None] * x - of.phase[None]
        return (of.amplitude * np.cos(phase)).sum(axis=1)

    def displacement(self, end: float) -> np.ndarray:
        """Time and displacement of the piston from its position at t = 0, towards the water, to `end`; (n, 2) [T], [L]."""
        if not (end > 0 and math.isfinite(end)):
            raise WaveFault(f"the end is {end:g}: it must be above 0" + ("" if not end > 0 else " and finite"))
        if self.kind == "solitary":
            return self._push(end)
        of = self.spectrum()
        t = self._times_of(of, end)
        k = wave_number(of.omega, self.depth, self.g)
        half_stroke = of.amplitude / self.transfer(k * self.depth)
        x = np.zeros_like(t)
        for s, omega, phase in zip(half_stroke, of.omega, of.phase):
            # the elevation at a piston goes with its velocity
            x += s * np.sin(omega * t - phase)
        if self.kind == "second_order":
            x += (self._second_order() * np.exp(-2j * self.omega * t)).real
        x *= self._growth(t)
        return np.column_stack([t, x - x[0]])

    def at_paddle(self, end: float, away: float = 0.0) -> np.ndarray:
        """Time and elevation at the distance `away` from the paddle by linear theory, with the near field that does not travel, to `end`; of a solitary
        wave Boussinesq's at that distance from the moving paddle. (n, 2) [T], [L]"""
        if self.kind == "solitary":
            t, x = self._push(end).T
            kappa, c = self._solitary()
            ahead = x + away - self.height / (kappa * self.depth)
            return np.column_stack([t, self.height / np.cosh(np.clip(kappa * (c * (t - self._start()) - ahead), -300, 300)) ** 2])
        of = self.spectrum()
        t = self._times_of(of, end)
        k = wave_number(of.omega, self.depth, self.g)
        beside = self._near_field(of.omega, away) / self.transfer(k * self.depth)
        eta = np.zeros_like(t)
        for a, omega, phase, share, late in zip(of.amplitude, of.omega, of.phase, beside, k * away):
            eta += a * (np.cos(omega * t - phase - late) + share * np.sin(omega * t - phase))
        return np.column_stack([t, eta * self._growth(t)])

    def _longest(self) -> float:
        return self.period or float(self.record[-1, 0] - self.record[0, 0]) / 10

    def _times_of(self, of: Components, end: float) -> np.ndarray:
        return self._times(end, max(2.0, _STEPS * end / min(2 * math.pi / float(of.omega.max()), self._longest())))

    def _growth(self, t: np.ndarray) -> np.ndarray:
        return 0.5 - 0.5 * np.cos(math.pi * np.clip(t / (self.ramp * self._longest()), 0, 1)) if self.ramp > 0 else np.ones_like(t)

    @staticmethod
    def _times(end: float, intervals: float) -> np.ndarray:
        if not intervals < _MOST_ROWS:
            raise WaveFault(f"the displacement would have {intervals:.3g} rows; {_MOST_ROWS:.0e} are the limit", hint="longer waves, or an earlier end")
        return np.linspace(0, end, math.ceil(intervals) + 1)

    def _second_order(self) -> complex:
        """Complex amplitude X2 of the displacement Re(X2 exp(-2 i omega t)) that suppresses the free second harmonic. [L]"""
        ursell = self.height * (2 * math.pi / self.wave) ** 2 / self.depth**3
        if ursell > 8 * math.pi**2 / 3:
            raise WaveFault(f"H L^2/d^3 is {ursell:.3g}: second order holds up to {8 * math.pi**2 / 3:.3g}; make the waves lower or shorter", "height")
        return second_order_piston(self.omega, self.depth, self.height / 2 / float(self.transfer(self.wave * self.depth)), self.g)

    def _solitary(self) -> tuple[float, float]:
        return math.sqrt(0.75 * self.height / self.depth**3), math.sqrt(self.g * (self.depth + self.height))

    def _start(self) -> float:
        """When the crest is at the piston: before, its height there is under a thousandth. [T]"""
        kappa, c = self._solitary()
        return (3.8 + self.height / self.depth) / (kappa * c)

    def _push(self, end: float) -> np.ndarray:
        """Source: Goring, Tsunamis - the propagation of long waves onto a shelf, Caltech (1978), eq. 3.24."""
        kappa, c = self._solitary()
        t = self._times(end, max(199.0, 200 * end / (2 * self._start())))
        x = np.zeros_like(t)
        reach = self.height / (kappa * self.depth)
        for _ in range(100):
            tanh = np.tanh(kappa * (c * (t - self._start()) - x))
            x = x - (x - reach * tanh) / (1 + reach * kappa * (1 - tanh**2))
        return np.column_stack([t, x - x[0]])
