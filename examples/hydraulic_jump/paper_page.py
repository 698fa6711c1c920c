"""Writes the pages, one of the paper's cases and one of standing jumps: tables from what `paper_evaluate` gathered, figures from what `courant post` drew."""
import paper_figures
import paper_study
from case_post import evaluated
from case_runs import EVALUATED, age
from page_text import heading, hours, number, percent, table
from paper_evaluate import asked

SETTINGS = ("*plates*: `scene.yaml` as the paper has it, with c0 = 30 m/s; *supported*: `supported_bed.yaml`, bed and weir complete the sums of the particles beside "
            "them, all else as before; *better*: the same, an eddy viscosity of v1 d1/10 at all spacings (q1 = 0.13 to 0.33), density diffusion 0.1, volume control with TAU = 0.1 s; *c0 = 1484 m/s*: `scene.yaml` "
            "with the paper's speed of sound.\n")


def command(options):
    words = [word for word, given in (("--paper-setting", options.paper_setting), ("--standing", options.standing), ("--study", options.study), ("--quick", options.quick)) if given]
    if options.only:
        words.append(f"--only {options.only}")
    return " ".join(["bash examples/hydraulic_jump/paper.sh", f"--threads {options.threads}", *words])


def top(title, options, program, project, shown):
    old = list(dict.fromkeys(run.variant for run, _ in shown if age(run.folder / EVALUATED) < program.age))
    about = ("What the runs are and how they compare is discussed in [hydraulic_jump.md](hydraulic_jump.md); the measurement of each number is described in [post.md](post.md) and in the recipes of "
             "`keyword_decks/hydraulic_jump`. The paper's numbers are cited by table, figure or equation.")
    return heading(title, command(options), about, 0.2 if options.quick else None, program, project, old)


def label(run):
    """Case and setting of a row."""
    return [run.case, run.setting]


def table1(shown, paper):
    rows = []
    for run, found in shown:
        theirs, ours = paper["table1"][run.case], found["run"]
        rows.append(label(run) + [f"{run.parameters['endtim']:g}", theirs[0], ours["particles"], theirs[1], ours["threads"], f"{theirs[2]} h", hours(ours["cpu_seconds"]),
                                  ours["steps"], number(1e9 * ours["cpu_seconds"] / ours["particle_steps"], "{:.0f}")])
    head = ["case", "setting", "flow [s]", "particles, paper", "here", "cores, paper", "here", "time, paper", "processor time, here", "steps", "ns of it per particle and step"]
    return "## Table 1: size and time\n\n" + table(head, rows) + "\n\nThe paper's columns: Table 1. Its cases ran with c0 = 1484 m/s. Settings: " + SETTINGS


def table2(shown):
    rows = []
    for run, found in shown:
        for interval in found["jump"]["intervals"]:
            if not interval["states"] or not interval["complete"]:
                continue
            theirs = (interval.get("published") or [{}])[0]
            rows.append(label(run) + [f"{float(interval['from']):g}-{float(interval['to']):g}", number(theirs.get("A"), "{:.3f}"), number(interval["A"], "{:.3f}"),
                                      number(theirs.get("P"), "{:.3f}"), number(interval["P"], "{:.3f}"), number(1000 * float(interval["mean_depth"]), "{:.1f}"),
                                      number(100 * (float(interval["mean_depth"]) / paper_figures.WEIR_DEPTH - 1), "{:+.1f} %")])
    order = list(dict.fromkeys(run.setting for run, _ in shown))
    rows.sort(key=lambda row: (order.index(row[1]), float(row[2].split("-")[0])))
    head = ["case", "setting", "interval [s]", "A, paper", "here", "P, paper", "here", "mean depth [mm]", "against the weir's"]
    d2 = 1000 * float(shown[0][1]["jump"]["d2_theory"])
    return (f"## Table 2: depth at x = 1 m against Bélanger, {d2:.1f} mm\n\n" + table(head, rows) +
            "\n\nA and P: eqs 19 and 20, recipe `keyword_decks/hydraulic_jump/post.yaml`; the paper's columns: Table 2. *The weir's*: 81.7 mm, the depth at which critical flow over the weir lets the inflow out ([theory.md](theory.md#hydraulic-jump)); it, and not Bélanger's, is the limit of a jump that has reached the weir.\n")


def course(shown, paper):
    theirs = paper["numbers"]
    keys = ("depth_rises", "turns", "at_gate")
    rows = [["paper", "c0 = 1484 m/s"] + [f"{theirs[key]['value']} ({theirs[key]['source']})" for key in keys]]
    for run, found in shown:
        turn = found["jump"].get("turn", {}).get("time")
        rows.append(label(run) + [number(found["events"]["depth_rises"], "{:.2f}"), number(turn, "{:.2f}"), number(found["events"]["at_gate"], "{:.1f}")])
    head = ["case", "setting", "depth at x = 1 m rises [s]", "jump turns [s]", "toe back at the gate [s]"]
    return ("## Course of events\n\n" + table(head, rows) + "\n\nThe depth rises: first over half of Bélanger's. The jump turns: the toe (depth over 2.5 d1) stands furthest "
            "downstream. At the gate: within 2 d1 of it; the paper gives the time for d1/4 alone.\n")


def settled(shown, paper):
    """Lengths, decay, deviations and frequencies against eqs 2 to 5, a column for each run with figures."""
    runs = [(run, found) for run, found in shown if "analyses" in found]
    if not runs:
        return ""
    rollers = [found["analyses"]["roller"] for _, found in runs]
    theirs, first, d1 = paper["numbers"], rollers[0], 0.02
    length, frequency = theirs["roller_length"]["value"] / d1, theirs["frequency"]["value"]

    def row(title, published, reference, key, form="{:.3g}", factor=1):
        return [title, published, reference] + [number(factor * roller[key], form) for roller in rollers]
    rows = [
        ["mean toe x1 [m]", "0", "-"] + [number(found["analyses"]["toe"]["toe_mean"], "{:.3f}") for _, found in runs],
        row("length of the roller, Lr/d1: mean velocity nowhere negative", f"{length:.2f} ({theirs['roller_length']['source']})", number(first["roller_length_reference"], "{:.2f} (eq. 2)"), "roller_length", "{:.2f}"),
        row("the same: stagnation point at the surface", "-", number(first["roller_length_surface_reference"], "{:.2f} (eq. 2)"), "roller_length_surface", "{:.2f}"),
        row("V_max against its decay, rms up to 20 d1", "-", "0 % (eq. 3)", "decay_rms", "{:.1f} %", 100),
        row("largest deviation of the surface, (η'/d1)max", "-", number(first["deviation_largest_reference"], "{:.3f} (eq. 4)"), "deviation_largest", "{:.3f}"),
        row("found at (x - x1)/d1", "-", "10 to 15 (section 1, experiments)", "deviation_largest_at", "{:.1f}"),
        row("dominant frequency of the depth [Hz]", f"{frequency} ({theirs['frequency']['source']})", number(first["strouhal_reference"] * 1.5 / d1, "{:.2f} (eq. 5)"), "frequency", "{:.2f}"),
        row("Strouhal number f d1/v1", f"{frequency * d1 / 1.5:.4f} (of that)", number(first["strouhal_reference"], "{:.4f} (eq. 5)"), "strouhal", "{:.4f}"),
    ]
    head = ["", "paper", "reference"] + [f"{run.case}, {run.setting}" for run, _ in runs]
    span = "{:g}-{:g} s".format(*runs[0][1]["run"]["settled"])
    return f"## The settled state, {span}\n\n" + table(head, rows) + "\n\nRecipe `keyword_decks/hydraulic_jump/paper_figures.yaml`; distances are from the gate, x1 = 0 as in the paper, wherever the mean toe (first row) is; in *better*, whose toe does not reach the gate, from the mean toe.\n"


def drift(found):
    volume = found.get("volume")
    return "-" if volume is None else number(100 * (volume["late"] - volume["early"]), "{:+.1f} %")


def checks(shown):
    rows = []
    for run, found in shown:
        bed, one = found["bed"], found["run"]
        dx = 0.02 / run.parameters["resolution"]
        rows.append(label(run) + ["{:g}-{:g}".format(*one["settled"]), number(1000 * bed["depth"], "{:.1f}"), number(1000 * bed["filled"], "{:.1f}"), percent(bed["filled_ratio_mean"]), drift(found),
                                  number(bed["row1"], "{:.2f}"), number(bed["row2"], "{:.2f}"), percent(bed["row_ratio"], 0),
                                  one["leaked_particles"], percent(float(one["max_penetration"]) / dx), percent(one["residual"], 2)])
    head = ["case", "setting", "window [s]", "depth at 1 m [mm]", "filled [mm]", "filled/depth, x = 0.1-1 m", "its drift", "v, row at the bed, x = 0.1 m [m/s]", "next row", "ratio, x = 0.1-1 m",
            "leaked", "largest penetration / dx", "energy residual"]
    return ("## What walls and sums do to the water\n\n" + table(head, rows) + "\n\n*Filled*: the depth that the particles' own volume m/ρ would have. *Its drift*: from 15-20 s to 25-30 s. *Ratio*: mean velocity, over x = 0.1 to 1 m, of the row of "
            "particles nearest to the bed over that of the next row. Residual of the energy ledger over the energy that passed through. Recipe "
            "`keyword_decks/hydraulic_jump/bed_and_volume.yaml`; leaks, penetration and energy from `summary.yaml`.\n")


def standing(shown):
    place, ratios = [], []
    for run, found in sorted(shown, key=lambda one: one[1]["values"]["froude"]):
        v, here, roller, toe = found["values"], found["local"], found["analyses"]["roller"], found["analyses"]["toe"]
        place.append([f"{v['froude']:g}", run.case, f"{v['reynolds']:g}", f"{v['cmu']:g}" if v["mixing"] > 0 else "-", "{:g}-{:g}".format(*found["run"]["settled"]), f"{v['ratio']:g}", f"{toe['toe_mean']:.3f} ± {toe['toe_deviation']:.3f}" + (" (gate)" if here["at_gate"] else ""),
                      number(1000 * toe["toe_speed"], "{:+.1f}"), number(1000 * here["d1"], "{:.1f}"), number(here["v1"], "{:.3f}"), number(here["froude"], "{:.2f}"),
                      number(1000 * here["d2"], "{:.1f}"), number(1000 * here["d2_filled"], "{:.1f}"), number(1000 * here["d2_theory"], "{:.1f}"),
                      number(here["d2"] / here["d2_theory"], "{:.3f}"), number(here["d2_filled"] / here["d2_theory"], "{:.3f}"), found["run"]["leaked_particles"],
                      percent(found["run"]["residual"], 2)])
        ratios.append([number(here["froude"], "{:.2f}"), number(roller["roller_length"], "{:.1f}"), number(roller["roller_length_surface"], "{:.1f}"),
                       number(roller["roller_length_reference"], "{:.1f}"), percent(roller["decay_rms"]), percent(here["decay_least"]),
                       number(roller["deviation_largest"], "{:.3f}"), number(roller["deviation_largest_reference"], "{:.3f}"), number(roller["deviation_largest_at"], "{:.1f}"),
                       number(roller["frequency"], "{:.2f}"), number(roller["strouhal"], "{:.4f}"), number(roller["strouhal_median"], "{:.4f}"), number(roller["strouhal_reference"], "{:.4f}")])
    head = ["Fr1 of the inflow", "case", "Re", "c_μ", "means over [s]", "level over Bélanger's", "toe [m]", "drift [mm/s]", "d1 before the toe [mm]", "v1 there [m/s]", "Fr1 there", "d2 [mm]", "filled [mm]",
            "Bélanger [mm]", "d2/Bélanger", "filled/Bélanger", "leaked", "energy residual"]
    against = ["Fr1 before the toe", "Lr/d1: mean velocity nowhere negative", "stagnation point", "eq. 2", "V_max, rms to eq. 3", "at least, by energy", "(η'/d1)max", "eq. 4", "at (x - x1)/d1", "f [Hz]", "St", "St, median over the roller", "eq. 5"]
    return (table(head, place) + "\n\n" + table(against, ratios) +
            "\n\n`keyword_decks/hydraulic_jump/standing_level.yaml`, recipe `keyword_decks/hydraulic_jump/standing_figures.yaml`. Re = v1 d1/ν: the artificial viscosity as an eddy viscosity; "
            "where a c_μ is given, that is a mixing length (`*COURANT_EDDY_VISCOSITY`, LMAX half of d2) and Re tells of the artificial viscosity beside it. Both are chosen for each Froude number. *Level*: that the outlet (`*COURANT_LEVEL_OUTLET`) keeps, over Bélanger's depth of the nominal jet, chosen so that the toe stands still; half a percent more sends it upstream with some 7 mm/s. Depth and velocity of the jet are taken three depths "
            "(or three deviations of the toe) upstream of the toe, d2 one to two d2 before the band of the outlet; d1 and v1 in all ratios are these. *At least*: as far from eq. 3 V_max would be without any loss, V² = v1² - 2 g (η - d1) along the bed under the hydrostatic pressure of the mean surface η. "
            "The paper names no range of Fr1 for eq. 3.\n")


def failure(run):
    """Why a run stopped in error, as its summary has it; empty where it did not."""
    summary = run.summary()
    return str(summary.get("reason", "")) if summary.get("termination") == "error" else ""


def beside(page, ending):
    """The page of standing jumps or of the study, beside that of the paper's cases."""
    return page.with_name(page.stem.removesuffix("_paper") + ending + page.suffix)


def write(options, runs, chosen, paper, program, project):
    """The pages of all runs that are complete and evaluated, but for pages of which no run was chosen; those that were written."""
    folder = options.page.parent

    def cases(shown):
        return [table1(shown, paper), table2(shown), course(shown, paper), settled(shown, paper), checks(shown), paper_figures.of_cases(shown, folder, project)]

    def still(shown):
        return [standing(shown), paper_figures.of_standing(shown, folder, project)]

    def study(shown):
        return paper_study.sections(shown, folder, project)

    written = []
    for page, title, sections, groups in ((options.page, "The numbers and figures of Jonsson et al. (2016)", cases, ("paper", "supported", "better", "paper_setting")),
                                          (beside(options.page, "_standing"), "Jumps that stand still", still, ("standing",)),
                                          (beside(options.page, "_study"), "What the numerics do to the paper's jump", study, ("study",))):
        own = [run for run in runs if run.group in groups]
        shown = [(run, found) for run in own if (found := evaluated(run)) and found.get("asked") == asked(run)]  # else of an older scene
        if not shown or not set(own) & set(chosen):
            continue
        there = {run.name for run, _ in shown}
        failed = {run: reason for run in own if run.name not in there and (reason := failure(run))}
        missing = dict.fromkeys(run.variant for run in own if run.name not in there and run not in failed)
        parts = [top(title, options, program, project, shown), *sections(shown)]
        if failed:
            parts.insert(-1, "Stopped in error:\n\n" + "\n".join(f"- {run.name.removeprefix('study/')} ({run.setting}): {reason}" for run, reason in failed.items()) + "\n")
        if missing:
            parts.insert(-1, f"Not run: {', '.join(missing)}." + (" The literal setting is discussed, with numbers of an earlier build, in [hydraulic_jump.md](hydraulic_jump.md#the-papers-numbers-taken-literally-c0--1484-ms-q1--01-q2--0)."
                                                                if any(run.group == "paper_setting" for run in own if run.variant in missing) else "") + "\n")
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text("\n".join(part for part in parts if part))
        written.append(page)
    return written
