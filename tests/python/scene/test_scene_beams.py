"""Beams and cables of scenes: meshes, sections, cards, and runs against theory."""
from __future__ import annotations

import math
import os
from typing import Any

import courant
import numpy as np
import pytest
from courant.scene.beams import Section, beam_mesh

needs_program = pytest.mark.skipif(not os.environ.get("COURANT_EXECUTABLE"), reason="needs the program")
RECTANGLE = {"rectangle": [0.01, 0.02]}


def said(scene: courant.Scene) -> str:
    with pytest.raises(courant.CourantError) as fault:
        scene.deck()
    return str(fault.value).partition("error: ")[2]


def one(**keys: Any) -> courant.Scene:
    given = {"beam": [[0, 0, 0], [1, 0, 0]], "section": RECTANGLE, "material": "steel", "fix": "start"} | keys
    return courant.Scene("beam", end=0.1).structure(**given)


def test_sections() -> None:
    """Against formulas of the same shapes: a thin tube 2 pi r t, pi r^3 t; a square 0.1406 a^4 in torsion (Timoshenko and Goodier, article 109)."""
    tube = Section("tube", (2.001, 0.001))
    assert tube.area == pytest.approx(2 * math.pi * 0.001, rel=1e-6) and tube.stiffness()[0] == pytest.approx(math.pi * 0.001, rel=1e-5)
    assert Section("rectangle", (2.0, 2.0)).stiffness()[2] == pytest.approx(0.1406 * 16, rel=2e-3)
    upright, across, _, shear = Section("rectangle", (1.0, 2.0)).stiffness()
    assert (upright, across, shear) == pytest.approx((2 / 12, 8 / 12, 5 / 3))
    assert Section("rod", (2.0,)).stiffness()[:3] == pytest.approx((math.pi / 4, math.pi / 4, math.pi / 2))


def test_lines_share_nodes_where_they_meet() -> None:
    lines = [np.array([[0, 0, 0], [2.0, 0, 0]]), np.array([[1.0, 0, 0], [1, 1, 0]]), np.array([[2.0, 0, 0], [1, 1, 0], [0, 0, 0]])]
    mesh = beam_mesh(lines, 0.5)
    assert len(mesh.cells) == 4 + 2 + 3 + 3 and len(mesh.points) == 5 + 2 + 2 + 2 and not mesh.groups
    assert np.bincount(mesh.cells.ravel()).max() == 3 and len(np.unique(np.sort(mesh.cells, axis=1), axis=0)) == len(mesh.cells)
    alone = beam_mesh([np.array([[3.0, 0, 0], [2, 0, 0]])], 0.0)
    assert len(alone.cells) == 16 and alone.points[alone.groups["start"]].tolist() == [[3, 0, 0]] and alone.points[alone.groups["end"]].tolist() == [[2, 0, 0]]


@pytest.mark.parametrize(("across", "at"), [(6.4, 0.62), (1.0, 1 / 3), (1.0, 0.333333)])
def test_a_line_that_ends_on_another_one_joins_it(across: float, at: float) -> None:
    mesh = beam_mesh([np.array([[0, 0, 0], [6.0, 0, 0]]), np.array([[at, 0, 0], [at, 0, across]])], 0.5)
    assert (np.bincount(mesh.cells.ravel()) == 3).sum() == 1 and (np.bincount(mesh.cells.ravel()) == 1).sum() == 3


def test_ties_with_a_common_node_are_one_body() -> None:
    scene = courant.Scene("legs", end=0.1).structure(title="block", box={"low": [0.9, -0.1, -0.1], "high": [1.1, 0.1, 0.1]}, material="steel", size=0.2, fix="bottom")
    for leg in ([[1, 0, 0.1], [1, 0, 1]], [[1, 0, 0.1], [1, 1, 1]]):
        scene.structure(beam=leg, section=RECTANGLE, material="steel", join={"start": "block"})
    assert str(scene.deck()).count("*CONSTRAINED_NODAL_RIGID_BODY") == 1


@pytest.mark.parametrize(("keys", "text"), [
    ({"section": None}, "'section' is missing: a beam has one"), ({"section": {"rod": 0.1, "cable": 1}}, "section: expected one of rod, tube, rectangle, cable, got rod and cable"),
    ({"section": {"tube": [0.02, 0.01]}}, "tube: its wall of 0.01 is as thick as half of the diameter 0.02"),
    ({"section": {"rectangle": 0.1}}, "rectangle: expected width and height"), ({"section": RECTANGLE | {"up": [1, 0, 0]}}, "up: some of the beams run along it"),
    ({"section": RECTANGLE | {"tension": 5}}, "tension: of a cable"), ({"section": {"rod": 0.1, "up": [0, 0, 1]}}, "up: direction of the height of a rectangle"),
    ({"beam": [[0, 0, 0]]}, "beam: a line has two points or more"), ({"beam": [[0, 0, 0], [0, 0, 0]]}, "beam: two points of the line that follow each other are the same"),
    ({"beam": 3}, "beam: expected a list of points"), ({"thickness": 0.1}, "thickness: of shells, and these are beams"), ({"fix": "feet"}, "fix: unknown name 'feet'"),
    ({"section": {"cable": 0.01}, "material": {"like": "steel", "yield": 1e8}}, "a cable is elastic"), ({"join": {"end": "hull"}}, "join: there is no wall, body or structure 'hull'"),
    ({"join": "end"}, "join: expected nodes, and the part"), ({"beam": None, "box": {"low": [0, 0, 0], "high": [1, 1, 1]}, "fix": "left"}, "section: of beams, and this is a box")])
def test_mistakes(keys: dict[str, Any], text: str) -> None:
    assert text in said(one(**keys))


def test_a_join_far_away_and_a_slender_warning(tmp_path) -> None:  # type: ignore[no-untyped-def]
    scene = one(title="a").structure(title="b", beam=[[1.5, 0, 0], [2, 0, 0]], section=RECTANGLE, material="steel", join={"start": "a"})
    assert "join: the node of 'b' at (1.5, 0, 0) is 0.5 away from 'a', whose elements are 0.0625 long" in said(scene)
    file = tmp_path / "thick.yaml"
    file.write_text(one(size=0.1, section={"rod": 0.5}).to_yaml())
    assert any("beams are slender" in (found.hint or "") for found in courant.check(file).all)


def test_yaml_and_back(tmp_path) -> None:  # type: ignore[no-untyped-def]
    scene = one(join={"end": "load"}, track=[(1, 0, 0)]).body(title="load", box={"low": [1, -0.1, -0.1], "high": [1.2, 0.1, 0.1]}, density=100)
    scene.to_yaml(tmp_path / "a.yaml")
    cards = [line for line in scene.deck().splitlines() if not line.startswith("$")]
    assert cards == [line for line in courant.Scene.from_yaml(tmp_path / "a.yaml").deck().splitlines() if not line.startswith("$")]
    assert "go with part 101" in scene.explain() and "*CONSTRAINED_EXTRA_NODES_NODE" in scene.deck() and "touches nothing" in scene.explain()


def test_beams_in_water_touch_nothing_and_have_no_gauge_of_force() -> None:
    scene = courant.Scene("pile", spacing=0.1, end=1).water(low=(0, 0, 0), high=(1, 1, 1)).box(low=(0, 0, 0), high=(1, 1, 2), open="top")
    scene.structure(title="pile", beam=[[0.5, 0.5, 0], [0.5, 0.5, 1.5]], section={"rod": 0.05}, material="steel", fix="bottom")
    assert "*SECTION_SHELL" in scene.deck() and "water against deformable parts" not in scene.deck() and "water flows through it" in scene.explain()
    assert "part 'pile' has beams alone, which water flows through" in said(scene.gauge("f", force="pile"))


def _motion(run: Any, point: tuple[float, ...], axis: str) -> tuple[np.ndarray, np.ndarray]:
    table = run.track(point)
    return np.asarray(table["t"]), np.asarray(table[f"displacement.{axis}"])


def _mean_and_period(t: np.ndarray, z: np.ndarray, middle: float) -> tuple[float, float]:
    """Of whole periods of an oscillation about `middle`."""
    at = np.flatnonzero((z[:-1] < middle) & (z[1:] >= middle))
    crossings = t[at] + (middle - z[at]) / (z[at + 1] - z[at]) * (t[at + 1] - t[at])
    inside = (t >= crossings[0]) & (t <= crossings[-1])
    return float(z[inside].mean()), float(np.diff(crossings).mean())


@needs_program
def test_cantilevers_under_their_weight(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """Suddenly loaded, they oscillate about rho A g L^4/(8 EI) with the period of their first mode, 2 pi/(1.8751^2) sqrt(rho A L^4/(EI)): within 1 %."""
    young, density, g = 210e9, 7850.0, 9.81
    scene, cases = courant.Scene("cantilevers", end=0.16, output=0.005), list[tuple[float, float, float]]()
    yields = {"like": "steel", "yield": 1e9, "tangent": 1e9}
    for y, (section, material) in enumerate((({"rectangle": [0.01, 0.02]}, "steel"), ({"rectangle": [0.02, 0.01], "up": [0, 1, 0]}, "steel"), ({"rod": 0.02}, "steel"),
                                             ({"tube": [0.02, 0.002]}, "steel"), ({"rectangle": [0.01, 0.02]}, yields), ({"tube": [0.02, 0.002]}, yields))):
        scene.structure(title=f"b{y}", beam=[[0, y, 0], [1, y, 0]], section=section, material=material, fix="start", track=[(1, y, 0)])
        inner = 0.016 if "tube" in section else 0.0
        area, inertia = (2e-4, 0.01 * 0.02**3 / 12) if "rectangle" in section else (math.pi / 4 * (0.02**2 - inner**2), math.pi / 64 * (0.02**4 - inner**4))
        cases.append((y, density * area * g / (8 * young * inertia), 2 * math.pi / 1.8751**2 * math.sqrt(density * area / (young * inertia))))
    run = scene.run(tmp_path, quiet=True)
    for y, deflection, period in cases:
        mean, found = _mean_and_period(*_motion(run, (1, y, 0), "z"), -deflection)
        assert mean == pytest.approx(-deflection, rel=0.01) and found == pytest.approx(period, rel=0.01), y


@needs_program
def test_joined_parts_move_as_one(tmp_path) -> None:  # type: ignore[no-untyped-def]
    """A beam of two structures, one on a plate that is held, and one on a block: the same motion as a beam in one piece, to round-off and to 0.1 %."""
    scene = courant.Scene("joined", end=0.03, output=0.003)
    common = {"section": RECTANGLE, "material": "steel", "size": 0.1}
    scene.structure(beam=[[0, 0, 0], [1, 0, 0]], fix="start", title="whole", track=[(1, 0, 0)], **common)
    scene.structure(beam=[[0, 1, 0], [0.5, 1, 0]], fix="start", title="half", **common)
    scene.structure(beam=[[0.5, 1, 0], [1, 1, 0]], join={"start": "half"}, title="rest", track=[(1, 1, 0)], **common)
    scene.structure(plate={"origin": (0, 1.9, -0.1), "edge1": (0, 0.2, 0), "edge2": (0, 0, 0.2)}, thickness=0.01, size=0.1, material="steel", fix="x < 1", title="plate")
    scene.structure(beam=[[0, 2, 0], [1, 2, 0]], join={"start": "plate"}, title="on it", track=[(1, 2, 0)], **common)
    scene.structure(box={"low": (-0.1, 2.9, -0.1), "high": (0, 3.1, 0.1)}, size=0.1, material="steel", fix="left", title="block")
    scene.structure(beam=[[0, 3, 0], [1, 3, 0]], join={"start": "block"}, title="at it", track=[(1, 3, 0)], **common)
    run = scene.run(tmp_path, quiet=True)
    whole, *others = (_motion(run, (1, y, 0), "z")[1] for y in range(4))
    for other, bound in zip(others, (1e-6, 1e-6, 1e-3)):
        assert np.abs(other - whole).max() < bound * np.abs(whole).max()


@needs_program
@pytest.mark.parametrize("dim", [2, 3])
def test_a_load_on_a_cable(dim: int, tmp_path) -> None:  # type: ignore[no-untyped-def]
    """It falls by 2 m g L/(E A), half of the mass of the cable included, within 1 %, and rises again to where it was within 2 % of that; the cable is
    massless beside it."""
    corner = [0.1] * dim
    scene = courant.Scene("load", end=0.06, output=0.005)
    scene.body(title="load", box={"low": [-v for v in corner], "high": corner}, density=2000 * (1 if dim == 3 else 0.2))
    top, bottom = [0.0] * (dim - 1) + [2.1], [0.0] * (dim - 1) + [0.1]
    scene.structure(title="rope", beam=[top, bottom], section={"cable": 0.004}, material={"density": 100, "young": 210e9}, size=0.5, fix="start", join={"end": "load"},
                    track=[bottom])
    run = scene.run(tmp_path, quiet=True)
    t, z = _motion(run, tuple(bottom), "xyz"[dim - 1])
    static = 16 * 9.81 * 2 / (210e9 * math.pi * 0.002**2)
    assert z.min() == pytest.approx(-2 * static, rel=0.01) and z[t > 0.03].max() == pytest.approx(0, abs=0.04 * static)
