"""What can be found wrong with a suite before anything is run."""
from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from ..diagnostics import Diagnostics, Location
from ..expressions import Formula
from ..variables import VARIABLES
from ..yaml_map import YamlMap, is_map
from .model import Case, Observation, Variables
from .names import OUTCOMES, find_history_names
from .plan import overrides_of
from .scene import parameter_values


class CheckedExpression(NamedTuple):
    """An expression of a case, checked once the names of its parameters are known. `over`: what it is evaluated over besides them."""

    where: Location
    name: str  # "observation.of"
    text: str
    over: str  # nothing, time, histories, particles or outcome


def check_observation(map_: YamlMap, o: Observation) -> None:
    """Whether the keys of an observation fit each other; faults are reported at the map."""
    own, profile, taken, has = o.kind not in ("history", "particles", "profile", "surface"), o.is_profile, o.take, map_.has
    surface = o.kind == "surface"
    rules = [(o.kind == "history" and has("where"), "where", "'where' belongs to particles and profiles"),
        (not profile and not own and has("along"), "along", "'along' belongs to profiles"),
        (surface and has("of"), "of", "a surface is the depth of the water, 'of' belongs to other kinds"),
        *((not surface and not own and has(key), key, f"'{key}' belongs to kind: surface") for key in ("x", "bed")),
        (o.kind in ("history", "profile", "surface") and not o.bins and has("reduce"), "reduce",
         "'reduce' belongs to kind: particles, and to profiles with bins"),
        (o.kind in ("history", "profile", "surface") and has("empty"), "empty", "'empty' belongs to kind: particles"),
        (not profile and not own and has("bins"), "bins", "'bins' belongs to profiles"),
        (profile and taken != "curve" and not (o.bins and taken in ("mean", "min", "max")), "take",
         "a profile can only be taken as a curve, one with bins also as mean, min or max"),
        (o.align and not (o.reference.kind == "csv" and taken == "curve"), "align", "'align' belongs to curves against a csv"),
        (profile and (o.start or o.end), "from", "a profile has no window; use 'where'"),
        (taken == "at" and not o.at, "take", "'take: at' needs the moment 'at'"),
        (o.at and taken != "at" and not profile and not own, "at", "'at' belongs to 'take: at' and to profiles"),
        (taken != "curve" and has("norm"), "norm", "'norm' belongs to curves and profiles"),
        *((o.reference.kind == "none" and has(key), key, f"'{key}' needs a 'reference'")
          for key in ("norm", "scale", "bound", "bound_settings", "least_order"))]
    for broken, key, message in rules:
        if broken:
            map_.error(map_.get(key) or map_.node, message)


def _twice(what: str, names: list[str]) -> Iterator[tuple[str, str]]:
    return ((f"two {what} are called '{name}'", "") for name, count in Counter(names).items() if count > 1)


def _faults(case: Case) -> Iterator[tuple[str, str]]:
    """What of a case does not fit together, and hints."""
    settings = [setting.name for setting in case.settings]
    yield from _twice("settings", settings)
    yield from _twice("observations", [o.name for o in case.observations])
    if not case.observations and not case.stability:
        yield "the case observes nothing", "give 'observations' or 'stability'"
    if case.stability and case.resolution:
        yield "a stability case has no 'resolution'", "sweep the parameter"
    for setting in case.settings:
        if setting.resolutions and not case.resolution:
            yield f"setting '{setting.name}' has resolutions, but the case does not name the parameter 'resolution'", ""
        if case.resolution and not setting.resolutions and not case.resolutions:
            yield f"setting '{setting.name}' has no resolutions", "give 'resolutions' to the case or the setting"
    for o in case.observations:
        for name in o.bound_settings:
            if name not in settings:
                yield (f"observation '{o.name}': bound_settings names '{name}', which is no setting", f"settings: {', '.join(sorted(settings))}")
        if case.stability:
            if o.bound is not None or o.least_order is not None:
                yield f"observation '{o.name}': bounds of a stability case are its limits", f"write a limit with 'value: {o.name}'"
            continue
        finest, ordered = o.reference.kind == "finest", o.least_order is not None
        for setting in case.settings:
            runs = max(1, len(setting.resolutions or case.resolutions))
            if finest and runs < 2:
                yield f"observation '{o.name}' is compared with the finest run, but setting '{setting.name}' has one run", ""
            if ordered and o.counts_for(setting.name) and runs < 2 + finest:
                yield f"observation '{o.name}': an order needs {2 + finest} resolutions at least", ""
        if ordered and not case.size:
            yield f"observation '{o.name}': an order needs the 'size' of the case", "for example size: dx"


def check_case(map_: YamlMap, case: Case, expressions: list[CheckedExpression], diagnostics: Diagnostics) -> None:
    """Whether the keys of a case fit each other, and whether its expressions can be understood."""
    if not is_map(map_.node):
        return
    if not case.resolution and case.resolutions:
        map_.error(map_.get("resolutions") or map_.node, "'resolutions' need the parameter that they are values of: 'resolution'")
    for key in ("picture_title", "picture_at", "picture_where"):
        if not case.picture_of and map_.has(key):
            map_.error(map_.get(key) or map_.node, f"'case.{key}' needs 'picture_of'")
    for message, hint in _faults(case):
        map_.error(map_.node, message, hint)
    if not diagnostics.ok:
        return  # without files and names, expressions would seem wrong
    # The names of parameters are the same in all runs of a scene, so those of the first run tell them.
    first = case.settings[0]
    overrides = overrides_of(case, first, (first.resolutions or case.resolutions or [""])[0])
    overrides |= {name: values[0] for name, values in case.stability.sweep} if case.stability else {}
    parameters = parameter_values(case, overrides)
    for expression in expressions if parameters is not None else ():  # else the plan of the runs states what is wrong
        _check_expression(expression, case, parameters or {}, diagnostics)


def _check_expression(e: CheckedExpression, case: Case, parameters: Variables, diagnostics: Diagnostics) -> None:
    if e.over == "gauges":
        return  # a form of its own
    history = find_history_names(e.text) if e.over == "histories" else None
    variables = {"time": ["t"], "particles": VARIABLES, "outcome": [*OUTCOMES, *(o.name for o in case.observations)],
                 "histories": [*history.words, "t"] if history else []}.get(e.over, [])
    formula = Formula(history.text if history else e.text, variables, parameters)
    if formula.ok:
        return
    hint = formula.hint
    if not hint and history and "/" not in e.text:
        hint = "histories are named like global/kinetic, parts/1/mass or contacts/1/force.y"
    if not hint and case.deck and formula.error.startswith("unknown name"):
        hint = "of a deck, those parameters are known to which the suite gives a number"
    diagnostics.error(e.where, f"'{e.name}': {formula.error}", hint)
