#!/usr/bin/env python3
"""Times materials beside *MAT_024 with linear hardening: processor time of an element and step, in pairs of runs at the same time.

usage: materials.py COURANT [--edge 16] [--steps 300] [--rounds 5] [--kinds KIND ...]

Meshes of EDGE^3 shells of five points or hexahedra of one that a velocity field stretches and shears beyond yield (beside_lulesh's decks). What
takes time besides the steps is taken out by runs of STEPS and of twice as many. Prints the median of the ratios, and the least and largest.
"""
import argparse
import concurrent.futures
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "peers"))
import elements_beside_lulesh as beside  # noqa: E402

FIRST = "1,1000.,1.E7,0.3"
CURVES = ["*DEFINE_CURVE", "7", "0.0,1.E4", "1.0,2.E5", "*DEFINE_CURVE", "8", "0.0,0.8E4", "1.0,1.5E5"]
PLAIN = ["*MAT_024", f"{FIRST},1.E4,1.E5", "", "", ""]
SHELLS = {
    "036 M 8": ["*MAT_036", f"{FIRST},1,1.E5,1.E4", "8,1.8,1.4,2.2", "0", "", ""],
    "036 M 6": ["*MAT_036", f"{FIRST},1,1.E5,1.E4", "6,1.8,1.4,2.2", "0", "", ""],
    "036 M 7.3": ["*MAT_036", f"{FIRST},1,1.E5,1.E4", "7.3,1.8,1.4,2.2", "0", "", ""],
    "036 M 8, curve": ["*MAT_036", f"{FIRST},3", "8,1.8,1.4,2.2,7", "0", "", "", *CURVES],
    "133": ["*MAT_133", f"{FIRST},0,0,0,1", "1.1E5,1.E-4,0.2,0,0,1,8", ".4865,1.378,.7536,1.025,1.036,.9036,1.232,1.486", "0", "", ""],
    "122": ["*MAT_122", f"{FIRST},1,1.E5,1.E4", "1.8,1.4,2.2", "0", "", ""],
}
BOTH = {
    "123": ["*MAT_123", f"{FIRST},1.E4,1.E5", ",,,,,5.,5.,2", "", ""],
    "081": ["*MAT_081", f"{FIRST},1.E4,1.E5,1.E-4", ",,,,5.0", "", ""],
    "105": ["*MAT_105", f"{FIRST},1.E4,1.E5", "", "1.E-4,1.E4,1.0", "", ""],
    "107": ["*MAT_107", FIRST, "1.0", "1.E4,1.E5,0.5", "", "1.0,0.0,5.0", ""],
    "120": ["*MAT_120", f"{FIRST},1.E4,8.,1.5,1.", ".5,.001,,,,,1,0.9", "", ""],
    "224": ["*MAT_224", FIRST, "7,0,9", "", *CURVES, "*DEFINE_CURVE", "9", "-1.,5.", "1.,9."],
    "024, GISSMO": [*PLAIN, "*MAT_ADD_DAMAGE_GISSMO", "1,,1", "9,,1.0,0.5,2.0", "", "*DEFINE_CURVE", "9", "-1.,5.", "1.,9."],
    "024 LOG": ["*MAT_024_LOG_INTERPOLATION", FIRST, ",,9", "", "", *CURVES, "*DEFINE_TABLE_2D", "9", "1.E-3,8", "1.E6,7"],
    "124": ["*MAT_124", FIRST, "7,8", "0.,0.", "0.", *CURVES],
    "061": ["*MAT_061", "1,1000.,1.E7,4.E6,1.E6,1.E3"],
    "076": ["*MAT_076", "1,1000.,1.E7", "", "1.E6", "2.E6,1.E3", "1.E6,1.E4"],
    "187": ["*MAT_187", "1,1000.,,,1.E7,0.3", "8,7,0,0,0.4", "", *CURVES],
}
SOLIDS = {
    "031": ["*MAT_031", "1,1000.,0.45,2.E6,1.E5", "", ""],
    "063": ["*MAT_063", "1,1000.,1.E7,0.0,7,1.E4", *CURVES],
    "163": ["*MAT_163", "1,1000.,1.E7,0.0,7,1.E4", "", *CURVES],
    "154": ["*MAT_154", f"{FIRST},2.,1.E4", "5.,1.E4,2.,1.E4"],
    "110": ["*MAT_110", "1,1000.,4.E6,0.93,0.31,0.0,0.6,0.6", "0.0,2.E3,0.0,2.8E4,1.5E4,1.0", "5.E-3,1.0,8.E6,0.0,0.0,0"],
    "159": ["*MAT_159", "1,1000.", "0.", "4.E6,8.E6,9.E3,0.3,6.E3,2.E-5", ".7474,0,.17,7.E-5,.66,0,.16,7.E-5", "5.,9.E4,.05,2.E-7,3.E-13",
            "100.,1.E9,.1,1.E9,1.E9,5.,1.", ""],
    "072R3": ["*MAT_072R3", "1,1000.,0.3", "0.,-3.E4", "0,0,0,39.37,0.145", "", "", "", ""],
    "075": ["*MAT_075", "1,1000.,1.E7,7,8", "1.E4,,,0.3", *CURVES],
    "084": ["*MAT_084", "1,1000.,1.E7,0.3,3.E4,3.E3,0.1,0.01", ",,,,1.0,1.,1.,1.", "", ""],
    "005": ["*MAT_005", "1,1000.,4.E6,8.E6,1.E8,1.E4,0.1,-1.E3", "", "0.,0.1", "", "0.,8.E5", ""],
    "002": ["*MAT_002", "1,1000.,1.E7,5.E6,2.E6,0.1,0.1,0.1", "2.E6,2.E6,2.E6,2.", ",,,1.,0.,0.", ",,,0.,1.,0."],
    "111": ["*MAT_111", "1,1000.,4.E6,0.79,1.6,0.0,0.61,1.E4", "1.E3,1.0,0.01,7.0,4.E3,0.001,2.E5,0.1", "0.04,1.0,2.E7,0.0,0.0,0"],
}
KINDS = {f"{name}, {element}": (element, material, 5 if element == "shell" else 0)
         for element, materials in (("shell", {**SHELLS, **BOTH}), ("solid", {**BOTH, **SOLIDS})) for name, material in materials.items()}
OF_024 = {element: f"024, {element}" for element in ("shell", "solid")}


def processor_seconds(command, cwd):
    """Of a command alone, whatever else runs."""
    process = subprocess.Popen(command, cwd=cwd, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "OMP_NUM_THREADS": "1"})
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 3):  # 3: a doubtful verdict
        sys.exit(f"{' '.join(map(str, command))} ended with {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("courant", type=pathlib.Path)
    for name, value in (("edge", 16), ("steps", 300), ("rounds", 5)):
        options.add_argument(f"--{name}", type=int, default=value)
    options.add_argument("--kinds", nargs="+", choices=list(KINDS), default=list(KINDS))
    a = options.parse_args()
    courant = a.courant.resolve()
    beside.KINDS = {**KINDS, **{name: (element, PLAIN, 5 if element == "shell" else 0) for element, name in OF_024.items()}}
    with tempfile.TemporaryDirectory() as folder:
        names = {kind: f"k{number}" for number, kind in enumerate(beside.KINDS)}

        def seconds(kind, steps):
            deck = f"{names[kind]}_{steps}"
            (pathlib.Path(folder) / f"{deck}.k").write_text(beside.deck(kind, a.edge, steps))
            return processor_seconds([courant, "run", f"{deck}.k", "-o", f"out_{deck}", "--quiet", "--no-final-dump", "--threads", "1"], folder)

        def per_step(kind):
            return seconds(kind, 2 * a.steps) - seconds(kind, a.steps)

        for kind in a.kinds:
            ratios = []
            for _ in range(a.rounds):
                with concurrent.futures.ThreadPoolExecutor(2) as pool:  # both suffer alike from other work
                    ours, plain = pool.map(per_step, (kind, OF_024[KINDS[kind][0]]))
                ratios.append(ours / plain)
            print(f"{kind}: {statistics.median(ratios):.2f} times 024 ({min(ratios):.2f} to {max(ratios):.2f})", flush=True)


if __name__ == "__main__":
    main()
