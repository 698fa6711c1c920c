"""Evaluates a run with the recipes of keyword_decks/hydraulic_jump: `courant post` measures, here its numbers are gathered in evaluated.yaml."""
import math
import pathlib
import re

from case_post import at, evaluate_once, mean, post, read_table, scalars

def window(run):
    return {"&from": run.settled[0], "&to": run.settled[1]}


# ---- the paper's cases

def events(table, jump):
    """When the depth at x = 1 m rises, and when the toe has come back to the gate."""
    times, turn = table["t"], float(jump.get("turn", {}).get("time", math.inf))
    rises = next((t for t, d in zip(times, table["depth_over_theory"]) if d > 0.5), math.nan)
    gate = next((t for t, x in zip(times, table["toe"]) if t > turn and x <= 0.04), math.nan)
    return {"depth_rises": rises, "at_gate": gate}


def bed_rows(run):
    """Where the row of particles at the bed and the next one are, for a recipe."""
    dx = 0.02 / run.parameters["resolution"]
    return {"&y1": dx / 2, "&y2": 1.75 * dx, "&row1": f'"{dx} - y"', "&row2": f'"min(y - {dx}, {2.5 * dx} - y)"'}


def bed_and_volume(folder):
    """Of tables that `courant post` wrote by bed_and_volume.yaml or study.yaml."""
    first, second, depth = (read_table(folder / f"{name}.csv") for name in ("row1", "row2", "depths_mean"))
    both = [(a, b) for a, b in zip(first["vx_mean"], second["vx_mean"]) if not math.isnan(a + b)]
    ratio = mean([a for a, _ in both]) / mean([b for _, b in both]) if both else math.nan
    filled = [f / d if d > 0 else math.nan for f, d in zip(depth["filled"], depth["mean"])]
    return {"row1": first["vx_mean"][0], "row2": second["vx_mean"][0], "row_ratio": ratio,
            "filled_ratio": filled[-1], "filled_ratio_mean": mean(filled), "depth": depth["mean"][-1], "filled": depth["filled"][-1]}


def volume_drift(run, program, scenes, threads):
    """Filled over depth from the middle of a run on and at its end, a sixth of it each, means over the basin: both are of the settled state."""
    out, sixth = {}, run.parameters["endtim"] / 6
    for name, begin in (("early", 3), ("late", 5)):
        part = {"&from": round(begin * sixth, 6), "&to": round((begin + 1) * sixth, 6)}
        post(run, program, scenes / "bed_and_volume.yaml", bed_rows(run) | part, threads)
        out[name] = bed_and_volume(run.folder / "bed_and_volume")["filled_ratio_mean"]
    return out


def evaluate_paper(run, program, scenes, threads):
    jump = post(run, program, scenes / "post.yaml", {}, threads)["jump"]
    out = {"jump": jump, "events": events(read_table(run.folder / "depth.csv"), jump)}
    if run.figures:
        out["volume"] = volume_drift(run, program, scenes, threads)
    post(run, program, scenes / "bed_and_volume.yaml", bed_rows(run) | window(run), threads)
    out["bed"] = bed_and_volume(run.folder / "bed_and_volume")
    if run.figures:
        numbers = window(run) | {"&moment": run.settled[1] - 0.005, "segment:": run.segment, "&toe": run.toe}
        out["analyses"] = scalars(post(run, program, scenes / "paper_figures.yaml", numbers, threads))
    return out


def evaluate_study(run, program, scenes, threads):
    jump = post(run, program, scenes / "study.yaml", bed_rows(run) | window(run), threads)["jump"]
    return {"jump": jump, "bed": bed_and_volume(run.folder / "bed_and_volume")}


# ---- standing jumps

def deck_values(deck):
    """What the scene wrote down: `$ value NAME NUMBER`."""
    found = re.findall(r"^\$ value (\w+) (\S+)$", deck.read_text(), re.M)
    return {name: float(value) for name, value in found}


def local_inflow(folder, toe, deviation, d1):
    """Depth and velocity of the jet three depths, or three deviations of the toe, upstream of the toe."""
    surface, flux = read_table(folder / "surface_mean.csv"), read_table(folder / "fluxes_mean.csv")
    x = toe - 3 * max(d1, deviation)
    speeds = [p / m if m > 0 else math.nan for p, m in zip(flux["momentum_x_mean"], flux["mass_mean"])]
    return x, at(surface["x"], surface["mean"], x), at(flux["at"], speeds, x)


def sequent_depth(folder, values):
    """Mean depth one to two d2 before the channel's end, by the surface and by the particles' volume."""
    surface = read_table(folder / "surface_mean.csv")
    low, high = values["end"] - 2 * values["d2"], values["end"] - values["d2"]
    rows = [k for k, x in enumerate(surface["x"]) if low <= x <= high]
    return mean([surface["mean"][k] for k in rows]), mean([surface["filled"][k] for k in rows])


def least_decay_rms(folder, froude, decay_to=20):
    """How far from eq. 3 the largest velocity must be at least: along the bed, under hydrostatic pressure, nothing is faster than without losses,
    V^2 <= v1^2 - 2 g (eta - d1), eta the mean surface that was found."""
    surface, line = read_table(folder / "roller_surface.csv"), read_table(folder / "roller.csv")
    errors = []
    for distance, decay in zip(line["distance"], line["decay"]):
        eta = at(surface["distance"], surface["mean"], distance)
        if 0 < distance <= decay_to and not math.isnan(eta):
            errors.append(max(0, 1 - math.sqrt(max(0, 1 - 2 * (eta - 1) / froude**2)) / decay) ** 2)
    return math.sqrt(mean(errors))


def evaluate_standing(run, program, scenes, threads):
    values = deck_values(run.deck)
    d1, recipe, folder = values["d1"], scenes / "standing_figures.yaml", run.folder / "standing"
    numbers = window(run) | {"&segment": run.segment, "&end": round(values["end"] - 0.02, 6), "&top": round(1.5 * values["d2"], 3)}
    toe = scalars(post(run, program, recipe, numbers | {"&v1": values["v1"], "&d1": d1}, threads))["toe"]
    x, depth, speed = local_inflow(folder, toe["toe_mean"], toe["toe_deviation"], d1)
    at_gate = math.isnan(depth) or math.isnan(speed)
    if at_gate:  # no jet to be seen: the inflow itself
        depth, speed = d1, values["v1"]
    found = scalars(post(run, program, recipe, numbers | {"&v1": speed, "&d1": depth}, threads))
    behind, filled = sequent_depth(folder, values)
    froude = speed / math.sqrt(9.81 * depth)
    return {"analyses": found, "values": values,
            "local": {"x": x, "d1": depth, "v1": speed, "froude": froude, "at_gate": at_gate, "d2": behind, "d2_filled": filled,
                      "decay_least": least_decay_rms(folder, froude), "d2_theory": depth / 2 * (math.sqrt(1 + 8 * froude**2) - 1)}}


# ---- all

def asked(run):
    """What paper_runs.yaml asks of the evaluation: with other requests it is made again."""
    return {"settled": list(run.settled), "segment": run.segment, "toe": run.toe, "figures": run.figures, "scene": run.scene.name, "case": run.case}


def evaluate(run, program, scenes, threads, say):
    work = {"standing": evaluate_standing, "study": evaluate_study}.get(run.group, evaluate_paper)
    made_from = [pathlib.Path(__file__), *scenes.glob("*.yaml")]
    evaluate_once(run, program, asked(run), made_from, lambda: work(run, program, scenes, threads), say)
