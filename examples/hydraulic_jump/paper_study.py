"""The study of `paper.sh --study`: the paper's jump with one option or number of the deck changed at a time, means over runs that differ in the last
digits of v1, error against processor time."""
import math
import statistics

import paper_figures
from paper_figures import BELANGER, V1, WEIR_DEPTH
from case_post import read_table
from page_text import number, table

NUDGE = 1e-6        # of v1 from one run of a variant to the next: nothing to the flow, all to a breaking wave
TITLES = {"options": "Options of the deck", "numbers": "Numbers of the paper's setting"}


def entries(file):
    """Lines of study_runs.yaml as those of paper_runs.yaml, one for each run."""
    out, common = [], file["common"]
    for variant in file["variants"]:
        line = common | variant
        for k in range(line["runs"]):
            parameters = common["parameters"] | variant.get("parameters", {}) | {"v1": V1 * (1 - k * NUDGE)}
            out.append(line | {"name": f"study/{variant['name']}.{k + 1}", "variant": variant["name"], "group": "study", "setting": variant["label"], "parameters": parameters})
    return out


def by_variant(shown):
    """[(first run, numbers of each of its runs)], in the order of the file."""
    variants = {}
    for run, found in shown:
        variants.setdefault(run.variant, (run, []))[1].append(measures(run, found) | {"threads": found["run"]["threads"]})
    return list(variants.values())


def depths(run):
    """Depth at x = 1 m of the states in the window: the top of the highest water, whatever cavity is below it."""
    low, high = run.settled
    return [d for t, d in zip(*(read_table(run.folder / "bed_and_volume" / "depths.csv")[key] for key in ("t", "depth@1"))) if low - 1e-3 <= t <= high + 1e-3]


def measures(run, found):
    """Numbers of one run."""
    d = depths(run)
    depth = statistics.fmean(d)
    return {"A": math.sqrt(statistics.fmean([one**2 for one in d])) / BELANGER, "P": math.sqrt(statistics.fmean([(one - BELANGER) ** 2 for one in d])) / BELANGER, "depth": 1000 * depth,
            "weir": 100 * (depth / WEIR_DEPTH - 1), "turn": float(found["jump"].get("turn", {}).get("time", math.nan)), "filled": 100 * found["bed"]["filled_ratio"],
            "rows": 100 * found["bed"]["row_ratio"], "residual": 100 * found["run"]["residual"], "leaked": found["run"]["leaked_particles"], "cpu": found["run"]["cpu_seconds"]}


def spread(values):
    """Mean and standard deviation of one run; the deviation is nan for a single one."""
    values = [v for v in values if not math.isnan(v)]
    if not values:
        return math.nan, math.nan
    return statistics.fmean(values), statistics.stdev(values) if len(values) > 1 else math.nan


def cell(values, digits):
    mean, deviation = spread(values)
    if math.isnan(mean):
        return "-"
    return f"{mean:.{digits}f}" + ("" if math.isnan(deviation) else f" ± {deviation:.{digits}f}")


def rows(variants, base):
    """Of a table; the last column is the processor time over that of the base."""
    out = []
    for run, numbers in variants:
        all_of = {key: [one[key] for one in numbers] for key in numbers[0]}
        out.append([run.label, len(numbers), cell(all_of["A"], 3), cell(all_of["P"], 3), cell(all_of["depth"], 1), cell(all_of["weir"], 1), cell(all_of["turn"], 2), cell(all_of["filled"], 1),
                    cell(all_of["rows"], 0), f"{spread(all_of['residual'])[0]:.2f}", sum(all_of["leaked"]), f"{spread(all_of['cpu'])[0]:.0f}", number(spread(all_of["cpu"])[0] / base, "{:.2f}")])
    return out


def pareto(variants, base):
    """P over processor time: what an option costs and what it brings."""
    points = []
    for run, numbers in variants:
        points.append(paper_figures.curve([spread([one["cpu"] for one in numbers])[0] / base], [spread([one["P"] for one in numbers])[0]], run.variant.replace("_", " "), "named"))
    return points


def sections(shown, page_folder, project):
    variants = by_variant(shown)
    base = next((spread([one["cpu"] for one in numbers])[0] for run, numbers in variants if run.variant == "base"), math.nan)
    head = ["changed", "runs", "A", "P", "depth at x = 1 m [mm]", f"against the weir's {1000 * WEIR_DEPTH:.1f} mm [%]", "jump turns [s]", "filled/depth [%]", "bed row/next [%]", "energy residual [%]", "leaked", "processor time [s]", "of the first"]
    threads = sorted({one["threads"] for _, numbers in variants for one in numbers})
    parts = [f"d1/4, 2.5 to 5 s, threads: {', '.join(map(str, threads))}; mean ± standard deviation of single runs, which differ in v1 by a millionth. Two means of three runs are alike "
             f"where they differ by less than about twice the larger deviation. Single runs have no deviation. A, P: Table 2 of the paper (0.969, 0.049 at d1/4), against Bélanger's {1000 * BELANGER:.1f} mm, from states 0.05 s apart, to the top of the highest water; the weir's "
             f"depth, {1000 * WEIR_DEPTH:.1f} mm, is what critical flow over it allows ([theory.md](theory.md#hydraulic-jump)). *Filled*: the depth at x = 1 m that the particles' own volume m/ρ fills over that of the surface. *Bed row*: mean "
             "velocity of the row of particles at the bed over the next, x = 0.1 to 1 m. *Residual*: of the energy ledger over what passed through. Kernels *as wide*: CSLH with the second moment of the cubic spline's 1.2. *ν*: of the "
             "artificial viscosity, q1 c0 h/8. *Windows*: `*COURANT_PAIR_GEOMETRY` 0.04. Settings: `examples/hydraulic_jump/study_runs.yaml`, recipe `keyword_decks/hydraulic_jump/study.yaml`.\n"]
    for name, title in TITLES.items():
        chosen = [one for one in variants if name in one[0].tables]
        if chosen:
            parts.append(f"## {title}\n\n" + table(head, rows(chosen, base)) + "\n")
    folder = paper_figures.figure_folder(page_folder)
    options = [one for one in variants if "options" in one[0].tables]
    figures = []
    if options and not math.isnan(base):
        figures.append(paper_figures.figure("study_cost", "Error of the depth against processor time, options of the deck", "processor time over that of the paper's setting [-]", "P, eq. 20 [-]", pareto(options, base),
                                            [paper_figures.line("paper, 0.049", y=[0.049], across="y")]))
    parts.append(paper_figures.section(paper_figures.draw(figures, folder, project), page_folder))
    return parts
