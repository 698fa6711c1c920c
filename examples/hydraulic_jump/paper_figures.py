"""Figures of the page: those that `courant post` drew of a run, and those over several runs, drawn by the same script."""
import json
import math
import shutil
import subprocess
import sys

from paper_evaluate import read_table

FOLDER = "figures/hydraulic_jump"
PROGRAM = "src/post/plot_figures.py"
# what `courant post` drew of the run with figures; fields as pixels, which are smaller
OF_A_RUN = [
    ("fig05_depth.svg", "Depth at x = 1 m over 30 s (Figure 5 b)"),
    ("fig06_profiles.svg", "Mean velocity every 0.025 m (Figure 6)"),
    ("fig07_decay.svg", "Largest mean velocity (Figure 7)"),
    ("fig08_streamlines.png", "Streamlines of the mean flow (Figure 8 shows one moment)"),
    ("fig09_surface.svg", "Mean surface (Figure 9)"),
    ("fig10_deviation.svg", "Standard deviation of the surface (Figure 10)"),
    ("fig12_spectra.svg", "Spectrum of the depth (Figure 12)"),
    ("fig13_frequency.svg", "Dominant frequency of the depth (Figure 13)"),
    ("fig06_roller.svg", "Length of the roller (section 3)"),
    ("fig11_largest_deviation.svg", "Largest deviation of the surface (Figure 11)"),
    ("fig14_strouhal.svg", "Strouhal number of the surface (Figure 14)"),
    ("balance.svg", "Momentum and energy through vertical planes"),
]
OF_THE_SETTING = ("fig05", "fig06_profiles", "fig07", "fig09")  # enough of the paper's speed of sound


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


def over_cases(main):
    """Figure 5 a: the depth of all cases of the recommended setting in one picture."""
    curves = []
    for run, _ in main:
        table = read_table(run.folder / "depth.csv")
        rows = [k for k, t in enumerate(table["t"]) if t <= 5.005]
        if run.group == "better":
            curves.append(curve([table["t"][k] for k in rows], [table["depth_over_theory"][k] for k in rows], f"${run.case.replace('d1', 'd_1')}$"))
    if not curves:
        return []
    return [figure("fig05a_depth", "Depth at x = 1 m, all cases (Figure 5 a)", "time $t$ [s]", "$d_{2,SPH} / d_{2,THEORY}$ [-]", curves,
                   [line("Bélanger, eq. 1", y=[1], across="y")], y_range=[0, 1.4])]


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
        done = subprocess.run([sys.executable, project / PROGRAM, folder], capture_output=True, text=True)
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
        ends = {"paper": "", "supported": "_supported", "better": "_better", "paper_setting": "_c1484"}[run.group]
        setting = f", {run.setting}"
        if run.case in ("d1/4", "d1/10"):
            number = 3 if run.case == "d1/4" else 4
            shown += copied(run, [("velocity.png", f"fig0{number}_speed{ends}.png", f"Speed of the water, {run.case}{setting} (Figure {number})")], folder)
        if run.figures:
            wanted = [one for one in OF_A_RUN if run.group == "better" or one[0].startswith(OF_THE_SETTING)]
            shown += copied(run, [("paper/" + name, name.replace(".", ends + "."), caption + setting) for name, caption in wanted], folder)
    return section(shown + draw(over_cases(runs), folder, project), page_folder)


def of_standing(runs, page_folder, project):
    """The same of jumps that stand still."""
    folder = figure_folder(page_folder)
    shown = []
    for run, found in runs:
        shown += copied(run, [("standing/streamlines.png", f"standing_{run.name}.png", f"Mean flow, Fr1 = {found['values']['froude']:g}")], folder)
    return section(shown + draw(over_froude(runs) + along_jump(runs), folder, project), page_folder)
