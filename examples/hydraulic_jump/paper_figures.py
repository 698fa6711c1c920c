"""Figures of the page: those that `courant post` drew of a run, and those over several runs, drawn by the same script."""
import json
import math
import os
import shutil
import subprocess
import sys

from case_post import read_table

FOLDER = "figures/hydraulic_jump"
# Of file names, by group. *Supported*, between *plates* and *better*, has no pictures of its own: its curves are in those over settings.
ENDS = {"paper": "", "better": "_better", "paper_setting": "_c1484"}
# of the paper's case [m, m/s]: its jet, conjugate depth by eq. 1, and the depth that critical flow over the weir allows (theory.md)
D1, V1, BELANGER, WEIR_DEPTH = 0.02, 1.5, 0.0863, 0.0817
PAPER_ROLLER = 0.2235 / D1  # section 3
PACKAGE = "src/python"  # whose `courant.post.draw` draws
# what `courant post` drew of a run alone; fields as pixels, which are smaller
OF_A_RUN = [
    ("fig06_profiles.svg", "Mean velocity every 0.025 m (Figure 6)"),
    ("fig08_streamlines.png", "Streamlines of the mean flow"),
    ("fig08_moment.png", "Streamlines at one moment, the end of the window (Figure 8)"),
    ("balance.svg", "Momentum and energy through vertical planes"),
]
OF_THE_BEST = ("balance",)  # enough of one setting


def plain(values):
    return [None if v is None or math.isnan(v) else v for v in values]


def curve(x, y, label, style="line"):
    return {"x": plain(x), "y": plain(y), "label": label, "style": style}


def line(label, x=(), y=(), across=" ", style="dashed"):
    return {"label": label, "style": style, "across": across, "x": list(x), "y": list(y)}


def equation(of, label, low, high):
    xs = [low + (high - low) * k / 80 for k in range(81)]
    return line(label, xs, [of(x) for x in xs])


def figure(name, title, x_label, y_label, curves, references=(), x_range=None, y_range=None):
    return {"name": name, "title": title, "x_label": x_label, "y_label": y_label, "scale": "linear", "x_range": x_range, "y_range": y_range,
            "walls": False, "equal": False, "curves": curves, "references": list(references), "map": None}


def bounded(table, x, y, low, high):
    """Two columns where the first is within bounds."""
    rows = [k for k, value in enumerate(table[x]) if low <= value <= high]
    return [table[x][k] for k in rows], [table[y][k] for k in rows]


def thinned(x, y, most=700):
    """Every n-th point, so that a picture of a long series stays small."""
    step = max(1, -(-len(x) // most))
    return x[::step], y[::step]


def over_cases(main):
    """Figure 5 a: the depth of all cases, a picture for each setting."""
    out = []
    for group, ends in ENDS.items():
        runs = [(run, found) for run, found in main if run.group == group]
        curves = [curve(*bounded(read_table(run.folder / "depth.csv"), "t", "depth_over_theory", 0, 5.005), f"${run.case.replace('d1', 'd_1')}$") for run, _ in runs]
        if curves:
            out.append(figure(f"fig05a_depth{ends}", f"Depth at x = 1 m, {runs[0][0].setting} (Figure 5 a)", "time $t$ [s]", "$d_{2,SPH} / d_{2,THEORY}$ [-]", curves,
                              [line("Bélanger, eq. 1", y=[1], across="y"), line("weir, critical flow", y=[WEIR_DEPTH / BELANGER], across="y"),
                               line("paper: depth rises", x=[0.8], across="x"), line("paper: jump turns", x=[2], across="x")], y_range=[0, 1.4]))
    return out


def over_settings(main):
    """Figures 5 b, 7 and 9 to 14: the settings of the long run in one picture, beside what the paper and its equations say."""
    runs = [(run, found["analyses"]["roller"]) for run, found in main if "analyses" in found]
    if not runs:
        return []

    def curves(table, x, y, style="line", low=-math.inf, high=math.inf):
        return [curve(*bounded(read_table(run.folder / "paper" / f"{table}.csv"), x, y, low, high), run.setting, style) for run, _ in runs]

    def numbers(key):
        return [curve([roller["Fr1"]], [roller[key]], run.setting, "points") for run, roller in runs]

    def spectrum(run, roller):
        """Of the gauge that is nearest to the paper's 8.75 d1 behind the toe."""
        table = read_table(run.folder / "paper" / "spectra.csv")
        places = {float(name.split("@")[1]): name for name in table if "@" in name}
        place = min(places, key=lambda x: abs(x - roller["toe"] - 8.75 * D1))
        return curve(*bounded(table, "f", places[place], 0, 8), f"{run.setting}, {(place - roller['toe']) / D1:.1f} $d_1$")
    x, fr = "$(x - x_1) / d_1$ [-]", "$Fr_1$ [-]"
    top, reference = runs[0][1]["deviation_largest_reference"], runs[0][1]["roller_length_reference"]
    frequency = runs[0][1]["strouhal_reference"] * V1 / D1
    depth = [curve(*thinned(*bounded(read_table(run.folder / "depth.csv"), "t", "depth_over_theory", 0, math.inf)), run.setting) for run, _ in runs]
    return [
        figure("fig05b_depth", "Depth at x = 1 m over 30 s (Figure 5 b)", "time $t$ [s]", "$d_{2,SPH} / d_{2,THEORY}$ [-]", depth,
               [line("Bélanger, eq. 1", y=[1], across="y"), line("paper, A over 15-30 s", [22.5], [1.041], style="points"), line("paper: toe at the gate", x=[11], across="x")], y_range=[0, 1.8]),
        figure("fig07_decay", "Largest mean velocity (Figure 7)", x, "$V_{max} / v_1$ [-]", curves("roller", "distance", "largest", low=0),
               [equation(lambda d: math.exp(-0.028 * d), "Chanson, eq. 3", 0, 50)], y_range=[0, 1.2]),
        figure("fig09_surface", "Mean surface (Figure 9)", x, "$\\eta / d_1$ [-]", curves("roller_surface", "distance", "mean", low=-5),
               [line("Bélanger, eq. 1", y=[BELANGER / D1], across="y"), line("end of the roller, eq. 2", x=[reference], across="x"), line("end of the paper's roller", x=[PAPER_ROLLER], across="x")], y_range=[0, 8]),
        figure("fig10_deviation", "Standard deviation of the surface (Figure 10)", x, "$\\eta' / d_1$ [-]", curves("roller_surface", "distance", "deviation", low=-5),
               [line("largest one by eq. 4", y=[top], across="y"), line("where experiments have it (Kucukali & Chanson)", [10, 15], [top, top], style="line+points")]),
        figure("fig11_largest_deviation", "Largest standard deviation of the surface (Figure 11)", fr, "$(\\eta' / d_1)_{max}$ [-]", numbers("deviation_largest"),
               [equation(lambda f: 0.116 * (f - 1) ** 1.235, "Murzyn & Chanson, eq. 4", 2, 6.5)]),
        figure("fig12_spectra", "Spectrum of the depth, in the paper at 8.75 $d_1$ behind the toe (Figure 12)", "frequency $f$ [Hz]", "spectral density [m$^2$ s]",
               [spectrum(run, roller) for run, roller in runs],
               [line("paper, 3.5 Hz", x=[3.5], across="x"), line("paper, band", x=[2], across="x"), line("", x=[5], across="x"), line("eq. 5", x=[frequency], across="x")]),
        figure("fig13_frequency", "Dominant frequency of the depth (Figure 13)", x, "$F_{fs}$ [Hz]", curves("roller_frequency", "distance", "f", "points", 0),
               [line("paper, 3.5 Hz", y=[3.5], across="y"), line("eq. 5", y=[frequency], across="y")], y_range=[0, 10]),
        figure("fig14_strouhal", "Strouhal number of the surface (Figure 14)", fr, "$St = f d_1 / v_1$ [-]", numbers("strouhal"),
               [equation(lambda f: 0.143 * math.exp(-0.27 * f), "Chachereau & Chanson, eq. 5", 2.4, 6.5), line("paper, 3.5 Hz", [3.4], [0.0467], style="points")], y_range=[0, 0.1]),
        figure("roller_length", "Length of the roller (section 3)", fr, "$L_r / d_1$ [-]", numbers("roller_length"),
               [equation(lambda f: 160 * math.tanh(f / 20) - 12, "Hager et al., eq. 2", 2, 6.5), line("paper", [3.4], [PAPER_ROLLER], style="points")]),
    ]


def over_froude(still):
    """Length, deviation, Strouhal number and depth of standing jumps over the Froude number that meets the toe."""
    if not still:
        return []
    here = [found["local"] for _, found in still]
    rollers = [found["analyses"]["roller"] for _, found in still]
    fr, x = [one["froude"] for one in here], "Froude number before the toe [-]"

    def of(key):
        return [roller[key] for roller in rollers]
    return [
        figure("standing_depth", "Depth behind standing jumps", x, "$d_2 / d_1$ [-]",
               [curve(fr, [one["d2"] / one["d1"] for one in here], "SPH, surface", "points"), curve(fr, [one["d2_filled"] / one["d1"] for one in here], "SPH, volume m/ρ", "points")],
               [equation(lambda f: 0.5 * (math.sqrt(1 + 8 * f * f) - 1), "Bélanger, eq. 1", 1.5, 6.6)]),
        figure("standing_roller", "Length of the roller", x, "$L_r / d_1$ [-]",
               [curve(fr, of("roller_length"), "SPH: mean velocity nowhere negative", "points"), curve(fr, of("roller_length_surface"), "SPH: stagnation point at the surface", "points")],
               [equation(lambda f: 160 * math.tanh(f / 20) - 12, "Hager et al., eq. 2", 2, 6.6)]),
        figure("standing_deviation", "Largest standard deviation of the surface (as Figure 11)", x, "$(\\eta' / d_1)_{max}$ [-]", [curve(fr, of("deviation_largest"), "SPH", "points")],
               [equation(lambda f: 0.116 * (f - 1) ** 1.235, "Murzyn & Chanson, eq. 4", 1.5, 6.6)]),
        figure("standing_strouhal", "Strouhal number of the surface (as Figure 14)", x, "$St = f d_1 / v_1$ [-]", [curve(fr, of("strouhal"), "SPH, mean spectrum", "points"), curve(fr, of("strouhal_median"), "SPH, median over the roller", "points")],
               [equation(lambda f: 0.143 * math.exp(-0.27 * f), "Chachereau & Chanson, eq. 5", 2.4, 6.5)], y_range=[0, 0.1]),
    ]


def along_jump(still):
    """Curves along the distance from the toe, one for each Froude number."""
    if not still:
        return []

    def curves(table, y, style="line"):
        out = []
        for run, found in still:
            columns = read_table(run.folder / "standing" / f"{table}.csv")
            out.append(curve(columns["distance"], columns[y], f"$Fr_1$ = {found['values']['froude']:g}", style))
        return out
    x = "$(x - x_1) / d_1$ [-]"
    return [
        figure("standing_surface", "Mean surface", x, "$\\eta / d_1$ [-]", curves("roller_surface", "mean")),
        figure("standing_decay", "Largest mean velocity (as Figure 7)", x, "$V_{max} / v_1$ [-]", curves("roller", "largest"),
               [equation(lambda d: math.exp(-0.028 * d), "Chanson, eq. 3", 0, 50)], y_range=[0, 1.2]),
        figure("standing_frequency", "Dominant frequency (as Figure 13)", x, "$F_{fs}$ [Hz]", curves("roller_frequency", "f", "points"), y_range=[0, 10]),
    ]


def draw(figures, folder, project):
    """The figures as SVG in the folder; their names. Without matplotlib none."""
    (folder / "figures.json").write_text(json.dumps({"title": "", "formats": ["svg"], "walls": [], "figures": figures}))
    try:
        done = subprocess.run([sys.executable, "-m", "courant.post.draw", folder], capture_output=True, text=True,
                              env=os.environ | {"PYTHONPATH": str(project / PACKAGE)})
        if done.returncode != 0:
            print("warning: figures over several runs were not drawn: " + done.stderr[-500:])
            return []
    finally:
        (folder / "figures.json").unlink()
    return [(one["name"] + ".svg", one["title"]) for one in figures]


def copy_picture(source, target):
    """Pixels in 256 colours and at most 1100 wide: a fifth of the bytes."""
    try:
        from PIL import Image  # comes with matplotlib
    except ImportError:
        Image = None
    if source.suffix != ".png" or Image is None:
        shutil.copy(source, target)
        return
    with Image.open(source) as picture:
        small = picture.convert("RGB")
        if small.width > 1100:
            small = small.resize((1100, round(small.height * 1100 / small.width)), Image.LANCZOS)
        small.quantize(256, method=Image.FASTOCTREE).save(target, optimize=True)


def copied(run, names, folder):
    """Copies what post drew of a run; names and captions of what was there."""
    out = []
    for source, name, caption in names:
        if (run.folder / source).is_file():
            copy_picture(run.folder / source, folder / name)
            out.append((name, caption))
    return out


def order(one):
    """The paper's figures first, by number."""
    return (not one[0].startswith("fig"), one[0].startswith("standing"), one[0])


def figure_folder(page_folder):
    """Beside the page, made if it is not there."""
    folder = page_folder / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def section(shown, page_folder):
    """The page's section that shows these figures."""
    size = sum(path.stat().st_size for path in (page_folder / FOLDER).iterdir()) / 1e6
    if size > 2:
        print(f"warning: the figures take {size:.1f} MB, more than the 2 MB meant for them")
    return "## Figures\n\n" + "\n\n".join(f"*{caption}*\n\n![{caption}]({FOLDER}/{name})" for name, caption in sorted(shown, key=order)) + "\n" if shown else ""


def of_cases(runs, page_folder, project):
    """Draws and copies figures of the paper's cases beside the page; its section."""
    folder = figure_folder(page_folder)
    shown = []
    for run, _ in runs:
        if run.group not in ENDS:
            continue
        ends, setting = ENDS[run.group], f", {run.setting}"
        if run.case in ("d1/4", "d1/10"):
            number = 3 if run.case == "d1/4" else 4
            shown += copied(run, [("velocity.png", f"fig0{number}_speed{ends}.png", f"Speed of the water, {run.case}{setting} (Figure {number})")], folder)
        if run.figures:
            wanted = [one for one in OF_A_RUN if run.group == "better" or not one[0].startswith(OF_THE_BEST)]
            shown += copied(run, [("paper/" + name, name.replace(".", ends + "."), caption + setting) for name, caption in wanted], folder)
    return section(shown + draw(over_cases(runs) + over_settings(runs), folder, project), page_folder)


def of_standing(runs, page_folder, project):
    """The same of standing jumps."""
    folder = figure_folder(page_folder)
    shown = []
    for run, found in runs:
        shown += copied(run, [("standing/streamlines.png", f"standing_{run.name}.png", f"Mean flow, Fr1 = {found['values']['froude']:g}")], folder)
    return section(shown + draw(over_froude(runs) + along_jump(runs), folder, project), page_folder)
