"""What a suite asks for, and what came out of it."""
from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Location

if TYPE_CHECKING:
    from .builders import Builder

Parameters = dict[str, str]  # NAME: VALUE, handed to the scene or deck as --param; numbers or expressions
Variables = dict[str, float]  # what expressions may name, with its values in a run


@dataclass
class Setting:
    """One line of a case's chart: values of parameters that stay the same while the resolution is swept."""

    name: str
    parameters: Parameters = field(default_factory=dict)
    resolutions: list[str] = field(default_factory=list)  # for this setting alone; empty: those of the case
    keywords: str = ""  # cards put at the end of the deck of a scene


@dataclass
class Reference:
    """What a run is compared with: none, a formula, a csv, or the finest run. Columns of a csv, by name or number, are scaled, then shifted."""

    kind: str = "none"
    formula: str = ""  # of t, or of particles; may use the scene's parameters
    csv: Path | None = None
    csv_x: str = "1"
    csv_y: str = "2"
    scale_x: str = "1"
    scale_y: str = "1"
    offset_x: str = "0"
    offset_y: str = "0"
    source: str = ""  # where it comes from, for the report

    def text(self) -> str:
        """ "formula sqrt(2 g h) (Ritter 1892)", "none"."""
        words = {"formula": f"formula {self.formula}", "finest": "the finest run", "csv": f"table {Path(self.csv or '').name}"}
        return words.get(self.kind, "none") + (f" ({self.source})" if self.source else "")


@dataclass
class Observation:
    """One number, or curve, that is observed in a run and compared; the user guide explains the keys."""

    name: str = ""
    title: str = ""
    unit: str = ""
    kind: str = "history"  # one of registry.KINDS
    of: str = ""
    where: str = ""
    along: str = ""
    bins: int = 0
    reduce: str = "mean"
    empty: float | None = None  # what stands where no particle counts; none: an error
    take: str = "curve"
    start: str | None = None  # the keys `from` and `to`: window in t, expressions of parameters
    end: str | None = None
    at: str | None = None
    x: str = ""  # of kind surface: place of the line and height of the bed there, expressions of parameters
    bed: str = ""
    reference: Reference = field(default_factory=Reference)
    align: int = 0
    norm: str = "l2"
    scale: str = ""  # the error is divided by it; blank: the same norm of the reference
    bound: float | None = None
    bound_settings: list[str] = field(default_factory=list)
    least_order: float | None = None

    @property
    def is_profile(self) -> bool:
        return self.kind == "profile"

    @property
    def label(self) -> str:
        return self.title or self.name

    def counts_for(self, setting: str) -> bool:
        """Whether its bounds hold for a setting."""
        return not self.bound_settings or setting in self.bound_settings


@dataclass
class Limit:
    """What must not be exceeded in a stability case; `value` and `at_most` are expressions."""

    name: str = ""
    value: str = ""
    at_most: str = ""


@dataclass
class Stability:
    """Verdicts instead of errors. Where the expressions are > 0, a run must be stable, or be refused or stop."""

    sweep: list[tuple[str, list[str]]] = field(default_factory=list)  # at most two: the map's columns and rows
    limits: list[Limit] = field(default_factory=list)
    must_be_stable: str = "1"
    must_stop: str = "0"


@dataclass
class Case:
    """Runs of a scene, of a deck, or of decks that a function makes."""

    name: str = ""
    title: str = ""
    about: str = ""
    scene: Path | None = None
    deck: Path | None = None
    build: Builder | None = None
    parameters: Parameters = field(default_factory=dict)
    resolution: str = ""  # name of the swept parameter; blank: none
    resolutions: list[str] = field(default_factory=list)
    size: str = ""  # expression: spacing, the abscissa of the order of convergence
    settings: list[Setting] = field(default_factory=list)
    observations: list[Observation] = field(default_factory=list)
    stability: Stability | None = None
    time_limit: float = 1800.0  # of a run, wall time [s]
    picture_of: str = ""
    picture_title: str = ""
    picture_at: str = ""
    picture_where: str = ""
    where: Location = field(default_factory=Location)

    @property
    def is_made(self) -> bool:
        """Whether the deck of a run is written by this program."""
        return self.deck is None


@dataclass
class Suite:
    file: Path = Path()
    title: str = ""
    about: str = ""
    cases: list[Case] = field(default_factory=list)


# How a run ended; broken: crash, hang or garbage. Later ones are worse.
Verdict = IntEnum("Verdict", ["stable", "degraded", "stopped", "refused", "broken"], start=0)
_NONE = np.empty(0)


@dataclass
class Curve:
    """A curve as it was compared, thinned for the report. Shapes (n,) and (m,); no reference: m = 0."""

    x: np.ndarray = field(default_factory=_NONE.copy)
    y: np.ndarray = field(default_factory=_NONE.copy)
    reference_x: np.ndarray = field(default_factory=_NONE.copy)
    reference_y: np.ndarray = field(default_factory=_NONE.copy)


@dataclass
class Observed:
    """An observation with its error, divided by its scale [-]; `why` states why something is missing."""

    name: str = ""
    found: bool = False
    why: str = ""
    value: float | None = None
    reference: float | None = None
    error: float | None = None
    curve: Curve = field(default_factory=Curve)


@dataclass
class RunNumbers:
    """What limits of stability cases may name."""

    residual: float = 0.0  # of the energy balance over what passed through
    error: float = 0.0  # energy from nowhere over what the scene held and passed
    ratio: float = 0.0
    leaked: float = 0.0
    penetration: float = 0.0
    steps: float = 0.0


@dataclass
class RunResult:
    """One run. `setting`: its name, or the swept values of a stability case, "tssfac = 0.9"."""

    setting: str = ""
    resolution: str = ""
    parameters: Parameters = field(default_factory=dict)
    size: float = 0.0
    folder: Path = Path()
    exit_code: int = 0
    termination: str = ""
    reason: str = ""
    wall_seconds: float = 0.0
    cpu_seconds: float = 0.0
    particles: int = 0
    steps: int = 0
    particle_steps: int = 0
    peak_memory_bytes: int = 0
    observed: list[Observed] = field(default_factory=list)  # in the order of the case's observations
    verdict: Verdict = Verdict.stable
    exceeded: list[str] = field(default_factory=list)
    as_required: bool = True  # the verdict is one that the case allows
    reused: bool = False  # taken from an earlier call
    numbers: RunNumbers = field(default_factory=RunNumbers)

    @property
    def name(self) -> str:
        """ "cubic at resolution 40", or what of it is there."""
        return " at ".join(filter(None, (self.setting, self.resolution and f"resolution {self.resolution}"))) or "the run"

    def error_of(self, k: int) -> float | None:
        return self.observed[k].error if k < len(self.observed) else None


@dataclass
class BoundCheck:
    """A bound and what was measured against it; `what`: "error at most", "order at least", "stable"."""

    setting: str
    observation: str
    what: str
    bound: float
    measured: float
    met: bool


@dataclass
class MeasuredOrder:
    """Order of convergence: slope of log(error) over log(size) by least squares; None with fewer than two errors."""

    setting: str
    observation: str
    order: float | None


@dataclass
class Picture:
    png: bytes  # of the file
    title: str
    low: str  # the ends of the colour scale
    high: str


@dataclass
class CaseResult:
    """Runs with the settings outermost, resolutions from coarse to fine, and what they come to."""

    definition: Case
    runs: list[RunResult] = field(default_factory=list)
    checks: list[BoundCheck] = field(default_factory=list)
    orders: list[MeasuredOrder] = field(default_factory=list)
    picture: Picture | None = None

    @property
    def title(self) -> str:
        return self.definition.title or self.definition.name

    @property
    def missed(self) -> int:
        return sum(not check.met for check in self.checks)

    def order_of(self, setting: str, observation: str) -> float | None:
        return next((m.order for m in self.orders if (m.setting, m.observation) == (setting, observation)), None)

    def ends_setting(self, k: int) -> bool:
        """Whether run k is the last of its setting."""
        return k + 1 == len(self.runs) or self.runs[k + 1].setting != self.runs[k].setting


@dataclass
class SuiteResult:
    suite: Suite
    version: str = ""  # of Courant with its build
    machine: str = ""  # processor, cores, system
    date: str = ""  # ISO 8601, UTC
    wall_seconds: float = 0.0
    jobs: int = 1
    cases: list[CaseResult] = field(default_factory=list)

    @property
    def title(self) -> str:
        return self.suite.title or self.suite.file.stem

    @property
    def ok(self) -> bool:
        return not any(case.missed for case in self.cases)
