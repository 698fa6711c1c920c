"""What can be found wrong with a suite before anything is run."""
from __future__ import annotations

from dataclasses import dataclass

from ..diagnostics import Diagnostics, Location
from ..expressions import Formula
from ..yaml_map import YamlMap, is_map
from .model import Case, Observation, Reference, Variables
from .names import OUTCOMES, PARTICLE_VARIABLES, find_history_names
from .plan import overrides_of
from .reference import read_table
from .scene import parameter_values


@dataclass
class CheckedExpression:
    """An expression of a case, checked once the names of its parameters are known.

    `over`: what it is evaluated over besides parameters: nothing, time, histories, particles or outcome.
    """

    where: Location
    name: str  # "observation.of"
    text: str
    over: str


def over_of_formula(o: Observation) -> str:
    """What a reference formula may name: particles for profiles, t for curves and for values at a moment."""
    if o.is_profile:
        return "particles" if o.take == "curve" else "nothing"
    return "time" if o.take in ("curve", "final", "at") else "nothing"


def check_observation(map_: YamlMap, o: Observation) -> None:
    """Whether the keys of an observation fit each other; faults are told at the map."""
    own, profile, taken, has = o.kind not in ("history", "particles", "profile"), o.is_profile, o.take, map_.has
    rules = [
        (o.kind == "history" and has("where"), "where", "'where' belongs to particles and profiles"),
        (not profile and not own and has("along"), "along", "'along' belongs to profiles"),
        (o.kind in ("history", "profile") and not o.bins and has("reduce"), "reduce",
         "'reduce' belongs to kind: particles, and to profiles with bins"),
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


def check_table(map_: YamlMap, reference: Reference, diagnostics: Diagnostics) -> None:
    """Whether the table of a reference can be read."""
    if reference.csv is None or not reference.csv.is_file():
        return  # told already
    faults = Diagnostics()
    read_table(reference.csv, reference.csv_x, reference.csv_y, faults)
    for fault in faults.all:
        diagnostics.add(fault)
        map_.error(map_.node, "this reference uses a table that cannot be read, see above")


def check_case(map_: YamlMap, case: Case, expressions: list[CheckedExpression], diagnostics: Diagnostics) -> None:
    """Whether the keys of a case fit each other, and whether its expressions can be understood."""
    if not is_map(map_.node):
        return
    if not case.resolution and case.resolutions:
        map_.error(map_.get("resolutions") or map_.node, "'resolutions' need the parameter that they are values of: 'resolution'")
    if not case.observations and not case.stability:
        map_.error(map_.node, "the case observes nothing", "give 'observations' or 'stability'")
    for key in ("picture_title", "picture_at", "picture_where"):
        if not case.picture_of and map_.has(key):
            map_.error(map_.get(key) or map_.node, f"'case.{key}' needs 'picture_of'")
    _check_settings(map_, case, diagnostics)
    if case.stability:
        _check_stability(map_, case)
    else:
        _check_counts(map_, case)
    if not diagnostics.ok:
        return  # without files and names, expressions would seem wrong
    # The names of parameters are the same in all runs of a scene, so those of the first run tell them.
    first = case.settings[0]
    overrides = overrides_of(case, first, (first.resolutions or case.resolutions or [""])[0])
    if case.stability:
        overrides.update({name: values[0] for name, values in case.stability.sweep})
    parameters = parameter_values(case, overrides)
    if parameters is not None:  # else the plan of the runs tells what is wrong
        for expression in expressions:
            _check_expression(expression, case, parameters, diagnostics)


def _check_expression(e: CheckedExpression, case: Case, parameters: Variables, diagnostics: Diagnostics) -> None:
    text, variables = e.text, list[str]()
    if e.over == "time":
        variables = ["t"]
    elif e.over == "particles":
        variables = PARTICLE_VARIABLES
    elif e.over == "histories":
        history = find_history_names(text)
        text, variables = history.text, [*history.words, "t"]
    elif e.over == "outcome":
        variables = [*OUTCOMES, *(o.name for o in case.observations)]
    formula = Formula(text, variables, parameters)
    if formula.ok:
        return
    hint = formula.hint
    if not hint and e.over == "histories" and "/" not in e.text:
        hint = "histories are named like global/kinetic, parts/1/mass or contacts/1/force.y"
    if not hint and case.deck and formula.error.startswith("unknown name"):
        hint = "of a deck, those parameters are known to which the suite gives a number"
    diagnostics.error(e.where, f"'{e.name}': {formula.error}", hint)


def _check_settings(map_: YamlMap, case: Case, diagnostics: Diagnostics) -> None:
    settings: set[str] = set()
    for setting in case.settings:
        if setting.name in settings:
            map_.error(map_.node, f"two settings are called '{setting.name}'")
        settings.add(setting.name)
        if setting.resolutions and not case.resolution:
            map_.error(map_.node, f"setting '{setting.name}' has resolutions, but the case does not name the parameter 'resolution'")
        if case.resolution and not setting.resolutions and not case.resolutions:
            map_.error(map_.node, f"setting '{setting.name}' has no resolutions", "give 'resolutions' to the case or the setting")
    observations: set[str] = set()
    for o in case.observations:
        if o.name in observations:
            map_.error(map_.node, f"two observations are called '{o.name}'")
        observations.add(o.name)
        for name in o.bound_settings:
            if name not in settings:
                diagnostics.error(case.where, f"observation '{o.name}': bound_settings names '{name}', which is no setting",
                                  f"settings: {', '.join(sorted(settings))}")


def _check_counts(map_: YamlMap, case: Case) -> None:
    """Whether there are runs enough for what is asked of them."""
    for setting in case.settings:
        runs = max(1, len(setting.resolutions or case.resolutions))
        for o in case.observations:
            finest = o.reference.kind == "finest"
            if finest and runs < 2:
                map_.error(map_.node, f"observation '{o.name}' is compared with the finest run, but setting '{setting.name}' has one run")
            least = 3 if finest else 2
            if o.least_order is not None and o.counts_for(setting.name) and runs < least:
                map_.error(map_.node, f"observation '{o.name}': an order needs {least} resolutions at least")
    for o in case.observations:
        if o.least_order is not None and not case.size:
            map_.error(map_.node, f"observation '{o.name}': an order needs the 'size' of the case", "for example size: dx")


def _check_stability(map_: YamlMap, case: Case) -> None:
    if case.resolution:
        map_.error(map_.node, "a stability case has no 'resolution'", "sweep the parameter")
    for o in case.observations:
        if o.bound is not None or o.least_order is not None:
            map_.error(map_.node, f"observation '{o.name}': bounds of a stability case are its limits",
                       f"write a limit with 'value: {o.name}'")
