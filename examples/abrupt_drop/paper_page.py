"""Writes the page of the tests at an abrupt drop: tables from what was evaluated, figures from what `courant post` drew."""
import shutil

from case_post import evaluated
from case_runs import EVALUATED, age
from page_text import heading, hours, number, percent, table

FIGURES = (("types", "J and the toe over time, before the colours of the types"), ("vorticity", "Vorticity in 1/s, the paper's Figures 7 to 12"),
           ("level", "Surface at distances from the mean toe"), ("spectra_level", "Spectrum of the surface, the paper's Figures 13 and 14"),
           ("spectra_pressure", "Spectrum of the pressure at the bed, the paper's Figures 16 to 19"), ("correlations", "Correlations, the paper's Figures 24 and 25"),
           ("regime", "F1 against y_t/y1 between the bounds of momentum, the paper's Figure 15"))
SETTING = """The one setting of the tests, fixed before they ran: `keyword_decks/abrupt_drop/abrupt_drop.yaml`, standard k-epsilon with the constants of books, smooth beds that rub by the logarithmic law, nothing fitted; y1, v1
and y_t as printed (T3: 18.18 cm for "1818"); a bed of 0.5 m before the step; the inflow uniform, under its hydrostatic pressure, k from 10 % of v1 and eddies of half the depth; at the end a level outlet at y_t; start with the toe at
the step. The rule of the types stands in [post.md](post.md#a-jump-at-an-abrupt-drop)."""


def share(found, *names):
    return sum(found["types"].get(f"share_{name}", 0) for name in names)


def row(run, found):
    types, regime, mass, sound = (found[key] for key in ("types", "regime", "mass", "soundness"))
    waves = share(found, "A_wave", "B_wave")
    return [run.name, run.experiment, f"**{found['regime_word'] or '-'}**", percent(share(found, "A"), 0), percent(share(found, "B"), 0), percent(waves, 0),
            number(types.get("J_mean"), "{:.2f}"), number(100 * types["toe_mean"] if "toe_mean" in types else None, "{:.1f}"),
            number(types.get("cycles"), "{:.0f}"), number(types.get("period_mean"), "{:.1f}"), number(regime.get("place"), "{:.2f}"),
            number(mass.get("out_over_in"), "{:.3f}"), number(sound.get("mach_most"), "{:.3f}"), found["run"]["leaked_particles"], hours(found["run"]["cpu_seconds"])]


HEAD = ["run", "experiment", "here", "A", "B", "waves", "J", "mean toe [cm]", "cycles", "period [s]", "(Y - Y_B)/(Y_A - Y_B)", "out/in", "Mach", "leaked", "processor time"]


def figures(run, page):
    """Figures of a run beside the page; their Markdown."""
    folder = page.parent / "figures" / "abrupt_drop"
    lines = []
    for name, caption in FIGURES:
        source = run.folder / "abrupt_drop" / f"{name}.png"
        if not source.is_file():
            continue
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, folder / f"{run.name}_{name}.png")
        lines.append(f"![{run.name}: {caption}](figures/abrupt_drop/{run.name}_{name}.png)\n\n{run.name}: {caption}.\n")
    return "\n".join(lines)


def write(options, runs, program, project):
    shown = [(run, found) for run in runs if (found := evaluated(run))]
    words = " ".join(["bash examples/abrupt_drop/paper.sh"] + ["--study"] * options.study + ["--quick"] * options.quick + ([f"--only {options.only}"] if options.only else []))
    old = [run.name for run, _ in shown if age(run.folder / EVALUATED) < program.age]
    text = [heading("Jumps at an abrupt drop: the tests of De Padova et al. (2017)", words, "What it means is discussed in [abrupt_drop.md](abrupt_drop.md).",
                    0.5 if options.quick else None, program, project, old)]
    tests = [(run, found) for run, found in shown if run.group == "tests"]
    if tests:
        right = [run.name for run, found in tests if found["regime_word"] == run.experiment]
        text.append(f"## The seven tests by one setting\n\n{SETTING}\n\n{table(HEAD, [row(*one) for one in tests])}\n\n"
                    f"Types as in the experiment: {len(right)} of {len(tests)}{' (' + ', '.join(right) + ')' if right else ''}. A, B, waves: shares of the time from {tests[0][0].settled[0]} s on.\n")
    others = [(run, found) for run, found in shown if run.group != "tests"]
    if others:
        rows = [row(*one) + [one[0].notes] for one in others]
        text.append(f"## Test T1 by other settings\n\n{table(HEAD + ['what differs'], rows)}\n")
    for run, _ in shown:
        if run.name in ("T1", "T1_mixing", "T1_printed"):
            drawn = figures(run, options.page)
            if drawn:
                text.append(f"## Figures of {run.name}\n\n{drawn}")
    options.page.parent.mkdir(parents=True, exist_ok=True)
    options.page.write_text("\n".join(text))
    return options.page
