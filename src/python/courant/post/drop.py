"""A hydraulic jump at an abrupt drop: momentum bounds, and the type of the jump over time by a rule with hysteresis.

Types after Ohtsu and Yasuda, J. Hydraul. Res. 29 (1991), and Mossa, Petrillo and Chanson, J. Hydraul. Res. 41 (2003).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

TYPES = ("undecided", "A", "B", "A-wave", "B-wave")  # their locations are the numbers in tables
_WAVES = (3, 4)


def momentum_bounds(F1: float, step: float) -> tuple[float, float]:
    """Tailwater depth over y1 that the balance of momentum across a drop asks for: Y_B, with the face of the step under the pressure of the
    upstream level, rho g s (y1 + s/2), and Y_A, under that of the tailwater, rho g s (y_t - s/2). `step`: s/y1. NaN for F1 <= 1.

    rho q (V_t - V_1) = rho g (y1^2 - y_t^2)/2 + force on the face, with V_t y_t = V_1 y1, Y = y_t/y1 and S = s/y1:
    B: Y^3 - (1 + 2 F1^2 + S (2 + S)) Y + 2 F1^2 = 0, A: Y^3 - 2 S Y^2 - (1 + 2 F1^2 - S^2) Y + 2 F1^2 = 0; the largest root is the subcritical one.
    Both are Belanger's equation for S = 0. Source: Moore and Morgan, Trans. ASCE 124 (1959); Hager and Bretz, J. Hydraul. Res. 24 (1986).
    """
    if not F1 > 1:
        return math.nan, math.nan
    F2, S = 2 * F1**2, step
    both = ((1, 0, -(1 + F2 + S * (2 + S)), F2), (1, -2 * S, -(1 + F2 - S**2), F2))
    B, A = (max(root.real for root in np.roots(cubic) if abs(root.imag) < 1e-9 * abs(root)) for cubic in both)
    return float(B), float(A)


@dataclass(frozen=True)
class TypeRule:
    """Thresholds. `jet`: of J, to either side; `upstream`, `band`: the toe is upstream of the step where it is more than upstream + band [y1]
    ahead of it, behind where it is less than upstream - band; in between both stay what they were. Where the toe is upstream a jet at the surface is
    none any longer once J > -jet/3: behind an A-jump that has run up its bed the flow is even, and J stays about 0."""

    jet: float = 0.15
    upstream: float = 1.0
    band: float = 0.25


def types_over_time(J: np.ndarray, ahead: np.ndarray, rule: TypeRule) -> np.ndarray:
    """Number of the type, an index into TYPES, of each state; (n,).

    J: (n,) (u_bed - u_surface)/V1; ahead: (n,) how far the toe is upstream of the step [y1]; NaN: there is none. Where there is no toe, or no
    J, there is no jump to judge: undecided.
    """
    out = np.zeros(len(J), dtype=int)
    jet, upstream = 0, None
    for k, (j, a) in enumerate(zip(J.tolist(), ahead.tolist(), strict=True)):
        if math.isnan(j) or math.isnan(a):
            continue
        jet = 1 if j > rule.jet else -1 if j < -rule.jet else jet
        if a > rule.upstream + rule.band or (upstream is None and a > rule.upstream):
            upstream = True
        elif a < rule.upstream - rule.band or upstream is None:
            upstream = False
        if upstream and jet < 0 and j > -rule.jet / 3:
            jet = 0
        if jet < 0:
            out[k] = 3 if upstream else 4
        elif upstream:
            out[k] = 1  # a roller over the step, wherever its jet is going
        elif jet > 0:
            out[k] = 2
    return out


class Switch(NamedTuple):
    t: float
    before: int
    after: int


@dataclass
class Cycles:
    """`switches`: changes from one type to another; `starts`: times at which a cycle begins; a cycle is from one start to the next one."""

    switches: list[Switch] = field(default_factory=list)
    starts: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def periods(self) -> np.ndarray:
        return np.diff(self.starts)


def cycles_of(t: np.ndarray, types: np.ndarray) -> Cycles:
    """Switches and cycles of types over time. A cycle begins where the jump turns into a wave, at either side, or, where it never is one, at each
    change from A to B. What is undecided is passed over, and so are changes between the two waves: the toe of a wave swings past the step.
    """
    decided = np.flatnonzero(types > 0)
    out, t, types = Cycles(), t[decided], types[decided]
    for k in np.flatnonzero(types[1:] != types[:-1]) + 1:
        out.switches.append(Switch(float(t[k]), int(types[k - 1]), int(types[k])))
    into_wave = [one.t for one in out.switches if one.after in _WAVES and one.before not in _WAVES]
    into_B = [one.t for one in out.switches if one.after == 2]
    out.starts = np.array(into_wave if np.isin(types, _WAVES).any() else into_B)
    return out


def shares_of(t: np.ndarray, types: np.ndarray) -> np.ndarray:
    """Share of the time in each of TYPES: each state represents the time half-way to its neighbours; (len(TYPES),)."""
    if len(t) < 2:
        return np.bincount(types, minlength=len(TYPES)) / max(1, len(t))
    half = 0.5 * np.diff(t)
    weight = np.append(half, 0) + np.append(0, half)
    return np.bincount(types, weight, len(TYPES)) / weight.sum()


def regime_of(shares: np.ndarray, least: float = 0.1) -> str:
    """What a run is as a whole, as experiments name it: of the families A, B and wave those count that hold for at least `least` of the time.

    A-jump, B-jump and wave jump stay what they are; A-wave and B-wave are jumps that turn from A or B into a wave and back; A-B and A-B-wave have both.
    """
    wave = shares[3] + shares[4] >= least
    jumps = [name for name, share in (("A", shares[1]), ("B", shares[2])) if share >= least]
    if not jumps:
        return "wave jump" if wave else "undecided"
    if wave:
        return "-".join([*jumps, "wave"])
    return f"{jumps[0]}-jump" if len(jumps) == 1 else "A-B"
