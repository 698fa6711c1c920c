"""Reads and checks a suite; all faults are reported at once, each with its line."""
from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from ..diagnostics import Diagnostics
from ..key_tables import keys as keys_of_map
from ..yaml_map import Node, YamlMap, as_flag, is_map, is_scalar, load_yaml, scalar_text
from .builders import Builder
from .model import Case, Limit, Observation, Parameters, Reference, Setting, Stability, Suite
from .reference import read_table
from .registry import KINDS, norm, reduction, take
from .suite_check import CheckedExpression, check_case, check_observation

_COLUMNS = keys_of_map("columns of a reference", "csv_x text, csv_y text, scale_x text, scale_y text, offset_x text, offset_y text")
_SUITE = keys_of_map("suite", "title text, about text, time_limit number, cases [@case]!")
_SETTING = keys_of_map("setting", "name text!, parameters map, resolutions list, keywords text")
_REFERENCE = keys_of_map("reference", "formula text, csv text, finest flag, source text")
_STABILITY = keys_of_map("stability", "sweep map, limits [@limit], must_be_stable text, must_stop text")
_LIMIT = keys_of_map("limit", "name text!, value text!, at_most text!")
_OF_CASE = keys_of_map(
    "case",
    "name text!, title text, about text, scene text, deck text, build text, parameters map, resolution text, resolutions list, size text, settings [@setting], "
    "observations [@observation], stability @stability, time_limit number, picture_of text, picture_title text, picture_at text, picture_where text",
)
_OF_OBSERVATION = keys_of_map(
    "observation",
    "name text!, title text, unit text, kind text, of text, where text, along text, bins number, reduce text, empty number, take text, align number, "
    "from text, to text, at text, x text, bed text, reference text|@reference, norm text, scale text, bound number, bound_settings list, least_order number",
)


def read_suite(file: Path, diagnostics: Diagnostics) -> Suite:
    """The result counts only if `diagnostics.ok`."""
    root = load_yaml(file, "suite", "a suite is a YAML file; the user guide shows one", diagnostics)
    if root is None:
        return Suite(file)
    map_ = YamlMap(root, "suite", str(file), diagnostics)
    map_.allow(*_SUITE)
    suite = Suite(file, map_.text("title") or file.stem, map_.text("about"))
    time_limit = map_.positive("time_limit", Case.time_limit)
    for node in map_.list("cases", required=True):
        case = _CaseReader(map_.element(node, "case"), file.parent).read(time_limit)
        if case.name and case.name in (other.name for other in suite.cases):
            map_.error(node, f"two cases are called '{case.name}'")
        suite.cases.append(case)
    if not suite.cases and diagnostics.ok:
        map_.error(root, "the suite has no cases")
    return suite


def _texts(map_: YamlMap, key: str) -> list[str]:
    """The scalars of a list."""
    nodes = map_.list(key)
    for node in nodes:
        if not is_scalar(node):
            map_.error(node, f"'{map_.name}.{key}' must be a list of values")
    return [scalar_text(node) for node in nodes if is_scalar(node)]


def _at(map_: YamlMap, key: str) -> Node:
    """Where a fault of a key is reported."""
    return map_.get(key) or map_.node


def _whole(map_: YamlMap, key: str) -> int:
    """A number > 0 without a fraction, 0 if it is not there."""
    value = map_.positive(key)
    if value != int(min(value, 1e6)):
        map_.error(_at(map_, key), f"'{map_.name}.{key}' must be a whole number")
    return int(min(value, 1e6))


def _word(map_: YamlMap, pattern: str, letters: str) -> str:
    """A name that is a word."""
    name = map_.text("name", required=True)
    if name and not re.fullmatch(pattern, name):
        map_.error(_at(map_, "name"), f"'{map_.name}.name' is a word of {letters}", "put the rest in 'title'")
    return name


def _parameters(map_: YamlMap) -> Parameters:
    """NAME: VALUE"""
    out: Parameters = {}
    values = map_.map("parameters")
    for name, key, value in values.entries() if values else ():
        if not is_scalar(key) or not is_scalar(value):
            map_.error(key, "parameters: expected NAME: VALUE with a number or an expression")
        elif name in out:
            map_.error(key, f"parameters: '{name}' stands twice")
        out.setdefault(name, scalar_text(value))
    return dict(sorted(out.items()))


class _CaseReader:
    def __init__(self, map_: YamlMap, folder: Path) -> None:
        self.map, self.folder, self.diagnostics = map_, folder, map_.diagnostics
        self.noted: list[CheckedExpression] = []

    def expressions(self, map_: YamlMap, over: str, *keys: str, required: bool = False, otherwise: str = "") -> dict[str, Any]:
        """Expressions by key, noted for the check."""
        out = {key: map_.text(key, otherwise, required) for key in keys}
        nodes = {key: map_.get(key) for key in keys}
        self.noted += [CheckedExpression(map_.where(node), f"{map_.name}.{key}", out[key], over)
                       for key, node in nodes.items() if node is not None and is_scalar(node)]
        return out

    def path(self, map_: YamlMap, key: str) -> Path | None:
        text = map_.text(key)
        value = Path(os.path.normpath(self.folder / text)) if text else None
        if value and not value.is_file():
            map_.error(_at(map_, key), f"'{map_.name}.{key}': there is no file '{value}'", "paths count from the folder of the suite")
        return value

    def read(self, time_limit: float) -> Case:
        map_ = self.map
        map_.allow(*_OF_CASE)
        name = _word(map_, "[A-Za-z0-9_-]+", "letters, digits, _ and -")
        out = Case(name, map_.text("title") or name, map_.text("about"), self.path(map_, "scene"), self.path(map_, "deck"), self.builder(), where=map_.where())
        if is_map(map_.node) and sum(map_.has(key) for key in ("scene", "deck", "build")) != 1:
            map_.error(map_.node, "a case has one of 'scene', 'deck' and 'build'")
        out.parameters, out.resolution, out.resolutions = _parameters(map_), map_.text("resolution"), _texts(map_, "resolutions")
        out.time_limit, out.settings = map_.positive("time_limit", time_limit), self.settings()
        out.observations = [self.observation(map_.element(node, "observation")) for node in map_.list("observations")]
        stability = map_.map("stability")
        out.stability = self.stability(stability, out) if stability else None
        out.picture_title = map_.text("picture_title")
        for key, text in (self.expressions(map_, "nothing", "size", "picture_at")
                          | self.expressions(map_, "particles", "picture_of", "picture_where")).items():
            setattr(out, key, text)
        check_case(map_, out, self.noted, self.diagnostics)
        return out

    def builder(self) -> Builder | None:
        text = self.map.text("build")
        if not text:
            return None
        name, _, function = text.rpartition(":")
        file = Path(os.path.normpath(self.folder / name))
        if not name or not function.isidentifier() or not file.is_file():
            self.map.error(_at(self.map, "build"), f"'case.build': expected FILE.py:FUNCTION with a file that is there, got '{text}'", "paths count from the folder of the suite")
            return None
        return Builder(file, function)

    def settings(self) -> list[Setting]:
        out = []
        for entry in (self.map.element(node, "setting") for node in self.map.list("settings")):
            entry.allow(*_SETTING)
            if entry.has("keywords") and self.map.has("deck"):
                entry.error(_at(entry, "keywords"), "'keywords' belong to a case with a 'scene' or 'build'", "write the cards into the deck")
            out.append(Setting(entry.text("name", required=True), _parameters(entry), _texts(entry, "resolutions"), entry.text("keywords")))
        return out or [Setting("default")]

    def observation(self, map_: YamlMap) -> Observation:
        map_.allow(*_OF_OBSERVATION)
        out = Observation(_word(map_, "[A-Za-z_][A-Za-z0-9_]*", "letters, digits and _"), unit=map_.text("unit"))
        out.title = map_.text("title") or out.name
        out.kind = map_.choice("kind", KINDS.names(), out.kind)
        found = self.expressions(map_, KINDS[out.kind].of if out.kind in KINDS else "particles", "of", required=out.kind != "surface")
        found |= self.expressions(map_, "particles", "where") | self.expressions(map_, "particles", "along", required=out.is_profile)
        moments = self.expressions(map_, "nothing", "from", "to", "at", "scale", "bed") | self.expressions(map_, "nothing", "x", required=out.kind == "surface")
        out.start, out.end, out.at = (moments.pop(key) or None for key in ("from", "to", "at"))
        for key, text in (found | moments).items():
            setattr(out, key, text)
        out.reduce = map_.choice("reduce", reduction.names(), out.reduce)
        out.empty = map_.number("empty") if map_.has("empty") else None
        out.take = map_.choice("take", ["curve", *take.names()], out.take)
        out.norm = map_.choice("norm", norm.names(), out.norm)
        out.bins, out.align = _whole(map_, "bins"), _whole(map_, "align")
        reference = map_.get("reference")
        if reference is not None:
            out.reference = self.reference(map_, reference, out)
        out.bound = map_.positive("bound") if map_.has("bound") else None
        out.least_order = map_.number("least_order") if map_.has("least_order") else None
        out.bound_settings = _texts(map_, "bound_settings")
        check_observation(map_, out)
        return out

    def reference(self, map_: YamlMap, node: Node, of: Observation) -> Reference:
        """`finest`, a formula, or a map."""
        # what the formula may name: particles for profiles, t for curves and for values at a moment
        over = "nothing" if of.take not in ("curve", *(() if of.is_profile else ("final", "at"))) else "particles" if of.is_profile else "time"
        if scalar_text(node) == "finest":
            return Reference("finest")
        if is_scalar(node):
            return Reference("formula", self.expressions(map_, over, "reference")["reference"])
        entry = YamlMap(node, "reference", map_.file, self.diagnostics)
        entry.allow(*_REFERENCE, *_COLUMNS)
        kinds = [key for key in ("formula", "csv", "finest") if entry.has(key)]
        if is_map(node) and len(kinds) != 1:
            entry.error(node, "a reference has one of 'formula', 'csv' and 'finest: true'")
        out = Reference(kinds[0] if kinds else "none", source=entry.text("source"))
        if "finest" in kinds and not as_flag(_at(entry, "finest")):
            entry.error(_at(entry, "finest"), "'reference.finest' can only be true")
        for key in _COLUMNS:
            if entry.has(key) and "csv" not in kinds:
                entry.error(_at(entry, key), f"'reference.{key}' belongs to a csv")
        found = self.expressions(entry, over, "formula") | self.expressions(entry, "nothing", *_COLUMNS[2:4], otherwise="1")
        found |= self.expressions(entry, "nothing", *_COLUMNS[4:], otherwise="0")
        found |= {"csv_x": entry.text("csv_x", "1"), "csv_y": entry.text("csv_y", "2"), "csv": self.path(entry, "csv")}
        for key, value in found.items():
            setattr(out, key, value)
        before = self.diagnostics.errors
        if out.csv and out.csv.is_file():
            read_table(out.csv, out.csv_x, out.csv_y, self.diagnostics)
        if self.diagnostics.errors > before:
            entry.error(node, "this reference uses a table that cannot be read, see above")
        return out

    def stability(self, map_: YamlMap, of: Case) -> Stability:
        out = Stability()
        map_.allow(*_STABILITY)
        sweep = map_.map("sweep")
        for name, key, _ in sweep.entries() if sweep else ():
            out.sweep.append((name, _texts(sweep or map_, name)))
            if not out.sweep[-1][1]:
                map_.error(key, f"'{name}' is swept over no values", "write [a, b, ...]")
        if len(out.sweep) > 2:
            map_.error(_at(map_, "sweep"), "at most two parameters can be swept")
        if not out.sweep and len(of.settings) < 2 and not map_.has("sweep"):
            map_.error(map_.node, "a stability case needs a 'sweep' or several settings")
        for entry in (map_.element(node, "limit") for node in map_.list("limits")):
            entry.allow(*_LIMIT)
            out.limits.append(Limit(entry.text("name", required=True), **self.expressions(entry, "outcome", "value", "at_most", required=True)))
        out.must_be_stable = self.expressions(map_, "nothing", "must_be_stable", otherwise="1")["must_be_stable"]
        out.must_stop = self.expressions(map_, "nothing", "must_stop", otherwise="0")["must_stop"]
        return out
