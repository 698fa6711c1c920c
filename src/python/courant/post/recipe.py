"""What `courant post` is asked to measure: the content of a recipe (YAML)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from os import PathLike
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from ..diagnostics import Diagnostics, Location
from ..key_tables import keys as keys_of_map
from ..units import Units
from ..yaml_map import Node, YamlMap, is_map, key, load_yaml, scalar_text
from .analyses import Analysis, Settings, read_analysis
from .figures import Figure, read_figure
from .jump import INTERVAL, JumpRecipe, PublishedRow

if TYPE_CHECKING:
    from .view_scene import View

_KEYS = keys_of_map(
    "recipe",
    "case text, probes [@probe of a recipe], jump @jump, snapshots @snapshots, units @units, up text, folder text, analyses [@analysis], figures [@figure], "
    "formats list, views [@view], missing @missing",
)
_MISSING = keys_of_map("missing", "density number, smoothing_length number")
_OF_JUMP = keys_of_map("more of a jump", "intervals list!, published [@published], toe @toe, front @front")
_TOE = keys_of_map("toe", "x list!, threshold number")
_FRONT = keys_of_map("front", "x number!, threshold number")
_UNITS = keys_of_map("units", "mass text, length text, time text")


@dataclass(frozen=True)
class ProbeRecipe:
    """Water depth over time on an upright line. `x`, `z`, `bed`: [L]."""

    name: str = key("text", default="")
    x: float = key("number", 0.0, required=True)
    z: float = key("number", 0.0)
    bed: float = key("number", 0.0)


@dataclass(frozen=True)
class SnapshotRecipe:
    """Pictures of the velocity field. `times`: [T]; `speed`: range of the colours [L/T]; `x`, `y`: window [L]; None: from the data."""

    times: list[float] = key("numbers", required=True)
    speed: tuple[float, float] | None = key("range", example=INTERVAL)
    x: tuple[float, float] | None = key("range", example=INTERVAL)
    y: tuple[float, float] | None = key("range", example=INTERVAL)


@dataclass
class Recipe:
    """`case`: overrides what the title of the run tells; `analyses`: in the order of the recipe; `folder`: in the run's folder, for what
    analyses write; `formats`: of the figures."""

    file: str
    case: str = ""
    probes: list[ProbeRecipe] = field(default_factory=list)
    jump: JumpRecipe | None = None
    snapshots: SnapshotRecipe | None = None
    settings: Settings = Settings()
    analyses: list[Analysis] = field(default_factory=list)
    figures: list[Figure] = field(default_factory=list)
    formats: list[str] = field(default_factory=lambda: ["png"])
    folder: str = "post"
    views: list[tuple[View, Location]] = field(default_factory=list)
    missing: dict[str, float] = field(default_factory=dict)  # of arrays that the field files may lack

    @property
    def needs_states(self) -> bool:
        """False for one of histories alone, which also a folder without field states serves, LS-DYNA's for example; views read their own."""
        return bool(self.jump or self.probes or self.snapshots) or any(one.needs_states for one in self.analyses)


def read_recipe(file: str | PathLike[str], diagnostics: Diagnostics, units: Units = Units()) -> Recipe | None:  # noqa: B008  frozen
    """All faults are reported; then there is None. `units`: of the run, where the recipe names none."""
    out = Recipe(str(file))
    root = load_yaml(out.file, "recipe", "a recipe is a YAML file such as keyword_decks/*/post.yaml", diagnostics)
    if root is None:
        return None
    before = diagnostics.errors
    keys = YamlMap(root, "recipe", out.file, diagnostics)
    keys.allow(*_KEYS)
    out.case = keys.text("case")
    out.probes = [keys.element(node, "probes").read(ProbeRecipe) for node in keys.list("probes")]
    out.probes = [one if one.name else replace(one, name=f"probe{k}") for k, one in enumerate(out.probes, 1)]
    if jump := keys.map("jump"):
        out.jump = _read_jump(jump)
    if snapshots := keys.map("snapshots"):
        out.snapshots = snapshots.read(SnapshotRecipe)
    out.settings = _read_settings(keys, units)
    if missing := keys.map("missing"):
        missing.allow(*_MISSING)
        out.missing = {name: missing.positive(name, 1) for name in ("density", "smoothing_length") if missing.has(name)}
    for node in keys.list("analyses"):
        _read_one(keys, node, out)
    out.figures = [read_figure(keys, node) for node in keys.list("figures")]
    if keys.has("views"):
        from .views import read_views

        out.views = read_views(keys, keys.text("up"))
    _read_formats(keys, out)
    _read_folder(keys, out)
    if diagnostics.errors == before and not (out.probes or out.jump or out.snapshots or out.analyses or out.views):
        diagnostics.error(Location(out.file, 1, 1), "the recipe asks for nothing", "add one of: probes, jump, snapshots, analyses, views")
    return out if diagnostics.errors == before else None


def _read_jump(keys: YamlMap) -> JumpRecipe:
    known: dict[str, Any] = {"intervals": [keys.range_of(node, "intervals", INTERVAL) or (0.0, 0.0) for node in keys.list("intervals", required=True)]}
    known["published"] = [keys.element(node, "published").read(PublishedRow) for node in keys.list("published")]
    if toe := keys.map("toe"):
        toe.allow(*_TOE)
        known |= {"toe_range": toe.range("x", required=True, example=INTERVAL), "toe_threshold": toe.positive("threshold", 1.5)}
    if front := keys.map("front"):
        front.allow(*_FRONT)
        known |= {"front_x": front.number("x", required=True), "front_threshold": front.positive("threshold", 1.3)}
    return keys.read(JumpRecipe, *_OF_JUMP, **known)


def _read_settings(keys: YamlMap, units: Units) -> Settings:
    if of := keys.map("units"):
        of.allow(*_UNITS)
        units = Units(of.text("mass", "kg"), of.text("length", "m"), of.text("time", "s"))
    return Settings(units, "xyz".index(keys.choice("up", ("y", "z"))))


def _read_one(keys: YamlMap, node: Node, recipe: Recipe) -> None:
    name = next((scalar_text(value) for word, value in node.value if scalar_text(word) == "name"), "") if is_map(node) else ""
    entry = keys.element(node, name or "analyses")
    one = read_analysis(entry, recipe.settings) if is_map(node) else None  # else the reader has reported
    if one is None:
        return
    named = {other.name for other in recipe.analyses}
    at = entry.get("name")
    if at is not None and one.name in named:
        entry.error(at, f"two analyses are named '{one.name}'")
    for word, wanted in one.refers():
        at = entry.get(word)
        if at is not None and wanted not in named:
            message = f"'{entry.name}.{word}': there is no analysis '{wanted}' above it"
            entry.error(at, message, "analyses are worked through from top to bottom")
    recipe.analyses.append(one)


def _read_formats(keys: YamlMap, recipe: Recipe) -> None:
    if not keys.has("formats"):
        return
    recipe.formats = []
    for node in keys.list("formats"):
        recipe.formats.append(scalar_text(node))
        if recipe.formats[-1] not in ("png", "svg", "pdf"):
            keys.error(node, f"'{keys.name}.formats' cannot be '{recipe.formats[-1]}'", "they are png, svg and pdf")


def _read_folder(keys: YamlMap, recipe: Recipe) -> None:
    recipe.folder = keys.text("folder", "post")
    if PurePosixPath(recipe.folder).is_absolute() or ".." in recipe.folder or not recipe.folder:
        message = "'recipe.folder' must be a folder within the run's"
        keys.error(keys.get("folder") or keys.node, message, "for example post")
