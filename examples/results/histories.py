#!/usr/bin/env python3
"""Reads and draws histories of a run, from the text files and from history.h5, by the Python package of Courant.

    python3 histories.py RESULTS                       what there is, in all kinds of files, and the last values
    python3 histories.py RESULTS energies.png          energies over time, from glstat and from history.h5
"""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "src" / "python"))
import courant


def show(run):
    for name, table in run.ascii.items():
        print(f"{name}, {len(table)} times, in the last one:")
        for column in table.columns:
            print(f"  {column.name:40} {column.values[-1]:14.6g} {column.unit}")
    print("history.h5:")
    for path, values in run.histories.items():
        print(f"  {path:40} {values.shape!s:>14} {run.histories.unit(path)}")


def draw(run, picture):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    glstat, energies = run.ascii["glstat"], run.energies
    for name in ("kinetic_energy", "internal_energy", "external_work", "total_energy"):
        pyplot.plot(glstat["t"], glstat[name], label=name.replace("_", " "))
    pyplot.plot(energies["t"], energies["dissipated"], "--", label="dissipated (history.h5)")
    pyplot.xlabel(f"time [{glstat.units['t']}]")
    pyplot.ylabel(f"energy [{energies.units['dissipated']}]")
    pyplot.legend()
    pyplot.savefig(picture, dpi=120)


if __name__ == "__main__":
    results = courant.open(sys.argv[1] if len(sys.argv) > 1 else ".")
    draw(results, sys.argv[2]) if len(sys.argv) > 2 else show(results)
