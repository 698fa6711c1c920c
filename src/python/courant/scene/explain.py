"""The choices that a scene leaves out, what was taken and why, and the cards that they became."""
from __future__ import annotations

from typing import TYPE_CHECKING

from .model import Model
from .numbers import number_text
from .still_water import has_oblique_walls

if TYPE_CHECKING:
    from .basin import Basin


def explain_basin(basin: Basin, model: Model) -> None:
    up = "xyz"[basin.dim - 1]

    def add(choice: str, reason: str, cards: str) -> None:
        model.choices.append((choice, reason, cards))

    add(f"{basin.dim} dimensions, {up} upwards", "corners have two components in the plane, three in space", "*CONTROL_SPH IDIM")
    add(f"sound speed {number_text(basin.sound_speed)}", "given" if basin.speed_given else
        "twenty times the speed of a fall over the height of the water, with those of inlets, bodies and driven walls: a blow squeezes it by a twentieth; softer than real water, so that steps are longer",
        "*EOS_LINEAR_POLYNOMIAL C1")
    add(f"artificial viscosity {number_text(basin.friction)}", "given" if basin.viscosity is not None else
        "none, as it damps waves; density diffusion smooths the sound of blows", "*HOURGLASS Q2")
    add("Wendland C4 kernel, h twice the spacing, density diffusion 0.1",
        "a wave of four particles in its height loses 0.6 % of it in a period, 10 % with the cubic spline and viscosity 0.02",
        "*SECTION_SPH CSLH, *COURANT_KERNEL, *COURANT_DENSITY_DIFFUSION")
    add("the water takes tension" if basin.tension else "the water takes no tension",
        "water under suction stays in one piece" if basin.tension else "given", "*MAT_NULL PC")
    add("steps of 0.5 of the longest stable ones", "still water then keeps its energy to 0.2 %, at 0.9 to 1.4 %", "*CONTROL_TIMESTEP TSSFAC")
    if basin.box or basin.solids:
        right = "beside mirrors pressure is right in all rows, where contact alone gives 1.39 of it in the lowest"
        cheap = "shells push particles back that come nearer than half a spacing; cheap, but the lowest row has 1.39 of its pressure"
        dear = "; walls of other shapes act by contact, as mirrors of many faces take most of the time of a run; bodies of few faces are mirrors, as contact lets them float too deep"
        if basin.dim == 3 and basin.mirrors and any(solid.free for solid in basin.solids):
            right += "; beside edges of bodies in space they take some 100 us per particle and step, ghosts some 3 us in calm water"
        behind = "fixed ghost particles continue the lattice of the water behind walls: right on walls of any slope, for walls that are dry on one side"
        if basin.still:
            behind += "; taken as the water is at rest and nothing moves it: mirrors leave it in motion beside oblique walls"
        elif basin.method == "mirrors" and has_oblique_walls(basin):
            right += "; beside oblique walls still water moves: wall_method: ghosts keeps it at rest, but lifts fast water off slopes"
        reason = {"mirrors": right, "contact": cheap, "mixed": right + dear, "ghosts": behind}[basin.method]
        add({"mirrors": "walls are mirrors", "contact": "walls act by contact", "ghosts": "walls have ghost particles behind them", "mixed": "box and bodies are mirrors, other walls act by contact"}[basin.method] + "".join(f", '{solid.shape.name}', too" for solid in basin.solids if solid.by_contact), reason,
            (f"*COURANT_WALL_SUPPORT METHOD {2 if basin.method == 'ghosts' else 1}, " if basin.mirrors else "") + "*CONTACT_AUTOMATIC_NODES_TO_SURFACE")
    if basin.mirrors:
        pressure = basin.water.pressure
        add(f"pressure at the start {pressure.text}" if pressure else "no pressure at the start", "still water does not begin with a blow" if pressure else
            "the water moves, is not on the floor of a box, or has several surfaces; water: pressure gives one", "*INITIAL_STRESS_SPH" if pressure else "none")
    explain_solids(basin, model)
    if any(solid.free for solid in basin.solids):
        add("bodies touch walls" if basin.dim == 3 else "bodies pass through walls and fall through the floor", "all that can touch does" if basin.dim == 3 else
            "the program knows no contact of elements in the plane", "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE" if basin.dim == 3 else "none")
    explain_output(basin, model)


def explain_solids(basin: Basin, model: Model) -> None:
    def add(choice: str, reason: str, cards: str) -> None:
        model.choices.append((choice, reason, cards))

    for solid in basin.solids:
        if solid.free:
            mass, centre, _ = solid.shape.inertia(solid.density)
            add(f"'{solid.shape.name}' weighs {number_text(mass)}, centre at {', '.join(f'{v:.4g}' for v in centre)}",
                "from its volume and density, as if it were filled evenly", f"*PART_INERTIA {solid.part}")
        elif solid.piston is not None and solid.piston.own_card:
            add(f"'{solid.shape.name}' is a {solid.piston.maker} that makes waves" + (" and absorbs those that come back" if solid.piston.absorb else ""), "given",
                f"*COURANT_WAVE_MAKER {solid.part}")
        elif solid.rotation is not None:
            add(f"'{solid.shape.name}' {solid.rotation.text()}", "given", f"*BOUNDARY_PRESCRIBED_MOTION_RIGID {solid.part}")
        elif solid.motion:
            add(f"'{solid.shape.name}' moves along {' and '.join(solid.motion)}", "given", f"*BOUNDARY_PRESCRIBED_MOTION_RIGID {solid.part}")
        else:
            add(f"'{solid.shape.name}' is held", "walls do not move without a motion", f"*PART {solid.part}, *MAT_RIGID 2")
        if basin.wet:
            add(f"water keeps out of '{solid.shape.name}'" if solid.closed or solid.shape.ground else f"'{solid.shape.name}' is thin: water on both sides",
                "closed shapes are solid; open ones have no inside", "*ELEMENT_SPH")


def explain_output(basin: Basin, model: Model) -> None:
    model.choices.append((f"states each {number_text(basin.output)}, histories each {number_text(basin.output / 10)}",
                          "a hundredth and a thousandth of the end, if not given", "*DATABASE_BINARY_D3PLOT, *DATABASE_GLSTAT, *DATABASE_MATSUM"))


def explained(model: Model) -> str:
    """One choice after the other: what, why, where in the deck."""
    return "".join(f"{choice}\n  why: {reason}\n  cards: {cards}\n" for choice, reason, cards in model.choices) or "the scene leaves nothing open: its cards are its own\n"
