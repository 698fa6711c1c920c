#!/usr/bin/env python3
"""Reads and draws histories of a run, from the text files or from history.h5.

    python3 histories.py RESULTS                       what there is
    python3 histories.py RESULTS energies.png          energies over time, from glstat and from history.h5
"""
import os
import sys


def read_glstat(path):
    """Columns of glstat by their labels: {"time": [...], "kinetic energy": [...], ...}"""
    columns = {}
    with open(path) as file:
        for line in file:
            if len(line) >= 46 and line[0] == " " and "." in line[1:32] and not line.startswith(" dt of"):
                columns.setdefault(line[1:32].rstrip(".").strip(), []).append(float(line[32:46]))
    return columns


def read_nodout(path):
    """Of each node rows of time and 12 numbers: displacement, velocity, acceleration, place (x, y, z each)."""
    nodes, time, reads = {}, None, False
    with open(path) as file:
        for line in file:
            if line.startswith(" n o d a l   p r i n t"):
                time = float(line[line.index("( at time") + 9:line.rindex(")")])
            elif line.startswith(" nodal point"):
                reads = "x-disp" in line
            elif reads and line.strip():
                numbers = [float(line[10 + 12 * k:22 + 12 * k]) for k in range(12)]
                nodes.setdefault(int(line[:9]), []).append([time, *numbers])
    return nodes


def read_history(path):
    """All datasets of history.h5 by name, and their dimensions in mass, length, time."""
    import h5py
    values, dimensions = {}, {}
    with h5py.File(path) as h5:
        def note(name, item):
            if isinstance(item, h5py.Dataset):
                values[name] = item[:]
                text = item.attrs["dimension"]
                dimensions[name] = text.decode() if isinstance(text, bytes) else str(text)
        h5.visititems(note)
    return values, dimensions


def main():
    results = sys.argv[1] if len(sys.argv) > 1 else "."
    glstat = read_glstat(os.path.join(results, "glstat"))
    values, dimensions = read_history(os.path.join(results, "history.h5"))
    if len(sys.argv) < 3:
        print(f"glstat, {len(glstat['time'])} times: " + ", ".join(glstat))
        for name, column in values.items():
            print(f"{name:40} {str(column.shape):16} {dimensions[name]}")
        return
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    for label in ("kinetic energy", "internal energy", "external work", "total energy"):
        pyplot.plot(glstat["time"], glstat[label], label=label)
    pyplot.plot(values["global/time"], values["global/dissipated"], "--", label="dissipated (history.h5)")
    pyplot.xlabel("time")
    pyplot.ylabel("energy")
    pyplot.legend()
    pyplot.savefig(sys.argv[2], dpi=120)


if __name__ == "__main__":
    main()
