"""Reads and checks a suite; all faults are told at once, each with its line."""
from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..diagnostics import Diagnostics
from ..words import did_you_mean
from ..yaml_map import Node, YamlMap, as_flag, is_map, is_scalar, load_yaml, scalar_text
from .model import Case, Limit, Observation, Parameters, Reference, Setting, Stability, Suite
from .reference import read_table
from .registry import KINDS, norm, reduction, take
from .suite_check import CheckedExpression, check_case, check_observation

_COLUMNS = ("csv_x", "csv_y", "scale_x", "scale_y", "offset_x", "offset_y")
_MOST_BINS = 1e6


def read_suite(file: Path, diagnostics: Diagnostics) -> Suite:
    """The result counts only if `diagnostics.ok`."""
    root = load_yaml(file, "suite", "a suite is a YAML file; the user guide shows one", diagnostics)
    return _SuiteReader(file, diagnostics).read(root) if root is not None else Suite(file)


def _texts(map_: YamlMap, key: str) -> list[str]:
    """The scalars of a list."""
    out = []
    for node in map_.list(key):
        if is_scalar(node):
            out.append(scalar_text(node))
        else:
            map_.error(node, f"'{map_.name}.{key}' must be a list of values")
    return out


def _choice(map_: YamlMap, key: str, default: str, allowed: Sequence[str]) -> str:
    value = map_.text(key, default)
    if value not in allowed:
        map_.error(map_.get(key) or map_.node, f"'{map_.name}.{key}' cannot be '{value}'",
                   f"{did_you_mean(value, allowed)}it may be {', '.join(allowed)}")
    return value


def _whole(map_: YamlMap, key: str) -> int:
    """A number > 0 without a fraction, 0 if it is not there."""
    value = map_.positive(key)
    whole = int(min(value, _MOST_BINS))
    if value != whole:
        map_.error(map_.get(key) or map_.node, f"'{map_.name}.{key}' must be a whole number")
    return whole


def _parameters(map_: YamlMap) -> Parameters:
    """NAME: VALUE"""
    out: Parameters = {}
    values = map_.map("parameters")
    for name, key, value in values.entries() if values else ():
        if not is_scalar(key) or not is_scalar(value):
            map_.error(key, "parameters: expected NAME: VALUE with a number or an expression")
        elif name in out:
            map_.error(key, f"parameters: '{name}' stands twice")
        else:
            out[name] = scalar_text(value)
    return dict(sorted(out.items()))


@dataclass
class _SuiteReader:
    file: Path
    diagnostics: Diagnostics

    def read(self, root: Node) -> Suite:
        map_ = YamlMap(root, "suite", str(self.file), self.diagnostics)
        map_.allow("title", "about", "time_limit", "cases")
        suite = Suite(self.file, map_.text("title"), map_.text("about"))
        time_limit = map_.positive("time_limit", Case.time_limit)
        names: set[str] = set()
        for node in map_.list("cases", required=True):
            case = _CaseReader(map_.element(node, "case"), self.file.parent).read(time_limit)
            suite.cases.append(case)
            if case.name and case.name in names:
                map_.error(node, f"two cases are called '{case.name}'")
            names.add(case.name)
        if not suite.cases and self.diagnostics.ok:
            map_.error(root, "the suite has no cases")
        suite.title = suite.title or self.file.stem
        return suite


class _CaseReader:
    def __init__(self, map_: YamlMap, folder: Path) -> None:
        self.map, self.folder, self.diagnostics = map_, folder, map_.diagnostics
        self.noted: list[CheckedExpression] = []

    def expression(self, map_: YamlMap, key: str, over: str, default: str = "", required: bool = False) -> str:
        """An expression, noted for the check."""
        value = map_.text(key, default, required)
        node = map_.get(key)
        if node is not None and is_scalar(node):
            self.noted.append(CheckedExpression(map_.where(node), f"{map_.name}.{key}", value, over))
        return value

    def moment(self, map_: YamlMap, key: str) -> str | None:
        return self.expression(map_, key, "nothing") if map_.has(key) else None

    def path(self, map_: YamlMap, key: str) -> Path | None:
        text = map_.text(key)
        if not text:
            return None
        value = Path(os.path.normpath(self.folder / text))
        if not value.is_file():
            map_.error(map_.get(key) or map_.node, f"'{map_.name}.{key}': there is no file '{value}'",
                       "paths count from the folder of the suite")
        return value

    def read(self, time_limit: float) -> Case:
        map_ = self.map
        out = Case(where=map_.where())
        map_.allow("name", "title", "about", "scene", "deck", "parameters", "resolution", "resolutions", "size", "settings",
                   "observations", "stability", "time_limit", "picture_of", "picture_title", "picture_at", "picture_where")
        out.name = map_.text("name", required=True)
        if not re.fullmatch(r"[A-Za-z0-9_-]*", out.name):
            map_.error(map_.get("name") or map_.node, "'case.name' is a word of letters, digits, _ and -", "put the rest in 'title'")
        out.title, out.about = map_.text("title") or out.name, map_.text("about")
        out.scene, out.deck = self.path(map_, "scene"), self.path(map_, "deck")
        if is_map(map_.node) and map_.has("scene") == map_.has("deck"):
            map_.error(map_.node, "a case has either a 'scene' or a 'deck'")
        out.parameters = _parameters(map_)
        out.resolution, out.resolutions = map_.text("resolution"), _texts(map_, "resolutions")
        out.size = self.expression(map_, "size", "nothing")
        out.time_limit = map_.positive("time_limit", time_limit)
        out.settings = self.settings()
        out.observations = [self.observation(map_.element(node, "observation")) for node in map_.list("observations")]
        stability = map_.map("stability")
        out.stability = self.stability(stability, out) if stability else None
        out.picture_of = self.expression(map_, "picture_of", "particles")
        out.picture_title = map_.text("picture_title")
        out.picture_at = self.expression(map_, "picture_at", "nothing")
        out.picture_where = self.expression(map_, "picture_where", "particles")
        check_case(map_, out, self.noted, self.diagnostics)
        return out

    def settings(self) -> list[Setting]:
        out = []
        for node in self.map.list("settings"):
            entry = self.map.element(node, "setting")
            entry.allow("name", "parameters", "resolutions")
            out.append(Setting(entry.text("name", required=True), _parameters(entry), _texts(entry, "resolutions")))
        return out or [Setting("default")]

    def observation(self, map_: YamlMap) -> Observation:
        map_.allow("name", "title", "unit", "kind", "of", "where", "along", "bins", "reduce", "take", "align", "from", "to", "at",
                   "reference", "norm", "scale", "bound", "bound_settings", "least_order")
        out = Observation(name=map_.text("name", required=True))
        if map_.has("name") and not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", out.name):
            map_.error(map_.get("name") or map_.node, "'observation.name' is a word of letters, digits and _", "put the rest in 'title'")
        out.title, out.unit = map_.text("title") or out.name, map_.text("unit")
        out.kind = _choice(map_, "kind", out.kind, KINDS.names())
        out.of = self.expression(map_, "of", KINDS[out.kind].of if out.kind in KINDS else "particles", required=True)
        out.where = self.expression(map_, "where", "particles")
        out.along = self.expression(map_, "along", "particles", required=out.is_profile)
        out.reduce = _choice(map_, "reduce", out.reduce, reduction.names())
        out.bins, out.align = _whole(map_, "bins"), _whole(map_, "align")
        out.take = _choice(map_, "take", out.take, ["curve", *take.names()])
        out.start, out.end, out.at = self.moment(map_, "from"), self.moment(map_, "to"), self.moment(map_, "at")
        reference = map_.get("reference")
        if reference is not None:
            self.reference(map_, reference, out)
        out.norm = _choice(map_, "norm", out.norm, norm.names())
        out.scale = self.expression(map_, "scale", "nothing")
        out.bound = map_.positive("bound") if map_.has("bound") else None
        out.least_order = map_.number("least_order") if map_.has("least_order") else None
        out.bound_settings = _texts(map_, "bound_settings")
        check_observation(map_, out)
        return out

    def reference(self, map_: YamlMap, node: Node, of: Observation) -> None:
        """`finest`, a formula, or a map."""
        out = of.reference = Reference()
        # what the formula may name: particles for profiles, t for curves and for values at a moment
        over = "nothing" if of.take not in ("curve", *(() if of.is_profile else ("final", "at"))) else "particles" if of.is_profile else "time"
        if is_scalar(node):
            out.kind = "finest" if scalar_text(node) == "finest" else "formula"
            if out.kind == "formula":
                out.formula = self.expression(map_, "reference", over)
            return
        entry = YamlMap(node, "reference", map_.file, self.diagnostics)
        entry.allow("formula", "csv", "finest", *_COLUMNS, "source")
        if not is_map(node):
            return
        if sum(entry.has(key) for key in ("formula", "csv", "finest")) != 1:
            entry.error(node, "a reference has one of 'formula', 'csv' and 'finest: true'")
        out.source = entry.text("source")
        if entry.has("formula"):
            out.kind, out.formula = "formula", self.expression(entry, "formula", over)
        elif entry.has("finest"):
            out.kind = "finest"
            if not as_flag(entry.get("finest") or node):
                entry.error(entry.get("finest") or node, "'reference.finest' can only be true")
        for key in _COLUMNS:
            if entry.has(key) and not entry.has("csv"):
                entry.error(entry.get(key) or node, f"'reference.{key}' belongs to a csv")
        if not entry.has("csv"):
            return
        out.kind, out.csv = "csv", self.path(entry, "csv")
        out.csv_x, out.csv_y = entry.text("csv_x", "1"), entry.text("csv_y", "2")
        out.scale_x, out.scale_y = (self.expression(entry, key, "nothing", "1") for key in ("scale_x", "scale_y"))
        out.offset_x, out.offset_y = (self.expression(entry, key, "nothing", "0") for key in ("offset_x", "offset_y"))
        if out.csv and out.csv.is_file():
            before = self.diagnostics.errors
            read_table(out.csv, out.csv_x, out.csv_y, self.diagnostics)
            if self.diagnostics.errors > before:
                entry.error(node, "this reference uses a table that cannot be read, see above")

    def stability(self, map_: YamlMap, of: Case) -> Stability:
        out = Stability()
        map_.allow("sweep", "limits", "must_be_stable", "must_stop")
        sweep = map_.map("sweep")
        if sweep and is_map(sweep.node):
            for name, key, _ in sweep.entries():
                out.sweep.append((name, _texts(sweep, name)))
                if not out.sweep[-1][1]:
                    sweep.error(key, f"'{name}' is swept over no values", "write [a, b, ...]")
            if len(out.sweep) > 2:
                sweep.error(sweep.node, "at most two parameters can be swept")
        if not out.sweep and len(of.settings) < 2 and not map_.has("sweep"):
            map_.error(map_.node, "a stability case needs a 'sweep' or several settings")
        for node in map_.list("limits"):
            entry = map_.element(node, "limit")
            entry.allow("name", "value", "at_most")
            out.limits.append(Limit(entry.text("name", required=True), self.expression(entry, "value", "outcome", required=True),
                                    self.expression(entry, "at_most", "outcome", required=True)))
        out.must_be_stable = self.expression(map_, "must_be_stable", "nothing", "1")
        out.must_stop = self.expression(map_, "must_stop", "nothing", "0")
        return out
